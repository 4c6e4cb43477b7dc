// SPDX-License-Identifier: MIT
#include "first_project/first_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/input_file.h"
#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "first_project/first_camera.h"
#include "first_project/first_model.h"
#include "first_project/planning_steps.h"
#include "project/json.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "scene/scene_parts.h"
#include "telemetry/track_csv.h"
#include "video/frame_source.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr double kLowCamera_m = 10;    // what is lower stands on the ground
constexpr double kLongestSpan_s = 60;  // an encounter lasts about that long

// How far the making is when a step begins, by its run time of a clip of 10 s.
constexpr int kLogStep_percent = 5, kLookStep_percent = 10, kMotionStep_percent = 20, kMatchStep_percent = 60,
              kIntruderStep_percent = 95;

// A path as the project names it: relative to its folder, so that both can be moved together.
std::string relative_to(const fs::path& file, const fs::path& project_file) {
  const fs::path from = canonical_path(project_file.parent_path());
  const fs::path path = canonical_name(file).lexically_relative(from);
  return path.empty() ? canonical_name(file).string() : path.generic_string();
}

// The frames that are used: all, or the middle minute of a long clip.
struct UsedFrames {
  FrameRange range;
  std::optional<FirstProjectNote> note;
};

UsedFrames used_frames(const FootageShape& footage) {
  const int last = static_cast<int>(footage.times_s.size()) - 1;
  const double length_s = footage.times_s.back();
  UsedFrames used{.range = {0, last}, .note = {}};
  if (length_s <= kLongestSpan_s * 1.5) return used;
  const double begin_s = (length_s - kLongestSpan_s) / 2;
  const auto frame_near = [&](double time_s) {
    return std::clamp(static_cast<int>(std::floor(frame_at_time(footage, time_s))), 0, last);
  };
  used.range = {frame_near(begin_s), frame_near(begin_s + kLongestSpan_s)};
  used.note = FirstProjectNote{
      .field = "footage.first_frame",
      .text = fmt::format("frames {} to {}: the middle minute of {}; footage.first_frame and last_frame change it",
                          used.range.first, used.range.last, clock_text(length_s)),
      .is_guess = true};
  return used;
}

// Of images that of their folder.
std::string name_of_footage(const fs::path& video) {
  if (!is_image_sequence(video)) return stem_of(video);
  const fs::path path = canonical_name(video);
  return stem_of(is_number_pattern(path) ? path.parent_path() : path);
}

Result<void> check_options(const FirstProjectOptions& options) {
  if (!options.calibration.empty() && options.horizontal_fov_deg)
    return fail("calibration", "states the field of view; give it or a field of view, not both", ErrorKind::usage);
  if (!options.out.empty() && lower_extension(options.out) != ".json")
    return fail(options.out.string(), "a project file ends in .json", ErrorKind::usage);
  const std::string wrong = options.name.empty() ? "" : file_name_error(options.name);
  return wrong.empty() ? Result<void>() : fail("name", wrong, ErrorKind::usage);
}

// All that is made on the way from the video to the project.
class Planning {
 public:
  Planning(const FirstProjectOptions& options, const FirstProjectControl& control)
      : options_(options), control_(control) {}

  Result<FirstProject> planned() {
    if (const Result<void> sound = check_options(options_); !sound) return fail(sound.error());
    step(0, "reading the video");
    Result<FrameSource> source = FrameSource::open(
        options_.video, control_.cancel, options_.plain ? Quantisers::leave_out : Quantisers::read, options_.timing);
    if (const Result<void> on = check_interrupt(control_.cancel); !on) return fail(on.error());
    if (!source) return fail(source.error());
    const VideoInfo info = source->info();
    footage_ = shape_of(info);
    name_project();
    if (const Result<void> done = set_camera(info); !done) return fail(done.error());
    if (const Result<void> done = look(*source); !done) return fail(done.error());
    if (const Result<void> done = set_intruder(); !done) return fail(done.error());
    if (const Result<void> on = check_interrupt(control_.cancel); !on) return fail(on.error());
    step(100, "");
    first_.warnings.insert(first_.warnings.begin(), info.warnings.begin(), info.warnings.end());
    add_notes_file();
    return std::move(first_);
  }

