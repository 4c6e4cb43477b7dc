// SPDX-License-Identifier: MIT
#include "editor/geometry/shown_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "video/reduced_bgr.h"

namespace sigs::editor {

namespace {

// A chroma sample is shared by two pixels each way, and read by the next two.
constexpr int kChromaReach_px = 4;

// Pixels and the blocks that they become.
struct BlockRun {
  cv::Range pixels;
  cv::Range blocks;
};

// The whole blocks, then what is left over as one more.
std::vector<BlockRun> block_runs(int length, int divisor) {
  const int whole = length / divisor;
  std::vector<BlockRun> runs;
  if (whole > 0) runs.push_back({{0, whole * divisor}, {0, whole}});
  if (whole * divisor < length) runs.push_back({{whole * divisor, length}, {whole, whole + 1}});
  return runs;
}

// Whole blocks within the range, and what is left over at the image's end.
cv::Range in_blocks(const cv::Range& range, int image_end, int block) {
  const int start = (range.start + block - 1) / block * block;
  return {start, range.end == image_end ? image_end : range.end / block * block};
}

cv::Range inner(const cv::Range& range, int image_end, int block) {
  return {range.start == 0 ? 0 : range.start + block, range.end == image_end ? image_end : range.end - block};
}

cv::Rect rect_of(const cv::Range& x, const cv::Range& y) {
  if (x.end <= x.start || y.end <= y.start) return {};
  return {x.start, y.start, x.size(), y.size()};
}

}  // namespace

cv::Mat bgr_of_part(const Frame& frame, const cv::Rect& part) {
  const cv::Rect wide = with_chroma_reach(part, frame.size_px());
  const cv::Size step = chroma_step(frame.layout);
  Frame piece = frame;
  for (int i = 0; i < frame.plane_count(); ++i) {
    const auto plane = static_cast<std::size_t>(i);
    piece.planes[plane] = frame.planes[plane](i == 0 ? wide : in_chroma(wide, step));
  }
  return bgr_of(piece)(part - wide.tl());
}

cv::Rect with_chroma_reach(const cv::Rect& part, const cv::Size& image_px) {
  const cv::Rect grown = cv::Rect(part.x - kChromaReach_px, part.y - kChromaReach_px, part.width + 2 * kChromaReach_px,
                                  part.height + 2 * kChromaReach_px) &
                         cv::Rect({0, 0}, image_px);
  return {cv::Point(grown.x & ~1, grown.y & ~1), grown.br()};
}

cv::Rect in_chroma(const cv::Rect& pixels, const cv::Size& step) {
  const cv::Point end((pixels.br().x + step.width - 1) / step.width, (pixels.br().y + step.height - 1) / step.height);
  return {cv::Point(pixels.x / step.width, pixels.y / step.height), end};
}

cv::Size reduced_size(const cv::Size& image_px, int divisor) {
  const int by = std::max(1, divisor);
  return {(image_px.width + by - 1) / by, (image_px.height + by - 1) / by};
}

cv::Mat reduced_copy(const cv::Mat& image, int divisor) {
  if (divisor < 2) return image;
  cv::Mat reduced(reduced_size(image.size(), divisor), image.type());
  for (const auto& [from_x, to_x] : block_runs(image.cols, divisor))
    for (const auto& [from_y, to_y] : block_runs(image.rows, divisor)) {
      cv::Mat part = reduced(to_y, to_x);
      cv::resize(image(from_y, from_x), part, part.size(), 0, 0, cv::INTER_AREA);
    }
  return reduced;
}

ShownImage::ShownImage(cv::Mat pixels) : pixels_(std::move(pixels)), size_(pixels_.size()) {
  ENSURE(pixels_.empty() || pixels_.type() == CV_8UC1 || pixels_.type() == CV_8UC3 || pixels_.type() == CV_8UC4);
}

ShownImage::ShownImage(std::shared_ptr<const Frame> frame) : frame_(std::move(frame)), size_(frame_->size_px()) {}

ShownImage::ShownImage(std::shared_ptr<const Frame> frame, const cv::Rect& part)
    : frame_(std::move(frame)), at_(part.tl()), size_(part.size()) {
  ENSURE((part & cv::Rect({0, 0}, frame_->size_px())) == part);
}

std::size_t ShownImage::bytes() const {
  if (!frame_) return pixels_.total() * pixels_.elemSize();
  std::size_t sum = 0;
  for (const cv::Mat& plane : frame_->planes) sum += plane.total() * plane.elemSize();
  return sum;
}

cv::Mat ShownImage::part(const cv::Rect& part) const {
  if (part.empty()) return {};
  return frame_ ? bgr_of_part(*frame_, part + at_) : pixels_(part);
}

cv::Mat ShownImage::reduced(const cv::Rect& part, int divisor) const {
  if (divisor < 2) return this->part(part);
  return frame_ ? reduced_bgr(*frame_, part + at_, divisor) : reduced_copy(pixels_(part), divisor);
}

cv::Mat PatchedImage::part(const cv::Rect& part) const {
  const cv::Rect patched = part & patch_rect();
  if (patched.empty()) return ground.part(part);
  if (patched == part) return patch.part(part - patch_at);
  cv::Mat image = ground.part(part).clone();
  patch.part(patched - patch_at).copyTo(image(patched - part.tl()));
  return image;
}

cv::Vec3b PatchedImage::bgr_at(const cv::Point& pixel) const {
  ENSURE(cv::Rect({0, 0}, size()).contains(pixel));
  const cv::Mat image = part({pixel, cv::Size(1, 1)});
  if (image.channels() == 3) return image.at<cv::Vec3b>(0, 0);
  const uchar grey = image.at<uchar>(0, 0);
  return {grey, grey, grey};
}

DrawnPatch drawn_patch(const PatchedImage& image, int divisor) {
  ENSURE(divisor >= 1);
  const cv::Rect rect = image.patch_rect();
  const cv::Range x = in_blocks({rect.x, rect.x + rect.width}, image.size().width, divisor);
  const cv::Range y = in_blocks({rect.y, rect.y + rect.height}, image.size().height, divisor);
  return {rect_of(x, y), rect_of(inner(x, image.size().width, divisor), inner(y, image.size().height, divisor))};
}

}  // namespace sigs::editor
