// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

constexpr const char* kAll = "xml,coco,yolo,voc,mot,kitti,cvat,vot,aot,csv";

int lines_of(const fs::path& path) {
  const std::string text = read_text(path).value();
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::string sigs_export(const TinyProject& tiny, const std::string& options) {
  const Run run = run_sigs("export " + tiny.project() + " --out '" + tiny.out() + "' " + options);
  CHECK_MESSAGE(run.status == 0, run.err);
  return run.out;
}

}  // namespace

TEST_CASE("an export writes every format that is asked for and names what it wrote") {
  const TinyProject tiny;
  const std::string out = sigs_export(tiny, std::string("--masks none --labels ") + kAll);
  std::set<std::string> names;
  std::istringstream in(out);
  for (std::string line; std::getline(in, line);) {
    CHECK(fs::exists(line));
    names.insert(fs::path(line).filename());
  }
  CHECK(names == std::set<std::string>{"tiny.mkv", "tiny.xml", "tiny.coco.json", "tiny.yolo", "tiny.voc", "tiny.mot",
                                       "tiny.kitti", "tiny.cvat.xml", "tiny.vot", "tiny.aot.json", "tiny.csv"});
  CHECK_FALSE(fs::exists(tiny.file("out/tiny.mot/tiny/img1")));
}

TEST_CASE("labels that name images which a video's export does not write give a warning") {
  const TinyProject tiny;
  const auto warning = [&](const std::string& options) {
    const Run run = run_sigs("export " + tiny.project() + " --out '" + tiny.out() +
                             "' --force --masks none --progress none " + options);
    CHECK_MESSAGE(run.status == 0, run.err);
    return run.err;
  };
  const std::string video = warning("--codec h264 --labels coco,xml,voc");
  CHECK_MESSAGE(video.find("coco, voc") != std::string::npos, video);
  CHECK_MESSAGE(video.find("png") != std::string::npos, video);
  CHECK(warning("--codec h264 --labels xml,csv,cvat").empty());
  CHECK(warning("--codec png --labels coco,voc").empty());
}

TEST_CASE("numbered images are in the folders of labels as hard links to the same files") {
  const TinyProject tiny;
  sigs_export(tiny, "--codec png --masks none --frames 4-6 --labels mot,kitti,vot,voc,yolo");
  const fs::path image = tiny.file("out/tiny/frame_000004.png");
  for (const char* name :
       {"tiny.mot/tiny/img1/000001.png", "tiny.kitti/image_02/tiny/000000.png", "tiny.vot/tiny/color/00000001.png",
        "tiny.voc/JPEGImages/frame_000004.png", "tiny.yolo/images/tiny/frame_000004.png"})
    CHECK_MESSAGE(fs::equivalent(image, tiny.file("out") / name), name);
  CHECK(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000003.png")));
  CHECK_FALSE(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000004.png")));
}

TEST_CASE("folders of labels are replaced with --force, unless they contain a foreign file") {
  const TinyProject tiny;
  const std::string labels = "--codec png --masks none --labels yolo,voc,mot,kitti,vot";
  sigs_export(tiny, labels);
  sigs_export(tiny, labels + " --force --frames 0-3");
  CHECK_FALSE(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000005.png")));
  for (const char* folder : {"tiny.yolo", "tiny.voc", "tiny.mot", "tiny.kitti", "tiny.vot"}) {
    const fs::path own = tiny.file("out") / folder / "notes.md";
    write_file(own, "mine");
    const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --force " + labels);
    CHECK_MESSAGE(run.status == 73, folder);
    CHECK_MESSAGE(run.err.find("notes.md") != std::string::npos, run.err);
    fs::remove(own);
  }
}

TEST_CASE("thresholds remove boxes from labels but not from xml or csv") {
  const TinyProject tiny;
  const fs::path mot = tiny.file("out/tiny.mot/tiny/gt/gt.txt");
  sigs_export(tiny, "--masks none --labels xml,csv,mot");
  const int all = lines_of(mot);
  const int rows = lines_of(tiny.file("out/tiny.csv"));
  const int xml = lines_of(tiny.file("out/tiny.xml"));
  CHECK(all > 0);
  sigs_export(tiny, "--masks none --labels xml,csv,mot --force --min-pixels 100000");
  CHECK(lines_of(mot) == 0);
  CHECK(lines_of(tiny.file("out/tiny.csv")) == rows);
  CHECK(lines_of(tiny.file("out/tiny.xml")) == xml);
  sigs_export(tiny, "--masks none --labels mot --force --min-visible 0");
  CHECK(lines_of(mot) == all);
}

TEST_CASE("unknown labels and invalid thresholds exit with status 64, name the option, and write nothing") {
  const TinyProject tiny;
  for (const auto& [options, status, part] :
       {std::tuple{"--labels pascal", 64, "error: --labels pascal: knows no format \"pascal\""},
        std::tuple{"--labels mot,mot", 64, "error: --labels mot,mot: "},
        std::tuple{"--labels mot,", 64, "knows no format \"\""},
        std::tuple{"--labels none,xml", 64, "error: --labels none,xml: knows no format \"none\""},
        std::tuple{"--min-pixels 0", 64, "error: --min-pixels 0: "},
        std::tuple{"--min-pixels -1", 64, "error: --min-pixels -1: "},
        std::tuple{"--min-pixels nan", 64, "error: --min-pixels nan: expected a whole number"},
        std::tuple{"--min-visible 1.5", 64, "error: --min-visible 1.5: "},
        std::tuple{"--codec vp9", 64, "error: --codec vp9: "}, std::tuple{"--crf 99", 64, "error: --crf 99: "},
        std::tuple{"--min-pixels some", 64, "some"}, std::tuple{"--min-visible half", 64, "half"},
        std::tuple{"--set 'export.labels=[\"pascal\"]'", 78, "export.labels: knows no format \"pascal\""}}) {
    const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() + " " + options);
    CHECK_MESSAGE(run.status == status, options << ": " << run.err);
    CHECK_MESSAGE(run.err.find(part) != std::string::npos, options << ": " << run.err);
    CHECK(tiny.files_out() == 0);
  }
}

TEST_CASE("an unusual name of a project is kept in its labels") {
  const std::string name = "it's \\\"a\\\" & <b> \xC3\xBC, 100%";
  TinyProject odd(3);
  odd.change("\"name\": \"tiny\"", "\"name\": \"" + name + "\"");
  sigs_export(odd, std::string("--codec png --masks none --labels ") + kAll);
  const std::string written = "it's \"a\" & <b> \xC3\xBC, 100%";
  CHECK(fs::exists(odd.file("out") / (written + ".mot") / written / "gt" / "gt.txt"));
  CHECK(fs::exists(odd.file("out") / (written + ".vot") / written / "color" / "00000003.png"));
}
