// SPDX-License-Identifier: MIT
#include "video/libav/sparse_ffv1.h"

extern "C" {
#include <libavutil/crc.h>
}

#include <algorithm>
#include <span>
#include <utility>

#include "video/libav/ffv1_check.h"
#include "video/libav/ffv1_slice.h"

namespace sigs::libav {
namespace {

constexpr size_t kSizeBytes = 3;

// FFmpeg lays n slices out in so many columns and rows: at least as many columns as rows, at most twice as many.
std::optional<cv::Size> grid_of(int slices) {
  for (int rows = 1; rows * rows <= slices; ++rows)
    if (slices % rows == 0 && slices / rows <= 2 * rows) return cv::Size(slices / rows, rows);
  return {};
}

cv::Rect part_of(cv::Size size_px, cv::Size grid, int slice) {
  const cv::Point at(slice % grid.width, slice / grid.width);
  const cv::Point from(size_px.width * at.x / grid.width, size_px.height * at.y / grid.height);
  const cv::Point to(size_px.width * (at.x + 1) / grid.width, size_px.height * (at.y + 1) / grid.height);
  return {from, to};
}

// Size and checksum (section 4.9, slice footer), chosen so that the whole slice with it has the remainder 0.
void add_footer(std::vector<uint8_t>& packet, size_t slice_begin) {
  const size_t bytes = packet.size() - slice_begin;
  for (const int shift : {16, 8, 0}) packet.push_back(static_cast<uint8_t>(bytes >> shift));
  packet.push_back(0);  // no error
  uint32_t sum = av_crc(av_crc_get_table(AV_CRC_32_IEEE), 0, packet.data() + slice_begin, bytes + kSizeBytes + 1);
  for (int i = 0; i < 4; ++i, sum >>= 8) packet.push_back(static_cast<uint8_t>(sum));
}

void append(std::vector<uint8_t>& packet, const std::vector<uint8_t>& bytes) {
  packet.insert(packet.end(), bytes.begin(), bytes.end());
}

// Noise of growing strength in a corner of every part: all contexts' steps, long codes, runs of all kinds.
void add_noise(cv::Mat part) {
  cv::Mat corner = part(cv::Rect(0, 0, std::min(part.cols, 96), std::min(part.rows, 48)));
  uint32_t state = 1;
  for (int y = 0; y < corner.rows; ++y)
    for (int x = 0; x < corner.cols; ++x) {
      state = state * 1664525U + 1013904223U;  // Numerical Recipes, section 7.1
      const bool is_set = (state >> 30) > 0 || y % 8 < 4;
      const uint32_t range = 2U << (x / 12);
      if (is_set) corner.at<uint8_t>(y, x) = static_cast<uint8_t>((state >> 8) % std::min(range, 256U));
    }
}

}  // namespace

std::optional<SparseFfv1> SparseFfv1::like(const Encode& encode, cv::Size size_px) {
  const cv::Mat black = cv::Mat::zeros(size_px, CV_8UC1);
  const std::vector<uint8_t> known = encode(black);
  const std::vector<std::span<const uint8_t>> slices = ffv1_slices(known);
  const std::optional<cv::Size> grid = grid_of(static_cast<int>(slices.size()));
  if (!grid || grid->width > size_px.width || grid->height > size_px.height) return {};
  SparseFfv1 sparse;
  cv::Mat noise = black.clone();
  for (int i = 0; i < grid->area(); ++i) {
    const cv::Rect part = part_of(size_px, *grid, i);
    const std::span<const uint8_t> slice = slices[static_cast<size_t>(i)];
    const size_t samples = ffv1_slice_samples(black(part)).size();
    if (slice.size() < samples) return {};
    sparse.slices_.push_back({part, {slice.begin(), slice.end() - static_cast<std::ptrdiff_t>(samples)}});
    add_noise(noise(part));
  }
  const bool agrees = sparse.packet_anyway(black) == known && sparse.packet_anyway(noise) == encode(noise);
  return agrees ? std::optional(std::move(sparse)) : std::nullopt;
}

std::optional<std::vector<uint8_t>> SparseFfv1::packet_of(const cv::Mat& picture) const {
  int left = picture.rows / 4;
  for (int y = 0; y < picture.rows; ++y)
    if (!is_zero_row(picture, y) && left-- == 0) return {};
  return packet_anyway(picture);
}

std::vector<uint8_t> SparseFfv1::packet_anyway(const cv::Mat& picture) const {
  std::vector<uint8_t> packet;
  for (const Slice& slice : slices_) {
    const size_t begin = packet.size();
    append(packet, slice.header);
    append(packet, ffv1_slice_samples(picture(slice.part)));
    add_footer(packet, begin);
  }
  return packet;
}

}  // namespace sigs::libav
