// SPDX-License-Identifier: MIT
#include "video/libav/orientation.h"

extern "C" {
#include <libavutil/display.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "video/chroma.h"

namespace sigs::libav {
namespace {

const int32_t* display_matrix(const AVStream& stream) {
  constexpr size_t kMatrixBytes = 9 * sizeof(int32_t);
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVPacketSideData* data = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data != nullptr && data->size >= kMatrixBytes ? reinterpret_cast<const int32_t*>(data->data) : nullptr;
#else
  size_t size = 0;
  const uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, &size);
  return data != nullptr && size >= kMatrixBytes ? reinterpret_cast<const int32_t*>(data) : nullptr;
#endif
}

// Where a chroma sample lies along one axis, in luma samples behind an even one: 0 or 0.5; after a flip also 1 or 1.5.
double flipped(double place, int luma_size, bool flip) {
  return flip ? std::fmod(luma_size + 1 - place, 2.0) : place;
}

}  // namespace

Result<Orientation> orientation_of(const AVStream& stream) {
  const int32_t* matrix = display_matrix(stream);
  if (matrix == nullptr) return Orientation{};
  // x' = a x + c y, y' = b x + d y
  const int64_t a = matrix[0];
  const int64_t b = matrix[1];
  const int64_t c = matrix[3];
  const int64_t d = matrix[4];
  const int64_t along = std::min(std::abs(a), std::abs(d));
  const int64_t across = std::min(std::abs(b), std::abs(c));
  constexpr int64_t kNegligible = 1000;  // files round their sines
  if (std::max(std::abs(b), std::abs(c)) <= along / kNegligible && along > 0)
    return Orientation{.flip_columns = a < 0, .flip_rows = d < 0};
  if (std::max(std::abs(a), std::abs(d)) <= across / kNegligible && across > 0)
    return Orientation{.transpose = true, .flip_columns = c < 0, .flip_rows = b < 0};
  const double angle_deg = -av_display_rotation_get(matrix);
  return fail("", "asks players to rotate the image" +
                      (std::isfinite(angle_deg) ? " by " + std::to_string(std::lround(angle_deg)) + " degrees"
                                                : std::string(" in a way that makes no image")) +
                      "; only right angles can be followed: rotate it with a video tool first");
}

Result<void> check_orientation(const Orientation& orientation, PixelLayout layout) {
  if (orientation.transpose && layout == PixelLayout::yuv422)
    return fail("", "is to be " + description_of(orientation) +
                        ", but its 4:2:2 chroma on its side is no layout that can be written: convert it to 4:2:0 or "
                        "4:4:4 with a video tool first");
  return {};
}

cv::Size oriented(cv::Size size, const Orientation& orientation) {
  return orientation.transpose ? cv::Size(size.height, size.width) : size;
}

Frame oriented(const Frame& frame, const Orientation& orientation) {
  Frame upright = frame;
  for (cv::Mat& plane : upright.planes) {
    if (plane.empty()) continue;
    cv::Mat moved;
    if (orientation.transpose)
      cv::transpose(plane, moved);
    else
      moved = plane;
    if (orientation.flip_columns || orientation.flip_rows) {
      cv::Mat in_reverse;
      cv::flip(moved, in_reverse,
               orientation.flip_columns && orientation.flip_rows ? -1
               : orientation.flip_columns                        ? 1
                                                                 : 0);
      moved = in_reverse;
    }
    plane = moved;
  }
  return upright;
}

OrientedSite oriented_site(ChromaSite site, PixelLayout layout, cv::Size stored_px, const Orientation& orientation) {
  const cv::Size step = chroma_step(layout);
  if (step == cv::Size(1, 1) || orientation == Orientation{}) return {site, true};
  double column = step.width == 1 || chroma_on_luma_column(site) ? 0 : 0.5;
  double row = step.height == 1 || chroma_on_luma_row(site) ? 0 : 0.5;
  if (orientation.transpose) std::swap(column, row);
  const cv::Size size = oriented(stored_px, orientation);
  if (step.width > 1) column = flipped(column, size.width, orientation.flip_columns);
  if (step.height > 1) row = flipped(row, size.height, orientation.flip_rows);
  for (const ChromaSite named : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left}) {
    const bool same_row = step.height == 1 || row == (chroma_on_luma_row(named) ? 0 : 0.5);
    if (column == (chroma_on_luma_column(named) ? 0 : 0.5) && same_row) return {named, true};
  }
  return {ChromaSite::center, false};
}

std::string description_of(const Orientation& orientation) {
  if (orientation == Orientation{}) return {};
  if (!orientation.transpose && orientation.flip_columns && orientation.flip_rows) return "rotated by 180 degrees";
  if (!orientation.transpose) return orientation.flip_columns ? "mirrored left to right" : "mirrored top to bottom";
  if (orientation.flip_columns != orientation.flip_rows)
    return std::string("rotated by 90 degrees ") + (orientation.flip_columns ? "clockwise" : "counterclockwise");
  return orientation.flip_columns ? "mirrored and rotated by 90 degrees: about the other diagonal"
                                  : "mirrored and rotated by 90 degrees: about the diagonal";
}

}  // namespace sigs::libav
