// SPDX-License-Identifier: MIT
// The functions that are loaded at the first call against OpenCV's own, which this test links.

#include "base/image_codecs.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "support/test_data.h"

namespace sigs::test {
namespace {

cv::Mat gradient(int type) {
  cv::Mat image(20, 30, type);
  cv::randu(image, 0, 256);
  return image;
}

bool are_same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace

TEST_CASE("images are written and read as OpenCV does it") {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1}) {
    const cv::Mat image = gradient(type);
    std::vector<uchar> bytes, truth;
    REQUIRE(image_codecs::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 4}));
    REQUIRE(cv::imencode(".png", image, truth, {cv::IMWRITE_PNG_COMPRESSION, 4}));
    CHECK(bytes == truth);
    CHECK(are_same(image_codecs::imdecode(bytes, cv::IMREAD_UNCHANGED), image));
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "sigs_image_codecs.png";
    REQUIRE(image_codecs::imwrite(file.string(), image));
    CHECK(are_same(cv::imread(file.string(), cv::IMREAD_UNCHANGED), image));
    CHECK(are_same(image_codecs::imread(file.string(), cv::IMREAD_UNCHANGED), image));
    CHECK(are_same(image_codecs::imread(file.string()), cv::imread(file.string())));
    std::filesystem::remove(file);
  }
}

TEST_CASE("PNG files read and written without OpenCV's library have its samples and bytes") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "sigs_plain.png";
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4}) {
    CAPTURE(type);
    cv::Mat image(37, 53, type);
    cv::randu(image, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
    image(cv::Rect(10, 10, 20, 20)).setTo(cv::Scalar::all(7));  // runs, beside noise
    for (const cv::Mat& part : {image, cv::Mat(image(cv::Rect(3, 4, 31, 23)))}) {
      std::vector<uchar> bytes, truth;
      REQUIRE(image_codecs::imencode(".png", part, bytes));
      REQUIRE(cv::imencode(".png", part, truth));
      CHECK(bytes == truth);
      write_file(file, {bytes.begin(), bytes.end()});
      CHECK(are_same(image_codecs::imread(file.string(), cv::IMREAD_UNCHANGED), part));
    }
  }
  std::filesystem::remove(file);
}

TEST_CASE("a PNG file that is cut off or damaged is read as OpenCV reads it") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "sigs_damaged.png";
  std::vector<uchar> whole;
  REQUIRE(cv::imencode(".png", gradient(CV_8UC3), whole));
  for (std::size_t kept = 0; kept < whole.size(); kept += 97)
    for (const bool is_cut : {true, false}) {
      CAPTURE(kept);
      std::string bytes(whole.begin(), whole.end());
      if (is_cut)
        bytes.resize(kept);
      else
        bytes[kept] = static_cast<char>(bytes[kept] ^ 0x10);
      write_file(file, bytes);
      const cv::Mat truth = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
      const cv::Mat image = image_codecs::imread(file.string(), cv::IMREAD_UNCHANGED);
      CHECK((truth.empty() ? image.empty() : are_same(image, truth)));
    }
  std::filesystem::remove(file);
}

TEST_CASE("what is no image is read as an empty one, and a format that is not known is refused") {
  CHECK(image_codecs::imread("/nowhere/none.png").empty());
  const std::vector<uchar> nonsense{'n', 'o', 'n', 'e'};
  CHECK(image_codecs::imdecode(nonsense, cv::IMREAD_COLOR).empty());
  std::vector<uchar> bytes;
  CHECK_THROWS_AS(image_codecs::imencode(".nothing", gradient(CV_8UC1), bytes), cv::Exception);
}

}  // namespace sigs::test
