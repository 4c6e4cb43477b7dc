// SPDX-License-Identifier: MIT
#include "editor/views/start_page.h"

#include <doctest/doctest.h>

#include "editor/views/dialogs.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("the start page offers projects, and no recipes of datasets") {
  const std::vector<SampleProject> samples = samples_in(test::source_dir() / "projects");
  CHECK(samples.size() >= 2);
  for (const SampleProject& sample : samples) {
    CAPTURE(sample.name);
    CHECK(read_project(sample.file));
    CHECK_FALSE(sample.text.empty());
  }
  CHECK(samples_in("/nowhere").empty());
}

TEST_CASE("every message passes by itself, errors after a longer time, and another project's start takes all away") {
  Toasts toasts;
  toasts.show({"Saved"}, 100);
  toasts.show({"cannot be read", true}, 100);
  toasts.pass(102);
  CHECK(toasts.count() == 2);
  toasts.pass(108);
  CHECK(toasts.count() == 1);  // the error
  CHECK(toasts.is_passing());
  toasts.pass(130);
  CHECK(toasts.count() == 0);
  CHECK_FALSE(toasts.is_passing());
  toasts.show({"cannot be read", true}, 200);
  toasts.clear();
  CHECK(toasts.count() == 0);
}
