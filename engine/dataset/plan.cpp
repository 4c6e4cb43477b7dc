// SPDX-License-Identifier: MIT
#include "dataset/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "base/threads.h"
#include "dataset/footage_cache.h"
#include "dataset/sample.h"
#include "dataset/video_sample.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

std::vector<VideoSpec> specs_of(const Recipe& recipe, std::size_t group_index) {
  const VideoGroup& group = recipe.groups[group_index];
  std::vector<VideoSpec> specs;
  if (group.is_sampled) {
    for (int number = 1; number <= group.count; ++number)
      specs.push_back({.group = group_index, .name = name_from(group.name, {.number = number})});
    return specs;
  }
  std::map<std::string, int> numbers;  // the last one of each name without its number
  for (const std::string& background : group.backgrounds)
    for (const std::string& aircraft : group.aircraft)
      for (std::size_t flight = 0; flight < group.flights.size(); ++flight)
        for (int i = 0; i < group.count; ++i) {
          NameParts parts{background, aircraft, group.flights[flight].name, 0};
          parts.number = ++numbers[lower_case(name_from(group.name, parts))];
          specs.push_back({.group = group_index,
                           .name = name_from(group.name, parts),
                           .background = index_of(recipe.backgrounds, background),
                           .aircraft = index_of(recipe.aircraft, aircraft),
                           .flight = flight});
        }
  return specs;
}

Result<std::vector<VideoSpec>> all_specs(const Recipe& recipe) {
  std::vector<VideoSpec> specs;
  std::map<std::string, std::size_t> group_of_name;
  for (std::size_t i = 0; i < recipe.groups.size(); ++i) {
    const std::string key = fmt::format("{}: videos[{}].name", recipe.file.string(), i);
    for (VideoSpec& spec : specs_of(recipe, i)) {
      if (const std::string wrong = wrong_with_video_name(spec.name); !wrong.empty())
        return fail(key, fmt::format("gives \"{}\", which {}", spec.name, wrong));
      const auto [place, is_new] = group_of_name.emplace(lower_case(spec.name), i);
      if (!is_new)
        return fail(key, "gives \"" + spec.name + "\", which videos[" + std::to_string(place->second) +
                             "] gives already; names must differ in more than case, as by {number}");
      specs.push_back(std::move(spec));
    }
  }
  return specs;
}

Result<void> check_projects(const Recipe& recipe, const Plan& plan) {
  for (const PlannedVideo& video : plan.videos)
    for (const Problem& problem : validate(video.rig ? *video.rig : video.project))
      return fail(fmt::format("{}: video {}: {}", recipe.file.string(), video.name, problem.field), problem.what,
                  problem.kind == ErrorKind::cannot_read ? problem.kind : ErrorKind::bad_data);
  return {};
}

Result<void> split_up(const Recipe& recipe, Plan& plan) {
  const std::string key = recipe.file.string() + ": splits.keep_together";
  std::vector<SplitCandidate> candidates;
  for (const PlannedVideo& video : plan.videos) {
    const auto unit = video.tags.find(recipe.keep_together);
    if (unit == video.tags.end() && !recipe.keep_together.empty())
      return fail(key, fmt::format("video {} has no tag \"{}\"", video.name, recipe.keep_together));
    candidates.push_back({video.name, video.split, unit == video.tags.end() ? "" : unit->second});
  }
  const Result<std::vector<std::string>> splits = splits_of(candidates, recipe.splits, recipe.seed);
  if (!splits) return fail(key, splits.error().what);
  for (std::size_t i = 0; i < plan.videos.size(); ++i) plan.videos[i].split = splits->at(i);
  return {};
}

// Why a sample was rejected: the quantity that its reason begins with.
std::string condition_of(const std::string& why) {
  return why.substr(0, std::min(why.find(':'), why.find(" in frame")));
}

// The videos of all cameras of a background's aircraft: what was sampled is of the whole.
std::vector<PlannedVideo> videos_of_cameras(PlannedVideo sampled, const std::vector<RigCamera>& cameras) {
  if (cameras.empty()) return {std::move(sampled)};
  Project rig = sampled.project;
  rig.cameras = cameras;
  rig.cameras.front().footage = std::exchange(rig.footage, {});
  std::vector<PlannedVideo> videos;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    PlannedVideo video = sampled;
    video.project = seen_by(rig, i);
    video.name = video.project.name;
    video.rig = rig;
    video.tags["rig"] = sampled.name;
    video.tags["camera"] = cameras[i].name;
    videos.push_back(std::move(video));
  }
  return videos;
}

// What is measured in the footage of a matched background: all that its videos share.
ClipToMeasure clip_of(const Recipe& recipe, std::size_t index) {
  const Background& background = recipe.backgrounds[index];
  ClipToMeasure clip{.project = recipe.base,
                     .height_is_guess = background.height_is_guess,
                     .where = fmt::format("{}: backgrounds[{}].appearance", recipe.file.string(), index)};
  clip.project.footage = background.footage;
  clip.project.camera = background.camera;
  clip.project.light = background.light;
  clip.project.appearance = background.appearance;
  clip.project.intruders.clear();
  clip.project.output = {};
  return clip;
}

