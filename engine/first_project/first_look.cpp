// SPDX-License-Identifier: MIT
#include "first_project/first_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "appearance/appearance.h"
#include "base/pose.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"
#include "telemetry/log_samples.h"

namespace sigs {

namespace {

constexpr int kLookFrames = 7;
constexpr double kSteady_rad = rad_of_deg(4);
constexpr double kMaxRoll_rad =
    rad_of_deg(7);  // what is tilted more in all frames is a hillside rather than the horizon

// The middles of equal parts of the range.
std::vector<int> look_frames(const Scene& scene) {
  const int length = scene.last_frame - scene.first_frame + 1;
  const int count = std::min(kLookFrames, length);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(scene.first_frame + static_cast<int>((2LL * i + 1) * length / (2LL * count)));
  return frames;
}

// Where the zenith is in each frame, in camera axes.
struct Horizons {
  std::vector<double> rolls_rad, pitches_rad;

  void add(const glm::dvec3& up) {
    pitches_rad.push_back(std::asin(std::clamp(up.x, -1.0, 1.0)));
    rolls_rad.push_back(std::atan2(-up.y, -up.z));
  }

  void set(FirstLook& look, std::size_t frames) const {
    if (2 * rolls_rad.size() < frames || rolls_rad.empty()) return;
    const double roll_rad = median_of(rolls_rad);
    const double pitch_rad = median_of(pitches_rad);
    std::size_t near = 0;
    for (std::size_t i = 0; i < rolls_rad.size(); ++i)
      near += std::abs(rolls_rad[i] - roll_rad) < kSteady_rad && std::abs(pitches_rad[i] - pitch_rad) < kSteady_rad;
    if (2 * near < frames || std::abs(roll_rad) > kMaxRoll_rad) return;
    look.roll_rad = roll_rad;
    look.pitch_rad = pitch_rad;
  }
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
  LightImageReader reader;
  Horizons horizons;
  std::size_t seen = 0;
  for (const int number : look_frames(scene)) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    const Result<Frame> frame = footage.read(number);
    if (!frame) return fail(frame.error());
    if (frame->damaged) continue;
    ++seen;
    View view{.camera = &scene.camera};
    if (scene.horizon_is_known)
      view.world_from_camera = camera_at(scene.motion, time_of_frame_s(scene.footage, number)).rotation;
    surroundings.add(*frame, view);
    if (scene.horizon_is_known) continue;
    if (const LightImage image = reader.read(*frame, view); image.skyline) horizons.add(image.skyline->up);
  }
  FirstLook look{.surroundings = surroundings.finish(sun)};
  horizons.set(look, seen);
  return look;
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
                          sun.azimuth_rad.is_known ? how_found(sun.witness) : "behind the camera, which is a guess");
  note.remedy = "`sigs appearance` looks at more, and at blur and noise";
  return note;
}

}  // namespace sigs
