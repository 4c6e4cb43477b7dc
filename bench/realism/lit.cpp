// SPDX-License-Identifier: MIT
#include "realism/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "accuracy/csv.h"
#include "appearance/target_look.h"
#include "base/statistics.h"
#include "base/threads.h"
#include "comparison/inserted_target.h"
#include "comparison/lit_like.h"
#include "scene/opened_project.h"

namespace sigs::bench {

namespace {

constexpr std::uint32_t kViewSeeds[] = {201, 307, 411, 523};

// Mean contrast (Weber) off the real target's, without its sign, of one target; over the views.
struct LitTarget {
  bool is_tuning = false;
  double before = 0, after = 0;
};

struct Place {
  const Stretch& stretch;
  const FootageShape& shape;
  const MeasuredTarget& real;
  cv::Point2d middle_px;
};

// None where the intruder is in no view told from the background.
std::optional<double> contrast_of(const Project& project, const Place& place, Workplace& workplace) {
  double sum = 0;
  int count = 0;
  for (const std::uint32_t seed : kViewSeeds) {
    Insertion view = expected(Insertion::make(project, place.stretch, place.shape, place.real, place.middle_px,
                                              {.seed = seed, .tries = 2}, workplace.files, workplace.context));
    const auto target = expected(view.middle_target(project, CameraShake::none));
    if (!target || !target->look.weber_mean) continue;
    sum += *target->look.weber_mean;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::vector<LitTarget> lit_targets_of(const RealClip& clip, const SampleOptions& options, Workplace& workplace) {
  FrameSource footage = opened(clip.path);
  const FootageShape shape = shape_of(footage.info());
  Project project = project_of(clip, shape.size_px, options.folder);
  apply(options.settings.back(), clip.name, project);
  std::vector<LitTarget> all;
  const int count = static_cast<int>(clip.boxes.size());
  for (int i = 0; i < options.frames_per_clip; ++i) {
    const int middle = (2 * i + 1) * count / (2 * options.frames_per_clip);
    const auto stretch = expected(stretch_around(footage, clip.boxes, middle, 0));
    if (!stretch) continue;
    const auto real = measured_target(stretch->frames, stretch->boxes);
    if (!real || real->look.is_cut || !real->look.weber_mean) continue;
    const cv::Size wanted(real->look.box.width + 8, std::max(real->look.box.height, real->look.box.width / 2) + 8);
    const auto place =
        similar_place(stretch->middle_frame(), stretch->middle_box(), wanted, seed_of(clip.name, middle));
    if (!place) continue;
    const auto lit = lit_like(project, shape, stretch->middle_frame(), middle, stretch->middle_box());
    if (!lit) continue;
    Project lit_project = project;
    apply(*lit, lit_project);
    const Place where{*stretch, shape, *real, *place};
    const auto before = contrast_of(project, where, workplace), after = contrast_of(lit_project, where, workplace);
    if (!before || !after) continue;
    all.push_back(
        {clip.is_tuning, std::abs(*before - *real->look.weber_mean), std::abs(*after - *real->look.weber_mean)});
  }
  return all;
}

void print_row(const char* name, const std::vector<LitTarget>& all, bool is_tuning) {
  std::vector<double> before, after;
  int better = 0;
  for (const LitTarget& one : all) {
    if (one.is_tuning != is_tuning) continue;
    before.push_back(one.before);
    after.push_back(one.after);
    better += one.after < one.before ? 1 : 0;
  }
  fmt::print("| {} | {} | {:.3f} | {:.3f} | {} |\n", name, before.size(), median(before), median(after), better);
}

}  // namespace

void compare_lit(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs) {
  std::vector<LitTarget> all;
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  parallel_for(jobs, jobs, [&](int) {
    Workplace workplace;
    for (std::size_t i = next++; i < clips.size(); i = next++) {
      const std::vector<LitTarget> some = lit_targets_of(clips[i], options, workplace);
      const std::lock_guard lock(mutex);
      all.insert(all.end(), some.begin(), some.end());
    }
  });
  fmt::print("| clips | real targets | mean contrast off: before | lit like it | nearer in |\n|---|---|---|---|---|\n");
  print_row("held out", all, false);
  print_row("tuning", all, true);
}

}  // namespace sigs::bench
