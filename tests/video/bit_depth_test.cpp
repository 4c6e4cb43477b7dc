// SPDX-License-Identifier: MIT
#include "video/frame.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Images of the clip through the ffmpeg program, as raw bytes of a planar format.
Samples raw_images(const std::filesystem::path& clip, const std::string& format, const TemporaryFolder& folder) {
  const auto raw = folder / "images.raw";
  REQUIRE(
      run_ffmpeg("-i \"" + clip.string() + "\" -f rawvideo -vsync 0 -pix_fmt " + format + " \"" + raw.string() + "\""));
  return bytes_of(raw);
}

std::string planar_name(PixelLayout layout, int bit_depth) {
  const char* const names[] = {"gray", "yuv420p", "yuv422p", "yuv444p", "gbrp"};
  return std::string(names[static_cast<int>(layout)]) + (bit_depth > 8 ? std::to_string(bit_depth) + "le" : "");
}

// In the order in which ffmpeg's planar format keeps them: green first.
Frame in_planar_order(Frame frame) {
  if (frame.layout == PixelLayout::rgb) std::rotate(frame.planes.begin(), frame.planes.begin() + 1, frame.planes.end());
  return frame;
}

VideoFormat deep_format(VideoCodec codec, PixelLayout layout, int bit_depth) {
  VideoFormat format;
  format.codec = codec;
  format.layout = layout;
  format.bit_depth = bit_depth;
  format.size_px = {96, 64};
  format.color.matrix_stated = format.color.range_stated = true;
  if (layout == PixelLayout::rgb) format.color.range = ColorRange::full;
  return format;
}

// What the ffmpeg program reads from the file is what was written, and so is what FrameSource reads.
void check_lossless(const VideoFormat& format) {
  CAPTURE(static_cast<int>(format.codec));
  CAPTURE(static_cast<int>(format.layout));
  CAPTURE(format.bit_depth);
  constexpr int kFrames = 4;
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", format, kFrames);
  FrameSource source = opened(folder / "a.mkv");
  CHECK(source.info().bit_depth == format.bit_depth);
  CHECK(source.info().layout == format.layout);
  CHECK(source.info().conversion.empty());
  Samples written, read;
  for (int n = 0; n < kFrames; ++n) {
    const Frame frame = test_frame(format.layout, format.size_px, n, format.color, format.bit_depth);
    const Samples samples = samples_of(in_planar_order(frame));
    written.insert(written.end(), samples.begin(), samples.end());
    const Samples back = samples_of(in_planar_order(*source.read(n)));
    read.insert(read.end(), back.begin(), back.end());
  }
  CHECK((read == written));
  CHECK((raw_images(folder / "a.mkv", planar_name(format.layout, format.bit_depth), folder) == written));
}

}  // namespace

