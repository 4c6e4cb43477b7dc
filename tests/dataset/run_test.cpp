// SPDX-License-Identifier: MIT
#include "dataset/run.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/staged_outputs.h"
#include "dataset/entry.h"
#include "dataset/tiny_plan.h"
#include "project/json.h"
#include "project/validate.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

DatasetRequest into(const fs::path& folder) {
  return {.folder = folder, .source = synthetic_source(), .jobs = 1};
}

DatasetRequest resumed(const fs::path& folder) {
  DatasetRequest request = into(folder);
  request.resume = true;
  return request;
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

}  // namespace

TEST_CASE("a video has the frames that its footage has, whatever its project says") {
  FootageShape footage;
  for (int n = 0; n < 50; ++n) footage.times_s.push_back(n / 25.0);
  Project project;
  project.footage.first_frame = 10;
  CHECK(frames_of(project, footage).value() == 40);
  project.footage.last_frame = 49;
  CHECK(frames_of(project, footage).value() == 40);
  for (const auto& [first, last] : std::vector<std::pair<int, int>>{{10, 50}, {10, 1000}, {20, 19}, {50, 60}}) {
    project.footage.first_frame = first;
    project.footage.last_frame = last;
    CHECK_FALSE(frames_of(project, footage));
  }
}

TEST_CASE("a dataset is a folder for each video, lists of its splits, checksums and an index") {
  const TinyPlan tiny;
  const DatasetReport report = made(tiny.plan, into(tiny.out()));
  CHECK(report.exported == 4);
  CHECK(report.kept == 0);
  CHECK(report.frames == 24);
  CHECK(names_in(tiny.out()) == std::set<std::string>{"v0", "v1", "v2", "v3", "splits", "SHA256SUMS", "index.json"});
  CHECK(names_in(tiny.out() / "v2") ==
        std::set<std::string>{"v2.mkv", "v2.masks.mkv", "v2.xml", "v2.json", "entry.json"});
  CHECK(read_text(tiny.out() / "splits/train.txt").value() == "v0\nv1\nv3\n");
  CHECK(read_text(tiny.out() / "splits/test.txt").value() == "v2\n");

  const nlohmann::json index = json_of(tiny.out() / "index.json");
  CHECK(index["name"] == "tiny");
  CHECK(index["seed"] == 0);
  CHECK(index["recipe"]["name"] == "tiny");
  CHECK(index["frames"] == 24);
  REQUIRE(index["videos"].size() == 4);
  CHECK(index["videos"][2]["name"] == "v2");
  CHECK(index["videos"][2]["split"] == "test");
  CHECK(index["videos"][2]["tags"]["aircraft"] == "cube");
  CHECK(index["videos"][2]["drawn"]["distance_m"] == 22.0);
  CHECK(index["videos"][2]["frames"] == 6);
  CHECK(index["checksum"] == report.checksum);
  CHECK(index["checksum"] == checksum_of_text(read_text(tiny.out() / "SHA256SUMS").value()));
}

TEST_CASE("index, entries and list of checksums describe every file") {
  const TinyPlan tiny(2);
  const DatasetReport report = made(tiny.plan, into(tiny.out()));
  std::map<std::string, std::string> truth;  // except the index, the list and the projects, which contain paths
  for (const auto& [path, text] : contents_of(tiny.out())) truth[path] = checksum_of_text(text);
  for (const char* const path : {"index.json", "SHA256SUMS", "v0/v0.json", "v1/v1.json"}) CHECK(truth.erase(path) == 1);
  std::map<std::string, std::string> listed;
  std::istringstream lines(read_text(tiny.out() / "SHA256SUMS").value());
  for (std::string checksum, path; lines >> checksum >> path;) listed[path] = checksum;
  CHECK(listed == truth);
  std::map<std::string, std::string> indexed;
  const nlohmann::json index = json_of(tiny.out() / "index.json");
  for (const nlohmann::json& video : index["videos"])
    for (const nlohmann::json& file : video["files"]) indexed[file["path"]] = file["sha256"];
  for (const nlohmann::json& file : index["shared_files"]) indexed[file["path"]] = file["sha256"];
  for (const char* const path : {"v0/entry.json", "v1/entry.json"}) CHECK(truth.erase(path) == 1);
  CHECK(indexed == truth);
  CHECK(index["videos"][1]["files"][0]["bytes"] ==
        fs::file_size(tiny.out() / std::string(index["videos"][1]["files"][0]["path"])));
}

