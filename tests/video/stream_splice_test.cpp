// SPDX-License-Identifier: MIT
#include "video/stream_splice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/core.hpp>
#include <random>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"
#include "video/data_streams.h"
#include "video/libav/demuxer.h"
#include "video/libav/nal_units.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

struct SplicedKind {
  const char* name;
  const char* options;
  const char* file;
  int first_encoded;  // where frames 24 to 26 change
  int last_encoded;
};

// Two seconds at 25 Hz. Where groups are closed the one with frames 24 to 26 is encoded.
constexpr SplicedKind kSplicedKinds[] = {
    {"B-frames", "-c:v libx264 -bf 3 -g 10 -sc_threshold 0", "a.mp4", 20, 29},
    {"B-frames in Matroska", "-c:v libx264 -bf 3 -g 10 -sc_threshold 0", "a.mkv", 20, 29},
    {"no B-frames, baseline", "-c:v libx264 -profile:v baseline -g 10 -sc_threshold 0 -pix_fmt yuv420p", "a.mp4", 20,
     29},
    {"10 bits", "-c:v libx264 -bf 3 -g 10 -sc_threshold 0 -pix_fmt yuv420p10le", "a.mkv", 20, 29},
    {"4:2:2, full range", "-c:v libx264 -bf 3 -g 10 -sc_threshold 0 -pix_fmt yuvj422p", "a.mp4", 20, 29},
    {"each picture alone", "-c:v libx264 -g 1", "a.mov", 24, 26},
    // Until the end there is no IDR picture.
    {"open groups", "-c:v libx264 -bf 3 -x264-params open-gop=1:keyint=10:min-keyint=10:scenecut=0", "a.mp4", -1, 49},
    {"HEVC, closed groups",
     "-c:v libx265 -x265-params open-gop=0:keyint=10:min-keyint=10:scenecut=0:bframes=3:log-level=none", "a.mp4", 20,
     29},
    {"HEVC, parameter sets in the stream",
     "-c:v libx265 -tag:v hev1 "
     "-x265-params open-gop=0:keyint=10:min-keyint=10:scenecut=0:bframes=0:repeat-headers=1:log-level=none",
     "a.mp4", 20, 29},
    {"HEVC, 10 bits",
     "-c:v libx265 -pix_fmt yuv420p10le "
     "-x265-params open-gop=0:keyint=10:min-keyint=10:scenecut=0:bframes=3:log-level=none",
     "a.mkv", 20, 29},
    // The frames shown before a keyframe, but decoded after it, go with the group before it.
    {"HEVC, open groups",
     "-c:v libx265 -x265-params open-gop=1:keyint=10:min-keyint=10:scenecut=0:bframes=3:log-level=none", "a.mp4", -1,
     -1},
    {"motion JPEG", "-c:v mjpeg -pix_fmt yuvj420p -q:v 3", "a.avi", 24, 26},
    {"motion JPEG in MOV", "-c:v mjpeg -pix_fmt yuvj422p -q:v 3", "a.mov", 24, 26},
    {"FFV1", "-c:v ffv1 -level 3 -g 1 -slices 4 -slicecrc 1", "a.mkv", 24, 26},
    {"ProRes", "-c:v prores_ks -profile:v standard", "a.mov", 24, 26},
    {"varying frame rate",
     "-vf \"select='not(eq(mod(n,7),3))'\" -fps_mode passthrough -c:v libx264 -bf 2 -g 10 -sc_threshold 0", "a.mp4", 20,
     29},
};

ChangedFrames changed_from(int first, int last, int from, int to) {
  ChangedFrames frames{.first = first};
  for (int n = first; n <= last; ++n) frames.changed.push_back(n >= from && n <= to);
  return frames;
}

// The frame that stands in for a changed one: its negative, which no encoder takes for the original.
Frame negative(const Frame& frame) {
  Frame out = frame;
  const double most = (1 << frame.bit_depth) - 1;
  for (cv::Mat& plane : out.planes) {
    cv::Mat inverted;  // of its own: frames share their samples
    cv::subtract(cv::Scalar(most), plane, inverted);
    plane = inverted;
  }
  return out;
}

