// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/ensure.h"
#include "base/threads.h"

namespace sigs {

cv::Mat distance_px(const cv::Mat& mask) {
  ENSURE(mask.type() == CV_8UC1 && !mask.empty());
  if (cv::countNonZero(mask) == 0) return {mask.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::infinity())};
  cv::Mat out;
  cv::distanceTransform(mask == 0, out, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return out;
}

cv::Mat signed_distance_px(const cv::Mat& mask) {
  constexpr double kCenterToBorder_px = 0.5;
  cv::Mat inside = distance_px(mask == 0) - kCenterToBorder_px;
  const cv::Mat outside = kCenterToBorder_px - distance_px(mask);
  outside.copyTo(inside, mask == 0);
  return inside;
}

cv::Mat soft_edged(const cv::Mat& mask, double width_px) {
  ENSURE(width_px >= 0);
  if (width_px <= 1) return mask != 0;
  cv::Mat inward_px = signed_distance_px(mask);
  cv::min(inward_px, width_px, inward_px);  // infinity has no 8-bit value
  cv::max(inward_px, -width_px, inward_px);
  cv::Mat out;
  inward_px.convertTo(out, CV_8U, 255 / width_px, 0.5 * 255);
  return out;
}

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

double intersection_over_union(const cv::Mat& a, const cv::Mat& b) {
  ENSURE(a.type() == CV_8UC1 && b.type() == CV_8UC1 && a.size() == b.size());
  constexpr double kHalf = 128;
  const cv::Mat in_a = a >= kHalf;
  const cv::Mat in_b = b >= kHalf;
  const int either = cv::countNonZero(in_a | in_b);
  return either == 0 ? 1.0 : static_cast<double>(cv::countNonZero(in_a & in_b)) / either;
}

namespace {

constexpr double kGrowth = 1.5;
constexpr int kQuietChecks = 3;
constexpr double kQuiet_s = 10;         // a turn that brings other ground into view takes some seconds
constexpr double kSurelyWorld = 0.25;   // confidence below it
constexpr double kMinKnown = 0.5;       // share of what is not masked that is surely world
constexpr double kUndecidedFrom = 0.3;  // confidence
constexpr double kUndecidedTo = 0.7;
constexpr double kSquare = 0.02;  // side by the image's diagonal: wider than the undecided band along a border

bool is_world_known(const Verdict& verdict) {
  const cv::Mat world = verdict.own_body == 0;
  const cv::Mat surely = verdict.confidence < kSurelyWorld;
  return cv::countNonZero(world & surely) >= kMinKnown * cv::countNonZero(world);
}

// A part that one check takes for body and the next for world is undecided before it changes sides.
bool has_undecided_square(const Verdict& verdict) {
  cv::Mat undecided;
  cv::inRange(verdict.confidence, kUndecidedFrom, kUndecidedTo, undecided);
  const int side_px = std::max(3, static_cast<int>(std::lround(kSquare * std::hypot(undecided.cols, undecided.rows))));
  cv::erode(undecided, undecided, cv::Mat::ones(side_px, side_px, CV_8U));
  return cv::countNonZero(undecided) > 0;
}

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols)) != 0) return false;
  return true;
}

FrameSteps steps_of(const VideoInfo& footage, int first_frame, const OwnBodySettings& settings) {
  const int passed = std::min(settings.frames, footage.frame_count() - first_frame);
  return {.first = first_frame, .every = settings.every, .count = (passed - 1) / settings.every + 1};
}

// One detection, from the first frame to the verdict.
class Detection {
 public:
  Detection(FrameSource& footage, int first_frame, const OwnBodySettings& settings, const DetectionControl& control)
      : footage_(footage),
        path_(footage.info().path.string()),
        settings_(settings),
        control_(control),
        steps_(steps_of(footage.info(), first_frame, settings)),
        method_(detection_method(settings, footage.info().size_px)),
        convergence_(settings.settled_percent / 100) {}

  [[nodiscard]] Result<OwnBody> run() {
    if (steps_.count < 2) return fail(too_few());
    if (const Result<void> processed = process_frames(); !processed) return fail(processed.error());
    if (used_ < 2) return fail(too_few());
    if (!anything_differs_)
      return fail(path_, fmt::format("nothing moves: all {} frames are equal; take a clip in flight", used_));
    if (!verdict_ || control_.stages == KeepStages::yes) verdict_ = method_->verdict(control_.stages);
    if (verdict_->undecided) return fail(undecided(*verdict_->undecided));
    return own_body();
  }

 private:
  [[nodiscard]] Result<void> process_frames() {
    LumaStream stream(footage_, steps_);
    while (std::optional<Result<LumaFrame>> frame = stream.next()) {
      if (const Result<void> on = check_interrupt(control_.cancel); !on) return on;
      if (!*frame) return fail(unreadable(frame->error()));
      add(**frame);
      if (control_.progress) control_.progress(passed_, passed_of_all());
      if (convergence_.is_converged()) break;
    }
    return {};
  }

