// SPDX-License-Identifier: MIT
#include "dataset/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dataset/flight_plan.h"
#include "dataset/footage_book.h"
#include "dataset/splits.h"
#include "dataset/video_name.h"
#include "project/validate.h"

namespace sigs {

namespace {

// One combination of a group: numbers in the recipe's lists.
struct Cast {
  std::size_t group = 0;
  std::size_t background = 0;
  std::size_t aircraft = 0;
  std::size_t flight = 0;
  std::string name;
};

template <class Named>
std::size_t index_of(const std::vector<Named>& all, const std::string& name) {
  const auto place = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return static_cast<std::size_t>(place - all.begin());
}

std::vector<Cast> casts_of(const Recipe& recipe, std::size_t group_index) {
  const VideoGroup& group = recipe.groups[group_index];
  std::vector<Cast> casts;
  for (const std::string& background : group.backgrounds)
    for (const std::string& aircraft : group.aircraft)
      for (std::size_t flight = 0; flight < group.flights.size(); ++flight)
        for (int number = 1; number <= group.count; ++number)
          casts.push_back({group_index, index_of(recipe.backgrounds, background), index_of(recipe.aircraft, aircraft),
                           flight, name_from(group.name, {background, aircraft, group.flights[flight].name, number})});
  return casts;
}

Result<std::vector<Cast>> all_casts(const Recipe& recipe) {
  std::vector<Cast> casts;
  std::map<std::string, std::size_t> group_of_name;
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    const std::string key = recipe.file.string() + ": videos[" + std::to_string(i) + "].name";
    for (Cast& cast : casts_of(recipe, i)) {
      if (const std::string wrong = wrong_with_video_name(cast.name); !wrong.empty())
        return fail(key, "gives \"" + cast.name + "\", which " + wrong);
      const auto [place, is_new] = group_of_name.emplace(folded(cast.name), i);
      if (!is_new)
        return fail(key, "gives \"" + cast.name + "\", which videos[" + std::to_string(place->second) +
                             "] gives already; names must differ in more than case, as by {number}");
      casts.push_back(std::move(cast));
    }
  }
  return casts;
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

std::map<std::string, double> values_of(const FlightPlan& flight, std::uint64_t seed, const std::string& video) {
  std::map<std::string, double> values;
  for (const FlightQuantity& quantity : quantities_of(flight.kind)) {
    const std::string name(quantity.name);
    if (const auto given = flight.quantities.find(name); given != flight.quantities.end())
      values[name] = drawn(given->second, {seed, video, name});
    else if (quantity.standard)
      values[name] = *quantity.standard;
  }
  return values;
}

// The frames of a video, or why the background has not got them.
tl::expected<FrameRange, std::string> frames_of(const VideoGroup& group, const std::string& video, std::uint64_t seed,
                                                const FrameRange& there) {
  const double skipped = std::floor(drawn(group.first_frame, {seed, video, "first_frame"}));
  const double first = there.first + skipped;
  const double last = group.frames ? first + *group.frames - 1 : there.last;
  if (first <= last && last <= there.last) return FrameRange{static_cast<int>(first), static_cast<int>(last)};
  return tl::unexpected(std::string(group.frames ? "frames" : "first_frame") + ": the background has " +
                        std::to_string(there.last - there.first + 1) + " frames, too few for " +
                        (group.frames ? std::to_string(*group.frames) + " " : "any ") + "from its frame " +
                        std::to_string(std::llround(skipped)) + " on");
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
                   std::vector<WaypointSettings> waypoints) {
  const Background& background = recipe.backgrounds[cast.background];
  const Aircraft& aircraft = recipe.aircraft[cast.aircraft];
  Project project = recipe.base;
  project.name = cast.name;
  project.footage = background.footage;
  project.footage.first_frame = frames.first;
  project.footage.last_frame = frames.last;
  project.camera = background.camera;
  project.light = background.light;
  project.output.categories = categories_of(recipe);
  IntruderSettings& intruder = project.intruders.front();
  intruder.name = aircraft.name;
  intruder.category = aircraft.category;
  intruder.model = aircraft.model;
  intruder.trajectory.waypoints = std::move(waypoints);
  return project;
}

tl::expected<PlannedVideo, std::string> planned(const Recipe& recipe, const Cast& cast,
                                                const OpenedBackground& background) {
  const VideoGroup& group = recipe.groups[cast.group];
  const FlightPlan& flight = group.flights[cast.flight];
  const tl::expected<FrameRange, std::string> frames = frames_of(group, cast.name, recipe.seed, background.frames);
  if (!frames) return tl::unexpected(frames.error());
  PlannedVideo video{.name = cast.name, .split = group.split, .tags = tags_of(recipe, cast)};
  video.drawn = values_of(flight, recipe.seed, cast.name);
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
  video.project = project_of(recipe, cast, *frames, std::move(flown->waypoints));
  return video;
}

Result<void> check_projects(const Recipe& recipe, const Plan& plan) {
  for (const PlannedVideo& video : plan.videos)
    for (const Problem& problem : validate(video.project))
      return fail(recipe.file.string() + ": video " + video.name + ": " + problem.field, problem.what,
                  problem.kind == ErrorKind::cannot_read ? problem.kind : ErrorKind::bad_data);
  return {};
}

Result<void> split_up(const Recipe& recipe, Plan& plan) {
  const std::string key = recipe.file.string() + ": splits.keep_together";
  std::vector<SplitCandidate> candidates;
  for (const PlannedVideo& video : plan.videos) {
    const auto unit = video.tags.find(recipe.keep_together);
    if (unit == video.tags.end() && !recipe.keep_together.empty())
      return fail(key, "video " + video.name + " has no tag \"" + recipe.keep_together + "\"");
    candidates.push_back({video.name, video.split, unit == video.tags.end() ? "" : unit->second});
  }
  const Result<std::vector<std::string>> splits = splits_of(candidates, recipe.splits, recipe.seed);
  if (!splits) return fail(key, splits.error().what);
  for (std::size_t i = 0; i < plan.videos.size(); ++i) plan.videos[i].split = splits->at(i);
  return {};
}

}  // namespace

Result<Plan> plan_of(const Recipe& recipe) {
  const Result<std::vector<Cast>> casts = all_casts(recipe);
  if (!casts) return fail(casts.error());
  const Result<std::vector<Result<OpenedBackground>>> backgrounds = opened_backgrounds(recipe);
  if (!backgrounds) return fail(backgrounds.error());
  Plan plan{.name = recipe.name};
  for (const Cast& cast : *casts) {
    const Result<OpenedBackground>& background = backgrounds->at(cast.background);
    if (!background) {
      plan.unopened.push_back({cast.name, background.error()});
      continue;
    }
    tl::expected<PlannedVideo, std::string> video = planned(recipe, cast, *background);
    if (video)
      plan.videos.push_back(*std::move(video));
    else
      plan.impossible.push_back({cast.name, video.error()});
  }
  Result<void> step = check_projects(recipe, plan);
  if (step) step = split_up(recipe, plan);
  if (!step) return fail(step.error());
  return plan;
}

}  // namespace sigs
