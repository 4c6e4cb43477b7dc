// SPDX-License-Identifier: MIT
#include "editor/document/recovery.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "editor/document/mask_painting.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

Document edited(const std::string& name, const fs::path& file = {}) {
  Project project;
  project.file = file;
  Document document(std::move(project));
  document.apply(ChangeProject{"rename", [name](Project& p) { p.name = name; }, {}});
  return document;
}

int files_in(const fs::path& folder, const std::string& extension) {
  int count = 0;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) count += entry.path().extension() == extension;
  return count;
}

// Another editor, which ends as by kill -9 while it holds unsaved changes.
void editor_that_dies(const fs::path& folder, const Document& document) {
  const pid_t child = ::fork();
  if (child == 0) {
    Recovery recovery(folder);
    const bool written = recovery.write(document).has_value();
    ::_exit(written ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  REQUIRE(status == 0);
}

}  // namespace

TEST_CASE("unsaved changes are written once they are old enough, and not before") {
  const TemporaryFolder folder;
  Recovery recovery(folder.path());
  const Document document = edited("a");
  CHECK_FALSE(recovery.keep(document, 100, 20));
  CHECK_FALSE(recovery.keep(document, 119.9, 20));
  CHECK(files_in(folder.path(), ".json") == 0);
  CHECK_FALSE(recovery.keep(document, 120, 20));
  CHECK(files_in(folder.path(), ".json") == 1);
}

TEST_CASE("work without a pause is recorded as well: the first unwritten change counts") {
  const TemporaryFolder folder;
  Recovery recovery(folder.path());
  Document document = edited("a");
  for (int second = 0; second <= 20; ++second) {
    document.apply(ChangeProject{"rename", [second](Project& p) { p.name = std::to_string(second); }, {}});
    CHECK_FALSE(recovery.keep(document, second, 20));
  }
  CHECK(files_in(folder.path(), ".json") == 1);
}

TEST_CASE("saving and orderly closing leave nothing behind") {
  const TemporaryFolder folder;
  {
    Recovery recovery(folder / "state");
    Document document = edited("a");
    REQUIRE(recovery.write(document));
    REQUIRE(document.save_as(folder / "p.json"));
    CHECK_FALSE(recovery.keep(document, 0, 20));
    CHECK(files_in(folder / "state", ".json") == 0);
    REQUIRE(recovery.write(document));
    recovery.forget();
  }
  CHECK(fs::is_empty(folder / "state"));
}

TEST_CASE("the recovery file of a crashed editor is found, with its file and name, and reads as it was") {
  const TemporaryFolder folder;
  const Document document = edited("night flight", folder / "somewhere/p.json");
  editor_that_dies(folder / "state", document);
  const std::vector<AbandonedProject> found = abandoned_projects(folder / "state");
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "night flight");
  CHECK(found[0].project_file == folder / "somewhere/p.json");
  CHECK(found[0].written_unix_s > 1'600'000'000);  // some time after the year 2020

  Recovery recovery(folder / "state");
  const auto taken = recovery.take_over(found[0]);
  REQUIRE(taken);
  CHECK(taken->read.project == document.project());
  CHECK_MESSAGE(abandoned_projects(folder / "state").empty(), "it is ours, and we run");
  CHECK_MESSAGE(files_in(folder / "state", ".json") == 1, "until it is saved it stays on disk");
  recovery.forget();
  CHECK(files_in(folder / "state", ".json") == 0);
}

TEST_CASE("a running editor's recovery file is not offered to others") {
  const TemporaryFolder folder;
  Recovery running(folder.path());
  REQUIRE(running.write(edited("a")));
  CHECK(abandoned_projects(folder.path()).empty());
  const AbandonedProject guessed{.recovery_file = [&] {
    for (const auto& entry : fs::directory_iterator(folder.path()))
      if (entry.path().extension() == ".json") return entry.path();
    return fs::path();
  }()};
  Recovery other(folder.path());
  CHECK_FALSE(other.take_over(guessed));
  discard(guessed);
  CHECK(fs::exists(guessed.recovery_file));
}

TEST_CASE("of two editors that recover the same project one gets it") {
  const TemporaryFolder folder;
  editor_that_dies(folder.path(), edited("a"));
  const std::vector<AbandonedProject> found = abandoned_projects(folder.path());
  REQUIRE(found.size() == 1);
  Recovery first(folder.path());
  Recovery second(folder.path());
  CHECK(first.take_over(found[0]));
  const auto late = second.take_over(found[0]);
  REQUIRE_FALSE(late);
  CHECK(late.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("a discarded project is gone with its lock") {
  const TemporaryFolder folder;
  editor_that_dies(folder.path(), edited("a"));
  const std::vector<AbandonedProject> found = abandoned_projects(folder.path());
  REQUIRE(found.size() == 1);
  discard(found[0]);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a folder that cannot be written is reported once, and writing is tried again") {
  const TemporaryFolder folder;
  std::ofstream(folder / "state") << "a file where the folder should be";
  Recovery recovery(folder / "state");
  const Document document = edited("a");
  CHECK_FALSE(recovery.keep(document, 0, 20));
  const std::optional<Error> reported = recovery.keep(document, 20, 20);
  REQUIRE(reported);
  CHECK(reported->text().find("state") != std::string::npos);
  CHECK_FALSE(recovery.keep(document, 40, 20));
  fs::remove(folder / "state");
  CHECK_FALSE(recovery.keep(document, 60, 20));
  CHECK(files_in(folder / "state", ".json") == 1);
}

TEST_CASE("files that are not recovery files are ignored") {
  const TemporaryFolder folder;
  std::ofstream(folder / "notes.json") << "[1, 2";
  std::ofstream(folder / "other.json") << "{\"sigs\": 1}";
  std::ofstream(folder / "editor-1-1.part.json") << "{\"sigs_recovery\": 1}";
  CHECK(abandoned_projects(folder.path()).empty());
  CHECK(abandoned_projects(folder / "nowhere").empty());
}

namespace {

cv::Mat striped_mask(int width_px) {
  cv::Mat mask = cv::Mat::zeros(30, 40, CV_8UC1);
  mask.colRange(0, width_px).setTo(200);
  return mask;
}

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

// The same with a mask that is being painted.
void editor_that_dies(const fs::path& folder, const Document& document, const MaskToKeep& mask) {
  const pid_t child = ::fork();
  if (child == 0) {
    Recovery recovery(folder);
    const bool reported = recovery.keep(document, 0, 0, mask).has_value();
    ::_exit(reported ? 1 : 0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  REQUIRE(status == 0);
}

}  // namespace

TEST_CASE("an unsaved mask is recovered after its editor has ended, also where the project was saved") {
  for (const bool is_saved : {false, true}) {
    const TemporaryFolder folder;
    Document document = edited("a", folder / "p.json");
    if (is_saved) REQUIRE(document.save());
    editor_that_dies(folder / "state", document, {.state = 7, .pixels = striped_mask(9), .has_strokes = true});
    const std::vector<AbandonedProject> found = abandoned_projects(folder / "state");
    REQUIRE(found.size() == 1);
    CHECK(found[0].has_mask);
    CHECK(found[0].problem.empty());

    Recovery recovery(folder / "state");
    const Result<RecoveredProject> taken = recovery.take_over(found[0]);
    REQUIRE(taken);
    CHECK(taken->read.project == document.project());
    REQUIRE(taken->mask);
    CHECK(is_same(taken->mask->pixels, striped_mask(9)));
    CHECK(taken->mask->has_strokes);
    CHECK_MESSAGE(files_in(folder / "state", ".png") == 1, "until it is saved it stays on disk");
    recovery.forget();
    CHECK(files_in(folder / "state", ".png") == 0);
    CHECK(files_in(folder / "state", ".json") == 0);
  }
}

TEST_CASE("a mask is written again when painted on, and not in the middle of a stroke") {
  const TemporaryFolder folder;
  Recovery recovery(folder.path());
  const Document document = edited("a");
  const auto kept = [&] {
    for (const auto& entry : fs::directory_iterator(folder.path()))
      if (entry.path().extension() == ".png") return read_mask(entry.path()).value();
    return cv::Mat();
  };
  CHECK_FALSE(recovery.keep(document, 0, 0, {.state = 3, .pixels = striped_mask(3)}));
  CHECK(is_same(kept(), striped_mask(3)));
  CHECK_FALSE(recovery.keep(document, 1, 0, {.state = 3, .pixels = striped_mask(5), .is_changing = true}));
  CHECK(is_same(kept(), striped_mask(3)));
  CHECK_FALSE(recovery.keep(document, 2, 0, {.state = 4, .pixels = striped_mask(6)}));
  CHECK(is_same(kept(), striped_mask(6)));
  CHECK_FALSE(recovery.keep(document, 3, 0));  // the mask was saved, the project was not
  CHECK(files_in(folder.path(), ".png") == 0);
  CHECK(files_in(folder.path(), ".json") == 1);
}

TEST_CASE("a recovered mask that is painted on takes the place of the one that was taken over") {
  const TemporaryFolder folder;
  const Document document = edited("a");
  editor_that_dies(folder.path(), document, {.state = 7, .pixels = striped_mask(9)});
  Recovery recovery(folder.path());
  REQUIRE(recovery.take_over(abandoned_projects(folder.path()).at(0)));
  CHECK_FALSE(recovery.keep(document, 0, 0, {.state = 2, .pixels = striped_mask(12)}));
  CHECK(files_in(folder.path(), ".png") == 1);
  recovery.forget();
  CHECK(files_in(folder.path(), ".png") == 0);
}

TEST_CASE("a project whose mask is damaged is recovered without it, and says so") {
  const TemporaryFolder folder;
  editor_that_dies(folder.path(), edited("a"), {.state = 7, .pixels = striped_mask(9)});
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.path().extension() == ".png") std::ofstream(entry.path()) << "no image";
  Recovery recovery(folder.path());
  const Result<RecoveredProject> taken = recovery.take_over(abandoned_projects(folder.path()).at(0));
  REQUIRE(taken);
  CHECK(taken->read.project.name == "a");
  CHECK_FALSE(taken->mask);
  CHECK(taken->mask_problem.find(".png") != std::string::npos);
}

TEST_CASE("a discarded project takes its mask with it") {
  const TemporaryFolder folder;
  editor_that_dies(folder.path(), edited("a"), {.state = 7, .pixels = striped_mask(9)});
  discard(abandoned_projects(folder.path()).at(0));
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a recovery file that cannot be read is reported, after those that can, and can be discarded") {
  const TemporaryFolder folder;
  std::ofstream(folder / "editor-1-1.json") << "{\"sigs_recovery\": 1, \"name\": \"cut o";
  std::ofstream(folder / "editor-1-2.json") << "";
  editor_that_dies(folder.path(), edited("a"));
  const std::vector<AbandonedProject> found = abandoned_projects(folder.path());
  REQUIRE(found.size() == 3);
  CHECK(found[0].problem.empty());
  for (const std::size_t i : {1, 2}) {
    CHECK_FALSE(found[i].problem.empty());
    CHECK(found[i].recovery_file.filename().string().starts_with("editor-1-"));
    discard(found[i]);
  }
  CHECK(abandoned_projects(folder.path()).size() == 1);
}