TEST_CASE("every format of more than 8 bits gives its own samples, packed or planar, in either byte order") {
  struct Deep {
    const char* pixel_format;
    const char* codec;
    PixelLayout layout;
    int bit_depth;
  };
  const Deep kinds[] = {
      {"yuv420p10le", "ffv1 -level 3", PixelLayout::yuv420, 10},
      {"yuv422p12le", "ffv1 -level 3", PixelLayout::yuv422, 12},
      {"yuv444p16le", "ffv1 -level 3", PixelLayout::yuv444, 16},
      {"gray10le", "ffv1 -level 3", PixelLayout::gray, 10},
      {"gray12le", "ffv1 -level 3", PixelLayout::gray, 12},
      {"gray16le", "ffv1 -level 3", PixelLayout::gray, 16},
      {"yuv420p9le", "ffv1 -level 3", PixelLayout::yuv420, 9},
      {"gbrp10le", "ffv1 -level 3", PixelLayout::rgb, 10},
      {"gbrp14le", "ffv1 -level 3", PixelLayout::rgb, 14},
      {"yuv422p10be", "rawvideo", PixelLayout::yuv422, 10},
      {"rgb48be", "png", PixelLayout::rgb, 16},
      {"gray16be", "png", PixelLayout::gray, 16},
      {"yuv422p10le", "v210", PixelLayout::yuv422, 10},
      {"yuv422p10le", "prores_ks", PixelLayout::yuv422, 10},
      {"yuv420p10le", "libx265 -x265-params log-level=none", PixelLayout::yuv420, 10},
      {"yuv444p12le", "libx265 -x265-params log-level=none", PixelLayout::yuv444, 12},
  };
  for (const Deep& kind : kinds) {
    CAPTURE(std::string(kind.pixel_format));
    CAPTURE(std::string(kind.codec));
    const TemporaryFolder folder;
    const auto path = folder / "a.nut";
    if (!make_clip(std::string("-c:v ") + kind.codec + " -pix_fmt " + kind.pixel_format, path,
                   "testsrc2=size=96x64:rate=25:duration=0.12,format=yuv444p16le,gblur=sigma=3"))
      continue;
    FrameSource source = opened(path);
    CHECK(source.info().bit_depth == kind.bit_depth);
    CHECK(source.info().layout == kind.layout);
    CHECK(source.info().conversion.empty());
    Samples read;
    for (int n = 0; n < source.info().frame_count(); ++n) {
      const Frame frame = *source.read(n);
      CHECK(frame.bit_depth == kind.bit_depth);
      const Samples samples = samples_of(in_planar_order(frame));
      read.insert(read.end(), samples.begin(), samples.end());
    }
    CHECK((read == raw_images(path, planar_name(kind.layout, kind.bit_depth), folder)));
  }
}

TEST_CASE("samples are rounded to 8 bits as H.273 relates the depths") {
  for (const int depth : {9, 10, 12, 16})
    for (const ColorRange range : {ColorRange::limited, ColorRange::full})
      for (const PixelLayout layout : {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::rgb}) {
        CAPTURE(depth);
        ColorInfo color;
        color.range = range;
        const Frame deep = test_frame(layout, {64, 32}, 1, color, depth);
        const Frame eight = with_bit_depth(deep, 8);
        CHECK(eight.bit_depth == 8);
        const bool full = range == ColorRange::full || layout == PixelLayout::rgb;
        const double top = std::pow(2.0, depth) - 1;
        for (int plane = 0; plane < deep.plane_count(); ++plane) {
          const bool is_chroma = plane > 0 && layout != PixelLayout::rgb;
          const double middle = is_chroma ? std::pow(2.0, depth - 1) : 0;
          const cv::Mat& codes = deep.planes[static_cast<size_t>(plane)];
          int wrong = 0;
          for (int y = 0; y < codes.rows; ++y)
            for (int x = 0; x < codes.cols; ++x) {
              const double value = (codes.at<ushort>(y, x) - middle) * (full ? 255 / top : std::pow(2.0, 8 - depth)) +
                                   (is_chroma ? 128 : 0);
              wrong +=
                  eight.planes[static_cast<size_t>(plane)].at<uchar>(y, x) != std::min(255.0, std::floor(value + 0.5));
            }
          CHECK(wrong == 0);
        }
      }
}

TEST_CASE("a change to more bits and back keeps every 8-bit sample") {
  for (const ColorRange range : {ColorRange::limited, ColorRange::full})
    for (const PixelLayout layout : kLayouts) {
      ColorInfo color;
      color.range = range;
      const Frame eight = test_frame(layout, {64, 32}, 2, color);
      for (const int depth : {9, 10, 12, 14, 16})
        CHECK((samples_of(with_bit_depth(with_bit_depth(eight, depth), 8)) == samples_of(eight)));
    }
}

TEST_CASE("black, white and neutral have the codes that H.273 gives for the depth") {
  const ColorInfo limited;
  ColorInfo full;
  full.range = ColorRange::full;
  for (const int depth : {8, 10, 12, 16}) {
    const double step = std::pow(2.0, depth - 8);
    const auto code = [&](const ColorInfo& color, float rgb) {
      const CodeToRgb map = code_to_rgb(PixelLayout::yuv420, color, depth);
      return cv::Vec3d(map.from_rgb * cv::Vec3f(rgb, rgb, rgb) + map.offset);
    };
    CHECK(cv::norm(code(limited, 0) - cv::Vec3d(16 * step, 128 * step, 128 * step)) < 1e-2);
    CHECK(cv::norm(code(limited, 1) - cv::Vec3d(235 * step, 128 * step, 128 * step)) < 1e-2);
    CHECK(cv::norm(code(full, 1) - cv::Vec3d(256 * step - 1, 128 * step, 128 * step)) < 1e-2);
  }
}

