// SPDX-License-Identifier: MIT
// FFV1's packets of 8-bit planes, which are made here, against those of FFmpeg's own encoder in the ffmpeg program.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"
#include "video/libav/encoding.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

constexpr int kCodedImages = 9;

// Black, masks that touch borders and middles, where slices meet, and images of all kinds of steps between neighbours.
Frame image_of_kind(PixelLayout layout, cv::Size size_px, int kind) {
  Frame frame = test_frame(layout, size_px, kind);
  cv::RNG random(7);
  for (int p = 0; p < frame.plane_count(); ++p) {
    cv::Mat& plane = frame.planes[static_cast<size_t>(p)];
    const cv::Rect whole({0, 0}, plane.size());
    const std::array boxes{cv::Rect(0, 0, 3, 2), cv::Rect(plane.cols / 2 - 5, plane.rows / 2 - 3, 11, 7),
                           cv::Rect(plane.cols - 4, plane.rows - 4, 4, 4), cv::Rect(0, plane.rows / 3, plane.cols, 1)};
    if (kind <= 4) plane.setTo(0);
    if (kind >= 1 && kind <= 4)
      random.fill(plane(boxes[static_cast<size_t>(kind) - 1] & whole), cv::RNG::UNIFORM, 0, 256);
    if (kind == 5) random.fill(plane, cv::RNG::UNIFORM, 0, 256);
    if (kind == 6) random.fill(plane, cv::RNG::NORMAL, 128, 3);
    if (kind == 7)
      plane.forEach<uchar>(
          [](uchar& sample, const int* at) { sample = static_cast<uchar>((at[0] / 3 + at[1]) % 2 * 255); });
  }
  frame.time_s = kind / 25.0;
  return frame;
}

std::string pixel_format_name(PixelLayout layout) {
  return layout == PixelLayout::gray     ? "gray"
         : layout == PixelLayout::yuv420 ? "yuv420p"
         : layout == PixelLayout::yuv422 ? "yuv422p"
                                         : "yuv444p";
}

std::vector<std::vector<uint8_t>> packet_bytes(const fs::path& file) {
  const std::vector<uint8_t> bytes = bytes_of(file);
  std::vector<std::vector<uint8_t>> packets;
  for (const PacketPlace& place : packets_of(file)) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(place.offset);
    packets.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(place.size));
  }
  return packets;
}

}  // namespace

TEST_CASE("FFV1's packets have the bytes of FFmpeg's encoder, and its decoder gives every sample back") {
  for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444})
    for (const cv::Size size : {cv::Size(160, 120), cv::Size(324, 244), cv::Size(162, 98), cv::Size(97, 51)}) {
      CAPTURE(pixel_format_name(layout));
      CAPTURE(size);
      const TemporaryFolder folder;
      const VideoFormat format{.codec = VideoCodec::ffv1, .threads = 2, .size_px = size, .layout = layout};
      Result<VideoWriter> writer = VideoWriter::open(folder / "ours.mkv", format);
      REQUIRE(writer.has_value());
      std::vector<Samples> images;
      std::ofstream raw(folder / "images.raw", std::ios::binary);
      for (int kind = 0; kind < kCodedImages; ++kind) {
        const Frame frame = image_of_kind(layout, size, kind);
        images.push_back(samples_of(frame));
        raw.write(reinterpret_cast<const char*>(images.back().data()),
                  static_cast<std::streamsize>(images.back().size()));
        REQUIRE(writer->write(frame, kind).has_value());
      }
      raw.close();
      REQUIRE(writer->finish().has_value());
      if (!run_ffmpeg(
              fmt::format("-f rawvideo -pix_fmt {} -s {}x{} -i \"{}\" -c:v ffv1 -level 3 -g 1 -slicecrc 1 \"{}\"",
                          pixel_format_name(layout), size.width, size.height, (folder / "images.raw").string(),
                          (folder / "truth.mkv").string())))
        return;
      CHECK(packet_bytes(folder / "ours.mkv") == packet_bytes(folder / "truth.mkv"));
      CHECK(whole_decode(folder / "ours.mkv").images == images);
    }
}

TEST_CASE("a black slice takes a bit for each run of doubling length") {
  // RFC 9043, 3.8.2.2.1: steps of 1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 8 ... samples, a bit each, and one for the rest
  // of a row. 24 samples are 4 * 1 + 4 * 2 + 3 * 4, in 11 bits; the next 24 go on with 4 + 8 + 8 and a rest, in 4 bits.
  std::vector<std::uint8_t> bytes{7};
  const cv::Mat black = cv::Mat::zeros(2, 24, CV_8UC1);
  libav::append_ffv1_samples(bytes, std::span(&black, 1));
  CHECK(bytes == std::vector<std::uint8_t>{7, 0xFF, 0xFE});
}
