// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// The same image through ffmpeg's own conversion to a plain planar format, as raw bytes.
Samples raw_of(const std::filesystem::path& clip, const char* format, const TemporaryFolder& folder) {
  const auto raw = folder / "image.raw";
  REQUIRE(run_ffmpeg("-i \"" + clip.string() + "\" -frames:v 1 -f rawvideo -pix_fmt " + format + " \"" + raw.string() +
                     "\""));
  return bytes_of(raw);
}

int largest_difference(const Samples& a, const Samples& b) {
  REQUIRE(a.size() == b.size());
  int largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(int{a[i]} - int{b[i]}));
  return largest;
}

// Red, green and blue of each pixel in plane 0.
Frame interleaved(const Frame& frame) {
  Frame packed;
  cv::merge(std::vector<cv::Mat>{frame.planes[0], frame.planes[1], frame.planes[2]}, packed.planes[0]);
  packed.planes[0] = packed.planes[0].reshape(1);
  return packed;
}

struct Kind {
  const char* pixel_format;
  const char* options;
  PixelLayout layout;
  const char* planar;      // the planar format to which ffmpeg converts it without loss
  const char* conversion;  // expected in info()
};

}  // namespace

TEST_CASE("every 8-bit format gives its own samples whether packed or planar") {
  const Kind kinds[] = {
      {"gray", "-c:v ffv1", PixelLayout::gray, "gray", ""},
      {"yuv420p", "-c:v ffv1", PixelLayout::yuv420, "yuv420p", ""},
      {"yuv422p", "-c:v ffv1", PixelLayout::yuv422, "yuv422p", ""},
      {"yuv444p", "-c:v ffv1", PixelLayout::yuv444, "yuv444p", ""},
      {"bgr0", "-c:v ffv1", PixelLayout::rgb, "gbrp", ""},
      {"bgra", "-c:v ffv1", PixelLayout::rgb, "gbrp", "opacity is left out"},
      {"nv12", "-c:v rawvideo", PixelLayout::yuv420, "yuv420p", ""},
      {"nv21", "-c:v rawvideo", PixelLayout::yuv420, "yuv420p", ""},
      {"yuyv422", "-c:v rawvideo", PixelLayout::yuv422, "yuv422p", ""},
      {"uyvy422", "-c:v rawvideo", PixelLayout::yuv422, "yuv422p", ""},
      {"rgb24", "-c:v rawvideo", PixelLayout::rgb, "gbrp", ""},
      {"bgr24", "-c:v rawvideo", PixelLayout::rgb, "gbrp", ""},
      {"0rgb", "-c:v rawvideo", PixelLayout::rgb, "gbrp", ""},
      {"gbrp", "-c:v rawvideo", PixelLayout::rgb, "gbrp", ""},
      {"rgb24", "-c:v png", PixelLayout::rgb, "gbrp", ""},
      {"pal8", "-c:v png", PixelLayout::rgb, "rgb24", "pal8 to RGB through its palette"},
  };
  for (const Kind& kind : kinds) {
    CAPTURE(std::string(kind.pixel_format));
    const TemporaryFolder folder;
    const auto path = folder / "a.nut";
    if (!make_clip(std::string(kind.options) + " -pix_fmt " + kind.pixel_format, path,
                   "testsrc2=size=50x38:rate=25:duration=0.2"))
      continue;
    FrameSource source = opened(path);
    CHECK(source.info().pixel_format == kind.pixel_format);
    CHECK(source.info().layout == kind.layout);
    CHECK(source.info().conversion == kind.conversion);
    Result<Frame> frame = source.read(0);
    REQUIRE(frame.has_value());
    if (std::string(kind.planar) == "gbrp")  // it keeps green first
      std::rotate(frame->planes.begin(), frame->planes.begin() + 1, frame->planes.end());
    const Samples truth = raw_of(path, kind.planar, folder);
    if (std::string(kind.planar) == "rgb24") *frame = interleaved(*frame);
    CHECK(largest_difference(samples_of(*frame), truth) == 0);
  }
}

