// SPDX-License-Identifier: MIT
#include "editor/preview/composited_image.h"

#include <opencv2/imgproc.hpp>
#include <utility>

namespace sigs::editor {

namespace {

// A chroma sample is shared by two pixels each way, and read by the next two.
constexpr int kChromaReach_px = 4;

cv::Rect grown(const cv::Rect& rect, int by_px, cv::Size image_px) {
  return cv::Rect(rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px) &
         cv::Rect({0, 0}, image_px);
}

// As cv::boundingRect(), which takes longer to pass over what is black.
cv::Rect bounds_of(const cv::Mat& mask) {
  int first = 0;
  int end = mask.rows;
  while (first < end && cv::countNonZero(mask.row(first)) == 0) ++first;
  while (end > first && cv::countNonZero(mask.row(end - 1)) == 0) --end;
  if (first == end) return {};
  return cv::boundingRect(mask.rowRange(first, end)) + cv::Point(0, first);
}

// Begins with a chroma sample.
cv::Rect from_even(const cv::Rect& rect) {
  const cv::Point first(rect.x & ~1, rect.y & ~1);
  return {first, rect.br()};
}

// The samples of one plane that belong to these pixels.
cv::Rect in_plane(const cv::Rect& pixels, int plane, const cv::Size& step) {
  if (plane == 0) return pixels;
  const cv::Point end((pixels.br().x + step.width - 1) / step.width, (pixels.br().y + step.height - 1) / step.height);
  return {cv::Point(pixels.x / step.width, pixels.y / step.height), end};
}

void copy_part(const Frame& from, const cv::Rect& pixels, Frame& to) {
  for (int i = 0; i < from.plane_count(); ++i) {
    const auto plane = static_cast<std::size_t>(i);
    const cv::Rect part = in_plane(pixels, i, chroma_step(from.layout));
    cv::Mat target = to.planes[plane](part);
    from.planes[plane](part).copyTo(target);
  }
}

}  // namespace

cv::Mat bgr_of_part(const Frame& frame, const cv::Rect& part) {
  const cv::Rect wide = from_even(grown(part, kChromaReach_px, frame.size_px()));
  Frame piece = frame;
  for (int i = 0; i < frame.plane_count(); ++i) {
    const auto plane = static_cast<std::size_t>(i);
    piece.planes[plane] = frame.planes[plane](in_plane(wide, i, chroma_step(frame.layout)));
  }
  return bgr_of(piece)(part - wide.tl());
}

void FootageCopies::hold(const std::shared_ptr<const DecodedFrame>& footage) {
  if (footage_ == footage) return;
  bgr_ = cv::Mat();
  copy_ = {};
  footage_ = footage;
}

cv::Mat FootageCopies::bgr(const std::shared_ptr<const DecodedFrame>& footage) {
  hold(footage);
  if (bgr_.empty()) bgr_ = bgr_of(footage->frame);
  return bgr_;
}

Frame FootageCopies::to_composite(const std::shared_ptr<const DecodedFrame>& footage) {
  hold(footage);
  return copy_.planes[0].empty() ? cloned(footage->frame) : std::exchange(copy_, {});
}

PatchedImage FootageCopies::patched(const std::shared_ptr<const DecodedFrame>& footage, ComposedFrame& composed) {
  const cv::Size size_px = footage->frame.size_px();
  PatchedImage image{.ground = bgr(footage), .patch = {}, .patch_at = {}};
  if (const cv::Rect masked = bounds_of(composed.mask); !masked.empty()) {
    const cv::Rect changed = grown(masked, kChromaReach_px, size_px);
    const cv::Rect part = grown(changed, kPatchMargin_px, size_px);
    image.patch = bgr_of_part(composed.image, part);
    image.patch_at = part.tl();
    copy_part(footage->frame, changed, composed.image);
  }
  copy_ = std::move(composed.image);
  return image;
}

}  // namespace sigs::editor
