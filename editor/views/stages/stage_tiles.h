// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame/compose_frame.h"

namespace sigs::editor {

// One image of a grid of them.
struct StageTile {
  std::string label;
  std::string tooltip;
  cv::Mat image;  // CV_8UC3 or CV_8UC1
};

// What a stage's name says: "1_bent" is "bent" of the scene's intruder 1, "bent" and "output" are nobody's.
struct StageName {
  std::optional<int> intruder;
  std::string stage;
};
[[nodiscard]] StageName stage_name(const std::string& name);

// The scene's numbers of the intruders that have stages of their own, each once, rising.
[[nodiscard]] std::vector<int> intruders_of(const std::vector<Stage>& stages);

// The stages of one intruder and those of the whole frame, in the order in which they were made, labelled as in the
// paper's figure 4. None: every stage whose name has no number.
[[nodiscard]] std::vector<StageTile> stage_tiles(const std::vector<Stage>& stages, std::optional<int> intruder);

// How much two images differ, times a gain, black where they are equal. Empty where their sizes or kinds differ.
[[nodiscard]] cv::Mat difference(const cv::Mat& a, const cv::Mat& b, double gain);

// The same, made once for each pair and gain, for the last few of them.
class Differences {
 public:
  [[nodiscard]] cv::Mat of(const cv::Mat& a, const cv::Mat& b, double gain);

 private:
  struct CachedDifference {
    cv::Mat a;  // kept, so that their addresses stay theirs
    cv::Mat b;
    double gain = 1;
    cv::Mat image;
  };
  std::vector<CachedDifference> made_;
};

}  // namespace sigs::editor
