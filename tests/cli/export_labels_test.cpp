// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "labels/labels.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

bool always(const LabelFormat&) {
  return true;
}

bool is_folder(const LabelFormat& format) {
  return format.is_folder;
}

// The formats for which this is true, as --labels takes them: "xml,coco".
std::string names_where(bool (*is_wanted)(const LabelFormat&), std::string_view separator = ",") {
  std::vector<std::string_view> names;
  for (const LabelFormat& format : label_formats())
    if (is_wanted(format)) names.push_back(format.name);
  return listed(names, separator);
}

std::string all_names() {
  return names_where(always);
}

// The file or folder that an export of the tiny project writes in this format.
std::string output_of(const LabelFormat& format) {
  return std::string("tiny").append(format.suffix);
}

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
  const std::string out = sigs_export(tiny, "--masks none --labels " + all_names());
  std::set<std::string> names;
  std::istringstream in(out);
  for (std::string line; std::getline(in, line);) {
    CHECK(fs::exists(line));
    names.insert(fs::path(line).filename());
  }
  std::set<std::string> expected{"tiny.mkv"};
  for (const LabelFormat& format : label_formats()) expected.insert(output_of(format));
  CHECK(names == expected);
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
  const auto names_images = [](const LabelFormat& format) { return format.names_images; };
  const auto names_no_images = [](const LabelFormat& format) { return !format.names_images; };
  const std::string video = warning("--codec h264 --labels " + all_names());
  CHECK_MESSAGE(video.find(names_where(names_images, ", ")) != std::string::npos, video);
  CHECK_MESSAGE(video.find("png") != std::string::npos, video);
  CHECK(warning("--codec h264 --labels " + names_where(names_no_images)).empty());
  CHECK(warning("--codec png --labels " + all_names()).empty());
}

TEST_CASE("numbered images are in the folders of labels as hard links to the same files") {
  const TinyProject tiny;
  sigs_export(tiny, "--codec png --masks none --frames 4-6 --labels " + names_where(is_folder));
  const fs::path image = tiny.file("out/tiny/frame_000004.png");
  for (const LabelFormat& format : label_formats()) {
    if (!format.is_folder) continue;
    const fs::path link = image_in_labels(format.name, 4, 4);
    REQUIRE_MESSAGE(!link.empty(), format.name << ": image_in_labels() in tests/cli/tiny_project.cpp");
    CHECK_MESSAGE(fs::equivalent(image, tiny.file("out") / output_of(format) / link), format.name);
  }
  CHECK(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000003.png")));
  CHECK_FALSE(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000004.png")));
}

TEST_CASE("folders of labels are replaced with --force, unless they contain a foreign file") {
  const TinyProject tiny;
  const std::string labels = "--codec png --masks none --labels " + names_where(is_folder);
  sigs_export(tiny, labels);
  sigs_export(tiny, labels + " --force --frames 0-3");
  CHECK_FALSE(fs::exists(tiny.file("out/tiny.mot/tiny/img1/000005.png")));
  for (const LabelFormat& format : label_formats()) {
    if (!format.is_folder) continue;
    const fs::path own = tiny.file("out") / output_of(format) / "notes.md";
    write_file(own, "mine");
    const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --force " + labels);
    CHECK_MESSAGE(run.status == 73, format.name);
    CHECK_MESSAGE(run.err.find("notes.md") != std::string::npos, run.err);
    fs::remove(own);
  }
}

TEST_CASE("thresholds remove boxes from labels, except where a format has none") {
  const TinyProject tiny;
  const fs::path mot = tiny.file("out/tiny.mot/tiny/gt/gt.txt");
  const std::string options = "--masks none --labels " + all_names();
  sigs_export(tiny, options);
  const int all = lines_of(mot);
  const auto before = contents_of(tiny.out());
  CHECK(all > 0);
  sigs_export(tiny, options + " --force --min-pixels 100000");
  CHECK(lines_of(mot) == 0);
  const auto after = contents_of(tiny.out());
  for (const LabelFormat& format : label_formats())
    if (!format.is_folder)
      CHECK_MESSAGE((after.at(output_of(format)) != before.at(output_of(format))) == format.has_thresholds,
                    format.name);
  sigs_export(tiny, "--masks none --labels mot --force --min-visible 0");
  CHECK(lines_of(mot) == all);
}

TEST_CASE("unknown labels and invalid thresholds exit with status 64, name the option, and write nothing") {
  const TinyProject tiny;
  for (const auto& [given, status, part] :
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
    const std::string options = given;
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
  sigs_export(odd, "--codec png --masks none --labels " + all_names());
  const std::string written = "it's \"a\" & <b> \xC3\xBC, 100%";
  CHECK(fs::exists(odd.file("out") / (written + ".mot") / written / "gt" / "gt.txt"));
  CHECK(fs::exists(odd.file("out") / (written + ".vot") / written / "color" / "00000003.png"));
}
