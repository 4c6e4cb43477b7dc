// SPDX-License-Identifier: MIT
#include "frame/standing_out.h"

#include <algorithm>

#include "compositor/footage_light.h"
#include "truth/detectability.h"
#include "video/luma_stream.h"

namespace sigs {

namespace {

cv::Mat luma_of_part(const Frame& frame, const cv::Rect& rect) {
  Frame part = frame;
  part.planes[0] = frame.planes[0](rect);
  if (frame.layout == PixelLayout::rgb)
    for (std::size_t plane = 1; plane < 3; ++plane) part.planes[plane] = frame.planes[plane](rect);
  return luma_of(part);
}

// Of a grey with this luma. RGB's luma has full range, as its map has.
LuminanceOfCode luminance_of_code(const Frame& frame) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  const TransferCurve curve = transfer_curve_of(frame.color);
  LuminanceOfCode luminance{};
  for (std::size_t code = 0; code < luminance.size(); ++code)
    luminance[code] =
        std::max(curve.linear_of_display(map.to_rgb(0, 0) * (static_cast<float>(code) - map.offset[0])), 0.0F);
  return luminance;
}

}  // namespace

std::vector<FootageLuma> footage_luma_of(const Frame& footage, const std::vector<IntruderLayers>& far_to_near) {
  std::vector<FootageLuma> all;
  for (const IntruderLayers& layers : far_to_near) {
    if (layers.occluded.empty()) continue;
    const cv::Rect rect = background_rect(layers.occluded.rect, footage.size_px());
    all.push_back({layers.placed.id, rect, luma_of_part(footage, rect).clone()});
  }
  return all;
}

void add_detectability(std::vector<IntruderTruth>& intruders, const Frame& image,
                       const std::vector<FootageLuma>& footage, const Scene& scene) {
  if (footage.empty()) return;
  const LuminanceOfCode luminance = luminance_of_code(image);
  for (IntruderTruth& intruder : intruders) {
    const auto behind =
        std::find_if(footage.begin(), footage.end(), [&](const FootageLuma& patch) { return patch.id == intruder.id; });
    if (behind == footage.end() || !intruder.visible_box) continue;
    const cv::Rect rect = background_rect(*intruder.visible_box, image.size_px()) & behind->rect;
    intruder.detectability = detectability(intruder, luma_of_part(image, *intruder.visible_box),
                                           behind->luma(rect - behind->rect.tl()), rect, scene.own_body, luminance);
  }
}

}  // namespace sigs
