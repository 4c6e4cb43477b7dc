// SPDX-License-Identifier: MIT
#include "editor/views/inspector/trajectory.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr int kMaxProblems = 3;

// Of the waypoints as a whole and of single ones, above their table.
void draw_problems(FieldRows& rows, const std::string& prefix) {
  int shown = 0;
  std::string last;
  const ProblemsByField& problems = rows.problems();
  for (auto found = problems.lower_bound(prefix); found != problems.end() && found->first.starts_with(prefix);
       ++found) {
    if (found->first == last || rows.sheet().find(found->first) != nullptr) continue;
    last = found->first;
    if (++shown > kMaxProblems) break;
    const std::size_t bracket = last.find("waypoints[");
    if (bracket != std::string::npos) {
      const std::string number = last.substr(bracket + 10, last.find(']', bracket) - bracket - 10);
      note("Waypoint " + number, true);
    }
    rows.problem_lines(last);
  }
}

}  // namespace

void TrajectoryBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) {
    note("No intruder yet. Add one above.");
    return;
  }
  const std::string key = "intruders[" + std::to_string(*intruder) + "].trajectory.";
  const bool is_level =
      context.project().intruders[static_cast<std::size_t>(*intruder)].trajectory.bank == BankChoice::level;
  rows.rows(key, [&](const Field& field) {
    RowOptions look;
    if (is_level && field.key.ends_with("bank_limit_deg")) look.off_because = "The wings stay level.";
    return look;
  });
  ImGui::Spacing();
  note("Waypoints");
  draw_problems(rows, key);
  waypoints_.draw(context, rows.problems(), *intruder);
  ImGui::Spacing();
  note("Flight");
  flight_.draw(context, rows, *intruder);
}

}  // namespace sigs::editor
