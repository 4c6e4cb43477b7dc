// SPDX-License-Identifier: MIT
#include "evaluation/metrics/aot_rules.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "evaluation/metrics/detection_score.h"

namespace sigs {

namespace {

constexpr double kGrown_px2 = 100;
constexpr double kLarge_px2 = 200;
constexpr double kMatch = 0.2;
constexpr double kNoMatch = 0.02;
constexpr double kRange_m = 700;
constexpr double kNear_m = 330;
constexpr double kInTime_m = 300;
constexpr int kMaxStep = 3;  // from a row's frame to the next one's
constexpr std::size_t kRows = 30;
constexpr double kFlight_h = 2.0 / 60;
constexpr double kScorePrecision = 1e-5;  // both as the published program's default
constexpr double kRatePrecision = 1e-5;

bool is_small(const AotBox& box) {
  return box.width_px * box.height_px < kGrown_px2;
}

// About its middle, at its own aspect.
AotBox grown(AotBox box) {
  if (!is_small(box)) return box;
  const double factor = std::sqrt(kGrown_px2 / (box.width_px * box.height_px));
  box.width_px *= factor;
  box.height_px *= factor;
  return box;
}

double area(const AotBox& box) {
  return box.width_px * box.height_px;
}

double overlap(const AotBox& a, const AotBox& b) {
  const auto edges = [](const AotBox& box) {
    return Box{box.x_px - box.width_px / 2, box.y_px - box.height_px / 2, box.width_px, box.height_px};
  };
  return overlap(edges(a), edges(b));
}

AotPair pair_of(const AotTruth& truth, int object, const std::vector<AotReport>& reports, int report) {
  const AotObject& o = truth.objects[static_cast<std::size_t>(object)];
  AotPair pair{.object = object, .report = report};
  if (!o.id.empty()) pair.object_area_px2 = area(grown(o.box));
  if (report < 0) return pair;
  const AotBox& found = reports[static_cast<std::size_t>(report)].box;
  const AotBox counted = !o.id.empty() && is_small(o.box) ? grown(found) : found;
  pair.report_area_px2 = area(counted);
  if (!o.id.empty()) {
    pair.overlap = overlap(o.box, found);
    pair.extended_overlap = overlap(grown(o.box), counted);
  }
  pair.is_match = pair.extended_overlap >= kMatch;
  pair.is_no_match = pair.extended_overlap < kNoMatch;
  return pair;
}

bool is_planned(const AotObject& object) {
  return !object.id.empty() && object.range_m.has_value();
}

bool is_in_range(const AotObject& object) {
  return is_planned(object) && *object.range_m <= kRange_m;
}

bool is_aircraft(const AotObject& object) {
  return object.id.starts_with("Airplane") || object.id.starts_with("Helicopter");
}

// The encounters that count, by flight and object.
std::vector<AotEncounter> aot_encounters(const AotTruth& truth) {
  std::map<std::pair<int, std::string>, std::vector<int>> rows;
  for (std::size_t i = 0; i < truth.objects.size(); ++i)
    if (is_in_range(truth.objects[i]))
      rows[{truth.objects[i].flight, truth.objects[i].id}].push_back(static_cast<int>(i));
  const auto at = [&](int i) -> const AotObject& { return truth.objects[static_cast<std::size_t>(i)]; };
  std::vector<AotEncounter> all;
  for (const auto& [key, objects] : rows)
    for (std::size_t k = 0; k < objects.size(); ++k) {
      if (k == 0 || at(objects[k]).frame - at(objects[k - 1]).frame > kMaxStep)
        all.push_back({.number = static_cast<int>(all.size()), .flight = key.first});
      all.back().objects.push_back(objects[k]);
    }
  std::erase_if(all, [&](const AotEncounter& encounter) {
    double nearest_m = kRange_m;
    for (const int i : encounter.objects) nearest_m = std::min(nearest_m, *at(i).range_m);
    return encounter.objects.size() < kRows || nearest_m > kNear_m;
  });
  for (AotEncounter& encounter : all) {
    double sum = 0;
    for (const int i : encounter.objects) sum += at(i).above_horizon;
    encounter.above_horizon = sum / static_cast<double>(encounter.objects.size());
  }
  return all;
}

// Rates and matches of the reports that count.
class Scorer {
 public:
  Scorer(const AotTruth& truth, const std::vector<AotReport>& reports, AotPolicy policy)
      : truth_(truth), reports_(reports), policy_(std::move(policy)), pairs_(aot_pairs(truth, reports)) {
    std::set<std::string> images;
    std::unordered_map<std::string, int> flight_of_image;
    for (const AotObject& o : truth.objects) {
      images.insert(o.image);
      flight_of_image.emplace(o.image, o.flight);
    }
    images_ = static_cast<double>(images.size());
    hours_ = static_cast<double>(truth.flights.size()) * kFlight_h;
    flights_.assign(reports.size(), -1);
    for (std::size_t i = 0; i < reports.size(); ++i)
      if (const auto at = flight_of_image.find(reports[i].image); at != flight_of_image.end()) flights_[i] = at->second;
    is_false_.assign(reports.size(), 1);
    for (const AotPair& pair : pairs_)
      if (pair.report >= 0 && !pair.is_no_match) is_false_[static_cast<std::size_t>(pair.report)] = 0;
    count_so_far();
  }

