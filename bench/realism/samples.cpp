// SPDX-License-Identifier: MIT
#include "realism/samples.h"

#include <algorithm>
#include <numbers>

#include "accuracy/csv.h"
#include "appearance/target_silhouette.h"
#include "comparison/inserted_target.h"
#include "realism/moved.h"
#include "scene/opened_project.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

constexpr double kField_rad = std::numbers::pi / 3;

// One of models_of(), the same for a seed whether or not the others' models are there.
ModelSettings model_for(const RealClip& clip, std::uint32_t seed) {
  const std::vector<ModelSettings> models = models_of(clip.is_helicopter);
  const ModelSettings& chosen = models[clip.is_helicopter ? 1 - seed % 2 : seed % models.size()];
  return fs::exists(chosen.file) ? chosen : models[seed % (clip.is_helicopter ? 1 : 2)];
}

std::optional<MeasuredTarget> moved_target(const Stretch& stretch, const MeasuredTarget& real, cv::Point2d middle_px) {
  // Chroma samples move by whole ones.
  const cv::Point2d now = 0.5 * cv::Point2d(real.look.box.tl() + real.look.box.br());
  const cv::Point shift(2 * cvRound((middle_px.x - now.x) / 2), 2 * cvRound((middle_px.y - now.y) / 2));
  std::vector<Frame> frames;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < stretch.frames.size(); ++i) {
    auto moved = with_target_moved(stretch.frames[i], stretch.boxes[i], shift);
    if (!moved) return std::nullopt;
    frames.push_back(std::move(*moved));
    const Box& box = stretch.boxes[i];
    boxes.push_back({box.x + shift.x, box.y + shift.y, box.width, box.height});
  }
  return measured_target(frames, boxes);
}

}  // namespace

std::vector<ModelSettings> models_of(bool is_helicopter) {
  const fs::path ours = fs::path(SIGS_ASSETS_DIR) / "models", others = fs::path(SIGS_TEST_DATA) / "models";
  const auto at = [](const fs::path& file) { return ModelSettings{.file = file.string()}; };
  const auto as_flight_gear = [&](const char* file) {
    return ModelSettings{.file = (others / file).string(), .forward = "-x", .up = "+y"};
  };
  if (is_helicopter)
    return {at(ours / "helicopter/helicopter.obj"), as_flight_gear("helicopter-dauphin/helicopter-dauphin.obj")};
  return {at(ours / "airliner/airliner.obj"),
          at(ours / "light-aircraft/light-aircraft.obj"),
          at(ours / "airliner-grey/airliner-grey.obj"),
          at(ours / "light-aircraft-grey/light-aircraft-grey.obj"),
          at(ours / "light-aircraft-dark/light-aircraft-dark.obj"),
          as_flight_gear("boeing737-300/boeing737-300.obj"),
          as_flight_gear("cessna172p-hires/cessna172p-hires.obj")};
}

std::uint32_t seed_of(const std::string& text, int frame) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  hash = (hash ^ static_cast<std::uint32_t>(frame)) * 16777619U;
  return hash ^ (hash >> 15);
}

Project project_of(const RealClip& clip, cv::Size size_px, const fs::path& folder) {
  Project project{.file = clip.name + ".json"};
  project.footage.video = fs::absolute(clip.path).string();
  project.footage.calibration = written_pinhole(size_px, kField_rad, folder / (clip.name + ".yml")).string();
  project.intruders.resize(1);
  project.intruders.front().model = model_for(clip, seed_of(clip.name, 0));
  return project;
}

std::vector<Sample> samples_of(const RealClip& clip, const SampleOptions& options, Workplace& workplace,
                               LeftOut& left_out) {
  FrameSource footage = opened(clip.path);
  const FootageShape shape = shape_of(footage.info());
  Project project = project_of(clip, shape.size_px, options.folder);
  std::vector<Sample> samples;
  const int count = static_cast<int>(clip.boxes.size());
  for (int i = 0; i < options.frames_per_clip; ++i) {
    const int middle = clip.is_still ? 0 : (2 * i + 1) * count / (2 * options.frames_per_clip);
    const auto stretch = expected(stretch_around(footage, clip.boxes, middle));
    if (!stretch || (stretch->reach() == 0 && !clip.is_still)) continue;
    const auto real = measured_target(stretch->frames, stretch->boxes);
    if (!real || real->look.is_cut) {
      ++(real ? left_out.cut : left_out.not_found);
      continue;
    }
    const cv::Size wanted(real->look.box.width + 8, std::max(real->look.box.height, real->look.box.width / 2) + 8);
    const std::uint32_t seed = seed_of(clip.name, clip.is_still ? i : middle);
    const auto place = similar_place(stretch->middle_frame(), stretch->middle_box(), wanted, seed);
    if (!place) {
      ++left_out.no_place;
      continue;
    }
    project.intruders.front().model = model_for(clip, seed / 7);
    Sample sample{.clip = clip.name,
                  .is_helicopter = clip.is_helicopter,
                  .is_tuning = clip.is_tuning,
                  .frame = clip.is_still ? i : middle,
                  .model = fs::path(project.intruders.front().model.file).stem().string(),
                  .targets = {{"real", *real}}};
    if (auto moved = moved_target(*stretch, *real, *place)) sample.targets.push_back({"moved", std::move(*moved)});
    Insertion insertion =
        expected(Insertion::make(project, *stretch, shape, *real, *place, {.seed = seed, .tries = options.views},
                                 workplace.files, workplace.context));
    for (const LookSettings& settings : options.settings) {
      Project set = project;
      apply(settings, clip.name, set);
      auto target = expected(
          insertion.target(set, shakes_in(settings, clip.name) ? CameraShake::as_real_target : CameraShake::none));
      if (target) sample.targets.push_back({settings.name, std::move(*target)});
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace sigs::bench
