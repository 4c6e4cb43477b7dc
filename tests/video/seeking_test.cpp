// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

struct ClipKind {
  const char* name;
  const char* options;
  const char* file;
  const char* filter = "";
};

constexpr ClipKind kClipKinds[] = {
    {"B-frames", "-c:v libx264 -bf 3 -g 20", "a.mp4"},
    {"open groups of pictures", "-c:v libx264 -bf 3 -x264-params open-gop=1:keyint=15:min-keyint=5", "a.mkv"},
    {"open groups in HEVC", "-c:v libx265 -x265-params open-gop=1:keyint=15:bframes=4:log-level=none", "a.mkv"},
    {"intra refresh without keyframes", "-c:v libx264 -x264-params intra-refresh=1:keyint=15", "a.mkv"},
    {"B-frames in AVI", "-c:v libx264 -bf 3 -g 20", "a.avi"},
    {"MPEG-4 with B-frames in AVI", "-c:v mpeg4 -bf 2 -g 12 -q:v 4", "a.avi"},
    {"MPEG-4 with B-frames in MP4", "-c:v mpeg4 -bf 2 -g 12 -q:v 4", "a.mp4"},
    {"MPEG-2 in a transport stream", "-c:v mpeg2video -bf 2 -g 12 -q:v 4", "a.ts"},
    {"H.264 in a transport stream", "-c:v libx264 -bf 3 -g 20", "a.ts"},
    {"H.264 in fragments", "-c:v libx264 -bf 3 -g 20 -movflags frag_keyframe+empty_moov", "a.mp4"},
    {"H.264 without a container", "-c:v libx264 -bf 3 -g 20", "a.h264"},
    {"interlaced H.264", "-c:v libx264 -bf 2 -g 20 -flags +ildct+ilme", "a.mp4"},
    {"VP8 with hidden images", "-c:v libvpx -auto-alt-ref 1 -lag-in-frames 16 -g 20 -b:v 300k -cpu-used 8", "a.mkv"},
    {"VP9 with hidden images", "-c:v libvpx-vp9 -auto-alt-ref 1 -lag-in-frames 16 -g 20 -b:v 300k -cpu-used 8",
     "a.mkv"},
    {"motion JPEG", "-c:v mjpeg -pix_fmt yuvj420p", "a.avi"},
    {"varying frame rate", "-vf setpts=N*N*0.002/TB -fps_mode passthrough -c:v libx264 -bf 3 -g 20", "a.mkv",
     "testsrc2=size=128x96:rate=1000:duration=0.05"},
};

// The index at an AVI's end, found by its name.
void hide_avi_index(const std::filesystem::path& path) {
  std::vector<uint8_t> bytes = bytes_of(path);
  const std::string name = "idx1";
  const auto place = std::find_end(bytes.begin(), bytes.end(), name.begin(), name.end());
  REQUIRE(place != bytes.end());
  const std::string junk = "JUNK";
  std::copy(junk.begin(), junk.end(), place);
  write_bytes(path, bytes);
}

}  // namespace

TEST_CASE("any frame of any kind of clip is the one that a whole decode gives") {
  for (const ClipKind& kind : kClipKinds) {
    CAPTURE(std::string(kind.name));
    const TemporaryFolder folder;
    const auto path = folder / kind.file;
    if (!make_clip(kind.options, path, kind.filter)) continue;
    const WholeDecode truth = whole_decode(path);
    REQUIRE(truth.images.size() >= 40);
    FrameSource source = opened(path);
    check_against(source, truth);
  }
}

TEST_CASE("frames read in steps of any length are those of a whole decode") {
  for (const char* options : {"-c:v mjpeg -pix_fmt yuvj420p", "-c:v libx264 -bf 3 -g 20"}) {
    CAPTURE(std::string(options));
    const TemporaryFolder folder;
    if (!make_clip(options, folder / "a.avi")) continue;
    const WholeDecode truth = whole_decode(folder / "a.avi");
    const int count = static_cast<int>(truth.images.size());
    for (int step = 2; step <= 18; ++step) {
      CAPTURE(step);
      FrameSource source = opened(folder / "a.avi");
      for (int n = 0; n < count; n += step) CHECK(samples_of(*source.read(n)) == truth.images[static_cast<size_t>(n)]);
    }
  }
}

TEST_CASE("an AVI without an index gives every frame") {
  for (const char* codec : {"-c:v mjpeg", "-c:v mpeg4 -g 12", "-c:v libx264 -bf 3 -g 20"}) {
    CAPTURE(std::string(codec));
    const TemporaryFolder folder;
    if (!make_clip(codec, folder / "a.avi")) continue;
    const WholeDecode indexed = whole_decode(folder / "a.avi");
    hide_avi_index(folder / "a.avi");
    const WholeDecode truth = whole_decode(folder / "a.avi");
    CHECK(truth.images == indexed.images);
    FrameSource source = opened(folder / "a.avi");
    check_against(source, truth);
  }
}

