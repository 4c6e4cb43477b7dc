// SPDX-License-Identifier: MIT
#include "scene/opened_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <variant>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/text.h"
#include "mesh/model_files.h"
#include "project/fields.h"
#include "project/validate.h"
#include "scene/camera_track.h"
#include "scene/plausibility.h"
#include "scene/scene_light.h"
#include "scene/scene_parts.h"
#include "video/frame_quantisers.h"

namespace sigs {

namespace fs = std::filesystem;

Result<void> check_valid(const Project& project) {
  const std::vector<Problem> problems = validate(project);
  if (problems.empty() && !project.cameras.empty())
    return fail(project.file.string() + ": cameras", "has several cameras, of which one is to be chosen here",
                ErrorKind::bad_project);
  return problems.empty() ? Result<void>() : fail(error_of(project, problems.front()));
}

Result<Scene> open_valid_scene(const Project& project, const FootageShape& footage, SceneFiles& files) {
  const auto failed = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  Scene scene = bare_scene(project, footage);
  if (const Result<void, Problem> timed = set_range(scene, project, files); !timed) return failed(timed.error());
  Result<Camera, Problem> camera = scene_camera(project, footage, files);
  if (!camera) return failed(camera.error());
  scene.camera = *std::move(camera);
  Result<CameraFlight, Problem> flight = camera_flight(project, footage, {scene.first_frame, scene.last_frame}, files);
  if (!flight) return failed(flight.error());
  set_camera_motion(scene, *std::move(flight));
  if (const std::optional<Problem> problem = panorama_problem(scene)) return failed(*problem);
  const Result<SceneLight, Problem> light = scene_light(project, scene);
  if (!light) return failed(light.error());
  scene.light = *light;
  const Result<cv::Mat, Problem> own_body = scene_own_body(project, footage.size_px, files);
  if (!own_body) return failed(own_body.error());
  scene.own_body = *own_body;
  Result<BoxesByFrame, Problem> real_aircraft = scene_real_aircraft(project, files);
  if (!real_aircraft) return failed(real_aircraft.error());
  scene.real_aircraft = *std::move(real_aircraft);
  Result<Occluder, Problem> occluder = scene_occluder(project, scene, files);
  if (!occluder) return failed(occluder.error());
  scene.occluder = *std::move(occluder);
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const Result<std::shared_ptr<const Model>, Problem> model = scene_model(project, i, files);
    if (!model) return failed(model.error());
    const Result<Trajectory, Problem> trajectory = scene_trajectory(project, i, scene);
    if (!trajectory) return failed(trajectory.error());
    add_intruder(scene, project.intruders[i].name, *model, *trajectory);
    scene.intruders.back().is_distractor = project.intruders[i].role == RoleChoice::distractor;
    scene.intruders.back().contrail = project.intruders[i].contrail;
    scene.intruders.back().lights = project.intruders[i].lights;
  }
  scene.issues = plausibility_issues(project, scene);
  return scene;
}

Result<Scene> open_scene(const Project& project, const FootageShape& footage, SceneFiles& files) {
  if (const Result<void> valid = check_valid(project); !valid) return fail(valid.error());
  return open_valid_scene(project, footage, files);
}

Result<Scene> open_scene(const Project& project, const FootageShape& footage) {
  SceneFiles files;
  return open_scene(project, footage, files);
}

Result<OpenedProject> open_project(const Project& project, const std::atomic<bool>* cancel, FrameSource* footage,
                                   SceneFiles* files) {
  if (const Result<void> valid = check_valid(project); !valid) return fail(valid.error());
  Result<FrameSource> source =
      footage != nullptr ? std::move(*footage) : open_footage(project, cancel, quantisers_for(project));
  if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
  if (!source) return fail(footage_error(project, source.error()));
  SceneFiles own_files;
  Result<Scene> scene =
      open_valid_scene(project, footage_shape(project, source->info()), files != nullptr ? *files : own_files);
  if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
  if (!scene) return fail(scene.error());
  std::vector<Warning> warnings = warnings_of(source->info());
  for (Warning& warning : codec_warnings_of(project, source->info())) warnings.push_back(std::move(warning));
  for (Warning& warning : warnings_of(project, *scene, estimated_visibilities(*scene, kVisibilitySampleFrames)))
    warnings.push_back(std::move(warning));
  return OpenedProject{std::move(*source), std::move(*scene), std::move(warnings)};
}

