// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>

#include "base/transfer.h"
#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

// Panes across the view, each 4 x 4 m, at distances from the body's origin in the given order.
struct Pane {
  float x_m;
  Material material;
};

Mesh panes(const std::vector<Pane>& all) {
  Mesh mesh;
  for (const Pane& pane : all) {
    mesh.materials.push_back(pane.material);
    add_quad(mesh, {pane.x_m, -2, 2}, {0, 4, 0}, {0, 0, -4}, static_cast<int>(mesh.materials.size()) - 1);
  }
  return measured(std::move(mesh));
}

Layer rendered_panes(const Mesh& mesh) {
  Layer layer = drawn(mesh, at({50, 0, 0}), ambient_only(), view_of({9, 9}, 300));
  CHECK(is_valid(layer));
  return layer;
}

glm::dvec4 over(const glm::dvec4& front, const glm::dvec4& back) {
  return front + back * (1 - front.a);
}

glm::dvec4 middle(const Layer& layer) {
  const auto c = layer.color.at<cv::Vec4f>(4, 4);
  return {c[0], c[1], c[2], c[3]};
}

const Material kRedGlass = paint({1, 0, 0}, 0.25F);
const Material kGreenGlass = paint({0, 1, 0}, 0.5F);
const Material kBlue = paint({0, 0, 1});

constexpr double kGlassRounding = 1e-6;

// An image of 2 x 2 texels: opaque and transparent above, half and opaque below.
Material cutout() {
  Material material = paint({1, 1, 1});
  material.texture.create(64, 64, CV_8UC4);
  material.texture(cv::Rect(0, 0, 32, 32)) = cv::Scalar(255, 0, 0, 255);
  material.texture(cv::Rect(32, 0, 32, 32)) = cv::Scalar(255, 0, 0, 0);
  material.texture(cv::Rect(0, 32, 32, 32)) = cv::Scalar(0, 255, 0, 128);
  material.texture(cv::Rect(32, 32, 32, 32)) = cv::Scalar(0, 0, 255, 255);
  return material;
}

}  // namespace

TEST_CASE("glass over nothing is premultiplied and covers wholly") {
  const Layer layer = rendered_panes(panes({{0, kRedGlass}}));
  CHECK(glm::distance(middle(layer), glm::dvec4{0.25, 0, 0, 0.25}) < kGlassRounding);
  CHECK(layer.coverage.at<float>(4, 4) == 1);
}

TEST_CASE("two panes are blended from far to near whatever their order in the file") {
  const glm::dvec4 red{0.25, 0, 0, 0.25};
  const glm::dvec4 green{0, 0.5, 0, 0.5};
  CHECK(glm::distance(middle(rendered_panes(panes({{-5, kRedGlass}, {5, kGreenGlass}}))), over(red, green)) <
        kGlassRounding);
  CHECK(glm::distance(middle(rendered_panes(panes({{5, kGreenGlass}, {-5, kRedGlass}}))), over(red, green)) <
        kGlassRounding);
  CHECK(glm::distance(middle(rendered_panes(panes({{-5, kGreenGlass}, {5, kRedGlass}}))), over(green, red)) <
        kGlassRounding);
}

TEST_CASE("glass shows solid parts behind it and is occluded by solid parts before it") {
  const glm::dvec4 red{0.25, 0, 0, 0.25};
  const glm::dvec4 blue{0, 0, 1, 1};
  CHECK(glm::distance(middle(rendered_panes(panes({{-5, kRedGlass}, {5, kBlue}}))), over(red, blue)) < kGlassRounding);
  CHECK(glm::distance(middle(rendered_panes(panes({{5, kRedGlass}, {-5, kBlue}}))), blue) < kGlassRounding);
}

TEST_CASE("glass never occludes glass, even where no order of whole triangles is right") {
  Mesh mesh;
  mesh.materials = {kRedGlass, kGreenGlass};
  // A large slanting pane whose triangles' middles are nearer than the small pane, although it is behind it everywhere.
  add_quad(mesh, {-10, -6, 2}, {20, 12, 0}, {0, 0, -4}, 0);
  add_quad(mesh, {5, 4.5F, 1}, {0, 1, 0}, {0, 0, -2}, 1);
  const Layer layer = drawn(measured(std::move(mesh)), at({50, 0, 0}), ambient_only(), view_of({81, 9}, 300));
  const auto color = layer.color.at<cv::Vec4f>(4, 67);  // 5 m right at 55 m: 40 + 300 * 5 / 55
  CHECK(color[3] == doctest::Approx(1 - 0.75 * 0.5));
  CHECK(color[0] > 0.1F);
  CHECK(color[1] > 0.3F);
}

