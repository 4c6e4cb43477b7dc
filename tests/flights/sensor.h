// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sigs::flights {

// Grain of a sensor: normal, some codes strong, of its own in every sample and frame.
class Grain {
 public:
  explicit Grain(double sigma_codes);
  void add_to(cv::Mat& image, int frame) const;

 private:
  cv::Mat pool_;  // CV_8SC1, one row; each row of an image begins anywhere in it
};

// What an exposure that hunts makes of the light: slow swings between 0.7 and 1.3, and jumps.
[[nodiscard]] double drifting_gain(int frame);

}  // namespace sigs::flights