// The clips of matched backgrounds, and which of them each video has.
void add_clips(const Recipe& recipe, Plan& plan) {
  std::map<std::size_t, std::size_t> clip_of_background;
  for (PlannedVideo& video : plan.videos) {
    const std::size_t background = index_of(recipe.backgrounds, video.tags.at("background"));
    if (!recipe.backgrounds[background].is_matched) continue;
    const auto [place, is_new] = clip_of_background.emplace(background, plan.clips.size());
    if (is_new) plan.clips.push_back(clip_of(recipe, background));
    video.clip = place->second;
  }
}

// Samples the recipe's videos one by one.
class Planner {
 public:
  Planner(const Recipe& recipe, const std::vector<Result<OpenedBackground>>& backgrounds)
      : recipe_(recipe), backgrounds_(backgrounds) {
    for (std::size_t i = 0; i < backgrounds.size(); ++i)
      if (backgrounds[i]) estimator_.remember(recipe.backgrounds[i].footage, backgrounds[i]->footage);
  }

  void add(const VideoSpec& spec, Plan& plan);

  // Decodes the frames of images, to know what aircraft in them are before.
  [[nodiscard]] Result<void> look_for_sky(const std::vector<VideoSpec>& specs, const std::atomic<bool>* cancel);

 private:
  // A sample, or why it is impossible; where a video may be sampled again it must be visible, too.
  [[nodiscard]] Possible<PlannedVideo> one_sample(const VideoSpec& spec, const OpenedBackground& background, int again);

  const Recipe& recipe_;
  const std::vector<Result<OpenedBackground>>& backgrounds_;
  VideoVisibility estimator_;
};

Result<void> Planner::look_for_sky(const std::vector<VideoSpec>& specs, const std::atomic<bool>* cancel) {
  std::map<std::size_t, std::set<int>> frames;  // by background
  for (const VideoSpec& spec : specs) {
    if (!recipe_.groups[spec.group].is_images) continue;
    const VideoSpec sampled = sampled_spec(recipe_, spec, 0);
    const Result<OpenedBackground>& background = backgrounds_.at(sampled.background);
    if (!background) continue;
    if (const auto frame = frame_of_image(recipe_, sampled, background->frames))
      frames[sampled.background].insert(*frame);
  }
  for (const auto& [background, numbers] : frames)
    if (const Result<void> step = estimator_.look_for_sky(recipe_.backgrounds[background].footage, numbers, cancel);
        !step)
      return step;
  return {};
}

Possible<PlannedVideo> Planner::one_sample(const VideoSpec& spec, const OpenedBackground& background, int again) {
  Possible<PlannedVideo> video = sampled_video(recipe_, spec, background, again, estimator_);
  if (!video || !recipe_.groups[spec.group].resamples) return video;
  const auto is_never_visible = [&](const PlannedVideo& of_camera) {
    const std::optional<Visibility> view = estimator_.visibility_of(of_camera.project, kVisibilityFrames);
    return view && view->visible == 0;
  };
  if (std::ranges::all_of(videos_of_cameras(*video, recipe_.backgrounds[spec.background].cameras), is_never_visible))
    return tl::unexpected(std::string("never in the picture: the intruder is beside it or behind the own body"));
  return video;
}

void Planner::add(const VideoSpec& spec, Plan& plan) {
  const std::optional<int>& resamples = recipe_.groups[spec.group].resamples;
  std::map<std::string, int> failed;
  std::string why;
  for (int again = 0; again <= resamples.value_or(0); ++again) {
    const VideoSpec sampled = sampled_spec(recipe_, spec, again);
    const Result<OpenedBackground>& background = backgrounds_.at(sampled.background);
    if (!background) {
      plan.unopened.push_back({spec.name, background.error()});
      return;
    }
    Possible<PlannedVideo> video = one_sample(sampled, *background, again);
    if (video) {
      video->resamples = std::move(failed);
      plan.videos.push_back(*std::move(video));
      return;
    }
    why = video.error();
    ++failed[condition_of(why)];
  }
  if (resamples)
    why = fmt::format(
        "none of {} samples can be used: {}; change what is sampled from, or raise videos[{}].redraws; the last one: "
        "{}",
        *resamples + 1, resamples_text(failed), spec.group, why);
  plan.impossible.push_back({spec.name, why});
}

struct Unit {
  std::string name;
  std::vector<std::size_t> members;
  std::string split;  // fixed, or not yet known
  std::uint64_t rank = 0;
};

// Two kinds of names, which must differ.
std::string unit_name(const SplitCandidate& candidate) {
  return candidate.unit.empty() ? "video " + candidate.video : "unit " + candidate.unit;
}

