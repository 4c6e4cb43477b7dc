// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "base/staged_outputs.h"
#include "support/test_data.h"

using namespace sigs;
namespace fs = std::filesystem;

namespace {

int files_in(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// What a run leaves that is killed while it writes x.txt and the folder y.
void killed_run(const fs::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    const Result<TemporaryFile> file = TemporaryFile::create(folder / "x.txt", true);
    const Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", true);
    if (!file || !images) _exit(1);
    test::write_file(file->temporary_path(), "half");
    test::write_file(images->temporary_path() / "half.png", "half");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
}

fs::path staging_in(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (fs::is_directory(entry.path())) return entry.path();
  return {};
}

}  // namespace

TEST_CASE("a file without commit leaves nothing behind") {
  const test::TemporaryFolder folder;
  {
    const Result<TemporaryFile> file = TemporaryFile::create(folder / "x.mkv", false);
    REQUIRE(file.has_value());
    CHECK(file->temporary_path().extension() == ".mkv");
    test::write_file(file->temporary_path(), "half");
  }
  CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("after commit a file has its final name and nothing else exists") {
  const test::TemporaryFolder folder;
  Result<TemporaryFile> file = TemporaryFile::create(folder / "x.txt", false);
  REQUIRE(file.has_value());
  test::write_file(file->temporary_path(), "whole");
  CHECK_FALSE(fs::exists(folder / "x.txt"));
  REQUIRE(file->commit().has_value());
  CHECK(read_text(folder / "x.txt").value() == "whole");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("an existing file stays unless overwriting was asked for") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "x.txt", "old");
  const Result<void> refused = write_text(folder / "x.txt", "new", false);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().kind == ErrorKind::cannot_create);
  CHECK(read_text(folder / "x.txt").value() == "old");
  REQUIRE(write_text(folder / "x.txt", "new", true).has_value());
  CHECK(read_text(folder / "x.txt").value() == "new");
}

TEST_CASE("a moved TemporaryFile is removed once, by its last owner") {
  const test::TemporaryFolder folder;
  Result<TemporaryFile> first = TemporaryFile::create(folder / "x.txt", false);
  REQUIRE(first.has_value());
  test::write_file(first->temporary_path(), "half");
  const fs::path part = first->temporary_path();
  {
    const TemporaryFile second = std::move(*first);
    CHECK(fs::exists(part));
  }
  CHECK_FALSE(fs::exists(part));
}

TEST_CASE("errors for a missing folder and a missing file name them") {
  const test::TemporaryFolder folder;
  const Result<TemporaryFile> file = TemporaryFile::create(folder / "no" / "x.txt", false);
  REQUIRE_FALSE(file.has_value());
  CHECK(file.error().kind == ErrorKind::cannot_create);
  const Result<std::string> text = read_text(folder / "no.txt");
  REQUIRE_FALSE(text.has_value());
  CHECK(text.error().kind == ErrorKind::cannot_read);
  CHECK(text.error().text().find("no.txt: no such file") != std::string::npos);
}

TEST_CASE("a full disk is an error and leaves nothing under the final name") {
  const test::TemporaryFolder folder;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{4096, before.rlim_max};  // no file can grow beyond it
  REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  const Result<void> written = write_text(folder / "x.txt", std::string(100'000, 'x'), false);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().kind == ErrorKind::write_failed);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("an empty file reads as empty text") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "empty.txt", "");
  CHECK(read_text(folder / "empty.txt").value().empty());
}

TEST_CASE("two writers of one name never mix, and the second gets an error") {
  const test::TemporaryFolder folder;
  {
    const Result<TemporaryFile> first = TemporaryFile::create(folder / "x.txt", true);
    REQUIRE(first.has_value());
    const Result<TemporaryFile> second = TemporaryFile::create(folder / "x.txt", true);
    REQUIRE_FALSE(second.has_value());
    CHECK(second.error().kind == ErrorKind::cannot_create);
    CHECK(second.error().text().find("is being written by another process") != std::string::npos);
    CHECK(fs::exists(first->temporary_path()));
  }
  CHECK(TemporaryFile::create(folder / "x.txt", true).has_value());
}

TEST_CASE("the remains of a killed process do not block later ones") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "x.part.txt", "half");
  Result<TemporaryFile> file = TemporaryFile::create(folder / "x.txt", false);
  REQUIRE(file.has_value());
  test::write_file(file->temporary_path(), "whole");
  REQUIRE(file->commit().has_value());
  CHECK(read_text(folder / "x.txt").value() == "whole");
  fs::create_directory(folder / "y.part");
  test::write_file(folder / "y.part/stale.png", "old");
  Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", false);
  REQUIRE(images.has_value());
  CHECK(fs::is_empty(images->temporary_path()));
  REQUIRE(images->commit().has_value());
  CHECK(fs::is_directory(folder / "y"));
}

