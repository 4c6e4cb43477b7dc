// SPDX-License-Identifier: MIT
// The scores by an independent calculation: overlaps by counting cells, curves by sorting.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "evaluation/clips.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/metrics/track_score.h"

namespace sigs::test {
namespace {

// Boxes of whole pixels, so that cells can be counted.
Box random_box(std::mt19937& random) {
  const auto number = [&](int minimum, int maximum) { return std::uniform_int_distribution(minimum, maximum)(random); };
  return {number(0, 40) - 0.5, number(0, 40) - 0.5, double(number(1, 25)), double(number(1, 25))};
}

double counted_overlap(const Box& a, const Box& b) {
  const auto holds = [](const Box& box, double x, double y) {
    return x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
  };
  int both = 0;
  int either = 0;
  for (int y = -3; y < 70; ++y)
    for (int x = -3; x < 70; ++x) {
      both += holds(a, x, y) && holds(b, x, y);
      either += holds(a, x, y) || holds(b, x, y);
    }
  return double(both) / either;
}

// Share of sorted values that are at most a threshold; of `all`, which may be more than there are values.
double share_up_to(const std::vector<double>& sorted, double threshold, double all) {
  return double(std::upper_bound(sorted.begin(), sorted.end(), threshold + 1e-10) - sorted.begin()) / all;
}

struct Pair {
  Box truth;
  Box reported;
};

std::vector<Pair> random_pairs(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const Box truth = random_box(random);
    // Every third one is close, so that curves have something on their left.
    const double near_by = std::uniform_int_distribution(-2, 2)(random);
    pairs.push_back({truth, i % 3 == 0 ? moved(truth, near_by, -near_by) : random_box(random)});
  }
  return pairs;
}

}  // namespace

TEST_CASE("the overlap of two boxes is that of the pixels they cover") {
  for (const Pair& pair : random_pairs(400, 3)) {
    CHECK(std::abs(overlap(pair.truth, pair.reported) - counted_overlap(pair.truth, pair.reported)) < 1e-12);
    CHECK(overlap(pair.truth, pair.reported) == overlap(pair.reported, pair.truth));
  }
  CHECK(overlap({0, 0, 0, 5}, {0, 0, 0, 5}) == 0);
  CHECK(overlap({0, 0, 5, 5}, {5, 0, 5, 5}) == 0);
  CHECK(overlap({-1e9, -1e9, 2e9, 2e9}, {0, 0, 1, 1}) > 0);
}

TEST_CASE("scores agree with an independent calculation") {
  const std::vector<Pair> pairs = random_pairs(500, 7);
  const auto is_silent = [](std::size_t i) { return i % 17 == 5; };
  const ClipTruth clip = clip_of(static_cast<int>(pairs.size()), 25,
                                 [&](int i) { return visible_at(pairs[static_cast<std::size_t>(i)].truth); });
  Results results;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!is_silent(i)) report(results, static_cast<int>(i), pairs[i].reported);
  const TrackScore score = score_track(clip, clip.targets[0], results, {});

  std::vector<double> errors;
  std::vector<double> normalized;
  std::vector<double> misses;  // 1 - overlap: small is good, as of errors
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [t, r] = pairs[i];
    misses.push_back(1 - (is_silent(i) ? 0 : counted_overlap(t, r)));
    if (is_silent(i)) continue;
    // Twice the middle of a box is the sum of its edges.
    const double dx = ((r.x + r.x + r.width) - (t.x + t.x + t.width)) / 2;
    const double dy = ((r.y + r.y + r.height) - (t.y + t.y + t.height)) / 2;
    errors.push_back(std::sqrt(dx * dx + dy * dy));
    normalized.push_back(std::sqrt(dx * dx / (t.width * t.width) + dy * dy / (t.height * t.height)));
  }
  for (std::vector<double>* values : {&errors, &normalized, &misses}) std::ranges::sort(*values);
  const double all = double(pairs.size());

  double mean = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) mean += (errors[i] - mean) / double(i + 1);
  CHECK(std::abs(score.mean_center_error_px - mean) < 1e-9);
  const std::size_t half = errors.size() / 2;
  const double median = errors.size() % 2 == 1 ? errors[half] : (errors[half - 1] + errors[half]) / 2;
  CHECK(std::abs(score.median_center_error_px - median) < 1e-9);
  for (int t = 0; t < kPrecisionSteps; ++t)
    CHECK(std::abs(score.precision[static_cast<std::size_t>(t)] - share_up_to(errors, t, all)) < 1e-9);
  for (int k = 0; k < kNormalizedSteps; ++k)
    CHECK(std::abs(score.normalized_precision[static_cast<std::size_t>(k)] - share_up_to(normalized, k * 0.01, all)) <
          1e-9);
  for (int k = 0; k < kSuccessSteps - 1; ++k)  // overlap > k/20 is 1 - overlap < 1 - k/20
    CHECK(std::abs(score.success[static_cast<std::size_t>(k)] - share_up_to(misses, 1 - k / 20.0 - 1e-9, all)) < 1e-9);
  CHECK(std::abs(score.success[20] - share_up_to(misses, 0, all)) < 1e-9);
  CHECK(score.success[20] > 0);  // some were shifted by zero
  CHECK(score.lost == std::ranges::count_if(misses, [](double miss) { return miss == 1; }));
}

}  // namespace sigs::test
