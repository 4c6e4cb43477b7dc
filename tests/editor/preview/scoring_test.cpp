// SPDX-License-Identifier: MIT
#include "editor/preview/scoring.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "base/staged_outputs.h"
#include "cli/tiny_project.h"
#include "comes_true.h"
#include "editor/preview/surveys.h"
#include "evaluation/metrics/track_score.h"
#include "export/export_project.h"
#include "preview_client.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace sigs::editor;
namespace fs = std::filesystem;

namespace {

using Scene = std::shared_ptr<const OpenedScene>;
using Surveys = std::vector<std::shared_ptr<const Survey>>;

Project read(const TinyProject& tiny) {
  return read_project(tiny.project()).value().project;
}

Scene opened(const Project& project) {
  const FrameSource source = FrameSource::open(resolved(project, project.footage.video)).value();
  auto footage = std::make_shared<Footage>(Footage{.shape = shape_of(source.info()), .video = source.info()});
  SceneFiles files;
  DraftScene draft = draft_scene(project, footage->shape, files);
  return std::make_shared<const OpenedScene>(OpenedScene{.content = content_id_of(project),
                                                         .project = std::make_shared<const Project>(project),
                                                         .footage = footage,
                                                         .draft = std::move(draft)});
}

Surveys surveys_of(const Scene& scene) {
  SurveyBuilder maker;
  maker.begin(scene);
  while (!maker.done()) maker.work(1);
  return maker.surveys();
}

// The own body hides the image's lower half, and that of the cube.
Project half_hidden(const TinyProject& tiny) {
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8UC1);
  mask.rowRange(24, 48).setTo(255);
  REQUIRE(cv::imwrite(tiny.file("mask.png").string(), mask));
  Project project = read(tiny);
  project.footage.own_body_mask = "mask.png";
  return project;
}

// The annotation that an export writes, read back.
ClipTruth exported_truth(const TinyProject& tiny, const Project& project) {
  const Result<ExportReport> report = export_project({.project = project, .folder = tiny.file("exported")}, {});
  REQUIRE_MESSAGE(report.has_value(), report.error().text());
  return read_truth(tiny.file("exported") / (project.name + ".xml")).value();
}

// Follows the truth with an error that grows, says nothing in frame 5 and loses it in frame 7.
void write_results(const fs::path& path, const ClipTruth& clip) {
  std::string text = "frame,x,y,width,height\n";
  for (int i = 0; i < clip.frames(); ++i) {
    const std::optional<Box>& box = clip.targets[0].frames[static_cast<std::size_t>(i)].visible;
    if (!box || i == 5) continue;
    const double away_px = i == 7 ? 500 : 0.3 * i;
    text += std::to_string(clip.footage.first_frame + i) + "," + std::to_string(box->x + 0.5 + away_px) + "," +
            std::to_string(box->y + 0.5 - away_px / 2) + "," + std::to_string(box->width) + "," +
            std::to_string(box->height) + "\n";
  }
  write_file(path, text);
}

TrackScore score_of_file(const fs::path& file, const ClipTruth& clip) {
  const TrackPolicy policy = policy_from_start(clip, clip.targets[0]).value();
  const Results results = read_results(file, clip.footage, {.start_frame = policy.from_frame}).value();
  return score_track(clip, clip.targets[0], results, policy);
}

// Not a number equals itself here.
bool is_same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void check_same(const TrackScore& a, const TrackScore& b) {
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    CHECK(a.frames[i].frame == b.frames[i].frame);
    CHECK(a.frames[i].is_scored == b.frames[i].is_scored);
    CHECK(a.frames[i].is_lost == b.frames[i].is_lost);
    CHECK(a.frames[i].center_error_px == b.frames[i].center_error_px);
    CHECK(a.frames[i].dx_px == b.frames[i].dx_px);
    CHECK(a.frames[i].overlap == b.frames[i].overlap);
  }
  CHECK(a.scored == b.scored);
  CHECK(a.lost == b.lost);
  CHECK(a.precision == b.precision);
  CHECK(is_same(a.mean_center_error_px, b.mean_center_error_px));
  CHECK(is_same(a.success_auc, b.success_auc));
}

ResultFile file_at(const fs::path& path, int id = 1) {
  return {.id = id, .path = path};
}

bool is_measured(const std::shared_ptr<const Scored>& scored) {
  return scored && scored->truth == TruthKind::measured;
}

}  // namespace

TEST_CASE("the editor's figures are those of the annotation that is exported") {
  const TinyProject tiny;
  const Project project = half_hidden(tiny);
  const ClipTruth clip = exported_truth(tiny, project);
  const fs::path file = tiny.file("my tracker.csv");
  write_results(file, clip);
  const TrackScore expected = score_of_file(file, clip);
  REQUIRE(expected.scored > 6);
  REQUIRE(expected.lost == 2);

  Scoring scoring([] {});
  const Scene scene = opened(project);
  const Surveys surveys = surveys_of(scene);
  // Outlines would not give this.
  REQUIRE(score_of_file(file, *outline_truth(*scene, surveys)).mean_center_error_px >
          expected.mean_center_error_px + 0.3);
  scoring.want({.scene = scene, .surveys = surveys, .files = {file_at(file)}});
  REQUIRE(comes_true([&] { return is_measured(scoring.scored()); }));
  const std::shared_ptr<const Scored> scored = scoring.scored();
  REQUIRE(scored->trackers.size() == 1);
  CHECK(scored->trackers[0].name == "my tracker");
  CHECK(scored->target == "cube");
  CHECK(scored->first_frame == clip.footage.first_frame);
  REQUIRE(scored->trackers[0].score);
  check_same(*scored->trackers[0].score, expected);
}

