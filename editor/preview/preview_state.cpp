// SPDX-License-Identifier: MIT
#include "editor/preview/preview_state.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace sigs::editor {

namespace {

constexpr std::chrono::milliseconds kWakeInterval(250);  // how long the window may not hear of frames fetched ahead
constexpr std::chrono::milliseconds kStillEditing(200);  // after an edit the next one is likely
constexpr std::chrono::milliseconds kStillPulling(150);  // likewise after a jump of the playhead

template <class T>
std::size_t held_bytes(const std::shared_ptr<const T>& kept) {
  return kept ? bytes_of(*kept) : 0;
}

}  // namespace

std::vector<int> prefetch_order(const PreviewRequest& wanted, int frame_count, int maximum) {
  const int first = std::clamp(wanted.range_first, 0, frame_count - 1);
  const int last = std::clamp(wanted.range_last, first, frame_count - 1);
  const int step = wanted.direction < 0 ? -1 : 1;
  const int length = last - first + 1;
  std::vector<int> frames;
  for (int i = 1; i <= std::min(maximum, length); ++i) {
    int frame = wanted.frame + step * i;
    const bool is_past = step > 0 ? frame > last : frame < first;
    if (is_past && !wanted.playing) break;
    if (is_past) frame -= step * length;
    if (frame >= first && frame <= last && frame != wanted.frame) frames.push_back(frame);
  }
  return frames;
}

PreviewState::PreviewState(PreviewLimits limits, std::function<void()> wake)
    : wake_(std::move(wake)), limits_(limits), decoded_(0), images_(0) {
  share_memory();
}

void PreviewState::notify_threads() {
  ++version_;
  changed_.notify_all();
}

bool PreviewState::should_wake(bool at_once) {
  has_news_ = true;
  const Clock::time_point now = Clock::now();
  if (stop_ || (!at_once && now - last_wake_ < kWakeInterval)) return false;
  last_wake_ = now;
  has_news_ = false;
  return true;
}

template <class Change>
void PreviewState::put(bool at_once, const Change& change) {
  bool call = false;
  {
    const std::lock_guard lock(mutex_);
    change();
    share_memory();
    call = should_wake(at_once);
  }
  if (call && wake_) wake_();
}

int PreviewState::clamped(int frame) const {
  if (!scene_) return frame;
  return std::clamp(frame, 0, static_cast<int>(scene_->footage->shape.times_s.size()) - 1);
}

std::optional<FrameKey> PreviewState::wanted_key() const {
  if (!wanted_) return std::nullopt;
  return FrameKey{combined_id(wanted_->revision.content, input_files_), clamped(wanted_->frame)};
}

std::shared_ptr<const PreviewImage> PreviewState::found(FrameKey key) const {
  return newest_.is(key) ? newest_.value : images_.find(key);
}

bool PreviewState::is_decoded(FrameKey key) const {
  return last_decoded_.is(key) || decoded_.find(key) != nullptr;
}

// What the playhead meets in the cache is what is shown from then on.
void PreviewState::follow_playhead() {
  if (const std::optional<FrameKey> key = wanted_key()) {
    images_.set_playhead(*key);
    if (const auto image = found(*key)) newest_ = {*key, image};
  }
  if (wanted_) decoded_.set_playhead({footage_.id, clamped(wanted_->frame)});
}

// Of what the preview state holds beside its caches. also_cached: even where a cache holds it too.
std::size_t PreviewState::shown_bytes(bool also_cached) const {
  std::size_t sum = held_bytes(untouched_.value) + held_bytes(staged_.value) + held_bytes(compared_.value);
  if (also_cached || images_.find(newest_.key) != newest_.value) sum += held_bytes(newest_.value);
  if (also_cached || decoded_.find(last_decoded_.key) != last_decoded_.value) sum += held_bytes(last_decoded_.value);
  return sum + (model_ ? bytes_of(model_->rgba) : 0);
}

MemoryUse PreviewState::memory() const {
  return {.images = images_.bytes(),
          .decoded = decoded_.bytes(),
          .shown = shown_bytes(false),
          .textures = texture_bytes_,
          .limit = limits_.cache_bytes};
}

// The caches share what textures and the view leave. What is shown has its room even while a cache holds it: it may go
// there at any time. A decoded frame has 1.5 bytes a pixel, an image that keeps it and a mask 2.5: three eighths hold
// about as many frames.
void PreviewState::share_memory() {
  const std::size_t taken = std::max(texture_bytes_, limits_.texture_bytes()) + shown_bytes(true);
  const std::size_t room = limits_.cache_bytes - std::min(limits_.cache_bytes, taken);
  const std::size_t for_decoded = room / 8 * 3;
  decoded_.set_limit(for_decoded);
  images_.set_limit(room - for_decoded);
}