TEST_CASE("what is nearly transparent neither covers nor colours") {
  const Layer layer = rendered_panes(panes({{0, paint({1, 1, 1}, 0.003F)}}));  // below 1/255
  CHECK(cv::countNonZero(layer.coverage) == 0);
  CHECK(cv::countNonZero(layer.color.reshape(1)) == 0);
}

TEST_CASE("a pane's edge covers by whole samples and its opacity follows") {
  Mesh mesh = facing_quad({-0.51, -0.37}, {0.42, 0.6}, kRedGlass);
  const Layer layer = drawn(mesh, at({25, 0, 0}), ambient_only(), view_of({32, 24}, 200));
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x)
      CHECK(layer.color.at<cv::Vec4f>(y, x)[3] == doctest::Approx(0.25F * layer.coverage.at<float>(y, x)));
}

TEST_CASE("a texture lies on the surface upright and unmirrored") {
  const Layer layer = drawn(facing_quad({-1, -1}, {1, 1}, cutout()), at({10, 0, 0}), ambient_only(),
                            view_of({64, 64}, 320));  // the square is as large as the image: 64 px
  const auto at_quarter = [&](int x, int y) { return layer.color.at<cv::Vec4f>(y, x); };
  CHECK(at_quarter(16, 16) == cv::Vec4f(1, 0, 0, 1));
  CHECK(at_quarter(48, 16) == cv::Vec4f(0, 0, 0, 0));
  CHECK(at_quarter(48, 48) == cv::Vec4f(0, 0, 1, 1));
  // Half opacity is premultiplied in linear light and stored in 8 bits of display code: half a step is 0.4 % there.
  CHECK(at_quarter(16, 48)[1] == doctest::Approx(128.0 / 255).epsilon(0.005));
  CHECK(at_quarter(16, 48)[3] == doctest::Approx(128.0 / 255).epsilon(1e-5));
  CHECK(layer.coverage.at<float>(16, 48) == 0);
  CHECK(layer.coverage.at<float>(48, 16) == 1);
  CHECK(is_valid(layer));
}

TEST_CASE("opaque texels of a cutout occlude what is behind and transparent ones do not") {
  Mesh mesh;
  mesh.materials = {cutout(), kBlue, kGreenGlass};
  add_quad(mesh, {-1, -1, 1}, {0, 2, 0}, {0, 0, -2}, 0);
  add_quad(mesh, {1, -2, 2}, {0, 4, 0}, {0, 0, -4}, 1);
  add_quad(mesh, {0, -2, 2}, {0, 4, 0}, {0, 0, -4}, 2);
  const Layer layer = drawn(measured(std::move(mesh)), at({50, 0, 0}), ambient_only(), view_of({64, 64}, 49 * 32));
  CHECK(layer.color.at<cv::Vec4f>(16, 16) == cv::Vec4f(1, 0, 0, 1));
  CHECK(layer.color.at<cv::Vec4f>(16, 48) == cv::Vec4f(0, 0.5F, 0.5F, 1));  // blue through green glass
  CHECK(is_valid(layer));
}

TEST_CASE("the colour of transparent texels does not bleed into their neighbours") {
  Material material = paint({1, 1, 1});
  material.texture.create(64, 64, CV_8UC4);
  material.texture = cv::Scalar(0, 255, 0, 0);  // transparent green
  material.texture(cv::Rect(0, 0, 32, 64)) = cv::Scalar(255, 0, 0, 255);
  const Layer layer =
      drawn(facing_quad({-1, -1}, {1, 1}, material), at({10, 0, 0}), ambient_only(), view_of({23, 23}, 70));
  std::vector<cv::Mat> planes;
  cv::split(layer.color, planes);
  CHECK(cv::countNonZero(planes[1]) == 0);
  CHECK(cv::countNonZero(planes[0]) > 0);
}

TEST_CASE("a texture's mean is kept when it is rendered small") {
  // Black and white in equal parts are a linear half from far away, not a half of display code.
  Material material = paint({1, 1, 1});
  material.texture.create(256, 256, CV_8UC4);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const uchar value = (x + y) % 2 == 0 ? 255 : 0;
      material.texture.at<cv::Vec4b>(y, x) = {value, value, value, 255};
    }
  const Layer layer =
      drawn(facing_quad({-1, -1}, {1, 1}, material), at({10, 0, 0}), ambient_only(), view_of({16, 16}, 80));
  // Levels of the image are kept in 8 bits of display code: a step near a linear half is 0.9 %.
  CHECK(layer.color.at<cv::Vec4f>(8, 8)[0] == doctest::Approx(0.5).epsilon(0.02));
}

}  // namespace sigs
