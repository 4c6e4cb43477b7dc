// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// The result of reading a frame: its samples and whether it is flagged, or the error's text.
struct ReadResult {
  Samples samples{};
  bool damaged = false;
  std::string error{};

  [[nodiscard]] bool operator==(const ReadResult&) const = default;
};

ReadResult result_of(FrameSource& source, int n) {
  const Result<Frame> frame = source.read(n);
  if (!frame) return {.error = frame.error().text()};
  return {.samples = samples_of(*frame), .damaged = frame->damaged};
}

std::vector<ReadResult> read_in_order(const std::filesystem::path& path) {
  FrameSource source = opened(path);
  std::vector<ReadResult> frames;
  for (int n = 0; n < source.info().frame_count(); ++n) frames.push_back(result_of(source, n));
  return frames;
}

// How many frames differ from those read in order where reading begins at them, some frames before, or at random.
int differing_reads(const std::filesystem::path& path, const std::vector<ReadResult>& in_order) {
  const int count = static_cast<int>(in_order.size());
  int differing = 0;
  for (int first = 0; first < count; first += 3) {
    FrameSource source = opened(path);
    if (source.info().frame_count() != count) return count;
    for (int n = first; n < std::min(first + 5, count); ++n)
      differing += result_of(source, n) == in_order[static_cast<size_t>(n)] ? 0 : 1;
  }
  FrameSource source = opened(path);
  for (const int n : shuffled(count)) differing += result_of(source, n) == in_order[static_cast<size_t>(n)] ? 0 : 1;
  return differing;
}

struct DamagedClip {
  const char* options;
  const char* file;
};

constexpr DamagedClip kDamagedClips[] = {
    {"-c:v libx264 -bf 2 -g 10 -crf 18", "a.mp4"},
    {"-c:v libx264 -bf 3 -x264-params open-gop=1:keyint=10:min-keyint=5", "a.mkv"},
    {"-c:v libx264 -bf 2 -g 10", "a.ts"},
    {"-c:v libx264 -bf 2 -g 12", "a.avi"},
    {"-c:v mpeg4 -bf 2 -g 10 -q:v 4", "a.avi"},
    {"-c:v mpeg4 -g 10 -q:v 4", "a.mkv"},
    {"-c:v mjpeg -pix_fmt yuvj420p -q:v 4", "a.avi"},
    {"-c:v mjpeg -pix_fmt yuvj422p -q:v 4", "a.mkv"},
    {"-c:v ffv1 -level 3 -slices 4 -slicecrc 1 -g 1", "a.mkv"},
    {"-c:v ffv1 -level 3 -slices 4 -slicecrc 1 -g 5", "a.avi"},
    {"-c:v libvpx-vp9 -g 10 -b:v 200k -cpu-used 8 -lag-in-frames 8", "a.mkv"},
    {"-c:v libx265 -x265-params open-gop=1:keyint=10:bframes=3:log-level=none", "a.mp4"},
};

using Bytes = std::vector<uint8_t>;

Bytes damaged_by(Bytes bytes, std::mt19937& random) {
  const auto place = [&](size_t length) { return std::uniform_int_distribution<size_t>(0, length - 1)(random); };
  switch (random() % 4) {
    case 0:  // single bytes, all over the file
      for (size_t i = 0, flips = 1 + random() % 12; i < flips; ++i)
        bytes[place(bytes.size())] ^= static_cast<uint8_t>(1 + random() % 255);
      break;
    case 1: {  // a part replaced by noise
      const size_t length = 1 + place(bytes.size() / 10);
      const size_t first = place(bytes.size() - length);
      for (size_t i = first; i < first + length; ++i) bytes[i] = static_cast<uint8_t>(random());
      break;
    }
    case 2: {  // a part that is missing
      const size_t length = 1 + place(bytes.size() / 20);
      const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(place(bytes.size() - length));
      bytes.erase(first, first + static_cast<std::ptrdiff_t>(length));
      break;
    }
    default:  // a file cut short
      bytes.resize(bytes.size() / 3 + place(bytes.size() * 2 / 3));
  }
  return bytes;
}

}  // namespace

