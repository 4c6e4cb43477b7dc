// SPDX-License-Identifier: MIT
#include "editor/geometry/lens_projection.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "editor/geometry/image_view.h"

namespace sigs::editor {
namespace {

constexpr double kMinDistance_m = 0.1;
constexpr double kMaxDraggedDistance_m = 1e8;
constexpr double kDoublingPx = 100;

constexpr double kTolerancePx = 0.25;  // at three places between two corners; so some half a pixel anywhere
constexpr double kMaxFarPx = 1e5;
constexpr int kMinDepth = 3;     // eight pieces between two given times, however straight they look
constexpr int kMaxDepth = 12;    // 4096 pieces, for a curve
constexpr int kBreakDepth = 24;  // to find where an image ends

using InCamera = std::function<glm::dvec3(double t)>;

struct Sample {
  double t = 0;
  std::optional<glm::dvec2> pixel;
};

// Follows a curve and halves its pieces until they are straight enough.
class Tracer {
 public:
  Tracer(const InCamera& in_camera, const Lens& lens, const glm::dvec2& image_size)
      : in_camera_(in_camera), lens_(lens), low_(-image_size), high_(2.0 * image_size) {}

  std::vector<PixelLine> traced(std::span<const double> times) {
    if (times.size() < 2) return {};
    Sample before = sample(times[0]);
    add(before);
    for (const double t : times.subspan(1)) {
      const Sample next = sample(t);
      follow(before, next, 0);
      before = next;
    }
    std::erase_if(lines_, [](const PixelLine& line) { return line.size() < 2; });
    return std::move(lines_);
  }

 private:
  Sample sample(double t) const {
    auto pixel = lens_.pixel(in_camera_(t));
    if (pixel && !(std::abs(pixel->x) < kMaxFarPx && std::abs(pixel->y) < kMaxFarPx)) pixel.reset();
    return {t, pixel};
  }

  // Whether a piece leaves a 360 degree image on one side and comes in on the other.
  bool goes_round(const Sample& a, const Sample& b) const {
    return lens_.period_px() > 0 && a.pixel && b.pixel && std::abs(a.pixel->x - b.pixel->x) > lens_.period_px() / 2;
  }

  void add(const Sample& next) {
    if (drawing_ && next.pixel && goes_round({0, lines_.back().back()}, next)) drawing_ = false;
    if (next.pixel && !drawing_) lines_.emplace_back();
    drawing_ = next.pixel.has_value();
    if (next.pixel) lines_.back().push_back(*next.pixel);
  }

  // Whether a piece comes within an image's size of the image; what is farther out need not be smooth.
  bool matters(std::initializer_list<Sample> samples) const {
    glm::dvec2 low = *samples.begin()->pixel;
    glm::dvec2 high = low;
    for (const Sample& s : samples) {
      low = glm::min(low, *s.pixel);
      high = glm::max(high, *s.pixel);
    }
    return glm::all(glm::lessThanEqual(low, high_)) && glm::all(glm::greaterThanEqual(high, low_));
  }

  bool is_done(const Sample& a, const Sample& middle, const Sample& b, int depth) const {
    if (depth < kMinDepth) return false;
    if (!a.pixel && !b.pixel && !middle.pixel) return true;
    if (!a.pixel || !b.pixel || !middle.pixel) return depth >= kBreakDepth;
    if (goes_round(a, middle) || goes_round(middle, b)) return depth >= kBreakDepth;
    if (depth >= kMaxDepth) return true;
    const Sample early = sample((a.t + middle.t) / 2);
    const Sample late = sample((middle.t + b.t) / 2);
    if (!early.pixel || !late.pixel) return false;
    if (!matters({a, early, middle, late, b})) return true;
    return std::ranges::all_of(std::initializer_list<Sample>{early, middle, late}, [&](const Sample& s) {
      return distance_to_segment(*s.pixel, *a.pixel, *b.pixel) <= kTolerancePx;
    });
  }

