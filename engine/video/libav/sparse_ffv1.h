// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace sigs::libav {

// Makes of mostly black grey pictures the very packets that FFmpeg's FFV1 encoder makes, in a fraction of its time.
// Slice headers are the encoder's own; what stands behind them is compared with it before anything is made.
class SparseFfv1 {
 public:
  // A picture's packet from the encoder; empty where it failed. Pictures do not depend on one another.
  using Encode = std::function<std::vector<uint8_t>(const cv::Mat& picture)>;

  // None where the encoder makes other packets than this would: another version of it, too small a picture.
  [[nodiscard]] static std::optional<SparseFfv1> like(const Encode& encode, cv::Size size_px);

  // Nothing for a picture of which more than a quarter of the rows hold anything: FFmpeg, on many threads, is as quick.
  [[nodiscard]] std::optional<std::vector<uint8_t>> packet_of(const cv::Mat& picture) const;

 private:
  struct Slice {
    cv::Rect part;
    std::vector<uint8_t> header;
  };
  [[nodiscard]] std::vector<uint8_t> packet_anyway(const cv::Mat& picture) const;

  std::vector<Slice> slices_;
};

}  // namespace sigs::libav
