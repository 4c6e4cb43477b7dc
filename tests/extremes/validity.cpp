// SPDX-License-Identifier: MIT
#include "extremes/validity.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <pugixml.hpp>

#include "labels/formats.h"
#include "spline/flights.h"

namespace sigs::test {

namespace {

constexpr double kRounding = 1e-3;  // of sums of floats; wide blur may undershoot zero by a thousandth

bool is_share(double value) {
  return value >= 0 && value <= 1;  // false for NaN
}

// Lowest and highest of all channels, and false for any that is NaN or infinite.
bool all_finite(const cv::Mat& mat) {
  return cv::checkRange(mat, true, nullptr, -1e30, 1e30);
}

struct Range {
  double low = 0;
  double high = 0;
};

Range range_of(const cv::Mat& mat) {
  Range range;
  cv::minMaxIdx(mat.reshape(1), &range.low, &range.high);
  return range;
}

bool is_valid(const Attitude& attitude) {
  constexpr double kTurn = std::numbers::pi * (1 + 1e-12);
  return std::abs(attitude.roll_rad) <= kTurn && std::abs(attitude.pitch_rad) <= kTurn / 2 &&
         std::abs(attitude.yaw_rad) <= kTurn;
}

// The attributes that hold no number.
bool is_text(const std::string& name) {
  constexpr std::array<const char*, 4> kTexts{"name", "in_picture", "horizon", "video"};
  return std::find(kTexts.begin(), kTexts.end(), name) != kTexts.end();
}

// How many attributes of the node and all below it hold numbers; each is read back.
int checked_numbers(const pugi::xml_node& node) {
  int count = 0;
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    if (is_text(attribute.name())) continue;
    char* end = nullptr;
    const double value = std::strtod(attribute.value(), &end);
    INFO(node.name() << " " << attribute.name() << "=\"" << attribute.value() << "\"");
    CHECK(end != attribute.value());
    CHECK(*end == '\0');
    CHECK(std::isfinite(value));
    ++count;
  }
  for (const pugi::xml_node& child : node.children()) count += checked_numbers(child);
  return count;
}

void check_image(const ComposedFrame& composed, const Frame& background) {
  const Frame& image = composed.image;
  REQUIRE(image.layout == background.layout);
  for (std::size_t i = 0; i < static_cast<std::size_t>(image.plane_count()); ++i) {
    CHECK(image.planes[i].type() == CV_8UC1);
    CHECK(image.planes[i].size() == background.planes[i].size());
  }
  if (composed.mask.empty()) {
    CHECK(same_planes(image, background));
    return;
  }
  CHECK(composed.mask.type() == CV_8UC1);
  REQUIRE(composed.mask.size() == image.size_px());
  cv::Mat changed;
  cv::compare(image.planes[0], background.planes[0], changed, cv::CMP_NE);
  CHECK(cv::countNonZero(changed & (composed.mask == 0)) == 0);
}

// OpenGL is made once for all frames of the program: a frame does not depend on the frames before it.
ComposeContext& shared_bench() {
  static ComposeContext context;
  return context;
}

// No surface of the scene emits more: the light's strongest channel, and gloss of a quarter of it.
double brightest_of(const Scene& scene) {
  const glm::dvec3& color = scene.light.color;
  return 1.25 * std::max({color.r, color.g, color.b});
}

}  // namespace

void check_valid(const Layer& layer, double brightest) {
  if (layer.empty()) return;
  CHECK(layer.color.type() == CV_32FC4);
  CHECK(layer.coverage.type() == CV_32FC1);
  REQUIRE(layer.color.size() == layer.rect.size());
  REQUIRE(layer.coverage.size() == layer.rect.size());
  CHECK(all_finite(layer.color));
  CHECK(all_finite(layer.coverage));
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  const Range covered = range_of(layer.coverage);
  const Range opaque = range_of(opacity);
  const Range light = range_of(layer.color);
  CHECK(covered.low >= 0);
  CHECK(covered.high <= 1 + kRounding);
  CHECK(opaque.low >= -kRounding);
  CHECK(opaque.high <= 1 + kRounding);
  CHECK(light.low >= -kRounding);
  CHECK(light.high <= std::max(1.0, brightest) * (1 + kRounding));
}

