// SPDX-License-Identifier: MIT
#include "realism/trackers.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <map>
#include <mutex>

#include "appearance/similar_place.h"
#include "base/threads.h"
#include "comparison/inserted_target.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/overlap.h"
#include "scene/opened_project.h"

namespace sigs::bench {

namespace {

constexpr int kReach = 30;  // frames before and after the middle one
const std::vector<std::string> kTrackers{"csrt", "kcf", "mosse", "medianflow"};
constexpr int kBootstraps = 2000;

// Success of one tracker on one target.
struct Followed {
  std::string clip, kind, tracker;
  bool is_tuning = false;
  double success = 0;  // mean overlap over the frames, which is the area under the success curve
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

// Where the path of the target's middle goes to, against the middle frame.
std::vector<cv::Point2d> path_of(const Stretch& stretch) {
  const auto middle_of = [](const Box& box) { return cv::Point2d(box.x + box.width / 2, box.y + box.height / 2); };
  std::vector<cv::Point2d> path;
  for (const Box& box : stretch.boxes) path.push_back(middle_of(box) - middle_of(stretch.middle_box()));
  return path;
}

// A place from which the whole path lies in the image. The rectangle that is looked for spans the path.
std::optional<cv::Point2d> place_for(const Stretch& stretch, const MeasuredTarget& real, std::uint32_t seed) {
  cv::Point2d low, high;
  for (const cv::Point2d& at : real.path_px) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const cv::Rect& box = real.look.box;
  const cv::Size size(static_cast<int>(high.x - low.x) + box.width + 8,
                      static_cast<int>(high.y - low.y) + std::max(box.height, box.width / 2) + 8);
  const auto middle = similar_place(stretch.middle_frame(), stretch.middle_box(), size, seed);
  return middle ? std::optional(*middle - 0.5 * (low + high)) : std::nullopt;
}

// Boxes of the real ones' size about their own middles: a tracker learns what a box holds, and how much of it is
// background must be alike.
std::vector<Box> as_loose_as(const std::vector<Box>& real, std::vector<Box> boxes) {
  for (std::size_t i = 0; i < std::min(boxes.size(), real.size()); ++i) {
    Box& box = boxes[i];
    box = {box.x + (box.width - real[i].width) / 2, box.y + (box.height - real[i].height) / 2, real[i].width,
           real[i].height};
  }
  return boxes;
}

constexpr double kSameContrast = 0.2;  // share by which contrasts may differ
const std::string kAtSameContrast = ", same contrast";

// The project with its light so strong that the target's contrast to its background (Weber, root of the mean square) is
// the real one's, within kSameContrast. None where no strength does that.
std::optional<Project> with_same_contrast(const Project& project, double wanted, Insertion& insertion) {
  std::optional<Project> nearest;
  double least = std::log(1 + kSameContrast);
  for (int step = -12; step <= 12; ++step) {
    Project lit = project;
    const double factor = std::pow(1.25, step);
    if (lit.light.kind == LightKind::sun)
      lit.light.exposure *= factor;
    else
      lit.light.color *= factor;
    const auto target = expected(insertion.middle_target(lit, CameraShake::as_real_target));
    if (!target || !target->look.weber_rms || !(*target->look.weber_rms > 0)) continue;
    const double off = std::abs(std::log(*target->look.weber_rms / wanted));
    if (off >= least) continue;
    least = off;
    nearest = lit;
  }
  return nearest;
}

std::vector<Followed> followed(const RealClip& clip, const SampleOptions& options, Workplace& workplace) {
  FrameSource footage = opened(clip.path);
  const FootageShape shape = shape_of(footage.info());
  const int middle = static_cast<int>(clip.boxes.size()) / 2;
  const auto stretch = expected(stretch_around(footage, clip.boxes, middle, kReach));
  if (!stretch || stretch->reach() != kReach) return {};
  auto real = measured_target({&stretch->middle_frame(), 1}, {&stretch->middle_box(), 1});
  if (!real || real->look.is_cut) return {};
  real->path_px = path_of(*stretch);
  const std::uint32_t seed = seed_of(clip.name, middle);
  const auto place = place_for(*stretch, *real, seed);
  if (!place) return {};
  std::vector<Followed> all;
  const auto add = [&](const std::string& kind, const std::map<std::string, double>& by_tracker) {
    for (const auto& [tracker, success] : by_tracker)
      all.push_back({clip.name, kind, tracker, clip.is_tuning, success});
  };
  add("real", successes(stretch->frames, stretch->boxes));
  const Project project = project_of(clip, shape.size_px, options.folder);
  Insertion insertion =
      expected(Insertion::make(project, *stretch, shape, *real, *place, seed, workplace.files, workplace.context));
  for (const LookSettings& settings : options.settings) {
    Project set = project;
    apply(settings, clip.name, set);
    const Insertion::Composed composed = expected(insertion.composed(set, CameraShake::as_real_target));
    if (!composed.frames.empty())
      add(settings.name, successes(composed.frames, as_loose_as(stretch->boxes, composed.boxes)));
    if (!real->look.weber_rms) continue;
    const auto same = with_same_contrast(set, *real->look.weber_rms, insertion);
    if (!same) continue;
    const Insertion::Composed again = expected(insertion.composed(*same, CameraShake::as_real_target));
    if (!again.frames.empty())
      add(settings.name + kAtSameContrast, successes(again.frames, as_loose_as(stretch->boxes, again.boxes)));
  }
  return all;
}

struct Difference {
  double real = 0, inserted = 0, difference = 0, low = 0, high = 0;
  int clips = 0;
};

// Of inserted and real targets of the same clips.
Difference difference_of(const std::vector<Followed>& all, const std::string& tracker, const std::string& kind) {
  std::map<std::string, std::pair<double, double>> by_clip;  // real, inserted
  for (const Followed& one : all) {
    if (one.tracker != tracker || (one.kind != kind && one.kind != "real")) continue;
    auto& pair = by_clip.emplace(one.clip, std::pair(-1.0, -1.0)).first->second;
    (one.kind == "real" ? pair.first : pair.second) = one.success;
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
  for (int n = 0; n < kBootstraps; ++n) {
    double sum = 0;
    for (int i = 0; i < difference.clips; ++i)
      sum += differences[static_cast<std::size_t>(random.uniform(0, difference.clips))];
    means.push_back(sum / difference.clips);
  }
  std::sort(means.begin(), means.end());
  difference.low = means[kBootstraps / 40];
  difference.high = means[kBootstraps - 1 - kBootstraps / 40];
  return difference;
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
  accuracy::Csv table(folder / "trackers.csv", "clip,tuning,kind,tracker,success");
  for (const Followed& one : all) table.row(one.clip, one.is_tuning, one.kind, one.tracker, one.success);
  std::ofstream out(folder / "trackers.md");
  out << "| tracker | inserted | clips | success, real | success, inserted | difference | 95 % |\n"
         "|---|---|---|---|---|---|---|\n";
  for (const LookSettings& settings : options.settings)
    for (const std::string& kind : {settings.name, settings.name + kAtSameContrast})
      for (const std::string& tracker : kTrackers) {
        const Difference d = difference_of(all, tracker, kind);
        out << fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | **{:+.3f}** | {:+.2f} to {:+.2f} |\n", tracker, kind,
                           d.clips, d.real, d.inserted, d.difference, d.low, d.high);
      }
}

}  // namespace sigs::bench
