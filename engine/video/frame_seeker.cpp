// SPDX-License-Identifier: MIT
#include "video/frame_seeker.h"

#include <algorithm>

namespace sigs {
FrameSeeker::FrameSeeker(libav::FrameDecoder stream, libav::FrameOrder order, const libav::PacketTable& table,
                         size_t bytes_to_keep, bool quantisers)
    : stream_(std::move(stream)),
      order_(std::move(order)),
      first_place_(static_cast<size_t>(table.size()), -1),
      bytes_to_keep_(bytes_to_keep),
      quantisers_(quantisers),
      shown_(order_.ordinals.size(), -1) {
  for (int n = 0; n < count(); ++n) {
    int& first = first_place_.at(static_cast<size_t>(ordinal_of(n)));
    if (first < 0) first = n;
    last_ordinals_.push_back(n == 0 ? ordinal_of(n) : std::max(last_ordinals_.back(), ordinal_of(n)));
  }
  list_starts();
  damage_.assign(starts_.size(), kNone);
}

void FrameSeeker::list_starts() {
  const int first = *std::min_element(order_.ordinals.begin(), order_.ordinals.end());
  const int first_n = first_place_[static_cast<size_t>(first)];
  starts_.push_back({first_n, 0});
  for (int n = first_n; n < count(); ++n)
    if (order_.can_start[static_cast<size_t>(n)] && ordinal_of(n) > std::max(first, starts_.back().ordinal))
      starts_.push_back({n, ordinal_of(n)});
  head_end_ = first + 1;
  while (head_end_ < static_cast<int>(first_place_.size()) && first_place_[static_cast<size_t>(head_end_)] < 0)
    ++head_end_;
}

size_t FrameSeeker::nearest_start(int n) const {
  const auto behind =
      std::upper_bound(starts_.begin(), starts_.end(), n, [](int value, const Start& s) { return value < s.n; });
  return behind == starts_.begin() ? 0 : static_cast<size_t>(behind - starts_.begin()) - 1;
}

// The ordinal at which the group of a start ends. Images that are shown before the next start may be decoded after it.
int FrameSeeker::end_of_group(size_t start) const {
  if (start + 1 >= starts_.size()) return static_cast<int>(first_place_.size());
  const Start& next = starts_[start + 1];
  int end = std::max(next.ordinal, last_ordinals_[static_cast<size_t>(next.n) - 1] + 1);
  if (end == next.ordinal) return end;
  while (end < static_cast<int>(first_place_.size()) && first_place_[static_cast<size_t>(end)] < 0) ++end;
  return end;
}

const FrameSeeker::Placed* FrameSeeker::kept(int n) const {
  if (substitute_ && substitute_->n == n) return &*substitute_;
  const auto it = std::find_if(kept_.begin(), kept_.end(), [n](const Placed& placed) { return placed.n == n; });
  return it == kept_.end() ? nullptr : &*it;
}

void FrameSeeker::keep(Placed placed) {
  constexpr size_t kMaxOnward = 4;  // while nobody steps back: more memory would only be new pages for the decoder
  constexpr size_t kMost = 32;
  const size_t most = has_stepped_back_ ? kMost : kMaxOnward;
  const size_t max_count = std::clamp<size_t>(bytes_to_keep_ / libav::bytes_of(*placed.image.frame), 1, most);
  kept_.push_back(std::move(placed));
  while (kept_.size() > max_count) kept_.pop_front();
}

// Whether a packet does not count for the run's damage. Images that are shown before the start but decoded after it
// refer to images that were not decoded, and no image after the start refers to them.
bool FrameSeeker::is_outside_run(int ordinal) const {
  const int n = first_place_[static_cast<size_t>(ordinal)];
  if (n < 0) return start_ == 0 && ordinal < head_end_;
  return n < starts_[start_].n;
}

bool FrameSeeker::is_intact(size_t start, int n) const {
  const int ordinal = ordinal_of(n);
  if (n < starts_[start].n && head_damage_ <= ordinal) return false;
  return damage_[start] > ordinal && !missing_.contains({start, n});
}

bool FrameSeeker::reached_next_start(size_t start, int n) const {
  const int stopped = std::min(damage_[start], ordinal_of(n));
  return start + 1 < starts_.size() && starts_[start + 1].ordinal <= stopped;
}

Result<void> FrameSeeker::begin(size_t start, int from, int end) {
  start_ = start;
  end_ = end;
  running_ = true;
  newest_ = start == 0 ? -1 : starts_[start].n - 1;
  const int threads = end - from > 1 ? 2 : 1;
  return stream_.start(from, {.threads = threads, .reorder_depth = order_.reorder_depth, .quantisers = quantisers_}, end);
}

void FrameSeeker::note_damage() {
  for (int ordinal : stream_.damaged()) {
    while (order_.in_fields && ordinal > 0 && first_place_[static_cast<size_t>(ordinal)] < 0) --ordinal;
    if (order_.intra_only)
      damaged_.insert(ordinal);
    else if (is_outside_run(ordinal))
      head_damage_ = start_ == 0 ? std::min(head_damage_, ordinal) : head_damage_;
    else
      damage_[start_] = std::min(damage_[start_], ordinal);
  }
}

void FrameSeeker::note_missing_up_to(int n) {
  for (int m = newest_ + 1; m <= n; ++m) {
    if (order_.intra_only)
      damaged_.insert(ordinal_of(m));
    else
      missing_.insert({start_, m});
    if (start_ > 0 && m == starts_[start_].n) damage_[start_] = starts_[start_].ordinal;  // not a keyframe
  }
  newest_ = std::max(newest_, n);
}

// Takes an image that the decoder has given. One packet may give several images, one after the other.
void FrameSeeker::place(libav::DecodedFrame image) {
  int n = first_place_.at(static_cast<size_t>(image.ordinal));
  if (newest_ + 1 < count() && ordinal_of(newest_ + 1) == image.ordinal) n = newest_ + 1;
  if (n <= newest_) return;
  note_missing_up_to(n - 1);
  newest_ = n;
  if (start_ > 0 && image.ordinal == starts_[start_].ordinal && !libav::is_key(*image.frame))
    damage_[start_] = image.ordinal;
  const bool intact = order_.intra_only ? !damaged_.contains(image.ordinal) : is_intact(start_, n);
  if (intact) keep({std::move(image), n});
}

Result<void> FrameSeeker::run_on_to(int n) {
  while (running_ && newest_ < n) {
    Result<std::optional<libav::DecodedFrame>> image = stream_.next();
    if (!image) return fail(image.error());
    note_damage();
    if (*image) {
      place(std::move(**image));
    } else {
      running_ = false;
      note_missing_up_to(n);
    }
    if (!order_.intra_only && damage_[start_] <= ordinal_of(n)) return {};
  }
  return {};
}

bool FrameSeeker::can_continue_to(size_t start, int n) const {
  return running_ && start_ == start && n > newest_ && ordinal_of(n) < end_;
}

Result<void> FrameSeeker::run(size_t start, int n) {
  if (!can_continue_to(start, n))
    if (const Result<void> begun = begin(start, starts_[start].ordinal, end_of_group(nearest_start(n))); !begun)
      return begun;
  return run_on_to(n);
}

// For images that are coded alone. A decoder that works on one image at a time is opened afresh for each image: some
// keep tables from one to the next.
Result<void> FrameSeeker::run_alone(int n) {
  const int ordinal = ordinal_of(n);
  const bool continues = running_ && order_.decodes_ahead && n > newest_ && ordinal <= stream_.fed() + 1;
  if (!continues) {
    const int end = order_.decodes_ahead ? static_cast<int>(first_place_.size()) : ordinal + 1;
    if (const Result<void> begun = begin(0, ordinal, end); !begun) return begun;
    newest_ = first_place_[static_cast<size_t>(ordinal)] - 1;
  }
  return run_on_to(n);
}

// Decodes the n-th image, which is then among those kept. False: it is damaged.
Result<bool> FrameSeeker::show(int n) {
  if (kept(n) != nullptr) return true;
  if (order_.intra_only) {
    if (damaged_.contains(ordinal_of(n))) return false;
    if (const Result<void> ran = run_alone(n); !ran) return fail(ran.error());
    return kept(n) != nullptr;
  }
  for (size_t start = nearest_start(n);; --start) {
    if (is_intact(start, n)) {
      if (const Result<void> ran = run(start, n); !ran) return fail(ran.error());
      if (is_intact(start, n)) return kept(n) != nullptr;
    }
    if (start == 0 || reached_next_start(start, n)) return false;
  }
}

// The last intact image before the n-th, else the first one after it; -1: there is none.
Result<int> FrameSeeker::substitute_of(int n) {
  const auto known = [this](int m) { return shown_[static_cast<size_t>(m)]; };
  for (int m = n - 1; m >= 0;) {
    const Result<bool> intact = show(m);
    if (!intact) return fail(intact.error());
    if (*intact) return m;
    if (known(m) > m) break;  // there is none before it
    m = known(m) >= 0 && known(m) < m ? known(m) : m - 1;
  }
  for (int m = n > 0 && known(n - 1) > n ? known(n - 1) : n + 1; m < count(); ++m) {
    const Result<bool> intact = show(m);
    if (!intact) return fail(intact.error());
    if (*intact) return m;
  }
  return -1;
}

// Keeps a substitute separately from the other images, so that a long damaged part does not decode it again and again.
void FrameSeeker::hold_as_substitute(int n) {
  const Placed* placed = kept(n);
  if (placed == nullptr || (substitute_ && substitute_->n == n)) return;
  libav::FramePtr frame = libav::new_frame();
  if (av_frame_ref(frame.get(), placed->image.frame.get()) >= 0)
    substitute_ = Placed{{std::move(frame), placed->image.ordinal, placed->image.quantisers}, n};
}

Result<FrameSeeker::Found> FrameSeeker::find(int n) {
  if (n < last_asked_) has_stepped_back_ = true;
  last_asked_ = n;
  const Result<bool> intact = show(n);
  if (!intact) return fail(intact.error());
  int& shown = shown_[static_cast<size_t>(n)];
  shown = n;
  if (!*intact) {
    const Result<int> substitute = substitute_of(n);
    if (!substitute) return fail(substitute.error());
    shown = *substitute;
    if (shown < 0) return Found{};
    hold_as_substitute(shown);
  }
  return Found{&kept(shown)->image, shown};
}

}  // namespace sigs
