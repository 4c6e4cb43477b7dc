// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/method.h"

namespace sigs {

// Decides when more frames no longer change the mask. As a verdict costs as much as decoding many frames, it is checked
// at few counts of frames, first 100, then 1.5 times as many each time. Converged: in at least three checks in a row,
// over at least ten seconds of footage,
// - the mask changed by less than the limit,
// - at least half of what is not masked is known to be world (confidence below 0.25): a sky that is plain at first does
//   not end the detection,
// - no square of 2 % of the image's diagonal is undecided (confidence 0.3 to 0.7), as a part that changes sides is.
class ConvergenceCheck {
 public:
  // min_change: limit of 1 - intersection over union of the masks of successive checks, 0..1. 0: never converges.
  explicit ConvergenceCheck(double min_change) : min_change_(min_change) {}

  // Whether check() is to be called after so many frames.
  [[nodiscard]] bool is_check_due(int frames_used) const { return min_change_ > 0 && frames_used >= next_check_; }

  // passed_s: time from the first frame used to this one.
  void check(const Verdict& verdict, int frames_used, double passed_s);

  [[nodiscard]] bool is_converged() const { return converged_; }

  // Of the last check: 1 - intersection over union with the mask before; 1 where either is undecided.
  [[nodiscard]] double last_change() const { return last_change_; }

 private:
  double min_change_ = 0;
  int next_check_ = 100;
  int quiet_checks_ = 0;
  bool converged_ = false;
  double last_change_ = 1;
  cv::Mat mask_;              // of the check before; empty: undecided
  double checked_s_ = 0;      // time of the check before
  double quiet_since_s_ = 0;  // time of the check with which the first of the quiet ones in a row was compared
};

}  // namespace sigs