void PreviewState::want(const PreviewRequest& wanted) {
  const std::lock_guard lock(mutex_);
  if (wanted_ == wanted) return;
  if (!wanted_ || wanted_->revision.number != wanted.revision.number) revised_ = Clock::now();
  if (wanted_ && !wanted.playing && std::abs(wanted_->frame - wanted.frame) > 1) jumped_ = Clock::now();
  wanted_ = wanted;
  if (!wanted.footage) untouched_ = {};
  if (!wanted.stages) staged_ = {};
  if (!wanted.compare_with) compared_ = {};
  follow_playhead();
  share_memory();
  notify_threads();
}

PreviewOutput PreviewState::shown() const {
  const std::lock_guard lock(mutex_);
  PreviewOutput shown{.scene = scene_,
                      .image = newest_.value,
                      .surveys = surveys_,
                      .model = model_,
                      .opening = footage_wanted_.id != footage_.id,
                      .compose_ms = compose_ms_};
  const std::optional<FrameKey> key = wanted_key();
  if (key) {
    const FrameKey footage{footage_.id, key->frame};
    shown.image_is_current = newest_.is(*key);
    if (wanted_->footage && untouched_.is(footage)) shown.footage = untouched_.value;
    if (wanted_->stages && staged_.is(*key)) shown.staged = staged_.value;
    if (wanted_->compare_with && compared_.is(*key) && compared_.value->method == wanted_->compare_with)
      shown.compared = compared_.value;
  }
  if (scene_) shown.cached.resize(scene_->footage->shape.times_s.size());
  if (key)
    for (const int frame : images_.frames_of(key->content))
      if (static_cast<std::size_t>(frame) < shown.cached.size()) shown.cached[static_cast<std::size_t>(frame)] = true;
  shown.memory = memory();
  const bool lacks_image = wanted_ && wanted_->image && !shown.image_is_current;
  shown.busy = wanted_ && (lacks_image || rendering_ || decoding_ || shown.opening);
  return shown;
}

void PreviewState::set_bytes(std::size_t& place, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(place, bytes) != bytes) share_memory();
}

void PreviewState::set_prefetch_paused(bool paused) {
  const std::lock_guard lock(mutex_);
  prefetch_paused_ = paused;
  notify_threads();
}

void PreviewState::stop() {
  const std::lock_guard lock(mutex_);
  stop_ = true;
  notify_threads();
}

// While the playhead is pulled, what lies ahead of it would take the processor from the images on its way.
bool PreviewState::is_time_for_more() const {
  return !prefetch_paused_ && Clock::now() - jumped_ >= kStillPulling;
}

std::optional<FrameKey> PreviewState::next_to_decode() const {
  const bool is_there = footage_.id != ContentId() && footage_.id == footage_wanted_.id && opened_footage_->video;
  if (!wanted_ || !wanted_->image || !is_there) return std::nullopt;
  const int count = opened_footage_->video->frame_count();
  const FrameKey first{footage_.id, std::clamp(wanted_->frame, 0, count - 1)};
  if (!is_decoded(first)) return first;
  if (!is_time_for_more()) return std::nullopt;
  const std::optional<FrameKey> shown = wanted_key();
  for (const int frame : prefetch_order(*wanted_, count, limits_.ahead)) {
    const FrameKey key{footage_.id, frame};
    if (shown && images_.find({shown->content, frame})) continue;
    if (decoded_.find(key)) continue;
    if (!decoded_.would_keep(key, decoded_bytes_)) break;
    return key;
  }
  return std::nullopt;
}

std::optional<DecodeTask> PreviewState::next_decoding() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    DecodeTask task;
    if (arrived_) {
      task.adopt = true;
      task.source = *std::exchange(arrived_, std::nullopt);
      return task;
    }
    if (std::exchange(opening_, footage_wanted_.id) != footage_wanted_.id && footage_wanted_.id != footage_.id) {
      task.open = footage_wanted_;
      return task;
    }
    const bool waits_for_time = !prefetch_paused_ && !is_time_for_more();  // before it is asked what to decode
    task.decode = next_to_decode();
    // That all is decoded is told too, by the renderer, as soon as it has nothing left to do itself.
    if (std::exchange(decoding_, task.decode.has_value()) && !decoding_) {
      has_news_ = true;
      notify_threads();
    }
    if (task.decode) return task;
    if (waits_for_time)
      changed_.wait_for(lock, kStillPulling);
    else
      changed_.wait(lock);
  }
  return std::nullopt;
}

void PreviewState::put_opened(const FootageId& footage, OpenedFootage opened) {
  put(true, [&] {
    if (footage.id != footage_wanted_.id) return;
    footage_ = footage;
    opened_footage_ = std::move(opened.footage);
    arrived_ = std::move(opened.source);
    follow_playhead();
    notify_threads();
  });
}

void PreviewState::put_decoded(FrameKey key, std::shared_ptr<const DecodedFrame> decoded) {
  const std::lock_guard lock(mutex_);
  decoded_bytes_ = bytes_of(*decoded);
  // What lies ahead takes the place of nothing that is wanted at this moment.
  if (!wanted_ || key.frame == clamped(wanted_->frame) || !is_decoded({footage_.id, clamped(wanted_->frame)}))
    last_decoded_ = {key, decoded};
  decoded_.put(key, std::move(decoded), decoded_bytes_);
  share_memory();
  notify_threads();
}

