// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "occlusion/detect.h"
#include "occlusion/mean_frame.h"
#include "occlusion/region_cut.h"
#include "occlusion/stable_motion.h"
#include "project/project.h"

namespace sigs {

namespace {

// How the method `stable` decides, step by step; images of the means' size.
struct StableDecision {
  MotionEvidence motion;
  cv::Mat drift;   // drifting() (mean_frame.h)
  cv::Mat moving;  // the maximum of motion.moving and drift, 0..1
  Boundaries boundaries;
  cv::Mat labels;      // CV_8UC1, 255: may be body, by the first of several cuts
  cv::Mat body;        // CV_8UC1, 255: body
  cv::Mat confidence;  // CV_32FC1: 0 surely world, 0.5 undecided, 1 surely body
  std::optional<std::string> undecided;
};

// Costs in the unit of CutCosts: one pixel of border.
constexpr double kMovingCost = 0.3;     // of labelling a pixel body that surely moves
constexpr double kDriftingCost = 0.05;  // that drifts: less, as drift is known for windows, not pixels
constexpr double kStillCost = 1;        // of labelling a still column of the image world
constexpr double kStayingCost = 0.05;   // of labelling an edge world that stays

// Plain sky is still too: stillness alone is weak evidence, but strong where everything around moves.
constexpr int kNear = 33;           // pixels: side of the surroundings
constexpr double kFarShare = 0.25;  // of the surroundings that moves: drift there may be the moving world at a border

// How far the evidence is trusted in a cut. First the whole image is cut with care, in several ways: plain sky beside a
// body is taken along with it unless labelling a pixel body costs something, and a slender body is lost if it does.
// Then the borders of what was found are placed with more trust: an edge within a body, such as a line of rivets, is
// not a border as long as nothing moves directly beside it.
struct Trust {
  int sure_reach = 0;           // pixels around a pixel that must move too, so that it counts as moving
  bool is_doubt_still = false;  // a pixel that does not count as moving counts as still
  double still_near_cost = 0;   // of labelling a still pixel world where everything around moves
  double lone_boundary = 1;     // share that is left of a boundary beside which nothing moves
};
constexpr Trust kCareful{.sure_reach = 3, .still_near_cost = 0.04};
constexpr double kSparingCost = 0.01;  // of labelling any pixel body
constexpr double kMaxSparingCost = 0.02;
constexpr Trust kTrusting{.sure_reach = 5, .is_doubt_still = true, .still_near_cost = 0.12, .lone_boundary = 0.7};
constexpr int kTrustReach = 10;  // pixels beside the borders
constexpr int kSoftRounds =
    16;  // of placing the borders by brightness: a boom grows out of a nose by 10 pixels in each

constexpr double kStrong = 4;   // gray levels per pixel: edges of this strength hide half of the drift beside them
constexpr int kDriftSpill = 6;  // pixels

constexpr double kMaxShare = 0.85;      // of the image that a body can fill
constexpr double kDoubtfulShare = 0.6;  // of the image that stays, though nothing in it looks like a body
constexpr double kSoftWorld = 0.75;     // of what is not body that must move by brightness where gradients show nothing
constexpr double kNothingPercent = 0.1;
constexpr double kUnsureBorder = 3;  // pixels beside the border where its position is uncertain
constexpr double kPlainWorld = 0.5;  // certainty of world that does not move

// From odds to likelihood: fitted to the parts of the synthetic flights and of reflections. Reflections that stay in
// the image are mostly kept with odds below 3, bodies with 3 and more (docs/research/own-body.md).
constexpr double kEvenOdds = 2.6;  // as often body as not
constexpr double kOddsUnit = 0.5;  // more odds by which its likelihood grows e-fold

// 0 near strong edges that stay .. 1 elsewhere: what passes beside such edges changes them more than a drift would.
cv::Mat away_from_edges(const StableDecision& decision) {
  const cv::Mat& square = decision.motion.mean_square;
  cv::Mat near = decision.boundaries.staying.mul(square / cv::Mat(square + kStrong * kStrong));
  cv::dilate(near, near, disc(kDriftSpill));
  return 1.0 - near;
}

cv::Mat boundary_of(const Boundaries& boundaries, const cv::Mat& moving, const Trust& trust) {
  cv::Mat beside;
  cv::dilate(moving, beside, disc(trust.sure_reach + 1));
  return cv::max(boundaries.ridge, boundaries.motion).mul(beside * (1 - trust.lone_boundary) + trust.lone_boundary);
}

// What the costs of cuts with the same trust share, whatever their drift and the cost of any body.
struct CutGround {
  cv::Mat moving_cost;         // of labelling what moves body
  cv::Mat far;                 // how little moves around, 0..1
  cv::Mat as_world, boundary;  // CutCosts
};

CutGround ground_of(const StableDecision& decision, const Trust& trust) {
  cv::Mat moving;
  cv::erode(decision.motion.moving, moving, disc(trust.sure_reach));
  cv::Mat near;
  cv::boxFilter(moving, near, CV_32F, {kNear, kNear}, {-1, -1}, true, cv::BORDER_REFLECT);
  const cv::Mat still = 1.0 - (trust.is_doubt_still ? moving : decision.motion.moving);
  return {.moving_cost = moving.mul(moving).mul(moving) * kMovingCost,
          .far = cv::max(1.0 - near / kFarShare, 0.0),
          .as_world = still.mul(near * trust.still_near_cost + kStillCost / moving.rows) +
                      decision.boundaries.staying.mul(1.0 - decision.moving) * kStayingCost,
          .boundary = boundary_of(decision.boundaries, moving, trust)};
}

CutCosts costs_of(const CutGround& ground, const cv::Mat& drift, double body_cost) {
  return {.as_body = ground.moving_cost + drift.mul(ground.far) * kDriftingCost + body_cost,
          .as_world = ground.as_world,
          .boundary = ground.boundary};
}

// Drift beside strong edges may be a highlight that drifts over the body, or a cloud that ends there: cuts with it and
// without it.
std::vector<cv::Mat> labellings_of(const StableDecision& decision, const cv::Mat& drift_away) {
  struct Way {
    const cv::Mat& drift;
    double body_cost;
  };
  const std::array<Way, 4> ways{Way{decision.drift, 0}, Way{drift_away, 0}, Way{decision.drift, kSparingCost},
                                Way{drift_away, kMaxSparingCost}};
  const CutGround ground = ground_of(decision, kCareful);
  std::vector<cv::Mat> labellings(ways.size());
  parallel_for(static_cast<int>(ways.size()), static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
    const Way& way = ways[static_cast<std::size_t>(i)];
    labellings[static_cast<std::size_t>(i)] = cheapest_cut(costs_of(ground, way.drift, way.body_cost));
  });
  return labellings;
}

// How much more likely than not a part is body, 0..1: 0 where it is not.
cv::Mat certainty_of_parts(const cv::Mat& odds) {
  cv::Mat against;
  cv::exp((kEvenOdds - odds) / kOddsUnit, against);
  return cv::max(2.0 / cv::Mat(1.0 + against) - 1.0, 0.0);
}

// The final border lies some way from that of the parts: pixels added to a part get the part's odds.
cv::Mat odds_nearby(const cv::Mat& odds, const cv::Mat& body) {
  cv::Mat near = odds.clone();
  for (int reached = 0, before = -1; reached != before;) {
    cv::Mat grown;
    cv::dilate(near, grown, disc(kTrustReach));
    near.copyTo(grown, near > 0);
    grown.setTo(0, ~body);
    near = grown;
    before = std::exchange(reached, cv::countNonZero(near));
  }
  return near;
}

cv::Mat confidence_of(const cv::Mat& moving, const cv::Mat& body, const BodyParts& parts) {
  cv::Mat inside;
  cv::Mat outside;
  cv::distanceTransform(body, inside, cv::DIST_L2, 3);
  cv::distanceTransform(~body, outside, cv::DIST_L2, 3);
  cv::Mat certainty = cv::max(moving, kPlainWorld) * -0.5;
  const cv::Mat odds = odds_nearby(parts.odds, body);
  cv::Mat((1.0 - moving).mul(certainty_of_parts(odds)) * 0.5).copyTo(certainty, body);
  certainty.setTo(0, parts.doubtful & ~body);
  return certainty.mul(cv::min(cv::Mat(inside + outside) / kUnsureBorder, 1.0)) + 0.5;
}

// Before anything is cut.
std::optional<std::string> why_too_little_moves(const cv::Mat& moving, double min_moving_percent) {
  const double moving_percent = 100 * cv::countNonZero(moving > 0.5) / static_cast<double>(moving.total());
  if (moving_percent < kNothingPercent) return "nothing moves";
  if (moving_percent < min_moving_percent) return "too little moves";
  return std::nullopt;
}

std::optional<std::string> why_undecided(const StableDecision& decision) {
  const auto pixels = static_cast<double>(decision.moving.total());
  if (cv::countNonZero(decision.body) > kMaxShare * pixels) return "nearly everything stays";
  if (cv::countNonZero(decision.body) == 0 && cv::countNonZero(decision.labels) > kDoubtfulShare * pixels)
    return "too little moves";
  return std::nullopt;
}

cv::Mat as_image(const cv::Mat& values, double white_at) {
  cv::Mat image;
  values.convertTo(image, CV_8U, 255 / white_at);
  return image;
}

cv::Mat root(const cv::Mat& values) {
  cv::Mat roots;
  cv::sqrt(values, roots);
  return roots;
}

// settings: lengths in pixels of the means. Where too little moves the result has its steps with KeepStages::yes alone.
StableDecision decision_by(const MotionEvidence& gradients, MotionEvidence motion, const cv::Mat& drift, int rounds,
                           const StableOwnBodySettings& settings, KeepStages keep) {
  StableDecision decision{.motion = std::move(motion), .drift = drift};
  decision.moving = cv::max(decision.motion.moving, decision.drift);
  decision.undecided = why_too_little_moves(decision.moving, settings.min_moving_percent);
  if (decision.undecided && keep == KeepStages::no) return decision;
  decision.boundaries = boundaries_of(gradients, decision.motion);
  const cv::Mat away = decision.drift.mul(away_from_edges(decision));
  const std::vector<cv::Mat> labellings = labellings_of(decision, away);
  decision.labels = labellings.front();
  const PartEvidence inside{.staying = decision.boundaries.staying,
                            .ending = decision.boundaries.ending,
                            .variation = decision.motion.variation / decision.motion.noise,
                            .drift = decision.drift,
                            .middle = cv::max(decision.boundaries.ridge, decision.boundaries.motion)};
  const BodyParts parts =
      body_parts(labellings, inside, settings.min_area_percent / 100 * static_cast<double>(decision.labels.total()));
  decision.body = parts.kept;
  const CutCosts costs = costs_of(ground_of(decision, kTrusting), away, 0);
  for (int round = 0; round < rounds; ++round) {
    const cv::Mat before = std::exchange(decision.body, cheapest_cut_near(decision.body, kTrustReach, costs));
    if (cv::countNonZero(before != decision.body) == 0) break;
  }
  decision.confidence = confidence_of(decision.moving, decision.body, parts);
  if (!decision.undecided) decision.undecided = why_undecided(decision);
  return decision;
}

// Of what is not body, the share that moves.
double share_moving_beside(const StableDecision& decision) {
  const cv::Mat world = decision.body == 0;
  return cv::countNonZero((decision.moving > 0.5) & world) / std::max(1.0, 1.0 * cv::countNonZero(world));
}

// By brightness, where it decides.
std::optional<StableDecision> soft_decision(const MotionEvidence& gradients, const std::vector<MeanFrame>& segments,
                                            const cv::Mat& drift, StableOwnBodySettings settings) {
  // A body of kMaxShare leaves the least world, of which kSoftWorld must move.
  settings.min_moving_percent = std::max(settings.min_moving_percent, 100 * kSoftWorld * (1 - kMaxShare));
  StableDecision soft = decision_by(gradients, brightness_motion_of(segments, gradients, settings.vibration_px), drift,
                                    kSoftRounds, settings, KeepStages::no);
  if (soft.undecided || share_moving_beside(soft) < kSoftWorld) return std::nullopt;
  return soft;
}

StableDecision stable_decision(const GradientMoments& moments, const std::vector<MeanFrame>& segments,
                               const StableOwnBodySettings& settings, KeepStages keep) {
  const MotionEvidence gradients = motion_of(moments, settings.vibration_px);
  const cv::Mat drift = drifting(segments, gradients.ratio);
  StableDecision decision = decision_by(gradients, gradients, drift, 1, settings, keep);
  if (!decision.undecided) return decision;
  std::optional<StableDecision> soft = soft_decision(gradients, segments, drift, settings);
  return soft ? std::move(*soft) : decision;
}

// The steps as images, CV_8UC1 of the means' size, without the result.
std::vector<DetectionStage> stage_images(const StableDecision& decision) {
  constexpr double kWhiteGradient = 20;  // gray levels per pixel
  return {
      {"mean_gradient", "Mean gradient: edges that stay", as_image(root(decision.motion.mean_square), kWhiteGradient)},
      {"coherence", "Coherence of the gradient over time", as_image(coherence_of(decision.motion), 1)},
      {"variation", "Variation of the gradient: what passes by",
       as_image(root(decision.motion.variation), kWhiteGradient)},
      {"drift", "Slow drift", as_image(decision.drift, 1)},
      {"moving", "What moves", as_image(decision.moving, 1)},
      {"walls", "Where a body can end", as_image(cv::max(decision.boundaries.ridge, decision.boundaries.motion), 1)},
      {"labels", "What the cheapest cut calls body", decision.labels}};
}

constexpr double kSmoothing =
    0.7;  // pixels of the means; removes the steps from a border and does not move a straight one

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
  [[nodiscard]] StableDecision decision(KeepStages keep) const;
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

StableDecision StableMethod::decision(KeepStages keep) const {
  StableOwnBodySettings settings = settings_;
  settings.vibration_px /= averager_.scale();
  if (averager_.waiting() == 0) return stable_decision(gradients_.moments(), segments_.segments(), settings, keep);
  GradientSums gradients = gradients_.clone();
  FootageSegments segments = segments_;
  gradients.add(averager_.image());
  segments.add(averager_.image());
  return stable_decision(gradients.moments(), segments.segments(), settings, keep);
}

Verdict StableMethod::undecided(std::string reason) const {
  return {.own_body = cv::Mat::zeros(size_px_, CV_8UC1),
          .confidence = cv::Mat(size_px_, CV_32FC1, cv::Scalar(0.5)),
          .undecided = std::move(reason)};
}

// A pixel of the means is a square of the footage's pixels. Rows and columns left over at the bottom and at the right
// are copies of their neighbours.
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
  if (averager_.frames() < 2) return undecided("fewer than 2 frames");
  const StableDecision decided = decision(keep);
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