  void add(const LumaFrame& frame) {
    passed_ = frame.number - steps_.first + 1;
    if (frame.damaged) {
      ++damaged_;
      return;
    }
    if (first_luma_.empty())
      first_luma_ = frame.luma;
    else if (!anything_differs_)
      anything_differs_ = !is_same(first_luma_, frame.luma);
    method_->add(frame.luma);
    ++used_;
    verdict_.reset();
    if (convergence_.is_check_due(used_)) check(frame.number);
  }

  void check(int number) {
    const std::vector<double>& times_s = footage_.info().times_s;
    const double passed_s = times_s[static_cast<std::size_t>(number)] - times_s[static_cast<std::size_t>(steps_.first)];
    verdict_ = method_->verdict(KeepStages::no);
    convergence_.check(*verdict_, used_, passed_s);
  }

  [[nodiscard]] OwnBody own_body() {
    OwnBody found{.mask = soft_edged(verdict_->own_body, settings_.soft_edge_px),
                  .stages = std::move(verdict_->stages),
                  .frames_used = used_,
                  .frames_passed = passed_,
                  .converged = convergence_.is_converged(),
                  .last_change = convergence_.is_converged() ? convergence_.last_change() : 0,
                  .share = static_cast<double>(cv::countNonZero(verdict_->own_body)) /
                           static_cast<double>(verdict_->own_body.total())};
    verdict_->confidence.convertTo(found.confidence, CV_16U, 65535);
    if (damaged_ > 0)
      found.warnings.push_back(
          {path_, fmt::format("{} of {} frames are damaged and were left out", damaged_, damaged_ + used_)});
    return found;
  }

  [[nodiscard]] int passed_of_all() const { return steps_.at(steps_.count - 1) - steps_.first + 1; }

  [[nodiscard]] Error too_few() const {
    const int usable = used_ + damaged_ > 0 ? used_ : steps_.count;
    std::string text = usable == 1 ? "only 1 frame can be used" : "no frame can be used";
    if (damaged_ > 0) text += fmt::format(", {} are damaged", damaged_);
    if (steps_.every > 1) text += fmt::format(", each {}th is taken", steps_.every);
    return {path_, text + "; at least 2 are needed to see what moves"};
  }

  [[nodiscard]] Error undecided(const std::string& reason) const {
    constexpr int kFew = 9;  // fewer than half a second of any footage
    const std::string few = used_ <= kFew ? fmt::format("{} frames are too few to tell: ", used_) : "";
    return {path_, fmt::format("{}{}; take a longer part of the flight, with turns", few, reason)};
  }

  // Of a frame that cannot be decoded or is of another size than those before.
  [[nodiscard]] Error unreadable(Error error) const {
    if (used_ >= 2) error.what += fmt::format("; own_body.frames = {} ends before it", passed_);
    return error;
  }

  FrameSource& footage_;
  std::string path_;
  const OwnBodySettings& settings_;
  const DetectionControl& control_;
  FrameSteps steps_;
  std::unique_ptr<DetectionMethod> method_;
  ConvergenceCheck convergence_;
  cv::Mat first_luma_;
  bool anything_differs_ = false;
  int used_ = 0;
  int damaged_ = 0;
  int passed_ = 0;
  std::optional<Verdict> verdict_;  // after the last frame added, where it was asked for
};

}  // namespace

void ConvergenceCheck::check(const Verdict& verdict, int frames_used, double passed_s) {
  next_check_ = static_cast<int>(frames_used * kGrowth);
  last_change_ = mask_.empty() || verdict.undecided ? 1 : 1 - intersection_over_union(mask_, verdict.own_body);
  const bool is_quiet = last_change_ < min_change_ && is_world_known(verdict) && !has_undecided_square(verdict);
  if (is_quiet && quiet_checks_ == 0) quiet_since_s_ = checked_s_;
  quiet_checks_ = is_quiet ? quiet_checks_ + 1 : 0;
  converged_ = quiet_checks_ >= kQuietChecks && passed_s - quiet_since_s_ >= kQuiet_s;
  mask_ = verdict.undecided ? cv::Mat() : verdict.own_body;
  checked_s_ = passed_s;
}

std::unique_ptr<DetectionMethod> detection_method(const OwnBodySettings& settings, cv::Size size_px) {
  if (settings.method == OwnBodyMethod::paper) return paper_method(settings.paper, size_px);
  return stable_method(settings.stable, size_px);
}

Result<OwnBody> detect_own_body(FrameSource& footage, int first_frame, const OwnBodySettings& settings,
                                const DetectionControl& control) {
  ENSURE(first_frame >= 0 && first_frame < footage.info().frame_count());
  ENSURE(settings.frames >= 1 && settings.every >= 1 && settings.soft_edge_px >= 0);
  return Detection(footage, first_frame, settings, control).run();
}

}  // namespace sigs