TEST_CASE("until frames are rendered outlines give the truth, within a pixel or so") {
  const TinyProject tiny;
  const Project project = read(tiny);
  const ClipTruth clip = exported_truth(tiny, project);
  const Scene scene = opened(project);
  const std::shared_ptr<const ClipTruth> outlines = outline_truth(*scene, surveys_of(scene));
  REQUIRE(outlines);
  REQUIRE(outlines->frames() == clip.frames());
  CHECK(outlines->footage.video == clip.footage.video);
  CHECK(outlines->times_s.back() == doctest::Approx(clip.times_s.back()).epsilon(1e-9));
  REQUIRE(outlines->targets.size() == 1);
  int compared = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    const std::optional<Box>& about = outlines->targets[0].frames[i].visible;
    const std::optional<Box>& exact = clip.targets[0].frames[i].visible;
    CHECK(about.has_value() == exact.has_value());
    if (!about || !exact) continue;
    ++compared;
    CHECK(std::abs(about->x - exact->x) <= 1);
    CHECK(std::abs(about->y - exact->y) <= 1);
    CHECK(std::abs(about->width - exact->width) <= 2);
    CHECK(std::abs(about->height - exact->height) <= 2);
  }
  CHECK(compared > 6);
  CHECK_FALSE(outline_truth(*scene, {nullptr}));
  CHECK_FALSE(outline_truth(*scene, {}));
}

TEST_CASE("a project that cannot be drawn is scored by outlines, and says why") {
  TinyProject tiny;
  const Project valid = read(tiny);
  const fs::path file = tiny.file("t.csv");
  write_results(file, exported_truth(tiny, valid));
  Project broken = valid;
  broken.intruders[0].model.file = "gone.obj";
  const Scene scene = opened(broken);
  Scoring scoring([] {});
  scoring.want({.scene = scene, .surveys = surveys_of(scene), .files = {file_at(file)}});
  REQUIRE(comes_true([&] {
    const auto scored = scoring.scored();
    return scored && !scored->truth_problem.empty() && scored->trackers[0].score;
  }));
  CHECK(scoring.scored()->truth == TruthKind::outlines);
}

TEST_CASE("a wrong line is named with its file, and a file that is repaired is read again") {
  const TinyProject tiny;
  const Project project = read(tiny);
  const fs::path file = tiny.file("bad.csv");
  write_file(file, "frame,x,y,width,height\n0,1,2,3,4\n1,1,2,nan,4\n");
  const Scene scene = opened(project);
  std::atomic<int> wakes = 0;
  Scoring scoring([&] { ++wakes; });
  scoring.want({.scene = scene, .surveys = surveys_of(scene), .files = {file_at(file)}});
  REQUIRE(comes_true([&] { return scoring.scored() && !scoring.scored()->trackers[0].problem.empty(); }));
  const std::string problem = scoring.scored()->trackers[0].problem;
  CHECK(problem.find("bad.csv") != std::string::npos);
  CHECK(problem.find('3') != std::string::npos);
  CHECK(problem.find('\n') == std::string::npos);
  CHECK_FALSE(scoring.scored()->trackers[0].score);
  write_file(file, "frame,x,y,width,height\n0,1,2,3,4\n");
  REQUIRE(comes_true([&] { return scoring.scored()->trackers[0].score != nullptr; }));
  CHECK(scoring.scored()->trackers[0].problem.empty());
  CHECK(comes_true([&] { return wakes > 1; }));
}

TEST_CASE("nothing is composed while no results are loaded, and nothing is shown once they are gone") {
  const TinyProject tiny;
  const Project project = read(tiny);
  const fs::path file = tiny.file("t.csv");
  write_file(file, "frame,x,y,width,height\n0,1,2,3,4\n");
  const Scene scene = opened(project);
  std::atomic<int> shows = 0;
  const auto stream = [&](const Project&, int, const TruthBuilder::OnFrame&) -> Result<void> {
    ++shows;
    return fail("clip", "is not shown");
  };
  Scoring scoring([] {}, stream);
  scoring.want({.scene = scene, .surveys = surveys_of(scene)});
  CHECK_FALSE(scoring.scored());
  scoring.want({.scene = scene, .surveys = surveys_of(scene), .files = {file_at(file)}});
  REQUIRE(comes_true([&] { return scoring.scored() && !scoring.scored()->truth_problem.empty(); }));
  CHECK(scoring.scored()->truth_problem == "clip: is not shown");
  CHECK(shows == 1);
  scoring.want({.scene = scene});
  CHECK_FALSE(scoring.scored());
}

}  // namespace sigs::test
