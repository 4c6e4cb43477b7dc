// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

struct Fixture {
  TemporaryFolder folder;
  std::string video = (folder / "clip.mkv").string();

  explicit Fixture(int frames = 10) { write_flight(video, frames); }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] Run run(const std::string& options) const {
    return run_sigs("mask " + video + " --method paper " + options);
  }
  // Of everything, folders too, however deep.
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path()))
      found.insert(entry.path().lexically_relative(folder.path()).string());
    return found;
  }
  void check_refused(const std::string& options, const std::string& message) const {
    const std::set<std::string> before = names();
    const Run refused = run(options);
    CHECK(refused.status == 64);
    CHECK_MESSAGE(refused.err == "error: " + message + "\n", refused.err);
    CHECK(names() == before);
  }
};

}  // namespace

TEST_CASE("a detection that fails takes away the folders that it made and no others") {
  const Fixture fixture(1);
  fs::create_directories(fixture.at("mine/empty"));
  const std::set<std::string> before = fixture.names();
  const Run run =
      fixture.run("--out " + fixture.at("new/deep/m.png") + " --confidence " + fixture.at("mine/sure/c.png") +
                  " --stages " + fixture.at("mine/empty/steps/") + " --every 1");
  CHECK(run.status == 65);
  CHECK(fixture.names() == before);
  CHECK(fixture.run("--out " + fixture.at("mine/empty/m.png")).status == 65);
  CHECK(fixture.names() == before);
}

TEST_CASE("an existing output that is refused leaves no new folder either") {
  const Fixture fixture;
  write_file(fixture.at("there.png"), "mine");
  const std::set<std::string> before = fixture.names();
  const Run run = fixture.run("--out " + fixture.at("new/deep/m.png") + " --confidence " + fixture.at("there.png"));
  CHECK(run.status == 73);
  CHECK(fixture.names() == before);
}

TEST_CASE("missing folders of a relative path are created") {
  const Fixture fixture;
  const std::string command = "cd " + fixture.folder.path().string() + " && " + (build_dir() / "sigs").string() +
                              " mask clip.mkv --method paper --out a/b/m.png --stages a/../c/steps >/dev/null 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(fs::exists(fixture.at("a/b/m.png")));
  CHECK(fs::exists(fixture.at("c/steps/00_frame.png")));
}

TEST_CASE("outputs with the same path are refused before anything is written") {
  const Fixture fixture;
  const std::string out = "--out " + fixture.at("out/m.png");
  fixture.check_refused(out + " --confidence " + fixture.at("out/../out/m.png"),
                        "--confidence " + fixture.at("out/../out/m.png") + ": is where the mask goes");
  fixture.check_refused(out + " --confidence " + fixture.at("out/m.png/c.png"),
                        "--confidence " + fixture.at("out/m.png/c.png") + ": is where the mask goes");
  const std::string folder = ": is the folder that --stages makes; choose another name";
  fixture.check_refused(out + " --stages " + fixture.at("out/m.png/"), "--out " + fixture.at("out/m.png") + folder);
  fixture.check_refused(out + " --stages " + fixture.at("out/m.png/steps"),
                        "--out " + fixture.at("out/m.png") + folder);
  fixture.check_refused(out + " --confidence " + fixture.at("c.png") + " --stages " + fixture.at("c.png"),
                        "--confidence " + fixture.at("c.png") + folder);
  const std::string name = ": is a name that --stages writes; choose another";
  for (const char* const taken : {"steps/00_frame.png", "steps/../steps/02_canny.png", "steps/09_own_body.png/m.png"}) {
    const std::string path = fixture.at(taken);
    fixture.check_refused("--out " + path + " --stages " + fixture.at("steps/"), "--out " + path + name);
    fixture.check_refused(out + " --confidence " + path + " --stages " + fixture.at("./steps"),
                          "--confidence " + path + name);
  }
}

TEST_CASE("several outputs can lie in one folder") {
  const Fixture fixture;
  for (const char* const name : {"m.png", "02_mine.png", "2_canny.png", "02_canny.2.png", "deeper/02_canny.png"}) {
    const Run run =
        fixture.run("--force --stages " + fixture.at("out") + " --out " + fixture.at("out/" + std::string(name)));
    CHECK_MESSAGE(run.status == 0, run.err);
  }
  CHECK(fixture.names().contains("out/deeper/02_canny.png"));
}

TEST_CASE("stages of an earlier run, of either method, are refused, and removed with force, and nothing else is") {
  const Fixture fixture;
  const std::string command = "--out " + fixture.at("m.png") + " --stages " + fixture.at("out");
  fs::create_directories(fixture.at("out"));
  write_file(fixture.at("out/07_labels.png"), "of the other method");
  const Run refused = fixture.run(command);
  CHECK(refused.status == 73);
  CHECK_MESSAGE(refused.err.find("07_labels.png: exists already; --force") != std::string::npos, refused.err);
  for (const char* const mine : {"out/07_mine.png", "out/labels.png", "out/07_labels.jpg", "out/m.png"})
    write_file(fixture.at(mine), "mine");
  for (const char* const old : {"out/11_overlay.png", "out/12_closed.png", "out/01_frame.png"})
    write_file(fixture.at(old), "of a run with other steps");
  REQUIRE(fixture.run(command + " --force").status == 0);
  const std::set<std::string> names = fixture.names();
  for (const char* const old : {"out/07_labels.png", "out/11_overlay.png", "out/12_closed.png", "out/01_frame.png"})
    CHECK_FALSE(names.contains(old));
  for (const char* const kept : {"out/07_mine.png", "out/labels.png", "out/07_labels.jpg", "out/m.png", "m.png",
                                 "out/00_frame.png", "out/06_closed.png", "out/10_overlay.png"})
    CHECK_MESSAGE(names.contains(kept), kept);
}

TEST_CASE("stages of another run stay where a detection fails") {
  const Fixture fixture(1);
  fs::create_directories(fixture.at("out"));
  write_file(fixture.at("out/07_labels.png"), "of another run");
  const std::set<std::string> before = fixture.names();
  CHECK(fixture.run("--force --out " + fixture.at("m.png") + " --stages " + fixture.at("out")).status == 65);
  CHECK(fixture.names() == before);
}

TEST_CASE("the help for masks has examples of its own and the defaults of the project") {
  const std::string help = run_sigs("mask --help").out;
  for (const char* const text : {"--frames N=1500 ", "--every K=1 ", "--method NAME=stable ", "Examples:\n  sigs mask ",
                                 "--stages steps\n", "--confidence sure.png ", "sigs mask encounter.json "})
    CHECK_MESSAGE(help.find(text) != std::string::npos, text);
  CHECK(help.find("sigs export") == std::string::npos);
}

}  // namespace sigs::test
