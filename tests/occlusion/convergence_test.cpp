// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <doctest/doctest.h>

#include <vector>

namespace sigs::test {
namespace {

constexpr double kLong_s = 5;  // between checks

// The left columns are body, of the rest the upper rows are known to be world; below it is plain.
Verdict verdict_with(int body_columns, int known_rows = 100) {
  Verdict verdict{.own_body = cv::Mat::zeros(100, 100, CV_8UC1),
                  .confidence = cv::Mat(100, 100, CV_32FC1, cv::Scalar(0.25))};
  verdict.confidence.rowRange(0, known_rows).setTo(0);
  verdict.own_body.colRange(0, body_columns).setTo(255);
  verdict.confidence.colRange(0, body_columns).setTo(1);
  return verdict;
}

Verdict undecided() {
  Verdict verdict = verdict_with(0);
  verdict.undecided = "nothing moves";
  return verdict;
}

bool settles(const std::vector<Verdict>& checks, double limit, double between_s = kLong_s) {
  ConvergenceCheck convergence(limit);
  for (int i = 0; i < static_cast<int>(checks.size()); ++i)
    convergence.check(checks[static_cast<std::size_t>(i)], 100 + 50 * i, 4 + between_s * i);
  return convergence.is_converged();
}

}  // namespace

TEST_CASE("a mask has converged once three checks in a row changed it by less than the limit") {
  const Verdict same = verdict_with(50);
  CHECK_FALSE(settles({same, same, same}, 0.01));  // the first one has none before it
  CHECK(settles({same, same, same, same}, 0.01));
  // 1 - 50 / 51 = 0.0196
  CHECK_FALSE(settles({same, verdict_with(51), same, verdict_with(51)}, 0.0196));
  CHECK(settles({same, verdict_with(51), same, verdict_with(51)}, 0.0197));
}

TEST_CASE("a change restarts the count of unchanged checks") {
  const Verdict before = verdict_with(50);
  const Verdict after = verdict_with(60);
  CHECK_FALSE(settles({before, before, before, after, after, after}, 0.01));
  CHECK(settles({before, before, before, after, after, after, after}, 0.01));
}

TEST_CASE("the mask of an image without an own body converges too") {
  const Verdict none = verdict_with(0);
  CHECK(settles({none, none, none, none}, 0.01));
}

TEST_CASE("a mask does not converge within ten seconds, while undecided, or with too little known motion") {
  const Verdict same = verdict_with(50);
  CHECK_FALSE(settles({same, same, same, same, same}, 0.01, 2.49));
  CHECK(settles({same, same, same, same, same}, 0.01, 2.5));
  CHECK_FALSE(settles({verdict_with(60), same, same, same, same}, 0.01, 2.5));
  CHECK_FALSE(settles({same, same, undecided(), same, same, same}, 0.01));
  CHECK(settles({same, same, undecided(), same, same, same, same}, 0.01));
  const Verdict plain = verdict_with(50, 49);
  CHECK_FALSE(settles({plain, plain, plain, plain, plain}, 0.01));
  const Verdict half = verdict_with(50, 50);
  CHECK(settles({half, half, half, half}, 0.01));
}

TEST_CASE("a mask does not converge while a patch of the image is undecided; a mask's border is no such patch") {
  const auto with_doubt = [](const cv::Rect& where, double confidence) {
    Verdict verdict = verdict_with(50);
    verdict.confidence(where).setTo(confidence);
    return std::vector<Verdict>(4, verdict);
  };
  // 2 % of the diagonal are 2.8 pixels.
  for (const cv::Point corner : {cv::Point(10, 20), cv::Point(70, 20), cv::Point(0, 0), cv::Point(97, 97)}) {
    CAPTURE(corner);
    CHECK_FALSE(settles(with_doubt({corner, cv::Size(3, 3)}, 0.5), 0.01));
    CHECK_FALSE(settles(with_doubt({corner, cv::Size(3, 3)}, 0.31), 0.01));
    CHECK_FALSE(settles(with_doubt({corner, cv::Size(3, 3)}, 0.69), 0.01));
    CHECK(settles(with_doubt({corner, cv::Size(3, 3)}, 0.29), 0.01));
    CHECK(settles(with_doubt({corner, cv::Size(3, 3)}, 0.71), 0.01));
  }
  CHECK(settles(with_doubt({49, 0, 2, 100}, 0.5), 0.01));
}

TEST_CASE("checks are few, each at half as many frames again, and there are none without a limit") {
  ConvergenceCheck convergence(0.01);
  const ConvergenceCheck never(0);
  std::vector<int> checks;
  for (int frames = 2; frames <= 1500; ++frames) {
    CHECK_FALSE(never.is_check_due(frames));
    if (!convergence.is_check_due(frames)) continue;
    convergence.check(undecided(), frames, frames / 25.0);
    checks.push_back(frames);
  }
  CHECK(checks == std::vector<int>{100, 150, 225, 337, 505, 757, 1135});
}

TEST_CASE("the last change is one minus the intersection over union of the last two masks") {
  ConvergenceCheck convergence(0.5);
  convergence.check(verdict_with(40), 100, 4);
  convergence.check(verdict_with(50), 150, 6);
  CHECK(convergence.last_change() == doctest::Approx(0.2));
}

}  // namespace sigs::test