 private:
  void step(int done_percent, const std::string& next) {
    if (control_.progress) control_.progress(done_percent, 100, next);
  }

  Project& project() { return first_.project; }
  [[nodiscard]] fs::path beside(const std::string& suffix) const {
    const fs::path& file = first_.project.file;
    return file.parent_path() / (stem_of(file) + suffix);
  }
  [[nodiscard]] fs::path calibration_file() const { return beside(".calibration.xml"); }

  void note(FirstProjectNote note) { first_.notes.push_back(std::move(note)); }

  void name_project() {
    const std::string name = !options_.name.empty()  ? options_.name
                             : !options_.out.empty() ? stem_of(options_.out)
                                                     : name_of_footage(options_.video);
    // Images already have a folder of that name.
    const std::string folder = is_image_sequence(options_.video) ? name + "-project" : name;
    const fs::path out = options_.out.empty() ? fs::path(folder) / (name + ".json") : options_.out;
    project().file = canonical_name(out);
    project().name = name;
    project().footage.video = relative_to(options_.video, project().file);
    if (options_.timing.frame_rate_hz > 0) project().footage.frame_rate_hz = options_.timing.frame_rate_hz;
    if (!options_.timing.times_file.empty())
      project().footage.timestamps = relative_to(options_.timing.times_file, project().file);
    const UsedFrames used = used_frames(footage_);
    range_ = used.range;
    if (!used.note) return;
    project().footage.first_frame = range_.first;
    project().footage.last_frame = range_.last;
    note(*used.note);
  }

  Result<void> set_camera(const VideoInfo& info) {
    step(kLogStep_percent, "reading the flight log");
    Result<FirstLog> log = log_of_video(options_.video, control_.cancel);
    if (!log) return fail(log.error());
    log_ = *std::move(log);
    Result<FirstCamera> camera = first_camera(options_, info, log_.lens);
    if (!camera) return fail(camera.error());
    camera_ = camera->camera;
    note(camera->note);
    lens_is_default_ = camera->is_default;
    const LensModel model = camera_->lens.parameters().model;
    if (options_.calibration.empty() && !needs_calibration(model)) {
      project().footage.lens_model = model;
    } else if (camera->calibration_text.empty()) {
      project().footage.calibration = relative_to(options_.calibration, project().file);
    } else {
      first_.files.push_back({.path = calibration_file(), .content = camera->calibration_text, .copy_of = {}});
      project().footage.calibration = calibration_file().filename().string();
    }
    const std::string log_path = log_.file.empty() ? "" : relative_to(log_.file, project().file);
    for (FirstProjectNote& track : set_track(log_, log_path, footage_, range_, project())) note(std::move(track));
    return {};
  }

  // The scene as far as it is known. The log fits: set_track() has tried it; so do the turns in the images.
  Scene scene() {
    Scene scene = bare_scene(project(), footage_);
    scene.camera = *camera_;
    scene.first_frame = range_.first;
    scene.last_frame = range_.last;
    if (project().camera.track.file.empty()) {
      set_camera_motion(scene, steady_flight(project()));
      // What hovers has no path, but a camera with settings.
      if (log_.track && log_.track->on_footage_time && !log_.track->white_cdpm2.values.empty())
        scene.motion.logged_white_cdpm2 = median(log_.track->white_cdpm2.values);
    } else if (Result<CameraFlight, Problem> flight =
                   flight_by_log(project(), seen_turns_ ? *seen_turns_ : *log_.track, footage_, range_)) {
      set_camera_motion(scene, *std::move(flight));
    }
    return scene;
  }

