// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kMaxLosses = 4;  // of a volume

// A number of the form: on the screen it is `scale` times what the approach has.
struct ApproachNumber {
  const char* id;
  const char* label;
  double PlannedApproach::*value;
  double scale;
  float step;            // a pixel of dragging
  const char* format;    // of a number that is not negative
  const char* negative;  // of one that is
  const char* help;
};

constexpr std::array<ApproachNumber, 6> kNumbers{{
    {"miss", "Horizontal miss", &PlannedApproach::miss_m, 1, 0.5F, "%.2f m, right", "%.2f m, left",
     "HMD: least distance over ground. Positive: it passes on the right, for one who looks where it comes from"},
    {"vertical", "Vertical miss", &PlannedApproach::vertical_miss_m, 1, 0.5F, "%.2f m, above", "%.2f m, below",
     "VMD: its height above the camera at that time"},
    {"closing", "Closing speed", &PlannedApproach::closing_speed_mps, 1, 0.1F, "%.2f m/s", "%.2f m/s",
     "Speed of the horizontal relative motion: what a large distance falls by"},
    {"bearing", "Bearing", &PlannedApproach::bearing_rad, kDegrees, 0.25F, "%.2f\u00b0", "%.2f\u00b0",
     "Where it comes from, to the right of the camera's course over ground: 0 head-on, 90 from the right, 180 from "
     "behind"},
    {"climb", "Climbs", &PlannedApproach::climb_mps, 1, 0.05F, "%.2f m/s", "%.2f m/s",
     "How fast it rises against the camera; 0: both stay at their heights"},
    {"time", "Time", &PlannedApproach::time_s, 1, 0.01F, "%.3f s", "%.3f s",
     "Time of the closest approach, from the footage's first frame on"},
}};

bool draw_number(const ApproachNumber& number, PlannedApproach& approach, float width, Typing& typing) {
  double& value = approach.*number.value;
  double on_screen = value * number.scale;
  ImGui::SetNextItemWidth(width);
  const bool is_changed = ImGui::DragScalar("##number", ImGuiDataType_Double, &on_screen, number.step, nullptr, nullptr,
                                            on_screen < 0 ? number.negative : number.format);
  if (!takes_effect(is_changed, on_screen, typing)) return false;
  value = on_screen / number.scale;
  if (number.value == &PlannedApproach::bearing_rad) value = std::remainder(value, 2 * std::numbers::pi);
  return true;
}

void draw_losses(const ViewContext& context, FieldRows& rows, const VolumeLosses& volume) {
  (void)rows.begin_row(volume.volume.name);
  ImGui::BeginGroup();
  if (volume.losses.empty()) ImGui::TextDisabled("never lost");
  for (std::size_t i = 0; i < std::min(volume.losses.size(), kMaxLosses); ++i) {
    const LossStretch& loss = volume.losses[i];
    ImGui::PushID(static_cast<int>(i));
    const std::string begin = loss.has_entry ? fmt::format("{:.3f} s", loss.time_s.begin_s) : "first frame";
    const std::string end = loss.has_exit ? fmt::format("{:.3f} s", loss.time_s.end_s) : "last frame";
    frame_link(context, begin, loss.entry_frame(), color::kBad);
    context.ui_probe.note_item("inspector/encounter/entry");
    ImGui::SameLine();
    ImGui::TextDisabled("to");
    ImGui::SameLine();
    frame_link(context, end, loss.exit_frame(), color::kBad);
    context.ui_probe.note_item("inspector/encounter/exit");
    ImGui::PopID();
  }
  if (volume.losses.size() > kMaxLosses) ImGui::TextDisabled("%zu more", volume.losses.size() - kMaxLosses);
  ImGui::EndGroup();
}

// When well clear is lost, by the newest survey.
void draw_volumes_lost(const ViewContext& context, FieldRows& rows, int intruder) {
  ImGui::Spacing();
  note("Well clear lost");
  const std::shared_ptr<const Survey> survey = survey_of(context, intruder);
  if (survey == nullptr || !survey->encounter) return note("Not known yet.");
  for (const VolumeLosses& volume : survey->encounter->volumes) draw_losses(context, rows, volume);
}

// What a change would do to a flight that is not the plain one.
void draw_notes(const PresentApproach& present, const ViewContext& context) {
  if (!present.is_within) {
    const bool is_first = std::lround(present.frame) <= context.document.first_frame();
    note(is_first ? "The clip begins after the closest approach: the distance only rises. A number makes one within."
                  : "The clip ends before the closest approach: the distance still falls. A number makes one within.");
  } else if (!present.is_straight) {
    note(
        "The flight curves, and stays a curve: misses move it as a whole, other numbers turn it and change its speed.");
  }
}

}  // namespace

