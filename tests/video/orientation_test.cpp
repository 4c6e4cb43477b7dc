// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::string in_quotes(const std::filesystem::path& path) {
  return "\"" + path.string() + "\"";
}

// The same stream with a display matrix in front of it.
bool write_rotated(const std::filesystem::path& from, int degrees, const std::filesystem::path& to) {
  return run_ffmpeg("-i " + in_quotes(from) + " -c copy -metadata:s:v:0 rotate=" + std::to_string(degrees) + " " +
                    in_quotes(to));
}

}  // namespace

TEST_CASE("footage with a display matrix is upright, every sample as after FFmpeg's own rotation") {
  const TemporaryFolder folder;
  for (const char* format : {"yuv420p", "yuv444p"}) {
    CAPTURE(std::string(format));
    if (!make_clip(std::string("-c:v libx264 -g 10 -pix_fmt ") + format, folder / "flat.mp4")) return;
    for (const int degrees : {90, 180, 270}) {
      CAPTURE(degrees);
      if (!write_rotated(folder / "flat.mp4", degrees, folder / "rotated.mp4")) return;
      // FFmpeg rotates by itself while it decodes; raw planes keep the result.
      REQUIRE(run_ffmpeg("-i " + in_quotes(folder / "rotated.mp4") + " -f rawvideo " + in_quotes(folder / "raw")));
      const std::vector<uint8_t> raw = bytes_of(folder / "raw");
      FrameSource source = opened(folder / "rotated.mp4");
      const cv::Size upright = degrees == 180 ? cv::Size(128, 96) : cv::Size(96, 128);
      CHECK(source.info().size_px == upright);
      size_t place = 0;
      for (int n = 0; n < source.info().frame_count(); ++n) {
        const Result<Frame> frame = source.read(n);
        REQUIRE(frame.has_value());
        CHECK(cv::norm(source.read_luma(n).value().luma, frame->planes[0], cv::NORM_INF) == 0);
        const Samples samples = samples_of(*frame);
        REQUIRE(place + samples.size() <= raw.size());
        const bool same = std::equal(samples.begin(), samples.end(), raw.begin() + static_cast<std::ptrdiff_t>(place));
        CHECK(same);
        place += samples.size();
      }
      CHECK(place == raw.size());
    }
  }
}

TEST_CASE("the pixel's aspect is rotated with the image") {
  const TemporaryFolder folder;
  if (!make_clip("-vf setsar=4/3 -c:v libx264", folder / "flat.mp4")) return;
  REQUIRE(write_rotated(folder / "flat.mp4", 90, folder / "rotated.mp4"));
  const FrameSource source = opened(folder / "rotated.mp4");
  CHECK(source.info().pixel_aspect_num == 3);
  CHECK(source.info().pixel_aspect_den == 4);
}

TEST_CASE("a rotation by other than right angles is refused, and so is transposed 4:2:2") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264", folder / "flat.mp4")) return;
  REQUIRE(write_rotated(folder / "flat.mp4", 30, folder / "rotated.mp4"));
  const Result<FrameSource> askew = FrameSource::open(folder / "rotated.mp4");
  REQUIRE(!askew.has_value());
  CHECK(askew.error().what.find("30 degrees") != std::string::npos);
  if (!make_clip("-c:v libx264 -pix_fmt yuv422p", folder / "flat.mp4")) return;
  REQUIRE(write_rotated(folder / "flat.mp4", 90, folder / "rotated.mp4"));
  const Result<FrameSource> aside = FrameSource::open(folder / "rotated.mp4");
  REQUIRE(!aside.has_value());
  CHECK(aside.error().what.find("4:2:2") != std::string::npos);
}