double difference_in_codes(const Frame& a, const Frame& b) {
  return cv::norm(a.planes[0], b.planes[0], cv::NORM_L1) / static_cast<double>(a.planes[0].total()) /
         codes_per_8_bit_step(a.bit_depth);
}

// Writes negatives in place of the encoded frames.
void splice(const fs::path& from, const fs::path& to, const SplicePlan& plan, int first) {
  FrameSource source = opened(from);
  Result<VideoWriter> writer = VideoWriter::open_splice(to, plan, nullptr);
  if (!writer) FAIL(writer.error().text());
  for (std::size_t i = 0; i < plan.encoded.size(); ++i) {
    if (!plan.encoded[i]) continue;
    const int number = first + static_cast<int>(i);
    const Result<Frame> frame = source.read(number);
    REQUIRE(frame);
    const Result<void> written = writer->write(negative(*frame), number);
    if (!written) FAIL(written.error().text());
  }
  const Result<void> finished = writer->finish();
  if (!finished) FAIL(finished.error().text());
}

// Frames that are copied are the footage's to the sample, the others are near the negatives; each at its time.
void check_spliced(const fs::path& from, const fs::path& to, const SplicePlan& plan, int first) {
  FrameSource source = opened(from);
  FrameSource result = opened(to);
  const WholeDecode whole = whole_decode(to);
  const auto count = static_cast<int>(plan.encoded.size());
  REQUIRE(result.info().frame_count() == count);
  REQUIRE(whole.images.size() == plan.encoded.size());
  CHECK(result.info().pixel_format == source.info().pixel_format);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const Result<Frame> before = source.read(first + i);
    const Result<Frame> after = result.read(i);
    REQUIRE(before);
    REQUIRE(after);
    CHECK_FALSE(after->damaged);
    if (plan.encoded[static_cast<std::size_t>(i)]) {
      CHECK(difference_in_codes(*after, negative(*before)) < 16);  // of compression
      CHECK(difference_in_codes(*after, *before) > 32);
    } else {
      CHECK(samples_of(*after) == samples_of(*before));
    }
    const auto times = [&](const FrameSource& clip, int n) { return clip.info().times_s[static_cast<std::size_t>(n)]; };
    CHECK(times(result, i) ==
          doctest::Approx(times(source, first + i) - times(source, first)).epsilon(1e-9).scale(0.0011));
  }
}

// The bytes of the video's packets, sorted.
std::vector<std::vector<uint8_t>> sorted_packets(const fs::path& path) {
  const std::vector<uint8_t> bytes = bytes_of(path);
  std::vector<std::vector<uint8_t>> packets;
  for (const PacketPlace& place : packets_of(path))
    packets.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(place.offset),
                         bytes.begin() + static_cast<std::ptrdiff_t>(place.offset + place.size));
  std::sort(packets.begin(), packets.end());
  return packets;
}

int packets_in_both(const fs::path& a, const fs::path& b) {
  const auto of_a = sorted_packets(a);
  const auto of_b = sorted_packets(b);
  std::vector<std::vector<uint8_t>> both;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(both));
  return static_cast<int>(both.size());
}

SplicePlan planned(const fs::path& path, const ChangedFrames& frames) {
  const FrameSource source = opened(path);
  Result<SplicePlan> plan = plan_splice(source.info(), frames);
  if (!plan) FAIL(plan.error().text());
  return *plan;
}

std::string refusal_of(const fs::path& path) {
  const FrameSource source = opened(path);
  const Result<SplicePlan> plan = plan_splice(source.info(), changed_from(0, source.info().frame_count() - 1, 1, 1));
  REQUIRE_FALSE(plan);
  CHECK(plan.error().kind == ErrorKind::usage);
  return plan.error().what;
}

}  // namespace