TEST_CASE("a file does not replace a folder of its name") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "x.mkv");
  const Result<TemporaryFile> file = TemporaryFile::create(folder / "x.mkv", true);
  REQUIRE_FALSE(file.has_value());
  CHECK(file.error().kind == ErrorKind::cannot_create);
}

TEST_CASE("the next run in a folder removes what a killed run left") {
  const test::TemporaryFolder folder;
  killed_run(folder.path());
  REQUIRE(files_in(folder.path()) > 0);
  REQUIRE(write_text(folder / "other.txt", "whole", false));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("the next run removes what a run left that was killed before or after it had a lock file") {
  const test::TemporaryFolder folder;
  killed_run(folder.path());
  const fs::path staging = staging_in(folder.path());
  const std::string lock = read_text(staging / "lock").value();
  for (const std::string& begun : {lock, lock.substr(0, 9), std::string()}) {
    fs::remove_all(staging);
    fs::create_directory(staging);
    fs::permissions(staging, fs::perms::owner_all);
    test::write_file(staging / "lock.part", begun);
    REQUIRE(write_text(folder / "other.txt", "whole", true));
    CHECK_MESSAGE(!fs::exists(staging), begun);
  }
  fs::create_directory(staging);
  fs::permissions(staging, fs::perms::owner_all);
  REQUIRE(write_text(folder / "other.txt", "whole", true));
  CHECK_FALSE(fs::exists(staging));
}

TEST_CASE("folders that may belong to another program are kept, whatever their name") {
  const auto stays = [](const char* what, auto&& change) {
    const test::TemporaryFolder folder;
    killed_run(folder.path());
    const fs::path staging = staging_in(folder.path());
    REQUIRE(!staging.empty());
    change(staging);
    REQUIRE(write_text(folder / "other.txt", "whole", false));
    CHECK_MESSAGE(fs::exists(staging), what);
  };
  stays("others may look into it", [](const fs::path& staging) { fs::permissions(staging, fs::perms(0755)); });
  stays("it has no lock file", [](const fs::path& staging) { fs::remove(staging / "lock"); });
  stays("its lock file says something else",
        [](const fs::path& staging) { test::write_file(staging / "lock", "mine"); });
  stays("its lock file is a link", [](const fs::path& staging) {
    fs::rename(staging / "lock", staging.parent_path() / "lock");
    fs::create_symlink(staging.parent_path() / "lock", staging / "lock");
  });
}

TEST_CASE("a folder that happens to be named like a staging folder is left unchanged") {
  const test::TemporaryFolder folder;
  for (const char* const name : {".sigs-abcdef", ".sigs-XXXXXX"}) {
    fs::create_directory(folder / name);
    fs::permissions(folder / name, fs::perms::owner_all);
    test::write_file(folder / name / "mine.txt", "mine");
  }
  fs::create_directory(folder / ".sigs-012345");
  fs::permissions(folder / ".sigs-012345", fs::perms::owner_all);
  test::write_file(folder / ".sigs-012345/lock.part", "mine");
  fs::create_directory(folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / ".sigs-123456");
  REQUIRE(write_text(folder / "x.txt", "whole", false));
  CHECK(read_text(folder / ".sigs-abcdef/mine.txt").value() == "mine");
  CHECK(read_text(folder / ".sigs-XXXXXX/mine.txt").value() == "mine");
  CHECK(read_text(folder / ".sigs-012345/lock.part").value() == "mine");
  CHECK(fs::is_symlink(folder / ".sigs-123456"));
}

TEST_CASE("nothing that existed before is opened, followed or removed") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "target", "mine");
  test::write_file(folder / "x.part.txt", "mine");
  fs::create_symlink(folder / "target", folder / "z.part.txt");
  fs::create_directory(folder / "y.part");
  test::write_file(folder / "y.part/mine.png", "mine");
  REQUIRE(write_text(folder / "x.txt", "whole", false));
  REQUIRE(write_text(folder / "z.txt", "whole", false));
  Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", false);
  REQUIRE(images);
  REQUIRE(images->commit());
  for (const char* const name : {"target", "x.part.txt", "y.part/mine.png"})
    CHECK(read_text(folder / name).value_or("gone") == "mine");
  CHECK(fs::is_symlink(folder / "z.part.txt"));
}