  Result<AotScore> score() {
    if (images_ == 0) return fail("", "the truth has no images");
    AotScore score{.policy = policy_};
    double least = 1;
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      if (flights_[i] < 0) ++score.unknown_images;
      if (counts(i, policy_.min_score)) least = std::min(least, reports_[i].score);
    }
    score.working_score = std::max(policy_.min_score, least);
    if (policy_.target_fppi || policy_.target_hfar) {
      const auto met = target_score(score.working_score);
      if (!met) return fail(met.error());
      score.working_score = *met;
    }
    score.fppi = fppi(score.working_score);
    score.hfar = hfar(score.working_score);
    count_rows(score);
    score.encounters = aot_encounters(truth_);
    for (const AotEncounter& encounter : score.encounters) {
      score.by_detection.push_back(encounter_score(encounter, false));
      score.by_track.push_back(encounter_score(encounter, true));
    }
    return score;
  }

 private:
  // Reports count from the frame on at which their track is min_track_length frames long, gaps included.
  void count_so_far() {
    std::unordered_map<std::string, int> frame_of_image;
    for (const AotObject& o : truth_.objects) frame_of_image.emplace(o.image, o.frame);
    std::map<std::pair<int, int>, std::map<int, std::vector<std::size_t>>> tracks;  // reports by frame
    for (std::size_t i = 0; i < reports_.size(); ++i)
      if (flights_[i] >= 0 && reports_[i].score >= policy_.min_score)
        tracks[{flights_[i], reports_[i].track}][frame_of_image.at(reports_[i].image)].push_back(i);
    is_long_.assign(reports_.size(), 0);
    for (const auto& [track, by_frame] : tracks)
      for (const auto& [frame, rows] : by_frame)
        for (const std::size_t row : rows)
          is_long_[row] = frame - by_frame.begin()->first + 1 >= policy_.min_track_length ? 1 : 0;
  }

  [[nodiscard]] bool counts(std::size_t report, double score) const {
    return flights_[report] >= 0 && is_long_[report] != 0 && reports_[report].score >= score;
  }

  [[nodiscard]] double fppi(double score) const {
    int found = 0;
    for (std::size_t i = 0; i < reports_.size(); ++i) found += counts(i, score) && is_false_[i] != 0 ? 1 : 0;
    return found / images_;
  }

  [[nodiscard]] double hfar(double score) const {
    std::set<std::pair<int, int>> tracks;
    for (std::size_t i = 0; i < reports_.size(); ++i)
      if (counts(i, score) && is_false_[i] != 0) tracks.emplace(flights_[i], reports_[i].track);
    return static_cast<double>(tracks.size()) / hours_;
  }

  // Halves the interval from the lowest score to 1 until the rate, rounded to 5 decimals, is the target, or the
  // interval is no longer than 1e-5: its upper end then, the lowest score found with a lower rate.
  [[nodiscard]] Result<double> target_score(double lowest) const {
    const double target = policy_.target_fppi ? *policy_.target_fppi : *policy_.target_hfar;
    const auto rate = [&](double score) {
      const double exact = policy_.target_fppi ? fppi(score) : hfar(score);
      return std::round(exact / kRatePrecision) * kRatePrecision;
    };
    double low = lowest;
    double high = 1;
    if (rate(low) <= target) return low;
    if (rate(high) > target) return fail("", "no score up to 1 brings the rate of false alarms down to the target");
    while (high - low > kScorePrecision) {
      const double middle = low + (high - low) / 2;
      const double found = rate(middle);
      if (std::abs(found - target) < kRatePrecision / 2) return middle;
      (found > target ? low : high) = middle;
    }
    return high;
  }