std::optional<PreviewSnapshot> PreviewState::snapshot() {
  const std::lock_guard lock(mutex_);
  if (stop_) return std::nullopt;
  std::optional<PreviewSnapshot> snapshot(std::in_place);
  snapshot->version = version_;
  snapshot->wanted = wanted_;
  snapshot->footage = footage_;
  snapshot->opened_footage = opened_footage_;
  snapshot->ahead = is_time_for_more() && Clock::now() - revised_ >= kStillEditing;
  if (last_decoded_.value) snapshot->fresh = last_decoded_.key;
  return snapshot;
}

void PreviewState::wait_for_changes(std::uint64_t version, std::chrono::milliseconds at_most) {
  bool call = false;
  {
    const std::lock_guard lock(mutex_);
    if (rendering_ || has_news_) call = should_wake(true);
    rendering_ = false;
  }
  if (call && wake_) wake_();
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, at_most, [&] { return stop_ || version_ != version; });
}

void PreviewState::set_input_files(const ContentId& input_files, const FootageId& footage) {
  {
    const std::lock_guard lock(mutex_);
    if (input_files_ == input_files && footage_wanted_.id == footage.id) return;
  }
  // The window hears of it: other footage is being opened, or an image that the cache holds is the current one.
  put(true, [&] {
    input_files_ = input_files;
    footage_wanted_ = footage;
    follow_playhead();
    notify_threads();
  });
}

std::shared_ptr<const DecodedFrame> PreviewState::decoded(FrameKey key) const {
  const std::lock_guard lock(mutex_);
  return last_decoded_.is(key) ? last_decoded_.value : decoded_.find(key);
}

bool PreviewState::has_image(FrameKey key) const {
  const std::lock_guard lock(mutex_);
  return found(key) != nullptr;
}

std::optional<int> PreviewState::next_prefetch(const PreviewSnapshot& snapshot, const ContentId& content,
                                               int frame_count) const {
  const std::lock_guard lock(mutex_);
  for (const int frame : prefetch_order(*snapshot.wanted, frame_count, limits_.ahead)) {
    const FrameKey key{content, frame};
    if (found(key)) continue;
    if (!images_.would_keep(key, image_bytes_)) break;
    const bool is_there = !snapshot.opened_footage->video || is_decoded({snapshot.footage.id, frame});
    return is_there ? std::optional(frame) : std::nullopt;
  }
  return std::nullopt;
}

void PreviewState::put_scene(std::shared_ptr<const OpenedScene> scene) {
  put(true, [&] {
    scene_ = std::move(scene);
    if (surveys_.size() != scene_->draft.intruder_of_project.size())
      surveys_.assign(scene_->draft.intruder_of_project.size(), nullptr);
    rendering_ = true;
    follow_playhead();
  });
}

void PreviewState::put_image(FrameKey key, std::shared_ptr<const PreviewImage> image, double took_ms, bool was_wanted) {
  put(was_wanted, [&] {
    rendering_ = true;
    image_bytes_ = bytes_of(*image);
    if (was_wanted) {
      newest_ = {key, image};
      compose_ms_ = took_ms;
    }
    images_.put(key, std::move(image), image_bytes_);
    follow_playhead();
  });
}

void PreviewState::put_untouched(FrameKey key, std::shared_ptr<const ShownImage> image) {
  put(true, [&] {
    if (wanted_ && wanted_->footage) untouched_ = {key, std::move(image)};
  });
}

void PreviewState::put_staged(FrameKey key, std::shared_ptr<const PreviewImage> image) {
  put(true, [&] {
    if (wanted_ && wanted_->stages) staged_ = {key, std::move(image)};
  });
}

void PreviewState::put_compared(FrameKey key, std::shared_ptr<const PreviewImage> image) {
  put(true, [&] {
    if (wanted_ && wanted_->compare_with) compared_ = {key, std::move(image)};
  });
}

bool PreviewState::has_compared(FrameKey key, MethodChoice method, bool staged) const {
  const std::lock_guard lock(mutex_);
  if (!compared_.is(key) || compared_.value->method != method) return false;
  return !staged || !compared_.value->stages.empty() || !compared_.value->problem.empty();
}

void PreviewState::put_surveys(std::vector<std::shared_ptr<const Survey>> surveys) {
  put(true, [&] { surveys_ = std::move(surveys); });
}

void PreviewState::put_model(std::shared_ptr<const ModelImage> model) {
  put(true, [&] { model_ = std::move(model); });
}

Previewer::Previewer(PreviewLimits limits, std::function<void()> wake)
    : state_(std::make_shared<PreviewState>(limits, std::move(wake))),
      decoder_([shared = state_] { run_decoder(shared); }) {
  try {
    renderer_ = std::thread([shared = state_] { run_renderer(*shared); });
  } catch (...) {
    end();
    throw;
  }
}

void Previewer::end() {
  state_->stop();
  for (std::thread* const thread : {&decoder_, &renderer_})
    if (thread->joinable()) thread->join();
}

}  // namespace sigs::editor
