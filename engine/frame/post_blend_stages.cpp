// SPDX-License-Identifier: MIT
#include "frame/post_blend_stages.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/image.h"
#include "compositor/blend.h"
#include "compositor/float_patch.h"
#include "compositor/grain.h"
#include "frame/render_plan.h"

namespace sigs {
namespace {

// Noise of each intruder of its own: where one shows through another, both are there.
Grain grain_for(const GrainSettings& settings, int intruder) {
  const auto seed = static_cast<std::uint64_t>(settings.seed) + (static_cast<std::uint64_t>(intruder) << 32);
  return {.sd_dark = settings.sd_dark,
          .sd_bright = settings.sd_bright,
          .sd_chroma = settings.sd_chroma,
          .correlation_length_px = settings.correlation_length_px,
          .temporal_correlation = settings.temporal_correlation,
          .seed = seed};
}

std::int64_t samples_of(const FloatPatch& patch, int first_plane, int end_plane) {
  std::int64_t count = 0;
  for (int plane = first_plane; plane < std::min(end_plane, patch.plane_count()); ++plane)
    count += patch.planes[static_cast<std::size_t>(plane)].rect.area();
  return count;
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

  void with_chroma_blur(double sigma_samples) {
    if (sigma_samples == 0 || patch_.plane_count() == 1) return;
    blur_chroma(patch_, sigma_samples);
    composed_.op_counts.samples_filtered += samples_of(patch_, patch_.layout == PixelLayout::rgb ? 0 : 1, 3);
    tell("chroma_blur");
  }

  void with_grain(const Grain& grain, int number) {
    if (grain.is_none()) return;
    composed_.op_counts.samples_of_noise += add_grain(patch_, grain, number);
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

}  // namespace

int post_blend_stages_margin_px(const AppearanceSettings& appearance, PixelLayout layout) {
  return std::max(sharpening_margin_px(appearance.sharpening, appearance.sharpening_px),
                  chroma_blur_margin_px(layout, appearance.chroma_blur_px));
}

bool has_post_blend_stages(const AppearanceSettings& appearance) {
  return appearance.sharpening > 0 || appearance.chroma_blur_px > 0 || !grain_for(appearance.grain, 0).is_none();
}

Rewritten blend_with_post_blend_stages(ComposedFrame& composed, const Scene& scene, const IntruderLayers& layers,
                                       int number, const StageDone& done) {
  const AppearanceSettings& look = scene.appearance;
  const BlendSpace space = scene.compositing.blend == BlendChoice::linear ? BlendSpace::linear : BlendSpace::display;
  FloatPatch patch = blended_patch(composed.image, layers.occluded, space,
                                   post_blend_stages_margin_px(look, composed.image.layout), scene.own_body);
  PostBlendStages stages(patch, composed, done);
  stages.sharpened(look.sharpening, look.sharpening_px);
  stages.with_chroma_blur(look.chroma_blur_px);
  stages.with_grain(grain_for(look.grain, layers.placed.id), number);
  return {patch.planes[0].rect, write_patch(patch, composed.image)};
}

std::optional<CodecMatch> codec_match_for(const Frame& background, const Scene& scene, int frame, const Lens& lens,
                                          const std::vector<IntruderLayers>& layers) {
  const CodecMatchSettings& settings = scene.appearance.codec;
  if (settings.match == CodecMatchChoice::none || scene.compositing.method != MethodChoice::direct) return std::nullopt;
  if (background.bit_depth > 8) return std::nullopt;
  const cv::Rect image({0, 0}, background.size_px());
  std::vector<cv::Rect> reaches;
  std::vector<std::vector<cv::Point2d>> earlier_px;
  for (const IntruderLayers& intruder : layers) {
    if (intruder.occluded.empty()) continue;
    reaches.push_back(grown(intruder.occluded.rect, post_blend_stages_margin_px(scene.appearance, background.layout)) &
                      image);
    if (settings.predicted_frames > 0)
      earlier_px.push_back(earlier_places(scene, frame, intruder.placed, lens, settings.predicted_frames));
  }
  if (reaches.empty()) return std::nullopt;
  const MatchedCodec codec = settings.match == CodecMatchChoice::h264    ? MatchedCodec::h264
                             : settings.match == CodecMatchChoice::mjpeg ? MatchedCodec::jpeg
                                                                         : MatchedCodec::footage;
  std::optional<FrameQuantisers> quantisers =
      matched_quantisers(codec, settings.quantiser, background.quantisers.get());
  if (!quantisers) return std::nullopt;
  return CodecMatch(background, reaches, std::move(*quantisers), earlier_px);
}

}  // namespace sigs