void check_valid(const IntruderTruth& truth, cv::Size image_size_px) {
  CHECK(is_finite(truth.position_m));
  CHECK(is_valid(attitude_of(truth.world_from_body)));
  CHECK(is_share(truth.visible_fraction));
  if (!truth.in_image) CHECK(truth.visible_fraction == 0);
  if (truth.visible_box) {
    CHECK(truth.in_image);
    CHECK(!truth.visible_box->empty());
    CHECK((*truth.visible_box & cv::Rect({0, 0}, image_size_px)) == *truth.visible_box);
  }
  if (truth.amodal_box) {
    const Box& box = *truth.amodal_box;
    for (const double number : {box.x, box.y, box.width, box.height}) CHECK(std::isfinite(number));
    CHECK(box.width >= 0);
    CHECK(box.height >= 0);
  }
}

void check_valid(const FrameTruth& truth, cv::Size image_size_px) {
  CHECK(std::isfinite(truth.time_s));
  CHECK(is_finite(truth.camera_position_m));
  CHECK(is_valid(attitude_of(truth.world_from_camera)));
  for (const IntruderTruth& intruder : truth.intruders) check_valid(intruder, image_size_px);
  pugi::xml_document document;
  REQUIRE(document.load_string(xml_of(truth).c_str()));
  // Frame number and time, and of each intruder at least number, share, place, distance and attitude.
  CHECK(checked_numbers(document) >= 2 + 9 * static_cast<int>(truth.intruders.size()));
}

ValidFrame valid_frame(const Scene& scene, int frame, const Frame& background) {
  ComposeContext& context = shared_bench();
  Result<ComposedFrame> composed = compose_frame(scene, frame, background, context);
  if (!composed) FAIL(composed.error().text());
  ValidFrame valid{.composed = std::move(*composed)};
  check_image(valid.composed, background);
  check_valid(valid.composed.truth, background.size_px());
  const SceneMoment moment = scene_at(scene, frame);
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers = intruder_layers(scene, moment, placed, context);
    if (!layers) FAIL(layers.error().text());
    for (const RenderedView& drawn : layers->views) check_valid(drawn.layer, brightest_of(scene));
    for (const Layer* layer : {&layers->warped, &layers->blurred, &layers->occluded})
      check_valid(*layer, brightest_of(scene));
    CHECK(std::isfinite(layers->formation.blur_px));
    CHECK(std::isfinite(layers->whole_area_px));
    CHECK(layers->whole_area_px >= 0);
    valid.layers.push_back(std::move(*layers));
  }
  for (const std::shared_ptr<const Model>& model : scene.models) context.forget(model->mesh);
  return valid;
}

void set_lens(Scenario& scenario, const cv::Matx33d& matrix, const std::vector<double>& coefficients, bool is_fisheye) {
  write_calibration(scenario.path("lens.xml"), matrix, coefficients, scenario.size_px(), is_fisheye);
  scenario.project.footage.calibration = "lens.xml";
}

void add_plate(Scenario& scenario, double side_m, const glm::dvec3& p_in_world) {
  const double half_m = side_m / 2;
  // A hundred times thinner than wide: its far side is hidden behind the near one, and smaller.
  write_obj(scenario.path("plate.obj"), {{{0, -half_m, -half_m}, {side_m / 100, half_m, half_m}, {1, 1, 1}}}, 1);
  scenario.add("plate.obj", p_in_world);
}

void add_cube(Scenario& scenario, double side_m, const glm::dvec3& p_in_world) {
  write_obj(scenario.path("cube.obj"), {{glm::dvec3(-side_m / 2), glm::dvec3(side_m / 2), {1, 1, 1}}}, 2);
  scenario.add("cube.obj", p_in_world);
}

double opacity_px(const Layer& layer) {
  return layer.empty() ? 0.0 : cv::sum(layer.color)[3];
}

}  // namespace sigs::test
