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

namespace sigs {

// Finds the n-th image of a video in order of presentation. The result depends on the file and n alone, not on what was
// read before. A *run* is the sequence of images that a fresh decoder produces from a start (a keyframe) on; up to the
// first damaged packet its images are intact.
//   1. The n-th image is taken from the nearest start at or before it whose run has it intact.
//   2. Where the nearest start has it damaged, earlier starts are tried, until a run reaches the next start without
//      damage: then that start is a correct one and the footage is damaged. Starts that turn out to be no keyframes
//      have no run.
//   3. An image that no run has intact is substituted by the last intact one before it, else by the first intact one.
// Where each image is coded alone, each is a run of its own, and no other start is tried.
class FrameSeeker {
 public:
  //   order          the order of presentation; it belongs to the stream
  //   bytes_to_keep  memory for decoded images, so that steps back need no decoding; used from the first such step on
  //   quantisers     images come with their quantisers (DecoderSettings)
  FrameSeeker(libav::FrameDecoder stream, libav::FrameOrder order, const libav::PacketTable& table,
              size_t bytes_to_keep, bool quantisers);

  // A decoded image that is intact.
  struct Found {
    const libav::DecodedFrame* image = nullptr;  // null: no image of the file is intact
    int n = 0;                                   // the number of that image; another one where it is a substitute
  };

  // The n-th image or its substitute; valid until the next call. Errors as of FrameDecoder.
  [[nodiscard]] Result<Found> find(int n);

 private:
  // An image with its number.
  struct Placed {
    libav::DecodedFrame image;
    int n = 0;
  };
  // A keyframe: its number, and the ordinal of its packet.
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
  [[nodiscard]] bool is_outside_run(int ordinal) const;
  [[nodiscard]] bool is_intact(size_t start, int n) const;
  [[nodiscard]] bool reached_next_start(size_t start, int n) const;
  [[nodiscard]] Result<bool> show(int n);
  [[nodiscard]] Result<int> substitute_of(int n);
  void hold_as_substitute(int n);
  [[nodiscard]] Result<void> run(size_t start, int n);
  [[nodiscard]] Result<void> run_alone(int n);
  [[nodiscard]] Result<void> run_on_to(int n);
  [[nodiscard]] bool can_continue_to(size_t start, int n) const;
  [[nodiscard]] Result<void> begin(size_t start, int from, int end);
  void note_damage();
  void place(libav::DecodedFrame image);
  void note_missing_up_to(int n);
  [[nodiscard]] const Placed* kept(int n) const;
  void keep(Placed placed);

  libav::FrameDecoder stream_;
  libav::FrameOrder order_;
  std::vector<int> first_place_;    // n by ordinal; -1: the packet gives no image
  std::vector<int> last_ordinals_;  // by n: the last packet, in order of decoding, of the images up to the n-th
  std::vector<Start> starts_;       // the first is where the file begins
  int head_end_ = 0;                // packets before it that give no image depend on what lies before the file
  size_t bytes_to_keep_ = 0;        // for kept_
  bool quantisers_ = false;

  std::vector<int> damage_;  // by start: the first damaged packet of its run, as far as known; kNone: none
  int head_damage_ = kNone;  // the first damaged packet of those before the first start in presentation
  std::set<std::pair<size_t, int>> missing_;  // start and n: its run does not give the image
  std::set<int> damaged_;                     // where images are coded alone: ordinals
  std::vector<int> shown_;                    // by n: which image is given for it; -1: not known yet

  std::deque<Placed> kept_;           // intact images, the newest last
  int last_asked_ = 0;                // the number in the last call of find()
  bool has_stepped_back_ = false;     // a call of find() has asked for an earlier image than the one before it
  std::optional<Placed> substitute_;  // the one used last
  size_t start_ = 0;                  // of the decoder's present run
  bool running_ = false;              // the decoder can continue
  int newest_ = -1;                   // the last image that the run has given
  int end_ = 0;                       // ordinal before which the run ends
};

}  // namespace sigs