TEST_CASE("groups of pictures without a changed frame keep every sample, whatever encoded them") {
  const TemporaryFolder folder;
  for (const SplicedKind& kind : kSplicedKinds) {
    CAPTURE(kind.name);
    const fs::path clip = folder / ("in_" + std::string(kind.file));
    const fs::path out = folder / kind.file;
    if (!make_clip(kind.options, clip)) continue;
    const int last = opened(clip).info().frame_count() - 1;
    const SplicePlan plan = planned(clip, changed_from(0, last, 24, 26));
    splice(clip, out, plan, 0);
    check_spliced(clip, out, plan, 0);
    const auto begin = std::find(plan.encoded.begin(), plan.encoded.end(), true) - plan.encoded.begin();
    const auto encoded = std::count(plan.encoded.begin(), plan.encoded.end(), true);
    if (kind.first_encoded >= 0) CHECK(begin == kind.first_encoded);
    if (kind.last_encoded >= 0) CHECK(begin + encoded - 1 == kind.last_encoded);
    CHECK(begin <= 24);
    CHECK(begin + encoded > 26);
    // At most a group of 10 and the frames shown before two keyframes, three each; without IDR pictures the rest too.
    CHECK(encoded <= (kind.last_encoded == 49 ? 36 : 16));
    // Of an open group of HEVC the keyframe behind the joint says so in one byte of each slice.
    const bool is_open_hevc = std::string(kind.name) == "HEVC, open groups";
    CHECK(packets_in_both(clip, out) >= last + 1 - static_cast<int>(encoded) - (is_open_hevc ? 1 : 0));
    CHECK(run_ffmpeg("-xerror -err_detect explode -i \"" + out.string() + "\" -f null -"));
  }
}

TEST_CASE("whatever changes in whatever range, the other groups stay") {
  const TemporaryFolder folder;
  const char* const kOptions[] = {
      "-c:v libx264 -bf 3 -g 10",
      "-c:v libx264 -bf 3 -x264-params open-gop=1:keyint=10:min-keyint=5",
      "-c:v libx265 -x265-params open-gop=1:keyint=8:min-keyint=8:bframes=4:log-level=none",
  };
  std::mt19937 random(1234);
  for (const char* const options : kOptions) {
    const fs::path clip = folder / "in.mp4";
    if (!make_clip(options, clip)) continue;
    for (int round = 0; round < 24; ++round) {
      CAPTURE(options);
      CAPTURE(round);
      const int first = round % 3 == 0 ? 0 : static_cast<int>(random() % 25);
      const int last = round % 4 == 0 ? 49 : first + 5 + static_cast<int>(random() % (45 - first));
      ChangedFrames frames = changed_from(first, std::min(last, 49), 0, -1);
      for (int i = 0; i < round % 4; ++i) frames.changed[random() % frames.changed.size()] = true;
      const SplicePlan plan = planned(clip, frames);
      for (std::size_t i = 0; i < frames.changed.size(); ++i) CHECK((plan.encoded[i] || !frames.changed[i]));
      CAPTURE(first);
      CAPTURE(frames.last());
      CAPTURE(std::find(frames.changed.begin(), frames.changed.end(), true) - frames.changed.begin());
      const fs::path out = folder / "out.mp4";
      splice(clip, out, plan, first);
      check_spliced(clip, out, plan, first);
    }
  }
}

TEST_CASE("a result can be spliced again") {
  const TemporaryFolder folder;
  for (const char* const options :
       {"-c:v libx264 -bf 2 -g 10 -sc_threshold 0",
        "-c:v libx265 -x265-params open-gop=0:keyint=10:min-keyint=10:scenecut=0:log-level=none"}) {
    CAPTURE(options);
    if (!make_clip(options, folder / "in.mp4")) continue;
    splice(folder / "in.mp4", folder / "once.mp4", planned(folder / "in.mp4", changed_from(0, 49, 12, 13)), 0);
    const SplicePlan again = planned(folder / "once.mp4", changed_from(0, 49, 18, 22));
    splice(folder / "once.mp4", folder / "twice.mp4", again, 0);
    check_spliced(folder / "once.mp4", folder / "twice.mp4", again, 0);
  }
}

