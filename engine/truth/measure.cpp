// SPDX-License-Identifier: MIT
#include "truth/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "base/ensure.h"

namespace sigs {

namespace {

// The shortest interval of columns that holds all of them where columns repeat: what the largest gap between two that
// follow each other leaves. Its first column and its length.
std::pair<double, double> shortest_around(std::vector<double> columns_px, double period_px) {
  std::sort(columns_px.begin(), columns_px.end());
  double first = columns_px.front();
  double gap = columns_px.front() + period_px - columns_px.back();
  for (std::size_t i = 1; i < columns_px.size(); ++i) {
    if (!(columns_px[i] - columns_px[i - 1] > gap)) continue;
    gap = columns_px[i] - columns_px[i - 1];
    first = columns_px[i];
  }
  return {first, period_px - gap};
}

struct Bounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void take(const glm::dvec2& pixel) {
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  [[nodiscard]] std::optional<Box> box() const {
    if (low.x > high.x) return std::nullopt;
    return Box{low.x, low.y, high.x - low.x, high.y - low.y};
  }
};

template <class PixelOf>
std::optional<Silhouette> silhouette_by(std::span<const glm::vec3> points_in_body, const PixelOf& pixel_of) {
  Bounds all;
  Bounds near;
  bool all_have_image = true;
  bool is_cut = false;
  for (const glm::vec3& point : points_in_body) {
    const std::optional<glm::dvec2> pixel = pixel_of(glm::dvec3(point));
    all_have_image = all_have_image && pixel;
    if (!pixel) continue;
    all.take(*pixel);
    const bool is_far = std::max(std::abs(pixel->x), std::abs(pixel->y)) > kFarthestTold_px;
    is_cut = is_cut || is_far;
    if (!is_far) near.take(*pixel);
  }
  if (!all.box()) return std::nullopt;
  return Silhouette{.box = *all.box(), .all_have_image = all_have_image, .is_cut = is_cut, .near_box = near.box()};
}

}  // namespace

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                        const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  if (!(lens.period_px() > 0))
    return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return lens.pixel(camera_from_body * point); });
  const Lens near = lens.around(camera_from_body.translation_m);
  std::vector<double> columns_px;
  std::optional<Silhouette> silhouette = silhouette_by(points_in_body, [&](const glm::dvec3& point) {
    const std::optional<glm::dvec2> pixel = near.pixel(camera_from_body * point);
    if (pixel) columns_px.push_back(pixel->x);
    return pixel;
  });
  // Round about a pole or the camera.
  if (silhouette && silhouette->box.width > lens.period_px() / 2)
    std::tie(silhouette->box.x, silhouette->box.width) = shortest_around(std::move(columns_px), lens.period_px());
  return silhouette;
}

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body, const RowMotion& motion,
                                        const Lens& lens) {
  return silhouette_by(points_in_body, [&](const glm::dvec3& point) { return motion.pixel(lens, point); });
}

namespace {

constexpr double kRounding = 1e-6;  // of sums of floats: a visible share below it is none

// Pixels that the silhouette touches. Rendered pixels lie across their edges and spill a little into the next ones.
cv::Rect outline_of(const std::optional<Silhouette>& silhouette) {
  if (!silhouette || !silhouette->all_have_image) return kUnboundedRect;
  return pixels_touched(silhouette->box, 0, kUnboundedRect);
}

std::optional<cv::Rect> common(const std::optional<cv::Rect>& box, const cv::Rect& outline) {
  const cv::Rect both = box ? *box & outline : cv::Rect();
  return both.empty() ? std::nullopt : std::optional<cv::Rect>(both);
}

// Coverage of what is left of an intruder behind the own body and the nearer intruders, over layers.occluded.rect.
cv::Mat visible_coverage(const MeasuredLayers& layers, std::span<const MeasuredLayers> nearer, const cv::Mat& mask) {
  const cv::Rect& rect = layers.occluded.rect;
  cv::Mat visible = layers.occluded.coverage.clone();
  visible.setTo(0, mask(rect) == 0);
  for (const MeasuredLayers& other : nearer) occlude_coverage(visible, rect, other.occluded);
  return visible;
}

void measure_visible(IntruderTruth& truth, const MeasuredLayers& layers, const cv::Mat& visible, float min_coverage,
                     double inside_px) {
  const cv::Rect& rect = layers.occluded.rect;
  const float min_visible = std::max(min_coverage, kMinVisibleCoverage);
  truth.visible_box = common(covered_box(visible, rect, min_visible), outline_of(layers.silhouette));
  if (truth.visible_box) {
    truth.visible = covered_pixels(visible, rect, min_visible, *truth.visible_box);
    truth.visible_pixels = cv::countNonZero(truth.visible);
  }
  const double visible_px = area_px(visible);
  const double whole_px = std::max(layers.whole_area_px, inside_px);
  truth.visible_fraction = visible_px < kRounding * inside_px ? 0.0 : std::min(visible_px / whole_px, 1.0);
}

}  // namespace

