// SPDX-License-Identifier: MIT
#include "frame/composite.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "scene/opened_project.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

constexpr int kCodedFrames = 12;

// A textured clip of uneven quantisers, as H.264. False: this machine cannot make it.
bool write_h264(const std::filesystem::path& path) {
  const std::string command = fmt::format(
      "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=size=326x242:rate=25:duration=1 -frames:v {} -c:v libx264 "
      "-crf 30 -g 5 -bf 2 -pix_fmt yuv420p \"{}\" 2>/dev/null",
      kCodedFrames, path.string());
  if (std::system(command.c_str()) == 0) return true;  // NOLINT(concurrency-mt-unsafe)
  MESSAGE("SKIPPED: no ffmpeg program with libx264");
  return false;
}

void fly(Scenario& scenario, CodecMatchChoice match) {
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  IntruderSettings& intruder = scenario.add("aircraft.obj", {});
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = {70, -45, -160}},
                                   {.frame = kCodedFrames, .position_m = {80, 30, -148}}};
  scenario.project.appearance.codec.match = match;
  scenario.project.output = {.codec = VideoCodec::ffv1, .masks = MasksChoice::video};
}

RawVideo exported(Scenario& scenario, int jobs) {
  const ExportRequest request{
      .project = scenario.project, .folder = scenario.path("out"), .jobs = jobs, .overwrite = true};
  const Result<ExportReport> report = export_project(request, {});
  if (!report) FAIL(report.error().text());
  return raw_video(scenario.path("out/lot.mkv"), kCodedFrames);
}