Quantisers quantisers_for(const Project& project) {
  const CodecMatchSettings& codec = project.appearance.codec;
  const bool direct = project.compositing.method == MethodChoice::direct;
  if (project.output.codec == VideoCodec::source) return Quantisers::read;
  return direct && codec.match != CodecMatchChoice::none ? Quantisers::read : Quantisers::leave_out;
}

SequenceTiming timing_of(const Project& project) {
  const FootageSettings& footage = project.footage;
  return {.frame_rate_hz = footage.frame_rate_hz.value_or(0),
          .times_file = footage.timestamps.empty() ? fs::path() : resolved(project, footage.timestamps)};
}

FileStamp footage_stamp_of(const Project& project) {
  if (project.footage.video.empty()) return {};
  const fs::path video = fs::absolute(resolved(project, project.footage.video)).lexically_normal();
  return stamp_of(is_number_pattern(video) ? video.parent_path() : video);
}

Result<FrameSource> open_footage(const Project& project, const std::atomic<bool>* cancel, Quantisers quantisers) {
  Result<FrameSource> whole =
      FrameSource::open(resolved(project, project.footage.video), cancel, quantisers, timing_of(project));
  if (!whole) return whole;
  return cropped_footage(*std::move(whole), project);
}

Result<FrameSource> cropped_footage(FrameSource whole, const Project& project) {
  const CropSettings& crop = project.footage.crop;
  if (crop == CropSettings{}) return whole;
  if (const Result<void> done = whole.crop({crop.left_px, crop.top_px, crop.width_px, crop.height_px}); !done)
    return fail("footage.crop", done.error().what);
  return whole;
}

Error footage_error(const Project& project, const Error& error) {
  if (error.where == "footage.crop") return error_of(project, {"footage.crop.left_px", error.what, error.kind});
  return error_of(project, {"footage.video", error.text(), error.kind});
}

Error composing_error(const Project& project, const Error& error) {
  if (error.kind != ErrorKind::bad_project || !error.where.starts_with("footage.")) return error;
  return error_of(project, {error.where, error.what, error.kind});
}

FootageKey footage_key(const Project& project) {
  const SequenceTiming timing = timing_of(project);
  const CropSettings& crop = project.footage.crop;
  return {resolved(project, project.footage.video).string(),
          timing.frame_rate_hz,
          timing.times_file.string(),
          crop.left_px,
          crop.top_px,
          crop.width_px,
          crop.height_px};
}

FootageShape in_rig_time(FootageShape shape, const Project& project) {
  if (!project.rig_view) return shape;
  const ClockSettings& clock = project.rig_view->clock;
  for (double& time_s : shape.times_s) time_s = clock.rig_time_s(time_s);
  shape.frame_interval_s *= 1 + clock.drift_ppm * 1e-6;
  return shape;
}

FootageShape footage_shape(const Project& project, const VideoInfo& video) {
  return in_rig_time(shape_of(video), project);
}

std::vector<Warning> warnings_of(const VideoInfo& video) {
  std::vector<Warning> warnings = video.warnings;
  if (!video.conversion.empty()) warnings.push_back({video.path.string(), "is converted: " + video.conversion});
  return warnings;
}

namespace {

std::string codecs_of_depth(int bit_depth) {
  std::vector<std::string_view> names;
  for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::h264, VideoCodec::hevc, VideoCodec::av1, VideoCodec::png,
                                 VideoCodec::tiff, VideoCodec::raw})
    if (max_bit_depth(codec) >= bit_depth) names.emplace_back(name_of(codec));
  return listed(names);
}

// Of footage of more than 8 bits: what has fewer.
std::vector<Warning> depth_warnings_of(const Project& project, const VideoInfo& video) {
  std::vector<Warning> warnings;
  const auto warn = [&](const char* field, std::string what) {
    warnings.push_back({project.file.string() + ": " + field, std::move(what)});
  };
  const int depth = std::min(video.bit_depth, project.output.max_bit_depth);
  const VideoCodec codec = project.output.codec;
  if (depth > max_bit_depth(codec))
    warn("export.video.codec",
         fmt::format("{} has {} bits a sample at most, the footage {}: all samples are rounded; "
                     "codecs that keep them are {}",
                     name_of(codec), max_bit_depth(codec), video.bit_depth, codecs_of_depth(depth)));
  const MethodChoice method = project.compositing.method;
  if (video.bit_depth > 8 && method != MethodChoice::direct)
    warn("compositing.method",
         fmt::format(
             "{} works with 8 bits a sample, the footage has {}: what it changes has the steps of 8 bits; direct "
             "keeps all",
             method == MethodChoice::classic ? "classic" : "plain", video.bit_depth));
  return warnings;
}