TEST_CASE("sound, rotation and edit lists stay as they are") {
  const TemporaryFolder folder;
  const std::string with_sound =
      "-f lavfi -i testsrc2=size=128x96:rate=25:duration=4 -f lavfi -i sine=440:duration=4 -c:v libx264 -bf 2 -g 10 "
      "-sc_threshold 0 -pix_fmt yuv420p -c:a aac ";
  if (!run_ffmpeg(with_sound + "\"" + (folder / "sound.mov").string() + "\"")) return;
  // Begins between keyframes: frames before that are decoded and not shown.
  REQUIRE(run_ffmpeg("-ss 1.32 -i \"" + (folder / "sound.mov").string() + "\" -c copy \"" +
                     (folder / "cut.mp4").string() + "\""));
  REQUIRE(run_ffmpeg("-i \"" + (folder / "sound.mov").string() + "\" -c copy -metadata:s:v rotate=90 \"" +
                     (folder / "turned.mp4").string() + "\""));
  for (const char* const name : {"sound.mov", "cut.mp4", "turned.mp4"}) {
    CAPTURE(name);
    const fs::path clip = folder / name;
    const fs::path out = folder / ("out_" + std::string(name));
    const int last = opened(clip).info().frame_count() - 1;
    const SplicePlan plan = planned(clip, changed_from(0, last, 30, 32));
    CHECK(plan.warnings.empty());
    splice(clip, out, plan, 0);
    check_spliced(clip, out, plan, 0);
    CHECK(opened(out).info().size_px == opened(clip).info().size_px);
    const auto sums = [&](const fs::path& path) {
      REQUIRE(run_ffmpeg("-i \"" + path.string() + "\" -map 0:a -c copy -f framemd5 \"" + path.string() + ".md5\""));
      const std::vector<uint8_t> text = bytes_of(path.string() + ".md5");
      return std::string(text.begin(), text.end());
    };
    CHECK(sums(out) == sums(clip));
  }
}

TEST_CASE("a camera's telemetry goes along") {
  if (!has_real_data()) return;
  const fs::path clip = real_data() / "video/air_karma_gopro_coast.mp4";
  const TemporaryFolder folder;
  const int last = opened(clip).info().frame_count() - 1;
  const SplicePlan plan = planned(clip, changed_from(0, last, 100, 102));
  CHECK(plan.warnings.size() == 1);  // "fdsc", which FFmpeg does not write
  splice(clip, folder / "out.mp4", plan, 0);
  check_spliced(clip, folder / "out.mp4", plan, 0);
  const auto telemetry_of = [](const fs::path& path) {
    const Result<std::vector<DataStream>> streams = data_streams_of(path);
    REQUIRE(streams);
    const auto gpmf = std::find_if(streams->begin(), streams->end(),
                                   [](const DataStream& stream) { return stream.kind == DataKind::gpmf; });
    REQUIRE(gpmf != streams->end());
    Result<DataPackets> packets = read_data_stream(path, gpmf->index);
    REQUIRE(packets);
    return packets->packets;
  };
  const std::vector<DataPacket> before = telemetry_of(clip);
  const std::vector<DataPacket> after = telemetry_of(folder / "out.mp4");
  REQUIRE(before.size() == after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(after[i].bytes == before[i].bytes);
    CHECK(after[i].time_s == doctest::Approx(before[i].time_s).epsilon(1e-6).scale(0.001));
  }
}

TEST_CASE("what cannot be spliced is refused with the codec to use instead") {
  const TemporaryFolder folder;
  const std::map<std::string, std::pair<std::string, std::string>> kRefused{
      {"interlaced.mp4", {"-c:v libx264 -flags +ildct+ilme -g 10", "interlaced"}},
      {"vp9.webm", {"-c:v libvpx-vp9 -b:v 300k -cpu-used 8", "vp9"}},
      {"mpeg4.avi", {"-c:v mpeg4 -q:v 4", "mpeg4"}},
      {"stream.ts", {"-c:v libx264 -g 10", "mpegts"}},
      {"old.mkv", {"-c:v ffv1 -level 1 -g 1", "version 0 or 1"}},
  };
  for (const auto& refused : kRefused) {
    const std::string& name = refused.first;
    CAPTURE(name);
    if (!make_clip(refused.second.first, folder / name)) continue;
    const std::string what = refusal_of(folder / name);
    CAPTURE(what);
    CHECK(what.find(refused.second.second) != std::string::npos);
    CHECK(what.find("use") != std::string::npos);
  }
}

