// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sigs::flights {

// Sensor noise: normal, some codes strong, independent in every sample and frame.
class Grain {
 public:
  explicit Grain(double sigma_codes);
  void add_to(cv::Mat& image, int frame) const;

 private:
  cv::Mat pool_;  // CV_8SC1, one row; each row of an image begins anywhere in it
};

// The gain of an unstable exposure control: slow oscillation between 0.7 and 1.3, and jumps.
[[nodiscard]] double drifting_gain(int frame);

}  // namespace sigs::flights
