// SPDX-License-Identifier: MIT
#include "comparison/inserted_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frame/compose_frame.h"
#include "video/frame.h"

namespace sigs {

namespace {

cv::Mat surroundings(const Frame& frame, const cv::Rect& box) {
  const int margin_px = 12 + std::max(box.width, box.height) / 4;
  const cv::Rect part(box.x - margin_px, box.y - margin_px, box.width + 2 * margin_px, box.height + 2 * margin_px);
  return bgr_of(frame)(part & cv::Rect({0, 0}, frame.size_px())).clone();
}

}  // namespace

Result<std::optional<Stretch>> stretch_around(FrameSource& footage, const std::vector<std::optional<Box>>& boxes,
                                              int middle, int reach) {
  const auto box_at = [&](int n) -> std::optional<Box> {
    if (n < 0 || n >= static_cast<int>(boxes.size()) || n >= footage.info().frame_count()) return std::nullopt;
    return boxes[static_cast<std::size_t>(n)];
  };
  if (!box_at(middle)) return std::optional<Stretch>();
  for (int n = middle - reach; n <= middle + reach; ++n)
    if (!box_at(n)) reach = 0;
  Stretch stretch{.middle = middle};
  for (int n = middle - reach; n <= middle + reach; ++n) {
    const Result<Frame> frame = footage.read(n);
    if (!frame) return fail(frame.error());
    stretch.frames.push_back(cloned(with_bit_depth(*frame, 8)));
    stretch.boxes.push_back(*box_at(n));
  }
  return std::optional(std::move(stretch));
}

std::optional<MeasuredTarget> measured_target(std::span<const Frame> frames, std::span<const Box> boxes) {
  const std::size_t middle = frames.size() / 2;
  std::vector<TargetLook> looks;
  std::optional<TargetLook> look;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto here = target_look(frames[i], boxes[i]);
    if (here) looks.push_back(*here);
    if (i == middle) look = here;
  }
  if (!look) return std::nullopt;
  MeasuredTarget target{.look = *look, .image = surroundings(frames[middle], look->box)};
  if (looks.size() < frames.size()) return target;
  add_flicker(target.look, looks);
  for (const TargetLook& one : looks) target.path_px.push_back(one.centroid_px - look->centroid_px);
  return target;
}

Result<std::vector<std::optional<Box>>> read_target_boxes(const std::filesystem::path& csv) {
  const auto by_frame = read_boxes_by_frame(csv);
  if (!by_frame) return fail(by_frame.error());
  if (by_frame->empty()) return fail(csv.string(), "has no box");
  std::vector<std::optional<Box>> boxes(static_cast<std::size_t>(by_frame->rbegin()->first) + 1);
  for (const auto& [frame, there] : *by_frame) boxes[static_cast<std::size_t>(frame)] = there.front();
  return boxes;
}

