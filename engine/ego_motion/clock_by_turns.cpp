// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "ego_motion/clock_sync.h"
#include "ego_motion/turn_search.h"

namespace sigs {

namespace {

constexpr std::size_t kMinTurnsToCompare = 20;

// The mean over two seconds about each value taken from it.
std::vector<glm::dvec3> without_slow_part(const std::vector<glm::dvec3>& values, std::size_t half) {
  std::vector<glm::dvec3> sums{glm::dvec3(0)};
  for (const glm::dvec3& value : values) sums.push_back(sums.back() + value);
  std::vector<glm::dvec3> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t from = i - std::min(i, half);
    const std::size_t to = std::min(values.size(), i + half + 1);
    out.push_back(values[i] - (sums[to] - sums[from]) / static_cast<double>(to - from));
  }
  return out;
}

// Angles of both cameras at the second one's frames, and what the fit needs of them.
class FineFit {
 public:
  FineFit(const AnglePath& first, const AnglePath& second, const CoarseOffset& start, bool fits_rotation)
      : first_(first),
        second_(second),
        rotation_(start.first_from_second),
        fits_rotation_(fits_rotation),
        shift_s_(start.offset_s),
        drift_(start.drift) {
    const double from_s = std::max(second.first_s(), first.first_s() - start.offset_s);
    const double to_s = std::min(second.last_s(), first.last_s() - start.offset_s);
    middle_s_ = (from_s + to_s) / 2;
    span_s_ = to_s - from_s;
  }

  // With drift first, which is kept where it is significant.
  [[nodiscard]] Result<TurnSync> run() {
    constexpr double kLongEnough_s = 60;  // in less, a drift of clocks is shorter than errors of attitudes that last
    const bool may_drift = span_s_ >= kLongEnough_s;
    if (!may_drift) drift_ = 0;
    if (!converged(may_drift)) return failed();
    const double drift_sd = may_drift ? deviations_[1] : std::numeric_limits<double>::infinity();
    constexpr double kSignificant = 3;
    if (may_drift && !(std::abs(drift_) > kSignificant * drift_sd)) {
      drift_ = 0;
      if (!converged(false)) return failed();
    }
    constexpr double kLeastSd_s = 0.0003;  // times are stated to a millisecond by some containers
    TurnSync sync{.first_from_second = rotation_, .correlation = correlation_, .overlap_s = seen_s_};
    sync.clock = {.offset_s = shift_s_ - drift_ * middle_s_,
                  .drift = drift_,
                  .sd_s = std::hypot(deviations_[0], kLeastSd_s),
                  .drift_sd = drift_sd,
                  .middle_s = middle_s_};
    if (fits_rotation_)
      for (std::size_t axis = deviations_.size() - 3; axis < deviations_.size(); ++axis)
        sync.rotation_sd_rad = std::max(sync.rotation_sd_rad, deviations_[axis]);
    return sync;
  }

 private:
  static constexpr double kHalfWindow_s = 1;
  static constexpr std::size_t kMinRun = 8;  // frames

  struct Node {
    double time_s = 0;
    std::vector<glm::dvec3> slopes;  // of what the first camera has turned by, by each unknown
    glm::dvec3 residual{0};          // second less first
    glm::dvec3 of_first{0};
    glm::dvec3 of_second{0};
  };

  [[nodiscard]] static tl::unexpected<Error> failed() {
    return fail("", "the cameras have too few frames in common to compare how they turn");
  }

  [[nodiscard]] double first_time_s(double t) const { return t + shift_s_ + drift_ * (t - middle_s_); }

  // Iterates to the least squares. False: too few frames in common, or no minimum nearby.
  bool converged(bool fits_drift) {
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Node> nodes = nodes_of(fits_drift);
      if (nodes.size() < kMinTurnsToCompare) return false;
      const double scale = scale_of(nodes);
      NormalEquations equations(static_cast<int>(nodes[0].slopes.size()));
      for (const Node& node : nodes)
        for (int axis = 0; axis < 3; ++axis)
          equations.add(along(node, axis), node.residual[axis], weight_of(node, scale));
      const std::vector<double> changes = equations.solved();
      apply(changes, fits_drift);
      if (!std::isfinite(shift_s_) || !std::isfinite(drift_)) return false;
      if (std::abs(changes[0]) < 1e-7 || round + 1 == kRounds) {
        measure(nodes, scale, equations);
        return std::abs(changes[0]) < 1e-3;
      }
    }
    return false;
  }

  void apply(const std::vector<double>& changes, bool fits_drift) {
    constexpr double kLongest_s = 0.05;
    shift_s_ += std::clamp(changes[0], -kLongest_s, kLongest_s);
    if (fits_drift) drift_ = std::clamp(drift_ + changes[1], -0.01, 0.01);
    if (!fits_rotation_) return;
    const std::size_t at = fits_drift ? 2 : 1;
    rotation_ = glm::normalize(turn_of({changes[at], changes[at + 1], changes[at + 2]}) * rotation_);
  }

