// SPDX-License-Identifier: MIT
#include "editor/views/export_view.h"

#include <doctest/doctest.h>

#include <string>
#include <utility>

using namespace sigs::editor;

namespace {

ExportState exporting(int done, int total, double left_s) {
  ExportState state;
  state.phase = JobPhase::running;
  state.done = done;
  state.total = total;
  state.left_s = left_s;
  return state;
}

}  // namespace

TEST_CASE("menu bar and dialog give the same time left, rounded to seconds and with hours") {
  for (const auto& [left_s, text] : {std::pair{4.6, "0:05"}, std::pair{4510.0, "1:15:10"}}) {
    const ExportState state = exporting(37, 100, left_s);
    CHECK(short_progress_text(state) == std::string("Export 37 %, ") + text + " left");
    CHECK(progress_text(state) == std::string("37 of 100 frames, ") + text + " left");
  }
}

TEST_CASE("an export of one frame is not said to have frames") {
  CHECK(progress_text(exporting(0, 1, 2)).starts_with("0 of 1 frame,"));
  CHECK(progress_text(exporting(1, 1, 0)).starts_with("1 of 1 frame,"));
}

TEST_CASE("an export whose length is not known has begun, without a share") {
  CHECK(short_progress_text(exporting(0, 0, 0)).find('%') == std::string::npos);
}
