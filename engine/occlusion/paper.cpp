// SPDX-License-Identifier: MIT
#include "occlusion/paper.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/ensure.h"
#include "occlusion/paper_steps.h"
#include "occlusion/soft_edge.h"

namespace sigs {

namespace {

struct RoughMask {  // section 4.1
  cv::Mat sum;
  cv::Mat canny;
  cv::Mat grown;
  cv::Mat mask;
};

struct RefinedMask {  // section 4.2
  cv::Mat sobel;
  cv::Mat closed_edges;
  cv::Mat with_padding;  // one row and two columns larger
  cv::Mat filled;
  cv::Mat mask;
};

RoughMask rough_mask(const cv::Mat& sum_of_differences, const PaperOwnBodySettings& settings) {
  RoughMask rough;
  rough.sum = normalised_sum(sum_of_differences);
  rough.canny = canny_edges(rough.sum, canny_thresholds(rough.sum, settings));
  rough.grown = dilated(rough.canny, dilation_px(settings, rough.sum.size()));
  rough.mask = contours_filled(rough.grown);
  return rough;
}

RefinedMask refined_mask(const cv::Mat& rough, const PaperOwnBodySettings& settings) {
  RefinedMask refined;
  refined.sobel = sobel_edges(rough);
  refined.closed_edges = closed(refined.sobel, closing_px(settings, rough.size()));
  refined.with_padding = padded(refined.closed_edges);
  refined.filled = unpadded(contours_filled(refined.with_padding));
  refined.mask = without_small(refined.filled, settings.least_area_percent);
  return refined;
}

// A padded mask in the image's size: its padding lies on the rim.
cv::Mat padding_shown(const cv::Mat& with_padding) {
  cv::Mat out = unpadded(with_padding);
  cv::bitwise_or(out.col(0), with_padding(cv::Rect(0, 0, 1, out.rows)), out.col(0));
  cv::bitwise_or(out.col(out.cols - 1), with_padding(cv::Rect(out.cols + 1, 0, 1, out.rows)), out.col(out.cols - 1));
  out.row(out.rows - 1).setTo(255);
  return out;
}

std::vector<DetectionStage> stages_of(const RoughMask& rough, const RefinedMask& refined) {
  return {{"difference_sum", "Sum of normalised differences", rough.sum},
          {"canny", "Canny edges of the sum", rough.canny},
          {"dilated", "Dilated", rough.grown},
          {"rough", "Rough mask: external contours filled", rough.mask},
          {"sobel", "Sobel across and down", refined.sobel},
          {"closed", "Closed", refined.closed_edges},
          {"padded", "Sides and bottom padded", padding_shown(refined.with_padding)},
          {"filled", "Closed contours filled", refined.filled},
          {"refined", "Refined mask: small contours dropped", refined.mask}};
}

cv::Mat confidence_in(const cv::Mat& mask, const PaperOwnBodySettings& settings) {
  constexpr double kSobelReach_px = 1;
  const double border_moves_px = 0.5 * dilation_px(settings, mask.size()) + kSobelReach_px;
  cv::Mat out = signed_distance_px(mask) / (2 * border_moves_px) + 0.5;
  cv::min(out, 1, out);
  cv::max(out, 0, out);
  return out;
}

class PaperMethod final : public DetectionMethod {
 public:
  PaperMethod(const PaperOwnBodySettings& settings, cv::Size size_px)
      : settings_(settings), sum_(cv::Mat::zeros(size_px, CV_32FC1)) {}

  void add(const cv::Mat& luma) override {
    ENSURE(luma.type() == CV_8UC1 && luma.size() == sum_.size());
    if (!previous_.empty()) {
      cv::absdiff(luma, previous_, difference_);
      moved_ |= add_normalised(difference_, sum_);
    }
    luma.copyTo(previous_);
  }

  [[nodiscard]] Verdict verdict(KeepStages keep) const override {
    const RoughMask rough = rough_mask(sum_, settings_);
    const RefinedMask refined = refined_mask(rough.mask, settings_);
    Verdict verdict;
    if (keep == KeepStages::yes) verdict.stages = stages_of(rough, refined);
    if (!moved_) verdict.undecided = "nothing moves: no frame differs from the one before";
    verdict.own_body = moved_ ? refined.mask : cv::Mat::zeros(sum_.size(), CV_8UC1);
    verdict.confidence =
        moved_ ? confidence_in(refined.mask, settings_) : cv::Mat(sum_.size(), CV_32FC1, cv::Scalar(0.5));
    return verdict;
  }

 private:
  PaperOwnBodySettings settings_;
  cv::Mat sum_;  // single precision: after n frames, differences below n / 2^24 of the largest are lost
  cv::Mat previous_;
  cv::Mat difference_;
  bool moved_ = false;
};

}  // namespace

std::unique_ptr<DetectionMethod> paper_method(const PaperOwnBodySettings& settings, cv::Size size_px) {
  return std::make_unique<PaperMethod>(settings, size_px);
}

}  // namespace sigs
