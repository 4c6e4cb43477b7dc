// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Backwards over the last two seconds, then jumps over the whole clip.
void check_jumps(FrameSource& source, const WholeDecode& truth) {
  const int count = source.info().frame_count();
  std::vector<int> order;
  for (int n = count - 1; n >= count - 60; --n) order.push_back(n);
  for (int i = 0; i < 40; ++i) order.push_back(i * 149 % count);
  for (const int n : order) {
    CAPTURE(n);
    const Result<Frame> frame = source.read(n);
    REQUIRE(frame.has_value());
    const bool same = samples_of(*frame) == truth.images[static_cast<size_t>(n)];
    CHECK(same);
  }
}

}  // namespace

TEST_CASE("the GoPro flight gives all its frames in order and at random") {
  if (!has_real_data()) return;
  const auto path = real_data() / "video" / "air_karma_gopro_coast.mp4";
  const WholeDecode truth = whole_decode(path);
  REQUIRE(truth.images.size() == 362);
  FrameSource source = opened(path);
  const VideoInfo& info = source.info();
  REQUIRE(info.frame_count() == 362);
  CHECK(info.size_px == cv::Size(854, 480));
  CHECK(info.layout == PixelLayout::yuv420);
  CHECK(info.color.range == ColorRange::full);
  CHECK(info.color.range_stated);
  CHECK(info.color.matrix == ColorMatrix::bt709);
  CHECK(info.color.matrix_stated);
  CHECK(info.frame_rate_num == 30000);
  CHECK(info.frame_rate_den == 1001);
  CHECK(!info.variable_frame_rate);
  CHECK(info.conversion.empty());
  CHECK(info.warnings.empty());
  for (int n = 0; n < 362; ++n) {
    CAPTURE(n);
    const Result<Frame> frame = source.read(n);
    REQUIRE(frame.has_value());
    CHECK(!frame->damaged);
    const bool same = samples_of(*frame) == truth.images[static_cast<size_t>(n)];
    CHECK(same);
  }
  check_jumps(source, truth);
}

TEST_CASE("a header that states more frames than there are gives a warning") {
  if (!has_real_data()) return;
  const auto path = real_data() / "video" / "opencv_tree.avi";
  FrameSource source = opened(path);
  CHECK(source.info().frame_count() == 68);
  CHECK(source.info().declared_frames == 444);
  CHECK(warns(source.info(), "header declares 444 frames, 68 are there"));
  CHECK(source.info().codec == "cinepak");
  CHECK(whole_decode(path).images.size() == 68);
  for (const int n : {67, 0, 30, 29}) CHECK(source.read(n).has_value());
}

TEST_CASE("every real clip can be read to its last frame and back") {
  if (!has_real_data()) return;
  struct Clip {
    const char* file;
    size_t frames;
  };
  for (const Clip& clip : {Clip{"video/ground_udacity_road_540p.mp4", 221}, Clip{"track/V_AIRPLANE_001.mp4", 0}}) {
    CAPTURE(std::string(clip.file));
    const WholeDecode truth = whole_decode(real_data() / clip.file);
    if (clip.frames > 0) CHECK(truth.images.size() == clip.frames);
    FrameSource source = opened(real_data() / clip.file);
    REQUIRE(source.info().frame_count() == static_cast<int>(truth.images.size()));
    check_jumps(source, truth);
  }
}