float max_coverage(const cv::Mat& coverage) {
  if (coverage.empty()) return 0;
  double largest = 0;
  cv::minMaxIdx(coverage, nullptr, &largest);
  return static_cast<float>(largest);
}

std::optional<cv::Rect> covered_box(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage) {
  cv::Point low(rect.width, rect.height);
  cv::Point high(-1, -1);
  for (int j = 0; j < rect.height; ++j)
    for (int i = 0; i < rect.width; ++i) {
      const float covered = coverage.at<float>(j, i);
      if (covered < min_coverage || covered <= 0) continue;
      low = {std::min(low.x, i), std::min(low.y, j)};
      high = {std::max(high.x, i), std::max(high.y, j)};
    }
  if (high.x < 0) return std::nullopt;
  return cv::Rect(low + rect.tl(), high + rect.tl() + cv::Point(1, 1));
}

cv::Mat covered_pixels(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage, const cv::Rect& box) {
  const cv::Mat within = coverage(box - rect.tl());
  return (within >= min_coverage) & (within > 0);
}

HorizonSide horizon_side_of(std::span<const glm::vec3> points_in_body,
                            const Pose<frame::Camera, frame::Body>& camera_from_body, const glm::dvec3& up_in_camera) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lowest_m = kInfinity;
  double highest_m = -kInfinity;
  for (const glm::vec3& point : points_in_body) {
    const double height_m = glm::dot(up_in_camera, camera_from_body * glm::dvec3(point));
    lowest_m = std::min(lowest_m, height_m);
    highest_m = std::max(highest_m, height_m);
  }
  if (lowest_m > 0 && !points_in_body.empty()) return HorizonSide::above;
  if (highest_m < 0 && !points_in_body.empty()) return HorizonSide::below;
  return HorizonSide::on;
}

double area_px(const cv::Mat& coverage) {
  return coverage.empty() ? 0.0 : cv::sum(coverage)[0];
}

double occluded_fraction(const IntruderTruth& truth) {
  if (truth.inside_fraction <= 0) return 0;
  return std::clamp(1 - truth.visible_fraction / truth.inside_fraction, 0.0, 1.0);
}

bool is_occluded(const IntruderTruth& truth) {
  constexpr double kOccluded = 0.05;
  return occluded_fraction(truth) > kOccluded;
}

void occlude_coverage(cv::Mat& coverage, const cv::Rect& rect, const Layer& nearer) {
  const cv::Rect common = rect & nearer.rect;
  for (int y = common.y; y < common.y + common.height; ++y)
    for (int x = common.x; x < common.x + common.width; ++x)
      coverage.at<float>(y - rect.y, x - rect.x) *=
          1.0F - nearer.color.at<cv::Vec4f>(y - nearer.rect.y, x - nearer.rect.x)[3];
}