TEST_CASE("formats without a layout of their own are converted to the nearest") {
  const Kind kinds[] = {
      {"yuv411p", "-c:v ffv1", PixelLayout::yuv422, "yuv422p", "yuv411p to yuv422p through swscale"},
      {"yuv440p", "-c:v ffv1", PixelLayout::yuv444, "yuv444p", "yuv440p to yuv444p through swscale"},
      {"rgb565le", "-c:v rawvideo", PixelLayout::rgb, "gbrp", "rgb565le to rgb24 through swscale"},
      {"monow", "-c:v rawvideo", PixelLayout::gray, "gray", "monow to gray through swscale"},
  };
  for (const Kind& kind : kinds) {
    CAPTURE(std::string(kind.pixel_format));
    const TemporaryFolder folder;
    const auto path = folder / "a.nut";
    if (!make_clip(std::string(kind.options) + " -pix_fmt " + kind.pixel_format, path,
                   "testsrc2=size=64x48:rate=25:duration=0.2,gblur=sigma=4"))
      continue;
    FrameSource source = opened(path);
    CHECK(source.info().layout == kind.layout);
    CHECK(source.info().conversion == kind.conversion);
    Result<Frame> frame = source.read(0);
    REQUIRE(frame.has_value());
    if (kind.layout == PixelLayout::rgb)
      std::rotate(frame->planes.begin(), frame->planes.begin() + 1, frame->planes.end());
    // The same library with other filters: bilinear against bicubic on a blurred image; 5-bit steps are exact.
    CHECK(largest_difference(samples_of(*frame), raw_of(path, kind.planar, folder)) <= 8);
  }
}

TEST_CASE("the colours that a file states are read and those that it leaves open are assumed") {
  struct Case {
    const char* options;
    const char* size;
    ColorRange range;
    ColorMatrix matrix;
    bool matrix_stated;
    bool range_stated;
  };
  const Case cases[] = {
      {"-c:v libx264", "64x48", ColorRange::limited, ColorMatrix::bt601, false, false},
      {"-c:v libx264", "64x720", ColorRange::limited, ColorMatrix::bt709, false, false},
      {"-c:v libx264 -colorspace bt709 -color_range tv", "64x48", ColorRange::limited, ColorMatrix::bt709, true, true},
      {"-c:v libx264 -colorspace bt470bg -color_range tv", "64x720", ColorRange::limited, ColorMatrix::bt601, true,
       true},
      {"-c:v libx264 -pix_fmt yuvj420p -colorspace bt2020nc", "64x48", ColorRange::full, ColorMatrix::bt2020, true,
       true},
      {"-c:v mjpeg -pix_fmt yuvj420p", "64x720", ColorRange::full, ColorMatrix::bt601, true, true},
  };
  for (const Case& c : cases) {
    CAPTURE(std::string(c.options));
    const TemporaryFolder folder;
    if (!make_clip(c.options, folder / "a.mkv",
                   std::string("testsrc2=rate=25:duration=0.2:size=") + c.size + ",format=yuv420p"))
      continue;
    const FrameSource source = opened(folder / "a.mkv");
    const ColorInfo& color = source.info().color;
    CHECK(color.range == c.range);
    CHECK(color.matrix == c.matrix);
    CHECK(color.matrix_stated == c.matrix_stated);
    CHECK(color.range_stated == c.range_stated);
  }
}

TEST_CASE("an image that players rotate is upright, with a warning") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264", folder / "flat.mp4")) return;
  REQUIRE(run_ffmpeg("-i \"" + (folder / "flat.mp4").string() + "\" -c copy -metadata:s:v rotate=90 \"" +
                     (folder / "rotated.mp4").string() + "\""));
  const FrameSource source = opened(folder / "rotated.mp4");
  CHECK(source.info().size_px == cv::Size(96, 128));
  REQUIRE(source.info().warnings.size() == 1);
  CHECK(source.info().warnings[0].what.find("rotate") != std::string::npos);
  CHECK(opened(folder / "flat.mp4").info().warnings.empty());
}

TEST_CASE("the luma of a frame read alone is that of the whole frame") {
  const TemporaryFolder folder;
  for (const char* options : {"-c:v libx264 -pix_fmt yuv420p", "-c:v ffv1 -pix_fmt yuv422p10le",
                              "-c:v ffv1 -pix_fmt gray", "-c:v ffv1 -pix_fmt gbrp", "-c:v rawvideo -pix_fmt yuyv422",
                              "-c:v rawvideo -pix_fmt yuv411p", "-c:v png -pix_fmt pal8"}) {
    CAPTURE(std::string(options));
    if (!make_clip(options, folder / "clip.nut")) continue;
    FrameSource source = opened(folder / "clip.nut");
    for (const int n : {0, 7, 3}) {
      const Result<Frame> frame = source.read(n);
      const Result<LumaFrame> alone = source.read_luma(n);
      REQUIRE(frame.has_value());
      REQUIRE(alone.has_value());
      CHECK(alone->number == n);
      CHECK(alone->damaged == frame->damaged);
      CHECK(cv::norm(alone->luma, luma_of(*frame), cv::NORM_INF) == 0);
    }
    std::filesystem::remove(folder / "clip.nut");
  }
}
