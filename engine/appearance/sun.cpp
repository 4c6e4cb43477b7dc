// SPDX-License-Identifier: MIT
#include "appearance/sun.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

constexpr double kDefaultAzimuth_rad = 2.88, kDefaultElevation_rad = 0.436;  // 165 and 25 degrees
constexpr int kGroundEvery = 2;
constexpr int kMinPatches = 10;
constexpr double kMinAgreement = 0.75;  // resultant of the doubled directions, 0 none to 1 all
constexpr double kMinSense = 0.5;       // majority of the votes for what casts the shadow, -1 to 1
constexpr double kShadowSd_rad = 0.07;  // of the level, the lens, and of things that are not upright
constexpr double kBlueRatio = 0.75;     // of red to blue: clear sky
constexpr double kMinBlueSky = 0.6;     // of the sky
constexpr double kMinSkyCells = 30;
constexpr double kTurn_rad = 2 * std::numbers::pi;

double between_half_turns(double angle_rad) {
  return std::remainder(angle_rad, kTurn_rad);
}

// The level's axes seen from the camera: by the attitude, else by the skyline, with X along the camera's heading.
std::optional<glm::dquat> level_of(const LightImage& image) {
  if (!image.skyline || !image.rays.angles_are_known()) return std::nullopt;
  if (!image.skyline->from_image && image.view.world_from_camera) return image.view.world_from_camera;
  const glm::dvec3 down = -image.skyline->up;
  const glm::dvec3 ahead = glm::dvec3(1, 0, 0) - down * down.x;
  if (glm::length(ahead) < 0.1) return std::nullopt;  // straight up or down: there is no heading
  const glm::dvec3 x = glm::normalize(ahead);
  const glm::dmat3 camera_from_level(x, glm::cross(down, x), down);
  return glm::conjugate(glm::quat_cast(camera_from_level));
}

// The deviations are those of a log's attitude, against which the sun stands in the image, and of the sun's movement.
SunEstimate by_time_and_place(const GivenSun& given) {
  constexpr double kLogSd_rad = rad_of_deg(1);
  const auto sd_with = [](double range_rad) { return std::hypot(kLogSd_rad, range_rad / std::sqrt(12)); };
  const glm::dvec3 to_sun = glm::normalize(given.to_sun_in_world);
  return {.azimuth_rad = {std::atan2(to_sun.y, to_sun.x), sd_with(given.azimuth_range_rad), true, ""},
          .elevation_rad = {std::asin(std::clamp(-to_sun.z, -1.0, 1.0)), sd_with(given.elevation_range_rad), true, ""},
          .evidence = SunEvidence::given};
}

// Lengths on the ground are in parts of the camera's height above it.
constexpr double kNearest = 0.55, kFarthest = 2.25, kHalfWidth = 1.5;
constexpr double kMinCell = 0.0032;
constexpr double kPixelsPerCell = 1.6;  // at the image's middle, seen squarely
constexpr int kMiddle_cells = 41;       // window of the median that is the ground's own brightness
constexpr double kShadowDark = 0.76;    // of that, as displayed: a shadow has half of the light or less
constexpr int kNode = 8;                // cells
constexpr int kMinArea = 14;            // cells
constexpr double kMinRatio = 1.7;       // of length to width
constexpr double kLongest_cells = 60;
constexpr double kMinEnd = 0.06;  // by which the brightness beyond an end differs from the ground's

// The ground laid flat: rows ahead (farther ones lower in the matrix), columns to the right. 0 where nothing is seen.
struct FlatGround {
  cv::Mat_<uchar> luma;
  double heading_rad = 0;  // of the rows, from world X to the right
};