IntruderTruth measured(const MeasuredLayers& layers, std::span<const MeasuredLayers> nearer, const cv::Mat& mask,
                       const std::optional<glm::dvec3>& up_in_camera) {
  IntruderTruth truth{.id = layers.id,
                      .name = layers.name,
                      .position_m = layers.camera_from_body.translation_m,
                      .world_from_body = layers.world_from_body};
  if (layers.silhouette)
    truth.amodal_box = layers.silhouette->is_cut ? layers.silhouette->near_box : layers.silhouette->box;
  if (up_in_camera) truth.horizon = horizon_side_of(layers.outermost_m, layers.camera_from_body, *up_in_camera);
  const double inside_px = area_px(layers.inside.coverage);
  // Relative to its own maximum: a distant one may cover no pixel by more than a hundredth.
  const float min_coverage = kMinCoverageShare * layers.max_coverage;
  truth.in_image =
      common(covered_box(layers.inside.coverage, layers.inside.rect, min_coverage), outline_of(layers.silhouette))
          .has_value();
  if (!truth.in_image) return truth;
  truth.inside_fraction = std::min(inside_px / std::max(layers.whole_area_px, inside_px), 1.0);
  if (!layers.occluded.empty() && !mask.empty())
    measure_visible(truth, layers, visible_coverage(layers, nearer, mask), min_coverage, inside_px);
  return truth;
}

namespace {

constexpr float kBodyShare = 1.0F / 512.0F;  // of the own body's mask: from here on a pixel is not background

// Sums over pixels.
struct Sums {
  double count = 0;
  double code = 0;
  double code_squared = 0;
  double luminance = 0;
  double luminance_squared = 0;

  void add(uchar luma, const LuminanceOfCode& luminance_of) {
    const double light = luminance_of[luma];
    count += 1;
    code += luma;
    code_squared += static_cast<double>(luma) * luma;
    luminance += light;
    luminance_squared += light * light;
  }
};

Sums sums_of_background(const cv::Mat& background, const cv::Rect& rect, const cv::Mat& own_body,
                        const LuminanceOfCode& luminance) {
  Sums sums;
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x)
      if (own_body.empty() || own_body.at<float>(rect.y + y, rect.x + x) < kBodyShare)
        sums.add(background.at<uchar>(y, x), luminance);
  return sums;
}

Sums sums_of_intruder(const IntruderTruth& truth, const cv::Mat& image, const LuminanceOfCode& luminance) {
  Sums sums;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (truth.visible.at<uchar>(y, x) != 0) sums.add(image.at<uchar>(y, x), luminance);
  return sums;
}

}  // namespace

cv::Rect background_rect(const cv::Rect& intruder, cv::Size image_size_px) {
  const int margin_px = std::clamp((std::max(intruder.width, intruder.height) + 1) / 2, 4, 64);
  return cv::Rect(intruder.x - margin_px, intruder.y - margin_px, intruder.width + 2 * margin_px,
                  intruder.height + 2 * margin_px) &
         cv::Rect({0, 0}, image_size_px);
}

std::optional<Detectability> detectability(const IntruderTruth& truth, const cv::Mat& image, const cv::Mat& background,
                                           const cv::Rect& background_rect, const cv::Mat& own_body,
                                           const LuminanceOfCode& luminance) {
  if (!truth.visible_box || truth.visible.empty()) return std::nullopt;
  ENSURE(background.size() == background_rect.size());
  ENSURE(image.size() == truth.visible_box->size() && image.size() == truth.visible.size());
  const Sums behind = sums_of_background(background, background_rect, own_body, luminance);
  const Sums seen = sums_of_intruder(truth, image, luminance);
  if (behind.count == 0 || seen.count == 0) return std::nullopt;
  const double darkest = std::max(static_cast<double>(luminance[1]), 1e-6);
  const double light_behind = std::max(behind.luminance / behind.count, darkest);
  const double light_seen = seen.luminance / seen.count;
  const double mean_square =
      seen.luminance_squared / seen.count - 2 * light_behind * light_seen + light_behind * light_behind;
  const double code_behind = behind.code / behind.count;
  const double variance = behind.code_squared / behind.count - code_behind * code_behind;
  return Detectability{
      .weber_contrast = (light_seen - light_behind) / light_behind,
      .rms_contrast = std::sqrt(std::max(mean_square, 0.0)) / light_behind,
      .signal_to_noise = std::abs(seen.code / seen.count - code_behind) / std::sqrt(std::max(variance, 1.0 / 12))};
}

}  // namespace sigs