TEST_CASE("the project in a video's folder opens from there") {
  const TinyPlan tiny(1);
  CHECK(made(tiny.plan, into(tiny.out("deep/er/out"))).exported == 1);
  const Project project = read_project(tiny.out("deep/er/out") / "v0/v0.json").value().project;
  CHECK(validate(project).empty());
  CHECK(project.footage.video == "../../../../clip.mkv");
  CHECK(project.name == "v0");
}

TEST_CASE("the bytes do not depend on how many videos are made in parallel") {
  const TinyPlan tiny;
  CHECK(made(tiny.plan, into(tiny.out("one"))).exported == 4);
  DatasetRequest request = into(tiny.out("three"));
  request.jobs = 3;
  CHECK(made(tiny.plan, request).exported == 4);
  CHECK(contents_of(tiny.out("one")) == contents_of(tiny.out("three")));
}

TEST_CASE("an existing dataset is not touched without resume") {
  const TinyPlan tiny(2);
  CHECK(made(tiny.plan, into(tiny.out())).exported == 2);
  const auto before = contents_of(tiny.out());
  CHECK(make_dataset(tiny.plan, into(tiny.out()), {}).error().kind == ErrorKind::cannot_create);
  fs::remove(tiny.out() / "index.json");
  CHECK(make_dataset(tiny.plan, into(tiny.out()), {}).error().kind == ErrorKind::cannot_create);
  CHECK(made(tiny.plan, resumed(tiny.out())).kept == 2);
  CHECK(contents_of(tiny.out()) == before);
}

TEST_CASE("resuming makes missing, damaged and changed videos, and keeps the rest") {
  TinyPlan tiny;
  CHECK(made(tiny.plan, into(tiny.out())).exported == 4);
  const auto before = contents_of(tiny.out());

  fs::remove_all(tiny.out() / "v0");                                      // missing
  std::ofstream(tiny.out() / "v1/v1.xml", std::ios::app) << "\n";         // another size
  std::string masks = read_text(tiny.out() / "v2/v2.masks.mkv").value();  // the same size
  masks[masks.size() / 2] = static_cast<char>(masks[masks.size() / 2] ^ 1);
  REQUIRE(write_text(tiny.out() / "v2/v2.masks.mkv", masks, true));
  std::vector<std::string> warnings;
  std::vector<std::string> finished;
  const DatasetControl control{.warn = [&](const Warning& warning) { warnings.push_back(warning.text()); },
                               .finished = [&](const std::string& video) { finished.push_back(video); }};
  const DatasetReport report = make_dataset(tiny.plan, resumed(tiny.out()), control).value();
  CHECK(report.kept == 1);
  CHECK(finished == std::vector<std::string>{"v0", "v1", "v2"});
  CHECK(warnings.size() == 2);
  CHECK(contents_of(tiny.out()) == before);

  tiny.plan.videos[3].project.intruders[0].trajectory.waypoints[1].position_m.y = 1;
  CHECK(made(tiny.plan, resumed(tiny.out())).exported == 1);
  CHECK(contents_of(tiny.out() / "v3") != contents_of(tiny.out() / "v2"));
  write_file(tiny.inputs().file("cube.mtl"), "newmtl paint\nKd 0.1 0.9 0.2\n");
  CHECK(made(tiny.plan, resumed(tiny.out())).exported == 4);
  DatasetRequest later = resumed(tiny.out());
  later.source = synthetic_source("test 2");
  CHECK(made(tiny.plan, later).exported == 4);
}

TEST_CASE("a changed split is recorded without making the video again") {
  TinyPlan tiny(2);
  CHECK(made(tiny.plan, into(tiny.out())).exported == 2);
  tiny.plan.videos[0].split = "val";
  const DatasetReport report = made(tiny.plan, resumed(tiny.out()));
  CHECK(report.kept == 2);
  CHECK(read_text(tiny.out() / "splits/val.txt").value() == "v0\n");
  CHECK(json_of(tiny.out() / "v0/entry.json")["split"] == "val");
}

