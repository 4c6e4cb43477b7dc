// SPDX-License-Identifier: MIT
#include "editor/preview/surveys.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "export/frame_stream.h"
#include "project/project.h"
#include "scene/flight.h"
#include "scene/opened_project.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kFrameRounding = 1e-6;  // a loss that begins this little after a frame begins in it

int whole_frame(double frame) {
  return static_cast<int>(std::clamp(frame, -1e9, 1e9));
}

VolumeLosses losses_of(const VolumeOutcome& outcome, const EncounterSummary& summary, const FootageShape& footage) {
  VolumeLosses result{.volume = outcome.volume};
  for (const TimeInterval& loss : outcome.losses)
    result.losses.push_back({.first_frame = frame_at_time(footage, loss.begin_s),
                             .last_frame = frame_at_time(footage, loss.end_s),
                             .time_s = loss,
                             .has_entry = loss.begin_s > summary.first_s,
                             .has_exit = loss.end_s < summary.last_s});
  return result;
}

TargetFrame target_frame_of(const VisibilityEstimate& estimate, const cv::Rect& image) {
  TargetFrame frame{.amodal_box = estimate.silhouette, .distance_m = estimate.distance_m};
  const bool is_visible = estimate.visibility_state == VisibilityState::in_view ||
                          estimate.visibility_state == VisibilityState::partly_occluded;
  if (!is_visible || !estimate.silhouette) return frame;
  const cv::Rect pixels = pixels_touched(*estimate.silhouette, 0, image);
  if (pixels.empty()) return frame;
  frame.visible = box_of(pixels);
  frame.visible_fraction = 1;
  return frame;
}

using Clock = std::chrono::steady_clock;

constexpr std::size_t kWorthShowing = 64;  // frames; then each time it has grown by half

// Rates of roll, pitch and yaw by those about the body's axes (Stevens, Lewis, Johnson: Aircraft Control and
// Simulation, 3rd edition, eq. 1.4-3), taken for small turns.
Attitude deviations_of_angles(const Attitude& at, const glm::dvec3& sd_rad) {
  const double cos_pitch = std::max(std::abs(std::cos(at.pitch_rad)), 1e-9);
  const double up = sd_rad.y * std::sin(at.roll_rad);
  const double side = sd_rad.z * std::cos(at.roll_rad);
  const double yaw_rad = std::hypot(up, side) / cos_pitch;
  const double roll_rad = std::hypot(sd_rad.x, yaw_rad * std::sin(at.pitch_rad));
  const double pitch_rad = std::hypot(sd_rad.y * std::cos(at.roll_rad), sd_rad.z * std::sin(at.roll_rad));
  const auto limited = [](double angle_rad) { return std::min(angle_rad, std::numbers::pi); };
  return {.roll_rad = limited(roll_rad), .pitch_rad = limited(pitch_rad), .yaw_rad = limited(yaw_rad)};
}

int nearest_frame(const FootageShape& footage, double frame) {
  const double last = std::max<double>(0, static_cast<double>(footage.times_s.size()) - 1);
  return static_cast<int>(std::lround(std::clamp(frame, 0.0, last)));
}

}  // namespace

CountedFrames counted_frames(const Scene& scene) {
  if (scene.timeline) return {scene.timeline->footage, scene.timeline->first_frame, scene.timeline->last_frame};
  return {scene.footage, scene.first_frame, scene.last_frame};
}

CountedFrames filmed_frames(const Scene& scene) {
  CountedFrames filmed = counted_frames(scene);
  if (!scene.timeline) return filmed;
  const auto own = [&](int frame) {
    return std::lround(frame_at_time(scene.footage, time_of_frame_s(filmed.footage, frame)));
  };
  while (filmed.first_frame < filmed.last_frame && own(filmed.first_frame) < scene.first_frame) ++filmed.first_frame;
  while (filmed.last_frame > filmed.first_frame && own(filmed.last_frame) > scene.last_frame) --filmed.last_frame;
  return filmed;
}

int own_frame_at(const Scene& scene, double counted_frame) {
  if (!scene.timeline) return nearest_frame(scene.footage, counted_frame);
  const double time_s = time_of_frame_s(scene.timeline->footage, counted_frame);
  return nearest_frame(scene.footage, frame_at_time(scene.footage, time_s));
}

int counted_frame_at(const Scene& scene, int own_frame) {
  if (!scene.timeline) return own_frame;
  const double time_s = time_of_frame_s(scene.footage, own_frame);
  return nearest_frame(scene.timeline->footage, frame_at_time(scene.timeline->footage, time_s));
}

std::vector<WellClearVolume> shown_volumes(const Project& project) {
  std::vector<WellClearVolume> volumes;
  for (const std::string& name : project.output.encounter)
    if (const Result<WellClearVolume> volume = well_clear_volume(name); volume) volumes.push_back(*volume);
  if (volumes.empty()) volumes.push_back(well_clear_volume("small-uas").value());
  return volumes;
}

