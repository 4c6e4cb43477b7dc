// SPDX-License-Identifier: MIT
#include "frame/look.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "compositor/blend.h"
#include "compositor/blur.h"
#include "compositor/float_patch.h"
#include "compositor/haze.h"
#include "video/color_space.h"

namespace sigs {
namespace {

// Linear light of the haze in front of what is in a box of the image. Where the footage around it is asked for, but the
// box is far beyond the image or wholly over the own body, the colour of the settings.
cv::Vec3d airlight_of(const Scene& scene, const cv::Rect& box, const Frame* background) {
  const HazeSettings& haze = scene.appearance.haze;
  const glm::dvec3& color = haze.airlight_color;
  std::optional<cv::Vec3d> behind;
  if (haze.airlight == AirlightChoice::behind && background != nullptr)
    behind = airlight_around(*background, box, scene.own_body);
  return behind.value_or(cv::Vec3d(color.x, color.y, color.z));
}

// The saturation and the black are the camera's, which the airlight has already as the footage shows it: so they come
// before haze.
//   through_haze  of a layer in tone, a visibility and an airlight
template <typename ThroughHaze>
Layer with_look(const Scene& scene, const Layer& layer, const cv::Rect& box, const Frame* background,
                ThroughHaze through_haze) {
  if (scene.compositing.method != MethodChoice::direct) return layer;
  const AppearanceSettings& look = scene.appearance;
  Layer in_tone = toned(layer, look.saturation, look.black);
  if (!look.haze.visibility_m) return in_tone;
  return through_haze(in_tone, *look.haze.visibility_m, airlight_of(scene, box, background));
}

std::int64_t samples_of(const FloatPatch& patch, int first_plane, int end_plane) {
  std::int64_t count = 0;
  for (int plane = first_plane; plane < std::min(end_plane, patch.plane_count()); ++plane)
    count += patch.planes[static_cast<std::size_t>(plane)].rect.area();
  return count;
}

// CV_32FC1, with a Gaussian's weights; 0 lies beyond it. Wide ones are computed of cells of an eighth of sigma, within
// half a percent of the highest value.
cv::Mat mean_around(const cv::Mat& image, double sigma_px) {
  constexpr double kCellsOfSigma = 8;
  const auto blurred = [](const cv::Mat& sharp, double sigma) {
    cv::Mat mean;
    const cv::Mat kernel = sampled_gaussian(sigma, blur_margin_px(sigma));
    cv::sepFilter2D(sharp, mean, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_CONSTANT);
    return mean;
  };
  const int cell_px = static_cast<int>(std::min(sigma_px, 4096.0) / kCellsOfSigma);
  if (cell_px < 2) return blurred(image, sigma_px);
  const auto up_to_cells = [&](int size_px) { return (cell_px - size_px % cell_px) % cell_px; };
  cv::Mat whole, cells, mean;
  cv::copyMakeBorder(image, whole, 0, up_to_cells(image.rows), 0, up_to_cells(image.cols), cv::BORDER_CONSTANT);
  cv::resize(whole, cells, {whole.cols / cell_px, whole.rows / cell_px}, 0, 0, cv::INTER_AREA);
  // Cells spread by (cell^2 - 1) / 12, linear interpolation by as much as a triangle of two cells, cell^2 / 6.
  const double cell2_px2 = double(cell_px) * cell_px;
  const double variance_px2 = sigma_px * sigma_px - (cell2_px2 - 1) / 12 - cell2_px2 / 6;
  cv::resize(blurred(cells, std::sqrt(variance_px2 / cell2_px2)), mean, whole.size(), 0, 0, cv::INTER_LINEAR);
  return mean(cv::Rect({0, 0}, image.size()));
}

// The stages in their order, each with the operations that it takes.
class PostBlendStages {
 public:
  PostBlendStages(FloatPatch& patch, ComposedFrame& composed, const StageDone& done)
      : patch_(patch), composed_(composed), done_(done) {}

  void sharpened(double amount, double sigma_px) {
    if (amount == 0) return;
    sharpen(patch_, amount, sigma_px);
    composed_.op_counts.samples_filtered += samples_of(patch_, 0, 1);
    tell("sharpened");
  }

  // The camera's enhancement of local contrast: what a warm thing adds to the mean around it is taken away there.
  void with_halo(double amount, double sigma_px) {
    if (amount == 0) return;
    const PatchPlane& plane = patch_.planes[0];
    const cv::Mat mean = mean_around(plane.after - plane.before, sigma_px);
    for (int i = 0; i < (patch_.layout == PixelLayout::rgb ? 3 : 1); ++i)
      add_change(patch_.planes[static_cast<std::size_t>(i)], -amount * mean);
    composed_.op_counts.samples_filtered += samples_of(patch_, 0, 1);
    tell("halo");
  }

  void with_chroma_blur(double sigma_samples) {
    if (sigma_samples == 0 || patch_.plane_count() == 1) return;
    blur_chroma(patch_, sigma_samples);
    composed_.op_counts.samples_filtered += samples_of(patch_, patch_.layout == PixelLayout::rgb ? 0 : 1, 3);
    tell("chroma_blur");
  }

