// SPDX-License-Identifier: MIT
#include "realism/tracker_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "appearance/target_look.h"
#include "base/statistics.h"
#include "realism/samples.h"
#include "scene/opened_project.h"

namespace sigs::bench {

namespace {

constexpr int kReach = 30;             // frames before and after the middle one
constexpr double kSameContrast = 0.2;  // share by which contrasts may differ
constexpr std::uint32_t kViews = 6;    // of each model, among which one with the same silhouette is looked for
constexpr double kHighest_rad = 1.0;   // elevation of these views: a turning aircraft shows its wings' whole area

cv::Point2d middle_of_box(const Box& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

Box shifted(const Box& box, const cv::Point2d& by) {
  return {box.x + by.x, box.y + by.y, box.width, box.height};
}

// Where the middle of the target's box goes to, against the middle frame.
std::vector<cv::Point2d> path_of_boxes(const Stretch& stretch) {
  std::vector<cv::Point2d> path;
  for (const Box& box : stretch.boxes) path.push_back(middle_of_box(box) - middle_of_box(stretch.middle_box()));
  return path;
}

// The target in each frame; none where it is not found there.
std::vector<std::optional<TargetLook>> looks_of(const std::vector<Frame>& frames, const std::vector<Box>& boxes) {
  std::vector<std::optional<TargetLook>> looks;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    looks.push_back(target_look(frames[i], boxes[i]));
    if (looks.back() && looks.back()->is_cut) looks.back().reset();
  }
  return looks;
}

// Where the target's silhouette goes to, against the middle frame; between the nearest frames in which it is found.
std::vector<cv::Point2d> path_of_silhouette(const Stretch& stretch, const std::vector<std::optional<TargetLook>>& looks,
                                            const cv::Point2d& middle_px) {
  // Where it is not found, its place in the box is that of the frames around.
  std::vector<std::pair<std::size_t, cv::Point2d>> in_box;
  for (std::size_t i = 0; i < looks.size(); ++i)
    if (looks[i]) in_box.emplace_back(i, looks[i]->centroid_px - middle_of_box(stretch.boxes[i]));
  std::vector<cv::Point2d> path;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const auto after = std::find_if(in_box.begin(), in_box.end(), [&](const auto& one) { return one.first >= i; });
    const auto& high = after == in_box.end() ? in_box.back() : *after;
    const auto& low = after == in_box.begin() || high.first == i ? high : *(after - 1);
    const double share = high.first == low.first ? 0
                                                 : static_cast<double>(i - std::min(i, low.first)) /
                                                       static_cast<double>(high.first - low.first);
    path.push_back(middle_of_box(stretch.boxes[i]) + low.second + std::min(1.0, share) * (high.second - low.second) -
                   middle_px);
  }
  return path;
}

// The median of the slopes between any two frames a third of the stretch or more apart (Theil and Sen) of the logarithm
// of the silhouette's size, the root of its area.
double growth_of(const std::vector<std::optional<TargetLook>>& looks, double frame_interval_s) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (std::size_t j = i + looks.size() / 3; j < looks.size(); ++j)
      if (looks[i] && looks[j])
        slopes.push_back(0.5 * std::log(looks[j]->area_px / looks[i]->area_px) /
                         (static_cast<double>(j - i) * frame_interval_s));
  return slopes.empty() ? 0 : median(std::move(slopes));
}

// A place from which the whole path lies in the image. The rectangle that is looked for spans the path.
std::optional<cv::Point2d> place_for(const Stretch& stretch, const std::vector<cv::Point2d>& path_px,
                                     const cv::Rect& box, std::uint32_t seed) {
  cv::Point2d low, high;
  for (const cv::Point2d& at : path_px) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const cv::Size size(static_cast<int>(high.x - low.x) + box.width + 8,
                      static_cast<int>(high.y - low.y) + std::max(box.height, box.width / 2) + 8);
  const auto middle = similar_place(stretch.middle_frame(), stretch.middle_box(), size, seed);
  return middle ? std::optional(*middle - 0.5 * (low + high)) : std::nullopt;
}

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

// How far two silhouettes differ: logarithms of the ratios of their areas and of their boxes' sides.
double unlikeness(const TargetLook& a, const TargetLook& b) {
  return std::abs(std::log(a.area_px / b.area_px)) +
         std::abs(std::log(static_cast<double>(a.box.width) / b.box.width)) +
         std::abs(std::log(static_cast<double>(a.box.height) / b.box.height));
}

}  // namespace

std::optional<TrackerTargets> TrackerTargets::make(const RealClip& clip, const SampleOptions& options) {
  FrameSource footage = opened(clip.path);
  TrackerTargets made;
  made.clip_ = clip;
  made.shape_ = shape_of(footage.info());
  const int middle = static_cast<int>(clip.boxes.size()) / 2;
  auto stretch = expected(stretch_around(footage, clip.boxes, middle, kReach));
  if (!stretch || stretch->reach() != kReach) return std::nullopt;
  made.stretch_ = *std::move(stretch);
  auto real = measured_target({&made.stretch_.middle_frame(), 1}, {&made.stretch_.middle_box(), 1});
  if (!real || real->look.is_cut) return std::nullopt;
  made.real_ = *std::move(real);
  made.seed_ = seed_of(clip.name, middle);
  made.box_path_px_ = path_of_boxes(made.stretch_);
  const auto place = place_for(made.stretch_, made.box_path_px_, made.real_.look.box, made.seed_);
  if (!place) return std::nullopt;
  made.place_px_ = *place;
  const auto looks = looks_of(made.stretch_.frames, made.stretch_.boxes);
  made.own_path_px_ = path_of_silhouette(made.stretch_, looks, made.real_.look.centroid_px);
  made.growth_per_s_ = growth_of(looks, made.shape_.frame_interval_s);
  made.project_ = project_of(clip, made.shape_.size_px, options.folder);
  return made;
}