int LossStretch::entry_frame() const {
  const double first = std::ceil(first_frame - kFrameRounding);
  return whole_frame(first <= last_frame ? first : std::round(first_frame));
}

int LossStretch::exit_frame() const {
  const double last = std::floor(last_frame + kFrameRounding);
  return whole_frame(last >= first_frame ? last : std::round(last_frame));
}

bool EncounterSurvey::is_lost(std::size_t volume, double frame) const {
  const std::vector<LossStretch>& losses = volumes[volume].losses;
  return std::ranges::any_of(losses, [&](const LossStretch& loss) {
    return frame >= loss.first_frame - kFrameRounding && frame <= loss.last_frame + kFrameRounding;
  });
}

EncounterSurvey encounter_survey(const Scene& scene, int intruder, const std::vector<WellClearVolume>& volumes) {
  const CountedFrames counted = filmed_frames(scene);
  EncounterSurvey survey{.first_frame = counted.first_frame};
  const EncounterTrack own = encounter_track_of_camera(scene);
  const EncounterTrack flight = encounter_track_of_intruder(scene, static_cast<std::size_t>(intruder));
  const Result<EncounterSummary> summary = encounter_of(own, flight, {.volumes = volumes, .row_times_s = {}});
  if (!summary) return survey;
  survey.nearest = summary->nearest_horizontal;
  survey.nearest_frame = frame_at_time(counted.footage, survey.nearest.time_s);
  for (const VolumeOutcome& outcome : summary->volumes)
    survey.volumes.push_back(losses_of(outcome, *summary, counted.footage));
  for (int frame = counted.first_frame; frame <= counted.last_frame; ++frame) {
    const double time_s = time_of_frame_s(counted.footage, frame);
    const RelativeState state = relative_state(own.at(time_s), flight.at(time_s));
    survey.horizontal_range_m.push_back(std::hypot(state.horizontal_m.x, state.horizontal_m.y));
    survey.tau_mod_s.push_back(tau_mod_s(state, volumes.front().dmod_m));
  }
  return survey;
}

std::shared_ptr<const Survey> on_timeline(const std::shared_ptr<const Survey>& survey, const Scene& scene) {
  if (!survey || !scene.timeline) return survey;
  const CountedFrames counted = filmed_frames(scene);
  const auto counted_at = [&](double frame) {
    return frame_at_time(counted.footage, time_of_frame_s(scene.footage, frame));
  };
  auto made = std::make_shared<Survey>(Survey{.revision = survey->revision,
                                              .first_frame = counted.first_frame,
                                              .flags = survey->flags,
                                              .closest = survey->closest,
                                              .encounter = survey->encounter});
  for (int frame = counted.first_frame; frame <= counted.last_frame; ++frame) {
    const auto i = static_cast<std::size_t>(std::max(0, own_frame_at(scene, frame) - survey->first_frame));
    if (i < survey->estimates.size()) {
      made->estimates.push_back(survey->estimates[i]);
      made->estimates.back().frame = frame;
    }
    if (i < survey->flight.size()) made->flight.push_back(survey->flight[i]);
    if (i < survey->camera.size()) made->camera.push_back(survey->camera[i]);
  }
  made->closest.frame = counted_at(survey->closest.frame);
  for (FlightFlag& flag : made->flags) {
    flag.first_frame = counted_at(flag.first_frame);
    flag.last_frame = counted_at(flag.last_frame);
  }
  return made;
}

FootageTruth footage_truth_of(const OpenedScene& scene) {
  const Scene& opened = scene.draft.scene;
  const FrameRange range{opened.first_frame, opened.last_frame};
  if (scene.footage && scene.footage->video) return footage_truth(*scene.footage->video, range);
  return {.size_px = opened.footage.size_px, .first_frame = range.first, .last_frame = range.last};
}

std::shared_ptr<const ClipTruth> outline_truth(const OpenedScene& scene,
                                               const std::vector<std::shared_ptr<const Survey>>& surveys) {
  const Scene& opened = scene.draft.scene;
  const int first = opened.first_frame;
  const int count = opened.last_frame - first + 1;
  ClipTruth clip{.footage = footage_truth_of(scene)};
  for (int i = 0; i < count; ++i) clip.times_s.push_back(time_of_frame_s(opened.footage, first + i));
  const cv::Rect image({0, 0}, opened.footage.size_px);
  for (std::size_t i = 0; i < scene.draft.intruder_of_project.size(); ++i) {
    const int id = scene.draft.intruder_of_project[i];
    if (id < 0) continue;
    const Survey* const survey = i < surveys.size() ? surveys[i].get() : nullptr;
    if (survey == nullptr || survey->first_frame != first || static_cast<int>(survey->estimates.size()) != count)
      return nullptr;
    TargetTruth target{.id = id, .name = opened.intruders[static_cast<std::size_t>(id)].name};
    for (const VisibilityEstimate& estimate : survey->estimates)
      target.frames.push_back(target_frame_of(estimate, image));
    clip.targets.push_back(std::move(target));
  }
  std::ranges::sort(clip.targets, {}, &TargetTruth::id);
  return std::make_shared<const ClipTruth>(std::move(clip));
}

