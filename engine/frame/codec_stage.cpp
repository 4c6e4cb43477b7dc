// SPDX-License-Identifier: MIT
#include "frame/codec_stage.h"

#include <utility>

#include "frame/code_stages.h"
#include "frame/exposure_motion.h"

namespace sigs {

namespace {

cv::Rect grown(const cv::Rect& rect, int margin_px) {
  return {rect.x - margin_px, rect.y - margin_px, rect.width + 2 * margin_px, rect.height + 2 * margin_px};
}

}  // namespace

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
    reaches.push_back(grown(intruder.occluded.rect, code_stages_margin_px(scene.appearance, background.layout)) &
                      image);
    if (settings.carried_frames > 0)
      earlier_px.push_back(earlier_places(scene, frame, intruder.placed, lens, settings.carried_frames));
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
