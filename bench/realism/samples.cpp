// SPDX-License-Identifier: MIT
#include "realism/samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "accuracy/csv.h"
#include "appearance/similar_place.h"
#include "base/pose.h"
#include "frame/compose_frame.h"
#include "realism/moved.h"
#include "scene/opened_project.h"
#include "scene/posed_intruder.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

constexpr int kAround = 3;  // frames before and after, for the flicker
constexpr double kField_rad = std::numbers::pi / 3;
constexpr double kLoose = 1.2;  // of an inserted target's box, like those of the real ones
constexpr double kLooseMargin_px = 3;

// The frames around the one that is measured, the middle one at kAround.
struct Stretch {
  int middle = 0;
  std::vector<Frame> frames;
  std::vector<Box> boxes;  // of the real target
};

std::optional<Stretch> stretch_around(int middle, const RealClip& clip, FrameSource& footage) {
  Stretch stretch{.middle = middle};
  for (int n = middle - kAround; n <= middle + kAround; ++n) {
    if (n < 0 || n >= static_cast<int>(clip.boxes.size()) || n >= footage.info().frame_count()) return std::nullopt;
    const auto& box = clip.boxes[static_cast<std::size_t>(n)];
    if (!box) return std::nullopt;
    const Result<Frame> frame = footage.read(n);
    if (!frame) accuracy::stop(frame.error().text());
    stretch.frames.push_back(cloned(*frame));
    stretch.boxes.push_back(*box);
  }
  return stretch;
}

cv::Mat surroundings(const Frame& frame, const cv::Rect& box) {
  const int margin_px = 12 + std::max(box.width, box.height) / 4;
  const cv::Rect part =
      cv::Rect(box.x - margin_px, box.y - margin_px, box.width + 2 * margin_px, box.height + 2 * margin_px) &
      cv::Rect({0, 0}, frame.size_px());
  return bgr_of(frame)(part).clone();
}

// The target in the middle frame, its flicker by all of them. box_in: loose box by position in the stretch.
std::optional<Target> measured(const std::string& kind, const std::vector<Frame>& frames,
                               const std::function<Box(std::size_t)>& box_in) {
  std::vector<TargetLook> looks;
  std::optional<TargetLook> middle;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto look = target_look(frames[i], box_in(i));
    if (look) looks.push_back(*look);
    if (i == kAround) middle = look;
  }
  if (!middle) return std::nullopt;
  Target target{.kind = kind, .look = *middle, .image = surroundings(frames[kAround], middle->box)};
  if (looks.size() < frames.size()) return target;
  add_flicker(target.look, looks);
  for (const TargetLook& look : looks) target.path_px.push_back(look.centroid_px - middle->centroid_px);
  return target;
}

ModelSettings model_for(const RealClip& clip, std::uint32_t seed) {
  const fs::path ours = fs::path(SIGS_ASSETS_DIR) / "models", others = fs::path(SIGS_TEST_DATA) / "models";
  const ModelSettings dauphin{
      .file = (others / "helicopter-dauphin/helicopter-dauphin.obj").string(), .forward = "-x", .up = "+y"};
  if (clip.is_helicopter && fs::exists(dauphin.file)) return dauphin;
  const ModelSettings aircraft[] = {
      {.file = (ours / "airliner/airliner.obj").string()},
      {.file = (ours / "light-aircraft/light-aircraft.obj").string()},
      {.file = (others / "boeing737-300/boeing737-300.obj").string(), .forward = "-x", .up = "+y"},
      {.file = (others / "cessna172p-hires/cessna172p-hires.obj").string(), .forward = "-x", .up = "+y"}};
  const ModelSettings& chosen = aircraft[seed % std::size(aircraft)];
  return fs::exists(chosen.file) ? chosen : aircraft[seed % 2];
}

// Seed of a sample: the same whatever else is measured.
std::uint32_t seed_of(const std::string& text, int frame) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  hash = (hash ^ static_cast<std::uint32_t>(frame)) * 16777619U;
  return hash ^ (hash >> 15);
}

Box loosened(const Box& box) {
  const double by_x = 0.5 * (kLoose - 1) * box.width + kLooseMargin_px;
  const double by_y = 0.5 * (kLoose - 1) * box.height + kLooseMargin_px;
  return {box.x - by_x, box.y - by_y, box.width + 2 * by_x, box.height + 2 * by_y};
}

// An aircraft of ours put into a stretch.
class Insertion {
 public:
  Insertion(const RealClip& clip, const Stretch& stretch, const FootageShape& shape, const fs::path& calibration,
            Workplace& workplace)
      : clip_(clip), stretch_(stretch), shape_(shape), workplace_(workplace) {
    project_.file = clip.name + ".json";
    project_.footage.video = fs::absolute(clip.path).string();
    project_.footage.calibration = calibration.string();
    const std::uint32_t seed = seed_of(clip.name, stretch.middle);
    project_.intruders.resize(1);
    project_.intruders.front().model = model_for(clip, seed_of(clip.name, 0));
    const Box &first = stretch.boxes.front(), &last = stretch.boxes.back();
    pose_.step_px = cv::Point2d(last.x + last.width / 2 - first.x - first.width / 2,
                                last.y + last.height / 2 - first.y - first.height / 2) /
                    (2.0 * kAround);
    pose_.seed = seed;
  }

  [[nodiscard]] std::string model() const { return fs::path(project_.intruders.front().model.file).stem().string(); }