  // Whether the log has the camera's path.
  [[nodiscard]] bool has_path() const {
    const auto& track = first_.project.camera.track;
    return !track.file.empty() && track.position != TrackPositionChoice::none;
  }

  Result<void> look(FrameSource& source) {
    step(kLookStep_percent, "looking at the footage");
    if (!options_.plain) {
      const Result<std::optional<FirstProjectNote>> palette = set_palette(source, scene(), project(), control_.cancel);
      if (!palette) return fail(palette.error());
      if (*palette) note(**palette);
    }
    Result<FirstLook> look = first_look(source, scene(), control_.cancel);
    if (!look) return fail(look.error());
    Result<FirstMotion> motion = seen_motion(source, *look);
    if (!motion) return fail(motion.error());
    if (motion->focal) {
      if (const Result<void> done = take_focal_length(source, *motion->focal); !done) return done;
      look = first_look(source, scene(), control_.cancel);
      if (!look) return fail(look.error());
    }
    std::vector<FirstProjectNote> attitude;
    if (!scene().horizon_is_known) attitude = set_attitude(*look, has_path(), project());
    looks_up_ = project().camera.position_m.z > -kLowCamera_m;
    follow(*std::move(motion));
    // A level that the images show at each frame is the motion's, with a note of its own.
    if (!seen_turns_ || !seen_turns_->level_is_known)
      for (FirstProjectNote& one : attitude) note(std::move(one));
    return match(source, *look);
  }

  Result<void> take_focal_length(FrameSource& source, const FocalScale& seen) {
    Result<FirstCamera> camera = camera_by_turns(source.info(), seen);
    if (!camera) return fail(camera.error());
    camera_ = std::move(camera->camera);
    for (FirstProjectFile& file : first_.files)
      if (file.path == calibration_file()) file.content = camera->calibration_text;
    for (FirstProjectNote& one : first_.notes)
      if (one.field == camera->note.field) one = camera->note;
    return {};
  }

  // How the camera turns by the images, where no log tells it; else nothing, without a note.
  Result<FirstMotion> seen_motion(FrameSource& source, const FirstLook& look) {
    if (options_.plain || !lacks_attitude(log_, project())) return FirstMotion{};
    constexpr const char* kStep = "finding the camera's motion";
    step(kMotionStep_percent, kStep);
    const auto tell = [&](double share) {
      step(kMotionStep_percent + static_cast<int>(share * (kMatchStep_percent - kMotionStep_percent)), kStep);
    };
    return first_motion(source, scene(),
                        {.horizon_is_seen = look.level_by == LevelBy::horizon,
                         .lens_is_guessed = lens_is_default_,
                         .log = project().camera.track.file.empty() ? nullptr : log_.track.get()},
                        {.progress = tell, .cancel = control_.cancel});
  }

  // Lets the camera turn as the images show it.
  void follow(FirstMotion motion) {
    if (motion.track) {
      const fs::path file = beside(".attitude.csv");
      motion.attitudes.file = file.filename().string();
      follow_attitudes(project(), motion.attitudes);
      first_.files.push_back({.path = file, .content = track_csv_text(*motion.track), .copy_of = {}});
      seen_turns_ = std::move(motion.track);
    }
    if (motion.note.text.empty()) return;
    // It was looked for: to look for it again is of no use.
    for (FirstProjectNote& other : first_.notes)
      if (other.field == "camera.speed_mps") other.remedy.clear();
    note(std::move(motion.note));
  }