  static std::vector<double> along(const Node& node, int axis) {
    std::vector<double> slopes;
    for (const glm::dvec3& slope : node.slopes) slopes.push_back(slope[axis]);
    return slopes;
  }

  static double scale_of(const std::vector<Node>& nodes) {
    std::vector<double> sizes;
    for (const Node& node : nodes) sizes.push_back(glm::length(node.residual));
    constexpr double kWide = 4;
    return std::max(1e-12, kWide * median(std::move(sizes)));
  }
  static double weight_of(const Node& node, double scale) {
    return geman_mcclure(squared_length(node.residual), scale * scale);
  }

  // Frames of the second camera that the first has seen too, in runs without a gap of either.
  [[nodiscard]] std::vector<Node> nodes_of(bool fits_drift) const {
    std::vector<Node> nodes;
    for (const AnglePath::Piece& piece : second_.pieces()) {
      std::vector<Node> run;
      std::optional<std::size_t> piece_of_first;
      for (std::size_t i = 0; i < piece.times_s.size(); ++i) {
        const auto at = first_.at(first_time_s(piece.times_s[i]));
        if (!run.empty() && (!at || at->piece != *piece_of_first)) end(run, nodes);
        if (!at) continue;
        piece_of_first = at->piece;
        run.push_back(node_of(piece.times_s[i], rotation_ * piece.angles_rad[i], *at, fits_drift));
      }
      end(run, nodes);
    }
    return nodes;
  }

  [[nodiscard]] Node node_of(double time_s, const glm::dvec3& of_second, const AnglePath::At& at,
                             bool fits_drift) const {
    Node node{.time_s = time_s, .slopes = {at.rate_radps}, .of_first = at.angle_rad, .of_second = of_second};
    if (fits_drift) node.slopes.push_back((time_s - middle_s_) * at.rate_radps);
    if (fits_rotation_)
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 about(0);
        about[axis] = 1;
        node.slopes.push_back(-glm::cross(about, of_second));
      }
    return node;
  }

  // Takes the slow part from all that a run has, which belongs to the drift of attitudes seen in images.
  static void end(std::vector<Node>& run, std::vector<Node>& nodes) {
    if (run.size() >= kMinRun) {
      const double step_s = (run.back().time_s - run.front().time_s) / static_cast<double>(run.size() - 1);
      const auto half = static_cast<std::size_t>(std::max(2.0, kHalfWindow_s / step_s));
      const auto take_slow_part = [&](const auto& value) {
        std::vector<glm::dvec3> values;
        for (Node& node : run) values.push_back(value(node));
        values = without_slow_part(values, half);
        for (std::size_t i = 0; i < run.size(); ++i) value(run[i]) = values[i];
      };
      for (std::size_t k = 0; k < run[0].slopes.size(); ++k)
        take_slow_part([k](Node& node) -> glm::dvec3& { return node.slopes[k]; });
      take_slow_part([](Node& node) -> glm::dvec3& { return node.of_first; });
      take_slow_part([](Node& node) -> glm::dvec3& { return node.of_second; });
      for (Node& node : run) {
        node.residual = node.of_second - node.of_first;
        nodes.push_back(node);
      }
    }
    run.clear();
  }

  // The sum of squares of residuals after noise of single frames is taken from them: means over a fifth of a second.
  static double lasting_squares(const std::vector<Node>& nodes, double scale) {
    constexpr double kMean_s = 0.2;
    glm::dvec3 sum(0);
    double weights = 0;
    double squares = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const double weight = weight_of(nodes[n], scale);
      sum += weight * nodes[n].residual;
      weights += weight;
      const bool ends =
          n + 1 == nodes.size() || std::floor(nodes[n + 1].time_s / kMean_s) != std::floor(nodes[n].time_s / kMean_s);
      if (!ends) continue;
      if (weights > 0) squares += squared_length(sum) / weights;
      sum = glm::dvec3(0);
      weights = 0;
    }
    return squares;
  }

  // Standard deviations and the correlation.
  void measure(const std::vector<Node>& nodes, double scale, const NormalEquations& equations) {
    const cv::Mat_<double> inverse = equations.inverse();
    cv::Mat scatter = cv::Mat::zeros(inverse.size(), CV_64F);
    cv::Mat score = cv::Mat::zeros(inverse.rows, 1, CV_64F);
    constexpr double kBlock_s = 0.5;
    double squares = 0;
    double weights = 0;
    double blocks = 0;
    double mixed = 0;
    double of_first = 0;
    double of_second = 0;
    double rates = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Node& node = nodes[n];
      const double weight = weight_of(node, scale);
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < inverse.rows; ++k)
          score.at<double>(k) += weight * node.slopes[static_cast<std::size_t>(k)][axis] * node.residual[axis];
      squares += weight * squared_length(node.residual);
      weights += 3 * weight;
      mixed += glm::dot(node.of_first, node.of_second);
      of_first += squared_length(node.of_first);
      of_second += squared_length(node.of_second);
      rates += weight * squared_length(node.slopes[0]);
      const bool ends =
          n + 1 == nodes.size() || std::floor(nodes[n + 1].time_s / kBlock_s) != std::floor(node.time_s / kBlock_s);
      if (!ends) continue;
      scatter += score * score.t();
      score.setTo(0);
      ++blocks;
    }
    const auto unknowns = static_cast<double>(inverse.rows);
    const cv::Mat sandwich = inverse * scatter * inverse;
    const double by_blocks = blocks > unknowns + 1 ? blocks / (blocks - unknowns) : 4;
    const double variance = squares / std::max(1.0, weights - unknowns);
    deviations_.clear();
    for (int k = 0; k < inverse.rows; ++k)
      deviations_.push_back(std::sqrt(std::max(by_blocks * sandwich.at<double>(k, k), variance * inverse(k, k))));
    correlation_ = of_first > 0 && of_second > 0 ? mixed / std::sqrt(of_first * of_second) : 0;
    seen_s_ = nodes.back().time_s - nodes.front().time_s;
    // Attitudes of real footage, whose lens is never quite that of its calibration, have errors that follow the motion.
    // They scatter little from part to part: one value in a second is taken to be independent.
    const double lasting_s = rates > 0 ? std::sqrt(lasting_squares(nodes, scale) / rates / std::max(1.0, seen_s_)) : 0;
    const double factor = std::max(1.0, lasting_s / deviations_[0]);
    for (double& deviation : deviations_) deviation *= factor;
  }

  const AnglePath& first_;
  const AnglePath& second_;
  glm::dquat rotation_;
  bool fits_rotation_;
  double shift_s_;  // at the middle
  double drift_;
  double middle_s_ = 0;
  double span_s_ = 0;
  std::vector<double> deviations_;  // offset, drift where it is fitted, three of the rotation where that is
  double correlation_ = 0;
  double seen_s_ = 0;
};

}  // namespace

