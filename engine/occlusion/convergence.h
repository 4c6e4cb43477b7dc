// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/method.h"

namespace sigs {

// Decides when more frames no longer change the mask. A verdict costs as much as decoding many frames, so it is asked
// for at few counts, each half as large again as the one before. Settled: at least three checks in a row, over at least
// ten seconds of footage, changed the mask by less than the limit, with at least half of what is not masked known to
// move and no patch of the image, as wide as 2 % of its diagonal, in doubt (confidence 0.3 to 0.7). A sky that is
// plain at first therefore does not end it, nor a part that comes and goes.
class ConvergenceCheck {
 public:
  // The limit: 1 - intersection over union of the masks of successive checks, 0..1; 0: never settled.
  explicit ConvergenceCheck(double min_change) : min_change_(min_change) {}

  [[nodiscard]] bool is_check_due(int frames_used) const { return min_change_ > 0 && frames_used >= next_check_; }

  // passed_s: from the first frame used to this one.
  void check(const Verdict& verdict, int frames_used, double passed_s);

  [[nodiscard]] bool is_converged() const { return converged_; }
  [[nodiscard]] double last_change() const { return last_change_; }

 private:
  double min_change_ = 0;
  int next_check_ = 100;
  int quiet_checks_ = 0;
  bool converged_ = false;
  double last_change_ = 1;
  cv::Mat mask_;              // of the check before; empty: none that could be told
  double checked_s_ = 0;      // when that was
  double quiet_since_s_ = 0;  // the check that the quiet ones in a row begin to be compared with
};

}  // namespace sigs
