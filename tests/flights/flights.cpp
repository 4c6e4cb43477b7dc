// SPDX-License-Identifier: MIT
#include "flights/flights.h"

#include <algorithm>
#include <map>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "flights/cases.h"
#include "flights/scenery.h"
#include "flights/sensor.h"

namespace sigs::flights {

namespace {

// Data shared by several flights, made when the first of them needs it.
class Countries {
 public:
  explicit Countries(int detail) : detail_(detail) {}
  std::shared_ptr<const Terrain> with(Roads roads) {
    std::shared_ptr<const Terrain>& place = made_[roads];
    if (!place) place = std::make_shared<const Terrain>(terrain(detail_, roads, 11));
    return place;
  }

 private:
  int detail_;
  std::map<Roads, std::shared_ptr<const Terrain>> made_;
};

// A bird crosses now and then.
void draw_mover(cv::Mat& image, int frame) {
  const cv::Point middle(frame * 3 % image.cols, image.rows / 4 + frame % 16);
  cv::ellipse(image, middle, {std::max(4, image.cols / 60), std::max(2, image.cols / 160)}, 0, 0, 360,
              cv::Scalar(40, 40, 44), cv::FILLED, cv::LINE_AA);
}

Shake shake_of(const Case& scene, cv::Size size_px, int frame) {
  if (scene.path.still) return {};
  Shake shake = shake_at(frame, size_px, scene.path.seed);
  shake.shift_px *= scene.shake;
  return shake;
}

cv::Mat drawn(const Case& scene, const Terrain& terrain, const Body& body, const Grain& grain,
              const cv::Mat& reflection, cv::Size size_px, int frame) {
  cv::Mat image = scenery(terrain, view_at(scene.path, size_px, frame), scene.cloudiness);
  if (scene.small_mover) draw_mover(image, frame);
  draw_over(image, scene.propeller, frame);
  draw_over(image, body, shake_of(scene, size_px, frame));
  add_to(image, reflection, scene.reflection, frame);
  if (scene.exposure_drifts) image *= drifting_gain(frame);
  grain.add_to(image, frame);
  for (const cv::Rect& bar : bars(scene, size_px)) image(bar).setTo(cv::Scalar::all(0));
  return image;
}

Flight flight(const Case& scene, const FlightSettings& settings, std::shared_ptr<const Terrain> terrain) {
  const auto body = std::make_shared<const Body>(body_of(scene.parts, settings.size_px, scene.path.seed));
  const auto grain = std::make_shared<const Grain>(scene.grain_codes);
  const cv::Mat reflection = painted(scene.reflection, settings.size_px);
  cv::Mat truth = body->truth.clone();
  for (const cv::Rect& bar : bars(scene, settings.size_px)) truth(bar).setTo(255);
  return {.name = scene.name,
          .size_px = settings.size_px,
          .own_body = truth,
          .bgr = [=, size_px = settings.size_px](
                     int n) { return drawn(scene, *terrain, *body, *grain, reflection, size_px, n); },
          .is_decidable = !scene.path.still};
}

// About the resolution at which the nearest ground appears.
int detail_for(cv::Size size_px) {
  return size_px.width <= 400 ? 1024 : size_px.width <= 800 ? 2048 : 4096;
}

std::vector<Flight> flights_of(const std::vector<Case>& scenes, const FlightSettings& settings) {
  Countries countries(detail_for(settings.size_px));
  std::vector<Flight> flights;
  for (const Case& scene : scenes) flights.push_back(flight(scene, settings, countries.with(scene.roads)));
  return flights;
}

}  // namespace

std::vector<Flight> all(const FlightSettings& settings) {
  return flights_of(cases(settings.frames), settings);
}

std::vector<Flight> hard(const FlightSettings& settings) {
  return flights_of(hard_cases(), settings);
}

std::vector<Flight> reflecting(const FlightSettings& settings) {
  return flights_of(reflecting_cases(), settings);
}

std::vector<Flight> unseen(const FlightSettings& settings) {
  return flights_of(unseen_cases(), settings);
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const Case& scene : cases(1)) names.push_back(scene.name);
  return names;
}

Flight by_name(std::string_view name, const FlightSettings& settings) {
  const std::vector<Case> scenes = cases(settings.frames);
  const auto found = std::ranges::find(scenes, name, &Case::name);
  ENSURE(found != scenes.end());
  return flight(*found, settings, Countries(detail_for(settings.size_px)).with(found->roads));
}

}  // namespace sigs::flights
