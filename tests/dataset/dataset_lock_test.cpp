// SPDX-License-Identifier: MIT
#include "dataset/dataset_lock.h"

#include <doctest/doctest.h>

#include <optional>

#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("shards contain every video exactly once, and overlap where one video is in both") {
  for (int parts = 1; parts <= 7; ++parts) {
    for (int video = 0; video < 50; ++video) {
      int times = 0;
      for (int part = 1; part <= parts; ++part) times += Shard{part, parts}.has(video) ? 1 : 0;
      CHECK(times == 1);
    }
    for (int others = 1; others <= 7; ++others)
      for (int a = 1; a <= parts; ++a)
        for (int b = 1; b <= others; ++b) {
          bool both = false;
          for (int video = 0; video < parts * others; ++video)
            both |= Shard{a, parts}.has(video) && Shard{b, others}.has(video);
          CHECK(overlap({a, parts}, {b, others}) == both);
        }
  }
}

TEST_CASE("of two runs that would make the same video the second is refused, others are not") {
  const TemporaryFolder folder;
  {
    const Result<DatasetLock> first = DatasetLock::acquire(folder.path(), {2, 3});
    REQUIRE(first);
    CHECK(DatasetLock::acquire(folder.path(), {2, 3}).error().kind == ErrorKind::cannot_create);
    CHECK(DatasetLock::acquire(folder.path(), {1, 1}).error().kind == ErrorKind::cannot_create);
    CHECK(DatasetLock::acquire(folder.path(), {1, 2}).error().what ==
          "another run is making part 2 of 3 of it; wait until it has ended");
    CHECK(DatasetLock::acquire(folder.path(), {1, 3}));
    CHECK(DatasetLock::acquire(folder.path(), {5, 6}).error().kind == ErrorKind::cannot_create);
    CHECK(DatasetLock::acquire(folder.path(), {6, 6}));
  }
  CHECK_MESSAGE(std::filesystem::is_empty(folder.path()), "the claims are gone with their owners");
  CHECK(DatasetLock::acquire(folder.path(), {1, 1}));
}

TEST_CASE("the remains of a killed run block no other run") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(staging_folder_of(folder.path()));
  write_file(staging_folder_of(folder.path()) / "2-of-3.lock", "");
  write_file(staging_folder_of(folder.path()) / "1-of-1.lock", "");
  CHECK(DatasetLock::acquire(folder.path(), {2, 3}));
  CHECK(DatasetLock::acquire(folder.path(), {1, 1}));
}
