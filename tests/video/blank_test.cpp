// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

constexpr std::array kOutputs{std::pair{VideoCodec::ffv1, Container::mkv},  std::pair{VideoCodec::ffv1, Container::avi},
                              std::pair{VideoCodec::h264, Container::mp4},  std::pair{VideoCodec::h264, Container::mkv},
                              std::pair{VideoCodec::mjpeg, Container::avi}, std::pair{VideoCodec::png, Container::mkv}};

VideoFormat two_thread_format(VideoCodec codec, Container container, PixelLayout layout, cv::Size size_px) {
  return {.codec = codec, .container = container, .threads = 2, .size_px = size_px, .layout = layout};
}

// The file, or all images of the folder one after the other.
std::vector<uint8_t> bytes_at(const fs::path& path) {
  if (!fs::is_directory(path)) return bytes_of(path);
  std::map<fs::path, std::vector<uint8_t>> images;
  for (const auto& entry : fs::directory_iterator(path)) images[entry.path()] = bytes_of(entry.path());
  std::vector<uint8_t> all;
  for (const auto& [name, bytes] : images) all.insert(all.end(), bytes.begin(), bytes.end());
  return all;
}

VideoWriter writer_at(const fs::path& path, const VideoFormat& format) {
  if (format.codec == VideoCodec::png) fs::create_directory(path);
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  REQUIRE(writer.has_value());
  return std::move(*writer);
}

// Uneven, so that a packet with the time of another one is detected.
double time_of(int number) {
  return number / 25.0 + (number % 3) * 0.005;
}

Frame zeros(const VideoFormat& format, int number) {
  Frame frame = test_frame(format.layout, format.size_px, number, format.color);
  for (int i = 0; i < frame.plane_count(); ++i) frame.planes[static_cast<size_t>(i)].setTo(0);
  return frame;
}

}  // namespace

TEST_CASE("blank images are written as if each of them had been encoded") {
  constexpr std::array kIsBlank{true, true, false, true, false, false, true, true, true, false};
  for (const auto& output : kOutputs)
    for (const PixelLayout layout : kLayouts)
      for (const cv::Size size : {cv::Size(96, 64), cv::Size(162, 98)}) {
        const VideoCodec codec = output.first;
        const Container container = output.second;
        CAPTURE(static_cast<int>(codec));
        CAPTURE(static_cast<int>(container));
        CAPTURE(static_cast<int>(layout));
        const TemporaryFolder folder;
        const VideoFormat format = two_thread_format(codec, container, layout, size);
        VideoWriter quick = writer_at(folder / "quick", format);
        VideoWriter slow = writer_at(folder / "slow", format);
        for (int n = 0; n < static_cast<int>(kIsBlank.size()); ++n) {
          const bool is_blank = kIsBlank[static_cast<size_t>(n)];
          Frame frame = is_blank ? zeros(format, n) : test_frame(layout, size, n, format.color);
          frame.time_s = time_of(n);
          REQUIRE((is_blank ? quick.write_blank(frame.time_s, n) : quick.write(frame, n)).has_value());
          REQUIRE(slow.write(frame, n).has_value());
        }
        REQUIRE(quick.finish().has_value());
        REQUIRE(slow.finish().has_value());
        CHECK(bytes_at(folder / "quick") == bytes_at(folder / "slow"));
      }
}

TEST_CASE("a blank image whose time does not lie after the one before is refused") {
  const TemporaryFolder folder;
  VideoWriter writer =
      writer_at(folder / "a", two_thread_format(VideoCodec::ffv1, Container::mkv, PixelLayout::gray, {32, 24}));
  REQUIRE(writer.write_blank(0, 0).has_value());
  REQUIRE(writer.write_blank(0.04, 1).has_value());
  CHECK(!writer.write_blank(0.04, 2).has_value());
  CHECK(!writer.write_blank(0.01, 2).has_value());
}

TEST_CASE("a written frame keeps its samples and the caller may use them again at once") {
  for (const auto& output : kOutputs)
    for (const PixelLayout layout : kLayouts) {
      const VideoCodec codec = output.first;
      const Container container = output.second;
      CAPTURE(static_cast<int>(codec));
      CAPTURE(static_cast<int>(layout));
      const TemporaryFolder folder;
      VideoFormat format = two_thread_format(codec, container, layout, {160, 96});
      // As MJPEG stores it, so that the frame needs no conversion.
      format.color = {.range = ColorRange::full, .matrix = ColorMatrix::bt601, .chroma_site = ChromaSite::center};
      VideoWriter own = writer_at(folder / "own", format);
      VideoWriter reused = writer_at(folder / "reused", format);
      Frame again = test_frame(layout, format.size_px, 0, format.color);
      for (int n = 0; n < 12; ++n) {
        const Frame frame = test_frame(layout, format.size_px, n, format.color);
        for (size_t i = 0; i < static_cast<size_t>(frame.plane_count()); ++i) frame.planes[i].copyTo(again.planes[i]);
        again.time_s = frame.time_s;
        REQUIRE(own.write(frame, n).has_value());
        REQUIRE(reused.write(again, n).has_value());
        const bool kept = samples_of(again) == samples_of(test_frame(layout, format.size_px, n, format.color));
        CHECK(kept);
        for (cv::Mat& plane : again.planes) plane.setTo(7);
      }
      REQUIRE(own.finish().has_value());
      REQUIRE(reused.finish().has_value());
      CHECK(bytes_at(folder / "own") == bytes_at(folder / "reused"));
    }
}

TEST_CASE("a frame with gaps between its rows is written like one without") {
  for (const auto& output : kOutputs) {
    const VideoCodec codec = output.first;
    const Container container = output.second;
    CAPTURE(static_cast<int>(codec));
    const TemporaryFolder folder;
    const VideoFormat format = two_thread_format(codec, container, PixelLayout::gray, {150, 98});
    VideoWriter whole = writer_at(folder / "whole", format);
    VideoWriter part = writer_at(folder / "part", format);
    for (int n = 0; n < 3; ++n) {
      const Frame frame = test_frame(format.layout, format.size_px, n, format.color);
      Frame cut = frame;
      cv::Mat large(200, 300, CV_8UC1, cv::Scalar(91));
      cut.planes[0] = large(cv::Rect(33, 7, 150, 98));
      frame.planes[0].copyTo(cut.planes[0]);
      REQUIRE(whole.write(frame, n).has_value());
      REQUIRE(part.write(cut, n).has_value());
    }
    REQUIRE(whole.finish().has_value());
    REQUIRE(part.finish().has_value());
    CHECK(bytes_at(folder / "whole") == bytes_at(folder / "part"));
  }
}