  Result<void> match(FrameSource& source, const FirstLook& look) {
    if (options_.plain) {
      note(set_light(look, project()));
      return {};
    }
    constexpr const char* kStep = "matching the footage's appearance";
    step(kMatchStep_percent, kStep);
    const auto tell = [&](double share) {
      step(kMatchStep_percent + static_cast<int>(share * (kIntruderStep_percent - kMatchStep_percent)), kStep);
    };
    const Result<std::vector<FirstProjectNote>> found =
        match_appearance(source, scene(), project(), {.progress = tell, .cancel = control_.cancel});
    if (!found) return fail(found.error());
    const Result<DarkOrThermal> light = set_dark_or_thermal(source, scene(), project(), control_.cancel);
    if (!light) return fail(light.error());
    if (light->note) note(*light->note);
    constexpr double kMinCover = 0.1;
    if (light->is_lit && look.cloud_cover >= kMinCover)
      note({.field = "footage.cloud_distance_m",
            .text = fmt::format("none: clouds cover {} % of the sky, and hide nothing as long as their distance is not "
                                "stated, which no footage tells",
                                std::lround(100 * look.cloud_cover)),
            .is_guess = true});
    // What daylight would do is of no use then.
    for (const FirstProjectNote& one : *found)
      if (light->is_lit || (!one.field.starts_with("light.") && one.field != "appearance.haze.visibility_m")) note(one);
    return {};
  }

  Result<void> set_intruder() {
    step(kIntruderStep_percent, "placing the intruder");
    SceneFiles files;
    Result<FirstModel> model = is_sample() ? sample_model(options_.model, files) : users_model(options_.model, files);
    if (!model) return fail(model.error());
    if (const Result<void> placed = set_model_file(*model); !placed) return placed;
    FirstFlight flight = first_flight(scene(), model->model);
    first_.visibility = flight.visibility;
    IntruderSettings intruder{.name = "intruder", .category = model->category, .model = model->settings};
    intruder.trajectory.attitude = attitude_of_category(intruder.category);
    intruder.trajectory.waypoints = std::move(flight.waypoints);
    if (project().light.white_cdpm2) intruder.lights = usual_lights(intruder.category);  // by night
    project().intruders = {std::move(intruder)};
    if (!options_.plain) project().compositing.quality = QualityChoice::automatic;
    project().camera.position_m.z -= flight.raise_m;
    note({.field = "camera.position_m",
          .text = fmt::format("{} m above the ground{}", number_text(-project().camera.position_m.z, 0),
                              looks_up_ ? ": a camera that looks up is taken to stand there" : ""),
          .is_guess = true});
    first_.notes.insert(first_.notes.end(), model->notes.begin(), model->notes.end());
    note(flight.note);
    first_.warnings.insert(first_.warnings.end(), model->warnings.begin(), model->warnings.end());
    return {};
  }

  [[nodiscard]] bool is_sample() const { return options_.model.empty() || is_sample_model(options_.model); }

  // The sample is copied, so that the project does not depend on where SIGS is installed.
  Result<void> set_model_file(FirstModel& model) {
    if (!is_sample()) {
      model.settings.file = relative_to(options_.model, project().file);
      return {};
    }
    const fs::path folder = project().file.parent_path() / model.file.stem();
    const Result<CopiedModel> copied = copied_model(model.file, folder);
    if (!copied) return fail(copied.error());
    model.settings.file = relative_to(copied->obj, project().file);
    first_.files.insert(first_.files.end(), copied->files.begin(), copied->files.end());
    return {};
  }

  // What was decided, as a text beside the project.
  void add_notes_file() {
    first_.files.push_back({.path = notes_file_of(project().file), .content = notes_text(first_), .copy_of = {}});
  }

  const FirstProjectOptions& options_;
  const FirstProjectControl& control_;
  FirstProject first_;
  FootageShape footage_;
  FrameRange range_;
  FirstLog log_;
  std::optional<Camera> camera_;
  bool lens_is_default_ = false;
  std::optional<Track> seen_turns_;  // of the camera, by the images
  bool looks_up_ = false;            // from the ground
};

}  // namespace

Result<FirstProject> planned_first_project(const FirstProjectOptions& options, const FirstProjectControl& control) {
  return Planning(options, control).planned();
}

}  // namespace sigs
