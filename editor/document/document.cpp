// SPDX-License-Identifier: MIT
#include "editor/document/document.h"

#include <algorithm>
#include <cmath>

#include "editor/document/field_edits.h"
#include "editor/document/project_paths.h"
#include "project/json.h"
#include "project/places.h"
#include "project/project.h"

namespace sigs::editor {

namespace {

// Of history, counted by the waypoints that its states hold: some 150 MB.
constexpr std::size_t kMaxWaypointsInHistory = 2'000'000;
constexpr std::size_t kMaxSteps = 1000;

bool finite(const WaypointSettings& waypoint) {
  const PlaceSettings place = waypoint.place.value_or(PlaceSettings());
  return is_finite(waypoint.position_m) && std::isfinite(waypoint.frame.value_or(0)) &&
         std::isfinite(place.latitude_deg) && std::isfinite(place.longitude_deg) && std::isfinite(place.height_m);
}

// The waypoints are looked at by themselves: there can be ten thousand.
bool finite(Project& project) {
  for (const IntruderSettings& intruder : project.intruders)
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints)
      if (!finite(waypoint)) return false;
  return with_waypoints_aside(project, [](const std::vector<Field>& fields) {
    return std::ranges::all_of(fields, [](const Field& field) { return is_finite(value_of(field)); });
  });
}

FileStamp stamp_of_file(const Project& project) {
  return stamp_of(project.file.empty() ? project.file : std::filesystem::absolute(project.file));
}

std::size_t waypoints_in(const Project& project) {
  std::size_t count = 1;
  for (const IntruderSettings& intruder : project.intruders) count += intruder.trajectory.waypoints.size();
  return count;
}

}  // namespace

void Edits::move_waypoint(int intruder, int waypoint, const glm::dvec3& position_m, std::string gesture) {
  change(
      "move waypoint",
      [=](Project& project) {
        auto& waypoints = project.intruders.at(static_cast<std::size_t>(intruder)).trajectory.waypoints;
        waypoints.at(static_cast<std::size_t>(waypoint)).position_m = position_m;
      },
      std::move(gesture));
}

Revision revision_of_camera(const Revision& whole, std::size_t camera) {
  if (whole.project->cameras.empty()) return whole;
  Project seen = seen_by(*whole.project, camera);
  seen.name = whole.project->name;
  return {whole.number + (std::uint64_t(camera) << 40), std::make_shared<const Project>(std::move(seen))};
}

Document::Document(Project project, std::uint64_t first_number, std::optional<FileStamp> as_read)
    : state_{first_number, std::make_shared<const Project>(std::move(project))},
      revision_(revision_of_camera(state_, 0)),
      first_number_(first_number),
      last_number_(first_number),
      saved_number_(first_number),
      file_stamp_(as_read ? std::move(*as_read) : stamp_of_file(this->project())) {
  playhead_ = first_frame();
}

void Document::set_frame_count(int count) {
  frame_count_ = std::max(0, count);
  keep_playhead_valid();
}

void Document::show(Revision state) {
  state_ = std::move(state);
  active_camera_ = std::min(active_camera_, std::max<std::size_t>(1, cameras().size()) - 1);
  revision_ = revision_of_camera(state_, active_camera_);
}

const FootageSettings& Document::counted_footage() const {
  return cameras().empty() ? whole().footage : cameras().front().footage;
}

int Document::first_frame() const {
  const int first = std::max(0, counted_footage().first_frame);
  return frame_count_ > 0 ? std::min(first, frame_count_ - 1) : first;
}

int Document::last_frame() const {
  const std::optional<int>& stated = counted_footage().last_frame;
  const int footage_last = frame_count_ > 0 ? frame_count_ - 1 : stated.value_or(first_frame());
  return std::max(first_frame(), std::min(stated.value_or(footage_last), footage_last));
}

int Document::range_first() const {
  return std::clamp(in_.value_or(first_frame()), first_frame(), last_frame());
}

int Document::range_last() const {
  return std::clamp(out_.value_or(last_frame()), range_first(), last_frame());
}

void Document::apply(const Edit& edit) {
  if (const auto* change_project = std::get_if<ChangeProject>(&edit)) change(*change_project);
  if (std::holds_alternative<EndGesture>(edit)) end_gesture();
  if (const auto* cancel = std::get_if<CancelGesture>(&edit)) cancel_gesture(cancel->gesture);
  if (std::holds_alternative<Undo>(edit)) take_step(past_, future_);
  if (std::holds_alternative<Redo>(edit)) take_step(future_, past_);
  if (const auto* go = std::get_if<GoToFrame>(&edit)) playhead_ = go->frame;
  if (const auto* select = std::get_if<Select>(&edit)) selection_ = select->selection;
  if (const auto* look = std::get_if<ActivateCamera>(&edit)) {
    active_camera_ = look->camera;
    show(state_);
  }
  if (const auto* range = std::get_if<SetInOut>(&edit)) {
    in_ = range->in;
    out_ = range->out;
    if (in_ && out_ && *in_ > *out_) std::swap(*in_, *out_);
  }
  keep_selection_valid();
  keep_playhead_valid();
}

