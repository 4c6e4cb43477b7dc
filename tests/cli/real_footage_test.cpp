// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;
namespace fs = std::filesystem;

namespace {

struct RealModel {
  const char* file;
  const char* axes;  // the file's path by the catalogue
};

constexpr std::array<RealModel, 5> kModels{{
    {"boeing737-300/boeing737-300.obj", R"("forward": "-x", "up": "+y")"},
    {"cessna172p-hires/cessna172p-hires.obj", R"("forward": "-x", "up": "+y")"},
    {"glider-centrair101/glider-centrair101.obj", R"("forward": "-x", "up": "+y")"},
    {"helicopter-dauphin/helicopter-dauphin.obj", R"("forward": "-x", "up": "+y")"},
    {"quadcopter-ratisbon/drone.obj", R"("forward": "+x", "up": "+y", "length_m": 12)"},
}};

std::vector<fs::path> clips_in(const char* folder) {
  std::vector<fs::path> clips;
  for (const auto& entry : fs::directory_iterator(real_data() / folder))
    if (entry.path().extension() == ".mp4" || entry.path().extension() == ".avi") clips.push_back(entry.path());
  std::sort(clips.begin(), clips.end());
  return clips;
}

// All of video/, and every tenth of track/, whose clips are of one size, codec and rate.
std::vector<fs::path> kinds_of_real_clips() {
  std::vector<fs::path> clips = clips_in("video");
  const std::vector<fs::path> tracked = clips_in("track");
  for (std::size_t i = 0; i < tracked.size(); i += 10) clips.push_back(tracked[i]);
  return clips;
}

// A mild wide-angle lens of the clip's own size.
std::string lens_for(cv::Size size_px) {
  const std::string focal = std::to_string(0.7 * size_px.width);
  return "image_width: " + std::to_string(size_px.width) + "\nimage_height: " + std::to_string(size_px.height) +
         "\ncamera_matrix: [[" + focal + ", 0, " + std::to_string((size_px.width - 1) / 2.0) + "], [0, " + focal +
         ", " + std::to_string((size_px.height - 1) / 2.0) +
         "], [0, 0, 1]]\ndist_coefs: [[-0.2, 0.04, 0.001, -0.0005, 0]]\n";
}

std::string project_of(const fs::path& clip, const RealModel& model) {
  return R"({"sigs": 1, "name": "real", "footage": {"video": ")" + clip.string() +
         R"(", "calibration": "lens.yaml"}, "intruders": [{"model": {"file": ")" +
         (real_data() / "models" / model.file).string() + "\", " + model.axes +
         R"(}, "trajectory": {"waypoints": [{"position_m": [90, -20, -160]}, {"position_m": [90, 20, -155]}]}}]})";
}

}  // namespace

TEST_CASE("every real clip opens and gives its middle frame") {
  if (!has_real_data()) return;
  for (const char* const folder : {"video", "track"})
    for (const fs::path& clip : clips_in(folder)) {
      INFO(clip);
      FrameSource source = FrameSource::open(clip).value();
      REQUIRE(source.info().frame_count() > 1);
      const Result<Frame> frame = source.read(source.info().frame_count() / 2);
      REQUIRE(frame.has_value());
      CHECK_FALSE(frame->damaged);
    }
}

TEST_CASE("every kind of real clip exports with every real model in turn") {
  if (!has_real_data()) return;
  const std::vector<fs::path> clips = kinds_of_real_clips();
  REQUIRE(clips.size() >= 5);
  for (std::size_t i = 0; i < std::max(clips.size(), kModels.size()); ++i) {
    const fs::path& clip = clips[i % clips.size()];
    const RealModel& model = kModels[i % kModels.size()];
    const TemporaryFolder folder;
    const FrameSource source = FrameSource::open(clip).value();
    write_file(folder / "lens.yaml", lens_for(source.info().size_px));
    write_file(folder / "p.json", project_of(clip, model));
    const int middle = source.info().frame_count() / 2;
    const std::string range = std::to_string(middle) + "-" + std::to_string(middle + 4);
    const Run run = run_sigs("export " + (folder / "p.json").string() + " --out " + folder.path().string() +
                             " --masks png --frames " + range);
    CHECK_MESSAGE(run.status == 0, clip.filename() << " " << model.file << ": " << run.err);
    CHECK(FrameSource::open(folder / "real.mkv").value().info().frame_count() == 5);
    const fs::path first =
        folder / "real.masks" /
        ("frame_" + std::string(6 - std::to_string(middle).size(), '0') + std::to_string(middle) + ".png");
    const cv::Mat mask = cv::imread(first.string(), cv::IMREAD_UNCHANGED);
    REQUIRE_MESSAGE(!mask.empty(), first);
    CHECK_MESSAGE(cv::countNonZero(mask) > 50, clip.filename() << " " << model.file);
  }
}

TEST_CASE("the untouched drone clip exports with all its 362 frames") {
  if (!has_real_data()) return;
  const TemporaryFolder folder;
  const fs::path clip = real_data() / "video/air_karma_gopro_coast.mp4";
  write_file(folder / "lens.yaml", lens_for({854, 480}));
  write_file(folder / "p.json", project_of(clip, kModels[0]));
  const Run run = run_sigs("export " + (folder / "p.json").string() + " --out " + folder.path().string() +
                           " --codec h264 --crf 30 --masks none");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(FrameSource::open(folder / "real.mp4").value().info().frame_count() == 362);
  const std::string xml = read_text(folder / "real.xml").value();
  CHECK(xml.find("<frame index=\"361\"") != std::string::npos);
  CHECK(xml.find("<frame index=\"362\"") == std::string::npos);
}
