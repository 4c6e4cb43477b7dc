// SPDX-License-Identifier: MIT
#include "video/picture_seeker.h"

extern "C" {
#include <libavutil/imgutils.h>
}

#include <algorithm>

namespace sigs {
namespace {

using libav::Picture;

// Going on costs decoding, seeking costs a decoder's start-up: about as much as this many pictures. Where each stands
// alone nothing but the picture asked for is decoded after a seek, and start-up is less than one of them.
constexpr int kWorthASeek = 16;
constexpr int kWorthASeekIntraOnly = 1;

size_t bytes_of(const AVFrame& frame) {
  const int bytes = av_image_get_buffer_size(static_cast<AVPixelFormat>(frame.format), frame.width, frame.height, 1);
  return bytes > 0 ? static_cast<size_t>(bytes) : 1;
}

}  // namespace

PictureSeeker::PictureSeeker(libav::PictureStream stream, libav::PictureOrder order, const libav::PacketTable& table,
                             size_t bytes_to_keep)
    : stream_(std::move(stream)),
      order_(std::move(order)),
      first_place_(static_cast<size_t>(table.size()), -1),
      bytes_to_keep_(bytes_to_keep),
      threads_(table.any_corrupt() ? 1 : 2) {
  for (int n = 0; n < static_cast<int>(order_.ordinals.size()); ++n) {
    const int ordinal = order_.ordinals[static_cast<size_t>(n)];
    int& first = first_place_.at(static_cast<size_t>(ordinal));
    if (first < 0) first = n;
    if (order_.can_start[static_cast<size_t>(n)] && ordinal > 0) starts_.push_back({n, ordinal});
  }
}

PictureSeeker::Start PictureSeeker::nearest_start(int n) const {
  auto it = std::upper_bound(starts_.begin(), starts_.end(), n, [](int value, const Start& s) { return value < s.n; });
  while (it != starts_.begin())
    if (--it; !wrong_starts_.contains(it->ordinal)) return *it;
  return {};
}

const PictureSeeker::Placed* PictureSeeker::kept(int n) const {
  const auto it = std::find_if(kept_.begin(), kept_.end(), [n](const Placed& placed) { return placed.n == n; });
  return it == kept_.end() ? nullptr : &*it;
}

void PictureSeeker::keep(Placed placed) {
  const size_t most = std::clamp<size_t>(bytes_to_keep_ / bytes_of(*placed.picture.frame), 1, 32);
  kept_.push_back(std::move(placed));
  while (kept_.size() > most) kept_.pop_front();
}

bool PictureSeeker::can_go_on_to(int n) const {
  if (!started_ || kept_.empty() || n < kept_.back().n) return false;
  if (ahead_ && n <= ahead_->n) return true;
  const int worth_a_seek = order_.intra_only ? kWorthASeekIntraOnly : kWorthASeek;
  return nearest_start(n).ordinal <= stream_.fed() + worth_a_seek;
}

Result<void> PictureSeeker::restart(int n) {
  start_ = nearest_start(n);
  kept_.clear();
  ahead_.reset();
  started_ = true;
  start_seen_ = start_.ordinal == 0;
  ended_ = false;
  last_ordinal_ = -1;
  return stream_.start(start_.ordinal, {.threads = threads_, .reorder_depth = order_.reorder_depth});
}

// One packet may make several pictures; they come out one after the other.
std::optional<int> PictureSeeker::place_of(int ordinal) {
  int n = first_place_.at(static_cast<size_t>(ordinal));
  if (n < 0) return {};
  const int newest = ahead_ ? ahead_->n : kept_.empty() ? -1 : kept_.back().n;
  if (ordinal == last_ordinal_ && newest + 1 < static_cast<int>(order_.ordinals.size()) &&
      order_.ordinals[static_cast<size_t>(newest) + 1] == ordinal)
    n = newest + 1;
  return n;
}

Result<void> PictureSeeker::look_ahead() {
  while (!ahead_ && !ended_) {
    Result<std::optional<Picture>> picture = stream_.next();
    if (!picture) return fail(picture.error());
    if (!*picture) {
      ended_ = true;
      break;
    }
    const std::optional<int> n = place_of((*picture)->ordinal);
    last_ordinal_ = (*picture)->ordinal;
    if ((*picture)->ordinal == start_.ordinal && (order_.intra_only || libav::is_key(*(*picture)->frame)))
      start_seen_ = true;
    // Before the start: shown earlier but decoded later, it may lean on what was not decoded.
    if (!n || *n < start_.n || (!kept_.empty() && *n <= kept_.back().n)) continue;
    ahead_ = Placed{std::move(**picture), *n};
  }
  return {};
}

Result<void> PictureSeeker::advance_to(int n) {
  while (kept_.empty() || kept_.back().n < n) {
    if (const Result<void> looked = look_ahead(); !looked) return looked;
    if (!ahead_ || ahead_->n > n || !start_seen_) return {};
    keep(std::move(*ahead_));
    ahead_.reset();
  }
  return {};
}

// How a decoder patches a damaged picture depends on those before it. Only if a whole group of pictures was sound is
// the patch that of a whole decode.
bool PictureSeeker::is_damaged_at_once() const {
  const std::optional<int> damaged = stream_.first_damage();
  return damaged && std::none_of(starts_.begin(), starts_.end(), [&](const Start& start) {
           return start.ordinal > start_.ordinal && start.ordinal <= *damaged;
         });
}

bool PictureSeeker::start_was_wrong() const {
  return !start_seen_ || kept_.empty() || is_damaged_at_once();
}

Result<PictureSeeker::Found> PictureSeeker::find(int n) {
  if (const Placed* placed = kept(n)) return Found{&placed->picture, false};
  bool go_on = can_go_on_to(n);
  while (true) {
    Result<void> moved = go_on ? Result<void>() : restart(n);
    if (moved) moved = advance_to(n);
    if (!moved) return fail(moved.error());
    go_on = false;
    if (stream_.first_damage() && threads_ > 1) {
      threads_ = 1;  // what two threads make of a damaged stream can depend on which of them is ahead
    } else if (start_was_wrong() && start_.ordinal > 0) {
      wrong_starts_.insert(start_.ordinal);
    } else {
      if (kept_.empty()) return Found{};
      return Found{&kept_.back().picture, kept_.back().n != n};
    }
  }
}

}  // namespace sigs
