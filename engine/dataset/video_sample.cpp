// SPDX-License-Identifier: MIT
#include "dataset/video_sample.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include "base/pose.h"
#include "dataset/flight_plan.h"
#include "project/fields.h"

namespace sigs {

namespace {

// The samples of one video. Each time it is sampled again, every random number has another key.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::string video, int again)
      : seed_(seed), video_(std::move(video)), ending_(again > 0 ? fmt::format(" again {}", again) : "") {}

  [[nodiscard]] double number(const Quantity& quantity, const std::string& name) const {
    return sampled(quantity, {seed_, video_, name + ending_});
  }

  [[nodiscard]] std::uint64_t bits(const std::string& name) const {
    return random_bits({seed_, video_, name + ending_});
  }

  // One of so many, with equal probability.
  [[nodiscard]] std::size_t pick(std::size_t count, const std::string& name) const {
    return static_cast<std::size_t>(random_share({seed_, video_, name + ending_}) * static_cast<double>(count));
  }

 private:
  std::uint64_t seed_;
  std::string video_;
  std::string ending_;
};

// An image keeps its background, its frame and the number of its aircraft when it is sampled again, so that they are
// distributed as they were sampled first.
Sampler first_sampler(const Recipe& recipe, const VideoSpec& spec, int again) {
  return {recipe.seed, spec.name, recipe.groups[spec.group].is_images ? 0 : again};
}

std::map<std::string, std::string> tags_of(const Recipe& recipe, const VideoSpec& spec) {
  const Background& background = recipe.backgrounds[spec.background];
  const Aircraft& aircraft = recipe.aircraft[spec.aircraft];
  const VideoGroup& group = recipe.groups[spec.group];
  std::map<std::string, std::string> tags{
      {"background", background.name}, {"aircraft", aircraft.name}, {"flight", group.flights[spec.flight].name}};
  for (const auto* const more : {&group.tags, &aircraft.tags, &background.tags})
    tags.insert(more->begin(), more->end());
  return tags;
}

// `prefix` distinguishes the flights of one video.
FlightValues values_of(const FlightPlan& flight, const Sampler& sampler, const std::string& prefix) {
  FlightValues values;
  for (const FlightQuantity& quantity : quantities_of(flight.kind)) {
    const std::string name(quantity.name);
    if (const auto given = flight.quantities.find(name); given != flight.quantities.end())
      values[name] = sampler.number(given->second, prefix + name);
    else if (quantity.standard)
      values[name] = *quantity.standard;
  }
  return values;
}

// The frames of a video, or why the background does not have them.
Possible<FrameRange> frames_of(const VideoGroup& group, const Sampler& sampler, const FrameRange& there) {
  const int count = there.last - there.first + 1;
  const Quantity any{.kind = Quantity::Kind::uniform, .high = double(count)};
  const Quantity from = group.first_frame.value_or(group.is_images ? any : Quantity{});
  const double skipped = std::floor(sampler.number(from, "first_frame"));
  const double first = there.first + skipped;
  const double last = group.frames ? first + *group.frames - 1 : there.last;
  if (first <= last && last <= there.last) return FrameRange{static_cast<int>(first), static_cast<int>(last)};
  return tl::unexpected(fmt::format("{}: the background has {} frames, too few for {}from its frame {} on",
                                    group.frames ? "frames" : "first_frame", count,
                                    group.frames ? fmt::format("{} ", *group.frames) : "any ", std::llround(skipped)));
}

// The light that is sampled for a video; null: its background's.
const LightPlan* light_of(const VideoGroup& group, const Sampler& sampler) {
  return group.lights.empty() ? nullptr : &group.lights[sampler.pick(group.lights.size(), "light")];
}

std::vector<std::string> categories_of(const Recipe& recipe) {
  if (!recipe.base.output.categories.empty()) return recipe.base.output.categories;
  std::vector<std::string> categories;
  for (const Aircraft& aircraft : recipe.aircraft)
    if (std::find(categories.begin(), categories.end(), aircraft.category) == categories.end())
      categories.push_back(aircraft.category);
  return categories;
}

Project project_of(const Recipe& recipe, const VideoSpec& spec, const FrameRange& frames,
                   const std::map<std::string, double>& light) {
  const Background& background = recipe.backgrounds[spec.background];
  Project project = recipe.base;
  project.name = spec.name;
  project.footage = background.footage;
  project.footage.first_frame = frames.first;
  project.footage.last_frame = frames.last;
  project.camera = background.camera;
  project.appearance = background.appearance;
  project.light = with_sampled_light(background.light, light);
  project.output.categories = categories_of(recipe);
  project.intruders.clear();
  return project;
}

// The settings of a video of a matched background that the recipe states.
std::set<std::string> stated_in(const Background& background, const VideoGroup& group, const LightPlan* light) {
  std::set<std::string> keys(background.stated.begin(), background.stated.end());
  for (const auto& [key, quantity] : group.numbers) keys.insert(key);
  if (light == nullptr) return keys;
  for (const auto& [key, quantity] : light->numbers) keys.insert(key);
  for (const auto& [name, quantity] : light->quantities) keys.insert(setting_of_light(name));
  return keys;
}

// A body of a video: which aircraft, on which flight.
struct Flyer {
  const Aircraft& aircraft;
  const FlightPlan& flight;
  std::string prefix;  // of the names of its quantities; empty: the video's first
};

// One with quantities that are sampled is named so in the entry's `drawn`.
void sample_model(const Flyer& flyer, const Sampler& sampler, PlannedVideo& video, ModelSettings& model) {
  const Aircraft& aircraft = flyer.aircraft;
  if (!aircraft.liveries.empty()) {
    model.file = aircraft.liveries[sampler.pick(aircraft.liveries.size(), flyer.prefix + "livery")];
    if (flyer.prefix.empty()) video.tags.emplace("livery", std::filesystem::path(model.file).stem().string());
  }
  if (aircraft.scale == Quantity{.value = 1}) return;
  const double scale = sampler.number(aircraft.scale, flyer.prefix + "scale");
  (model.length_m > 0 ? model.length_m : model.scale) *= scale;
  video.sampled[flyer.prefix + "scale"] = scale;
}

// "bird", "bird 2", ...
std::string unused_name(const Project& project, const std::string& name) {
  int same = 0;
  for (const IntruderSettings& intruder : project.intruders)
    same += intruder.name == name || intruder.name.starts_with(name + " ") ? 1 : 0;
  return same == 0 ? name : fmt::format("{} {}", name, same + 1);
}

// A video while bodies are added to it.
struct VideoInWork {
  const Recipe& recipe;
  const VideoGroup& group;
  const OpenedBackground& background;
  const FlightContext& context;
  const Sampler& sampler;
  VideoVisibility& estimator;
  PlannedVideo& video;
};

bool have_common_area(const Box& a, const Box& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Where the intruder that was placed in the image may not be there: the reason. Else what it is before, where that was
// looked at.
using Behind = std::optional<VideoVisibility::Behind>;
Possible<Behind> checked_place(const VideoInWork& work, int frame) {
  const std::optional<VisibilityEstimate> seen = work.estimator.last_intruder_at(work.video.project, frame);
  if (!seen) return Behind();
  if (seen->visibility_state == VisibilityState::occluded)
    return tl::unexpected(std::string("x_percent, y_percent: the own body hides all of the intruder there"));
  if (seen->visibility_state == VisibilityState::out_of_view || !seen->silhouette)
    return tl::unexpected(std::string("x_percent, y_percent: the intruder is beside the image then"));
  const auto real = work.background.real_aircraft.find(frame);
  if (real != work.background.real_aircraft.end())
    for (const Box& box : real->second)
      if (have_common_area(box, *seen->silhouette))
        return tl::unexpected(std::string("real_aircraft: the intruder would be over a real aircraft"));
  const auto behind = work.estimator.behind(work.video.project.footage, frame, *seen->silhouette);
  if (behind && work.group.placement == Placement::sky && behind->sky < kNearlyAll)
    return tl::unexpected(std::string("placement: the image does not show sky there"));
  if (behind && work.group.placement == Placement::land && behind->land < kNearlyAll)
    return tl::unexpected(std::string("placement: the image does not show land there"));
  return behind;
}

// By nose_deg, where it was drawn: one heading for the whole flight, since that quantity is of straight flights.
void turn_nose(TrajectoryPlan& trajectory, const FlightValues& values) {
  const auto nose_deg = values.find("nose_deg");
  if (nose_deg == values.end() || trajectory.attitude == AttitudeKind::path || trajectory.waypoints.empty()) return;
  const glm::dvec3 way_m = trajectory.waypoints.back().position_m - trajectory.waypoints.front().position_m;
  const double course_deg = deg_of_rad(std::atan2(way_m.y, way_m.x));
  trajectory.waypoints.front().heading_deg = std::remainder(course_deg + nose_deg->second, 360);
}

// Samples numbers of the project, by their keys. They stand in `sampled` without `dropped` before them.
void sample_numbers(const std::map<std::string, Quantity>& numbers, const Sampler& sampler, const std::string& prefix,
                    std::size_t dropped, Project& project, std::map<std::string, double>& sampled) {
  if (numbers.empty()) return;
  for (const Field& field : fields_of(project)) {
    const auto quantity = numbers.find(field.key);
    if (quantity == numbers.end()) continue;
    const std::string name = prefix + field.key.substr(dropped);
    const double number = sampler.number(quantity->second, name);
    sampled[name] = number;
    if (auto* const* const real = std::get_if<double*>(&field.value)) **real = number;
    if (auto* const* const whole = std::get_if<int*>(&field.value)) **whole = static_cast<int>(std::floor(number));
    if (auto* const* const optional = std::get_if<std::optional<double>*>(&field.value)) **optional = number;
  }
}

// "heat.skin", "lights.strobe_cd" and others; "contrail.strands" and others, of an aircraft that flies high enough.
void sample_look(const Flyer& flyer, const Sampler& sampler, IntruderSettings& intruder,
                 std::map<std::string, double>& sampled) {
  const bool is_high = -intruder.trajectory.waypoints.front().position_m.z >= flyer.aircraft.contrail_above_m;
  Project alone;
  alone.intruders = {std::move(intruder)};
  const auto sample = [&](const std::map<std::string, Quantity>& numbers) {
    sample_numbers(numbers, sampler, flyer.prefix, std::string_view("intruders[0].").size(), alone, sampled);
  };
  sample(flyer.aircraft.drawn);
  if (is_high) sample(flyer.aircraft.contrail);
  intruder = std::move(alone.intruders.front());
}

// Adds a body to the project, or says why it cannot fly so.
Possible<void> add_flyer(const Flyer& flyer, const VideoInWork& work) {
  FlightValues values = values_of(flyer.flight, work.sampler, flyer.prefix);
  IntruderSettings intruder = work.recipe.base.intruders.front();
  intruder.name = unused_name(work.video.project, flyer.aircraft.name);
  intruder.category = flyer.aircraft.category;
  intruder.role = flyer.aircraft.is_distractor ? RoleChoice::distractor : RoleChoice::intruder;
  intruder.model = flyer.aircraft.model;
  sample_model(flyer, work.sampler, work.video, intruder.model);
  if (intruder.trajectory.attitude == AttitudeKind::path)
    intruder.trajectory.attitude = attitude_of_category(intruder.category);
  FlightContext context = work.context;
  context.speed_limits_mps = flyer.aircraft.speed_limits_mps;
  context.source = &flyer.flight.source;
  context.random_bits = work.sampler.bits(flyer.prefix + "flight_source");
  context.size_px_on = [&](const std::vector<WaypointSettings>& waypoints, int frame) -> std::optional<double> {
    Project alone = work.video.project;
    alone.intruders = {intruder};
    alone.intruders.front().trajectory.waypoints = waypoints;
    turn_nose(alone.intruders.front().trajectory, values);
    const std::optional<VisibilityEstimate> seen = work.estimator.last_intruder_at(alone, frame);
    return seen ? std::optional(seen->size_px) : std::nullopt;
  };
  Possible<PlannedFlight> planned = planned_flight(flyer.flight.kind, values, context);
  if (!planned) return tl::unexpected(planned.error());
  const std::optional<int> frame =
      flyer.flight.kind == FlightKind::image_position ? frame_of_position(values, context) : std::nullopt;
  values.merge(planned->derived);
  for (const auto& [name, value] : values) work.video.sampled[flyer.prefix + name] = value;
  if (planned->waypoints.size() > 2) {  // a drawn or recorded flight passes its waypoints
    intruder.trajectory.spline = SplineKind::interpolating;
    intruder.trajectory.timing = Timing::frames;
  }
  intruder.trajectory.waypoints = std::move(planned->waypoints);
  turn_nose(intruder.trajectory, values);
  sample_look(flyer, work.sampler, intruder, work.video.sampled);
  work.video.project.intruders.push_back(std::move(intruder));
  if (!frame) return {};
  const Possible<Behind> behind = checked_place(work, *frame);
  if (!behind) return tl::unexpected(behind.error());
  if (*behind) {
    work.video.sampled[flyer.prefix + "sky_percent"] = std::round(100 * (*behind)->sky);
    work.video.sampled[flyer.prefix + "land_percent"] = std::round(100 * (*behind)->land);
  }
  return {};
}

// What else flies. Keys of random numbers are those of the names in `drawn`, "other3.bearing_deg".
Possible<void> add_others(const VideoInWork& work) {
  int number = 0;
  for (std::size_t i = 0; i < work.group.others.size(); ++i) {
    const OthersPlan& others = work.group.others[i];
    const auto count =
        std::min(kMaxOthers, static_cast<int>(work.sampler.number(others.count, fmt::format("others[{}].count", i))));
    for (int n = 0; n < count; ++n) {
      const std::string prefix = fmt::format("other{}.", ++number);
      const std::string& name = others.aircraft[work.sampler.pick(others.aircraft.size(), prefix + "aircraft")];
      const Flyer flyer{.aircraft = work.recipe.aircraft[index_of(work.recipe.aircraft, name)],
                        .flight = others.flights[work.sampler.pick(others.flights.size(), prefix + "flight")],
                        .prefix = prefix};
      if (const auto added = add_flyer(flyer, work); !added)
        return tl::unexpected(fmt::format("others[{}].{}", i, added.error()));
    }
  }
  return {};
}

// The aircraft of the group's own: one of a video, of an image as many as its number says.
Possible<void> add_flyers(const VideoSpec& spec, int count, const VideoInWork& work) {
  const VideoGroup& group = work.group;
  for (int n = 0; n < count; ++n) {
    const std::string prefix = n == 0 ? "" : fmt::format("other{}.", n);
    const std::size_t aircraft =
        n == 0 ? spec.aircraft
               : index_of(work.recipe.aircraft,
                          group.aircraft[work.sampler.pick(group.aircraft.size(), prefix + "aircraft")]);
    const std::size_t flight = n == 0 ? spec.flight : work.sampler.pick(group.flights.size(), prefix + "flight");
    const Flyer flyer{.aircraft = work.recipe.aircraft[aircraft], .flight = group.flights[flight], .prefix = prefix};
    if (auto added = add_flyer(flyer, work); !added) return added;
  }
  return {};
}

}  // namespace

VideoSpec sampled_spec(const Recipe& recipe, VideoSpec spec, int again) {
  const VideoGroup& group = recipe.groups[spec.group];
  if (!group.is_sampled) return spec;
  const Sampler sampler(recipe.seed, spec.name, again);
  const std::size_t background = first_sampler(recipe, spec, again).pick(group.backgrounds.size(), "background");
  spec.background = index_of(recipe.backgrounds, group.backgrounds[background]);
  spec.aircraft = index_of(recipe.aircraft, group.aircraft[sampler.pick(group.aircraft.size(), "aircraft")]);
  spec.flight = sampler.pick(group.flights.size(), "flight");
  return spec;
}

std::optional<int> frame_of_image(const Recipe& recipe, const VideoSpec& spec, const FrameRange& frames) {
  const auto range = frames_of(recipe.groups[spec.group], first_sampler(recipe, spec, 0), frames);
  return range ? std::optional(range->first) : std::nullopt;
}

Possible<PlannedVideo> sampled_video(const Recipe& recipe, const VideoSpec& spec, const OpenedBackground& background,
                                     int again, VideoVisibility& estimator) {
  const VideoGroup& group = recipe.groups[spec.group];
  const Sampler sampler(recipe.seed, spec.name, again);
  const Sampler first = first_sampler(recipe, spec, again);
  const Possible<FrameRange> frames = frames_of(group, first, background.frames);
  if (!frames) return tl::unexpected(frames.error());
  const LightPlan* const light_plan = light_of(group, sampler);
  std::map<std::string, double> light;
  if (light_plan != nullptr)
    for (const auto& [name, quantity] : light_plan->quantities) light[name] = sampler.number(quantity, name);
  PlannedVideo video{.name = spec.name, .split = group.split, .tags = tags_of(recipe, spec)};
  video.project = project_of(recipe, spec, *frames, light);
  if (const Background& matched = recipe.backgrounds[spec.background]; matched.is_matched)
    video.stated = stated_in(matched, group, light_plan);
  if (light_plan != nullptr) sample_numbers(light_plan->numbers, sampler, "", 0, video.project, video.sampled);
  sample_numbers(group.numbers, sampler, "", 0, video.project, video.sampled);
  const FlightContext context{
      .camera = video.project.camera, .lens = background.lens, .footage = background.footage, .frames = *frames};
  const VideoInWork work{recipe, group, background, context, sampler, estimator, video};
  const auto count = static_cast<int>(first.number(group.per_image, "per_image"));
  Possible<void> step = add_flyers(spec, count, work);
  if (step) step = add_others(work);
  if (!step) return tl::unexpected(step.error());
  if (count == 0) video.tags["aircraft"] = video.tags["flight"] = "none";
  if (group.is_images || (group.first_frame && group.first_frame->kind != Quantity::Kind::fixed))
    video.sampled["first_frame"] = frames->first - background.frames.first;
  if (group.is_images) video.sampled["per_image"] = count;
  video.sampled.insert(light.begin(), light.end());
  return video;
}

}  // namespace sigs
