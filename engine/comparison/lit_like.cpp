// SPDX-License-Identifier: MIT
#include "comparison/lit_like.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "appearance/target_look.h"
#include "base/statistics.h"
#include "base/threads.h"
#include "comparison/inserted_target.h"
#include "frame/composed_frame.h"
#include "scene/opened_project.h"
#include "scene/scene_files.h"
#include "video/color_space.h"

namespace sigs {

namespace {

constexpr int kViews = 8;
constexpr int kPlaces = 3;  // that similar_place() chooses from; the views stand at them by turns
constexpr int kTries = 2;   // for each view: the one whose silhouette's area is most like the target's
constexpr int kRounds = 3;  // in the last one the exposure hardly changes
constexpr double kLowestExposure = 0.02, kHighestExposure = 50;
constexpr std::array<double, 5> kQuantiles{0.05, 0.25, 0.5, 0.75, 0.95};
constexpr double kBlackLight = 0.004;                                // linear; what is darker is the sensor's noise
constexpr double kUsualAzimuth_deg = 165, kUsualElevation_deg = 25;  // SunEstimate's

// Logarithms of linear luminance at kQuantiles, over a target's pixels.
using LogLight = std::array<double, kQuantiles.size()>;

// The silhouette's pixels that are not mixed with the background, or all where few are left.
cv::Mat inner_of(const TargetSilhouette& target) {
  cv::Mat inside_px;
  cv::distanceTransform(target.mask, inside_px, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat inner = inside_px > 1.5;
  return cv::countNonZero(inner) >= 30 ? inner : target.mask;
}

std::optional<LogLight> log_light(const Frame& any_frame, const Box& box) {
  const Frame frame = any_frame.layout == PixelLayout::rgb
                          ? frame_of_bgr(bgr_of(any_frame), PixelLayout::yuv444, {.range = ColorRange::full})
                          : any_frame;
  const std::optional<TargetSilhouette> target = target_silhouette(frame, box);
  if (!target) return std::nullopt;
  const cv::Mat inner = inner_of(*target);
  const TransferFunction function = transfer_function_of(frame.color.transfer).value_or(TransferFunction::srgb);
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  std::vector<double> lights;
  for (int y = 0; y < inner.rows; ++y)
    for (int x = 0; x < inner.cols; ++x) {
      if (inner.at<uchar>(y, x) == 0) continue;
      const int code = frame.planes[0].at<uchar>(target->patch.y + y, target->patch.x + x);
      const double display = map.to_rgb(0, 0) * (code - static_cast<double>(map.offset[0]));
      lights.push_back(std::log(linear_of_display(function, std::clamp(display, 0.0, 1.0)) + kBlackLight));
    }
  LogLight log;
  for (std::size_t q = 0; q < log.size(); ++q) log[q] = quantile(lights, kQuantiles[q]);
  return log;
}

// A point light becomes a sun; one without a direction gets the default, unless a log tells it by time and place.
void use_sun(Project& project, const FootageShape& shape) {
  LightSettings& light = project.light;
  if (light.kind != LightKind::sun) light.exposure = 1;
  light.kind = LightKind::sun;
  if (light.sun.azimuth_deg && light.sun.elevation_deg) return;
  if (!project.camera.track.file.empty() && open_scene(project, shape)) return;
  light.sun = {light.sun.azimuth_deg.value_or(kUsualAzimuth_deg),
               light.sun.elevation_deg.value_or(kUsualElevation_deg)};
}

// The logarithm of how much brighter the target is than the intruder: its median over views and quantiles, as the
// silhouette of a view may hold a piece of cloud, and its robust standard deviation.
struct Ratio {
  double median = 0, sd = 0;
};

std::optional<Ratio> ratio_over(const std::vector<LogLight>& drawn, const LogLight& real) {
  std::vector<double> off;
  for (const LogLight& one : drawn)
    for (std::size_t q = 0; q < one.size(); ++q) off.push_back(real[q] - one[q]);
  if (off.empty()) return std::nullopt;
  return Ratio{median(off), robust_standard_deviation(off)};
}

// Draws the intruder's views.
class Views {
 public:
  Views(const Project& project, const FootageShape& shape, const Stretch& stretch, const LitLikeControl& control)
      : project_(project), shape_(shape), stretch_(stretch), control_(control) {}

  Result<void> choose(const MeasuredTarget& real, const std::vector<cv::Point2d>& places_px) {
    for (int v = 0; v < kViews; ++v) {
      const cv::Point2d place_px = places_px[static_cast<std::size_t>(v) % places_px.size()];
      const InsertedView view{.seed = static_cast<std::uint32_t>(1 + v * kTries), .tries = kTries};
      Result<Insertion> insertion = Insertion::make(project_, stretch_, shape_, real, place_px, view, files_, context_);
      if (!insertion) return fail(insertion.error());
      views_.push_back(*std::move(insertion));
      if (const Result<void> goes_on = count(); !goes_on) return goes_on;
    }
    return {};
  }

  // In those views in which the intruder is told from its background.
  Result<std::vector<LogLight>> under(double exposure) {
    project_.light.exposure = exposure;
    std::vector<LogLight> all;
    for (Insertion& view : views_) {
      const Result<Insertion::Composed> one = view.composed(project_, CameraShake::none);
      if (!one) return fail(one.error());
      if (const Result<void> goes_on = count(); !goes_on) return fail(goes_on.error());
      if (one->frames.empty()) continue;
      if (const auto light = log_light(one->frames.front(), one->boxes.front())) all.push_back(*light);
    }
    return all;
  }

 private:
  Result<void> count() {
    if (const Result<void> on = check_interrupt(control_.cancel, project_.file.string()); !on) return on;
    if (control_.progress) control_.progress(++done_, (1 + kRounds) * kViews);
    return {};
  }

  Project project_;
  const FootageShape& shape_;
  const Stretch& stretch_;
  const LitLikeControl& control_;
  SceneFiles files_;
  ComposeContext context_;
  std::vector<Insertion> views_;
  int done_ = 0;
};

}  // namespace

Result<LitLike> lit_like(const Project& project, const FootageShape& shape, const Frame& frame, int frame_number,
                         const Box& box, const LitLikeControl& control) {
  const std::string where = fmt::format("{}: frame {}", project.footage.video, frame_number);
  const Stretch stretch{.middle = frame_number, .frames = {with_bit_depth(frame, 8)}, .boxes = {box}};
  const auto real = measured_target(stretch.frames, stretch.boxes);
  const auto light = log_light(stretch.frames.front(), box);
  if (!real || !light)
    return fail(where,
                "nothing in the box differs from its surroundings by enough; draw it around all of an aircraft or "
                "another thing that the sun lights",
                ErrorKind::bad_data);
  const cv::Size wanted(real->look.box.width + 8, std::max(real->look.box.height, real->look.box.width / 2) + 8);
  std::vector<cv::Point2d> places_px;
  for (std::uint32_t seed = 1; seed <= kPlaces; ++seed)
    if (const auto place_px = similar_place(stretch.frames.front(), box, wanted, seed)) places_px.push_back(*place_px);
  if (places_px.empty())
    return fail(where, "has no other place of the box's size to compare with", ErrorKind::bad_data);
  Project lit = project;
  use_sun(lit, shape);
  Views views(lit, shape, stretch, control);
  if (const Result<void> chosen = views.choose(*real, places_px); !chosen) return fail(chosen.error());
  LitLike found{.sun = lit.light.sun, .exposure = {.value = lit.light.exposure, .is_known = true}};
  for (int round = 0; round < kRounds; ++round) {
    const Result<std::vector<LogLight>> drawn = views.under(found.exposure.value);
    if (!drawn) return fail(drawn.error());
    const std::optional<Ratio> ratio = ratio_over(*drawn, *light);
    if (!ratio) return fail(where, "the intruder cannot be told from the background there", ErrorKind::bad_data);
    found.exposure.value =
        std::clamp(found.exposure.value * std::exp(ratio->median), kLowestExposure, kHighestExposure);
    found.exposure.sd = found.exposure.value * ratio->sd;
  }
  return found;
}

Result<LitLike> lit_like(const Project& project, int frame_number, const Box& box, const LitLikeControl& control) {
  Result<FrameSource> footage = open_footage(project, control.cancel, Quantisers::read);
  if (!footage) return fail(footage.error());
  const int count = footage->info().frame_count();
  if (frame_number < 0 || frame_number >= count)
    return fail(project.footage.video, fmt::format("has frames 0 to {}, not {}", count - 1, frame_number),
                ErrorKind::usage);
  const Result<Frame> frame = footage->read(frame_number);
  if (!frame) return fail(frame.error());
  return lit_like(project, shape_of(footage->info()), cloned(*frame), frame_number, box, control);
}

void apply(const LitLike& lit, Project& project) {
  project.light.kind = LightKind::sun;
  project.light.sun = lit.sun;
  project.light.exposure = std::round(lit.exposure.value * 1000) / 1000;
}

std::vector<AppearanceQuantity> quantities_of(const LitLike& lit) {
  return {{"exposure", "", lit.exposure, "light.exposure"}};
}

std::vector<std::string> applied_settings(const LitLike&) {
  return {"light.kind", "light.sun.azimuth_deg", "light.sun.elevation_deg", "light.exposure"};
}

}  // namespace sigs
