// SPDX-License-Identifier: MIT
#include "editor/document/mask_painting.h"

#include <algorithm>
#include <utility>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxBytesInHistory = std::size_t(256) << 20;
constexpr std::size_t kMaxSteps = 1000;

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  for (int y = 0; y < a.rows; ++y)
    if (!std::equal(a.ptr<uchar>(y), a.ptr<uchar>(y) + a.cols, b.ptr<uchar>(y))) return false;
  return true;
}

}  // namespace

MaskPainting::MaskPainting(const cv::Mat& mask, std::uint64_t first_state)
    : mask_(mask.clone()),
      state_(first_state),
      last_state_(first_state),
      saved_state_(first_state),
      whole_state_(first_state) {
  ENSURE(mask.type() == CV_8UC1);
}

void MaskPainting::begin_stroke(const Brush& brush, const glm::dvec2& at) {
  if (mask_.empty()) return;
  end_stroke();
  stroke_ = Stroke{.brush = brush, .at = at, .before = mask_.clone()};
  move(at);
}

void MaskPainting::extend_stroke(const glm::dvec2& to) {
  if (stroke_ && to != stroke_->at) move(to);
}

void MaskPainting::move(const glm::dvec2& to) {
  const cv::Rect touched = move_brush(mask_, stroke_->brush, stroke_->at, to);
  stroke_->at = to;
  if (!touched.empty()) stroke_->touched |= touched;
}

void MaskPainting::end_stroke() {
  if (!stroke_) return;
  const Stroke stroke = std::move(*stroke_);
  stroke_.reset();
  remember(stroke.brush.erases ? "erase" : "paint", stroke.touched, stroke.before, false);
}

void MaskPainting::take_back_stroke() {
  if (!stroke_) return;
  stroke_->before.copyTo(mask_);
  stroke_.reset();
}

void MaskPainting::replace(const cv::Mat& mask, std::string name) {
  ENSURE(mask.type() == CV_8UC1 && mask.size() == mask_.size());
  end_stroke();
  const cv::Mat before = std::exchange(mask_, mask.clone());
  remember(std::move(name), {{0, 0}, mask_.size()}, before, true);
}

// A step that left every byte as it was is none.
void MaskPainting::remember(std::string name, const cv::Rect& place, const cv::Mat& before, bool is_whole) {
  if (is_same(mask_(place), before(place))) {
    if (is_whole) whole_state_ = state_;
    return;
  }
  past_.push_back({std::move(name), place, before(place).clone(), state_, whole_state_});
  future_.clear();
  state_ = ++last_state_;
  if (is_whole) whole_state_ = state_;
  forget_oldest();
}

void MaskPainting::swap_with(Step& step) {
  cv::Mat here = mask_(step.place);
  const cv::Mat held = here.clone();
  step.other.copyTo(here);
  step.other = held;
  std::swap(step.other_state, state_);
  std::swap(step.other_whole_state, whole_state_);
}

void MaskPainting::undo() {
  if (!can_undo()) return;
  swap_with(past_.back());
  future_.push_back(std::move(past_.back()));
  past_.pop_back();
}

void MaskPainting::redo() {
  if (!can_redo()) return;
  swap_with(future_.back());
  past_.push_back(std::move(future_.back()));
  future_.pop_back();
}

// The newest stays, however large.
void MaskPainting::forget_oldest() {
  std::size_t bytes = 0;
  std::size_t kept = 0;
  while (kept < past_.size() && kept < kMaxSteps) {
    bytes += past_[past_.size() - 1 - kept].other.total();
    if (kept > 0 && bytes > kMaxBytesInHistory) break;
    ++kept;
  }
  past_.erase(past_.begin(), past_.end() - static_cast<std::ptrdiff_t>(kept));
}

}  // namespace sigs::editor
