// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// How many frames are flagged, the same in order and at random.
int damaged_frames(FrameSource& source) {
  const int count = source.info().frame_count();
  std::vector<Samples> in_order;
  std::vector<bool> damaged;
  for (int n = 0; n < count; ++n) {
    const Result<Frame> frame = source.read(n);
    if (!frame) FAIL(frame.error().text());
    in_order.push_back(samples_of(*frame));
    damaged.push_back(frame->damaged);
  }
  for (const int n : shuffled(count)) {
    CAPTURE(n);
    const Result<Frame> frame = source.read(n);
    REQUIRE(frame.has_value());
    CHECK(frame->damaged == damaged[static_cast<size_t>(n)]);
    const bool same = samples_of(*frame) == in_order[static_cast<size_t>(n)];
    CHECK(same);
  }
  return static_cast<int>(std::count(damaged.begin(), damaged.end(), true));
}

void overwrite(const std::filesystem::path& path, double from, double to) {
  std::vector<uint8_t> bytes = bytes_of(path);
  const auto at = [&](double share) { return static_cast<size_t>(share * static_cast<double>(bytes.size())); };
  for (size_t i = at(from); i < at(to); ++i) bytes[i] = static_cast<uint8_t>(bytes[i] * 37 + i);
  write_bytes(path, bytes);
}

void cut(const std::filesystem::path& path, double share) {
  std::filesystem::resize_file(path,
                               static_cast<uintmax_t>(share * static_cast<double>(std::filesystem::file_size(path))));
}

std::string error_of(const std::filesystem::path& path, ErrorKind kind) {
  const Result<FrameSource> source = FrameSource::open(path);
  REQUIRE(!source.has_value());
  CHECK(source.error().kind == kind);
  CHECK(source.error().where.find(path.string()) != std::string::npos);
  return source.error().what;
}

}  // namespace

TEST_CASE("a damaged part in the middle leaves the rest of an H264 clip unchanged") {
  for (const char* file : {"a.mp4", "a.mkv"}) {
    CAPTURE(std::string(file));
    const TemporaryFolder folder;
    const auto path = folder / file;
    if (!make_clip("-c:v libx264 -bf 2 -g 10 -keyint_min 10 -crf 15", path)) return;
    const WholeDecode whole = whole_decode(path);
    overwrite(path, 0.50, 0.52);
    FrameSource source = opened(path);
    REQUIRE(source.info().frame_count() <= 50);
    // Where the header of a block is overwritten, the Matroska reader continues at the next keyframe or cluster.
    REQUIRE(source.info().frame_count() >= 40);
    const int damaged = damaged_frames(source);
    CHECK((damaged >= 1 || source.info().frame_count() < 50));
    CHECK(damaged <= 12);
    const int last = source.info().frame_count() - 1;
    for (int i = 0; i < 20; ++i) {  // the damage is more than a group of pictures away from both ends
      CHECK(samples_of(*source.read(i)) == whole.images[static_cast<size_t>(i)]);
      CHECK(samples_of(*source.read(last - i % 10)) == whole.images[static_cast<size_t>(49 - i % 10)]);
    }
  }
}

TEST_CASE("overwritten motion JPEG gives the same frames in steps as in order") {
  const TemporaryFolder folder;
  const auto path = folder / "a.avi";
  if (!make_clip("-c:v mjpeg -pix_fmt yuvj420p -q:v 3", path)) return;
  overwrite(path, 0.50, 0.52);
  FrameSource in_order = opened(path);
  CHECK(damaged_frames(in_order) >= 1);
  const int count = in_order.info().frame_count();
  for (int step = 2; step <= 9; ++step) {
    CAPTURE(step);
    FrameSource in_steps = opened(path);
    for (int n = 0; n < count; n += step) {
      const Result<Frame> truth = in_order.read(n);
      const Result<Frame> frame = in_steps.read(n);
      CHECK(frame->damaged == truth->damaged);
      const bool same = samples_of(*frame) == samples_of(*truth);
      CHECK(same);
    }
  }
}

TEST_CASE(
    "a clip with any bytes overwritten can be read or is refused, and every order of reading gives the same frames") {
  const TemporaryFolder folder;
  for (const char* file : {"a.mp4", "a.mkv", "a.avi"}) {
    CAPTURE(std::string(file));
    if (!make_clip("-c:v libx264 -bf 2 -g 10", folder / file, "testsrc2=size=64x48:rate=25:duration=1")) return;
    const std::vector<uint8_t> whole = bytes_of(folder / file);
    for (uint32_t seed = 1; seed <= 12; ++seed) {
      CAPTURE(seed);
      std::vector<uint8_t> bytes = whole;
      for (uint32_t i = 0, state = seed * 2654435761U; i < 1 + seed / 2; ++i) {
        state = state * 1664525U + 1013904223U;
        bytes[(state >> 3) % bytes.size()] = static_cast<uint8_t>(state >> 24);
      }
      write_bytes(folder / "b", bytes);
      Result<FrameSource> source = FrameSource::open(folder / "b");
      if (source) CHECK(damaged_frames(*source) <= source->info().frame_count());
    }
  }
}