TEST_CASE("a deep image as BGR is that of its samples, in 8 bits and in 16") {
  for (const PixelLayout layout : kLayouts)
    for (const cv::Size size : {cv::Size(64, 32), cv::Size(37, 5)}) {
      Frame frame = test_frame(layout, size, 3, {}, 12);
      for (int i = 0; i < frame.plane_count(); ++i)  // every code value, far outside the range of images
        cv::randu(frame.planes[static_cast<std::size_t>(i)], 0, 1 << 12);
      cv::Mat fine;
      bgr16_of(frame).convertTo(fine, CV_64F, 255.0 / 65535);
      cv::Mat coarse;
      bgr_of(frame).convertTo(coarse, CV_64F);
      // Both are roundings of the same value; RGB is rounded from its codes, not by way of 16 bits.
      CHECK(cv::norm(fine, coarse, cv::NORM_INF) <= 0.5 + 255.0 / 65535);
    }
}

TEST_CASE("FFV1 gives back every sample of 9 to 16 bits, to the ffmpeg program as well") {
  for (const int depth : {9, 10, 12, 14, 16})
    for (const PixelLayout layout : kLayouts)
      if (!(layout == PixelLayout::gray && depth == 14))  // FFV1 has no gray of 14 bits
        check_lossless(deep_format(VideoCodec::ffv1, layout, depth));
}

TEST_CASE("H264, HEVC and AV1 with crf 0 give back every sample of their depths") {
  struct Lossless {
    VideoCodec codec;
    std::vector<int> depths;
  };
  for (const auto& [codec, depths] : {Lossless{VideoCodec::h264, {8, 10}}, Lossless{VideoCodec::hevc, {8, 10, 12}},
                                      Lossless{VideoCodec::av1, {8, 10, 12}}})
    for (const int depth : depths)
      for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444}) {
        VideoFormat format = deep_format(codec, layout, depth);
        format.crf = 0;
        check_lossless(format);
      }
}

TEST_CASE("a depth that a codec lacks is stored with the next that it has") {
  struct Stored {
    VideoCodec codec;
    PixelLayout layout;
    int depth;
    int max_depth;
    int stored;
  };
  for (const Stored& one :
       {Stored{VideoCodec::ffv1, PixelLayout::gray, 14, 16, 16},
        Stored{VideoCodec::hevc, PixelLayout::yuv420, 9, 16, 10},
        Stored{VideoCodec::h264, PixelLayout::yuv420, 12, 16, 10},
        Stored{VideoCodec::hevc, PixelLayout::yuv422, 16, 16, 12},
        Stored{VideoCodec::mjpeg, PixelLayout::yuv420, 10, 16, 8},
        Stored{VideoCodec::h264, PixelLayout::yuv420, 10, 8, 8}, Stored{VideoCodec::ffv1, PixelLayout::rgb, 12, 8, 8},
        Stored{VideoCodec::av1, PixelLayout::gray, 10, 16, 10}}) {
    CAPTURE(static_cast<int>(one.codec));
    const TemporaryFolder folder;
    VideoFormat format = deep_format(one.codec, one.layout, one.depth);
    format.max_bit_depth = one.max_depth;
    format.crf = 1;
    write_clip(folder / "a.mkv", format, 3);
    FrameSource source = opened(folder / "a.mkv");
    CHECK(source.info().bit_depth == one.stored);
    CHECK(std::min(one.stored, max_bit_depth(one.codec)) == one.stored);
    const Frame want = with_bit_depth(test_frame(one.layout, format.size_px, 1, format.color, one.depth), 8);
    const Frame have = with_bit_depth(*source.read(1), 8);
    cv::Mat first, second;
    bgr_of(want).convertTo(first, CV_32F);
    bgr_of(have).convertTo(second, CV_32F);
    // The coders' quantisers are the finest that each has; a wrong shift would be off by a factor.
    CHECK(cv::norm(first, second, cv::NORM_L1) / (3 * static_cast<double>(first.total())) < 4);
  }
}

