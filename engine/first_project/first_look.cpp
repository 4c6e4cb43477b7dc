// SPDX-License-Identifier: MIT
#include "first_project/planning_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "appearance/appearance.h"
#include "appearance/light_image.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "horizon/cloud_map.h"
#include "horizon/horizon.h"
#include "horizon/sky_map.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"
#include "telemetry/log_samples.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

constexpr int kLookFrames = 7;
constexpr double kCloud = 0.3;  // opacity of what counts as clouds
constexpr double kSteady_rad = rad_of_deg(4);
constexpr double kOnlySky = 0.8, kNoSky = 0.08;  // shares of a frame
constexpr double kMinBlue = 0.5;                 // of green, linear light: sky; meadows and woods have less
constexpr double kLooksUp_rad = rad_of_deg(5);
constexpr double kGuessedUp_deg = 30, kGuessedDown_deg = -90;
constexpr double kOnGround_m = 2;

// The middles of equal parts of the range.
std::vector<int> look_frames(const Scene& scene) {
  const int length = scene.last_frame - scene.first_frame + 1;
  const int count = std::min(kLookFrames, length);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(scene.first_frame + static_cast<int>((2LL * i + 1) * length / (2LL * count)));
  return frames;
}

// What tells the level, frame by frame.
class Levels {
 public:
  void add(const Frame& frame, const Camera& camera) {
    ++frames_;
    const ReducedLuma reduced = reduced_luma(luma_of(frame));
    if (is_gray(frame)) {
      if (const auto warm_rad = skyline_pitch_rad(sky_above_warm_ground(reduced.luma), reduced.scale, camera))
        warm_pitches_rad_.push_back(*warm_rad);
      may_be_thermal_ = may_be_thermal_ || is_as_small_as_thermal(frame.size_px());
    }
    const SkyMap sky = sky_map_of(reduced.luma);
    const bool is_sky = has_colors_of_sky(frame, sky);
    if (sky.share < kNoSky || !is_sky) ++grounds_;
    if (!is_sky) return;
    if (const auto line = horizon_in(reduced.luma, reduced.scale, camera, {}, 0)) {
      line_pitches_rad_.push_back(std::asin(std::clamp(line->up.x, -1.0, 1.0)));
      line_rolls_rad_.push_back(std::atan2(-line->up.y, -line->up.z));
    }
    if (const auto pitch_rad = skyline_pitch_rad(sky, reduced.scale, camera))
      skyline_pitches_rad_.push_back(*pitch_rad);
    else if (sky.share > kOnlySky)
      ++skies_;
  }

  void set(FirstLook& look) const {
    if (frames_ == 0) return;
    if (2 * warm_pitches_rad_.size() >= frames_) {
      look.level_by = LevelBy::skyline;
      look.pitch_rad = median(warm_pitches_rad_);
      return;
    }
    if (set_horizon(look)) return;
    if (2 * skyline_pitches_rad_.size() >= frames_) {
      look.level_by = LevelBy::skyline;
      look.pitch_rad = median(skyline_pitches_rad_);
    } else if (2 * (skies_ + skyline_pitches_rad_.size()) >= frames_) {
      look.level_by = LevelBy::sky;
      look.pitch_rad = rad_of_deg(kGuessedUp_deg);
    } else if (2 * grounds_ >= frames_ && !may_be_thermal_) {  // clouds are rough to a thermal camera, as ground is
      look.level_by = LevelBy::ground;
      look.pitch_rad = rad_of_deg(kGuessedDown_deg);
    }
  }

 private:
  bool set_horizon(FirstLook& look) const {
    if (2 * line_rolls_rad_.size() < frames_) return false;
    const double roll_rad = median(line_rolls_rad_);
    const double pitch_rad = median(line_pitches_rad_);
    std::size_t near = 0;
    for (std::size_t i = 0; i < line_rolls_rad_.size(); ++i)
      near += std::abs(line_rolls_rad_[i] - roll_rad) < kSteady_rad &&
              std::abs(line_pitches_rad_[i] - pitch_rad) < kSteady_rad;
    if (2 * near < frames_) return false;
    look.level_by = LevelBy::horizon;
    look.roll_rad = roll_rad;
    look.pitch_rad = pitch_rad;
    return true;
  }

  static bool has_colors_of_sky(const Frame& frame, const SkyMap& sky) {
    const LightGrid grid = light_grid_of(frame);
    if (grid.empty() || sky.empty()) return false;
    cv::Mat cells;
    cv::resize(sky.sky, cells, grid.size(), 0, 0, cv::INTER_NEAREST);
    const cv::Scalar light = cv::mean(grid.light, cells == 255);
    return light[2] >= kMinBlue * light[1];
  }

  // Without colours, but for what a codec leaves of them: a code of 8 bits in the mean.
  static bool is_gray(const Frame& frame) {
    const int step = codes_per_8_bit_step(frame.bit_depth);
    const bool is_rgb = frame.layout == PixelLayout::rgb;
    for (std::size_t i = 1; i < static_cast<std::size_t>(frame.plane_count()); ++i) {
      const cv::Mat& plane = frame.planes[i];
      cv::Mat off;
      if (is_rgb)
        cv::absdiff(plane, frame.planes[0], off);
      else
        cv::absdiff(plane, cv::Scalar::all(128 * step), off);
      if (cv::mean(off)[0] > step) return false;
    }
    return true;
  }

