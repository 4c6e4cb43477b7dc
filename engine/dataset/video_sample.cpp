// SPDX-License-Identifier: MIT
#include "dataset/video_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dataset/flight_plan.h"

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

  // One of so many, with equal probability.
  [[nodiscard]] std::size_t pick(std::size_t count, const std::string& name) const {
    return static_cast<std::size_t>(random_share({seed_, video_, name + ending_}) * static_cast<double>(count));
  }

 private:
  std::uint64_t seed_;
  std::string video_;
  std::string ending_;
};

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

std::map<std::string, double> values_of(const FlightPlan& flight, const Sampler& sampler) {
  std::map<std::string, double> values;
  for (const FlightQuantity& quantity : quantities_of(flight.kind)) {
    const std::string name(quantity.name);
    if (const auto given = flight.quantities.find(name); given != flight.quantities.end())
      values[name] = sampler.number(given->second, name);
    else if (quantity.standard)
      values[name] = *quantity.standard;
  }
  return values;
}

// The frames of a video, or why the background does not have them.
tl::expected<FrameRange, std::string> frames_of(const VideoGroup& group, const Sampler& sampler,
                                                const FrameRange& there) {
  const double skipped = std::floor(sampler.number(group.first_frame, "first_frame"));
  const double first = there.first + skipped;
  const double last = group.frames ? first + *group.frames - 1 : there.last;
  if (first <= last && last <= there.last) return FrameRange{static_cast<int>(first), static_cast<int>(last)};
  return tl::unexpected(fmt::format("{}: the background has {} frames, too few for {}from its frame {} on",
                                    group.frames ? "frames" : "first_frame", there.last - there.first + 1,
                                    group.frames ? fmt::format("{} ", *group.frames) : "any ", std::llround(skipped)));
}

std::map<std::string, double> light_of(const VideoGroup& group, const Sampler& sampler) {
  std::map<std::string, double> values;
  if (group.lights.empty()) return values;
  const LightPlan& light = group.lights[sampler.pick(group.lights.size(), "light")];
  for (const auto& [name, quantity] : light.quantities) values[name] = sampler.number(quantity, name);
  return values;
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
                   std::vector<WaypointSettings> waypoints, const std::map<std::string, double>& light) {
  const Background& background = recipe.backgrounds[spec.background];
  const Aircraft& aircraft = recipe.aircraft[spec.aircraft];
  Project project = recipe.base;
  project.name = spec.name;
  project.footage = background.footage;
  project.footage.first_frame = frames.first;
  project.footage.last_frame = frames.last;
  project.camera = background.camera;
  project.light = with_sampled_light(background.light, light);
  project.output.categories = categories_of(recipe);
  IntruderSettings& intruder = project.intruders.front();
  intruder.name = aircraft.name;
  intruder.category = aircraft.category;
  intruder.model = aircraft.model;
  intruder.trajectory.waypoints = std::move(waypoints);
  return project;
}

}  // namespace

VideoSpec sampled_spec(const Recipe& recipe, VideoSpec spec, int again) {
  const VideoGroup& group = recipe.groups[spec.group];
  if (!group.is_sampled) return spec;
  const Sampler sampler(recipe.seed, spec.name, again);
  spec.background =
      index_of(recipe.backgrounds, group.backgrounds[sampler.pick(group.backgrounds.size(), "background")]);
  spec.aircraft = index_of(recipe.aircraft, group.aircraft[sampler.pick(group.aircraft.size(), "aircraft")]);
  spec.flight = sampler.pick(group.flights.size(), "flight");
  return spec;
}

tl::expected<PlannedVideo, std::string> sampled_video(const Recipe& recipe, const VideoSpec& spec,
                                                      const OpenedBackground& background, int again) {
  const VideoGroup& group = recipe.groups[spec.group];
  const FlightPlan& flight = group.flights[spec.flight];
  const Sampler sampler(recipe.seed, spec.name, again);
  const tl::expected<FrameRange, std::string> frames = frames_of(group, sampler, background.frames);
  if (!frames) return tl::unexpected(frames.error());
  PlannedVideo video{.name = spec.name, .split = group.split, .tags = tags_of(recipe, spec)};
  video.sampled = values_of(flight, sampler);
  tl::expected<PlannedFlight, std::string> planned =
      planned_flight(flight.kind, video.sampled,
                     {.camera = recipe.backgrounds[spec.background].camera,
                      .lens = background.lens,
                      .footage = background.footage,
                      .frames = *frames,
                      .speed_limits_mps = recipe.aircraft[spec.aircraft].speed_limits_mps});
  if (!planned) return tl::unexpected(planned.error());
  video.sampled.merge(planned->derived);
  if (group.first_frame.kind != Quantity::Kind::fixed)
    video.sampled["first_frame"] = frames->first - background.frames.first;
  const std::map<std::string, double> light = light_of(group, sampler);
  video.sampled.insert(light.begin(), light.end());
  video.project = project_of(recipe, spec, *frames, std::move(planned->waypoints), light);
  return video;
}

}  // namespace sigs