  void follow(const Sample& a, const Sample& b, int depth) {
    const Sample middle = sample((a.t + b.t) / 2);
    if (is_done(a, middle, b, depth)) {
      if (a.pixel && b.pixel && !middle.pixel) drawing_ = false;
      return add(b);
    }
    follow(a, middle, depth + 1);
    follow(middle, b, depth + 1);
  }

  const InCamera& in_camera_;
  const Lens& lens_;
  glm::dvec2 low_;
  glm::dvec2 high_;
  bool drawing_ = false;
  std::vector<PixelLine> lines_;
};

constexpr double kSameRay = 1e-6;  // radians between rays that are too near each other to tell a line by
constexpr double kEnds = 0.25;     // share of the line at each end

// Down in the camera's axes.
glm::dvec3 down_of(const HorizonTilt& tilt) {
  return {-std::sin(tilt.pitch_rad), std::cos(tilt.pitch_rad) * std::sin(tilt.roll_rad),
          std::cos(tilt.pitch_rad) * std::cos(tilt.roll_rad)};
}

// The pieces of a line within the image, one after the other.
std::vector<glm::dvec2> shown_points(std::span<const PixelLine> lines, const glm::dvec2& size) {
  constexpr int kStepsOfAPiece = 16;  // so that a piece that crosses the image is not lost
  std::vector<glm::dvec2> points;
  for (const PixelLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      for (int step = 0; step <= kStepsOfAPiece; ++step) {
        const glm::dvec2 p = glm::mix(line[i], line[i + 1], step / double(kStepsOfAPiece));
        if (p.x >= -0.5 && p.y >= -0.5 && p.x <= size.x - 0.5 && p.y <= size.y - 0.5) points.push_back(p);
      }
  return points;
}

}  // namespace

std::optional<glm::dvec2> pixel_of(const glm::dvec3& p_in_world, const CameraPose& world_from_camera,
                                   const Lens& lens) {
  return lens.pixel(inverse(world_from_camera) * p_in_world);
}

std::optional<glm::dvec3> point_behind(const glm::dvec2& pixel, double distance_m, const CameraPose& world_from_camera,
                                       const Lens& lens) {
  if (!(distance_m > 0) || !std::isfinite(distance_m)) return std::nullopt;
  const auto ray = lens.ray(pixel);
  if (!ray) return std::nullopt;
  return world_from_camera * (*ray * distance_m);
}

std::optional<glm::dvec3> dragged_across(const glm::dvec3& start_m, const glm::dvec2& from_px, const glm::dvec2& to_px,
                                         const CameraPose& world_from_camera, const Lens& lens) {
  const auto start_px = pixel_of(start_m, world_from_camera, lens);
  if (!start_px) return std::nullopt;
  if (from_px == to_px) return start_m;
  const double distance_m = glm::distance(start_m, world_from_camera.translation_m);
  return point_behind(*start_px + (to_px - from_px), distance_m, world_from_camera, lens);
}

glm::dvec3 dragged_along(const glm::dvec3& start_m, double up_px, const CameraPose& world_from_camera) {
  if (std::isnan(up_px) || up_px == 0) return start_m;
  const glm::dvec3 from_camera = start_m - world_from_camera.translation_m;
  const double before_m = glm::length(from_camera);
  // At the camera itself there is no ray; out of the way then means along the optical axis.
  const glm::dvec3 ray = before_m > 0 ? from_camera / before_m : world_from_camera.rotation * glm::dvec3{1, 0, 0};
  const double after_m = std::clamp(std::max(before_m, kMinDistance_m) * std::exp2(up_px / kDoublingPx), kMinDistance_m,
                                    kMaxDraggedDistance_m);
  return world_from_camera.translation_m + ray * after_m;
}

std::vector<PixelLine> path_through_lens(const std::function<glm::dvec3(double time_s)>& position_m,
                                         std::span<const double> times_s, const CameraPose& world_from_camera,
                                         const Lens& lens, const glm::dvec2& image_size) {
  const auto camera_from_world = inverse(world_from_camera);
  const InCamera in_camera = [&](double t_s) { return camera_from_world * position_m(t_s); };
  return Tracer(in_camera, lens, image_size).traced(times_s);
}

std::vector<PixelLine> horizon_through_lens(const CameraPose& world_from_camera, const Lens& lens,
                                            const glm::dvec2& image_size) {
  const glm::dvec3 ahead = world_from_camera.rotation * glm::dvec3{1, 0, 0};
  const glm::dquat camera_from_world = glm::conjugate(world_from_camera.rotation);
  // Begins behind the camera, where most lenses see nothing, so that the line is whole.
  const double behind_rad = std::atan2(ahead.y, ahead.x) - std::numbers::pi;
  const InCamera in_camera = [&](double t) {
    return camera_from_world * glm::dvec3{std::cos(behind_rad + t), std::sin(behind_rad + t), 0};
  };
  std::vector<double> turns;
  for (int i = 0; i <= 8; ++i) turns.push_back(i * std::numbers::pi / 4);
  return Tracer(in_camera, lens, image_size).traced(turns);
}

std::optional<HorizonTilt> lifted_to(const glm::dvec2& pixel, double roll_rad, const Lens& lens) {
  const std::optional<glm::dvec3> ray = lens.ray(pixel);
  if (!ray) return std::nullopt;
  const double below = ray->y * std::sin(roll_rad) + ray->z * std::cos(roll_rad);
  // Rays behind the camera lie on the same great circle as those opposite.
  const double side = ray->x < 0 ? -1 : 1;
  return HorizonTilt{roll_rad, std::atan2(side * below, side * ray->x)};
}

std::optional<HorizonTilt> through(const glm::dvec2& a_px, const glm::dvec2& b_px, const HorizonTilt& before,
                                   const Lens& lens) {
  const std::optional<glm::dvec3> a = lens.ray(a_px);
  const std::optional<glm::dvec3> b = lens.ray(b_px);
  if (!a || !b) return std::nullopt;
  glm::dvec3 down = glm::cross(*a, *b);
  const double length = glm::length(down);
  if (length < kSameRay) return std::nullopt;
  down /= glm::dot(down, down_of(before)) < 0 ? -length : length;
  return HorizonTilt{std::atan2(down.y, down.z), std::asin(std::clamp(-down.x, -1.0, 1.0))};
}

std::optional<HorizonGrip> grip_of(std::span<const PixelLine> horizon, const glm::dvec2& pixel,
                                   const glm::dvec2& image_size) {
  const std::vector<glm::dvec2> points = shown_points(horizon, image_size);
  if (points.size() < 2) return std::nullopt;
  std::vector<double> along{0};
  for (std::size_t i = 1; i < points.size(); ++i)
    along.push_back(along.back() + glm::distance(points[i - 1], points[i]));
  HorizonGrip grip{.distance_px = std::numeric_limits<double>::infinity()};
  double share = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const glm::dvec2 nearest = nearest_on_segment(pixel, points[i - 1], points[i]).at;
    const double distance_px = glm::distance(nearest, pixel);
    if (distance_px >= grip.distance_px) continue;
    grip.distance_px = distance_px;
    grip.on_line_px = nearest;
    share = (along[i - 1] + glm::distance(points[i - 1], nearest)) / std::max(along.back(), 1e-9);
  }
  const auto point_at = [&](double part) {
    const auto there = std::ranges::lower_bound(along, part * along.back()) - along.begin();
    return points[static_cast<std::size_t>(there)];
  };
  grip.middle_px = point_at(0.5);
  grip.first_px = point_at(kEnds / 2);
  grip.last_px = point_at(1 - kEnds / 2);
  grip.part = share < kEnds || share > 1 - kEnds ? HorizonPart::end : HorizonPart::middle;
  return grip;
}

}  // namespace sigs::editor