TEST_CASE("an edit list removes the images before it") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -bf 3 -g 20", folder / "whole.mp4")) return;
  const std::string cut = "-ss 1.08 -i \"" + (folder / "whole.mp4").string() + "\" -c copy \"";
  REQUIRE(run_ffmpeg(cut + (folder / "cut.mp4").string() + "\""));
  const WholeDecode truth = whole_decode(folder / "cut.mp4");
  REQUIRE(truth.images.size() == 23);  // 50 frames less the 27 that begin before 1.08 s
  FrameSource source = opened(folder / "cut.mp4");
  check_against(source, truth);
}

TEST_CASE("a clip cut inside an open group of pictures begins with the first complete image") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -bf 3 -x264-params open-gop=1:keyint=15:scenecut=0 -f h264", folder / "whole.h264"))
    return;
  // In the bare stream the second recovery point follows a sequence parameter set; begin there.
  const std::vector<uint8_t> bytes = bytes_of(folder / "whole.h264");
  const std::vector<uint8_t> parameter_set{0, 0, 0, 1, 0x67};
  const auto second = std::search(bytes.begin() + 5, bytes.end(), parameter_set.begin(), parameter_set.end());
  REQUIRE(second != bytes.end());
  write_bytes(folder / "cut.h264", {second, bytes.end()});
  const WholeDecode truth = whole_decode(folder / "cut.h264");
  FrameSource source = opened(folder / "cut.h264");
  check_against(source, truth);
}

TEST_CASE("sound and other streams beside the video change nothing") {
  const TemporaryFolder folder;
  if (!run_ffmpeg("-f lavfi -i testsrc2=size=128x96:rate=25:duration=2 -f lavfi -i sine=duration=3 "
                  "-map 1:a -map 0:v -map 1:a -c:v libx264 -g 20 -bf 3 -c:a aac \"" +
                  (folder / "a.mp4").string() + "\""))
    return;
  FrameSource source = opened(folder / "a.mp4");
  check_against(source, whole_decode(folder / "a.mp4"));
}

TEST_CASE("frame times are the presentation times of the container") {
  const TemporaryFolder folder;
  for (const char* file : {"a.mkv", "a.mp4"}) {
    CAPTURE(std::string(file));
    if (!make_clip("-vf setpts=N*N*0.002/TB -fps_mode passthrough -c:v libx264 -bf 3 -g 20", folder / file,
                   "testsrc2=size=128x96:rate=1000:duration=0.05"))
      return;
    FrameSource source = opened(folder / file);
    CHECK(source.info().variable_frame_rate);
    REQUIRE(source.info().frame_count() == 50);
    for (int n = 0; n < 50; ++n)  // Matroska and the filter that made the clip each round to 1 ms, either way
      CHECK(std::abs(source.info().times_s[static_cast<size_t>(n)] - 0.002 * n * n) < 1.001e-3);
    CHECK(source.read(7)->time_s == source.info().times_s[7]);
  }
}

TEST_CASE("frame times of an AVI with B-frames are those of a constant rate") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -bf 3 -g 20", folder / "a.avi")) return;
  const FrameSource source = opened(folder / "a.avi");
  REQUIRE(source.info().frame_count() == 50);
  CHECK(!source.info().variable_frame_rate);
  for (int n = 0; n < 50; ++n)
    CHECK(source.info().times_s[static_cast<size_t>(n)] == doctest::Approx(n / 25.0).epsilon(1e-9));
}

TEST_CASE("reading a frame twice gives the same samples, and they are not shared") {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", {.size_px = {64, 48}}, 3);
  FrameSource source = opened(folder / "a.mkv");
  Result<Frame> first = source.read(1);
  REQUIRE(first.has_value());
  const Samples before = samples_of(*first);
  first->planes[0].setTo(0);
  CHECK(samples_of(*source.read(1)) == before);
}

TEST_CASE("a cancellation while a video is opened is never another error") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mp4";
  if (!make_clip("-c:v libx264 -bf 3 -g 20", path, "testsrc2=size=640x480:rate=25:duration=8")) return;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  (void)opened(path);
  const Clock::duration whole = Clock::now() - start;
  constexpr int kMoments = 200;  // spread over the time that opening takes
  for (int k = 0; k < kMoments; ++k) {
    CAPTURE(k);
    std::atomic<bool> cancel{false};
    std::thread canceller([&] {
      const Clock::time_point until = Clock::now() + whole * k / kMoments;
      while (Clock::now() < until) std::this_thread::yield();
      cancel = true;
    });
    const Result<FrameSource> source = FrameSource::open(path, &cancel);
    canceller.join();
    if (!source) CHECK_MESSAGE(source.error().kind == ErrorKind::interrupted, source.error().what);
  }
}