bool same_images(const RawVideo& a, const RawVideo& b) {
  REQUIRE(a.images.size() == kCodedFrames);
  REQUIRE(b.images.size() == kCodedFrames);
  for (std::size_t n = 0; n < a.images.size(); ++n)
    for (std::size_t i = 0; i < a.images[n].planes.size(); ++i)
      if (!same_bytes(a.images[n].planes[i], b.images[n].planes[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("with the codec match an export has the same bytes on one thread, on four, and frame by frame") {
  Scenario scenario({326, 242}, kCodedFrames);
  if (!write_h264(scenario.path("footage.mp4"))) return;
  fly(scenario, CodecMatchChoice::footage);
  scenario.project.footage.video = scenario.path("footage.mp4").string();
  const RawVideo alone = exported(scenario, 1);
  CHECK(same_images(alone, exported(scenario, 4)));
  Result<OpenedProject> opened = open_project(scenario.project, nullptr);
  REQUIRE(opened.has_value());
  CHECK(opened->warnings.empty());
  for (const int n : {7, 2, 11}) {
    CAPTURE(n);
    const Frame background = opened->source.read(n).value();
    CHECK(background.quantisers != nullptr);
    const ComposedFrame frame = composed(opened->scene, n, background);
    CHECK(frame.op_counts.pixels_coded > 0);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(same_bytes(frame.image.planes[i], alone.images[static_cast<std::size_t>(n)].planes[i]));
  }
  scenario.project.appearance.codec.match = CodecMatchChoice::none;
  CHECK(!same_images(alone, exported(scenario, 2)));
}

TEST_CASE("what is carried over from frames before is the same on one thread, on four, and frame by frame") {
  Scenario scenario({326, 242}, kCodedFrames);
  if (!write_h264(scenario.path("footage.mp4"))) return;
  fly(scenario, CodecMatchChoice::footage);
  scenario.project.footage.video = scenario.path("footage.mp4").string();
  const RawVideo first_alone = exported(scenario, 1);
  scenario.project.appearance.codec.predicted_frames = 4;
  const RawVideo alone = exported(scenario, 1);
  CHECK(same_images(alone, exported(scenario, 4)));
  CHECK(!same_images(alone, first_alone));
  for (std::size_t i = 0; i < 3; ++i)  // nothing is before the first frame
    CHECK(same_bytes(alone.images[0].planes[i], first_alone.images[0].planes[i]));
  Result<OpenedProject> opened = open_project(scenario.project, nullptr);
  REQUIRE(opened.has_value());
  for (const int n : {9, 1, 6}) {
    CAPTURE(n);
    const Frame background = opened->source.read(n).value();
    const ComposedFrame frame = composed(opened->scene, n, background);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(same_bytes(frame.image.planes[i], alone.images[static_cast<std::size_t>(n)].planes[i]));
  }
}

TEST_CASE("the truth does not depend on the codec match, and every rewritten sample is in the mask") {
  for (const PixelLayout layout :
       {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const CodecMatchChoice match : {CodecMatchChoice::h264, CodecMatchChoice::mjpeg}) {
      Scenario scenario({320, 240}, kCodedFrames);
      fly(scenario, CodecMatchChoice::none);
      const Frame background = grainy_frame({320, 240}, 1, layout);
      const ComposedFrame plain = composed(scenario.opened(), 3, background);
      scenario.project.appearance.codec = {.match = match, .predicted_frames = 3, .quantiser = 35};
      const ComposedFrame matched = composed(scenario.opened(), 3, background);
      REQUIRE(plain.truth.intruders.size() == 1);
      CHECK(matched.truth.intruders[0].visible_pixels == plain.truth.intruders[0].visible_pixels);
      CHECK(plain.op_counts.pixels_coded == 0);
      CHECK(matched.op_counts.pixels_coded > 0);
      CHECK(!same_bytes(matched.image.planes[0], plain.image.planes[0]));
      CHECK(cv::countNonZero((matched.image.planes[0] != background.planes[0]) & (matched.mask == 0)) == 0);
      CHECK(cv::countNonZero(matched.mask < plain.mask) == 0);
    }
}

TEST_CASE("only the direct method, and only where asked, goes through a codec; lossless footage has none to match") {
  Scenario scenario({320, 240}, kCodedFrames);
  fly(scenario, CodecMatchChoice::footage);
  scenario.project.compositing.method = MethodChoice::classic;
  const Frame background = grainy_frame({320, 240}, 1);
  CHECK(composed(scenario.opened(), 3, background).op_counts.pixels_coded == 0);
  CHECK(quantisers_for(scenario.project) == Quantisers::leave_out);
  scenario.project.compositing.method = MethodChoice::direct;
  CHECK(quantisers_for(scenario.project) == Quantisers::read);
  CHECK(composed(scenario.opened(), 3, background).op_counts.pixels_coded > 0);
  write_footage(scenario.path("lossless.mkv"), {320, 240}, 2, PixelLayout::yuv420);
  Result<FrameSource> source = FrameSource::open(scenario.path("lossless.mkv"), nullptr, Quantisers::read);
  REQUIRE(source.has_value());
  CHECK(composed(scenario.opened(), 1, source->read(1).value()).op_counts.pixels_coded == 0);
}

TEST_CASE("footage that does not state its quantisers is a warning that names what is taken, unless the project does") {
  Scenario scenario;
  const VideoInfo hevc{.codec = "hevc"};
  scenario.project.appearance.codec.match = CodecMatchChoice::footage;
  REQUIRE(codec_warnings_of(scenario.project, hevc).size() == 1);
  CHECK(codec_warnings_of(scenario.project, hevc)[0].what.find("QP 23") != std::string::npos);
  CHECK(codec_warnings_of(scenario.project, {.codec = "h264"}).empty());
  CHECK(codec_warnings_of(scenario.project, {.codec = "ffv1"}).empty());
  scenario.project.appearance.codec.match = CodecMatchChoice::mjpeg;
  REQUIRE(codec_warnings_of(scenario.project, {.codec = "h264"}).size() == 1);
  CHECK(codec_warnings_of(scenario.project, {.codec = "h264"})[0].what.find("90 percent") != std::string::npos);
  scenario.project.appearance.codec.quantiser = 70;
  CHECK(codec_warnings_of(scenario.project, {.codec = "h264"}).empty());
  scenario.project.appearance.codec = {};
  CHECK(codec_warnings_of(scenario.project, hevc).empty());
}

}  // namespace sigs::test
