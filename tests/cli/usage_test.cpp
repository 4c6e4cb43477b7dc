// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <thread>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("an unknown command is answered with a list of the known ones") {
  const Run run = run_sigs("exprt p.json");
  CHECK(run.status == 64);
  CHECK(
      run.err ==
      "error: exprt: no such command; there are init, export, frame, mask, occluder, dataset, evaluate, check, info, "
      "telemetry, ego-motion, appearance, path, calibrate, compare, encounter, encounter-model, risk, model and rig\n");
  const Run inner = run_sigs("evaluate trck clip.xml");
  CHECK(inner.status == 64);
  CHECK(inner.err == "error: evaluate trck: no such command; there are track, detect, performance and rig\n");
  CHECK(run_sigs("evaluate --help").status == 0);
  CHECK(run_sigs("evaluate").status == 64);
}

TEST_CASE("standard output is refused as an output, and no folder named - is created") {
  const TinyProject tiny;
  const std::string here = "cd '" + tiny.file("").string() + "' && ";
  const std::string sigs = (build_dir() / "sigs").string();
  for (const char* command : {" export p.json --masks png", " frame p.json --frame 2", " mask clip.mkv"}) {
    CAPTURE(command);
    CHECK(std::system((here + sigs + command + " --out - 2>err.txt").c_str()) == 64 * 256);
    CHECK(has(read_text(tiny.file("err.txt")).value(), "standard output"));
    CHECK_FALSE(std::filesystem::exists(tiny.file("-")));
  }
}

TEST_CASE("one image of a sequence is a clip of one frame, and this is reported") {
  const TinyProject tiny;
  const std::string make =
      "ffmpeg -v error -i '" + tiny.file("clip.mkv").string() + "' '" + tiny.file("shot_%04d.png").string() + "'";
  REQUIRE(std::system(make.c_str()) == 0);
  const Run run = run_sigs("info '" + tiny.file("shot_0003.png").string() + "'");
  CHECK(run.status == 0);
  const std::string said = run.out + run.err;
  CHECK_MESSAGE(has(said, "one image"), said);
  CHECK_MESSAGE(has(said, "shot_%04d.png"), said);
}

