// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "base/result.h"
#include "video/libav/picture_order.h"
#include "video/libav/picture_stream.h"

namespace sigs {

// The n-th picture of a whole decode, by the shortest way that is known to give just that: going on from the last one,
// or from the nearest picture at which decoding can begin. Where a start turns out not to be what the container said,
// the one before it is taken, in the end the file's own start.
class PictureSeeker {
 public:
  PictureSeeker(libav::PictureStream stream, libav::PictureOrder order, const libav::PacketTable& table,
                size_t bytes_to_keep);

  struct Found {
    const libav::Picture* picture = nullptr;  // null: neither the n-th picture nor any before it can be made
    bool stands_in = false;                   // it is one before the n-th, which the decoder did not give
  };

  // Valid until the next call.
  [[nodiscard]] Result<Found> find(int n);

 private:
  struct Placed {
    libav::Picture picture;
    int n = 0;
  };
  struct Start {
    int n = 0;  // 0 with ordinal 0: the file's start, always right
    int ordinal = 0;
  };

  [[nodiscard]] Start nearest_start(int n) const;
  [[nodiscard]] bool can_go_on_to(int n) const;
  [[nodiscard]] Result<void> restart(int n);
  [[nodiscard]] Result<void> advance_to(int n);
  [[nodiscard]] Result<void> look_ahead();
  [[nodiscard]] bool start_was_wrong() const;
  [[nodiscard]] bool is_damaged_at_once() const;
  [[nodiscard]] const Placed* kept(int n) const;
  void keep(Placed placed);
  [[nodiscard]] std::optional<int> place_of(int ordinal);

  libav::PictureStream stream_;
  libav::PictureOrder order_;
  std::vector<int> first_place_;  // n by ordinal; -1: makes no picture
  std::vector<Start> starts_;     // by n
  std::set<int> wrong_starts_;    // ordinals
  size_t bytes_to_keep_ = 0;
  int threads_ = 2;

  std::deque<Placed> kept_;      // the last pictures in order, the newest is where the decoder stands
  std::optional<Placed> ahead_;  // decoded, behind the picture that was asked for
  Start start_;
  bool started_ = false;
  bool start_seen_ = false;  // the picture at start_ came out and is one to start at
  bool ended_ = false;
  int last_ordinal_ = -1;
};

}  // namespace sigs
