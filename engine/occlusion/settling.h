// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/method.h"

namespace sigs {

// Decides when more frames no longer change the mask. A verdict costs as much as decoding many frames, so it is asked
// for at few counts, each half as large again as the one before. Settled: at least three looks in a row, over at least
// ten seconds of footage, changed the mask by less than the limit, with at least half of what is not masked known to
// move and no patch of the picture, as wide as 2 % of its diagonal, in doubt (confidence 0.3 to 0.7). A sky that is
// plain at first therefore does not end it, nor a part that comes and goes.
class Settling {
 public:
  // The limit: 1 - intersection over union of the masks of successive looks, 0..1; 0: never settled.
  explicit Settling(double least_change) : least_change_(least_change) {}

  [[nodiscard]] bool is_look_due(int frames_used) const { return least_change_ > 0 && frames_used >= next_look_; }

  // passed_s: from the first frame used to this one.
  void look(const Verdict& verdict, int frames_used, double passed_s);

  [[nodiscard]] bool is_settled() const { return settled_; }
  [[nodiscard]] double last_change() const { return last_change_; }

 private:
  double least_change_ = 0;
  int next_look_ = 100;
  int quiet_looks_ = 0;
  bool settled_ = false;
  double last_change_ = 1;
  cv::Mat mask_;              // of the look before; empty: none that could be told
  double looked_s_ = 0;       // when that was
  double quiet_since_s_ = 0;  // the look that the quiet ones in a row begin to be compared with
};

}  // namespace sigs
