// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <iterator>
#include <string>
#include <vector>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kClipFrames = 8;
const cv::Size kClipSize(160, 120);

void prepare_one_aircraft(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), kClipSize, kClipFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.add("aircraft.obj", {60, 0, -150});
}

// Files and folders below a folder, also those with names of parts; none where there is no such folder.
std::vector<std::string> everything_below(const fs::path& folder) {
  std::vector<std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files.push_back(fs::relative(entry.path(), folder).string());
  return files;
}

// Within its life no file can grow beyond a size; writing more fails as on a full disk, but with another error number.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

constexpr VideoCodec kCodecs[] = {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::mjpeg, VideoCodec::png};

void set_codec(Project& project, VideoCodec codec) {
  project.output.codec = codec;
  project.output.masks = codec == VideoCodec::png ? MasksChoice::png : MasksChoice::video;
}

}  // namespace

TEST_CASE("progress is reported once for every frame and in order") {
  Scenario scenario(kClipSize, kClipFrames);
  prepare_one_aircraft(scenario);
  std::vector<int> done;
  std::vector<int> totals;
  const ExportControl control{.progress = [&](int n, int total) {
    done.push_back(n);
    totals.push_back(total);
  }};
  const Result<ExportReport> report = export_project(
      {.project = scenario.project, .folder = scenario.path("out"), .frames = FrameRange{1, 5}, .jobs = 2}, control);
  REQUIRE(report.has_value());
  CHECK(done == std::vector<int>{1, 2, 3, 4, 5});
  CHECK(totals == std::vector<int>(5, 5));
  CHECK(report->frames == 5);
  CHECK(!report->renderer_description.empty());
}

TEST_CASE("a cancelled export returns this error and leaves no file") {
  for (const VideoCodec codec : kCodecs)
    for (const int at : {0, 1, kClipFrames - 1})
      for (const int jobs : {1, 2}) {
        CAPTURE(static_cast<int>(codec));
        CAPTURE(at);
        Scenario scenario(kClipSize, kClipFrames);
        prepare_one_aircraft(scenario);
        set_codec(scenario.project, codec);
        std::atomic<bool> cancel{at == 0};
        const ExportControl control{.progress = [&](int n, int) { cancel = n >= at; }, .cancel = &cancel};
        const Result<ExportReport> report =
            export_project({.project = scenario.project, .folder = scenario.path("out"), .jobs = jobs}, control);
        REQUIRE(!report.has_value());
        CHECK(report.error().kind == ErrorKind::interrupted);
        CHECK(everything_below(scenario.path("out")).empty());
      }
}

TEST_CASE("a cancelled export leaves the results of the one before") {
  Scenario scenario(kClipSize, kClipFrames);
  prepare_one_aircraft(scenario);
  REQUIRE(export_project({.project = scenario.project, .folder = scenario.path("out")}, {}).has_value());
  const std::string before = text_of(scenario.path("out/lot.mkv"));
  const std::vector<std::string> files = everything_below(scenario.path("out"));
  std::atomic<bool> cancel{false};
  const ExportControl control{.progress = [&](int n, int) { cancel = n >= 3; }, .cancel = &cancel};
  scenario.project.light.ambient = 1;
  REQUIRE(!export_project({.project = scenario.project, .folder = scenario.path("out"), .overwrite = true}, control)
               .has_value());
  CHECK(text_of(scenario.path("out/lot.mkv")) == before);
  CHECK(everything_below(scenario.path("out")) == files);
}

TEST_CASE("an existing output is not overwritten unless requested and no other file appears") {
  for (const char* const name : {"lot.mkv", "lot.masks.mkv", "lot.xml"}) {
    CAPTURE(name);
    Scenario scenario(kClipSize, kClipFrames);
    prepare_one_aircraft(scenario);
    write_file_and_folders(scenario.path("out") / name, "mine");
    const ExportRequest request{.project = scenario.project, .folder = scenario.path("out")};
    const Result<ExportReport> report = export_project(request, {});
    REQUIRE(!report.has_value());
    CHECK(report.error().kind == ErrorKind::cannot_create);
    CHECK(report.error().text().find(name) != std::string::npos);
    CHECK(text_of(scenario.path("out") / name) == "mine");
    CHECK(everything_below(scenario.path("out")) == std::vector<std::string>{name});
  }
}

TEST_CASE("an existing output is overwritten when requested") {
  for (const VideoCodec codec : kCodecs) {
    CAPTURE(static_cast<int>(codec));
    Scenario scenario(kClipSize, kClipFrames);
    prepare_one_aircraft(scenario);
    set_codec(scenario.project, codec);
    ExportRequest request{.project = scenario.project, .folder = scenario.path("out")};
    REQUIRE(export_project(request, {}).has_value());
    const std::vector<std::string> files = everything_below(scenario.path("out"));
    CHECK(!export_project(request, {}).has_value());
    request.overwrite = true;
    request.frames = FrameRange{0, 3};
    const Result<ExportReport> again = export_project(request, {});
    if (!again) FAIL(again.error().text());
    // Images of the longer export do not stay among those of the shorter one.
    CHECK(everything_below(scenario.path("out")).size() ==
          files.size() - (codec == VideoCodec::png ? 2 * (kClipFrames - 4) : 0));
  }
}