namespace {

constexpr double kLoose = 1.2;  // of an inserted target's box, as the real ones' boxes are loose
constexpr double kLooseMargin_px = 3;
constexpr double kMaxResizing = 1.6;  // of the first guess: a silhouette that is only told in part is not trusted more

Box loosened(const Box& box) {
  const double by_x = 0.5 * (kLoose - 1) * box.width + kLooseMargin_px;
  const double by_y = 0.5 * (kLoose - 1) * box.height + kLooseMargin_px;
  return {box.x - by_x, box.y - by_y, box.width + 2 * by_x, box.height + 2 * by_y};
}

cv::Point2d middle_of(const Box& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

// By which factor an inserted target is to be seen larger, so that its silhouette is as wide as the real one's.
double resizing(const TargetLook& look, const TargetLook& real) {
  return std::clamp(static_cast<double>(real.box.width) / look.box.width, 1 / kMaxResizing, kMaxResizing);
}

// How far the areas differ once both are as wide: logarithm of their ratio, without its sign.
double area_unlikeness(const TargetLook& look, const TargetLook& real) {
  const double larger = static_cast<double>(real.box.width) / look.box.width;
  return std::abs(std::log(look.area_px * larger * larger / real.area_px));
}

}  // namespace

Result<Insertion> Insertion::make(const Project& project, const Stretch& stretch, const FootageShape& shape,
                                  const MeasuredTarget& real, cv::Point2d middle_px, const InsertedView& view,
                                  SceneFiles& files, ComposeContext& context) {
  Insertion insertion(stretch, shape, files, context);
  insertion.real_path_px_ = real.path_px;
  IntruderPose& pose = insertion.pose_;
  pose.middle_px = middle_px;
  pose.aspect = static_cast<double>(real.look.box.width) / real.look.box.height;
  const double wanted_px = std::max(2.0, real.look.box.width - 1.0);
  pose.width_px = wanted_px;
  pose.seed = view.seed;
  pose.highest_rad = view.highest_rad;
  pose.growth_per_s = view.growth_per_s;
  if (stretch.reach() > 0)
    pose.step_px = (middle_of(stretch.boxes.back()) - middle_of(stretch.boxes.front())) / (2.0 * stretch.reach());
  // A silhouette by threshold is wider or narrower than the outline: both are to be the same by threshold.
  Project sharp = project;
  sharp.compositing.blur_px_per_m = 0;
  sharp.appearance = {};
  const auto middle = static_cast<std::size_t>(stretch.reach());
  IntruderPose best = pose;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < view.tries; ++n) {
    pose.seed = view.seed + static_cast<std::uint32_t>(n);
    pose.width_px = wanted_px;
    const Result<Composed> one = insertion.composed_between(sharp, middle, middle + 1);
    if (!one) return fail(one.error());
    const auto look = one->frames.empty() ? std::nullopt : target_look(one->frames[0], one->boxes[0]);
    if (!look) continue;
    pose.width_px *= resizing(*look, real.look);
    const double unlike = area_unlikeness(*look, real.look);
    if (unlike >= least) continue;
    least = unlike;
    best = pose;
  }
  pose = best;
  return insertion;
}

Result<Insertion::Composed> Insertion::composed(const Project& project, CameraShake shake) {
  pose_.path_px = shake == CameraShake::as_real_target ? real_path_px_ : std::vector<cv::Point2d>();
  return composed_between(project, 0, stretch_->frames.size());
}

Result<Insertion::Composed> Insertion::composed_between(const Project& project, std::size_t first, std::size_t end) {
  const Result<Scene> scene = posed_scene(project, shape_, *files_, stretch_->middle, pose_);
  if (!scene) return fail(scene.error());
  Composed all;
  for (std::size_t i = first; i < end; ++i) {
    Result<ComposedFrame> one = compose_frame(*scene, stretch_->middle - stretch_->reach() + static_cast<int>(i),
                                              stretch_->frames[i], *context_);
    if (!one) return fail(one.error());
    const auto& box = one->truth.intruders.front().amodal_box;
    if (!box) return Composed{};
    all.boxes.push_back(loosened(*box));
    all.frames.push_back(std::move(one->image));
  }
  for (const auto& model : scene->models) context_->forget(model->mesh);
  return all;
}

Result<std::optional<MeasuredTarget>> Insertion::middle_target(const Project& project, CameraShake shake) {
  pose_.path_px = shake == CameraShake::as_real_target ? real_path_px_ : std::vector<cv::Point2d>();
  const auto middle = static_cast<std::size_t>(stretch_->reach());
  const Result<Composed> one = composed_between(project, middle, middle + 1);
  if (!one) return fail(one.error());
  if (one->frames.empty()) return std::optional<MeasuredTarget>();
  return measured_target(one->frames, one->boxes);
}

Result<std::optional<MeasuredTarget>> Insertion::target(const Project& project, CameraShake shake) {
  const Result<Composed> all = composed(project, shake);
  if (!all) return fail(all.error());
  if (all->frames.empty()) return std::optional<MeasuredTarget>();
  return measured_target(all->frames, all->boxes);
}

}  // namespace sigs
