// SPDX-License-Identifier: MIT
#pragma once

#include "editor/preview/background_job.h"

namespace sigs::editor {

// A bar with the frames that are done, and the button "Stop" below it, which is the item drawn last. True when the
// button is clicked.
[[nodiscard]] bool draw_job_progress(int done, int total, bool is_stopping);

template <class Request, class Value>
[[nodiscard]] bool draw_job_progress(const JobState<Request, Value>& state) {
  return draw_job_progress(state.done, state.total, state.is_stopping);
}

}  // namespace sigs::editor