// Where the lens shows each cell: computed for each eighth row and column, linear between. Far outside where it shows
// nothing.
cv::Mat cell_pixels(const Camera& camera, const glm::dquat& camera_from_level, cv::Size size, double cell) {
  const cv::Size nodes(size.width / kNode + 3, size.height / kNode + 3);  // one more on each side
  cv::Mat_<cv::Vec2f> coarse(nodes, cv::Vec2f(-1e5F, -1e5F));
  const auto middle = [&](int node) { return (node - 0.5) * kNode - 0.5; };
  for (int row = 0; row < nodes.height; ++row)
    for (int column = 0; column < nodes.width; ++column) {
      const glm::dvec3 spot(kNearest + middle(row) * cell, -kHalfWidth + middle(column) * cell, 1);
      if (const auto pixel = camera.lens.pixel(camera_from_level * spot))
        coarse(row, column) = {static_cast<float>(pixel->x), static_cast<float>(pixel->y)};
    }
  cv::Mat fine;
  cv::resize(coarse, fine, {}, kNode, kNode, cv::INTER_LINEAR);
  return fine(cv::Rect({kNode, kNode}, size));
}

FlatGround flat_ground(const cv::Mat& luma, const Camera& camera, const glm::dquat& world_from_camera,
                       const cv::Mat& own_body) {
  FlatGround ground;
  const glm::dvec3 axis = world_from_camera * glm::dvec3(1, 0, 0);
  ground.heading_rad = std::atan2(axis.y, axis.x);
  const double pixel_rad = 1 / std::max(camera.lens.pixels_per_radian({1, 0, 0}), 1.0);
  const double cell = std::max(kMinCell, kPixelsPerCell * pixel_rad);
  const cv::Size size(static_cast<int>(2 * kHalfWidth / cell), static_cast<int>((kFarthest - kNearest) / cell));
  if (size.width < kMiddle_cells || size.height < kMiddle_cells) return ground;
  const glm::dquat camera_from_level =
      glm::conjugate(world_from_camera) * glm::angleAxis(ground.heading_rad, glm::dvec3(0, 0, 1));
  cv::Mat visible = cv::max(luma, 1);
  if (own_body.size() == luma.size() && own_body.type() == CV_8UC1) visible.setTo(0, own_body > 127);
  cv::remap(visible, ground.luma, cell_pixels(camera, camera_from_level, size, cell), cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  return ground;
}

// Mean brightness of the 3 x 3 cells around a place, in parts of the ground's own; 1 outside.
double brightness_at(const FlatGround& ground, const cv::Mat_<uchar>& middle, double x, double y) {
  const int column = cvRound(x), row = cvRound(y);
  if (column < 1 || row < 1 || column + 1 >= middle.cols || row + 1 >= middle.rows) return 1;
  const cv::Rect window(column - 1, row - 1, 3, 3);
  return cv::mean(ground.luma(window))[0] / std::max(1.0, cv::mean(middle(window))[0]);
}

struct Shape {
  double x = 0, y = 0;   // centre, cells
  double angle_rad = 0;  // of the long axis, from the columns' direction to the rows'
  double length = 0, ratio = 0;
};

Shape shape_of(const cv::Mat& mask, const cv::Rect& box) {
  const cv::Moments m = cv::moments(mask, true);
  Shape shape{.x = box.x + m.m10 / m.m00, .y = box.y + m.m01 / m.m00};
  const double xx = m.mu20 / m.m00, yy = m.mu02 / m.m00, xy = m.mu11 / m.m00;
  const double half = 0.5 * (xx + yy), off = std::hypot(0.5 * (xx - yy), xy);
  shape.angle_rad = 0.5 * std::atan2(2 * xy, xx - yy);
  shape.length = std::sqrt(12 * (half + off));
  shape.ratio = std::sqrt((half + off) / std::max(half - off, 1.0 / 12));
  return shape;
}

// What stands at the one end and not at the other: above 0 at the beginning of the axis.
double sense_of(const FlatGround& ground, const cv::Mat_<uchar>& middle, const Shape& shape) {
  const double reach = 0.5 * shape.length + 2.5;
  const double dx = reach * std::cos(shape.angle_rad), dy = reach * std::sin(shape.angle_rad);
  const double begin = std::abs(brightness_at(ground, middle, shape.x - dx, shape.y - dy) - 1);
  const double end = std::abs(brightness_at(ground, middle, shape.x + dx, shape.y + dy) - 1);
  if (std::max(begin, end) < kMinEnd || std::max(begin, end) < 2 * std::min(begin, end)) return 0;
  return begin > end ? 1 : -1;
}

}  // namespace

