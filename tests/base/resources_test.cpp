// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "base/paths.h"
#include "base/resources.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;

namespace fs = std::filesystem;

TEST_CASE("a program that runs from its build folder finds the assets of its source tree") {
  const Result<fs::path> folder = resource_folder();
  REQUIRE(folder);
  CHECK(canonical_path(*folder) == canonical_path(test::source_dir()));
  const Result<fs::path> model = resource_file("assets/models/light-aircraft/light-aircraft.obj");
  REQUIRE(model);
  CHECK(test::text_of(*model) == test::text_of(test::source_dir() / "assets/models/light-aircraft/light-aircraft.obj"));
  const Result<fs::path> none = resource_file("assets/models/none.obj");
  REQUIRE_FALSE(none);
  CHECK(none.error().kind == ErrorKind::cannot_read);
  CHECK(none.error().text().find("none.obj") != std::string::npos);
}

TEST_CASE("an installed program and a library below it find share/sigs, the nearest one first") {
  const test::TemporaryFolder root;
  fs::create_directories(root / "usr/share/sigs/assets/models");
  fs::create_directories(root / "usr/local/share/sigs/assets/models");
  CHECK(resource_folder_for(root / "usr/bin/sigs").value() == root / "usr/share/sigs");
  CHECK(resource_folder_for(root / "usr/local/bin/sigs").value() == root / "usr/local/share/sigs");
  CHECK(resource_folder_for(root / "usr/lib/python3/dist-packages/sigs/_sigs.so").value() == root / "usr/share/sigs");
  // A wheel brings its own.
  fs::create_directories(root / "venv/site-packages/sigs/share/sigs/assets/models");
  CHECK(resource_folder_for(root / "venv/site-packages/sigs/_sigs.so").value() ==
        root / "venv/site-packages/sigs/share/sigs");
}

TEST_CASE("assets of something else are not taken for those of SIGS, and the error says what is missing") {
  const test::TemporaryFolder root;
  fs::create_directories(root / "assets/models");  // no projects beside it
  const Result<fs::path> folder = resource_folder_for(root / "a/b/c/d/e/f/g/h/i/sigs");
  REQUIRE_FALSE(folder);
  CHECK(folder.error().kind == ErrorKind::cannot_read);
  CHECK(folder.error().text().find("share/sigs/assets/models") != std::string::npos);
  CHECK_FALSE(resource_folder_for("sigs"));
}
