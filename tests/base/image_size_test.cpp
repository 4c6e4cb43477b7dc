// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/image.h"
#include "support/test_data.h"

namespace sigs::test {

TEST_CASE("the size in the header of an image is that which decoding gives") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.bmp", "a.tiff", "a.webp", "a.ppm", "a.pgm", "a.pbm"})
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(640, 479), cv::Size(1, 5000)})
      for (const int type : {CV_8UC1, CV_8UC3}) {
        if (name.starts_with("a.p") && name != "a.png" && (name == "a.ppm") != (type == CV_8UC3)) continue;
        CAPTURE(name);
        REQUIRE(cv::imwrite((folder / name).string(), cv::Mat(size, type, cv::Scalar::all(77))));
        const cv::Mat decoded = cv::imread((folder / name).string(), cv::IMREAD_UNCHANGED);
        REQUIRE(decoded.size() == size);
        CHECK(image_size_px(folder / name) == size);
      }
}

TEST_CASE("an incomplete file or one that is not an image has no size") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.bmp", "a.tiff", "a.webp"}) {
    REQUIRE(cv::imwrite((folder / name).string(), cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(9))));
    std::filesystem::resize_file(folder / name, 14);
    CHECK_FALSE(image_size_px(folder / name).has_value());
  }
  std::ofstream(folder / "text.png") << "this is no image, however long it may go on";
  CHECK_FALSE(image_size_px(folder / "text.png").has_value());
  CHECK_FALSE(image_size_px(folder / "none.png").has_value());
}

}  // namespace sigs::test
