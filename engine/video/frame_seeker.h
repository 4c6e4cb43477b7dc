// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/result.h"
#include "video/libav/frame_decoder.h"
#include "video/libav/frame_order.h"

namespace sigs {

// The image that is shown as the n-th, which depends on the file and n alone. A *run* is what a fresh decoder makes
// of the packets from a start, a keyframe, on; up to the first packet that is damaged its images are intact.
//   1. The n-th image is taken from the nearest start at or before it whose run has it intact.
//   2. Starts are gone back over until there is one, or until a run got over a whole group of images before its
//      damage: then the start was right and the footage is damaged. Starts that are no keyframes have no run.
//   3. An image that no run has intact is substituted by the last intact one before it, or the first intact one at all.
// Where images stand alone each has a run of its own, and there is nothing to go back to.
class FrameSeeker {
 public:
  FrameSeeker(libav::FrameDecoder stream, libav::FrameOrder order, const libav::PacketTable& table,
              size_t bytes_to_keep);

  struct Found {
    const libav::DecodedFrame* image = nullptr;  // null: no image of the file is intact
    int n = 0;                                   // which image it is
  };

  // Valid until the next call.
  [[nodiscard]] Result<Found> find(int n);

 private:
  struct Placed {
    libav::DecodedFrame image;
    int n = 0;
  };
  struct Start {
    int n = 0;
    int ordinal = 0;
  };
  static constexpr int kNone = std::numeric_limits<int>::max();

  void list_starts();
  [[nodiscard]] int ordinal_of(int n) const { return order_.ordinals[static_cast<size_t>(n)]; }
  [[nodiscard]] int count() const { return static_cast<int>(order_.ordinals.size()); }
  [[nodiscard]] size_t nearest_start(int n) const;
  [[nodiscard]] int end_of_group(size_t start) const;
  [[nodiscard]] bool is_excused(int ordinal) const;
  [[nodiscard]] bool is_intact(size_t start, int n) const;
  [[nodiscard]] bool got_over_a_group(size_t start, int n) const;
  [[nodiscard]] Result<bool> show(int n);
  [[nodiscard]] Result<int> substitute_of(int n);
  void hold_as_substitute(int n);
  [[nodiscard]] Result<void> run(size_t start, int n);
  [[nodiscard]] Result<void> run_alone(int n);
  [[nodiscard]] Result<void> run_on_to(int n);
  [[nodiscard]] bool goes_on_to(size_t start, int n) const;
  [[nodiscard]] Result<void> begin(size_t start, int from, int end);
  void note_damage();
  void place(libav::DecodedFrame image);
  void miss_up_to(int n);
  [[nodiscard]] const Placed* kept(int n) const;
  void keep(Placed placed);

  libav::FrameDecoder stream_;
  libav::FrameOrder order_;
  std::vector<int> first_place_;    // n by ordinal; -1: makes no image
  std::vector<int> last_ordinals_;  // by n: the last packet, in decoding, of the images up to the n-th
  std::vector<Start> starts_;       // the first is where the file begins
  int head_end_ = 0;                // packets before it that make no image lean on what lies before the file
  size_t bytes_to_keep_ = 0;

  std::vector<int> damage_;  // by start: the first damaged packet of its run as far as it is known; kNone: none
  int head_damage_ = kNone;  // the first damaged packet of those before the first start in presentation
  std::set<std::pair<size_t, int>> missing_;  // start and n: its run does not make the image
  std::set<int> damaged_;                     // where images stand alone: ordinals
  std::vector<int> shown_;                    // by n: which image is shown; -1: not known yet

  std::deque<Placed> kept_;           // intact images, the newest last
  std::optional<Placed> substitute_;  // the one used last
  size_t start_ = 0;                  // of the run that the decoder is in
  bool running_ = false;
  int newest_ = -1;  // the last image of the run that came out
  int end_ = 0;      // ordinal before which the run stops
};

}  // namespace sigs
