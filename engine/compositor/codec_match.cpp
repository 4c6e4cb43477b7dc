// SPDX-License-Identifier: MIT
#include "compositor/codec_match.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "compositor/recompression.h"

namespace sigs {
namespace {

FrameQuantisers uniform(QuantiserKind kind, double value) {
  if (kind != QuantiserKind::jpeg) return {.kind = kind, .mean = std::round(value)};
  const double quality = std::clamp(std::round(value), 1.0, 100.0);
  return {.kind = kind, .mean = quality, .tables = jpeg_tables(quality)};
}

QuantiserKind kind_of(CodecMatchChoice codec, const FrameQuantisers* stated) {
  if (codec == CodecMatchChoice::mjpeg) return QuantiserKind::jpeg;
  return codec == CodecMatchChoice::footage && stated != nullptr ? stated->kind : QuantiserKind::h264;
}

double default_of(QuantiserKind kind) {
  return kind == QuantiserKind::jpeg ? kDefaultJpegQuality_percent : kDefaultQp;
}

// Down to the multiple of a macroblock at or below a place, in macroblocks.
int block_at(int place_px) {
  return static_cast<int>(std::floor(static_cast<double>(place_px) / FrameQuantisers::kBlock_px));
}

cv::Size plane_step(PixelLayout layout, int plane) {
  return plane == 0 ? cv::Size(1, 1) : chroma_step(layout);
}

// Rectangles that overlap become one around both, until none do.
std::vector<cv::Rect> disjoint(std::vector<cv::Rect> rects) {
  for (std::size_t i = 0; i < rects.size();) {
    const auto other = std::find_if(rects.begin() + static_cast<std::ptrdiff_t>(i) + 1, rects.end(),
                                    [&](const cv::Rect& rect) { return !(rect & rects[i]).empty(); });
    if (other == rects.end()) {
      ++i;
      continue;
    }
    rects[i] |= *other;
    rects.erase(other);
    i = 0;  // it may have grown into one that was clear before
  }
  return rects;
}

// With where it was in the images before that are followed.
cv::Rect with_earlier(cv::Rect reach, const std::vector<cv::Point2d>& earlier_px) {
  const cv::Rect now = reach;
  for (const cv::Point2d at : earlier_px) {
    if (!can_be_followed(at)) break;
    reach |= now + cv::Point(cvFloor(at.x), cvFloor(at.y));
    reach |= now + cv::Point(cvCeil(at.x), cvCeil(at.y));
  }
  return reach;
}

// Whether all pixels of a sample's span are the own body's.
bool is_own_body(const cv::Mat& own_body, cv::Point sample, cv::Size step) {
  for (int y = sample.y * step.height; y < std::min((sample.y + 1) * step.height, own_body.rows); ++y)
    for (int x = sample.x * step.width; x < std::min((sample.x + 1) * step.width, own_body.cols); ++x)
      if (own_body.at<float>(y, x) < 1) return false;
  return true;
}

// The mask gets at least 1 at the pixels that a rewritten sample spans.
void mark(cv::Mat& mask, cv::Point sample, cv::Size step) {
  const cv::Rect span(sample.x * step.width, sample.y * step.height, step.width, step.height);
  cv::Mat pixels = mask(span & cv::Rect({0, 0}, mask.size()));
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x) pixels.at<uchar>(y, x) = std::max<uchar>(1, pixels.at<uchar>(y, x));
}

}  // namespace

std::optional<FrameQuantisers> matched_quantisers(CodecMatchChoice codec, std::optional<double> quantiser,
                                                  const FrameQuantisers* stated) {
  const QuantiserKind kind = kind_of(codec, stated);
  if (kind == QuantiserKind::none) return std::nullopt;
  const double scale = kind == QuantiserKind::mpeg ? 2 : 1;
  FrameQuantisers matched;
  if (stated != nullptr && stated->kind == kind && !quantiser)
    matched = *stated;
  else
    matched = uniform(kind, scale * quantiser.value_or(default_of(kind)));
  if (stated != nullptr) matched.origin_px = stated->origin_px;
  return matched;
}

CodecMatch::CodecMatch(const Frame& footage, std::span<const cv::Rect> reaches, FrameQuantisers quantisers,
                       std::span<const std::vector<cv::Point2d>> earlier_px)
    : quantisers_(std::move(quantisers)), layout_(footage.layout), size_px_(footage.size_px()) {
  const cv::Rect image({0, 0}, size_px_);
  std::vector<cv::Rect> blocks;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    const cv::Rect reach = (earlier_px.empty() ? reaches[i] : with_earlier(reaches[i], earlier_px[i])) & image;
    if (!(reaches[i] & image).empty()) blocks.push_back(blocks_around(reach));
  }
  for (const cv::Rect& rect : disjoint(std::move(blocks))) {
    patches_.push_back({rect, cut_out(footage, rect), {}});
    int largest = 0;
    for (std::size_t i = 0; i < earlier_px.size(); ++i) {
      const cv::Rect reach = reaches[i] & image;
      if (reach.area() <= largest || (blocks_around(reach) & rect).empty()) continue;
      largest = reach.area();
      patches_.back().earlier_px = earlier_px[i];
    }
  }
}

