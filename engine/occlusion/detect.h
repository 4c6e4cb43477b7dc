// SPDX-License-Identifier: MIT
#pragma once

// Distances, edges and overlap of masks. Masks are CV_8UC1. Pixel coordinates: base/image.h.
#include <atomic>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"
#include "video/frame_source.h"

namespace sigs {

// Distance of each pixel's centre from the centre of the nearest non-zero pixel, CV_32FC1, in pixels: 0 on non-zero
// pixels; +infinity everywhere in a black mask.
[[nodiscard]] cv::Mat distance_px(const cv::Mat& mask);

// Distance of each pixel's centre from the mask's border, CV_32FC1, in pixels: positive inside, negative outside. The
// border runs half a pixel from the centres on its two sides. The edge of the image is not a border: a body that
// touches it continues beyond. +infinity in a white mask, -infinity in a black one.
[[nodiscard]] cv::Mat signed_distance_px(const cv::Mat& mask);

// A hard mask (non-zero: body) with a soft edge: from 0 to 255 within width_px, centred on the border, linear in the
// signed distance. CV_8UC1. width_px >= 0; up to 1, the step between two pixels, the mask stays hard.
[[nodiscard]] cv::Mat soft_edged(const cv::Mat& mask, double width_px);

// A round structuring element for cv::dilate and cv::erode, of 2 * radius + 1 pixels.
[[nodiscard]] cv::Mat disc(int radius);

// Intersection over union of two masks of one size: 1 where they are equal, 0 where they do not overlap. A pixel
// belongs to a mask from 128 on. Two empty masks are equal.
[[nodiscard]] double intersection_over_union(const cv::Mat& a, const cv::Mat& b);

// An intermediate result of the detection as an image for inspection: 8 bit, one channel, of the footage's size.
struct DetectionStage {
  std::string name;   // part of a file name: "difference_sum"
  std::string title;  // "Sum of normalised differences"
  cv::Mat image;
};

// Whether a verdict carries its stages.
enum class KeepStages { no, yes };

// The result of a method after the frames added so far. Images are of the footage's size.
struct Verdict {
  cv::Mat own_body;                      // CV_8UC1, 255: own body, 0: world; hard edge
  cv::Mat confidence;                    // CV_32FC1: 0 surely world, 0.5 undecided, 1 surely own body
  std::vector<DetectionStage> stages;    // in order; empty unless asked for
  std::optional<std::string> undecided;  // why nothing can be decided ("nothing moves"); the mask is black then
};

// A method that finds the own body in a sequence of frames. It processes each frame once and keeps sums, not frames:
// its memory does not grow with their number.
class DetectionMethod {
 public:
  DetectionMethod() = default;
  DetectionMethod(const DetectionMethod&) = delete;
  DetectionMethod& operator=(const DetectionMethod&) = delete;
  virtual ~DetectionMethod() = default;

  // Adds a frame: its luma, CV_8UC1 of the size given to the method, full or limited range as in the footage. The
  // samples may be overwritten after the call.
  virtual void add(const cv::Mat& luma) = 0;

  // The result by the frames added so far, at least two. May be asked for at any time and does not change the method.
  [[nodiscard]] virtual Verdict verdict(KeepStages keep) const = 0;
};

// The method that the settings name. size_px: of the footage.
[[nodiscard]] std::unique_ptr<DetectionMethod> detection_method(const OwnBodySettings& settings, cv::Size size_px);

// The body is what stays in place while the world moves (README.md). vibration_px is in pixels of the footage.
[[nodiscard]] std::unique_ptr<DetectionMethod> stable_method(const StableOwnBodySettings& settings, cv::Size size_px);

// Section 4 of the paper as published: README.md says where it works; its steps are in paper.h. The confidence is the
// signed distance from the mask's border, scaled by how far the steps move that border; it does not say whether the
// method is right on this footage. Undecided where no frame differs from the one before.
[[nodiscard]] std::unique_ptr<DetectionMethod> paper_method(const PaperOwnBodySettings& settings, cv::Size size_px);

// What was found of the aircraft that carries the camera in its own footage.
struct OwnBody {
  cv::Mat mask;        // CV_8UC1 of the footage's size, 255: own body; its edge is as soft as the settings ask
  cv::Mat confidence;  // CV_16UC1: 0 surely world, 32768 undecided, 65535 surely own body
  std::vector<DetectionStage> stages;
  int frames_used = 0;
  int frames_passed = 0;   // of the footage, from the first used to the last
  bool converged = false;  // ended early: more frames no longer changed the mask (ConvergenceCheck)
  double last_change = 0;  // where converged: 1 - intersection over union of the masks of the last two checks
  double share = 0;        // of the image that is masked, 0..1
  std::vector<Warning> warnings;
};

// A mask from shorter footage, or one that covers more of the image, should be inspected before it is used.
inline constexpr double kEnoughFootage_s = 10;
inline constexpr double kLargeShare = 0.5;

struct DetectionControl {
  std::function<void(int done, int total)> progress;  // frames passed and to be passed; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
  KeepStages stages = KeepStages::no;
};

// Finds the own body in frames first_frame, first_frame + every, ... of the footage, in one pass. Memory does not grow
// with their number. Damaged frames are left out, with a warning. first_frame must be a frame of the footage. Errors:
// bad_data (fewer than 2 frames, all frames equal, nothing moves, a frame that cannot be decoded or is of another
// size), interrupted.
[[nodiscard]] Result<OwnBody> detect_own_body(FrameSource& footage, int first_frame, const OwnBodySettings& settings,
                                              const DetectionControl& control);

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