  // The size so that a real target's silhouette and this one's have the same width, when both are measured alike.
  void place(cv::Point2d middle_px, const Target& target) {
    const TargetLook& real = target.look;
    real_path_px_ = target.path_px;
    pose_.middle_px = middle_px;
    pose_.aspect = static_cast<double>(real.box.width) / real.box.height;
    pose_.width_px = std::max(2.0, real.box.width - 1.0);
    Project sharp = project_;
    sharp.compositing.blur_px_per_m = 0;
    const auto inserted = measured_middle(sharp);
    if (inserted) pose_.width_px *= std::clamp(static_cast<double>(real.box.width) / inserted->box.width, 0.6, 1.6);
  }

  [[nodiscard]] std::optional<Target> target(const LookSettings& settings) {
    pose_.path_px.clear();
    Project project = project_;
    apply(settings, clip_.name, project);
    if (settings.shakes) pose_.path_px = real_path_px_;
    const Scene scene = scene_of(project);
    std::vector<Frame> frames;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < stretch_.frames.size(); ++i) {
      ComposedFrame composed = this->composed(scene, i);
      const auto& box = composed.truth.intruders.front().amodal_box;
      if (!box) return std::nullopt;
      boxes.push_back(loosened(*box));
      frames.push_back(std::move(composed.image));
    }
    for (const auto& model : scene.models) workplace_.context.forget(model->mesh);
    return measured(settings.name, frames, [&](std::size_t i) { return boxes[i]; });
  }

 private:
  [[nodiscard]] Scene scene_of(const Project& project) {
    Result<Scene> scene = posed_scene(project, shape_, workplace_.files, stretch_.middle, pose_);
    if (!scene) accuracy::stop(scene.error().text());
    return *std::move(scene);
  }

  [[nodiscard]] ComposedFrame composed(const Scene& scene, std::size_t i) {
    Result<ComposedFrame> composed =
        compose_frame(scene, stretch_.middle - kAround + static_cast<int>(i), stretch_.frames[i], workplace_.context);
    if (!composed) accuracy::stop(composed.error().text());
    return *std::move(composed);
  }

  [[nodiscard]] std::optional<TargetLook> measured_middle(const Project& project) {
    const Scene scene = scene_of(project);
    const ComposedFrame composed = this->composed(scene, kAround);
    const auto& box = composed.truth.intruders.front().amodal_box;
    return box ? target_look(composed.image, loosened(*box)) : std::nullopt;
  }

  const RealClip& clip_;
  const Stretch& stretch_;
  const FootageShape& shape_;
  Workplace& workplace_;
  Project project_;
  IntruderPose pose_;
  std::vector<cv::Point2d> real_path_px_;
};

std::optional<Target> moved_target(const Stretch& stretch, const Target& real, cv::Point2d middle_px) {
  // Chroma samples move by whole ones.
  const cv::Point2d now = 0.5 * cv::Point2d(real.look.box.tl() + real.look.box.br());
  const cv::Point shift(2 * cvRound((middle_px.x - now.x) / 2), 2 * cvRound((middle_px.y - now.y) / 2));
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < stretch.frames.size(); ++i) {
    auto moved = with_target_moved(stretch.frames[i], stretch.boxes[i], shift);
    if (!moved) return std::nullopt;
    frames.push_back(std::move(*moved));
  }
  return measured("moved", frames, [&](std::size_t i) {
    const Box& box = stretch.boxes[i];
    return Box{box.x + shift.x, box.y + shift.y, box.width, box.height};
  });
}

}  // namespace

std::vector<Sample> samples_of(const RealClip& clip, const SampleOptions& options, Workplace& workplace,
                               LeftOut& left_out) {
  FrameSource footage = opened(clip.path);
  const FootageShape shape = shape_of(footage.info());
  const fs::path calibration = written_pinhole(shape.size_px, kField_rad, options.folder / (clip.name + ".yml"));
  std::vector<Sample> samples;
  const int count = static_cast<int>(clip.boxes.size());
  for (int i = 0; i < options.frames_per_clip; ++i) {
    const int middle = (2 * i + 1) * count / (2 * options.frames_per_clip);
    const auto stretch = stretch_around(middle, clip, footage);
    if (!stretch) continue;
    const auto real = measured("real", stretch->frames, [&](std::size_t n) { return stretch->boxes[n]; });
    if (!real || real->look.is_cut) {
      ++(real ? left_out.cut : left_out.not_found);
      continue;
    }
    const cv::Size wanted(real->look.box.width + 8, std::max(real->look.box.height, real->look.box.width / 2) + 8);
    const auto place =
        similar_place(stretch->frames[kAround], stretch->boxes[kAround], wanted, seed_of(clip.name, middle));
    if (!place) {
      ++left_out.no_place;
      continue;
    }
    Sample sample{.clip = clip.name,
                  .is_helicopter = clip.is_helicopter,
                  .is_tuning = clip.is_tuning,
                  .frame = middle,
                  .targets = {*real}};
    if (auto moved = moved_target(*stretch, *real, *place)) sample.targets.push_back(std::move(*moved));
    Insertion insertion(clip, *stretch, shape, calibration, workplace);
    insertion.place(*place, *real);
    sample.model = insertion.model();
    for (const LookSettings& settings : options.settings)
      if (auto target = insertion.target(settings)) sample.targets.push_back(std::move(*target));
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace sigs::bench
