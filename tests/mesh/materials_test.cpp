// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <opencv2/imgcodecs.hpp>

#include "base/staged_outputs.h"
#include "mesh/mesh.h"
#include "mesh/written.h"
#include "support/test_data.h"

namespace sigs {
namespace {

constexpr char kShape[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

// One triangle of material "paint", described by this text.
class Painted {
 public:
  explicit Painted(const std::string& mtl) {
    test::written(folder / "model.mtl", "newmtl paint\n" + mtl);
    test::written(folder / "model.obj", std::string("mtllib model.mtl\n") + kShape + "usemtl paint\nf 1/1 2/2 3/3\n");
  }
  [[nodiscard]] Mesh mesh() const { return read_obj(folder / "model.obj").value(); }
  [[nodiscard]] Material material() const { return mesh().materials.at(0); }

  test::TemporaryFolder folder;
};

cv::Mat two_rows(int type, const cv::Scalar& top, const cv::Scalar& bottom) {
  cv::Mat texture(2, 1, type);
  texture.row(0) = top;
  texture.row(1) = bottom;
  return texture;
}

}  // namespace

TEST_CASE("colours and gloss come from the MTL") {
  const Material material = Painted("Kd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 42\n").material();
  CHECK(material.name == "paint");
  CHECK(material.diffuse == glm::vec3{0.1F, 0.2F, 0.3F});
  CHECK(material.specular == glm::vec3{0.4F, 0.5F, 0.6F});
  CHECK(material.shininess == 42);
  CHECK(material.opacity == 1);
  CHECK(material.texture.empty());
}

TEST_CASE("opacity is d, or 1 - Tr, or the fourth number of Kd, in that order") {
  const auto opacity = [](const std::string& mtl) { return Painted(mtl).material().opacity; };
  CHECK(opacity("Kd 1 1 1\n") == 1);
  CHECK(opacity("Kd 1 1 1\nd 0.25\n") == 0.25F);
  CHECK(opacity("Kd 1 1 1\nTr 0.25\n") == 0.75F);
  CHECK(opacity("Kd 1 1 1 0.345\n") == 0.345F);
  CHECK(opacity("Kd 1 1 1 0.345\nd 0.5\n") == 0.5F);
  CHECK(opacity("d 0.5\nKd 1 1 1 0\n") == 0.5F);
  CHECK(opacity("Kd 1 1 1 7\n") == 1);
  CHECK(opacity("Kd 1 1 1 # white\n") == 1);
}

TEST_CASE("invisible materials are left out of the mesh with a warning") {
  const test::TemporaryFolder folder;
  test::written(folder / "model.mtl", "newmtl paint\nKd 1 0 0 1\nnewmtl hot_spot\nKd 0.6 0.6 0.6 0\n");
  test::written(folder / "model.obj", std::string("mtllib model.mtl\n") + kShape +
                                          "v 9 9 9\nusemtl hot_spot\nf 1 2 4\nusemtl paint\nf 1 2 3\n");
  const Mesh mesh = read_obj(folder / "model.obj").value();
  CHECK(mesh.indices.size() == 3);
  CHECK(mesh.high_m == glm::vec3{1, 0, 0});
  REQUIRE(mesh.parts.size() == 1);
  CHECK(mesh.materials[mesh.parts[0].material].name == "paint");
  REQUIRE(mesh.warnings.size() == 1);
  CHECK(mesh.warnings[0].text().find("hot_spot") != std::string::npos);
}

TEST_CASE("a model that is transparent throughout is rendered solid with a warning") {
  const Mesh mesh = Painted("Kd 0.2 0.2 0.2 0\n").mesh();
  CHECK(mesh.materials[0].opacity == 1);
  CHECK(mesh.warnings.size() == 1);
}

TEST_CASE("a missing MTL file gives grey and a warning with its name") {
  const test::TemporaryFolder folder;
  test::written(folder / "model.obj", std::string("mtllib lost.mtl\n") + kShape + "usemtl paint\nf 1 2 3\n");
  const Mesh mesh = read_obj(folder / "model.obj").value();
  CHECK(mesh.materials.at(0).diffuse == glm::vec3{0.5F});
  REQUIRE(mesh.warnings.size() == 1);
  CHECK(mesh.warnings[0].text().find("lost.mtl") != std::string::npos);
}

TEST_CASE("faces without a material are grey without a warning") {
  const test::TemporaryFolder folder;
  const Mesh mesh = read_obj(test::written(folder / "model.obj", std::string(kShape) + "f 1 2 3\n")).value();
  CHECK(mesh.materials.at(0).diffuse == glm::vec3{0.5F});
  CHECK(mesh.warnings.empty());
}

TEST_CASE("a material that no MTL file has is grey and reported") {
  const test::TemporaryFolder folder;
  test::written(folder / "model.mtl", "newmtl other\nKd 1 0 0\n");
  test::written(folder / "model.obj", std::string("mtllib model.mtl\n") + kShape + "usemtl paint\nf 1 2 3\n");
  const Mesh mesh = read_obj(folder / "model.obj").value();
  CHECK(mesh.materials.at(0).diffuse == glm::vec3{0.5F});
  REQUIRE(mesh.warnings.size() == 1);
  CHECK(mesh.warnings[0].text().find("paint") != std::string::npos);
}

TEST_CASE("a missing or unreadable texture gives grey and a warning with its name") {
  for (const bool is_there : {false, true}) {
    Painted painted("Kd 1 0 0\nmap_Kd lost.png\n");
    if (is_there) test::written(painted.folder / "lost.png", "this is no texture");
    const Mesh mesh = painted.mesh();
    CHECK(mesh.materials.at(0).diffuse == glm::vec3{0.5F});
    CHECK(mesh.materials.at(0).texture.empty());
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].text().find("lost.png") != std::string::npos);
  }
}