// With a macroblock on each side: chroma of a pixel at the edge may lie there, and the deblocking filter reaches there.
cv::Rect CodecMatch::blocks_around(const cv::Rect& reach) const {
  const cv::Point origin = quantisers_.origin_px;
  const cv::Point first(block_at(reach.x - origin.x) - 1, block_at(reach.y - origin.y) - 1);
  const cv::Point last(block_at(reach.br().x - 1 - origin.x) + 1, block_at(reach.br().y - 1 - origin.y) + 1);
  const cv::Rect whole(0, 0, block_at(size_px_.width - 1 - origin.x) + 1, block_at(size_px_.height - 1 - origin.y) + 1);
  return cv::Rect(first, last + cv::Point(1, 1)) & whole;
}

cv::Rect CodecMatch::rect_of(const cv::Rect& blocks, int plane) const {
  const cv::Size step = plane_step(layout_, plane);
  const cv::Size block(FrameQuantisers::kBlock_px / step.width, FrameQuantisers::kBlock_px / step.height);
  return {quantisers_.origin_px.x / step.width + blocks.x * block.width,
          quantisers_.origin_px.y / step.height + blocks.y * block.height, blocks.width * block.width,
          blocks.height * block.height};
}

Frame CodecMatch::cut_out(const Frame& frame, const cv::Rect& blocks) const {
  Frame patch{.layout = layout_, .color = frame.color};
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Mat& plane = frame.planes[static_cast<std::size_t>(i)];
    const cv::Rect rect = rect_of(blocks, i);
    const cv::Rect inside = rect & cv::Rect({0, 0}, plane.size());
    cv::copyMakeBorder(plane(inside), patch.planes[static_cast<std::size_t>(i)], inside.y - rect.y,
                       rect.br().y - inside.br().y, inside.x - rect.x, rect.br().x - inside.br().x,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  }
  return patch;
}

void CodecMatch::put_back(Frame& frame, cv::Mat& mask, const Patch& patch, const Frame& coded,
                          const cv::Mat& own_body) const {
  for (int i = 0; i < frame.plane_count(); ++i) {
    const auto which = static_cast<std::size_t>(i);
    const cv::Size step = plane_step(layout_, i);
    cv::Mat& plane = frame.planes[which];
    const cv::Rect rect = rect_of(patch.blocks, i);
    const cv::Rect inside = rect & cv::Rect({0, 0}, plane.size());
    for (int y = inside.y; y < inside.br().y; ++y)
      for (int x = inside.x; x < inside.br().x; ++x) {
        const uchar before = patch.footage.planes[which].at<uchar>(y - rect.y, x - rect.x);
        const bool is_body = !own_body.empty() && is_own_body(own_body, {x, y}, step);
        const uchar after = is_body ? before : coded.planes[which].at<uchar>(y - rect.y, x - rect.x);
        plane.at<uchar>(y, x) = after;
        if (after != before) mark(mask, {x, y}, step);
      }
  }
}

std::int64_t CodecMatch::apply(Frame& frame, cv::Mat& mask, const cv::Mat& own_body) const {
  if (mask.empty()) return 0;
  std::int64_t count = 0;
  for (const Patch& patch : patches_) {
    PatchCoding coding{.kind = quantisers_.kind,
                       .quantisers = cv::Mat(patch.blocks.size(), CV_16SC1),
                       .cb_offset = quantisers_.cb_offset,
                       .cr_offset = quantisers_.cr_offset,
                       .tables = quantisers_.tables};
    for (int row = 0; row < patch.blocks.height; ++row)
      for (int column = 0; column < patch.blocks.width; ++column)
        coding.quantisers.at<short>(row, column) =
            static_cast<short>(quantisers_.at(patch.blocks.x + column, patch.blocks.y + row));
    const Frame opacity{.layout = PixelLayout::gray, .planes = {mask}};
    const Frame coded = recompressed_after(cut_out(frame, patch.blocks), patch.footage, coding, patch.earlier_px,
                                           cut_out(opacity, patch.blocks).planes[0]);
    put_back(frame, mask, patch, coded, own_body);
    count += static_cast<std::int64_t>(coded.planes[0].total() * (1 + patch.earlier_px.size()));
  }
  return count;
}

}  // namespace sigs
