// SPDX-License-Identifier: MIT
// Under final names there is a complete result at every moment: the older one until the newer one is complete.
#include <doctest/doctest.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <string>

#include "base/text.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "cli/tiny_recipe.h"
#include "occlusion/synthetic_clip.h"
#include "project/project.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kKilled = 128 + 9;
constexpr const char* kNoFlags = "SIGS_TEST_NO_RENAMEAT2=1 ";

int image_count(const fs::path& folder) {
  return fs::exists(folder) ? static_cast<int>(std::distance(fs::directory_iterator(folder), {})) : 0;
}

bool has_staging_folder(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(".sigs-")) return true;
  return false;
}

// Ten frames exported as images, masks and labels; replacing them asks for five, so that old and new differ.
struct Exported {
  TinyProject tiny;
  std::string command = "export " + tiny.project() + " --codec png --masks png --labels xml,kitti --out " + tiny.out();
  std::map<std::string, std::string> older;

  Exported() {
    REQUIRE(run_sigs(command).status == 0);
    older = contents_of(tiny.out());
  }
  [[nodiscard]] std::string replacing() const { return command + " --force --frames 0-4"; }

  // Old or new, but complete.
  void check_whole(const std::string& when) const {
    for (const char* const name : {"tiny", "tiny.masks", "tiny.kitti/image_02/tiny"}) {
      const int count = image_count(fs::path(tiny.out()) / name);
      CHECK_MESSAGE((count == 10 || count == 5), when << ": " << name << " has " << count << " images");
    }
    for (const char* const name : {"tiny.xml", "tiny.kitti"})
      CHECK_MESSAGE(fs::exists(fs::path(tiny.out()) / name), when << ": " << name);
  }
};

}  // namespace

TEST_CASE("labels of a flight with a place on the Earth are replaced in every format") {
  const TinyProject tiny;
  const std::string command = "export " + tiny.project() +
                              " --masks none --set geo.latitude_deg=47 --set geo.longitude_deg=8 --labels " +
                              listed(kLabelNames, ",") + " --out " + tiny.out();
  REQUIRE(run_sigs(command).status == 0);
  CHECK(fs::exists(fs::path(tiny.out()) / "tiny.kitti/poses/tiny.txt"));
  const Run again = run_sigs(command + " --force");
  CHECK_MESSAGE(again.status == 0, again.err);
}

TEST_CASE("killed before any of its renamings, an export has left whole results under all final names") {
  const Exported exported;
  int kills = 0;
  for (int number = 1; number < 40; ++number) {
    const Run run = run_sigs_with_fault("SIGS_TEST_KILL_AT=" + std::to_string(number), exported.replacing());
    if (run.status == 0) break;
    REQUIRE_MESSAGE(run.status == kKilled, run.err);
    ++kills;
    exported.check_whole("killed at " + std::to_string(number));
  }
  CHECK(kills >= 4);  // one output at least is renamed once each
  exported.check_whole("at the end");
  CHECK(image_count(fs::path(exported.tiny.out()) / "tiny") == 5);
  CHECK_FALSE(has_staging_folder(exported.tiny.out()));
}

TEST_CASE("where folders cannot be exchanged, the next run puts back what a killed one had moved aside") {
  const Exported exported;
  int kills = 0;
  for (int number = 1; number < 40; ++number) {
    const Run run =
        run_sigs_with_fault(kNoFlags + ("SIGS_TEST_KILL_AT=" + std::to_string(number)), exported.replacing());
    if (run.status == 0) break;
    REQUIRE_MESSAGE(run.status == kKilled, run.err);
    ++kills;
    const Run other = run_sigs("frame " + exported.tiny.project() + " --frame 0 --force --out " + exported.tiny.out());
    CHECK_MESSAGE(other.status == 0, other.err);
    exported.check_whole("killed at " + std::to_string(number));
    CHECK_FALSE(has_staging_folder(exported.tiny.out()));
  }
  CHECK(kills >= 4);
}