TEST_CASE("textures of every kind become eight bit RGBA with their top row first") {
  struct Kind {
    const char* name;
    cv::Mat texture;
    cv::Vec4b top;
  };
  const cv::Vec4b red{255, 0, 0, 255};
  const Kind kinds[] = {
      {"gray.png", two_rows(CV_8UC1, 200, 10), {200, 200, 200, 255}},
      {"rgb.png", two_rows(CV_8UC3, {0, 0, 255}, {255, 0, 0}), red},
      {"rgba.png", two_rows(CV_8UC4, {0, 0, 255, 77}, {255, 0, 0, 255}), {255, 0, 0, 77}},
      {"gray16.png", two_rows(CV_16UC1, 200 * 257, 0), {200, 200, 200, 255}},
      {"rgb16.png", two_rows(CV_16UC3, {0, 0, 65535}, {0, 0, 0}), red},
      {"texture.bmp", two_rows(CV_8UC3, {0, 0, 255}, {255, 0, 0}), red},
  };
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    Painted painted("Kd 1 1 1\nmap_Kd " + std::string(kind.name) + "\n");
    REQUIRE(cv::imwrite((painted.folder / kind.name).string(), kind.texture));
    const cv::Mat texture = painted.material().texture;
    REQUIRE(texture.type() == CV_8UC4);
    REQUIRE(texture.size() == cv::Size(1, 2));
    CHECK(texture.at<cv::Vec4b>(0, 0) == kind.top);
    CHECK(texture.at<cv::Vec4b>(1, 0) != kind.top);
  }
}

TEST_CASE("a texture of too many pixels is named with its size and not decoded") {
  // Headers that state such a size, with next to nothing behind them: a decoder that does not read them first would
  // allocate that size.
  struct Kind {
    const char* name;
    std::size_t place;  // of the width, then the height
    std::string sides;
  };
  const Kind kinds[] = {{"large.bmp", 18, std::string("\x80\x3E\0\0\x80\x3E\0\0", 8)},
                        {"large.jpg", 0, std::string("\x3E\x80\x3E\x80", 4)}};
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    Painted painted("Kd 1 0 0\nmap_Kd " + std::string(kind.name) + "\n");
    const std::string file = (painted.folder / kind.name).string();
    REQUIRE(cv::imwrite(file, two_rows(CV_8UC3, 1, 2)));
    std::string bytes = read_text(file).value();
    const std::size_t place = kind.place > 0 ? kind.place : bytes.find("\xFF\xC0") + 5;
    test::written(file, bytes.replace(place, kind.sides.size(), kind.sides));
    const Mesh mesh = painted.mesh();
    CHECK(mesh.materials.at(0).texture.empty());
    REQUIRE(mesh.warnings.size() == 1);
    CHECK_MESSAGE(mesh.warnings[0].text().find("16000x16000") != std::string::npos, mesh.warnings[0].text());
    CHECK_MESSAGE(mesh.warnings[0].text().find(kind.name) != std::string::npos, mesh.warnings[0].text());
  }
}

