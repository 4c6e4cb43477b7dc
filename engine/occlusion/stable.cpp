// SPDX-License-Identifier: MIT
#include "occlusion/stable.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "occlusion/footage_segments.h"
#include "occlusion/gradient_sums.h"
#include "occlusion/mean_frame.h"
#include "occlusion/stable_decision.h"

namespace sigs {

namespace {

constexpr int kMinFrames = 2;
constexpr double kSmoothing = 0.7;  // pixels of the means; takes the steps out of a border, moves no straight one

cv::Mat gaussian_blurred(const cv::Mat& mask, int scale) {
  cv::Mat soft;
  mask.convertTo(soft, CV_32F, 1.0 / 255);
  if (scale > 1) cv::GaussianBlur(soft, soft, {}, kSmoothing);
  return soft;
}

class StableMethod final : public DetectionMethod {
 public:
  StableMethod(const StableOwnBodySettings& settings, cv::Size size_px)
      : settings_(settings), size_px_(size_px), averager_(size_px), gradients_(averager_.size()) {}

  void add(const cv::Mat& luma) override;
  [[nodiscard]] Verdict verdict(KeepStages keep) const override;

 private:
  [[nodiscard]] StableDecision decision() const;
  [[nodiscard]] Verdict undecided(std::string reason) const;
  [[nodiscard]] cv::Mat at_full_size(const cv::Mat& small) const;
  [[nodiscard]] std::vector<DetectionStage> stages_of(const StableDecision& decision, const cv::Mat& mask) const;

  StableOwnBodySettings settings_;
  cv::Size size_px_;
  FrameAverager averager_;
  GradientSums gradients_;
  FootageSegments segments_;
};

void StableMethod::add(const cv::Mat& luma) {
  averager_.add(luma);
  if (!averager_.is_full()) return;
  const MeanFrame image = averager_.image();
  gradients_.add(image);
  segments_.add(image);
  averager_.clear();
}

StableDecision StableMethod::decision() const {
  StableOwnBodySettings settings = settings_;
  settings.vibration_px /= averager_.scale();
  if (averager_.waiting() == 0) return stable_decision(gradients_.moments(), segments_.segments(), settings);
  GradientSums gradients = gradients_.clone();
  FootageSegments segments = segments_;
  gradients.add(averager_.image());
  segments.add(averager_.image());
  return stable_decision(gradients.moments(), segments.segments(), settings);
}

Verdict StableMethod::undecided(std::string reason) const {
  return {.own_body = cv::Mat::zeros(size_px_, CV_8UC1),
          .confidence = cv::Mat(size_px_, CV_32FC1, cv::Scalar(0.5)),
          .undecided = std::move(reason)};
}

// A pixel of the means is a square of the footage's; what these leave over at the right and the bottom is as its
// neighbour.
cv::Mat StableMethod::at_full_size(const cv::Mat& small) const {
  if (averager_.scale() == 1) return small;
  cv::Mat large;
  cv::resize(small, large, small.size() * averager_.scale(), 0, 0, cv::INTER_LINEAR);
  cv::copyMakeBorder(large, large, 0, size_px_.height - large.rows, 0, size_px_.width - large.cols,
                     cv::BORDER_REPLICATE);
  return large;
}

std::vector<DetectionStage> StableMethod::stages_of(const StableDecision& decision, const cv::Mat& mask) const {
  std::vector<DetectionStage> stages;
  for (const DetectionStage& stage : stage_images(decision))
    stages.push_back({stage.name, stage.title, at_full_size(stage.image)});
  stages.push_back({"own_body", "Own body", mask});
  cv::Mat confidence;
  at_full_size(decision.confidence).convertTo(confidence, CV_8U, 255);
  stages.push_back({"confidence", "Confidence", confidence});
  return stages;
}

Verdict StableMethod::verdict(KeepStages keep) const {
  if (averager_.frames() < kMinFrames) return undecided("fewer than 2 frames");
  const StableDecision decided = decision();
  Verdict verdict = decided.undecided
                        ? undecided(*decided.undecided)
                        : Verdict{.own_body = at_full_size(gaussian_blurred(decided.body, averager_.scale())) >= 0.5,
                                  .confidence = at_full_size(decided.confidence)};
  if (keep == KeepStages::yes) verdict.stages = stages_of(decided, verdict.own_body);
  return verdict;
}

}  // namespace

std::unique_ptr<DetectionMethod> stable_method(const StableOwnBodySettings& settings, cv::Size size_px) {
  return std::make_unique<StableMethod>(settings, size_px);
}

}  // namespace sigs
