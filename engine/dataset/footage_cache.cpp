// SPDX-License-Identifier: MIT
#include "dataset/footage_cache.h"

#include <fmt/format.h>

#include <memory>

#include "base/threads.h"
#include "export/export_project.h"
#include "horizon/horizon.h"
#include "scene/model.h"
#include "scene/scene_parts.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

// An error about a file, with the key of the recipe that names it in front.
tl::unexpected<Error> fail_at(const std::string& where, Error error) {
  return fail(where, error.text(), error.kind);
}

// A project of footage alone, whose paths are absolute.
Project project_of(const FootageSettings& footage) {
  Project project;
  project.footage = footage;
  return project;
}

// The footage of a project, by absolute paths.
FootageSettings footage_of(const Project& project) {
  FootageSettings settings = project.footage;
  settings.video = resolved(project, settings.video).string();
  if (!settings.timestamps.empty()) settings.timestamps = resolved(project, settings.timestamps).string();
  return settings;
}

Result<FootageShape> opened_shape(const FootageSettings& footage, const std::atomic<bool>* cancel = nullptr) {
  const Result<FrameSource> source = open_footage(project_of(footage), cancel);
  if (!source) return fail(source.error());
  return shape_of(source->info());
}

// A model of one metre for each unit of its file at the size of the settings, with what an estimate needs alone: its
// bounds and outermost points. So videos whose sizes are sampled share one file read. Null: it has no length.
std::shared_ptr<const Model> model_of_size(const Model& unit, const ModelSettings& settings) {
  const double length = double(unit.mesh.high_m.x) - double(unit.mesh.low_m.x);
  if (settings.length_m > 0 && !(length > 0)) return nullptr;
  const auto factor = static_cast<float>(settings.length_m > 0 ? settings.length_m / length : settings.scale);
  auto model = std::make_shared<Model>();
  model->mesh.low_m = factor * unit.mesh.low_m;
  model->mesh.high_m = factor * unit.mesh.high_m;
  model->mesh.radius_m = factor * unit.mesh.radius_m;
  for (const glm::vec3& point_m : unit.outermost_m) model->outermost_m.push_back(factor * point_m);
  return model;
}

// key: of the background in the recipe, for errors.
Result<OpenedBackground> opened_background(const Background& background, const std::string& key,
                                           const FootageShape& shape) {
  const FootageSettings& settings = background.footage;
  const std::string where = key + "footage.";
  Result<Camera> lens = read_calibration(settings.calibration, shape.size_px, settings.lens_model, shape.part);
  if (!lens) return fail_at(where + "calibration", lens.error());
  for (const auto& [name, mask] :
       {std::pair("own_body_mask", settings.own_body_mask), std::pair("occluder_mask", settings.occluder_mask)})
    if (!mask.empty())
      if (const Result<cv::Mat> read = read_own_body_mask(mask, shape.size_px); !read)
        return fail_at(where + name, read.error());
  BoxesByFrame real_aircraft;
  if (!settings.real_aircraft.empty()) {
    Result<BoxesByFrame> boxes = read_boxes_by_frame(settings.real_aircraft);
    if (!boxes) return fail_at(where + "real_aircraft", boxes.error());
    real_aircraft = *std::move(boxes);
  }
  if (const std::string& attitude = background.camera.attitude_file; !attitude.empty())
    if (const auto read = read_attitude_file(attitude); !read)
      return fail_at(key + "camera.attitude_file", read.error());
  if (const TrackSettings& track = background.camera.track; !track.file.empty()) {
    const Result<Track> read = read_track(track.file);
    if (!read) return fail_at(key + "camera.track.file", read.error());
    // Flights are planned about a camera that flies straight on (flight_plan.h).
    const bool has_position = !read->position.empty() || !read->local_position_ned_m.empty();
    if (track.position != TrackPositionChoice::none && has_position)
      return fail(key + "camera.track.position",
                  "is not \"none\", and the log has positions: a recipe plans flights about a camera that flies "
                  "straight on; use the log's "
                  "attitude alone, or write the encounter as a project");
  }
  const int last = static_cast<int>(shape.times_s.size()) - 1;
  const FrameRange frames{settings.first_frame, settings.last_frame.value_or(last)};
  if (frames.last > last || frames.first > frames.last)
    return fail(where + (frames.last > last ? "last_frame" : "first_frame"),
                fmt::format("the footage has frames 0 to {}", last));
  return OpenedBackground{shape, *std::move(lens), frames, std::move(real_aircraft)};
}

