// SPDX-License-Identifier: MIT
#include "video/shared_footage.h"

#include <doctest/doctest.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <thread>

#include "support/files.h"
#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const VideoFormat kClip{.codec = VideoCodec::ffv1, .container = Container::mkv, .size_px = {64, 48}};

std::vector<FrameSource> shared(const std::filesystem::path& clip, const std::vector<FrameSteps>& frames, int ahead) {
  return FrameSource::shared(opened(clip), frames, ahead);
}

}  // namespace

TEST_CASE("readers of shared footage get the footage's frames, each with samples of its own") {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", kClip, 12);
  std::vector<FrameSource> sources =
      shared(folder / "a.mkv", {{.count = 12}, {.first = 3, .count = 9}, {.count = 6}}, 2);
  CHECK(sources[1].info().times_s == opened(folder / "a.mkv").info().times_s);
  std::vector<std::vector<int>> wrong(sources.size());
  std::vector<std::thread> threads;
  for (std::size_t reader = 0; reader < sources.size(); ++reader)
    threads.emplace_back([&, reader] {
      FrameSource source = std::move(sources[reader]);
      for (int n = reader == 1 ? 3 : 0; n < (reader == 2 ? 6 : 12); ++n) {
        Result<Frame> frame = source.read(n);
        if (!frame || samples_of(*frame) != samples_of(test_frame(kClip.layout, kClip.size_px, n)))
          wrong[reader].push_back(n);
        else
          frame->planes[0].setTo(0);  // nobody else may see it
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<int>& frames : wrong) CHECK(frames.empty());
}

TEST_CASE("frames are right in any order, and of a reader that leaves out some") {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", kClip, 12);
  const auto is_right = [&](FrameSource& source, int n) {
    const Result<Frame> frame = source.read(n);
    return frame && samples_of(*frame) == samples_of(test_frame(kClip.layout, kClip.size_px, n));
  };
  FrameSource alone = std::move(shared(folder / "a.mkv", {{.count = 12}}, 3)[0]);
  for (const int n : {0, 5, 5, 7, 6, 11, 0, 11}) CHECK(is_right(alone, n));
  std::vector<FrameSource> sources = shared(folder / "a.mkv", {{.count = 12}, {.count = 12}}, 3);
  std::atomic<int> right{0};
  std::thread every_fifth([&, source = std::move(sources[1])]() mutable {
    for (const int n : {0, 5, 10}) right += is_right(source, n) ? 1 : 0;
  });
  FrameSource every = std::move(sources[0]);
  for (int n = 0; n < 12; ++n) CHECK(is_right(every, n));
  every_fifth.join();
  CHECK(right == 3);
}

TEST_CASE("a reader waits for the slowest, so few frames are kept; it goes on when that one has left") {
  constexpr int kAhead = 3;
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", kClip, 40);
  std::vector<FrameSource> sources = shared(folder / "a.mkv", {{.count = 40}, {.count = 40}}, kAhead);
  std::atomic<int> asked_by_slow{0};
  std::atomic<int> furthest_ahead{0};
  std::atomic<int> read_by_fast{0};
  std::thread fast([&, source = std::move(sources[0])]() mutable {
    for (int n = 0; n < 40; ++n) {
      if (!source.read(n)) break;
      if (n < 30) furthest_ahead = std::max(furthest_ahead.load(), n - asked_by_slow.load());
      ++read_by_fast;
    }
  });
  {
    FrameSource slow = std::move(sources[1]);
    for (int n = 0; n < 20; ++n) {
      asked_by_slow = n;
      CHECK(slow.read(n));
      while (read_by_fast < n + kAhead) std::this_thread::yield();
    }
    CHECK(read_by_fast <= 20 + kAhead);
    asked_by_slow = 40;
  }
  fast.join();
  CHECK(read_by_fast == 40);
  CHECK(furthest_ahead <= kAhead);
}

TEST_CASE("an error of the footage is that of each reader") {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", kClip, 4);
  std::vector<FrameSource> sources = shared(folder / "a.mkv", {{.count = 4}, {.count = 4}}, 2);
  CHECK(sources[0].read(0));
  CHECK(sources[1].read(0));
  std::ofstream(folder / "a.mkv", std::ios::app) << "more";
  for (FrameSource& source : sources) {
    const Result<Frame> frame = source.read(1);
    REQUIRE_FALSE(frame);
    CHECK(frame.error().kind == ErrorKind::cannot_read);
  }
}

TEST_CASE("FFV1 copies slices that another reader has coded only where the samples are the footage's") {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", kClip, 3);
  std::vector<FrameSource> sources(shared(folder / "a.mkv", {{.count = 3}, {.count = 3}, {.count = 3}}, 3));
  for (std::size_t reader = 0; reader < sources.size(); ++reader) {
    VideoFormat format = kClip;
    format.threads = 2;
    const auto written = [&](const std::string& name, bool shares) {
      Result<VideoWriter> writer = VideoWriter::open(folder / name, format);
      REQUIRE(writer);
      FrameSource own = opened(folder / "a.mkv");
      for (int n = 0; n < 3; ++n) {
        Frame frame = shares ? sources[reader].read(n).value() : own.read(n).value();
        CHECK((frame.coded != nullptr) == shares);
        if (reader > 0 && n > 0) frame.planes[reader - 1].at<uchar>(3, 2 * n) ^= 1;  // of luma, of chroma
        REQUIRE(writer->write(frame, n));
      }
      REQUIRE(writer->finish());
      return text_of(folder / name);
    };
    CHECK(written("shared.mkv", true) == written("alone.mkv", false));
  }
}

TEST_CASE("a slice is coded once, and again for another header") {
  CodedFootage coded(test_frame(PixelLayout::gray, {8, 8}, 0));
  int times = 0;
  const auto code = [&](std::uint8_t header) {
    return coded.slice(1, {header}, [&] {
      ++times;
      return std::vector<std::uint8_t>{header, 7};
    });
  };
  for (int i = 0; i < 3; ++i) CHECK(code(4) == std::vector<std::uint8_t>{4, 7});
  CHECK(times == 1);
  CHECK(code(5) == std::vector<std::uint8_t>{5, 7});
  CHECK(times == 2);
  CHECK(code(4) == std::vector<std::uint8_t>{4, 7});
  CHECK(times == 2);
}
