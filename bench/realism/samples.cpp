// SPDX-License-Identifier: MIT
#include "realism/samples.h"

#include <algorithm>
#include <numbers>

#include "accuracy/csv.h"
#include "appearance/target_look.h"
#include "comparison/inserted_target.h"
#include "scene/opened_project.h"

#include <opencv2/imgproc.hpp>

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

namespace {

constexpr double kWhole_px = 10;  // around the target: taken over wholly
constexpr double kSoft_px = 5;    // beyond: less and less
constexpr double kFine_px = 4;    // sigma: what is smoother at the new place is background

// The plane with the weighted stretch replaced by the smooth background there plus the difference.
void put(cv::Mat& plane, const cv::Mat& difference, const cv::Mat& weight, cv::Point at) {
  cv::Mat part = plane(cv::Rect(at, difference.size())), values, smooth;
  part.convertTo(values, CV_32F);
  cv::GaussianBlur(values, smooth, {}, kFine_px);
  const cv::Mat mixed = values + weight.mul(smooth + difference - values);
  mixed.convertTo(part, CV_8U);
}

}  // namespace

std::optional<Frame> with_target_moved(const Frame& frame, const Box& box, cv::Point shift) {
  const auto target = target_silhouette(frame, box);
  if (!target || frame.layout == PixelLayout::rgb) return std::nullopt;
  cv::Mat weight = (kWhole_px + kSoft_px - target->distance_px) / kSoft_px;
  weight = cv::max(0.0, cv::min(1.0, weight));
  const cv::Size step = chroma_step(frame.layout);
  cv::Rect part = target->patch;
  part.x += part.x % 2;  // where chroma samples begin
  part.y += part.y % 2;
  part.width = (target->patch.br().x - part.x) / 2 * 2;
  part.height = (target->patch.br().y - part.y) / 2 * 2;
  const cv::Rect image({0, 0}, frame.size_px());
  const cv::Rect wanted = cv::Rect(part.tl() + shift, part.size());
  // As much of the patch as lies within the image at the new place; the target's own neighbourhood must.
  const cv::Rect reach =
      cv::Rect(target->box.x - 8, target->box.y - 8, target->box.width + 16, target->box.height + 16);
  if (((reach + shift) & image) != reach + shift) return std::nullopt;
  cv::Rect there = wanted & image;
  there.width = there.width / 2 * 2;
  there.height = there.height / 2 * 2;
  const cv::Rect in_patch = there - shift - target->patch.tl();
  Frame moved = cloned(frame);
  put(moved.planes[0], target->difference(in_patch), weight(in_patch), there.tl());
  const cv::Mat differences[] = {{}, target->cb_difference, target->cr_difference};
  for (int p = 1; p < frame.plane_count(); ++p) {
    // The chroma samples themselves: the background's surface is the same whichever plane size it is taken from.
    const cv::Size size(there.width / step.width, there.height / step.height);
    const cv::Point from((there.x - shift.x) / step.width, (there.y - shift.y) / step.height);
    cv::Mat surface, samples, small_weight, small_surface;
    const cv::Mat full = p == 1 ? target->cb : target->cr;
    surface = full(in_patch) - differences[p](in_patch);
    cv::resize(surface, small_surface, size, 0, 0, cv::INTER_AREA);
    cv::resize(weight(in_patch), small_weight, size, 0, 0, cv::INTER_AREA);
    frame.planes[static_cast<std::size_t>(p)](cv::Rect(from, size)).convertTo(samples, CV_32F);
    put(moved.planes[static_cast<std::size_t>(p)], samples - small_surface, small_weight,
        {there.x / step.width, there.y / step.height});
  }
  return moved;
}

}  // namespace sigs::bench