bool Document::has_other_changes(std::uint64_t since_revision, const std::string& gesture) const {
  return revision_.number != since_revision && (gesture.empty() || gesture_ != gesture);
}

void Document::change(const ChangeProject& change) {
  const bool is_of_whole = change.of == ChangeOf::whole;
  Project changed = is_of_whole ? whole() : project();
  try {
    change.change(changed);
  } catch (const std::exception&) {
    return;
  }
  // put_back() takes the name that seen_by() makes.
  if (!is_of_whole && changed.rig_view) changed.name += "." + changed.rig_view->name;
  if (!is_of_whole) changed = put_back(whole(), std::move(changed));
  changed.file = whole().file;
  if (!finite(changed) || changed == whole()) return;
  keep_places(whole(), changed);
  if (!finite(changed) || changed == whole()) return;
  const bool joins = !change.gesture.empty() && change.gesture == gesture_ && !past_.empty();
  if (!joins) {
    end_gesture();
    past_.push_back({change.name, state_, selection_});
    future_of_gesture_ = std::exchange(future_, {});
  }
  gesture_ = change.gesture;
  show({++last_number_, std::make_shared<const Project>(std::move(changed))});
  if (gesture_.empty()) end_gesture();
}

void Document::end_gesture() {
  gesture_.clear();
  future_of_gesture_.clear();
  forget_oldest();
}

void Document::cancel_gesture(const std::string& gesture) {
  if (gesture.empty() || gesture != gesture_ || past_.empty()) return;
  show(std::move(past_.back().before));
  selection_ = past_.back().selection;
  past_.pop_back();
  future_ = std::exchange(future_of_gesture_, {});
  end_gesture();
}

// Not in a gesture: what it might still be taken back to has to be there.
void Document::forget_oldest() {
  const std::size_t room = std::max<std::size_t>(10, kMaxWaypointsInHistory / waypoints_in(project()));
  while (past_.size() > std::min(kMaxSteps, room)) past_.erase(past_.begin());
}

void Document::take_step(std::vector<Step>& from, std::vector<Step>& to) {
  end_gesture();
  if (from.empty()) return;
  Step step = std::move(from.back());
  from.pop_back();
  // A state from before the document was saved under another name is moved there when it comes back, and not when that
  // was done: a long history would take long to move, and most of it never comes back.
  const std::filesystem::path file = whole().file;
  if (step.before.project->file != file)
    step.before = {++last_number_, std::make_shared<const Project>(moved_to(*step.before.project, file))};
  to.push_back({std::move(step.name), state_, std::exchange(selection_, step.selection)});
  show(std::move(step.before));
}

void Document::keep_selection_valid() {
  const auto intruders = static_cast<int>(project().intruders.size());
  const bool of_intruder = selection_.kind == Selected::intruder || selection_.kind == Selected::waypoint;
  if (!of_intruder) return;
  if (intruders == 0) {
    selection_ = {};
    return;
  }
  selection_.intruder = std::clamp(selection_.intruder, 0, intruders - 1);
  if (selection_.kind != Selected::waypoint) return;
  const auto waypoints =
      static_cast<int>(project().intruders[static_cast<std::size_t>(selection_.intruder)].trajectory.waypoints.size());
  if (waypoints == 0) selection_ = {Selected::intruder, selection_.intruder, 0};
  selection_.waypoint = std::clamp(selection_.waypoint, 0, std::max(0, waypoints - 1));
}

void Document::keep_playhead_valid() {
  playhead_ = std::clamp(playhead_, first_frame(), last_frame());
}

Result<void> Document::save_as(const std::filesystem::path& path) {
  if (path.empty()) return fail("", "the project has no file name", ErrorKind::cannot_create);
  Project moved = moved_to(whole(), path);
  if (const Result<void> written = write_project(moved, path, true); !written) return written;
  if (moved != whole()) show({++last_number_, std::make_shared<const Project>(std::move(moved))});
  saved_number_ = state_.number;
  file_stamp_ = stamp_of_file(project());
  end_gesture();
  return {};
}

bool Document::file_has_changed() const {
  const FileStamp present = stamp_of(file_stamp_.path);
  return present.exists && present != file_stamp_;
}

void Guesses::begin(std::vector<Guess> guesses, const Document& document) {
  guesses_ = std::move(guesses);
  for (Guess& guess : guesses_)
    if (guess.value.empty()) guess.value = setting_text(document.project(), guess.text.field);
  first_number_ = document.first_number();
  revision_ = 0;
  follow(document);
}

void Guesses::follow(const Document& document) {
  if (guesses_.empty()) return;
  if (document.first_number() != first_number_) {
    guesses_.clear();
    left_.clear();
    return;
  }
  if (document.revision().number == revision_) return;
  revision_ = document.revision().number;
  left_.clear();
  std::vector<std::string> keys;
  for (const Guess& guess : guesses_) keys.push_back(guess.text.field);
  const std::vector<std::string> values = setting_texts(document.project(), keys);
  for (std::size_t i = 0; i < guesses_.size(); ++i)
    if (values[i] == guesses_[i].value) left_.push_back(guesses_[i].text);
}

}  // namespace sigs::editor