  void count_rows(AotScore& score) {
    matched_by_.assign(truth_.objects.size(), {});
    for (const AotPair& pair : pairs_)
      if (pair.report >= 0 && pair.is_match && counts(static_cast<std::size_t>(pair.report), score.working_score))
        matched_by_[static_cast<std::size_t>(pair.object)].insert(
            reports_[static_cast<std::size_t>(pair.report)].track);
    for (std::size_t i = 0; i < truth_.objects.size(); ++i) {
      const AotObject& o = truth_.objects[i];
      const int matched = matched_by_[i].empty() ? 0 : 1;
      (is_planned(o) ? score.planned_rows : score.unplanned_rows) += 1;
      if (!is_planned(o) && !is_aircraft(o)) continue;
      if (!is_planned(o)) ++score.unplanned_aircraft;
      const bool is_large = area(grown(o.box)) > kLarge_px2;
      (is_large ? score.large_rows : score.small_rows) += 1;
      (is_large ? score.matched_large : score.matched_small) += matched;
      if (!is_in_range(o)) continue;
      ++score.rows_in_range;
      score.matched_in_range += matched;
      score.largest_range_m = std::max(score.largest_range_m, *o.range_m);
    }
  }

  [[nodiscard]] AotEncounterScore encounter_score(const AotEncounter& encounter, bool by_track) const {
    AotEncounterScore score;
    std::map<int, int> in_window;  // rows by track; of single detections all have track 0
    const auto add = [&](std::size_t row, int step) {
      const std::set<int>& tracks = matched_by_[static_cast<std::size_t>(encounter.objects[row])];
      if (tracks.empty()) return;
      if (!by_track) in_window[0] += step;
      if (by_track)
        for (const int track : tracks) in_window[track] += step;
    };
    const auto& first = truth_.objects[static_cast<std::size_t>(encounter.objects.front())];
    for (std::size_t row = 0; row < encounter.objects.size(); ++row) {
      const auto object = static_cast<std::size_t>(encounter.objects[row]);
      score.matched_rows += matched_by_[object].empty() ? 0 : 1;
      add(row, 1);
      if (row >= kRows) add(row - kRows, -1);
      if (row + 1 < kRows) continue;
      int most = 0;
      for (const auto& [track, rows] : in_window) most = std::max(most, rows);
      score.largest_share = std::max(score.largest_share, most / static_cast<double>(kRows));
      if (score.is_detected || 2 * most < static_cast<int>(kRows)) continue;
      const AotObject& last = truth_.objects[object];
      const int latency = last.frame - first.frame;
      const bool in_time = *last.range_m >= kInTime_m || latency < static_cast<int>(kRows);
      if (!score.range_m || in_time) {
        score.range_m = last.range_m;
        score.latency_frames = latency;
      }
      score.is_detected = in_time;
    }
    return score;
  }

  const AotTruth& truth_;
  const std::vector<AotReport>& reports_;
  AotPolicy policy_;
  std::vector<AotPair> pairs_;
  double images_ = 0;
  double hours_ = 0;
  std::vector<int> flights_;               // of each report; -1: an image that the truth does not have
  std::vector<char> is_false_;             // of each report
  std::vector<char> is_long_;              // of each report: its track is long enough by then
  std::vector<std::set<int>> matched_by_;  // tracks of each object
};

}  // namespace

std::vector<AotPair> aot_pairs(const AotTruth& truth, const std::vector<AotReport>& reports) {
  std::unordered_map<std::string, std::vector<int>> by_image;
  for (std::size_t i = 0; i < reports.size(); ++i) by_image[reports[i].image].push_back(static_cast<int>(i));
  std::vector<AotPair> pairs;
  for (int object = 0; object < static_cast<int>(truth.objects.size()); ++object) {
    const auto found = by_image.find(truth.objects[static_cast<std::size_t>(object)].image);
    if (found == by_image.end()) pairs.push_back(pair_of(truth, object, reports, -1));
    if (found != by_image.end())
      for (const int report : found->second) pairs.push_back(pair_of(truth, object, reports, report));
  }
  return pairs;
}

Result<AotScore> aot_score(const AotTruth& truth, const std::vector<AotReport>& reports, const AotPolicy& policy) {
  return Scorer(truth, reports, policy).score();
}

}  // namespace sigs