  std::vector<double> line_rolls_rad_, line_pitches_rad_, skyline_pitches_rad_;
  std::vector<double> warm_pitches_rad_;  // of skylines above which it is darker
  bool may_be_thermal_ = false;
  std::size_t frames_ = 0, skies_ = 0, grounds_ = 0;
};

// By the camera's log, where that has time and place.
std::optional<GivenSun> sun_by_log(Scene scene) {
  if (!scene.earth || !scene.utc_at_frame_0_s) return std::nullopt;
  scene.light = {};  // the direction that the project states must not stand for the computed one
  const int middle = (scene.first_frame + scene.last_frame) / 2;
  return GivenSun{.to_sun_in_world = sunlight_at(scene, time_of_frame_s(scene.footage, middle)).to_sun};
}

}  // namespace

Result<FirstLook> first_look(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel) {
  const std::optional<GivenSun> sun = sun_by_log(scene);
  Surroundings surroundings(!sun);
  Levels levels;
  std::vector<double> covers;
  const bool is_round = scene.camera.lens.period_px() > 0;
  const std::optional<HeatColors> colors = heat_colors(scene.palette);
  for (const int number : look_frames(scene)) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    Result<Frame> frame = footage.read(number);
    if (!frame) return fail(frame.error());
    if (frame->damaged) continue;
    if (colors) frame = colors->heat_of(*frame).frame;
    View view{.camera = &scene.camera};
    if (scene.horizon_is_known)
      view.world_from_camera = camera_at(scene.motion, time_of_frame_s(scene.footage, number)).rotation;
    surroundings.add(*frame, view);
    if (!scene.horizon_is_known && !is_round) levels.add(*frame, scene.camera);
    covers.push_back(CloudMap(*frame).cover(kCloud));
  }
  FirstLook look{.surroundings = surroundings.finish(sun), .cloud_cover = covers.empty() ? 0 : median(covers)};
  if (is_round)
    look.level_by = LevelBy::all_round;
  else
    levels.set(look);
  return look;
}

std::vector<FirstProjectNote> set_attitude(const FirstLook& look, bool has_path, Project& project) {
  FirstProjectNote note{.field = "camera.attitude_deg", .is_guess = true};
  if (look.level_by == LevelBy::nothing) {
    note.text = "not known: no horizon was found in the footage; the camera counts as level";
    return {note};
  }
  const auto rounded_deg = [](double rad) { return std::round(10 * deg_of_rad(rad)) / 10 + 0.0; };
  project.camera.roll_deg = rounded_deg(look.roll_rad);
  project.camera.pitch_deg = rounded_deg(look.pitch_rad);
  const std::string pitch = number_text(*project.camera.pitch_deg, 1);
  switch (look.level_by) {
    case LevelBy::horizon:
      note.text = fmt::format("roll {}, pitch {}: by the horizon in a few frames",
                              number_text(*project.camera.roll_deg, 1), pitch);
      note.remedy = "`sigs ego-motion` finds each frame's attitude";
      break;
    case LevelBy::all_round:
      note.text = "roll 0, pitch 0: 360 degree cameras mostly level their footage";
      note.remedy = "level it while it is stitched, or set camera.attitude_deg";
      break;
    case LevelBy::skyline:
      note.text = fmt::format(
          "pitch {}: by where the sky ends above woods, hills or houses, right to some degrees; "
          "roll 0",
          pitch);
      break;
    case LevelBy::sky:
      note.text = fmt::format(
          "pitch {}: only sky is in sight, so that the camera looks up; by how much the footage does "
          "not tell",
          pitch);
      break;
    default:
      note.text = fmt::format(
          "pitch {}: only ground is in sight, so that the camera looks down; by how much the footage "
          "does not tell",
          pitch);
  }
  std::vector<FirstProjectNote> notes{note};
  if (look.pitch_rad <= kLooksUp_rad || has_path) return notes;
  project.camera.position_m.z = -kOnGround_m;
  return notes;
}

FirstProjectNote set_light(const FirstLook& look, Project& project) {
  FirstProjectNote note{.field = "light.kind", .is_guess = true};
  const LightEstimate& light = look.surroundings.light;
  if (!light.sky_color[0].is_known) {
    note.text = "the default light: " + light.sky_color[0].why;
    note.remedy = "set light.* as the footage is lit, or use `sigs appearance`";
    return note;
  }
  const CompositingSettings compositing = project.compositing;
  const AppearanceSettings appearance = project.appearance;
  Appearance seen;
  seen.surroundings = look.surroundings;
  apply(seen, project);
  project.compositing = compositing;
  project.appearance = appearance;
  const SunEstimate& sun = look.surroundings.sun;
  note.text = fmt::format("sun, sky and ground as a few frames show them, the sun {}",
                          sun.azimuth_rad.is_known ? how_found(sun.evidence) : "behind the camera, which is a guess");
  note.remedy = "`sigs appearance` looks at more, and at blur and noise";
  return note;
}

}  // namespace sigs