TEST_CASE("PNG images of deep footage have 16 bits, white at the top") {
  const TemporaryFolder folder;
  VideoFormat format = deep_format(VideoCodec::png, PixelLayout::gray, 10);
  Result<VideoWriter> writer = VideoWriter::open(folder.path(), format);
  REQUIRE(writer.has_value());
  Frame frame = test_frame(PixelLayout::gray, format.size_px, 0, format.color, 10);
  frame.planes[0].at<ushort>(0, 0) = 940;
  frame.planes[0].at<ushort>(0, 1) = 64;
  frame.planes[0].at<ushort>(0, 2) = 502;
  REQUIRE(writer->write(frame, 7).has_value());
  const cv::Mat image = cv::imread((folder / "frame_000007.png").string(), cv::IMREAD_UNCHANGED);
  REQUIRE(image.type() == CV_16UC1);
  CHECK(image.at<ushort>(0, 0) == 65535);
  CHECK(image.at<ushort>(0, 1) == 0);
  CHECK(std::abs(image.at<ushort>(0, 2) - 65535 / 2.0) <= 1);
}

TEST_CASE("clips in HEVC and AV1 are read as FFmpeg decodes them, in any order") {
  struct Clip {
    const char* options;
    const char* name;
  };
  for (const Clip& clip :
       {Clip{"-c:v libx265 -x265-params log-level=none:keyint=10:bframes=3 -pix_fmt yuv420p", "a.mp4"},
        Clip{"-c:v libx265 -x265-params log-level=none:keyint=10 -pix_fmt yuv420p10le", "a.mkv"},
        Clip{"-c:v libaom-av1 -cpu-used 8 -crf 30 -b:v 0 -g 12 -pix_fmt yuv420p", "a.mp4"},
        Clip{"-c:v libaom-av1 -cpu-used 8 -crf 30 -b:v 0 -g 12 -pix_fmt yuv420p10le", "a.mkv"}}) {
    CAPTURE(std::string(clip.options));
    const TemporaryFolder folder;
    if (!make_clip(clip.options, folder / clip.name, "testsrc2=size=128x96:rate=25:duration=1.2")) continue;
    FrameSource source = opened(folder / clip.name);
    check_against(source, whole_decode(folder / clip.name));
  }
}

TEST_CASE("the light of PQ and HLG footage of 10 bits is read and written") {
  struct Light {
    const char* options;
    int transfer;
  };
  for (const Light& light : {Light{"smpte2084", 16}, Light{"arib-std-b67", 18}}) {
    const TemporaryFolder folder;
    if (!make_clip(std::string("-c:v libx265 -x265-params log-level=none -pix_fmt yuv420p10le -color_range tv "
                               "-colorspace bt2020nc -color_primaries bt2020 -color_trc ") +
                       light.options,
                   folder / "a.mp4"))
      continue;
    FrameSource source = opened(folder / "a.mp4");
    const VideoInfo& info = source.info();
    CHECK(info.bit_depth == 10);
    CHECK(info.color.matrix == ColorMatrix::bt2020);
    CHECK(info.color.primaries == 9);
    CHECK(info.color.transfer == light.transfer);
    for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1}) {
      VideoFormat format = deep_format(codec, info.layout, info.bit_depth);
      format.size_px = info.size_px;
      format.color = info.color;
      Result<VideoWriter> writer = VideoWriter::open(folder / "b.mkv", format);
      REQUIRE(writer.has_value());
      REQUIRE(writer->write(*source.read(0), 0).has_value());
      REQUIRE(writer->finish().has_value());
      const FrameSource written = opened(folder / "b.mkv");
      CHECK(written.info().bit_depth == 10);
      CHECK(written.info().color == info.color);
    }
  }
}
