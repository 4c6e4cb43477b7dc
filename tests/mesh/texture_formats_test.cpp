// SPDX-License-Identifier: MIT
#include "mesh/materials.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/written.h"

namespace sigs::test {
namespace {

std::string bytes_of(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

// 2 columns, 3 rows, 24 bits a pixel. Rows come from below as Targa has them, unless bit 5 of the description is set.
std::string targa(int description) {
  return bytes_of({0, 0, 2, 0, 0, 0, 0, 0, 0, 0,  0,  0,  2,  0,  3,  0,  24, description,  //
                   1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18});
}

// The same size, uncompressed, a byte a sample, one plane after the other from below.
std::string sgi(int planes) {
  std::string bytes = bytes_of({0x01, 0xDA, 0, 1, 0, 3, 0, 2, 0, 3, 0, planes});
  bytes.resize(512, '\0');
  bytes[19] = static_cast<char>(0xFF);  // the largest sample
  for (int i = 0; i < 6 * planes; ++i) bytes.push_back(static_cast<char>(10 + i));
  return bytes;
}

}  // namespace

TEST_CASE("Targa and SGI images have their samples, with the first row on top") {
  CHECK(texture_size_px(targa(0)) == cv::Size(2, 3));
  const cv::Mat from_below = decoded_texture(targa(0));
  REQUIRE(from_below.type() == CV_8UC3);
  CHECK(from_below.at<cv::Vec3b>(2, 0) == cv::Vec3b(1, 2, 3));
  CHECK(from_below.at<cv::Vec3b>(0, 1) == cv::Vec3b(16, 17, 18));
  CHECK(decoded_texture(targa(0x20)).at<cv::Vec3b>(0, 0) == cv::Vec3b(1, 2, 3));

  CHECK(texture_size_px(sgi(3)) == cv::Size(2, 3));
  const cv::Mat color = decoded_texture(sgi(3));
  REQUIRE(color.type() == CV_8UC3);
  CHECK(color.at<cv::Vec3b>(2, 1) == cv::Vec3b(23, 17, 11));  // blue, green, red
  CHECK(color.at<cv::Vec3b>(0, 0) == cv::Vec3b(26, 20, 14));
  const cv::Mat with_opacity = decoded_texture(sgi(4));
  REQUIRE(with_opacity.type() == CV_8UC4);
  CHECK(with_opacity.at<cv::Vec4b>(2, 0) == cv::Vec4b(22, 16, 10, 28));
  const cv::Mat gray = decoded_texture(sgi(1));
  REQUIRE(gray.type() == CV_8UC1);
  CHECK(gray.at<uchar>(0, 1) == 15);
}

TEST_CASE("what is no such image, or a part of one, gives none") {
  for (const std::string& bytes : {std::string(), std::string("P6 2 2 255 "), std::string(600, '\0'),
                                   std::string("\x89PNG\r\n\x1A\n 0123456789"), sgi(3).substr(0, 12)})
    CHECK_FALSE(texture_size_px(bytes));
  for (const std::string& bytes : {targa(0).substr(0, 20), sgi(3).substr(0, 514)}) {
    CHECK(texture_size_px(bytes));
    CHECK(decoded_texture(bytes).empty());
  }
  // A header that claims more than there is memory for is refused by its size, before anything is decoded.
  std::string large = targa(0);
  large[13] = large[15] = static_cast<char>(0xFF);
  CHECK(texture_size_px(large) == cv::Size(0xFF02, 0xFF03));
  const TemporaryFolder folder;
  written(folder / "large.tga", large);
  written(folder / "paint.tga", targa(0));
  const auto mesh_with = [&](const std::string& texture) {
    written(folder / "model.mtl", "newmtl paint\nmap_Kd " + texture + "\n");
    return read_obj(written(folder / "model.obj",
                            "mtllib model.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                            "f 1/1 2/2 3/3\n"))
        .value();
  };
  const Mesh painted = mesh_with("paint.tga");
  CHECK(painted.warnings.empty());
  CHECK(painted.materials.at(0).texture.at<cv::Vec4b>(2, 0) == cv::Vec4b(3, 2, 1, 255));
  const Mesh plain = mesh_with("large.tga");
  REQUIRE(plain.warnings.size() == 1);
  CHECK(plain.warnings[0].text().find("at most 8192x8192") != std::string::npos);
}

}  // namespace sigs::test
