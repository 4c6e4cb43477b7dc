// SPDX-License-Identifier: MIT
#include "frame/contrail.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"

namespace sigs {

namespace {

constexpr int kPoints = 200;          // along a strand, closer together at its beginning
constexpr double kMinSpeed_mps = 1;   // nothing that hovers leaves a trail
constexpr double kBehindTail = 0.1;   // lengths of the aircraft from its tail to where ice is seen
constexpr double kForming = 0.3;      // lengths over which the trail becomes as dense as it gets
constexpr double kMinSine = 0.1;      // of the angle between trail and line of sight: it is no endless line
constexpr double kMinSigma_px = 0.5;  // of a profile: narrower ones change with their place between pixels
constexpr double kReach = 3.5;        // sigmas to which a profile is drawn: exp(-6)

// Places of the engines across the span, in spans from the middle.
std::vector<double> engines_of(int strands) {
  switch (strands) {
    case 1:
      return {0};
    case 2:
      return {-0.17, 0.17};
    case 3:
      return {-0.17, 0, 0.17};
    default:
      return {-0.3, -0.17, 0.17, 0.3};
  }
}

// Of a strand's middle seen from the side, at a distance behind its beginning.
double depth_at(const ContrailSettings& contrail, double behind_m, double sigma_m, double aircraft_m) {
  const double at_engine = -std::log(1 - std::min(contrail.opacity, 0.999));
  const double forming = 1 - std::exp(-behind_m / (kForming * aircraft_m));
  const double fading = std::max(0.0, 1 - behind_m / contrail.length_m);
  return at_engine * forming * fading * (contrail.width_m / 4) / sigma_m;
}

// One piece of a strand, between two places that follow each other.
struct Piece {
  const TrailPoint& from;
  const TrailPoint& to;
};

// Ice in a pixel.
struct Ice {
  float depth = 0;  // optical
  float distance_m = 0;
};

// Of a piece at a pixel: that of its nearest place.
Ice ice_of(const Piece& piece, const glm::dvec2& pixel) {
  const glm::dvec2 way = piece.to.pixel - piece.from.pixel;
  const double length2 = glm::dot(way, way);
  const double share = length2 > 0 ? std::clamp(glm::dot(pixel - piece.from.pixel, way) / length2, 0.0, 1.0) : 0.0;
  const double sigma_px = std::lerp(piece.from.sigma_px, piece.to.sigma_px, share);
  const glm::dvec2 off = pixel - (piece.from.pixel + share * way);
  const double wide_px = std::max(sigma_px, kMinSigma_px);
  const double depth = std::lerp(piece.from.depth, piece.to.depth, share) * sigma_px / wide_px;
  return {static_cast<float>(depth * std::exp(-glm::dot(off, off) / (2 * wide_px * wide_px))),
          static_cast<float>(std::lerp(piece.from.distance_m, piece.to.distance_m, share))};
}

// Where the lens' columns repeat, each strand in one piece, and three times: in its place and a period to each side, so
// that what leaves the image on one side comes in on the other.
std::vector<TrailStrand> all_round(std::vector<TrailStrand> strands, const Lens& lens) {
  const double period_px = lens.period_px();
  if (!(period_px > 0)) return strands;
  std::vector<TrailStrand> all;
  for (TrailStrand& strand : strands) {
    for (std::size_t i = 1; i < strand.size(); ++i)
      strand[i].pixel = strand[i - 1].pixel + lens.way(strand[i - 1].pixel, strand[i].pixel);
    for (const double by_px : {-period_px, 0.0, period_px}) {
      all.push_back(strand);
      for (TrailPoint& point : all.back()) point.pixel.x += by_px;
    }
  }
  return all;
}

// Pixels to a radian across a strand: of a lens whose scale differs by direction that much, across its image.
//   p_in_camera  the place
//   along        the strand's direction there
double pixels_across(const Lens& lens, const glm::dvec3& p_in_camera, const glm::dvec3& along,
                     const glm::dvec2& pixel) {
  constexpr double kStep_rad = 1e-4;
  if (!(lens.period_px() > 0)) return lens.pixels_per_radian(p_in_camera);
  const glm::dvec3 seen = glm::normalize(p_in_camera);
  const glm::dvec3 across = glm::cross(along, seen);
  const double sine = glm::length(across);
  const auto beside = lens.pixel(seen + kStep_rad / sine * across);
  const auto ahead = lens.pixel(seen + kStep_rad / sine * (along - seen * glm::dot(along, seen)));
  if (!(sine > 0) || !beside || !ahead) return lens.pixels_per_radian(seen);
  const glm::dvec2 a = lens.way(pixel, *beside), b = lens.way(pixel, *ahead);
  return std::abs(a.x * b.y - a.y * b.x) / (std::max(glm::length(b), 1e-12) * kStep_rad);
}

double reach_px(const Piece& piece) {
  return kReach * std::max({piece.from.sigma_px, piece.to.sigma_px, kMinSigma_px});
}

// Pixels within reach of a piece, in whole numbers; clamped, so that the far end of a trail may lie anywhere.
cv::Rect rect_of(const Piece& piece, const cv::Rect& bounds) {
  const double reach = reach_px(piece);
  const glm::dvec2 low = glm::min(piece.from.pixel, piece.to.pixel) - reach;
  const glm::dvec2 high = glm::max(piece.from.pixel, piece.to.pixel) + reach;
  return pixels_touched({low.x, low.y, high.x - low.x, high.y - low.y}, 0, bounds);
}

// Adds a piece to the strand's depths and distances (CV_32FC1 over rect): where two pieces meet, the denser one counts.
void draw(const Piece& piece, const cv::Rect& rect, cv::Mat& depths, cv::Mat& distances_m) {
  const double reach = reach_px(piece);
  const glm::dvec2 way = piece.to.pixel - piece.from.pixel;
  const cv::Rect own = rect_of(piece, rect);
  for (int y = own.y; y < own.y + own.height; ++y) {
    // The share of the piece that comes near this row, and the columns near that.
    double first = 0, last = 1;
    if (std::abs(way.y) > 1e-9) {
      first = (y - reach - piece.from.pixel.y) / way.y;
      last = (y + reach - piece.from.pixel.y) / way.y;
      if (first > last) std::swap(first, last);
      first = std::clamp(first, 0.0, 1.0);
      last = std::clamp(last, 0.0, 1.0);
    }
    const double one = piece.from.pixel.x + first * way.x;
    const double other = piece.from.pixel.x + last * way.x;
    const double low = std::min(one, other), high = std::max(one, other);
    const int begin = std::max(own.x, static_cast<int>(std::floor(std::max(low - reach, own.x - 1.0))));
    const int end = std::min(own.x + own.width, static_cast<int>(std::ceil(std::min(high + reach, 1e6))) + 1);
    float* const row = depths.ptr<float>(y - rect.y);
    float* const distances = distances_m.ptr<float>(y - rect.y);
    for (int x = begin; x < end; ++x) {
      const Ice ice = ice_of(piece, {x, y});
      if (!(ice.depth > row[x - rect.x])) continue;
      row[x - rect.x] = ice.depth;
      distances[x - rect.x] = ice.distance_m;
    }
  }
}

}  // namespace

std::vector<TrailStrand> contrail_strands(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                          const Lens& lens) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(placed.id)];
  const double speed_mps = glm::length(intruder.trajectory.velocity_mps(moment.time_s));
  if (intruder.contrail.strands == 0 || !(speed_mps > kMinSpeed_mps)) return {};
  const Mesh& mesh = intruder.model->mesh;
  const double aircraft_m = std::max(0.1, double(mesh.high_m.x) - double(mesh.low_m.x));
  const double span_m = double(mesh.high_m.y) - double(mesh.low_m.y);
  const double begin_m = -double(mesh.low_m.x) + kBehindTail * aircraft_m;
  const glm::dquat camera_from_world = glm::conjugate(moment.world_from_camera.rotation);
  const std::vector<double> engines = engines_of(intruder.contrail.strands);
  std::vector<TrailStrand> open(engines.size()), strands;
  const auto close = [&](TrailStrand& strand) {
    if (strand.size() > 1) strands.push_back(std::move(strand));
    strand.clear();
  };
  for (int i = 0; i <= kPoints; ++i) {
    const double behind_m = intruder.contrail.length_m * std::pow(double(i) / kPoints, 2.5);
    const double age_s = (begin_m + behind_m) / speed_mps;
    const Pose<frame::World, frame::Body> then = intruder.trajectory.world_from_body(moment.time_s - age_s);
    const glm::dvec3 along =
        glm::normalize(camera_from_world * intruder.trajectory.velocity_mps(moment.time_s - age_s));
    const double sigma_m =
        std::hypot(intruder.contrail.width_m / 4, intruder.contrail.spread_mps * behind_m / speed_mps);
    for (std::size_t k = 0; k < engines.size(); ++k) {
      const glm::dvec3 in_world = then.translation_m + then.rotation * glm::dvec3(0, engines[k] * span_m, 0);
      const glm::dvec3 seen = camera_from_world * (in_world - moment.world_from_camera.translation_m);
      const double distance_m = glm::length(seen);
      const std::optional<glm::dvec2> pixel = distance_m > 0 ? lens.pixel(seen) : std::nullopt;
      if (!pixel) {
        close(open[k]);
        continue;
      }
      const double sine = glm::length(glm::cross(along, seen / distance_m));
      open[k].push_back({*pixel, pixels_across(lens, seen, along, *pixel) * sigma_m / distance_m,
                         depth_at(intruder.contrail, behind_m, sigma_m, aircraft_m) / std::max(sine, kMinSine),
                         distance_m});
    }
  }
  for (TrailStrand& strand : open) close(strand);
  return all_round(std::move(strands), lens);
}

