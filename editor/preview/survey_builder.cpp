// SPDX-License-Identifier: MIT
#include "editor/preview/survey_builder.h"

#include <chrono>
#include <utility>

namespace sigs::editor {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kWorthShowing = 64;  // frames; then each time it has grown by half

}  // namespace

void SurveyBuilder::begin(std::shared_ptr<const OpenedScene> scene) {
  points_.reset();
  scene_ = std::move(scene);
  const Scene& opened = scene_->draft.scene;
  surveys_.assign(scene_->draft.intruder_of_project.size(),
                  Survey{.revision = scene_->revision, .first_frame = opened.first_frame});
  next_frame_ = opened.first_frame;
  next_whole_ = 0;
  handed_out_ = 0;
}

void SurveyBuilder::look_at_frame(int frame) {
  const Scene& scene = scene_->draft.scene;
  const double time_s = time_of_frame_s(scene.footage, frame);
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

void SurveyBuilder::step() {
  if (!points_)
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