glm::dvec3 to_sun_of(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          -std::sin(elevation_rad)};
}

std::string how_found(SunEvidence evidence) {
  // In the order of SunEvidence.
  static constexpr std::array kWays{"", "by time and place", "by shadows on the ground", "by the sky's brightness"};
  return kWays.at(static_cast<std::size_t>(evidence));
}

void Sun::add(const Frame& frame, const LightImage& image) {
  if (image.empty()) return;
  ++frames_;
  const std::optional<glm::dquat> level = level_of(image);
  if (!level) return;
  add_sky(image, *level);
  // Shadows hardly change from one sampled frame to the next, and laying the ground flat is most of the work.
  if (with_level_++ % kGroundEvery == 0) add_ground(frame, image, *level);
}

void Sun::add_sky(const LightImage& image, const glm::dquat& world_from_camera) {
  for (int y = 0; y < image.grid.size().height; ++y)
    for (int x = 0; x < image.grid.size().width; ++x) {
      const auto up = image.elevation_rad(x, y);
      if (!up || *up <= rad_of_deg(5)) continue;
      const auto band = static_cast<std::size_t>((deg_of_rad(*up) - 5) / 5);
      if (band >= kElevations) continue;
      const glm::dvec3 ray = world_from_camera * image.rays.at(x, y);
      const double share = std::atan2(ray.y, ray.x) / kTurn_rad;
      const auto sector = static_cast<std::size_t>((share - std::floor(share)) * kAzimuths) % kAzimuths;
      const glm::dvec3 light = color_of(image.grid.light(y, x));
      ++sky_cells_;
      if (light.r < kBlueRatio * light.b) ++blue_cells_;
      sky_[band][sector].sum += luminance(light);
      ++sky_[band][sector].count;
      sky_[band][sector].from_axis += std::acos(std::clamp(image.rays.at(x, y).x, -1.0, 1.0));
    }
}

void Sun::add_ground(const Frame& frame, const LightImage& image, const glm::dquat& world_from_camera) {
  const cv::Mat luma = luma_of(frame);
  const auto found = shadow_patches(luma, *image.view.camera, world_from_camera, image.view.own_body);
  patches_.insert(patches_.end(), found.begin(), found.end());
}

void Sun::set_by_shadows(SunEstimate& sun) const {
  std::complex<double> sum = 0;
  double weight = 0;
  for (const Patch& p : patches_) {
    sum += std::polar(p.weight, 2 * p.direction_rad);
    weight += p.weight;
  }
  const double agreement = weight > 0 ? std::abs(sum) / weight : 0;
  const auto count = static_cast<double>(patches_.size());
  if (count < kMinPatches || agreement < kMinAgreement) return;
  const double axis = 0.5 * std::arg(sum);
  double sense = 0, votes = 0;
  for (const Patch& p : patches_) {
    sense += std::cos(p.direction_rad - axis) > 0 ? p.sense : -p.sense;
    votes += std::abs(p.sense);
  }
  if (votes < 0.25 * count || std::abs(sense) < kMinSense * votes) return;
  const double away = sense > 0 ? axis : axis + std::numbers::pi;
  // Each patch's own deviation follows from the agreement (Mardia 1972, for doubled angles). The patches of a clip are
  // of the same few things, seen again.
  const double each = 0.5 * std::sqrt(-2 * std::log(std::min(agreement, 0.9999)));
  sun.azimuth_rad = {.value = between_half_turns(away + std::numbers::pi), .is_known = true};
  sun.azimuth_rad.sd = std::hypot(
      kShadowSd_rad, each / std::sqrt(std::max(1.0, count * kGroundEvery / std::max(kGroundEvery, with_level_))));
  sun.evidence = SunEvidence::shadows;
}

