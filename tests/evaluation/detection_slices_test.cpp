// SPDX-License-Identifier: MIT
#include "evaluation/metrics/slices.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "evaluation/clips.h"
#include "evaluation/reports/report.h"

namespace sigs::test {

namespace {

const Box kSmallBox{99.5, 99.5, 12, 6};

// Frames 0 to 39: 50 m farther each frame from 25 m on, above the horizon, in the second half of poor contrast.
ClipTruth receding() {
  return clip_of(40, 10, [](int i) {
    TargetFrame frame = visible_at(kSmallBox, 25 + 50 * i);
    frame.horizon = HorizonSide::above;
    frame.rms_contrast = i < 20 ? 0.15 : 0.04;
    return frame;
  });
}

Results seen_until(int last) {
  Results results{.name = "eye"};
  for (int i = 0; i <= last; ++i) report(results, i, kSmallBox);
  return results;
}

}  // namespace

TEST_CASE("slices count the frames and matches of their range, size, contrast and side") {
  const std::vector<FrameSlice> slices = frame_slices({{"one", receding(), seen_until(9)}}, {});
  std::map<std::string, const FrameSlice*> by_name;
  for (const FrameSlice& slice : slices) by_name[slice.by + "/" + slice.name] = &slice;
  const auto check = [&](const std::string& name, int frames, int matched) {
    CAPTURE(name);
    REQUIRE(by_name.contains(name));
    CHECK(by_name[name]->frames == frames);
    CHECK(by_name[name]->matched == matched);
  };
  // 25, 75 | 125 ... 275 | 325 ... 675 | 725 ... 1475 | 1525 ...
  check("range/below 100 m", 2, 2);
  check("range/100 to 300 m", 4, 4);
  check("range/300 to 700 m", 8, 4);
  check("range/700 to 1500 m", 16, 0);
  check("range/from 1500 m", 10, 0);
  check("size/8 to 16 px", 40, 10);
  check("size/below 8 px", 0, 0);
  check("contrast/0.1 to 0.2", 20, 10);
  check("contrast/below 0.05", 20, 0);
  check("horizon/above", 40, 10);
  check("horizon/below", 0, 0);
  check("visible/from 0.95", 40, 10);
}

TEST_CASE("the interval of a share is that of the binomial distribution where groups are single trials") {
  std::vector<GroupShare> groups(400);
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = {i % 4 == 0 ? 1.0 : 0.0, 1};
  const Interval interval = share_interval(groups);
  const double sd = std::sqrt(0.25 * 0.75 / 400);
  CHECK(interval.low == doctest::Approx(0.25 - 1.96 * sd).epsilon(0.02));
  CHECK(interval.high == doctest::Approx(0.25 + 1.96 * sd).epsilon(0.02));
  // Ten times the same trials in each group tell no more.
  for (GroupShare& group : groups) group = {10 * group.part, 10};
  CHECK(share_interval(groups).low == interval.low);
  // Draws of trials that all succeed are all 1: the interval is Wilson's, n / (n + z^2) to 1.
  CHECK(share_interval(std::vector<GroupShare>(30, {1, 1})).low ==
        doctest::Approx(30 / (30 + 1.96 * 1.96)).epsilon(1e-4));
  CHECK(share_interval(std::vector<GroupShare>(30, {1, 1})).high == 1);
  CHECK(share_interval({{0, 5}, {0, 9}}).low == 0);
  CHECK(share_interval({{0, 5}, {0, 9}}).high == doctest::Approx(1.96 * 1.96 / (2 + 1.96 * 1.96)).epsilon(1e-4));
  // One group does not tell how groups differ, nor do others without any trial.
  CHECK(std::isnan(share_interval({{3, 6}}).low));
  CHECK(std::isnan(share_interval({{3, 6}, {0, 0}, {0, 0}}).high));
  CHECK(std::isnan(difference_interval({{3, 6}}, {{1, 6}}).low));
}

TEST_CASE("two detectors on the same encounters differ by more than chance or do not") {
  std::vector<GroupShare> good(40, {1, 1});
  std::vector<GroupShare> bad(40, {1, 1});
  CHECK(difference_interval(good, bad).low == 0);
  CHECK(difference_interval(good, bad).high == 0);
  bad[3].part = 0;
  CHECK(difference_interval(good, bad).low == 0);  // one encounter of 40
  for (std::size_t i = 0; i < 20; ++i) bad[i].part = 0;
  CHECK(difference_interval(good, bad).low > 0.3);
  CHECK(difference_interval(good, bad).high < 0.7);
  CHECK(std::isnan(share_interval({}).low));
  CHECK(std::isnan(share_interval({{0, 0}}).low));
}

TEST_CASE("a report says which detectors can be distinguished") {
  const auto encounter = [](bool is_detected) { return EncounterScore{.clip = "c", .is_detected = is_detected}; };
  DetectionReport report;
  for (const char* name : {"one", "two", "three"}) report.scores.push_back({.name = name});
  for (int i = 0; i < 30; ++i) {
    report.scores[0].encounters.push_back(encounter(true));
    report.scores[1].encounters.push_back(encounter(i != 4));
    report.scores[2].encounters.push_back(encounter(i < 10));
  }
  const std::string text = intervals_text(report);
  CHECK(text.find("one: 0.886 to 1.000") != std::string::npos);
  CHECK(text.find("two less one: ") != std::string::npos);
  CHECK(text.find("0.000, they cannot be distinguished") != std::string::npos);
  CHECK(text.find("they can be distinguished", text.find("three less one")) != std::string::npos);
  CHECK(intervals_text(DetectionReport{}).empty());
  CHECK(slices_text(report).empty());
}

}  // namespace sigs::test
