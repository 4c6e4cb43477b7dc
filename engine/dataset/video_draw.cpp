// SPDX-License-Identifier: MIT
#include "dataset/video_draw.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dataset/flight_plan.h"
#include "dataset/light_draw.h"

namespace sigs {

namespace {

// The draws of one video. Each time it is drawn again, every number comes from another place.
class Draws {
 public:
  Draws(std::uint64_t seed, std::string video, int again)
      : seed_(seed), video_(std::move(video)), ending_(again > 0 ? " again " + std::to_string(again) : "") {}

  [[nodiscard]] double number(const Quantity& quantity, const std::string& name) const {
    return drawn(quantity, {seed_, video_, name + ending_});
  }

  // One of so many, each as likely.
  [[nodiscard]] std::size_t pick(std::size_t count, const std::string& name) const {
    return static_cast<std::size_t>(random_share({seed_, video_, name + ending_}) * static_cast<double>(count));
  }

 private:
  std::uint64_t seed_;
  std::string video_;
  std::string ending_;
};

template <class Named>
std::size_t index_of(const std::vector<Named>& all, const std::string& name) {
  const auto place = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return static_cast<std::size_t>(place - all.begin());
}

std::map<std::string, std::string> tags_of(const Recipe& recipe, const Cast& cast) {
  const Background& background = recipe.backgrounds[cast.background];
  const Aircraft& aircraft = recipe.aircraft[cast.aircraft];
  const VideoGroup& group = recipe.groups[cast.group];
  std::map<std::string, std::string> tags{
      {"background", background.name}, {"aircraft", aircraft.name}, {"flight", group.flights[cast.flight].name}};
  for (const auto* const more : {&group.tags, &aircraft.tags, &background.tags})
    tags.insert(more->begin(), more->end());
  return tags;
}

std::map<std::string, double> values_of(const FlightPlan& flight, const Draws& draws) {
  std::map<std::string, double> values;
  for (const FlightQuantity& quantity : quantities_of(flight.kind)) {
    const std::string name(quantity.name);
    if (const auto given = flight.quantities.find(name); given != flight.quantities.end())
      values[name] = draws.number(given->second, name);
    else if (quantity.standard)
      values[name] = *quantity.standard;
  }
  return values;
}

// The frames of a video, or why the background has not got them.
tl::expected<FrameRange, std::string> frames_of(const VideoGroup& group, const Draws& draws, const FrameRange& there) {
  const double skipped = std::floor(draws.number(group.first_frame, "first_frame"));
  const double first = there.first + skipped;
  const double last = group.frames ? first + *group.frames - 1 : there.last;
  if (first <= last && last <= there.last) return FrameRange{static_cast<int>(first), static_cast<int>(last)};
  return tl::unexpected(std::string(group.frames ? "frames" : "first_frame") + ": the background has " +
                        std::to_string(there.last - there.first + 1) + " frames, too few for " +
                        (group.frames ? std::to_string(*group.frames) + " " : "any ") + "from its frame " +
                        std::to_string(std::llround(skipped)) + " on");
}

std::map<std::string, double> light_of(const VideoGroup& group, const Draws& draws) {
  std::map<std::string, double> values;
  if (group.lights.empty()) return values;
  const LightPlan& light = group.lights[draws.pick(group.lights.size(), "light")];
  for (const auto& [name, quantity] : light.quantities) values[name] = draws.number(quantity, name);
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

Project project_of(const Recipe& recipe, const Cast& cast, const FrameRange& frames,
                   std::vector<WaypointSettings> waypoints, const std::map<std::string, double>& light) {
  const Background& background = recipe.backgrounds[cast.background];
  const Aircraft& aircraft = recipe.aircraft[cast.aircraft];
  Project project = recipe.base;
  project.name = cast.name;
  project.footage = background.footage;
  project.footage.first_frame = frames.first;
  project.footage.last_frame = frames.last;
  project.camera = background.camera;
  project.light = lit_by(background.light, light);
  project.output.categories = categories_of(recipe);
  IntruderSettings& intruder = project.intruders.front();
  intruder.name = aircraft.name;
  intruder.category = aircraft.category;
  intruder.model = aircraft.model;
  intruder.trajectory.waypoints = std::move(waypoints);
  return project;
}

}  // namespace

Cast drawn_cast(const Recipe& recipe, Cast cast, int again) {
  const VideoGroup& group = recipe.groups[cast.group];
  if (!group.is_drawn) return cast;
  const Draws draws(recipe.seed, cast.name, again);
  cast.background = index_of(recipe.backgrounds, group.backgrounds[draws.pick(group.backgrounds.size(), "background")]);
  cast.aircraft = index_of(recipe.aircraft, group.aircraft[draws.pick(group.aircraft.size(), "aircraft")]);
  cast.flight = draws.pick(group.flights.size(), "flight");
  return cast;
}

tl::expected<PlannedVideo, std::string> drawn_video(const Recipe& recipe, const Cast& cast,
                                                    const OpenedBackground& background, int again) {
  const VideoGroup& group = recipe.groups[cast.group];
  const FlightPlan& flight = group.flights[cast.flight];
  const Draws draws(recipe.seed, cast.name, again);
  const tl::expected<FrameRange, std::string> frames = frames_of(group, draws, background.frames);
  if (!frames) return tl::unexpected(frames.error());
  PlannedVideo video{.name = cast.name, .split = group.split, .tags = tags_of(recipe, cast)};
  video.drawn = values_of(flight, draws);
  tl::expected<PlannedFlight, std::string> flown =
      planned_flight(flight.kind, video.drawn,
                     {.camera = recipe.backgrounds[cast.background].camera,
                      .lens = background.lens,
                      .footage = background.footage,
                      .frames = *frames,
                      .speed_limits_mps = recipe.aircraft[cast.aircraft].speed_limits_mps});
  if (!flown) return tl::unexpected(flown.error());
  video.drawn.merge(flown->facts);
  if (group.first_frame.kind != Quantity::Kind::fixed)
    video.drawn["first_frame"] = frames->first - background.frames.first;
  const std::map<std::string, double> light = light_of(group, draws);
  video.drawn.insert(light.begin(), light.end());
  video.project = project_of(recipe, cast, *frames, std::move(flown->waypoints), light);
  return video;
}

}  // namespace sigs