// The environment variable SIGS_DAMAGED_CLIPS sets how many clips of each kind are damaged.
TEST_CASE("a frame of a damaged clip is the same in order, by itself, from the middle on and at random") {
  const TemporaryFolder folder;
  const char* asked = std::getenv("SIGS_DAMAGED_CLIPS");
  const int each = asked == nullptr ? 6 : std::atoi(asked);
  int clips = 0;
  for (const DamagedClip& kind : kDamagedClips) {
    CAPTURE(std::string(kind.options));
    CAPTURE(std::string(kind.file));
    if (!make_clip(kind.options, folder / kind.file, "testsrc2=size=96x64:rate=25:duration=1.6")) continue;
    const Bytes whole = bytes_of(folder / kind.file);
    for (int seed = 1; seed <= each; ++seed) {
      CAPTURE(seed);
      std::mt19937 random(static_cast<uint32_t>(seed));
      const std::filesystem::path path = folder / (std::string("damaged_") + kind.file);
      write_bytes(path, damaged_by(whole, random));
      if (!FrameSource::open(path)) continue;
      ++clips;
      CHECK(differing_reads(path, read_in_order(path)) == 0);
    }
  }
  CHECK(clips > 0);
}

TEST_CASE("a clip from the middle of which frames are missing gives the same frames in every order of reading") {
  const TemporaryFolder folder;
  for (const char* file : {"a.mp4", "a.mkv"}) {
    CAPTURE(std::string(file));
    if (!make_clip("-c:v libx264 -bf 0 -g 20", folder / file)) return;
    const std::string drop = "-i \"" + (folder / file).string() + "\" -c copy -bsf:v noise=drop='eq(n\\,25)' \"";
    const std::filesystem::path path = folder / (std::string("dropped_") + file);
    if (!run_ffmpeg(drop + path.string() + "\"")) return;
    const std::vector<ReadResult> in_order = read_in_order(path);
    CHECK(in_order.size() < 50);
    CHECK(differing_reads(path, in_order) == 0);
    const auto is_damaged = [](const ReadResult& frame) { return frame.damaged; };
    // All frames decoded after it up to the next keyframe depend on the missing one.
    CHECK(std::count_if(in_order.begin(), in_order.end(), is_damaged) > 0);
    CHECK(std::count_if(in_order.begin(), in_order.begin() + 20, is_damaged) == 0);
    CHECK(std::count_if(in_order.begin() + 39, in_order.end(), is_damaged) == 0);
  }
}

TEST_CASE("FFV1 whose checksums are all wrong has no intact frame and is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mkv";
  write_clip(path, {.size_px = {160, 120}}, 20);
  Bytes bytes = bytes_of(path);
  for (const PacketPlace& packet : packets_of(path)) bytes[packet.offset + packet.size - 1] ^= 0x04;
  write_bytes(path, bytes);
  const Result<FrameSource> source = FrameSource::open(path);
  REQUIRE(!source.has_value());
  CHECK(source.error().kind == ErrorKind::bad_data);
  CHECK(source.error().text().find("damaged") != std::string::npos);
}

TEST_CASE("FFV1 with one intact frame gives it in place of all others, each flagged") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mkv";
  write_clip(path, {.size_px = {160, 120}}, 20);
  FrameSource whole = opened(path);
  const Samples intact = samples_of(*whole.read(12));
  Bytes bytes = bytes_of(path);
  const std::vector<PacketPlace> packets = packets_of(path);
  REQUIRE(packets.size() == 20);
  for (size_t i = 0; i < packets.size(); ++i)
    if (i != 12) bytes[packets[i].offset + packets[i].size - 1] ^= 0x04;
  write_bytes(path, bytes);
  FrameSource source = opened(path);
  REQUIRE(source.info().frame_count() == 20);
  for (int n = 0; n < 20; ++n) {
    CAPTURE(n);
    const Result<Frame> frame = source.read(n);
    REQUIRE(frame.has_value());
    CHECK(frame->damaged == (n != 12));
    const bool same = samples_of(*frame) == intact;
    CHECK(same);
  }
}

TEST_CASE("footage that shrinks while it is read is an error, not a frozen image") {
  for (const char* file : {"a.mkv", "a.avi", "a.mp4"}) {
    CAPTURE(std::string(file));
    const TemporaryFolder folder;
    const auto path = folder / file;
    if (!make_clip("-c:v libx264 -g 10 -movflags +faststart", path)) return;
    FrameSource source = opened(path);
    REQUIRE(source.read(3).has_value());
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    int errors = 0;
    std::string words;
    for (int n = 4; n < source.info().frame_count(); ++n) {
      const Result<Frame> frame = source.read(n);
      errors += frame ? 0 : 1;
      if (!frame) words = frame.error().text();
      if (frame) CHECK(!frame->damaged);
    }
    CHECK(errors > 0);
    CHECK(words.find("changed") != std::string::npos);
    CHECK(words.find(path.string()) != std::string::npos);
  }
}