TEST_CASE("a file created by others under the final name during the work is kept") {
  const test::TemporaryFolder folder;
  Result<TemporaryFile> file = TemporaryFile::create(folder / "x.txt", false);
  Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", false);
  REQUIRE(file);
  REQUIRE(images);
  test::write_file(folder / "x.txt", "mine");
  fs::create_directory(folder / "y");
  const Result<void> kept = file->commit();
  REQUIRE_FALSE(kept);
  CHECK(kept.error().kind == ErrorKind::cannot_create);
  CHECK_FALSE(images->commit());
  CHECK(read_text(folder / "x.txt").value() == "mine");
}

TEST_CASE("a folder that was written into during the work is not replaced") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "y");
  test::write_file(folder / "y/old.png", "old");
  const auto may_replace = [](const fs::path& there) {
    return fs::exists(there / "mine.txt")
               ? Result<void>(fail(there.string(), "holds mine.txt", ErrorKind::cannot_create))
               : Result<void>();
  };
  {
    Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", true, may_replace);
    REQUIRE(images);
    test::write_file(images->temporary_path() / "new.png", "new");
    test::write_file(folder / "y/mine.txt", "mine");
    const Result<void> kept = images->commit();
    REQUIRE_FALSE(kept);
    CHECK(kept.error().text().find((folder / "y").string() + ": holds mine.txt") != std::string::npos);
  }
  CHECK(read_text(folder / "y/mine.txt").value() == "mine");
  CHECK(read_text(folder / "y/old.png").value() == "old");
  CHECK_FALSE(fs::exists(folder / "y/new.png"));
  CHECK(files_in(folder.path()) == 1);
  fs::remove(folder / "y/mine.txt");
  Result<TemporaryFile> again = TemporaryFile::create_folder(folder / "y", true, may_replace);
  REQUIRE(again);
  REQUIRE(again->commit());
  CHECK(fs::is_empty(folder / "y"));
}

TEST_CASE("outputs that belong together all get their final names, or none does") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "a.txt", "old");
  StagedOutputs outputs(StagedOutputs::Existing::replace);
  for (const char* const name : {"a.txt", "b.txt", "c.txt"}) {
    const Result<fs::path> staged = outputs.add_file(folder / name);
    REQUIRE(staged);
    CHECK(staged->filename() == name);
    test::write_file(*staged, "new");
  }
  fs::create_directory(folder / "c.txt");  // a file is not written over a folder
  REQUIRE_FALSE(outputs.commit());
  CHECK(read_text(folder / "a.txt").value() == "old");
  CHECK_FALSE(fs::exists(folder / "b.txt"));
  CHECK(fs::is_directory(folder / "c.txt"));
}

