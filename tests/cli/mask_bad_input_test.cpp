// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"
#include "video/clips.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

struct Folder {
  TemporaryFolder folder;
  std::string video = (folder / "clip.mkv").string();

  [[nodiscard]] std::string out() const { return (folder / "out").string(); }
  [[nodiscard]] int files_out() const {
    if (!fs::exists(out())) return 0;
    const fs::directory_iterator files(out());
    return static_cast<int>(std::distance(begin(files), end(files)));
  }

  // An invalid option: an error with a pointer to the help, and nothing is written.
  void check_option_refused(const std::string& input, const std::string& options, const std::string& line) const {
    const Run run = run_sigs("mask " + input + " " + options);
    CHECK(run.status == 64);
    CHECK_MESSAGE(run.err == line + "\nRun with --help for more information.\n", run.err);
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(out()));
  }

  // One line of error on stderr, the right exit status, and neither file nor folder left.
  void check_refused(const std::string& input, int status, const std::string& message,
                     const std::string& more = "") const {
    const Run run = run_sigs("mask " + input + " --method paper --out " + out() + "/m.png --confidence " + out() +
                             "/c.png --stages " + out() + " " + more);
    CHECK_MESSAGE(run.status == status, run.err);
    CHECK_MESSAGE(run.err.starts_with("error: "), run.err);
    CHECK_MESSAGE(run.err.find(message) != std::string::npos, run.err);
    CHECK_MESSAGE(std::count(run.err.begin(), run.err.end(), '\n') == 1, run.err);
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(out()));
  }
};

}  // namespace

TEST_CASE("a mask's video that is missing, a folder or not a video is named") {
  const Folder in;
  in.check_refused("gone.mkv", 66, "gone.mkv: no such file");
  in.check_refused(in.folder.path().string(), 66, in.folder.path().string());
  write_file(in.video, "this is no video");
  const Run run = run_sigs("mask " + in.video + " --out " + in.out() + "/m.png");
  CHECK((run.status == 65 || run.status == 66));
  CHECK_MESSAGE(run.err.starts_with("error: " + in.video + ": "), run.err);
  CHECK(in.files_out() == 0);
}

TEST_CASE("a clip of one frame gives no mask") {
  const Folder in;
  write_flight(in.video, 1);
  in.check_refused(in.video, 65, in.video + ": only 1 frame can be used; at least 2 are needed");
}

TEST_CASE("steps that leave one frame give no mask") {
  const Folder in;
  write_flight(in.video, 10);
  in.check_refused(in.video, 65, "only 1 frame can be used, each 10th is taken", "--every 10");
}

TEST_CASE("a clip in which nothing moves gives no mask") {
  const Folder in;
  write_luma_clip(in.video, 10, [](int) { return flight_luma(0); });
  in.check_refused(in.video, 65, in.video + ": nothing moves");
}

TEST_CASE("a clip whose size changes gives no mask") {
  const Folder in;
  const std::string codec = "-c:v libx264 -pix_fmt yuv420p -f h264";
  if (!make_clip(codec, in.folder / "a.h264", "testsrc2=size=64x48:rate=25:duration=0.4") ||
      !make_clip(codec, in.folder / "b.h264", "testsrc2=size=96x72:rate=25:duration=0.4"))
    return;
  std::vector<uint8_t> both = bytes_of(in.folder / "a.h264");
  const std::vector<uint8_t> second = bytes_of(in.folder / "b.h264");
  both.insert(both.end(), second.begin(), second.end());
  const fs::path path = in.folder / "both.h264";
  write_bytes(path, both);
  const Run run = run_sigs("mask " + path.string() + " --method paper --out " + in.out() + "/m.png");
  CHECK(run.status == 65);
  CHECK_MESSAGE(run.err.find("frame 10: the image's size changes from 64x48 to 96x72; ") != std::string::npos, run.err);
  CHECK(in.files_out() == 0);
}

TEST_CASE("an invalid command line for a mask exits with status 64") {
  const Folder in;
  write_flight(in.video, 10);
  in.check_refused(in.video, 64, "own_body.every: is 0; ", "--set own_body.every=0");
  in.check_refused(in.video, 64, "did you mean own_body.soft_edge_px?", "--set own_body.soft_edge=2");
  in.check_refused(in.video, 64, "footage.first_frame: the footage has 10 frames, 0 to 9",
                   "--set footage.first_frame=10");
  CHECK(run_sigs("mask").status == 64);
  CHECK(run_sigs("mask " + in.video + " --nonsense").status == 64);
}