void EncounterBlock::settle(const ViewContext& context, int intruder) {
  const std::uint64_t revision = context.document.revision().number;
  const bool is_lost =
      start_ && context.document.has_other_changes(revision_before_, start_ && !gesture_.empty() ? gesture_ : "");
  if (intruder != intruder_ || is_lost) {
    intruder_ = intruder;
    start_.reset();
    wish_.reset();
    wished_distance_m_.reset();
    reason_.clear();
    is_held_ = false;
  }
  if (!is_held_ && context.shown.scene->revision == revision) {
    wish_.reset();
    wished_distance_m_.reset();
  }
  if (!is_held_ && revision != reason_revision_) reason_.clear();
}

std::optional<PlannedApproach> EncounterBlock::draw_numbers(const ViewContext& context, FieldRows& rows,
                                                            const PlannedApproach& shown) {
  std::optional<PlannedApproach> edited;
  for (const ApproachNumber& number : kNumbers) {
    ImGui::PushID(number.id);
    const float width = rows.begin_row(number.label);
    PlannedApproach approach = shown;
    const bool is_edited = draw_number(number, approach, width, rows.typing());
    if (is_edited) edited = approach;
    context.ui_probe.note_item(fmt::format("inspector/encounter/{}", number.id), number.help);
    follow_hold(context, is_edited);
    ImGui::PopID();
  }
  if (edited) wished_distance_m_.reset();
  return edited;
}

void EncounterBlock::follow_hold(const ViewContext& context, bool is_edited) {
  if (ImGui::IsItemActivated()) {
    is_held_ = true;
    start_.reset();
    revision_before_ = context.document.revision().number;
  }
  if (ImGui::IsItemDeactivated() || (is_edited && !ImGui::IsItemActive())) is_held_ = false;
}

std::optional<PlannedApproach> EncounterBlock::draw_distance(const ViewContext& context, FieldRows& rows, int intruder,
                                                             const PresentApproach& present) {
  ImGui::PushID("distance");
  double distance_m = wished_distance_m_.value_or(present.nearest_3d.range_m);
  ImGui::SetNextItemWidth(rows.begin_row("Closest, 3-D"));
  const bool is_edited =
      takes_effect(ImGui::DragScalar("##number", ImGuiDataType_Double, &distance_m, 0.5F, nullptr, nullptr, "%.2f m"),
                   distance_m, rows.typing());
  context.ui_probe.note_item(
      "inspector/encounter/distance",
      fmt::format("Least distance in space, at {:.3f} s. A change makes both misses larger or smaller in "
                  "the same proportion",
                  present.nearest_3d.time_s));
  follow_hold(context, is_edited);
  ImGui::PopID();
  if (!is_edited) return std::nullopt;
  if (!start_) start_ = approach_start(context, intruder);
  if (!start_) return std::nullopt;
  distance_m = std::max(0.0, distance_m);
  const tl::expected<PlannedApproach, std::string> wanted = approach_at_distance(*start_, distance_m);
  if (wanted) {
    wished_distance_m_ = distance_m;
    return *wanted;
  }
  reason_ = wanted.error();
  reason_revision_ = context.document.revision().number;
  return std::nullopt;
}

void EncounterBlock::draw_straight(const ViewContext& context, int intruder) {
  const bool is_clicked =
      context.ui_probe.noted(ImGui::Button("Make it straight"), "inspector/encounter/straight",
                             "Two waypoints, in the first frame and in the last one; the closest approach stays");
  if (!is_clicked) return;
  if (const std::optional<ApproachStart> start = approach_start(context, intruder)) {
    reason_ = make_straight(context, *start);
    reason_revision_ = context.document.revision().number;
  }
}

void EncounterBlock::change(const ViewContext& context, int intruder, const PlannedApproach& wanted) {
  if (!start_) start_ = approach_start(context, intruder);
  if (!start_) return;
  gesture_ = fmt::format("encounter form {}", intruder);
  wish_ = wanted;
  reason_ = change_approach(context, *start_, wanted, gesture_);
  reason_revision_ = context.document.revision().number;
}

void EncounterBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return note("No intruder yet. Add one above.");
  context.needs.encounters = true;
  const PresentApproach* const present = memory_.of(context, *intruder);
  if (present == nullptr) return note("The flight is not known yet.");
  settle(context, *intruder);
  note("Closest approach");
  const bool was_held = is_held_;
  std::optional<PlannedApproach> edited = draw_numbers(context, rows, wish_.value_or(present->approach));
  if (const auto by_distance = draw_distance(context, rows, *intruder, *present)) edited = by_distance;
  if (edited) change(context, *intruder, *edited);
  if (!is_held_ && (was_held || edited)) {
    context.edits.end_gesture();
    start_.reset();
    gesture_.clear();
  }
  (void)rows.begin_row("Frame");
  frame_link(context, fmt::format("{:.1f}", present->frame), std::round(present->frame), color::kAccent);
  context.ui_probe.note_item("inspector/encounter/frame");
  if (!reason_.empty()) {
    draw_wrapped(fmt::format("Not possible: {}", reason_), color::kBad);
    context.ui_probe.note_item("inspector/encounter/reason");
  }
  draw_notes(*present, context);
  if (!present->is_straight) draw_straight(context, *intruder);
  draw_volumes_lost(context, rows, *intruder);
}

}  // namespace sigs::editor
