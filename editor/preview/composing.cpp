// SPDX-License-Identifier: MIT
#include "editor/preview/composing.h"

#include <algorithm>
#include <utility>

#include "base/guarded.h"
#include "editor/preview/polite.h"

namespace sigs::editor {

namespace {

constexpr std::chrono::milliseconds kLookAtFiles(1000);  // how often they are looked at for changes from outside
constexpr std::chrono::milliseconds kNap(50);            // until edits have come to rest
constexpr std::chrono::milliseconds kOldSurvey(300);     // how long an older survey stands in for one that is made
constexpr double kSurveySlice_s = 0.003;
constexpr int kBackgroundTasks = 3;

}  // namespace

void Composing::run() {
  be_polite(kNicenessOfPictures);
  while (const std::optional<Turn> turn = board_.turn()) {
    // What failed for want of memory is tried again at the next turn, when something else may have given it back.
    const Result<bool> did = guarded([&]() -> Result<bool> { return step(*turn); });
    if (did && *did) continue;
    board_.rest(turn->version, did && turn->ahead ? kLookAtFiles : kNap);
  }
}

int Composing::clamped(int frame) const {
  return std::clamp(frame, 0, static_cast<int>(scene_->footage->shape.times_s.size()) - 1);
}

void Composing::name_revision(const Turn& turn) {
  const Revision& revision = turn.wanted->revision;
  const Clock::time_point now = Clock::now();
  if (revision.number == revision_ && now - named_ < kLookAtFiles) return;
  state_ = picture_names_.number_of(picture_name_of(*revision.project));
  const FileStamp video = footage_name_of(*revision.project);
  footage_ = {footage_names_.number_of(video), video.path};
  revision_ = revision.number;
  named_ = now;
  board_.name_revision(revision_, state_, footage_);
}

// Also where only the number is new: whoever looks at the scene finds the project that it belongs to.
void Composing::open_revision(const Turn& turn) {
  if (turn.footage.id != footage_.id || !turn.opened_footage) return;
  const bool is_open = scene_fits() && scene_->revision == revision_ && scene_footage_ == footage_.id;
  if (is_open) return;
  const Revision& revision = turn.wanted->revision;
  scene_ = composer_.opened(revision, footage_for(*revision.project, turn.opened_footage));
  scene_state_ = state_;
  scene_footage_ = footage_.id;
  board_.put_scene(scene_);
}

std::shared_ptr<const Decoded> Composing::footage_frame(int frame) const {
  if (scene_->footage->video) return board_.decoded({scene_footage_, frame});
  return std::make_shared<const Decoded>(Decoded{grey_frame(scene_->footage->shape, frame), ""});
}

bool Composing::compose(int frame, bool was_wanted) {
  const std::shared_ptr<const Decoded> footage = footage_frame(frame);
  if (!footage) return false;
  const Clock::time_point start = Clock::now();
  auto picture = composer_.picture(*scene_, frame, *footage, Stages::leave_out, std::nullopt);
  const std::chrono::duration<double, std::milli> took = Clock::now() - start;
  board_.put_picture({state_, frame}, std::move(picture), took.count(), was_wanted);
  return true;
}

// While the wanted frame is still being decoded, the one that was wanted before it is better than nothing: a fast
// scrub shows pictures on its way.
bool Composing::show_wanted(const Turn& turn) {
  const int frame = clamped(turn.wanted->frame);
  if (board_.has_picture({state_, frame})) return false;
  if (compose(frame, true)) return true;
  const bool is_fresh = turn.fresh && turn.fresh->state == scene_footage_;
  return is_fresh && !board_.has_picture({state_, turn.fresh->frame}) && compose(turn.fresh->frame, true);
}

bool Composing::show_extras(const Turn& turn) {
  const Wanted& wanted = *turn.wanted;
  const FrameKey key{state_, clamped(wanted.frame)};
  const FrameKey footage_key{scene_footage_, key.frame};
  const bool untouched = wanted.footage && !board_.has_untouched(footage_key);
  const bool compared = wanted.compare_with && !board_.has_compared(key, *wanted.compare_with, wanted.stages);
  const bool staged = wanted.stages && !board_.has_staged(key);
  if (!untouched && !compared && !staged) return false;
  const std::shared_ptr<const Decoded> footage = footage_frame(key.frame);
  if (!footage) return false;
  if (untouched)
    board_.put_untouched(footage_key, std::make_shared<const cv::Mat>(bgr_of(footage->frame)));
  else if (compared)
    board_.put_compared(key, composer_.picture(*scene_, key.frame, *footage,
                                               wanted.stages ? Stages::keep : Stages::leave_out, wanted.compare_with));
  else
    board_.put_staged(key, composer_.picture(*scene_, key.frame, *footage, Stages::keep, std::nullopt));
  return true;
}

bool Composing::fetch_ahead(const Turn& turn) {
  if (!turn.ahead || !scene_fits()) return false;
  const int count = static_cast<int>(scene_->footage->shape.times_s.size());
  const std::optional<int> frame = board_.next_ahead(turn, state_, count);
  return frame && compose(*frame, false);
}

// The survey of the revision before stays for a moment, so that it does not shrink and grow with every step of a drag.
bool Composing::survey() {
  if (!scene_fits()) return false;
  if (survey_state_ != scene_state_) {
    survey_maker_.begin(scene_);
    survey_state_ = scene_state_;
    survey_is_shown_ = false;
    survey_begun_ = Clock::now();
  }
  if (survey_maker_.done() && survey_is_shown_) return false;
  const bool has_more = survey_maker_.work(kSurveySlice_s);
  if (!has_more || (!survey_maker_.done() && Clock::now() - survey_begun_ < kOldSurvey)) return true;
  board_.put_surveys(survey_maker_.surveys());
  survey_is_shown_ = survey_maker_.done();
  return true;
}

bool Composing::turn_model(const Turn& turn) {
  const std::optional<Wanted::Turntable>& wanted = turn.wanted->turntable;
  const auto intruders = static_cast<int>(turn.wanted->revision.project->intruders.size());
  if (!wanted || wanted->intruder < 0 || wanted->intruder >= intruders || wanted->size_px.empty()) return false;
  const ModelKey key{state_, wanted->intruder, wanted->turn_rad, wanted->size_px};
  if (model_ == key) return false;
  model_ = key;
  board_.put_model(composer_.model_picture(*turn.wanted->revision.project, *wanted));
  return true;
}

bool Composing::step(const Turn& turn) {
  if (!turn.wanted || !turn.wanted->revision.project) return false;
  name_revision(turn);
  open_revision(turn);
  if (scene_fits() && (show_wanted(turn) || show_extras(turn))) return true;
  for (int i = 0; i < kBackgroundTasks; ++i) {
    whose_turn_ = (whose_turn_ + 1) % kBackgroundTasks;
    const bool did = whose_turn_ == 0 ? fetch_ahead(turn) : whose_turn_ == 1 ? survey() : turn_model(turn);
    if (did) return true;
  }
  return false;
}

}  // namespace sigs::editor