Trail trail_of(std::span<const TrailStrand> strands, const cv::Vec3d& color, const cv::Rect& bounds) {
  cv::Rect rect;
  for (const TrailStrand& strand : strands)
    for (std::size_t i = 1; i < strand.size(); ++i) rect |= rect_of({strand[i - 1], strand[i]}, bounds);
  if (rect.empty()) return {};
  cv::Mat sum = cv::Mat::zeros(rect.size(), CV_32FC1);
  cv::Mat moment_m = cv::Mat::zeros(rect.size(), CV_32FC1);  // sum of depths times distances
  for (const TrailStrand& strand : strands) {
    cv::Mat depths = cv::Mat::zeros(rect.size(), CV_32FC1), distances_m = cv::Mat::zeros(rect.size(), CV_32FC1);
    for (std::size_t i = 1; i < strand.size(); ++i) draw({strand[i - 1], strand[i]}, rect, depths, distances_m);
    sum += depths;
    moment_m += depths.mul(distances_m);
  }
  Layer layer{.rect = rect, .color = cv::Mat(rect.size(), CV_32FC4), .coverage = cv::Mat::zeros(rect.size(), CV_32FC1)};
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x) {
      const float opacity = 1 - std::exp(-sum.at<float>(y, x));
      auto& pixel = layer.color.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = opacity * static_cast<float>(color[c]);
      pixel[3] = opacity;
    }
  cv::Mat distance_m = moment_m / sum;
  distance_m.setTo(0, sum == 0);
  return {std::move(layer), std::move(distance_m)};
}

cv::Vec3d contrail_color(const Scene& scene, const SceneMoment& moment, const ContrailSettings& contrail) {
  const SceneLight& light = scene.light;
  glm::dvec3 color = light.color * std::lerp(light.ambient, 1.0, contrail.brightness);
  if (light.kind == LightKind::sun)
    color = light.exposure * (contrail.brightness * moment.sun_visible_share * light.color +
                              0.5 * (light.sky_color + light.ground_color));
  return {color.x, color.y, color.z};
}

bool is_before_aircraft(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed) {
  const glm::dvec3 velocity =
      scene.intruders[static_cast<std::size_t>(placed.id)].trajectory.velocity_mps(moment.time_s);
  const glm::dvec3 to_aircraft = moment.world_from_camera.rotation * placed.camera_from_body.translation_m;
  return glm::dot(velocity, to_aircraft) > 0;
}

}  // namespace sigs
