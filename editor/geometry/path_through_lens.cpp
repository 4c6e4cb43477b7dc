// SPDX-License-Identifier: MIT
#include "editor/geometry/path_through_lens.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

namespace sigs::editor {
namespace {

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

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length_2 = glm::dot(along, along);
  const double share = length_2 > 0 ? std::clamp(glm::dot(p - a, along) / length_2, 0.0, 1.0) : 0;
  return glm::distance(p, a + along * share);
}

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

  void add(const Sample& next) {
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

}  // namespace

std::vector<PixelLine> path_through_lens(const std::function<glm::dvec3(double time_s)>& position_m,
                                         std::span<const double> times_s, const CameraPose& world_from_camera,
                                         const Lens& lens, const glm::dvec2& image_size) {
  const auto camera_from_world = inverse(world_from_camera);
  const InCamera in_camera = [&](double t_s) { return camera_from_world * position_m(t_s); };
  return Tracer(in_camera, lens, image_size).traced(times_s);
}

std::vector<PixelLine> points_through_lens(std::span<const glm::dvec3> points_m, const CameraPose& world_from_camera,
                                           const Lens& lens, const glm::dvec2& image_size) {
  std::vector<double> times;
  for (std::size_t i = 0; i < points_m.size(); ++i) times.push_back(static_cast<double>(i));
  const auto position_m = [&](double t) {
    const std::size_t leg = std::min(static_cast<std::size_t>(t), points_m.size() - 2);
    return glm::mix(points_m[leg], points_m[leg + 1], t - static_cast<double>(leg));
  };
  return path_through_lens(position_m, times, world_from_camera, lens, image_size);
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

}  // namespace sigs::editor
