// SPDX-License-Identifier: MIT
#include "video/data_streams.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;
namespace {

// A clip of four seconds whose video begins two seconds into the container, with subtitles at 1.5 and 3 s after it.
std::filesystem::path clip_with_subtitles(const TemporaryFolder& folder, const std::string& name,
                                          const std::string& codec) {
  write_file(folder / "text.srt",
             "1\n00:00:01,500 --> 00:00:02,000\nfirst\n\n2\n00:00:03,000 --> 00:00:03,500\nsecond\n");
  const std::string command = "ffmpeg -v error -y -f lavfi -i testsrc=s=64x48:r=10:d=4 -i '" +
                              (folder / "text.srt").string() + "' -c:v libx264 -bf 2 -c:s " + codec + " '" +
                              (folder / name).string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  return folder / name;
}

}  // namespace

TEST_CASE("subtitles are listed and read at the times of the footage, whatever the container") {
  const TemporaryFolder folder;
  for (const auto& [file, codec] : {std::pair("clip.mp4", "mov_text"), std::pair("clip.mkv", "subrip")}) {
    const std::string name = file;
    CAPTURE(name);
    const std::filesystem::path clip = clip_with_subtitles(folder, name, codec);
    const auto streams = data_streams_of(clip);
    REQUIRE(streams);
    REQUIRE(streams->size() == 1);
    CHECK((*streams)[0].kind == DataKind::subtitles);
    CHECK((*streams)[0].codec == codec);
    const auto read = read_data_stream(clip, (*streams)[0].index);
    REQUIRE(read);
    CHECK(read->on_footage_time);
    std::vector<DataPacket> with_text;  // MP4 has empty samples between the texts
    for (const DataPacket& packet : read->packets)
      if (packet.bytes.size() > 2) with_text.push_back(packet);
    REQUIRE(with_text.size() == 2);
    CHECK(with_text[0].time_s == doctest::Approx(1.5).epsilon(0.01));
    CHECK(with_text[0].duration_s == doctest::Approx(0.5).epsilon(0.01));
    CHECK(with_text[1].time_s == doctest::Approx(3.0).epsilon(0.01));
    CHECK(with_text[0].bytes.find("first") != std::string::npos);
  }
}

TEST_CASE("a file that is missing, no container, or without the stream is an error") {
  const TemporaryFolder folder;
  write_file(folder / "text.txt", "no container");
  CHECK(data_streams_of(folder / "none.mp4").error().kind == ErrorKind::cannot_read);
  CHECK_FALSE(data_streams_of(folder.path()));
  CHECK_FALSE(data_streams_of(folder / "text.txt"));
  const std::filesystem::path clip = clip_with_subtitles(folder, "clip.mkv", "subrip");
  CHECK_FALSE(read_data_stream(clip, 7));
  CHECK_FALSE(read_data_stream(clip, -1));
}

TEST_CASE("reading ends when it is cancelled") {
  const TemporaryFolder folder;
  const std::filesystem::path clip = clip_with_subtitles(folder, "clip.mkv", "subrip");
  const std::atomic<bool> cancel = true;
  const auto read = read_data_stream(clip, 1, &cancel);
  REQUIRE(!read);
  CHECK(read.error().kind == ErrorKind::interrupted);
}

TEST_CASE("a file that ends before its index does is read up to there, and says so") {
  const TemporaryFolder folder;
  const std::filesystem::path clip = clip_with_subtitles(folder, "clip.mp4", "mov_text");
  const std::string command = "ffmpeg -v error -y -i '" + clip.string() + "' -map 0 -c copy -movflags +faststart '" +
                              (folder / "cut.mp4").string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  const auto whole = read_data_stream(folder / "cut.mp4", 1);
  REQUIRE(whole);
  CHECK_FALSE(whole->broke_off);
  REQUIRE(whole->packets.size() >= 2);
  // Cut within the last payload.
  std::filesystem::resize_file(folder / "cut.mp4", static_cast<std::uintmax_t>(whole->packets.back().file_offset + 1));
  const auto cut = read_data_stream(folder / "cut.mp4", 1);
  REQUIRE(cut);
  CHECK(cut->broke_off);
  CHECK(cut->packets[0].bytes == whole->packets[0].bytes);
}

TEST_CASE("the telemetry of a real clip is found, also where its video is broken") {
  if (!has_real_data()) return;
  const std::filesystem::path clip = real_data() / "video" / "air_karma_gopro_coast.mp4";
  const auto streams = data_streams_of(clip);
  REQUIRE(streams);
  int index = -1;
  for (const DataStream& stream : *streams)
    if (stream.kind == DataKind::gpmf) index = stream.index;
  REQUIRE(index >= 0);
  const auto read = read_data_stream(clip, index);
  REQUIRE(read);
  REQUIRE(read->packets.size() == 13);  // as ffprobe -show_packets lists them
  CHECK(read->packets[1].time_s == doctest::Approx(1.001));
  CHECK(read->packets[12].bytes.size() == 3052);
  CHECK(read->packets[12].file_offset == 4063482);
  // Zeros over the first image, which is at bytes 480 to 55513.
  const TemporaryFolder folder;
  std::filesystem::copy_file(clip, folder / "broken.mp4");
  std::filesystem::permissions(folder / "broken.mp4", std::filesystem::perms::owner_all);
  std::fstream out(folder / "broken.mp4", std::ios::in | std::ios::out | std::ios::binary);
  out.seekp(480);
  out << std::string(55000, '\0');
  out.close();
  const auto again = read_data_stream(folder / "broken.mp4", index);
  REQUIRE(again);
  REQUIRE(again->packets.size() == 13);
  CHECK(again->packets[12].bytes == read->packets[12].bytes);
}