TEST_CASE("parameter sets get other numbers and nothing else") {
  const TemporaryFolder folder;
  if (!make_clip("-c:v libx265 -x265-params log-level=none", folder / "a.mp4")) return;
  const Result<libav::Demuxer> demuxer = libav::Demuxer::open(folder / "a.mp4", nullptr);
  REQUIRE(demuxer);
  const AVCodecParameters& stream = *demuxer->stream().codecpar;
  std::vector<libav::Bytes> made;
  std::vector<libav::ByteSpan> units;
  for (const libav::ByteSpan unit : libav::parameter_sets_in(stream)) {
    if (!libav::is_parameter_set(unit, AV_CODEC_ID_HEVC)) continue;
    const libav::Bytes other = libav::renumbered(unit, {.video = 9, .sequence = 15, .picture = 22});
    const libav::Bytes back = libav::renumbered(other, {.video = 0, .sequence = 0, .picture = 0});
    CHECK(std::equal(back.begin(), back.end(), unit.begin(), unit.end()));
    made.push_back(other);
  }
  REQUIRE(made.size() == 3);
  for (const libav::Bytes& unit : made) units.emplace_back(unit);
  const libav::ParameterSetIds ids = libav::ids_of(units, AV_CODEC_ID_HEVC);
  CHECK(ids.video == std::set<int>{9});
  CHECK(ids.sequence == std::set<int>{15});
  CHECK(ids.picture == std::set<int>{22});
  // The header with both sets.
  const libav::Bytes header = libav::with_parameter_sets(stream, made);
  AVCodecParameters both = stream;
  both.extradata = const_cast<uint8_t*>(header.data());
  both.extradata_size = static_cast<int>(header.size());
  const libav::ParameterSetIds all = libav::ids_of(libav::parameter_sets_in(both), AV_CODEC_ID_HEVC);
  CHECK(all.sequence == std::set<int>{0, 15});
  CHECK(all.picture == std::set<int>{0, 22});
}

TEST_CASE("bytes that look like start codes survive a renumbering, and damaged units end quietly") {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    // A slice of a trailing picture (type 1): the header's first bit, the number 0 of its set, then anything.
    libav::Bytes unit{2, 1, 0xC0};
    for (unsigned i = 0; i < random() % 60; ++i)
      unit.push_back(static_cast<uint8_t>(random() % 4 == 0 ? random() % 256 : 0));
    unit.push_back(0x80);
    libav::Bytes packet;
    libav::append_nal(packet, libav::renumbered(unit, {.picture = 15}), 4);
    for (const libav::ByteSpan once : libav::nal_units_of(packet, 4)) {
      for (std::size_t i = 0; i + 2 < once.size(); ++i)
        CHECK_FALSE((once[i] == 0 && once[i + 1] == 0 && once[i + 2] < 3));
      const libav::Bytes back = libav::renumbered(once, {.picture = 0});
      // What was written without emulation prevention gets it.
      CHECK(libav::renumbered(back, {.picture = 15}) == libav::Bytes(once.begin(), once.end()));
    }
    packet.resize(random() % packet.size());
    static_cast<void>(libav::key_kind_of(packet, AV_CODEC_ID_HEVC, 4));
    static_cast<void>(libav::key_kind_of(packet, AV_CODEC_ID_H264, 0));
    for (const libav::ByteSpan rest : libav::nal_units_of(packet, 4))
      static_cast<void>(libav::renumbered(rest, {.picture = 15}));
  }
}
