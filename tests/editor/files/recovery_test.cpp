// SPDX-License-Identifier: MIT
#include "editor/document/recovery.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

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

TEST_CASE("a person who never pauses is kept as well: the first unwritten change counts") {
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

TEST_CASE("what a dead editor left is found, with its file and name, and reads as it was") {
  const TemporaryFolder folder;
  const Document document = edited("night flight", folder / "somewhere/p.json");
  editor_that_dies(folder / "state", document);
  const std::vector<AbandonedProject> found = abandoned_projects(folder / "state");
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "night flight");
  CHECK(found[0].project_file == folder / "somewhere/p.json");
  CHECK(found[0].written_unix_s > 1'600'000'000);  // some time after the year 2020

  Recovery recovery(folder / "state");
  const Result<ReadProject> read = recovery.take_over(found[0]);
  REQUIRE(read);
  CHECK(read->project == document.project());
  CHECK_MESSAGE(abandoned_projects(folder / "state").empty(), "it is ours, and we run");
  CHECK_MESSAGE(files_in(folder / "state", ".json") == 1, "until it is saved it stays on disk");
  recovery.forget();
  CHECK(files_in(folder / "state", ".json") == 0);
}

TEST_CASE("a running editor's changes are no one else's") {
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
  const Result<ReadProject> late = second.take_over(found[0]);
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

TEST_CASE("a folder that cannot be written is told of once, and writing is tried again") {
  const TemporaryFolder folder;
  std::ofstream(folder / "state") << "a file where the folder should be";
  Recovery recovery(folder / "state");
  const Document document = edited("a");
  CHECK_FALSE(recovery.keep(document, 0, 20));
  const std::optional<Error> told = recovery.keep(document, 20, 20);
  REQUIRE(told);
  CHECK(told->text().find("state") != std::string::npos);
  CHECK_FALSE(recovery.keep(document, 40, 20));
  fs::remove(folder / "state");
  CHECK_FALSE(recovery.keep(document, 60, 20));
  CHECK(files_in(folder / "state", ".json") == 1);
}

TEST_CASE("files that are no recovery files are passed over") {
  const TemporaryFolder folder;
  std::ofstream(folder / "notes.json") << "[1, 2";
  std::ofstream(folder / "other.json") << "{\"sigs\": 1}";
  std::ofstream(folder / "editor-1-1.part.json") << "{\"sigs_recovery\": 1}";
  CHECK(abandoned_projects(folder.path()).empty());
  CHECK(abandoned_projects(folder / "nowhere").empty());
}
