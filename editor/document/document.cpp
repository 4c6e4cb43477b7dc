// SPDX-License-Identifier: MIT
#include "editor/document/document.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/document/project_paths.h"
#include "project/json.h"
#include "project/places.h"

namespace sigs::editor {

namespace {

// Of history, counted by the waypoints that its states hold: some 150 MB.
constexpr std::size_t kMaxWaypointsInHistory = 2'000'000;
constexpr std::size_t kMaxSteps = 1000;

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const std::optional<double>& number) {
  return std::isfinite(number.value_or(0));
}

bool finite(const WaypointSettings& waypoint) {
  const PlaceSettings place = waypoint.place.value_or(PlaceSettings());
  return finite(waypoint.position_m) && finite(waypoint.frame) && std::isfinite(place.latitude_deg) &&
         std::isfinite(place.longitude_deg) && std::isfinite(place.height_m);
}

bool finite(const IntruderSettings& intruder) {
  const TrajectoryPlan& plan = intruder.trajectory;
  return std::isfinite(intruder.model.scale) && std::isfinite(intruder.model.length_m) &&
         std::isfinite(plan.bank_limit_deg) &&
         std::all_of(plan.waypoints.begin(), plan.waypoints.end(),
                     [](const WaypointSettings& waypoint) { return finite(waypoint); });
}

bool finite(const OwnBodySettings& own_body) {
  const PaperOwnBodySettings& paper = own_body.paper;
  const StableOwnBodySettings& stable = own_body.stable;
  for (const double number :
       {own_body.settled_percent, own_body.soft_edge_px, paper.canny_low, paper.canny_high, paper.min_area_percent,
        stable.vibration_px, stable.min_area_percent, stable.min_moving_percent})
    if (!std::isfinite(number)) return false;
  return true;
}

bool finite(const CameraSettings& camera) {
  return finite(camera.position_m) && finite(camera.roll_deg) && finite(camera.pitch_deg) &&
         std::isfinite(camera.yaw_deg) && std::isfinite(camera.speed_mps) && std::isfinite(camera.track.offset_s) &&
         finite(camera.readout_s) && finite(camera.exposure_s);
}

bool finite(const LightSettings& light) {
  return finite(light.position_m) && finite(light.color) && std::isfinite(light.ambient) &&
         finite(light.sun.azimuth_deg) && finite(light.sun.elevation_deg) && finite(light.sky_color) &&
         finite(light.ground_color) && std::isfinite(light.exposure);
}

bool finite(const AppearanceSettings& appearance) {
  const GrainSettings& grain = appearance.grain;
  for (const double number :
       {appearance.psf_sigma_px, appearance.sharpening, appearance.sharpening_px, appearance.chroma_blur_px,
        appearance.black, appearance.saturation, grain.sd_dark, grain.sd_bright, grain.sd_chroma,
        grain.correlation_length_px, grain.temporal_correlation})
    if (!std::isfinite(number)) return false;
  return finite(appearance.haze.visibility_m) && finite(appearance.haze.airlight_color) &&
         finite(appearance.codec.quantiser);
}

bool finite(const GeoSettings& geo) {
  return finite(geo.latitude_deg) && finite(geo.longitude_deg) && finite(geo.height_m) && finite(geo.heading_deg);
}

bool finite(const Project& project) {
  return finite(project.own_body) && finite(project.camera) && finite(project.geo) && finite(project.light) &&
         finite(project.appearance) && finite(project.compositing.blur_px_per_m) &&
         std::all_of(project.intruders.begin(), project.intruders.end(),
                     [](const IntruderSettings& intruder) { return finite(intruder); });
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

Document::Document() : Document(Project()) {}

Document::Document(Project project, std::uint64_t first_number, std::optional<FileStamp> as_read)
    : revision_{first_number, std::make_shared<const Project>(std::move(project))},
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

int Document::first_frame() const {
  const int first = std::max(0, project().footage.first_frame);
  return frame_count_ > 0 ? std::min(first, frame_count_ - 1) : first;
}

int Document::last_frame() const {
  const int footage_last = frame_count_ > 0 ? frame_count_ - 1 : project().footage.last_frame.value_or(first_frame());
  return std::max(first_frame(), std::min(project().footage.last_frame.value_or(footage_last), footage_last));
}

int Document::range_first() const {
  return std::clamp(in_.value_or(first_frame()), first_frame(), last_frame());
}

int Document::range_last() const {
  return std::clamp(out_.value_or(last_frame()), range_first(), last_frame());
}

std::string Document::undo_name() const {
  return past_.empty() ? std::string() : past_.back().name;
}

std::string Document::redo_name() const {
  return future_.empty() ? std::string() : future_.back().name;
}

void Document::apply(const std::vector<Edit>& edits) {
  for (const Edit& edit : edits) apply(edit);
}

void Document::apply(const Edit& edit) {
  if (const auto* change_project = std::get_if<ChangeProject>(&edit)) change(*change_project);
  if (std::holds_alternative<EndGesture>(edit)) end_gesture();
  if (const auto* cancel = std::get_if<CancelGesture>(&edit)) cancel_gesture(cancel->gesture);
  if (std::holds_alternative<Undo>(edit)) step_back();
  if (std::holds_alternative<Redo>(edit)) step_forward();
  if (const auto* go = std::get_if<GoToFrame>(&edit)) playhead_ = go->frame;
  if (const auto* select = std::get_if<Select>(&edit)) selection_ = select->selection;
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
  Project changed = project();
  try {
    change.change(changed);
  } catch (const std::exception&) {
    return;
  }
  changed.file = project().file;
  if (!finite(changed) || changed == project()) return;
  keep_places(project(), changed);
  if (!finite(changed) || changed == project()) return;
  const bool joins = !change.gesture.empty() && change.gesture == gesture_ && !past_.empty();
  if (!joins) {
    end_gesture();
    past_.push_back({change.name, revision_, selection_});
    future_of_gesture_ = std::exchange(future_, {});
  }
  gesture_ = change.gesture;
  revision_ = {++last_number_, std::make_shared<const Project>(std::move(changed))};
  if (gesture_.empty()) end_gesture();
}

void Document::end_gesture() {
  gesture_.clear();
  future_of_gesture_.clear();
  forget_oldest();
}

void Document::cancel_gesture(const std::string& gesture) {
  if (gesture.empty() || gesture != gesture_ || past_.empty()) return;
  revision_ = std::move(past_.back().before);
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

void Document::step_back() {
  end_gesture();
  if (past_.empty()) return;
  Step step = std::move(past_.back());
  past_.pop_back();
  future_.push_back(exchanged(std::move(step)));
}

void Document::step_forward() {
  end_gesture();
  if (future_.empty()) return;
  Step step = std::move(future_.back());
  future_.pop_back();
  past_.push_back(exchanged(std::move(step)));
}

// A state from before the document was saved under another name is moved there when it comes back, and not when that
// was done: a long history would take long to move, and most of it never comes back.
Document::Step Document::exchanged(Step step) {
  const std::filesystem::path file = project().file;
  if (step.before.project->file != file)
    step.before = {++last_number_, std::make_shared<const Project>(moved_to(*step.before.project, file))};
  return {std::move(step.name), std::exchange(revision_, std::move(step.before)),
          std::exchange(selection_, step.selection)};
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

Result<void> Document::save() {
  return save_as(project().file);
}

Result<void> Document::save_as(const std::filesystem::path& path) {
  if (path.empty()) return fail("", "the project has no file name", ErrorKind::cannot_create);
  Project moved = moved_to(project(), path);
  if (const Result<void> written = write_project(moved, path, true); !written) return written;
  if (moved != project()) revision_ = {++last_number_, std::make_shared<const Project>(std::move(moved))};
  saved_number_ = revision_.number;
  file_stamp_ = stamp_of_file(project());
  end_gesture();
  return {};
}

bool Document::file_has_changed() const {
  const FileStamp present = stamp_of(file_stamp_.path);
  return present.exists && present != file_stamp_;
}

}  // namespace sigs::editor
