// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <algorithm>
#include <cstring>
#include <iterator>

extern "C" {
#include <libavutil/crc.h>
}

#include "base/threads.h"
#include "video/chroma.h"
#include "video/libav/planes.h"
#include "video/shared_footage.h"

namespace sigs::libav {
namespace {

constexpr int kSlicesAcross = 2;
const cv::Size kSmallSize_px(64, 48);

// What follows a slice: its size in 24 bits, a byte for errors, and a checksum (RFC 9043, 4.8).
constexpr std::size_t kFooter_bytes = 8;

bool has_planes_of_bytes(const Encoding& encoding) {
  return encoding.bit_depth == 8 && encoding.layout != PixelLayout::rgb;
}

// The part of a plane in a slice. Chroma begins at the sample that contains the slice's first luma sample.
cv::Mat part_of(const cv::Mat& plane, std::size_t slice, cv::Size size_px, cv::Size step) {
  const int column = static_cast<int>(slice) % kSlicesAcross;
  const int row = static_cast<int>(slice) / kSlicesAcross;
  const cv::Point low(size_px.width * column / kSlicesAcross, size_px.height * row / kSlicesAcross);
  const cv::Point high(size_px.width * (column + 1) / kSlicesAcross, size_px.height * (row + 1) / kSlicesAcross);
  const cv::Size size((high.x - low.x + step.width - 1) / step.width, (high.y - low.y + step.height - 1) / step.height);
  return plane(cv::Rect(cv::Point(low.x / step.width, low.y / step.height), size));
}

std::vector<cv::Mat> parts_of(const Frame& frame, std::size_t slice) {
  std::vector<cv::Mat> parts;
  for (int p = 0; p < frame.plane_count(); ++p) {
    const cv::Size step = p == 0 ? cv::Size(1, 1) : chroma_step(frame.layout);
    parts.push_back(part_of(frame.planes[static_cast<std::size_t>(p)], slice, frame.size_px(), step));
  }
  return parts;
}

bool have_same_samples(const std::vector<cv::Mat>& parts, const Frame& frame, std::size_t slice) {
  const std::vector<cv::Mat> others = parts_of(frame, slice);
  return std::ranges::equal(parts, others, [](const cv::Mat& a, const cv::Mat& b) {
    if (a.size() != b.size() || a.type() != b.type()) return false;
    for (int y = 0; y < a.rows; ++y)
      if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols) * a.elemSize()) != 0) return false;
    return true;
  });
}

// Everything that samples can be: noise, edges, slopes, and areas of one value.
Frame small_image(const Encoding& encoding) {
  Frame frame = blank_frame(encoding.layout, kSmallSize_px, encoding.color, encoding.bit_depth);
  std::uint32_t noise = 1;
  for (int p = 0; p < frame.plane_count(); ++p) {
    cv::Mat& plane = frame.planes[static_cast<std::size_t>(p)];
    for (int y = 0; y < plane.rows; ++y)
      for (int x = plane.cols / 8; x < plane.cols; ++x) {
        noise = noise * 1664525U + 1013904223U;  // Numerical Recipes' generator
        const int of_area = x < plane.cols / 2 ? static_cast<int>(noise >> (y < plane.rows / 2 ? 24 : 29)) : 2 * x + y;
        plane.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(y % 16 < 4 ? 200 : of_area);
      }
  }
  return frame;
}

bool have_same_header(const AVCodecContext& a, const AVCodecContext& b) {
  return std::equal(a.extradata, a.extradata + a.extradata_size, b.extradata, b.extradata + b.extradata_size);
}

void append_footer(std::vector<std::uint8_t>& slice) {
  const std::size_t size = slice.size();
  for (const int shift : {16, 8, 0}) slice.push_back(static_cast<std::uint8_t>(size >> shift));
  slice.push_back(0);  // no error
  const std::uint32_t checksum = av_crc(av_crc_get_table(AV_CRC_32_IEEE), 0, slice.data(), slice.size());
  for (const int shift : {0, 8, 16, 24}) slice.push_back(static_cast<std::uint8_t>(checksum >> shift));
}

}  // namespace

std::optional<Ffv1Packets> Ffv1Packets::like(const AVCodecContext& encoder, const VideoFormat& format,
                                             const Encoding& encoding) {
  if (format.codec != VideoCodec::ffv1 || !has_planes_of_bytes(encoding)) return std::nullopt;
  VideoFormat small = format;
  small.size_px = kSmallSize_px;
  small.threads = 1;
  const bool headers = (encoder.flags & AV_CODEC_FLAG_GLOBAL_HEADER) != 0;
  const Result<CodecPtr> trial = open_encoder(small, encoding, encoder.time_base, headers);
  if (!trial || !have_same_header(encoder, **trial)) return std::nullopt;
  const Frame frame = small_image(encoding);
  const FramePtr image = new_image(**trial);
  image->pts = 0;
  wrap_planes(*image, frame);
  const std::vector<std::uint8_t> truth = packet_at_once(**trial, *image);
  Ffv1Packets packets;
  if (!packets.learn_headers(truth, frame) || packets.packet_of(frame, 1) != truth) return std::nullopt;
  return packets;
}

// The slices of a packet are found from its end; what is in a slice before the samples is its header.
bool Ffv1Packets::learn_headers(const std::vector<std::uint8_t>& packet, const Frame& frame) {
  std::size_t end = packet.size();
  for (std::size_t i = slices_.size(); i-- > 0;) {
    code(i, frame);
    const std::size_t samples = slices_[i].bytes.size() - kFooter_bytes;
    if (end < kFooter_bytes + samples) return false;
    const std::uint8_t* const footer = &packet[end - kFooter_bytes];
    const std::size_t size = footer[0] << 16 | footer[1] << 8 | footer[2];
    if (size < samples || size + kFooter_bytes > end) return false;
    const auto begin = packet.begin() + static_cast<std::ptrdiff_t>(end - kFooter_bytes - size);
    slices_[i].header.assign(begin, begin + static_cast<std::ptrdiff_t>(size - samples));
    end -= size + kFooter_bytes;
  }
  return end == 0;
}

void Ffv1Packets::code(std::size_t slice, const Frame& frame) {
  const std::vector<cv::Mat> parts = parts_of(frame, slice);
  std::vector<std::uint8_t>& bytes = slices_[slice].bytes;
  const auto code_samples = [&] {
    bytes = slices_[slice].header;
    append_ffv1_samples(bytes, parts);
    append_footer(bytes);
    return bytes;
  };
  if (frame.coded && have_same_samples(parts, frame.coded->image(), slice))
    bytes = frame.coded->slice(slice, slices_[slice].header, code_samples);
  else
    code_samples();
}

std::vector<std::uint8_t> Ffv1Packets::packet_of(const Frame& frame, int threads) {
  parallel_for(static_cast<int>(slices_.size()), threads,
               [&](int slice) { code(static_cast<std::size_t>(slice), frame); });
  std::vector<std::uint8_t> packet;
  for (const Slice& slice : slices_) packet.insert(packet.end(), slice.bytes.begin(), slice.bytes.end());
  return packet;
}

}  // namespace sigs::libav
