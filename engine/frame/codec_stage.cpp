// SPDX-License-Identifier: MIT
#include "frame/codec_stage.h"

#include <utility>

namespace sigs {

std::optional<CodecMatch> codec_match_for(const Frame& background, const Scene& scene,
                                          const std::vector<IntruderLayers>& layers) {
  const CodecMatchSettings& settings = scene.appearance.codec;
  if (settings.match == CodecMatchChoice::none || scene.compositing.method != MethodChoice::direct) return std::nullopt;
  std::vector<cv::Rect> reaches;
  for (const IntruderLayers& intruder : layers)
    if (!intruder.occluded.empty()) reaches.push_back(intruder.occluded.rect);
  if (reaches.empty()) return std::nullopt;
  const MatchedCodec codec = settings.match == CodecMatchChoice::h264    ? MatchedCodec::h264
                             : settings.match == CodecMatchChoice::mjpeg ? MatchedCodec::jpeg
                                                                         : MatchedCodec::footage;
  std::optional<FrameQuantisers> quantisers =
      matched_quantisers(codec, settings.quantiser, background.quantisers.get());
  if (!quantisers) return std::nullopt;
  return CodecMatch(background, reaches, std::move(*quantisers));
}

}  // namespace sigs