// The row of cells below all sky within a quarter of the image's width.
int land_from(const SkyMap& map, int column) {
  int row = 0;
  const int reach = map.sky.cols / 4;
  for (int x = std::max(0, column - reach); x <= std::min(map.sky.cols - 1, column + reach); ++x)
    row = std::max(row, map.end_of(x));
  return row;
}

// The frames that an export writes; of a further camera of a rig those of the time of the first one.
Result<FrameRange> range_of(const Project& project, const FootageShape& footage) {
  Scene scene = bare_scene(project, in_rig_time(footage, project));
  SceneFiles files;
  if (const Result<void, Problem> step = set_range(scene, project, files); !step)
    return fail(error_of(project, step.error()));
  return FrameRange{scene.first_frame, scene.last_frame};
}

}  // namespace

Result<std::vector<Result<OpenedBackground>>> opened_backgrounds(const Recipe& recipe) {
  std::map<FootageKey, FootageShape> shapes;  // of the clips that could be opened
  std::vector<Result<OpenedBackground>> backgrounds;
  bool has_any = false;
  for (const Background& background : recipe.backgrounds) {
    const std::string key = fmt::format("{}: backgrounds[{}].", recipe.file.string(), backgrounds.size());
    const FootageKey footage = footage_key(project_of(background.footage));
    if (!shapes.contains(footage)) {
      Result<FootageShape> shape = opened_shape(background.footage);
      if (!shape) {
        backgrounds.push_back(fail_at(key + "footage.video", shape.error()));
        continue;
      }
      shapes.emplace(footage, *std::move(shape));
    }
    Result<OpenedBackground> opened = opened_background(background, key, shapes.at(footage));
    if (!opened) return fail(opened.error());
    backgrounds.push_back(std::move(opened));
    has_any = true;
  }
  if (!has_any && !backgrounds.empty()) return fail(backgrounds.front().error());
  return backgrounds;
}

void VideoVisibility::remember(const FootageSettings& footage, const FootageShape& shape) {
  shapes_[footage_key(project_of(footage))] = shape;
}

std::optional<Scene> VideoVisibility::scene_of(const Project& project) {
  const FootageSettings settings = footage_of(project);
  const std::optional<FootageShape> footage = shape_of_footage(settings);
  if (!footage) return std::nullopt;
  Project unit = project;
  for (IntruderSettings& intruder : unit.intruders) {
    intruder.model.scale = 1;
    intruder.model.length_m = 0;
  }
  Result<Scene> scene = open_scene(unit, in_rig_time(*footage, project), files_);
  if (!scene) return std::nullopt;
  for (std::size_t i = 0; i < scene->intruders.size(); ++i) {
    std::shared_ptr<const Model> model = model_of_size(*scene->intruders[i].model, project.intruders[i].model);
    if (!model) return std::nullopt;
    scene->intruders[i].model = model.get();
    scene->models.push_back(std::move(model));
  }
  return *std::move(scene);
}

std::optional<Visibility> VideoVisibility::visibility_of(const Project& project, int frames) {
  const std::optional<Scene> scene = scene_of(project);
  if (!scene || scene->intruders.empty()) return std::nullopt;
  return estimated_visibilities(*scene, frames).front();
}

bool VideoVisibility::last_differs_by_a_flight(const Project& project) {
  if (!last_ || project.intruders.empty() || last_->project.intruders.size() != project.intruders.size()) return false;
  last_->project.intruders.back().trajectory = project.intruders.back().trajectory;
  if (last_->project != project) return false;
  Result<Trajectory, Problem> flight = scene_trajectory(project, project.intruders.size() - 1, last_->scene);
  if (!flight) return false;
  last_->scene.intruders.back().trajectory = *std::move(flight);
  return true;
}