Result<std::vector<Unit>> units_of(std::span<const SplitCandidate> candidates, std::uint64_t seed) {
  std::map<std::string, Unit> units;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const SplitCandidate& candidate = candidates[i];
    const std::string name = unit_name(candidate);
    Unit& unit = units[name];
    unit.name = name;
    unit.members.push_back(i);
    unit.rank = random_bits({seed, name, "split"});
    if (candidate.fixed.empty() || candidate.fixed == unit.split) continue;
    if (!unit.split.empty())
      return fail("", fmt::format("\"{}\" is in {} and in {}, but keep_together keeps it in one split", candidate.unit,
                                  unit.split, candidate.fixed));
    unit.split = candidate.fixed;
  }
  std::vector<Unit> list;
  for (auto& [name, unit] : units) list.push_back(std::move(unit));
  return list;
}

bool goes_first(const Unit& a, const Unit& b) {
  if (a.members.size() != b.members.size()) return a.members.size() > b.members.size();
  return a.rank != b.rank ? a.rank < b.rank : a.name < b.name;
}

void share_out(std::vector<Unit*>& units, std::span<const SplitShare> shares) {
  std::sort(units.begin(), units.end(), [](const Unit* a, const Unit* b) { return goes_first(*a, *b); });
  double videos = 0;
  for (const Unit* const unit : units) videos += static_cast<double>(unit->members.size());
  std::vector<double> lacking;
  for (const SplitShare& share : shares) lacking.push_back(share.share * videos);
  for (Unit* const unit : units) {
    const auto neediest = std::max_element(lacking.begin(), lacking.end());
    *neediest -= static_cast<double>(unit->members.size());
    unit->split = shares[static_cast<std::size_t>(neediest - lacking.begin())].name;
  }
}

// A rotor that the model of its aircraft cannot have is a mistake of the recipe, whatever video is made of it.
Result<void> check_rotors(const Recipe& recipe) {
  SceneFiles files;
  Project project = recipe.base;
  project.intruders.resize(1);
  for (std::size_t i = 0; i < recipe.aircraft.size(); ++i) {
    project.intruders[0].model = recipe.aircraft[i].model;
    if (recipe.aircraft[i].model.rotors.empty()) continue;
    const auto model = scene_model(project, 0, files);
    const std::size_t rotor = model ? std::string::npos : model.error().field.find("model.rotors[");
    if (rotor != std::string::npos)
      return fail(fmt::format("{}: aircraft[{}].{}", recipe.file.string(), i, model.error().field.substr(rotor)),
                  model.error().what);
  }
  return {};
}

}  // namespace

Result<Plan> plan_of(const Recipe& recipe, const std::atomic<bool>* cancel) {
  if (const Result<void> rotors = check_rotors(recipe); !rotors) return fail(rotors.error());
  const Result<std::vector<VideoSpec>> specs = all_specs(recipe);
  if (!specs) return fail(specs.error());
  const Result<std::vector<Result<OpenedBackground>>> backgrounds = opened_backgrounds(recipe);
  if (!backgrounds) return fail(backgrounds.error());
  Plan plan{.name = recipe.name};
  Planner planner(recipe, *backgrounds);
  if (const Result<void> looked = planner.look_for_sky(*specs, cancel); !looked) return fail(looked.error());
  for (const VideoSpec& spec : *specs) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    planner.add(spec, plan);
  }
  if (const Result<void> step = split_up(recipe, plan); !step) return fail(step.error());
  std::vector<PlannedVideo> videos;  // after the splits, so that all cameras of an aircraft are in the same
  for (PlannedVideo& video : plan.videos) {
    const auto& cameras = recipe.backgrounds[index_of(recipe.backgrounds, video.tags.at("background"))].cameras;
    for (PlannedVideo& of_camera : videos_of_cameras(std::move(video), cameras)) videos.push_back(std::move(of_camera));
  }
  plan.videos = std::move(videos);
  add_clips(recipe, plan);
  if (const Result<void> step = check_projects(recipe, plan); !step) return fail(step.error());
  return plan;
}

std::map<std::string, int> resamples_of(const std::vector<const PlannedVideo*>& videos) {
  std::map<std::string, int> resamples;
  for (const PlannedVideo* const video : videos)
    for (const auto& [condition, count] : video->resamples) resamples[condition] += count;
  return resamples;
}

std::string resamples_text(const std::map<std::string, int>& resamples) {
  std::vector<std::pair<std::string, int>> list(resamples.begin(), resamples.end());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [condition, count] : list) {
    if (!text.empty()) text += "; ";
    text += condition;
    text += count == 1 ? " once" : " ";
    if (count > 1) text += fmt::format("{} times", count);
  }
  return text;
}

Result<std::vector<std::string>> splits_of(std::span<const SplitCandidate> candidates,
                                           std::span<const SplitShare> shares, std::uint64_t seed) {
  Result<std::vector<Unit>> units = units_of(candidates, seed);
  if (!units) return fail(units.error());
  std::vector<Unit*> open;
  for (Unit& unit : *units)
    if (unit.split.empty()) open.push_back(&unit);
  if (!shares.empty()) share_out(open, shares);
  std::vector<std::string> splits(candidates.size());
  for (const Unit& unit : *units)
    for (const std::size_t member : unit.members) splits[member] = unit.split;
  return splits;
}

}  // namespace sigs