std::vector<SeenTurn> frame_turns(const EgoMotion& motion) {
  std::vector<SeenTurn> turns;
  std::optional<std::size_t> before;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const EgoFrame& frame = motion.frames[k];
    if (frame.is_lost || k == 0) {
      before = k;
      continue;
    }
    if (frame.is_repeated) continue;
    const EgoFrame& last = motion.frames[*before];
    turns.push_back(
        {last.time_s, frame.time_s, vector_of(glm::conjugate(last.world_from_camera) * frame.world_from_camera)});
    before = k;
  }
  return turns;
}

Result<TurnSync> clock_by_turns(std::span<const SeenTurn> first, std::span<const SeenTurn> second,
                                const TurnSyncSettings& settings, const StepControl& control) {
  const AnglePath path_of_first(first);
  const AnglePath path_of_second(second);
  if (first.size() < kMinTurnsToCompare || second.size() < kMinTurnsToCompare || path_of_first.empty() ||
      path_of_second.empty())
    return fail("",
                fmt::format("the turns of {} frames are known, and of {} of the other camera; {} are needed of both",
                            first.size(), second.size(), kMinTurnsToCompare));
  const auto found =
      coarse_offset(path_of_first, path_of_second, settings.first_from_second, settings.max_offset_s, control);
  if (control.is_cancelled()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  constexpr double kMaxChance = 0.018;  // the fit below refuses most of what is left
  if (!found || found->chance > kMaxChance)
    return fail("",
                fmt::format("the cameras hardly turn, or not alike (correlation {:.2f} at best): no offset of their "
                            "clocks can be told from others",
                            found ? found->correlation : 0.0));
  if (found->rival_offset_s)
    return fail("",
                fmt::format("the turns agree as well at offsets of {:.2f} s and {:.2f} s: the motion repeats itself",
                            found->offset_s, *found->rival_offset_s));
  Result<TurnSync> sync = FineFit(path_of_first, path_of_second, *found, !settings.first_from_second.has_value()).run();
  if (!sync) return fail(sync.error());
  constexpr double kMinCorrelationOfAngles = 0.7;
  constexpr double kMaxSd_s = 0.1;
  if (!(sync->correlation >= kMinCorrelationOfAngles) || !(sync->clock.sd_s <= kMaxSd_s))
    return fail("", fmt::format("the cameras hardly turn, or not alike (correlation {:.2f}, {:.0f} ms of standard "
                                "deviation): the offset of their clocks is not known",
                                sync->correlation, 1000 * sync->clock.sd_s));
  return sync;
}

}  // namespace sigs