TEST_CASE("a second export of the same name is refused while the first one writes") {
  const TinyProject tiny(3000);
  const std::string first = (build_dir() / "sigs").string() + " export " + tiny.project() + " --method classic --out " +
                            tiny.out() + " >/dev/null 2>&1 &";
  REQUIRE(std::system(first.c_str()) == 0);
  const auto has_begun = [&] {  // the last of its outputs lies in its staging folder
    std::error_code code;
    for (std::filesystem::recursive_directory_iterator it(tiny.out(), code), end; !code && it != end;
         it.increment(code))
      if (it->path().filename() == "tiny.xml") return true;
    return false;
  };
  while (!has_begun()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Run second = run_sigs("export " + tiny.project() + " --frames 0-3 --out " + tiny.out());
  CHECK(second.status == 73);
  CHECK_MESSAGE(has(second.err, "is being written by another process"), second.err);
  while (!std::filesystem::exists(tiny.out() + "/tiny.xml")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(has(read_text(tiny.out() + "/tiny.xml").value(), "last_frame=\"2999\""));
}

TEST_CASE("help and version go to stdout and exit with status 0") {
  CHECK(run_sigs("--help").status == 0);
  CHECK(has(run_sigs("--help").out, "Examples:"));
  CHECK(run_sigs("export --help").status == 0);
  CHECK(has(run_sigs("--version").out, "sigs 0."));
}

TEST_CASE("an invalid command line exits with status 64") {
  for (const char* const arguments :
       {"", "fly", "export", "export p.json --jobs many", "frame p.json", "export p.json --nonsense"})
    CHECK_MESSAGE(run_sigs(arguments).status == 64, arguments);
}

TEST_CASE("an export writes its three files and prints their names alone on stdout") {
  const TinyProject tiny;
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK(run.status == 0);
  CHECK_MESSAGE(has(run.err, ": visible in "), run.err);
  CHECK_MESSAGE(run.err.find('\n') == run.err.size() - 1, run.err);  // that line alone
  CHECK(run.out == tiny.out() + "/tiny.mkv\n" + tiny.out() + "/tiny.masks.mkv\n" + tiny.out() + "/tiny.xml\n");
  CHECK(tiny.files_out() == 3);
}

TEST_CASE("options of the command line override the project") {
  const TinyProject tiny;
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() +
                           " --codec h264 --crf 30 --container mp4 --masks none --labels none --frames 2-4 "
                           "--method plain --set name=other");
  CHECK(run.status == 0);
  CHECK(run.out == tiny.out() + "/other.mp4\n");
}

TEST_CASE("images are numbered as the footage's frames are") {
  const TinyProject tiny;
  CHECK(
      run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --codec png --masks png --frames 7-8").status ==
      0);
  for (const char* const name : {"tiny/frame_000007.png", "tiny/frame_000008.png", "tiny.masks/frame_000008.png"})
    CHECK_MESSAGE(std::filesystem::exists(std::filesystem::path(tiny.out()) / name), name);
}

TEST_CASE("a folder of images is replaced with force unless it contains a foreign file") {
  const TinyProject tiny;
  const std::string command = "export " + tiny.project() + " --out " + tiny.out() + " --codec png --masks none --force";
  REQUIRE(run_sigs(command).status == 0);
  REQUIRE(run_sigs(command + " --frames 0-1").status == 0);
  CHECK_FALSE(std::filesystem::exists(tiny.out() + "/tiny/frame_000005.png"));
  write_file(tiny.out() + "/tiny/notes.txt", "mine");
  const Run refused = run_sigs(command);
  CHECK(refused.status == 73);
  CHECK_MESSAGE(has(refused.err, "notes.txt"), refused.err);
  CHECK(read_text(tiny.out() + "/tiny/notes.txt").value() == "mine");
}

TEST_CASE("existing output is refused with 73 and replaced with force") {
  const TinyProject tiny;
  const std::string command = "export " + tiny.project() + " --out " + tiny.out();
  REQUIRE(run_sigs(command).status == 0);
  const std::string before = read_text(tiny.out() + "/tiny.mkv").value();
  const Run again = run_sigs(command + " --frames 0-3");
  CHECK(again.status == 73);
  CHECK(has(again.err, "tiny.mkv: exists already; --force overwrites it"));
  CHECK(read_text(tiny.out() + "/tiny.mkv").value() == before);
  CHECK(run_sigs(command + " --force").status == 0);
  CHECK(read_text(tiny.out() + "/tiny.mkv").value() == before);
}

TEST_CASE("a frame and its stages are written and the frame is the export's") {
  const TinyProject tiny;
  const Run run = run_sigs("frame " + tiny.project() + " --frame 5 --stages --out " + tiny.out());
  CHECK(run.status == 0);
  CHECK(has(run.out, "frame_5.png"));
  CHECK(has(run.out, "_output.png"));
  REQUIRE(run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --codec png").status == 0);
  const cv::Mat frame = cv::imread(tiny.out() + "/frame_5.png", cv::IMREAD_UNCHANGED);
  const cv::Mat exported = cv::imread(tiny.out() + "/tiny/frame_000005.png", cv::IMREAD_UNCHANGED);
  REQUIRE(frame.size() == exported.size());
  CHECK(cv::norm(frame, exported, cv::NORM_INF) == 0);
}

TEST_CASE("the classic method shows all the stages of the paper's figure 4") {
  const TinyProject tiny;
  const Run run =
      run_sigs("frame " + tiny.project() + " --frame 5 --stages --set compositing.method=classic --out " + tiny.out());
  CHECK(run.status == 0);
  for (const char* const stage : {"input1", "input2", "_a.png", "_b.png", "_c.png", "_d.png", "_f.png", "output"})
    CHECK_MESSAGE(has(run.out, stage), stage);
}

TEST_CASE("the direct method shows each step from the layer to the output, in order") {
  const TinyProject tiny;
  const Run run = run_sigs("frame " + tiny.project() + " --frame 5 --stages --out " + tiny.out());
  CHECK(run.status == 0);
  std::size_t last = 0;
  for (const char* const stage :
       {"_00_input1", "_01_layer", "_02_warped", "_03_blurred", "_04_occluded", "_05_mask", "_06_output"}) {
    const std::size_t at = run.out.find(stage);
    REQUIRE_MESSAGE(at != std::string::npos, stage);
    CHECK_MESSAGE(at >= last, stage);
    last = at;
  }
}

TEST_CASE("check reports no problem in a complete project and lists the problems of a broken one") {
  TinyProject tiny;
  CHECK(run_sigs("check " + tiny.project()).status == 0);
  tiny.change("cube.obj", "gone.obj");
  tiny.change("lens.xml", "gone.xml");
  const Run run = run_sigs("check " + tiny.project());
  CHECK(run.status == 66);
  CHECK(has(run.out, "p.json: footage.calibration: no such file"));
  CHECK(has(run.out, "p.json: intruders[0].model.file: no such file"));
}

TEST_CASE("info prints the properties of a video, a calibration and a model") {
  const TinyProject tiny;
  const Run video = run_sigs("info " + tiny.file("clip.mkv").string());
  CHECK(video.status == 0);
  CHECK(has(video.out, "64x48"));
  CHECK(has(video.out, "frames: 10, 25/1"));
  CHECK(has(run_sigs("info " + tiny.file("lens.xml").string()).out, "Brown-Conrady, 5 coefficients"));
  CHECK(has(run_sigs("info " + tiny.file("cube.obj").string()).out, "12 triangles"));
  CHECK(run_sigs("info nothing.mkv").status == 66);
}

TEST_CASE("info reads a calibration for the requested size") {
  const TinyProject tiny;
  CHECK(has(run_sigs("info " + tiny.file("lens.xml").string() + " --size 128x96").out, "size: 128x96"));
  CHECK(run_sigs("info " + tiny.file("lens.xml").string() + " --size 128").status == 64);
  CHECK(run_sigs("info " + tiny.file("lens.xml").string() + " --size 100x96").status == 65);
}

TEST_CASE("another codec on the command line selects its own container") {
  TinyProject tiny;
  tiny.change(R"("intruders")", R"("export": {"video": {"codec": "ffv1", "container": "mkv"}}, "intruders")");
  const Run run = run_sigs("export " + tiny.project() + " --codec png --masks none --labels none --out " + tiny.out());
  CHECK_MESSAGE(run.status == 0, run.err);
}

TEST_CASE("progress as lines and as JSON goes to stderr and ends at the last frame") {
  const TinyProject tiny;
  const std::string command = "export " + tiny.project() + " --force --out " + tiny.out() + " --progress ";
  CHECK(has(run_sigs(command + "plain").err, "frame 10 of 10, 0:00 left"));
  CHECK(has(run_sigs(command + "json").err, "{\"done\": 10, \"total\": 10, "));
  CHECK(run_sigs(command + "none").err.empty());
}

TEST_CASE("an interrupted export exits with status 130 and leaves no file") {
  const TinyProject tiny(3000);
  const std::string program = (build_dir() / "sigs").string();
  const std::string project = tiny.project();
  const std::string out = tiny.out();
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), "sigs", "export", project.c_str(), "--out", out.c_str(), "--method", "classic", nullptr);
    _exit(127);
  }
  while (tiny.files_out() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(tiny.files_out() == 0);
}
