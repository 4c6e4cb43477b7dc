// SPDX-License-Identifier: MIT
#include "video/libav/turn.h"

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

Result<Turn> turn_of(const AVStream& stream) {
  const int32_t* matrix = display_matrix(stream);
  if (matrix == nullptr) return Turn{};
  // x' = a x + c y, y' = b x + d y
  const int64_t a = matrix[0];
  const int64_t b = matrix[1];
  const int64_t c = matrix[3];
  const int64_t d = matrix[4];
  const int64_t along = std::min(std::abs(a), std::abs(d));
  const int64_t across = std::min(std::abs(b), std::abs(c));
  constexpr int64_t kNegligible = 1000;  // files round their sines
  if (std::max(std::abs(b), std::abs(c)) <= along / kNegligible && along > 0)
    return Turn{.flip_columns = a < 0, .flip_rows = d < 0};
  if (std::max(std::abs(a), std::abs(d)) <= across / kNegligible && across > 0)
    return Turn{.transpose = true, .flip_columns = c < 0, .flip_rows = b < 0};
  const double angle_deg = -av_display_rotation_get(matrix);
  return fail("", "asks players to rotate the picture" +
                      (std::isfinite(angle_deg) ? " by " + std::to_string(std::lround(angle_deg)) + " degrees"
                                                : std::string(" in a way that makes no picture")) +
                      "; only right angles can be followed: rotate it with a video tool first");
}

Result<void> check_turn(const Turn& turn, PixelLayout layout) {
  if (turn.transpose && layout == PixelLayout::yuv422)
    return fail("", "is to be " + words_of(turn) +
                        ", but its 4:2:2 chroma on its side is no layout that can be written: convert it to 4:2:0 or "
                        "4:4:4 with a video tool first");
  return {};
}

cv::Size turned(cv::Size size, const Turn& turn) {
  return turn.transpose ? cv::Size(size.height, size.width) : size;
}

Frame turned(const Frame& frame, const Turn& turn) {
  Frame upright = frame;
  for (cv::Mat& plane : upright.planes) {
    if (plane.empty()) continue;
    cv::Mat moved;
    if (turn.transpose)
      cv::transpose(plane, moved);
    else
      moved = plane;
    if (turn.flip_columns || turn.flip_rows) {
      cv::Mat in_reverse;
      cv::flip(moved, in_reverse, turn.flip_columns && turn.flip_rows ? -1 : turn.flip_columns ? 1 : 0);
      moved = in_reverse;
    }
    plane = moved;
  }
  return upright;
}

TurnedSite turned_site(ChromaSite site, PixelLayout layout, cv::Size stored_px, const Turn& turn) {
  const cv::Size step = chroma_step(layout);
  if (step == cv::Size(1, 1) || turn == Turn{}) return {site, true};
  double column = step.width == 1 || chroma_on_luma_column(site) ? 0 : 0.5;
  double row = step.height == 1 || chroma_on_luma_row(site) ? 0 : 0.5;
  if (turn.transpose) std::swap(column, row);
  const cv::Size size = turned(stored_px, turn);
  if (step.width > 1) column = flipped(column, size.width, turn.flip_columns);
  if (step.height > 1) row = flipped(row, size.height, turn.flip_rows);
  for (const ChromaSite named : {ChromaSite::left, ChromaSite::center, ChromaSite::top_left}) {
    const bool same_row = step.height == 1 || row == (chroma_on_luma_row(named) ? 0 : 0.5);
    if (column == (chroma_on_luma_column(named) ? 0 : 0.5) && same_row) return {named, true};
  }
  return {ChromaSite::center, false};
}

std::string words_of(const Turn& turn) {
  if (turn == Turn{}) return {};
  if (!turn.transpose && turn.flip_columns && turn.flip_rows) return "rotated by 180 degrees";
  if (!turn.transpose) return turn.flip_columns ? "mirrored left to right" : "mirrored top to bottom";
  if (turn.flip_columns != turn.flip_rows)
    return std::string("rotated by 90 degrees ") + (turn.flip_columns ? "clockwise" : "counterclockwise");
  return turn.flip_columns ? "mirrored and rotated by 90 degrees: about the other diagonal"
                           : "mirrored and rotated by 90 degrees: about the diagonal";
}

}  // namespace sigs::libav
