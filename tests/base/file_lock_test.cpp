// SPDX-License-Identifier: MIT

#include <sys/stat.h>

#include <doctest/doctest.h>
#include <cerrno>
#include <fstream>

#include "base/file_lock.h"
#include "support/test_data.h"

using namespace sigs;

TEST_CASE("only EWOULDBLOCK means that a lock is held") {
  CHECK(lock_answer(0) == LockAnswer::held);
  CHECK(lock_answer(EWOULDBLOCK) == LockAnswer::taken);
  for (const int error : {ENOLCK, ENOSYS, EOPNOTSUPP, EINVAL, EIO, ESTALE, EBADF})
    CHECK(lock_answer(error) == LockAnswer::unavailable);
}

TEST_CASE("a lock excludes others until it is released") {
  const test::TemporaryFolder folder;
  Descriptor first = open_for_lock(folder / "lock", LockFile::made_where_missing);
  const Descriptor second = open_for_lock(folder / "lock", LockFile::must_be_there);
  CHECK_FALSE(is_locked_by_another(second));
  CHECK(try_lock(first) == LockAnswer::held);
  CHECK(is_locked_by_another(second));
  CHECK(try_lock(second) == LockAnswer::taken);
  first.reset();
  CHECK(try_lock(second) == LockAnswer::held);
}

TEST_CASE("a lock file is a regular file, keeps its contents, and is recognized by its name") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "mine";
  const Descriptor file = open_for_lock(folder / "file", LockFile::made_where_missing);
  REQUIRE(file.is_open());
  CHECK(std::filesystem::file_size(folder / "file") == 4);
  CHECK(is_named(file, folder / "file"));
  std::filesystem::rename(folder / "file", folder / "renamed");
  CHECK_FALSE(is_named(file, folder / "file"));
  std::filesystem::create_symlink(folder / "renamed", folder / "link");
  CHECK_FALSE(open_for_lock(folder / "link", LockFile::made_where_missing).is_open());
  REQUIRE(mkfifo((folder / "fifo").c_str(), 0600) == 0);
  CHECK_FALSE(open_for_lock(folder / "fifo", LockFile::must_be_there).is_open());
  CHECK_FALSE(open_for_lock(folder / "none", LockFile::must_be_there).is_open());
}