TEST_CASE("an export never replaces a folder that holds anything but its own images") {
  Scenario scenario(kClipSize, kClipFrames);
  prepare_one_aircraft(scenario);
  set_codec(scenario.project, VideoCodec::png);
  write_file_and_folders(scenario.path("out/lot/diary.txt"), "mine");
  const Result<ExportReport> report =
      export_project({.project = scenario.project, .folder = scenario.path("out"), .overwrite = true}, {});
  REQUIRE(!report.has_value());
  CHECK(report.error().kind == ErrorKind::cannot_create);
  CHECK(text_of(scenario.path("out/lot/diary.txt")) == "mine");
}

TEST_CASE("an export never overwrites what it reads") {
  Scenario scenario(kClipSize, kClipFrames);
  prepare_one_aircraft(scenario);
  const std::string footage = text_of(scenario.path("footage.mkv"));
  scenario.project.name = "footage";
  const Result<ExportReport> over_footage =
      export_project({.project = scenario.project, .folder = scenario.path("."), .overwrite = true}, {});
  REQUIRE(!over_footage.has_value());
  CHECK(over_footage.error().kind == ErrorKind::cannot_create);
  CHECK(text_of(scenario.path("footage.mkv")) == footage);

  const std::string lens = text_of(scenario.path("pinhole.xml"));
  scenario.project.name = "pinhole";
  CHECK(
      !export_project({.project = scenario.project, .folder = scenario.path("."), .overwrite = true}, {}).has_value());
  CHECK(text_of(scenario.path("pinhole.xml")) == lens);
}

TEST_CASE("a full disk is reported and no file is left behind") {
  for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::mjpeg, VideoCodec::png}) {
    CAPTURE(static_cast<int>(codec));
    Scenario scenario(kClipSize, kClipFrames);
    prepare_one_aircraft(scenario);
    set_codec(scenario.project, codec);
    scenario.project.output.crf = 0;  // large
    Result<ExportReport> report = fail("", "not run");
    {
      const FileSizeLimit limit(6000);
      report = export_project({.project = scenario.project, .folder = scenario.path("out"), .jobs = 2}, {});
    }
    REQUIRE(!report.has_value());
    CHECK(report.error().kind == ErrorKind::write_failed);
    CHECK(everything_below(scenario.path("out")).empty());
  }
}

TEST_CASE("labels that cannot be written to their end fail the export") {
  Scenario scenario(kClipSize, 60);
  write_footage(scenario.path("footage.mkv"), {16, 16}, 60, PixelLayout::gray);
  write_calibration(scenario.path("pinhole.xml"), {20, 0, 8, 0, 20, 8, 0, 0, 1}, {0, 0, 0, 0}, {16, 16});
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  for (int i = 0; i < 4; ++i) scenario.add("aircraft.obj", {-100, 0, -150});
  scenario.project.output.masks = MasksChoice::none;
  scenario.project.output.codec = VideoCodec::png;
  Result<ExportReport> report = fail("", "not run");
  {
    const FileSizeLimit limit(20000);  // an image of 16 by 16 is far smaller, the labels of 60 frames are larger
    report = export_project({.project = scenario.project, .folder = scenario.path("out")}, {});
  }
  REQUIRE(!report.has_value());
  CHECK(report.error().kind == ErrorKind::write_failed);
  CHECK(everything_below(scenario.path("out")).empty());
}

TEST_CASE("frames that the project does not have are a usage error and write nothing") {
  for (const FrameRange range : {FrameRange{0, kClipFrames}, FrameRange{5, 4}, FrameRange{-1, 3}}) {
    Scenario scenario(kClipSize, kClipFrames);
    prepare_one_aircraft(scenario);
    const Result<ExportReport> report =
        export_project({.project = scenario.project, .folder = scenario.path("out"), .frames = range}, {});
    REQUIRE(!report.has_value());
    CHECK(report.error().kind == ErrorKind::usage);
    CHECK(!fs::exists(scenario.path("out")));
  }
}

TEST_CASE("a folder that cannot be created is an error") {
  Scenario scenario(kClipSize, kClipFrames);
  prepare_one_aircraft(scenario);
  write_file_and_folders(scenario.path("wall"), "a file");
  const Result<ExportReport> report =
      export_project({.project = scenario.project, .folder = scenario.path("wall/out")}, {});
  REQUIRE(!report.has_value());
  CHECK(report.error().kind == ErrorKind::cannot_create);
}

}  // namespace sigs::test
