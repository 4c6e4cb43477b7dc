// SPDX-License-Identifier: MIT
#include "editor/views/inspector/trajectory.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/document/field_edits.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

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
  const std::string key = fmt::format("intruders[{}].trajectory.", *intruder);
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
  rows.guess_lines(key.substr(0, key.size() - 1));
  rows.guess_lines(key + "waypoints");
  waypoints_.draw(context, rows.problems(), *intruder);
  ImGui::Spacing();
  note("Flight");
  flight_.draw(context, rows, *intruder);
}

namespace {

constexpr std::size_t kMaxFlags = 12;

std::string tenths(double value, double step = 0.1) {
  return number_text(std::round(value / step) * step);
}

void note_row(FieldRows& rows, const char* label, const std::string& text, const char* tooltip) {
  (void)rows.begin_row(label);
  ImGui::PushStyleColor(ImGuiCol_Text, color::kQuiet);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  tooltip_for_item(tooltip);
}

std::string frames_text(const FlightFlag& flag) {
  const long first = std::lround(flag.first_frame);
  const long last = std::lround(flag.last_frame);
  return first == last ? fmt::format("frame {}", first) : fmt::format("frames {} to {}", first, last);
}

}  // namespace

Visibility visibility_of(const Survey& survey, int frames) {
  Visibility visibility{.frames = frames};
  for (const VisibilityEstimate& estimate : survey.estimates) add(visibility, estimate);
  return visibility;
}

void FlightSummary::measure(const std::shared_ptr<const Survey>& survey) {
  if (survey == measured_) return;
  measured_ = survey;
  if (survey->flight.empty()) return;
  visibility_ = text_of(visibility_of(*survey, static_cast<int>(survey->estimates.size())));
  const auto span = [&](auto value) {
    const auto [minimum, maximum] =
        std::minmax_element(survey->flight.begin(), survey->flight.end(),
                            [&](const auto& a, const auto& b) { return value(a) < value(b); });
    return Span{value(*minimum), value(*maximum)};
  };
  speed_mps_ = span([](const FlightState& state) { return state.speed_mps; });
  load_ = span([](const FlightState& state) { return state.load_factor; });
  climb_mps_ = span([](const FlightState& state) { return state.climb_rate_mps; });
}

void FlightSummary::draw(const ViewContext& context, FieldRows& rows, int intruder) {
  const auto index = static_cast<std::size_t>(intruder);
  const std::vector<std::shared_ptr<const Survey>>& surveys = context.shown.surveys;
  if (index >= surveys.size() || !surveys[index] || surveys[index]->flight.empty()) {
    note("The flight has not been looked at yet.");
    return;
  }
  const Survey& survey = *surveys[index];
  measure(surveys[index]);
  note_row(rows, "Speed", fmt::format("{} to {} m/s", tenths(speed_mps_.minimum), tenths(speed_mps_.maximum)),
           "Minimum and maximum");
  note_row(rows, "Load factor", fmt::format("{} to {} g", tenths(load_.minimum, 0.01), tenths(load_.maximum, 0.01)),
           "Lift by weight; 1 in level flight");
  note_row(rows, "Climb", fmt::format("{} to {} m/s", tenths(climb_mps_.minimum), tenths(climb_mps_.maximum)),
           "Up is positive");
  note_row(rows, "Seen", visibility_, "Estimated without drawing; size: the longer side of its silhouette");
  (void)rows.begin_row("Closest");
  frame_link(context, fmt::format("{} m, frame {}", tenths(survey.closest.distance_m), tenths(survey.closest.frame)),
             survey.closest.frame, color::kAccent);
  for (std::size_t i = 0; i < std::min(survey.flags.size(), kMaxFlags); ++i) {
    const FlightFlag& flag = survey.flags[i];
    std::string text = fmt::format("{} ({})", flag.text(), frames_text(flag));
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    frame_link(context, text, flag.first_frame, color::kPartly);
  }
  if (survey.flags.size() > kMaxFlags) note(fmt::format("{} more", survey.flags.size() - kMaxFlags), true);
}

}  // namespace sigs::editor
