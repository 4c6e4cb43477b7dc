// SPDX-License-Identifier: MIT
#include "editor/geometry/patched_image.h"

#include "base/ensure.h"

namespace sigs::editor {

namespace {

struct Span {
  int begin = 0;
  int end = 0;  // the one after the last
};

// Whole blocks within the span, and what is left over at the image's end.
Span in_blocks(const Span& span, int image_end, int block) {
  const int begin = (span.begin + block - 1) / block * block;
  return {begin, span.end == image_end ? image_end : span.end / block * block};
}

Span inner(const Span& span, int image_end, int block) {
  return {span.begin == 0 ? 0 : span.begin + block, span.end == image_end ? image_end : span.end - block};
}

cv::Rect rect_of(const Span& x, const Span& y) {
  if (x.end <= x.begin || y.end <= y.begin) return {};
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

}  // namespace

cv::Vec3b PatchedImage::bgr_at(const cv::Point& pixel) const {
  ENSURE(cv::Rect({0, 0}, size()).contains(pixel));
  const bool is_patched = patch_rect().contains(pixel);
  const cv::Mat& image = is_patched ? patch : ground;
  const cv::Point at = is_patched ? pixel - patch_at : pixel;
  if (image.channels() == 3) return image.at<cv::Vec3b>(at);
  const uchar grey = image.at<uchar>(at);
  return {grey, grey, grey};
}

cv::Mat PatchedImage::whole() const {
  if (patch.empty()) return ground;
  cv::Mat image = ground.clone();
  patch.copyTo(image(patch_rect()));
  return image;
}

DrawnPatch drawn_patch(const PatchedImage& image, int divisor) {
  ENSURE(divisor >= 1);
  const cv::Rect rect = image.patch_rect();
  const Span x = in_blocks({rect.x, rect.x + rect.width}, image.size().width, divisor);
  const Span y = in_blocks({rect.y, rect.y + rect.height}, image.size().height, divisor);
  return {rect_of(x, y), rect_of(inner(x, image.size().width, divisor), inner(y, image.size().height, divisor))};
}

}  // namespace sigs::editor
