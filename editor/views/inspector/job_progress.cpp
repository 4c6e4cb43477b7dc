// SPDX-License-Identifier: MIT
#include "editor/views/inspector/job_progress.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

namespace sigs::editor {

bool draw_job_progress(int done, int total, bool is_stopping) {
  const float share = total > 0 ? static_cast<float>(done) / static_cast<float>(total) : 0;
  const std::string text = total > 0 ? fmt::format("{} of {} frames", done, total) : "reading";
  ImGui::ProgressBar(share, {-1, 0}, text.c_str());
  ImGui::BeginDisabled(is_stopping);
  const bool is_clicked = ImGui::Button("Stop");
  ImGui::EndDisabled();
  return is_clicked;
}

}  // namespace sigs::editor
