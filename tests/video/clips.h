// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "video/frame_source.h"
#include "video/video_writer.h"

namespace sigs::test {

inline constexpr std::array kLayouts{PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444,
                                     PixelLayout::rgb};

[[nodiscard]] ColorInfo color_info(ColorRange range, ColorMatrix matrix, ChromaSite site = ChromaSite::left);

// Whether one of the warnings contains a text.
[[nodiscard]] bool warns(const VideoInfo& info, const std::string& what);

// All samples of an image, plane after plane without gaps; of more than 8 bits two bytes each, the lower one first.
using Samples = std::vector<uint8_t>;
[[nodiscard]] Samples samples_of(const Frame& frame);

// Every image that FFmpeg's libraries give when they decode the file from the start with one thread: the truth for
// reading. Only for planar formats of 8 bits or little-endian words, whose bytes are the samples.
struct WholeDecode {
  std::vector<Samples> images;
  std::vector<double> times_s;  // of each image as FFmpeg guesses it, from the first
};
[[nodiscard]] WholeDecode whole_decode(const std::filesystem::path& path);

// Where the data of each packet of the video stream lie in the file. Only for containers that store them in one piece.
struct PacketPlace {
  size_t offset = 0;
  size_t size = 0;
};
[[nodiscard]] std::vector<PacketPlace> packets_of(const std::filesystem::path& path);

// Runs the ffmpeg program on a moving test image. False, and SKIPPED printed, where there is none or it lacks a
// codec.
//   filter   of the test image, "testsrc2=size=128x96:rate=25:duration=2" if empty
//   options  codec and muxer options; path  the output
[[nodiscard]] bool make_clip(const std::string& options, const std::filesystem::path& path,
                             const std::string& filter = {});
[[nodiscard]] bool run_ffmpeg(const std::string& arguments);

// An image with structure and noise, different for every number; the same on every machine.
// Of more than 8 bits the lower bits are noise, too.
[[nodiscard]] Frame test_frame(PixelLayout layout, cv::Size size_px, int number, const ColorInfo& color = {},
                               int bit_depth = 8);

// Writes count test frames at the format's nominal rate. The writer's errors fail the test.
void write_clip(const std::filesystem::path& path, const VideoFormat& format, int count);
[[nodiscard]] FrameSource opened(const std::filesystem::path& path);

// Compares each frame with the truth: in order, backwards and in a shuffled order.
void check_against(FrameSource& source, const WholeDecode& truth);

[[nodiscard]] std::vector<uint8_t> bytes_of(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::vector<uint8_t>& bytes);

// The numbers 0..count-1 in a fixed, mixed order.
[[nodiscard]] std::vector<int> shuffled(int count);

}  // namespace sigs::test
