// SPDX-License-Identifier: MIT
#include "editor/preview/rate_meter.h"

#include <algorithm>

namespace sigs::editor {

namespace {

constexpr double kWindow_s = 8;
constexpr double kMinStep_s = 0.1;  // of the notes that are kept: their number stays small
constexpr double kMinSpan_s = 0.2;  // a rate from less is noise

}  // namespace

void RateMeter::note(double now_s, int done) {
  const bool is_close = notes_.size() > 1 && now_s - notes_[notes_.size() - 2].time_s < kMinStep_s;
  if (is_close) notes_.pop_back();
  notes_.push_back({now_s, done});
  while (notes_.size() > 2 && now_s - notes_[1].time_s >= kWindow_s) notes_.pop_front();
}

std::optional<double> RateMeter::rate_hz() const {
  if (notes_.size() < 2) return std::nullopt;
  const double span_s = notes_.back().time_s - notes_.front().time_s;
  const int done = notes_.back().done - notes_.front().done;
  if (span_s < kMinSpan_s || done <= 0) return std::nullopt;
  return done / span_s;
}

std::optional<double> RateMeter::left_s(int total) const {
  const std::optional<double> rate = rate_hz();
  if (!rate) return std::nullopt;
  return std::max(0, total - notes_.back().done) / *rate;
}

}  // namespace sigs::editor