TEST_CASE("a file replaces only files, and a folder only folders") {
  const test::TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "fifo").c_str(), 0600) == 0);
  CHECK_FALSE(TemporaryFile::create(folder / "fifo", true));
  test::write_file(folder / "file", "mine");
  CHECK_FALSE(TemporaryFile::create_folder(folder / "file", true));
  fs::create_symlink(folder / "nowhere", folder / "dangling");
  CHECK_FALSE(TemporaryFile::create(folder / "dangling", false));
}

TEST_CASE("replacing a symbolic link leaves its target alone") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "target", "mine");
  fs::create_symlink(folder / "target", folder / "x.txt");
  REQUIRE(write_text(folder / "x.txt", "new", true));
  CHECK_FALSE(fs::is_symlink(folder / "x.txt"));
  CHECK(read_text(folder / "x.txt").value() == "new");
  CHECK(read_text(folder / "target").value() == "mine");
}

TEST_CASE("many writers of one folder leave complete files and nothing else") {
  const test::TemporaryFolder folder;
  std::vector<std::thread> writers;
  for (int writer = 0; writer < 4; ++writer)
    writers.emplace_back([&folder, writer] {
      for (int i = 0; i < 50; ++i) {
        const Result<void> own = write_text(folder / ("own" + std::to_string(writer)), std::string(1000, 'o'), true);
        if (!own) std::abort();
        static_cast<void>(write_text(folder / "shared", std::string(1000, static_cast<char>('a' + writer)), true));
      }
    });
  for (std::thread& writer : writers) writer.join();
  CHECK(files_in(folder.path()) == 5);
  const std::string shared = read_text(folder / "shared").value();
  CHECK(shared == std::string(1000, shared.front()));
}

TEST_CASE("the mode of a file is the user's, not the staging folder's") {
  const test::TemporaryFolder folder;
  const mode_t before = umask(027);
  REQUIRE(write_text(folder / "x.txt", "x", false));
  Result<TemporaryFile> images = TemporaryFile::create_folder(folder / "y", false);
  umask(before);
  REQUIRE(images);
  REQUIRE(images->commit());
  CHECK(fs::status(folder / "x.txt").permissions() == fs::perms(0640));
  CHECK(fs::status(folder / "y").permissions() == fs::perms(0750));
}

namespace {

std::atomic<pid_t> taken_by{0};

// Replaces a folder on a thread that blocks SIGTERM, and calls `send` in the middle. Which thread takes the signal
// within two seconds; 0: none.
pid_t thread_that_takes(const std::function<void()>& send) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "out");
  taken_by = 0;
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = [](int) { taken_by = static_cast<pid_t>(syscall(SYS_gettid)); };
  sigaction(SIGTERM, &action, &before);
  std::thread other([&] {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    StagedOutputs outputs(StagedOutputs::Existing::replace);
    if (!outputs.add_folder(folder / "out", [&](const fs::path& older) {
          if (older == folder / "out") return Result<void>();  // asked before the names change, too
          send();
          std::this_thread::sleep_for(std::chrono::milliseconds(100));  // so that it comes while it is held back
          CHECK(taken_by == 0);
          return Result<void>();
        }))
      return;
    CHECK(outputs.commit());
  });
  for (int i = 0; i < 2000 && taken_by == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  other.join();
  sigaction(SIGTERM, &before, nullptr);
  return taken_by;
}

}  // namespace

TEST_CASE("a signal held back by a thread that blocks it goes to one that does not, as the system would send it") {
  CHECK(thread_that_takes([] { kill(getpid(), SIGTERM); }) == getpid());
}

TEST_CASE("a signal to one thread goes to that thread, whichever thread held it back") {
  std::atomic<pid_t> wanted{0};
  std::atomic<bool> done{false};
  std::thread target([&] {
    wanted = static_cast<pid_t>(syscall(SYS_gettid));
    while (!done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  while (wanted == 0) std::this_thread::yield();
  CHECK(thread_that_takes([&] { pthread_kill(target.native_handle(), SIGTERM); }) == wanted);
  done = true;
  target.join();
}