TEST_CASE("textures are found in folders, with blanks, and with names from Windows") {
  for (const char* written :
       {"textures/my paint.png", "textures\\my paint.png", "Textures\\My Paint.PNG", "C:\\Users\\me\\my paint.png"}) {
    CAPTURE(written);
    Painted painted("map_Kd " + std::string(written) + "\n");
    const bool is_beside = std::string(written).starts_with("C:") || std::string(written).starts_with("T");
    const auto folder = is_beside ? painted.folder.path() : painted.folder / "textures";
    std::filesystem::create_directories(folder);
    REQUIRE(cv::imwrite((folder / "my paint.png").string(), two_rows(CV_8UC1, 1, 2)));
    CHECK(painted.mesh().warnings.empty());
    CHECK_FALSE(painted.material().texture.empty());
    CHECK(painted.material().diffuse == glm::vec3{1.0F});
  }
}

TEST_CASE("materials that name the same texture share its pixels") {
  const test::TemporaryFolder folder;
  cv::imwrite((folder / "a.png").string(), two_rows(CV_8UC1, 1, 2));
  test::written(folder / "model.mtl", "newmtl one\nmap_Kd a.png\nnewmtl two\nmap_Kd a.png\n");
  test::written(folder / "model.obj",
                std::string("mtllib model.mtl\n") + kShape + "usemtl one\nf 1 2 3\nusemtl two\nf 1 3 2\n");
  const Mesh mesh = read_obj(folder / "model.obj").value();
  REQUIRE(mesh.parts.size() == 2);
  CHECK(mesh.materials[0].texture.data == mesh.materials[1].texture.data);
}

TEST_CASE("an opacity map multiplies the opacity of the texture") {
  Painted painted("Kd 1 1 1\nmap_Kd paint.png\nmap_d holes.png\n");
  cv::imwrite((painted.folder / "paint.png").string(), two_rows(CV_8UC3, {0, 0, 255}, {0, 0, 255}));
  cv::imwrite((painted.folder / "holes.png").string(), two_rows(CV_8UC1, 255, 0));
  const cv::Mat texture = painted.material().texture;
  CHECK(texture.at<cv::Vec4b>(0, 0) == cv::Vec4b{255, 0, 0, 255});
  CHECK(texture.at<cv::Vec4b>(1, 0) == cv::Vec4b{255, 0, 0, 0});
}

TEST_CASE("texture coordinates follow the placement in the MTL") {
  Painted painted("map_Kd -s 2 3 1 -o 0.5 0.25 0 a.png\n");
  cv::imwrite((painted.folder / "a.png").string(), two_rows(CV_8UC1, 1, 2));
  const Mesh mesh = painted.mesh();
  REQUIRE(mesh.vertices.size() == 3);
  CHECK(mesh.vertices[mesh.indices[0]].uv == glm::vec2{0.5F, 0.25F});
  CHECK(mesh.vertices[mesh.indices[1]].uv == glm::vec2{2.5F, 0.25F});
  CHECK(mesh.vertices[mesh.indices[2]].uv == glm::vec2{0.5F, 3.25F});
}

TEST_CASE("an MTL file whose name contains blanks is found") {
  const test::TemporaryFolder folder;
  test::written(folder / "my model.mtl", "newmtl my paint\nKd 0 1 0\n");
  test::written(folder / "model.obj", std::string("mtllib my model.mtl\n") + kShape + "usemtl my paint \nf 1 2 3\n");
  const Mesh mesh = read_obj(folder / "model.obj").value();
  CHECK(mesh.warnings.empty());
  CHECK(mesh.materials.at(0).diffuse == glm::vec3{0, 1, 0});
}

}  // namespace sigs