// Of the codec match.
std::vector<Warning> match_warnings_of(const Project& project, const VideoInfo& video) {
  const CodecMatchSettings& codec = project.appearance.codec;
  if (codec.match == CodecMatchChoice::none || project.compositing.method != MethodChoice::direct) return {};
  if (video.bit_depth > 8)
    return {
        {project.file.string() + ": appearance.codec.match",
         fmt::format("is left out: it recompresses images of 8 bits a sample, the footage has {}", video.bit_depth)}};
  if (codec.quantiser) return {};
  const bool jpeg = codec.match == CodecMatchChoice::mjpeg;
  const bool is_its_own =
      codec.match == CodecMatchChoice::footage || (jpeg ? video.codec == "mjpeg" : video.codec == "h264");
  if (is_its_own && states_quantisers(video.codec)) return {};
  if (codec.match == CodecMatchChoice::footage && is_lossless_codec(video.codec)) return {};
  return {
      {project.file.string() + ": appearance.codec.quantiser",
       fmt::format("the footage, {}, does not state what to quantise by; {} is taken: set the quantiser if you know it",
                   video.codec,
                   jpeg ? fmt::format("a quality of {:g} percent", kDefaultJpegQuality_percent)
                        : fmt::format("H.264's QP {}", kDefaultQp))}};
}

}  // namespace

std::vector<Warning> codec_warnings_of(const Project& project, const VideoInfo& video) {
  std::vector<Warning> warnings = match_warnings_of(project, video);
  for (Warning& warning : depth_warnings_of(project, video)) warnings.push_back(std::move(warning));
  return warnings;
}

std::vector<Warning> warnings_of(const Project& project, const Scene& scene,
                                 const std::vector<Visibility>& visibilities) {
  std::vector<Warning> warnings = scene.warnings;
  const auto add = [&](const Problem& issue) {
    warnings.push_back({project.file.string() + ": " + issue.field, issue.what});
  };
  for (const Problem& issue : scene.issues) add(issue);
  if (project.rig_view) return warnings;  // what one camera of several never shows is no mistake
  for (std::size_t i = 0; i < visibilities.size(); ++i)
    if (std::optional<Problem> never = never_visible(visibilities[i], scene.intruders[i].name, i)) {
      if (const std::string where = where_out_of_view(scene, i); !where.empty()) never->what += "; " + where;
      add(*never);
    }
  return warnings;
}

Warning visible_in_no_camera(const Project& project, std::size_t intruder) {
  return {fmt::format("{}: intruders[{}].trajectory", project.file.string(), intruder),
          fmt::format("\"{}\" is visible in no camera", project.intruders.at(intruder).name)};
}

Result<FrameRange> range_in(const Scene& scene, const std::optional<FrameRange>& asked_for) {
  const FrameRange range = asked_for.value_or(FrameRange{scene.first_frame, scene.last_frame});
  if (range.first > range.last || range.first < scene.first_frame || range.last > scene.last_frame)
    return fail(fmt::format("frames {}-{}", range.first, range.last),
                fmt::format("the project has frames {} to {}", scene.first_frame, scene.last_frame), ErrorKind::usage);
  return range;
}

std::vector<fs::path> files_read_by(const Project& project) {
  std::vector<fs::path> files{project.file};
  Project copy = project;
  for (const Field& field : fields_of(copy)) {
    if (!field.is_path) continue;
    const fs::path file = resolved(project, *std::get<std::string*>(field.value));
    if (file.empty()) continue;
    files.push_back(field.key.ends_with("footage.calibration") ? calibration_name(file).file : file);
    if (field.key.ends_with("footage.video") && is_image_sequence(file))
      if (const Result<std::vector<fs::path>> images = files_of_sequence(file))
        files.insert(files.end(), images->begin(), images->end());
    if (!field.key.ends_with("model.file")) continue;
    if (const Result<std::vector<fs::path>> more = files_of_model(file))
      files.insert(files.end(), more->begin(), more->end());
  }
  return files;
}

Result<void> check_inputs_not_overwritten(const Project& project, const std::vector<fs::path>& outputs,
                                          std::string_view reader) {
  const bool any_there = std::any_of(outputs.begin(), outputs.end(), [](const fs::path& output) {
    std::error_code code;
    return fs::exists(fs::symlink_status(output, code));
  });
  return any_there ? check_inputs_not_overwritten(outputs, files_read_by(project), reader) : Result<void>();
}

}  // namespace sigs