TEST_CASE("one renaming that fails leaves every older result where it was") {
  const Exported exported;
  for (const char* const before : {"", kNoFlags}) {
    for (const char* const name : {"tiny", "tiny.masks", "tiny.xml", "tiny.kitti"}) {
      const Run run =
          run_sigs_with_fault(before + (std::string("SIGS_TEST_FAIL_RENAME=") + name), exported.replacing());
      CHECK_MESSAGE(run.status == 74, name << ": " << run.err);
      CHECK_MESSAGE(run.err.find(std::string("/") + name) != std::string::npos, run.err);
      CHECK_MESSAGE(contents_of(exported.tiny.out()) == exported.older, name);
    }
  }
}

TEST_CASE("one renaming that fails leaves no new result either") {
  const TinyProject tiny;
  for (const char* const name : {"tiny.mkv", "tiny.masks.mkv", "tiny.xml"}) {
    const Run run = run_sigs_with_fault(std::string("SIGS_TEST_FAIL_RENAME=") + name,
                                        "export " + tiny.project() + " --out " + tiny.out());
    CHECK_MESSAGE(run.status == 74, run.err);
    CHECK_MESSAGE(tiny.files_out() == 0, name);
  }
}

TEST_CASE("signals are deferred while outputs get their final names") {
  const Exported exported;
  for (int number = 1; number <= 12; ++number) {
    const Run run = run_sigs_with_fault("SIGS_TEST_TERM_AT=" + std::to_string(number), exported.replacing());
    const bool was_reported = run.err.find("interrupted") != std::string::npos;
    CHECK_MESSAGE((run.status == 0 || was_reported), number << ": killed half way, status " << run.status);
    exported.check_whole("signalled at " + std::to_string(number));
    CHECK(image_count(fs::path(exported.tiny.out()) / "tiny") ==
          image_count(fs::path(exported.tiny.out()) / "tiny.masks"));
    CHECK_FALSE(has_staging_folder(exported.tiny.out()));
  }
}

TEST_CASE("outputs are written to file systems without rename flags or without locks too") {
  for (const std::string& fault :
       {std::string(kNoFlags), "SIGS_TEST_FLOCK=" + std::to_string(ENOLCK), "SIGS_TEST_FLOCK=" + std::to_string(ENOSYS),
        "SIGS_TEST_FLOCK=" + std::to_string(EOPNOTSUPP), "SIGS_TEST_FLOCK=" + std::to_string(EINVAL)}) {
    const TinyProject tiny;
    const std::string command = "export " + tiny.project() + " --codec png --labels xml,kitti --out " + tiny.out();
    const Run first = run_sigs_with_fault(fault, command);
    CHECK_MESSAGE(first.status == 0, fault << ": " << first.err);
    const std::map<std::string, std::string> written = contents_of(tiny.out());
    CHECK(written.size() > 10);
    const Run kept = run_sigs_with_fault(fault, command);
    CHECK_MESSAGE(kept.status == 73, kept.err);
    CHECK(contents_of(tiny.out()) == written);
    const Run again = run_sigs_with_fault(fault, command + " --force");
    CHECK_MESSAGE(again.status == 0, again.err);
    CHECK(contents_of(tiny.out()) == written);
    write_flight(tiny.file("flight.mkv"), 10);
    const Run mask = run_sigs_with_fault(
        fault, "mask " + tiny.file("flight.mkv").string() + " --method paper --out " + tiny.file("m.png").string());
    CHECK_MESSAGE(mask.status == 0, mask.err);
    CHECK_FALSE(has_staging_folder(tiny.file("")));
    const TinyRecipe recipe;
    const Run dataset = run_sigs_with_fault(fault, recipe.arguments("out"));
    CHECK_MESSAGE(dataset.status == 0, dataset.err);
  }
}

TEST_CASE("a dataset's video that cannot be renamed leaves the older one in place") {
  const TinyRecipe recipe;
  REQUIRE(recipe.run("out").status == 0);
  const auto video = [&] { return contents_of(fs::path(recipe.out("out")) / "red LR"); };
  const std::map<std::string, std::string> older = video();
  for (const char* const before : {"", kNoFlags}) {
    const Run run = run_sigs_with_fault(before + std::string("SIGS_TEST_FAIL_RENAME='red LR'"),
                                        recipe.arguments("out", "--resume --set camera.speed_mps=33"));
    CHECK_MESSAGE(run.status == 74, run.err);
    CHECK(video() == older);
  }
}

}  // namespace sigs::test