TEST_CASE("a video that fails is listed, the others are made, and there is no index") {
  TinyPlan tiny;
  tiny.plan.videos[1].project.intruders[0].model.file = tiny.inputs().file("none.obj").string();
  tiny.plan.videos[2].project.footage.last_frame = 100;
  const DatasetReport report = made(tiny.plan, into(tiny.out()));
  CHECK(report.exported == 2);
  REQUIRE(report.failures.size() == 2);
  CHECK(report.failures[0].video == "v1");
  CHECK(report.failures[0].error.kind == ErrorKind::cannot_read);
  CHECK(report.failures[1].video == "v2");
  CHECK(report.checksum.empty());
  CHECK(names_in(tiny.out()) == std::set<std::string>{"v0", "v3"});
  tiny.plan.videos[1].project.intruders[0].model.file = tiny.inputs().file("cube.obj").string();
  tiny.plan.videos[2].project.footage.last_frame = 5;
  const DatasetReport again = made(tiny.plan, resumed(tiny.out()));
  CHECK(again.kept == 2);
  CHECK(again.exported == 2);
  CHECK(made(tiny.plan, into(tiny.out("other"))).checksum == again.checksum);
}

TEST_CASE("shards made separately and merged are the dataset that one run makes") {
  const TinyPlan tiny(5, 3);
  CHECK(made(tiny.plan, into(tiny.out("whole"))).exported == 5);
  for (int part = 1; part <= 3; ++part) {
    DatasetRequest request = into(tiny.out("far/away/part" + std::to_string(part)));
    request.shard = {part, 3};
    const DatasetReport report = made(tiny.plan, request);
    CHECK(report.exported == (part == 3 ? 1 : 2));
    CHECK(report.checksum.empty());
    for (const std::string& name : names_in(request.folder)) CHECK(name[0] == 'v');
  }
  DatasetRequest merge = into(tiny.out("sum"));
  merge.merge_only = true;
  fs::create_directory(merge.folder);
  for (int part = 1; part <= 3; ++part) {
    if (part == 3) {
      const Result<DatasetReport> early = make_dataset(tiny.plan, merge, {});
      REQUIRE_FALSE(early);
      CHECK(early.error().kind == ErrorKind::bad_data);
      CHECK_MESSAGE(early.error().what.ends_with("resuming makes them: v2: missing"), early.error().what);
    }
    const fs::path from = tiny.out("far/away/part" + std::to_string(part));
    for (const std::string& name : names_in(from)) fs::rename(from / name, merge.folder / name);
  }
  const DatasetReport report = made(tiny.plan, merge);
  CHECK(report.kept == 5);
  CHECK(contents_of(merge.folder) == contents_of(tiny.out("whole")));
}

TEST_CASE("files of another program are not removed") {
  TinyPlan tiny(2, 3);
  fs::create_directories(tiny.out() / "v1");
  write_file(tiny.out() / "v1/mine.txt", "mine");
  CHECK(make_dataset(tiny.plan, into(tiny.out()), {}).error().kind == ErrorKind::cannot_create);
  const DatasetReport report = made(tiny.plan, resumed(tiny.out()));
  CHECK(report.exported == 1);
  REQUIRE(report.failures.size() == 1);
  CHECK(report.failures[0].error.kind == ErrorKind::cannot_create);
  fs::remove_all(tiny.out() / "v1");
  CHECK(made(tiny.plan, resumed(tiny.out())).exported == 1);

  write_file(tiny.out() / "v1/results.csv", "mine");
  CHECK(made(tiny.plan, resumed(tiny.out())).kept == 2);
  tiny.plan.videos[1].project.camera.speed_mps = 1;
  CHECK(made(tiny.plan, resumed(tiny.out())).failures.size() == 1);
  CHECK(read_text(tiny.out() / "v1/results.csv").value() == "mine");

  fs::create_directories(tiny.out("own/labels"));
  CHECK(make_dataset(tiny.plan, resumed(tiny.out("own")), {}).error().kind == ErrorKind::cannot_create);
}

TEST_CASE("foreign files among splits, labels and index are named and kept, and the dataset is unchanged") {
  TinyPlan tiny(2, 3);
  for (PlannedVideo& video : tiny.plan.videos) video.project.output.labels = {"xml", "coco"};
  CHECK(made(tiny.plan, into(tiny.out())).exported == 2);
  const auto whole = contents_of(tiny.out());
  DatasetRequest merge = into(tiny.out());
  merge.merge_only = true;
  for (const char* const mine : {"splits/fold1.txt", "labels/mine/a", "labels/coco/b", "index.json", "SHA256SUMS"}) {
    CAPTURE(mine);
    fs::create_directories((tiny.out() / mine).parent_path());
    write_file(tiny.out() / mine, R"({"foo":1})");
    if (std::string(mine) == "SHA256SUMS") fs::remove(tiny.out() / "index.json");
    for (const DatasetRequest& request : {resumed(tiny.out()), merge}) {
      const Result<DatasetReport> report = make_dataset(tiny.plan, request, {});
      REQUIRE_FALSE(report);
      CHECK(report.error().kind == ErrorKind::cannot_create);
      CHECK_MESSAGE(report.error().where.ends_with(mine), report.error().where);
    }
    CHECK(read_text(tiny.out() / mine).value() == R"({"foo":1})");
    fs::remove(tiny.out() / mine);
    if (std::string(mine) == "SHA256SUMS")  // nothing tells any more who wrote these
      for (const char* const name : {"splits", "labels"}) fs::remove_all(tiny.out() / name);
    CHECK(made(tiny.plan, resumed(tiny.out())).kept == 2);
    CHECK(contents_of(tiny.out()) == whole);
  }
}