TEST_CASE("a flipped bit in FFV1 is found by its checksum") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mkv";
  write_clip(path, {.size_px = {160, 120}}, 20);
  FrameSource whole = opened(path);
  std::vector<Samples> images;
  for (int n = 0; n < 20; ++n) images.push_back(samples_of(*whole.read(n)));
  std::vector<uint8_t> bytes = bytes_of(path);
  bytes[bytes.size() / 2] = static_cast<uint8_t>(bytes[bytes.size() / 2] ^ 0x10);
  write_bytes(path, bytes);
  FrameSource source = opened(path);
  REQUIRE(source.info().frame_count() == 20);
  CHECK(warns(source.info(), "damaged"));
  CHECK(damaged_frames(source) == 1);
  for (int n = 0; n < 20; ++n) {
    const Result<Frame> frame = source.read(n);
    if (!frame->damaged) CHECK(samples_of(*frame) == images[static_cast<size_t>(n)]);
  }
}

TEST_CASE("a file that ends early keeps the frames that it has") {
  for (const char* file : {"a.mkv", "a.avi"}) {
    CAPTURE(std::string(file));
    const TemporaryFolder folder;
    const auto path = folder / file;
    const VideoFormat format{.container = std::string(file) == "a.avi" ? Container::avi : Container::mkv,
                             .size_px = {160, 120}};
    write_clip(path, format, 30);
    FrameSource whole = opened(path);
    const Samples fifth = samples_of(*whole.read(5));
    cut(path, 0.6);
    FrameSource source = opened(path);
    CHECK(source.info().frame_count() >= 16);
    CHECK(source.info().frame_count() <= 19);
    CHECK(!source.info().warnings.empty());
    CHECK(samples_of(*source.read(5)) == fifth);
    CHECK(damaged_frames(source) <= 1);  // the frame in which it ends
  }
}

TEST_CASE("a whole file whose first frame is late does not end early, and a cut one does") {
  for (const char* file : {"a.mkv", "a.mp4"}) {
    CAPTURE(std::string(file));
    const TemporaryFolder folder;
    const auto path = folder / file;
    if (!make_clip("-c:v libx264 -output_ts_offset 0.5", path)) return;
    FrameSource whole = opened(path);
    CHECK(whole.info().frame_count() == 50);
    CHECK(whole.info().warnings.empty());
    if (path.extension() != ".mkv") continue;  // an MP4 has its index at the end
    cut(path, 0.6);
    CHECK(warns(opened(path).info(), "ends early"));
  }
}

TEST_CASE("an MP4 cut short after its index keeps the frames that it has") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mp4";
  if (!make_clip("-c:v libx264 -bf 2 -g 10 -movflags +faststart", path)) return;
  const WholeDecode whole = whole_decode(path);
  cut(path, 0.6);
  FrameSource source = opened(path);
  CHECK(source.info().declared_frames == 50);
  CHECK(source.info().frame_count() < 45);
  REQUIRE(source.info().frame_count() > 20);
  CHECK(warns(source.info(), "header declares 50 frames"));
  CHECK(samples_of(*source.read(15)) == whole.images[15]);
  CHECK(damaged_frames(source) <= 4);  // the cut frame and those that depend on it
}

TEST_CASE("an MP4 cut short before its index is refused with this reason") {
  const TemporaryFolder folder;
  const auto path = folder / "a.mp4";
  if (!make_clip("-c:v libx264", path)) return;
  cut(path, 0.5);
  CHECK(error_of(path, ErrorKind::bad_data).find("moov") != std::string::npos);
}

TEST_CASE("a file that is not a video is refused with a reason") {
  const TemporaryFolder folder;
  CHECK(error_of(folder / "absent.mp4", ErrorKind::cannot_read) == "no such file");
  CHECK(error_of(folder.path(), ErrorKind::cannot_read) ==
        "is a folder without images (PNG, TIFF or JPEG), not a video");
  write_bytes(folder / "empty.mp4", {});
  CHECK(error_of(folder / "empty.mp4", ErrorKind::cannot_read) == "is empty");
  const std::string text = "This is no video.\nNot at all.\n";
  write_bytes(folder / "notes.txt", {text.begin(), text.end()});
  CHECK(error_of(folder / "notes.txt", ErrorKind::cannot_read).find("video") != std::string::npos);
  write_bytes(folder / "noise.mp4", std::vector<uint8_t>(5000, 0x5a));
  CHECK(error_of(folder / "noise.mp4", ErrorKind::cannot_read).find("video") != std::string::npos);
}

TEST_CASE("a file with sound alone is not a video") {
  const TemporaryFolder folder;
  if (!run_ffmpeg("-f lavfi -i sine=duration=1 \"" + (folder / "a.wav").string() + "\"")) return;
  CHECK(error_of(folder / "a.wav", ErrorKind::cannot_read) == "there is no video in it");
}

TEST_CASE("a video of which no frame can be decoded is bad data") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx264 -bf 0", folder / "a.mkv", "testsrc2=size=128x96:rate=25:duration=0.04")) return;
  std::vector<uint8_t> bytes = bytes_of(folder / "a.mkv");
  const std::vector<uint8_t> cluster{0x1f, 0x43, 0xb6, 0x75};  // Matroska's Cluster element
  const auto place = std::search(bytes.begin(), bytes.end(), cluster.begin(), cluster.end());
  REQUIRE(place != bytes.end());
  std::fill(place + 40, bytes.end(), uint8_t{0});
  write_bytes(folder / "a.mkv", bytes);
  CHECK(!error_of(folder / "a.mkv", ErrorKind::bad_data).empty());
}