TEST_CASE("an invalid number or method for a mask is a command-line error, for a video and for a project") {
  const Folder in;
  write_flight(in.video, 10);
  const std::string project = (in.folder / "p.json").string();
  write_file(project, R"({"sigs": 1, "footage": {"video": "clip.mkv"}})");
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--frames 0", "--frames: is 0, must be 2 or more"},
      {"--frames 1", "--frames: is 1, must be 2 or more"},
      {"--frames -5", "--frames: is -5, must be 2 or more"},
      {"--frames -99999999999999999999", "--frames: is -99999999999999999999, must be 2 or more"},
      {"--frames 1000000001", "--frames: is 1000000001, must be 1000000000 or less"},
      {"--frames 99999999999999999999", "--frames: is 99999999999999999999, must be 1000000000 or less"},
      {"--frames ten", "--frames: is ten, must be a whole number"},
      {"--frames 2.5", "--frames: is 2.5, must be a whole number"},
      {"--frames ''", "--frames: is empty"},
      {"--every 0", "--every: is 0, must be 1 or more"},
      {"--every 1000001", "--every: is 1000001, must be 1000000 or less"},
      {"--method magic", "--method: is magic, must be stable or paper"},
      {"--method ''", "--method: is empty"}};
  for (const auto& [options, line] : wrong) {
    in.check_option_refused(in.video, "--out " + in.out() + "/m.png " + options, line);
    if (options.ends_with(" 0") || options.ends_with("magic"))
      in.check_option_refused(project, "--out " + in.out() + "/m.png " + options, line);
  }
}

TEST_CASE("an empty path given for a mask is reported") {
  const Folder in;
  write_flight(in.video, 10);
  in.check_option_refused("''", "--out " + in.out() + "/m.png", "FILE: is empty");
  in.check_option_refused(in.video, "--out ''", "--out: is empty");
  const std::string out = "--out " + in.out() + "/m.png ";
  in.check_option_refused(in.video, out + "--confidence ''", "--confidence: is empty");
  in.check_option_refused(in.video, out + "--stages ''", "--stages: is empty");
}

TEST_CASE("a mask is written to a PNG of its own") {
  const Folder in;
  write_flight(in.video, 10);
  const std::string before = read_text(in.video).value();
  const std::string start = "mask " + in.video + " --method paper --force --out ";
  CHECK(run_sigs(start + in.out() + "/m.jpg").status == 64);
  CHECK(run_sigs(start + in.out() + "/m.png --confidence " + in.out() + "/./m.png").status == 64);
  const std::string disguised = (in.folder / "clip.png").string();
  fs::rename(in.video, disguised);
  const Run run = run_sigs("mask " + disguised + " --method paper --force --out " + disguised);
  CHECK(run.status == 73);
  CHECK_MESSAGE(run.err.find("is read by this command; choose another name") != std::string::npos, run.err);
  CHECK(read_text(disguised).value() == before);
  CHECK(in.files_out() == 0);
}

TEST_CASE("an invalid project exits with status 78 and names the field") {
  const Folder in;
  write_flight(in.video, 10);
  const std::string project = (in.folder / "p.json").string();
  write_file(project, R"({"sigs": 1, "footage": {"video": "clip.mkv", "last_frame": 12}})");
  in.check_refused(project, 78, "p.json: footage.last_frame: the footage has 10 frames, 0 to 9");
  write_file(project, R"({"sigs": 1, "footage": {"video": "clip.mkv"}, "own_body": {"every": -2}})");
  in.check_refused(project, 78, "p.json: own_body.every: is -2; ");
  write_file(project, R"({"sigs": 1, "footage": {"video": "gone.mkv"}})");
  in.check_refused(project, 66, "p.json: footage.video: no such file: ");
  write_file(project, R"({"sigs": 1})");
  in.check_refused(project, 78, "p.json: footage.video: is missing");
}

TEST_CASE("an existing stage is found before the work begins") {
  const Folder in;
  write_flight(in.video, 10);
  fs::create_directories(in.out());
  write_file(in.out() + "/00_frame.png", "mine");
  const Run run = run_sigs("mask " + in.video + " --method paper --out " + in.out() + "/m.png --stages " + in.out());
  CHECK(run.status == 73);
  CHECK_MESSAGE(run.err.find("00_frame.png: exists already; --force") != std::string::npos, run.err);
  CHECK(in.files_out() == 1);
  CHECK(read_text(in.out() + "/00_frame.png").value() == "mine");
}

TEST_CASE("a mask's folder that cannot be created exits with status 73") {
  const Folder in;
  write_flight(in.video, 10);
  write_file(in.folder / "blocked", "a file where a folder is wanted");
  const Run run = run_sigs("mask " + in.video + " --out " + (in.folder / "blocked/m.png").string());
  CHECK(run.status == 73);
  CHECK_MESSAGE(run.err.find("blocked") != std::string::npos, run.err);
}

TEST_CASE("a full disk leaves no mask and exits with status 74") {
  const Folder in;
  write_flight(in.video, 10);
  const Run run = run_sigs_after(kFullDisk, "mask " + in.video + " --method paper --out " + in.out() +
                                                "/m.png --confidence " + in.out() + "/c.png");
  CHECK_MESSAGE(run.status == 74, run.err);
  CHECK_MESSAGE(run.err.find("c.png: could not be written: ") != std::string::npos, run.err);
  CHECK(in.files_out() == 0);
}

}  // namespace sigs::test