TEST_CASE("a merge of no folders creates none, and a failed run leaves no empty folder") {
  TinyPlan tiny(1, 3);
  DatasetRequest merge = into(tiny.out());
  merge.merge_only = true;
  CHECK(make_dataset(tiny.plan, merge, {}).error().kind == ErrorKind::cannot_read);
  tiny.plan.videos[0].project.intruders[0].model.file = tiny.inputs().file("none.obj").string();
  CHECK(made(tiny.plan, into(tiny.out())).failures.size() == 1);
  CHECK_FALSE(fs::exists(tiny.out()));
}

TEST_CASE("a video no longer in the plan is kept, reported, and not in the index") {
  TinyPlan tiny(2, 3);
  CHECK(made(tiny.plan, into(tiny.out())).exported == 2);
  tiny.plan.videos.pop_back();
  std::vector<std::string> warnings;
  const DatasetControl control{.warn = [&](const Warning& warning) { warnings.push_back(warning.where); }};
  CHECK(make_dataset(tiny.plan, resumed(tiny.out()), control).value().kept == 1);
  CHECK(warnings == std::vector<std::string>{fs::canonical(tiny.out() / "v1").string()});
  CHECK(json_of(tiny.out() / "index.json")["videos"].size() == 1);
  CHECK(fs::exists(tiny.out() / "v1/v1.xml"));
}

TEST_CASE("names that collide with each other or the dataset's own files are refused") {
  for (const char* const name : {"", "a/b", ".hidden", "labels", "splits", "index.json", "SHA256SUMS", "entry", "v1"}) {
    CAPTURE(name);
    TinyPlan tiny(2);
    tiny.plan.videos[0].name = name;
    CHECK(make_dataset(tiny.plan, into(tiny.out()), {}).error().kind == ErrorKind::bad_data);
    CHECK_FALSE(fs::exists(tiny.out()));
  }
}

TEST_CASE("unusual names of videos and folders work") {
  TinyPlan tiny(1, 3);
  const std::string name = "Ä <&> \"it's\" \\ x";
  tiny.plan.videos[0].name = name;
  tiny.plan.videos[0].project.name = name;
  CHECK(made(tiny.plan, into(tiny.out("a 'b' \"ü\""))).exported == 1);
  CHECK(fs::exists(tiny.out("a 'b' \"ü\"") / name / (name + ".xml")));
  CHECK(validate(read_project(tiny.out("a 'b' \"ü\"") / name / (name + ".json")).value().project).empty());
  CHECK(made(tiny.plan, resumed(tiny.out("a 'b' \"ü\""))).kept == 1);
}

TEST_CASE("a cancellation ends the run, and finished videos are kept") {
  const TinyPlan tiny(3);
  std::atomic<bool> stop{false};
  const DatasetControl control{.finished = [&](const std::string& video) { stop = video == "v1"; }, .cancel = &stop};
  const Result<DatasetReport> report = make_dataset(tiny.plan, into(tiny.out()), control);
  REQUIRE_FALSE(report);
  CHECK(report.error().kind == ErrorKind::interrupted);
  CHECK(report.error().what == "interrupted; 2 of 3 videos are complete, resuming goes on");
  CHECK(names_in(tiny.out()) == std::set<std::string>{"v0", "v1"});
  CHECK(made(tiny.plan, resumed(tiny.out())).kept == 2);
}

TEST_CASE("progress counts the frames that are to be made, up to all of them") {
  const TinyPlan tiny(3, 5);
  CHECK(made(tiny.plan, into(tiny.out())).exported == 3);
  fs::remove_all(tiny.out() / "v0");
  fs::remove_all(tiny.out() / "v2");
  std::vector<int> done;
  const DatasetControl control{.progress = [&](int frames, int total) {
    done.push_back(frames);
    CHECK(total == 10);
  }};
  REQUIRE(make_dataset(tiny.plan, resumed(tiny.out()), control));
  CHECK(done == std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
}