void Sun::set_by_sky(SunEstimate& sun) const {
  if (blue_cells_ < kMinBlueSky * sky_cells_) return;
  std::vector<SkySample> samples;
  for (std::size_t band = 0; band < kElevations; ++band)
    for (std::size_t i = 0; i < kAzimuths; ++i) {
      const SkyBin& bin = sky_[band][i];
      if (bin.count < kMinSkyCells || bin.sum <= 0) continue;
      const auto middle = [](std::size_t k, double step) { return (static_cast<double>(k) + 0.5) * step; };
      samples.push_back({.azimuth_rad = middle(i, kTurn_rad / kAzimuths),
                         .elevation_rad = rad_of_deg(5) + middle(band, rad_of_deg(5)),
                         .luminance = bin.sum / bin.count,
                         .from_axis_rad = bin.from_axis / bin.count,
                         .band = static_cast<int>(band)});
    }
  const std::optional<SkySun> found = sun_of_sky(samples);
  if (!found) return;
  sun.elevation_rad = {.value = found->elevation_rad, .sd = found->elevation_sd_rad, .is_known = true};
  if (sun.evidence == SunEvidence::shadows) return;
  sun.azimuth_rad = {.value = between_half_turns(found->azimuth_rad), .sd = found->azimuth_sd_rad, .is_known = true};
  sun.evidence = SunEvidence::sky;
}

SunEstimate Sun::finish(const std::optional<GivenSun>& given) const {
  if (given) {
    const double length = glm::length(given->to_sun_in_world);
    if (length > 0 && std::isfinite(length)) return by_time_and_place(*given);
  }
  SunEstimate sun{.azimuth_rad = {.value = kDefaultAzimuth_rad}, .elevation_rad = {.value = kDefaultElevation_rad}};
  set_by_shadows(sun);
  set_by_sky(sun);
  std::string why = "neither shadows on the ground nor the sky's brightness show it";
  if (frames_ == 0)
    why = "there is no frame";
  else if (with_level_ == 0)
    why = "the camera's calibration or the horizon is not known";
  if (!sun.azimuth_rad.is_known) sun.azimuth_rad.why = why;
  if (!sun.elevation_rad.is_known) sun.elevation_rad.why = why;
  return sun;
}

void apply(const SunEstimate& sun, LightSettings& settings) {
  if (sun.evidence == SunEvidence::given) return;
  settings.sun.azimuth_deg = deg_of_rad(sun.azimuth_rad.value);
  settings.sun.elevation_deg = deg_of_rad(sun.elevation_rad.value);
}

std::vector<Sun::Patch> shadow_patches(const cv::Mat& luma, const Camera& camera, const glm::dquat& world_from_camera,
                                       const cv::Mat& own_body) {
  std::vector<Sun::Patch> patches;
  const FlatGround ground = flat_ground(luma, camera, world_from_camera, own_body);
  if (ground.luma.empty()) return patches;
  cv::Mat_<uchar> middle;
  cv::medianBlur(ground.luma, middle, kMiddle_cells);
  cv::Mat seen, dark, labels, boxes, centres;
  cv::erode(ground.luma > 0, seen, cv::Mat::ones(5, 5, CV_8U));
  cv::Mat limit;
  middle.convertTo(limit, CV_8U, kShadowDark);
  dark = (ground.luma < limit) & seen;
  const int count = cv::connectedComponentsWithStats(dark, labels, boxes, centres, 8);
  for (int i = 1; i < count; ++i) {
    const int area = boxes.at<int>(i, cv::CC_STAT_AREA);
    const cv::Rect box(boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    if (area < kMinArea || std::max(box.width, box.height) > kLongest_cells) continue;
    const Shape shape = shape_of(labels(box) == i, box);
    if (shape.ratio < kMinRatio) continue;
    // From columns (right) and rows (ahead) to world X and the right of it.
    const double direction = ground.heading_rad + std::numbers::pi / 2 - shape.angle_rad;
    patches.push_back({direction, std::sqrt(static_cast<double>(area)), sense_of(ground, middle, shape)});
  }
  return patches;
}

}  // namespace sigs
