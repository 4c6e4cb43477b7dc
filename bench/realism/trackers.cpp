// SPDX-License-Identifier: MIT
#include "realism/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>

#include "base/statistics.h"
#include "base/threads.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/opencv_tracker.h"
#include "realism/tracker_targets.h"

namespace sigs::bench {

namespace {

const std::vector<std::string> kTrackers{"csrt", "kcf", "mosse", "medianflow"};
constexpr int kTrackerBootstraps = 2000;

// Success of one tracker on one target.
struct Followed {
  std::string clip, kind, tracker;
  bool is_tuning = false;
  double success = 0;  // mean overlap over the frames, which is the area under the success curve
  TargetFigures figures;
};

// The area under the success curve (share of frames whose overlap exceeds a threshold, over all thresholds from 0 to 1)
// is the mean overlap. A frame without a result counts as 0; the first one, which the tracker is told, does not count.
std::map<std::string, double> successes(const std::vector<Frame>& frames, const std::vector<Box>& boxes) {
  TrackerGroup group = expected(TrackerGroup::make(kTrackers));
  group.start(0, bgr_of(frames[0]), boxes[0]);
  for (std::size_t n = 1; n < frames.size(); ++n) group.follow(static_cast<int>(n), bgr_of(frames[n]));
  std::map<std::string, double> all;  // a tracker that cannot start on the target has no success
  for (const std::string& tracker : kTrackers) all[tracker] = 0;
  for (const Results& results : group.results()) {
    double sum = 0;
    for (std::size_t n = 1; n < frames.size(); ++n) {
      const ReportedBox* const reported = results.best_at(static_cast<int>(n));
      if (reported != nullptr) sum += overlap(reported->box, boxes[n]);
    }
    all[results.name] = sum / static_cast<double>(frames.size() - 1);
  }
  return all;
}

std::string kind_of(const LookSettings& settings, const Equalities& equal) {
  return *equal.name == 0 ? settings.name : settings.name + " + " + equal.name;
}

// What is made equal for one of the settings: all; of the last ones step by step where this is asked for.
std::vector<Equalities> equalities_of(const SampleOptions& options, const LookSettings& settings) {
  const auto first = std::begin(kEqualitySteps), end = std::end(kEqualitySteps);
  const bool in_steps = options.steps && &settings == &options.settings.back();
  return {in_steps ? first : end - 1, end};
}

std::vector<Followed> followed(const RealClip& clip, const SampleOptions& options, Workplace& workplace) {
  auto targets = TrackerTargets::make(clip, options);
  if (!targets) return {};
  std::vector<Followed> all;
  const auto add = [&](const std::string& kind, const std::optional<TrackedTarget>& target) {
    if (!target) return;
    const TargetFigures figures = targets->figures_of(*target);
    for (const auto& [tracker, success] : successes(target->frames, target->boxes))
      all.push_back({clip.name, kind, tracker, clip.is_tuning, success, figures});
  };
  add("real", targets->real());
  add("moved", targets->moved());
  targets->look_for_silhouette(options.settings.back(), workplace);
  for (const LookSettings& settings : options.settings)
    for (const Equalities& equal : equalities_of(options, settings))
      add(kind_of(settings, equal), targets->inserted(settings, equal, workplace));
  std::fprintf(stderr, "%s\n", clip.name.c_str());
  return all;
}

struct Difference {
  double real = 0, inserted = 0, difference = 0, low = 0, high = 0;
  int clips = 0;
};

// Of targets of the same clips; `real` stands for the kind that is compared against.
Difference difference_of(const std::vector<Followed>& all, const std::string& tracker, const std::string& kind,
                         const std::string& against) {
  std::map<std::string, std::pair<double, double>> by_clip;  // real, inserted
  for (const Followed& one : all) {
    if (one.tracker != tracker || (one.kind != kind && one.kind != against)) continue;
    auto& pair = by_clip.emplace(one.clip, std::pair(-1.0, -1.0)).first->second;
    (one.kind == against ? pair.first : pair.second) = one.success;
  }
  std::erase_if(by_clip, [](const auto& entry) { return entry.second.first < 0 || entry.second.second < 0; });
  Difference difference{.clips = static_cast<int>(by_clip.size())};
  if (by_clip.empty()) return difference;
  std::vector<double> differences;
  for (const auto& [clip, pair] : by_clip) {
    difference.real += pair.first / difference.clips;
    difference.inserted += pair.second / difference.clips;
    differences.push_back(pair.second - pair.first);
  }
  difference.difference = difference.inserted - difference.real;
  cv::RNG random(7);
  std::vector<double> means;
  for (int n = 0; n < kTrackerBootstraps; ++n) {
    double sum = 0;
    for (int i = 0; i < difference.clips; ++i)
      sum += differences[static_cast<std::size_t>(random.uniform(0, difference.clips))];
    means.push_back(sum / difference.clips);
  }
  std::sort(means.begin(), means.end());
  difference.low = means[kTrackerBootstraps / 40];
  difference.high = means[kTrackerBootstraps - 1 - kTrackerBootstraps / 40];
  return difference;
}

// How like the real targets those of a kind are, apart from trackers: one line of a table. Ratios to the real one:
// median, and median of the deviation either way, as a factor.
std::string line_of_likeness(const std::vector<Followed>& all, const std::string& kind) {
  std::map<std::string, std::pair<TargetFigures, TargetFigures>> by_clip;  // real, of this kind
  for (const Followed& one : all) {
    if (one.kind == "real") by_clip[one.clip].first = one.figures;
    if (one.kind == kind) by_clip[one.clip].second = one.figures;
  }
  std::erase_if(by_clip, [](const auto& entry) { return !(entry.second.second.area_px > 0); });
  std::string line = fmt::format("| {} | {} |", kind, by_clip.size());
  for (const auto figure : {&TargetFigures::area_px, &TargetFigures::aspect, &TargetFigures::weber_rms}) {
    std::vector<double> logs, sizes;
    for (const auto& [clip, pair] : by_clip) logs.push_back(std::log(pair.second.*figure / pair.first.*figure));
    for (const double value : logs) sizes.push_back(std::abs(value));
    line += fmt::format(" {:.2f} ({:.2f}) |", std::exp(median(logs)), std::exp(median(sizes)));
  }
  std::vector<double> growths;
  int cut = 0;
  for (const auto& [clip, pair] : by_clip) {
    growths.push_back(std::abs(pair.second.growth_per_s));
    cut += pair.second.frames_cut;
  }
  return line + fmt::format(" {:.3f} | {} |\n", median(growths), cut);
}

void write_tables(const std::vector<Followed>& all, const std::vector<std::string>& kinds,
                  const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "| tracker | target | clips | success, real | success | difference to real | 95 % | difference to moved | 95 "
         "% "
         "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& kind : kinds)
    for (const std::string& tracker : kTrackers) {
      const Difference real = difference_of(all, tracker, kind, "real");
      out << fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | **{:+.3f}** | {:+.2f} to {:+.2f} |", tracker, kind,
                         real.clips, real.real, real.inserted, real.difference, real.low, real.high);
      const Difference moved = difference_of(all, tracker, kind, "moved");
      out << (kind == "moved"
                  ? std::string(" | |\n")
                  : fmt::format(" **{:+.3f}** | {:+.2f} to {:+.2f} |\n", moved.difference, moved.low, moved.high));
    }
  out << "\n| target | clips | area | aspect | contrast | growth, 1/s | frames cut |\n|---|---|---|---|---|---|---|\n"
      << line_of_likeness(all, "real");
  for (const std::string& kind : kinds) out << line_of_likeness(all, kind);
}

}  // namespace

void compare_trackers(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs,
                      const std::filesystem::path& folder) {
  std::vector<std::vector<Followed>> by_clip(clips.size());
  std::atomic<std::size_t> next{0};
  parallel_for(jobs, jobs, [&](int) {
    Workplace workplace;
    for (std::size_t i = next++; i < clips.size(); i = next++) by_clip[i] = followed(clips[i], options, workplace);
  });
  std::vector<Followed> all;
  for (const auto& some : by_clip) all.insert(all.end(), some.begin(), some.end());
  accuracy::Csv table(folder / "trackers.csv",
                      "clip,tuning,kind,tracker,success,area_px,aspect,weber_rms,growth_per_s,frames_cut");
  for (const Followed& one : all)
    table.row(one.clip, one.is_tuning, one.kind, one.tracker, one.success, one.figures.area_px, one.figures.aspect,
              one.figures.weber_rms, one.figures.growth_per_s, one.figures.frames_cut);
  std::vector<std::string> kinds{"moved"};
  for (const LookSettings& settings : options.settings)
    for (const Equalities& equal : equalities_of(options, settings)) kinds.push_back(kind_of(settings, equal));
  write_tables(all, kinds, folder / "trackers.md");
}

}  // namespace sigs::bench
