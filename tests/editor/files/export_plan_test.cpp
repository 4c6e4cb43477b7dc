// SPDX-License-Identifier: MIT
#include "editor/preview/export_plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "cli/tiny_project.h"
#include "export/export_project.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/project.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TinyProject;

TEST_CASE("the files that an export will write are known in advance, for every choice") {
  const TinyProject tiny(2);
  Project project = read_project(tiny.project()).value().project;
  VideoInfo footage;
  footage.times_s = {0, 0.04};
  for (const VideoCodec codec :
       {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1, VideoCodec::mjpeg, VideoCodec::png,
        VideoCodec::tiff, VideoCodec::jpeg, VideoCodec::raw})
    for (const MasksChoice masks : {MasksChoice::none, MasksChoice::video, MasksChoice::png})
      for (const bool labels : {false, true}) {
        project.output.codec = codec;
        project.output.masks = masks;
        project.output.labels =
            labels ? std::vector<std::string>(kLabelNames.begin(), kLabelNames.end()) : std::vector<std::string>{};
        project.output.encounter = labels ? std::vector<std::string>{"nmac"} : std::vector<std::string>{};
        const std::filesystem::path folder = tiny.file("out");
        CAPTURE(static_cast<int>(codec));
        CAPTURE(static_cast<int>(masks));
        CHECK(those_there(outputs_of(project, footage, folder)).empty());
        const Result<ExportReport> report = export_project({.project = project, .folder = folder}, {});
        REQUIRE_MESSAGE(report, report.error().text());
        std::vector<std::filesystem::path> foretold = outputs_of(project, footage, folder);
        std::vector<std::filesystem::path> written = report->written;
        std::sort(foretold.begin(), foretold.end());
        std::sort(written.begin(), written.end());
        CHECK(foretold == written);
        CHECK(those_there(outputs_of(project, footage, folder)).size() == written.size());
        std::filesystem::remove_all(folder);
      }
}

TEST_CASE("the files of a rig's export are known in advance, and the command of one camera names it") {
  const TinyProject tiny(2);
  Project project = read_project(tiny.project()).value().project;
  RigCamera camera{.name = "a", .footage = std::exchange(project.footage, {}), .mount = {}, .clock = {}};
  project.cameras = {camera, camera};
  project.cameras[1].name = "b c";
  project.cameras[1].mount.yaw_deg = 1;
  const std::filesystem::path folder = tiny.file("out");
  VideoInfo footage;
  footage.times_s = {0, 0.04};
  std::vector<std::filesystem::path> foretold = outputs_of_rig(project, {footage, footage}, folder);
  CHECK(those_there(foretold).empty());
  const Result<RigReport> report = export_rig({.project = project, .folder = folder}, {});
  REQUIRE_MESSAGE(report, report.error().text());
  std::vector<std::filesystem::path> written = report->written;
  std::sort(foretold.begin(), foretold.end());
  std::sort(written.begin(), written.end());
  CHECK(foretold == written);
  CHECK(those_there(foretold) == foretold);
  CHECK(export_command({.project = project, .folder = "out"}).find("--camera") == std::string::npos);
  CHECK(export_command({.project = seen_by(project, 1), .folder = "out"}).find(" --camera 'b c' ") !=
        std::string::npos);
}

TEST_CASE("the usual folder lies beside the project file") {
  Project project;
  project.file = "/a/b/p.json";
  CHECK(usual_export_folder(project) == "/a/b/out");
  project.file.clear();
  CHECK(usual_export_folder(project).is_absolute());
}

TEST_CASE("the equivalent command is quoted correctly for a shell") {
  ExportRequest request{.folder = "/home/me/my out"};
  request.project.file = "/home/me/it's.json";
  CHECK(export_command(request) == R"(sigs export '/home/me/it'\''s.json' --out '/home/me/my out')");
  request.project.file = "a/b.json";
  request.frames = FrameRange{10, 20};
  request.overwrite = true;
  request.folder = "out";
  CHECK(export_command(request) == "sigs export a/b.json --frames 10-20 --out out --force");
}

TEST_CASE("settings that are not saved are in the command: what it sets makes the saved project the present one") {
  Project saved;
  saved.file = "/a/b/p.json";
  saved.intruders.resize(1);
  saved.intruders[0].trajectory.waypoints = {{.frame = 0, .position_m = {1, 2, 3}}};
  CHECK(assignments_between(saved, saved).texts.empty());
  CHECK(assignments_between(saved, saved).are_all);
  Project present = saved;
  present.name = "it's mine";
  present.output.codec = VideoCodec::h264;
  present.output.crf = 23;
  present.output.labels = {"xml", "coco"};
  present.footage.last_frame = 30;
  present.camera.speed_mps = 31.25;
  present.intruders[0].trajectory.waypoints[0].position_m.y = -7.125;
  const Assignments assignments = assignments_between(saved, present);
  REQUIRE(assignments.are_all);
  Project reached = saved;
  for (const std::string& assignment : assignments.texts) CHECK_MESSAGE(set_field(reached, assignment), assignment);
  CHECK(reached == present);
  const std::string command = export_command({.project = present, .folder = "out"}, assignments.texts);
  CHECK(command.find(R"( --set 'name=it'\''s mine')") != std::string::npos);
  CHECK(command.find(" --set export.video.codec=h264 ") != std::string::npos);
  // What no setting says. Those of the export are in the command all the same.
  present.intruders[0].trajectory.waypoints.push_back({.frame = 9, .position_m = {4, 5, 6}});
  const Assignments left = assignments_between(saved, present);
  CHECK_FALSE(left.are_all);
  reached = saved;
  for (const std::string& assignment : left.texts) CHECK_MESSAGE(set_field(reached, assignment), assignment);
  CHECK(reached.output == present.output);
  CHECK(reached.intruders == saved.intruders);
  CHECK_FALSE(assignments_between(Project(), saved).are_all);
  CHECK(assignments_between(Project(), saved).texts.empty());
}