std::optional<TrackedTarget> TrackerTargets::moved() const {
  // Chroma samples move by whole ones.
  const cv::Rect& box = real_.look.box;
  const cv::Point2d now = 0.5 * cv::Point2d(box.tl() + box.br());
  const cv::Point shift(2 * cvRound((place_px_.x - now.x) / 2), 2 * cvRound((place_px_.y - now.y) / 2));
  TrackedTarget target;
  for (std::size_t i = 0; i < stretch_.frames.size(); ++i) {
    auto frame = with_target_moved(stretch_.frames[i], stretch_.boxes[i], shift);
    if (!frame) return std::nullopt;
    target.frames.push_back(*std::move(frame));
    target.boxes.push_back(shifted(stretch_.boxes[i], shift));
  }
  return target;
}

Insertion TrackerTargets::insertion_of(const Chosen& chosen, const MeasuredTarget& real, Workplace& workplace) const {
  return expected(Insertion::make(chosen.project, stretch_, shape_, real, place_px_, chosen.view, workplace.files,
                                  workplace.context));
}

void TrackerTargets::look_for_silhouette(const LookSettings& settings, Workplace& workplace) {
  double least = std::numeric_limits<double>::infinity();
  MeasuredTarget real = real_;
  real.path_px = own_path_px_;
  for (const ModelSettings& model : models_of(clip_.is_helicopter)) {
    if (!std::filesystem::exists(model.file)) continue;
    for (std::uint32_t n = 0; n < kViews; ++n) {
      Chosen chosen{project_, {.seed = seed_ + n, .growth_per_s = growth_per_s_}};
      apply(settings, clip_.name, chosen.project);
      chosen.project.intruders.front().model = model;
      if (n % 2 == 1) chosen.view.highest_rad = kHighest_rad;
      const auto target =
          expected(insertion_of(chosen, real, workplace).middle_target(chosen.project, CameraShake::as_real_target));
      if (!target || unlikeness(target->look, real.look) >= least) continue;
      least = unlikeness(target->look, real.look);
      similar_model_ = model;
      similar_view_ = chosen.view;
    }
  }
  // Where none is found in its box at all, the clip's model as it would be without this.
  if (!std::isfinite(least)) {
    similar_model_ = project_.intruders.front().model;
    similar_view_ = {.seed = seed_, .growth_per_s = growth_per_s_};
  }
}

// Boxes of the real ones' size: a tracker learns what a box holds, and how much of it is background must be alike.
std::vector<Box> TrackerTargets::boxes_of(const Insertion::Composed& composed, bool on_own_path) const {
  const std::size_t middle = composed.boxes.size() / 2;
  const auto look = on_own_path ? target_look(composed.frames[middle], composed.boxes[middle]) : std::nullopt;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < composed.boxes.size(); ++i) {
    const Box& real = stretch_.boxes[i];
    boxes.push_back(shifted(real, look ? look->centroid_px - real_.look.centroid_px
                                       : middle_of_box(composed.boxes[i]) - middle_of_box(real)));
  }
  return boxes;
}

std::optional<TrackedTarget> TrackerTargets::inserted(const LookSettings& settings, const Equalities& equal,
                                                      Workplace& workplace) const {
  MeasuredTarget real = real_;
  real.path_px = equal.path ? own_path_px_ : box_path_px_;
  Chosen chosen{project_, {.seed = seed_}};
  if (equal.growth) chosen.view.growth_per_s = growth_per_s_;
  apply(settings, clip_.name, chosen.project);
  if (equal.silhouette) {
    chosen.project.intruders.front().model = similar_model_;
    chosen.view = similar_view_;
  }
  Insertion insertion = insertion_of(chosen, real, workplace);
  if (equal.contrast) {
    if (!real.look.weber_rms) return std::nullopt;
    const auto same = with_same_contrast(chosen.project, *real.look.weber_rms, insertion);
    if (!same) return std::nullopt;
    chosen.project = *same;
  }
  Insertion::Composed composed = expected(insertion.composed(chosen.project, CameraShake::as_real_target));
  if (composed.frames.empty()) return std::nullopt;
  std::vector<Box> boxes = boxes_of(composed, equal.path);
  return TrackedTarget{.frames = std::move(composed.frames), .boxes = std::move(boxes)};
}

TargetFigures TrackerTargets::figures_of(const TrackedTarget& target) const {
  const auto looks = looks_of(target.frames, target.boxes);
  TargetFigures figures{.growth_per_s = growth_of(looks, shape_.frame_interval_s)};
  if (const auto& look = looks[looks.size() / 2]) {
    figures.area_px = look->area_px;
    figures.aspect = static_cast<double>(look->box.width) / look->box.height;
    figures.weber_rms = look->weber_rms.value_or(0);
  }
  const Box image{0, 0, static_cast<double>(shape_.size_px.width), static_cast<double>(shape_.size_px.height)};
  for (const Box& box : target.boxes)
    if (box.x < image.x || box.y < image.y || box.x + box.width > image.width || box.y + box.height > image.height)
      ++figures.frames_cut;
  return figures;
}

}  // namespace sigs::bench