std::optional<VisibilityEstimate> VideoVisibility::last_intruder_at(const Project& project, int frame) {
  if (!last_differs_by_a_flight(project)) {
    last_.reset();
    std::optional<Scene> scene = scene_of(project);
    if (!scene || scene->intruders.empty()) return std::nullopt;
    last_ = Opened{project, *std::move(scene)};
  }
  return VisibilityEstimator(last_->scene).at(static_cast<int>(project.intruders.size()) - 1, frame);
}

Result<void> VideoVisibility::look_for_sky(const FootageSettings& footage, const std::set<int>& frames,
                                           const std::atomic<bool>* cancel) {
  Result<FrameSource> source = open_footage(project_of(footage), cancel);
  if (!source) return fail(source.error());
  for (const int number : frames) {
    if (const Result<void> on = check_interrupt(cancel); !on) return on;
    const Result<Frame> frame = source->read(number);
    if (!frame) return fail(frame.error());
    const ReducedLuma reduced = reduced_luma(luma_of(*frame));
    skies_[{footage_key(project_of(footage)), number}] = {sky_map_of(reduced.luma), reduced.scale};
  }
  return {};
}

std::optional<VideoVisibility::Behind> VideoVisibility::behind(const FootageSettings& footage, int frame,
                                                               const Box& box) const {
  const auto there = skies_.find({footage_key(project_of(footage)), frame});
  if (there == skies_.end() || there->second.map.empty()) return std::nullopt;
  const auto& [map, scale] = there->second;
  constexpr int kPlaces = 8;  // along each side
  constexpr double kShare = 1.0 / (kPlaces * kPlaces);
  Behind behind;
  for (int i = 0; i < kPlaces; ++i) {
    const double x_px = std::max(0.0, (box.x + box.width * (i + 0.5) / kPlaces + 0.5) / scale);
    const int from = land_from(map, std::min(static_cast<int>(x_px) / SkyMap::kCell_px, map.sky.cols - 1));
    for (int j = 0; j < kPlaces; ++j) {
      const double y_px = std::max(0.0, (box.y + box.height * (j + 0.5) / kPlaces + 0.5) / scale);
      if (map.is_sky(x_px, y_px)) behind.sky += kShare;
      if (y_px >= from * SkyMap::kCell_px) behind.land += kShare;
    }
  }
  return behind;
}

std::optional<FootageShape> VideoVisibility::shape_of_footage(const FootageSettings& footage) {
  const FootageKey key = footage_key(project_of(footage));
  if (const auto known = shapes_.find(key); known != shapes_.end()) return known->second;
  const Result<FootageShape> shape = opened_shape(footage);
  return shapes_[key] = shape ? std::optional(*shape) : std::nullopt;
}

Result<int> frames_of(const Project& project, const FootageShape& footage) {
  const Result<FrameRange> range = range_of(project, footage);
  if (!range) return fail(range.error());
  return range->last - range->first + 1;
}

Result<ExportExtent> ExportExtents::of(const Project& project) {
  const FootageSettings settings = footage_of(project);
  const FootageKey key = footage_key(project_of(settings));
  std::unique_lock lock(mutex_);
  auto known = shapes_.find(key);
  if (known == shapes_.end()) {
    lock.unlock();
    Result<FootageShape> shape = opened_shape(settings, cancel_);
    lock.lock();
    known = shapes_.emplace(key, std::move(shape)).first;
  }
  if (!known->second) return fail(known->second.error());
  const FootageShape shape = *known->second;
  lock.unlock();
  const Result<FrameRange> frames = range_of(project, shape);
  if (!frames) return fail(frames.error());
  return ExportExtent{*frames, shape.size_px};
}

std::vector<std::optional<Visibility>> visibilities_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                                       const std::atomic<bool>* cancel) {
  VideoVisibility estimator;
  std::vector<std::optional<Visibility>> visibilities(videos.size());
  for (std::size_t i = 0; i < videos.size() && !is_cancelled(cancel); ++i)
    visibilities[i] = estimator.visibility_of(videos[i]->project, frames);
  return visibilities;
}

}  // namespace sigs