  void with_grain(const GrainSettings& grain, int number, int intruder) {
    if (grain.is_none()) return;
    composed_.op_counts.samples_of_noise += add_grain(patch_, grain, number, intruder);
    tell("grain");
  }

 private:
  void tell(const char* name) {
    if (!done_) return;
    (void)write_patch(patch_, composed_.image);
    done_(name);
  }

  FloatPatch& patch_;
  ComposedFrame& composed_;
  const StageDone& done_;
};

// Whether a layer only takes light, as a shadow does.
bool is_black(const Layer& layer) {
  return std::all_of(layer.color.begin<cv::Vec4f>(), layer.color.end<cv::Vec4f>(),
                     [](const cv::Vec4f& color) { return color[0] == 0 && color[1] == 0 && color[2] == 0; });
}

// Opacities of a black layer that is mixed in light become what it takes of small differences between codes. Where it
// leaves the share t of the light L, it leaves t d(t L) / d(L) of them, d being the slope of display values over light:
// by a power of 1 / g that is t^(1 / g), more than of the light. L is that of the mean luma, or of green, below it.
void count_in_codes(FloatPatch& patch) {
  const int luma = patch.layout == PixelLayout::rgb ? 1 : 0;
  const PatchPlane& plane = patch.planes[static_cast<std::size_t>(luma)];
  const CodeToRgb codes = code_to_rgb(patch.layout, patch.color, patch.bit_depth);
  const double mean_code = cv::mean(plane.before, plane.opacity > 0)[0];
  const TransferCurve curve = transfer_curve_of(patch.color);
  const float display = codes.to_rgb(luma, luma) * (static_cast<float>(mean_code) - codes.offset[luma]);
  const float unshaded = std::max(curve.linear_of_display(display), 1e-4F);
  const auto slope = [&](float light) {
    constexpr float kStep = 0.01F;
    return (curve.display_of_linear(light * (1 + kStep)) - curve.display_of_linear(light * (1 - kStep))) / light;
  };
  const float slope_unshaded = slope(unshaded);
  for (int i = 0; i < patch.plane_count(); ++i)
    patch.planes[static_cast<std::size_t>(i)].opacity.forEach<float>([&](float& opacity, const int*) {
      const float through = 1 - opacity;
      if (opacity > 0 && through > 0)
        opacity = std::clamp(1 - through * slope(through * unshaded) / slope_unshaded, 1e-6F, 1.0F);
    });
}

double halo_of(const Scene& scene) {
  return scene.is_thermal ? scene.appearance.thermal.halo : 0;
}

}  // namespace

double light_through_haze(const Scene& scene, double distance_m) {
  const std::optional<double>& visibility_m = scene.appearance.haze.visibility_m;
  return visibility_m ? haze_transmission(distance_m, *visibility_m) : 1;
}

Layer in_footage_look(const Scene& scene, const Layer& layer, double distance_m, const cv::Rect& box,
                      const Frame* background) {
  return with_look(scene, layer, box, background,
                   [&](const Layer& in_tone, double visibility_m, const cv::Vec3d& airlight) {
                     return hazed(in_tone, haze_transmission(distance_m, visibility_m), airlight);
                   });
}

Layer in_footage_look(const Scene& scene, const Layer& layer, const cv::Mat& distance_m, const cv::Rect& box,
                      const Frame* background) {
  return with_look(scene, layer, box, background,
                   [&](const Layer& in_tone, double visibility_m, const cv::Vec3d& airlight) {
                     return hazed(in_tone, distance_m, visibility_m, airlight);
                   });
}

int post_blend_stages_margin_px(const Scene& scene, PixelLayout layout, int max_halo_px) {
  const AppearanceSettings& appearance = scene.appearance;
  return std::max({sharpening_margin_px(appearance.sharpening, appearance.sharpening_px),
                   chroma_blur_margin_px(layout, appearance.chroma_blur_px), grain_margin_px(layout, appearance.grain),
                   halo_of(scene) > 0 ? std::min(blur_margin_px(appearance.thermal.halo_px), max_halo_px) : 0});
}

bool has_post_blend_stages(const Scene& scene) {
  const AppearanceSettings& appearance = scene.appearance;
  return appearance.sharpening != 0 || appearance.chroma_blur_px > 0 || !appearance.grain.is_none() ||
         halo_of(scene) > 0;
}

Rewritten blend_with_post_blend_stages(ComposedFrame& composed, const Scene& scene, const Layer& layer,
                                       BlendChoice space, int intruder, int number, const StageDone& done) {
  const AppearanceSettings& look = scene.appearance;
  FloatPatch patch = blended_patch(composed.image, layer, space,
                                   post_blend_stages_margin_px(scene, composed.image.layout), scene.own_body);
  if (space == BlendChoice::linear && is_black(layer)) count_in_codes(patch);
  PostBlendStages stages(patch, composed, done);
  stages.with_halo(halo_of(scene), look.thermal.halo_px);
  stages.sharpened(look.sharpening, look.sharpening_px);
  stages.with_chroma_blur(look.chroma_blur_px);
  stages.with_grain(look.grain, number, intruder);
  return {patch.planes[0].rect, write_patch(patch, composed.image)};
}

}  // namespace sigs