void SurveyBuilder::begin(std::shared_ptr<const OpenedScene> scene) {
  points_.reset();
  scene_ = std::move(scene);
  const Scene& opened = scene_->draft.scene;
  surveys_.assign(scene_->draft.intruder_of_project.size(),
                  Survey{.revision = scene_->revision, .first_frame = opened.first_frame});
  next_frame_ = opened.first_frame;
  next_whole_ = 0;
  next_encounter_ = 0;
  handed_out_ = 0;
}

void SurveyBuilder::want_volumes(std::vector<WellClearVolume> volumes) {
  const auto has_same_name = [](const WellClearVolume& a, const WellClearVolume& b) { return a.name == b.name; };
  if (std::equal(volumes.begin(), volumes.end(), volumes_.begin(), volumes_.end(), has_same_name)) return;
  volumes_ = std::move(volumes);
  next_encounter_ = 0;
}

CameraTurn camera_turn_at(const CameraMotion& motion, double time_s, const CameraTurn* before) {
  CameraTurn turn{.attitude = attitude_of(camera_at(motion, time_s).rotation)};
  if (const std::optional<glm::dvec3> sd_rad = attitude_sd_at(motion.deviations, time_s))
    turn.sd = deviations_of_angles(turn.attitude, *sd_rad);
  if (before != nullptr)
    turn.attitude.yaw_rad = before->attitude.yaw_rad +
                            std::remainder(turn.attitude.yaw_rad - before->attitude.yaw_rad, 2 * std::numbers::pi);
  return turn;
}

void SurveyBuilder::look_at_camera(double time_s) {
  const CameraMotion& motion = scene_->draft.scene.motion;
  if (motion.attitudes.empty() || surveys_.empty()) return;
  const std::vector<CameraTurn>& before = surveys_.front().camera;
  const CameraTurn turn = camera_turn_at(motion, time_s, before.empty() ? nullptr : &before.back());
  for (Survey& survey : surveys_) survey.camera.push_back(turn);
}

void SurveyBuilder::look_at_frame(int frame) {
  const Scene& scene = scene_->draft.scene;
  const double time_s = time_of_frame_s(scene.footage, frame);
  look_at_camera(time_s);
  for (std::size_t i = 0; i < surveys_.size(); ++i) {
    const int id = scene_->draft.intruder_of_project[i];
    if (id < 0) continue;
    surveys_[i].estimates.push_back(points_->at(id, frame));
    surveys_[i].flight.push_back(flight_at(scene.intruders[static_cast<std::size_t>(id)], time_s));
  }
}

void SurveyBuilder::look_at_whole(std::size_t intruder) {
  const int id = scene_->draft.intruder_of_project[intruder];
  if (id < 0) return;
  surveys_[intruder].closest = closest_approach(scene_->draft.scene, id);
  surveys_[intruder].flags = flight_flags(scene_->draft.scene, id);
}

void SurveyBuilder::look_at_encounter(std::size_t intruder) {
  const int id = scene_->draft.intruder_of_project[intruder];
  if (id < 0) return;
  surveys_[intruder].encounter =
      std::make_shared<const EncounterSurvey>(encounter_survey(scene_->draft.scene, id, volumes_));
}

void SurveyBuilder::step() {
  if (has_encounter_to_make())
    look_at_encounter(next_encounter_++);
  else if (!points_)
    points_.emplace(scene_->draft.scene);
  else if (next_frame_ <= last_frame())
    look_at_frame(next_frame_++);
  else
    look_at_whole(next_whole_++);
}

bool SurveyBuilder::work(double budget_s) {
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(budget_s));
  do {
    if (done()) break;
    step();
  } while (Clock::now() < end);
  if (done()) return true;
  const auto frames = static_cast<std::size_t>(next_frame_ - scene_->draft.scene.first_frame);
  return next_frame_ <= last_frame() && frames >= kWorthShowing && frames >= handed_out_ + handed_out_ / 2;
}

std::vector<std::shared_ptr<const Survey>> SurveyBuilder::surveys() {
  handed_out_ = static_cast<std::size_t>(next_frame_ - scene_->draft.scene.first_frame);
  std::vector<std::shared_ptr<const Survey>> shared;
  for (const Survey& survey : surveys_) shared.push_back(std::make_shared<const Survey>(survey));
  return shared;
}

}  // namespace sigs::editor
