// SPDX-License-Identifier: MIT
#include "dataset/domain_fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/threads.h"
#include "dataset/video_sample.h"
#include "project/project.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr int kFillRounds = 4;
constexpr std::size_t kFlightsOfRound = 1200;  // planned in one round, over all targets
constexpr std::size_t kFlightsOfTarget = 12;   // at most
constexpr int kFillFrames = 25;
constexpr std::size_t kListedUnreached = 20;

// --- What further videos can be made of.

// A background and an aircraft, with the light, appearance, camera, footage and tags of one of the recipe's groups.
struct FillSource {
  const Json* group = nullptr;  // null: none
  std::size_t background = 0, aircraft = 0;
  std::map<std::string, std::string> words;
};

std::vector<FillSource> sources_of(const Recipe& recipe, const Json& json) {
  std::vector<const Json*> groups{nullptr};
  if (json.contains("videos") && json["videos"].is_array())
    for (const Json& group : json["videos"]) groups.push_back(&group);
  std::vector<FillSource> sources;
  for (const Json* const group : groups)
    for (std::size_t b = 0; b < recipe.backgrounds.size(); ++b)
      for (std::size_t a = 0; a < recipe.aircraft.size(); ++a) {
        const Background& background = recipe.backgrounds[b];
        const Aircraft& aircraft = recipe.aircraft[a];
        if (aircraft.is_distractor) continue;
        FillSource source{.group = group, .background = b, .aircraft = a, .words = {}};
        source.words = {
            {"background", background.name}, {"aircraft", aircraft.name}, {kKindCondition, aircraft.category}};
        if (group != nullptr && group->contains("tags"))
          for (const auto& [tag, value] : group->at("tags").items())
            source.words.emplace(tag, value.get<std::string>());
        for (const auto* const tags : {&aircraft.tags, &background.tags})
          source.words.insert(tags->begin(), tags->end());
        if (recipe.keep_together.empty() || recipe.keep_together == "flight" ||
            source.words.contains(recipe.keep_together))
          sources.push_back(std::move(source));
      }
  return sources;
}

// Whether images are all that the recipe makes: then its further videos are images too, since the defaults of their
// settings differ.
bool makes_images(const Recipe& recipe) {
  return std::ranges::all_of(recipe.groups, &VideoGroup::is_images);
}

// The recipe's groups as a list.
Json groups_in(const Json& recipe) {
  for (const char* const key : {"videos", "images"})
    if (recipe.contains(key) && recipe[key].is_number()) return Json::array({Json{{key, recipe[key]}}});
  return recipe.contains("videos") ? recipe["videos"] : Json::array();
}

// "fill", or the first of "fill2", "fill3", ... with which no video's name begins.
std::string free_prefix(const Recipe& recipe) {
  for (int number = 1;; ++number) {
    const std::string prefix = number == 1 ? "fill-" : fmt::format("fill{}-", number);
    if (std::ranges::none_of(recipe.groups, [&](const VideoGroup& group) { return group.name.starts_with(prefix); }))
      return prefix;
  }
}

// --- What of the coverage is still empty.

std::vector<DomainTarget> empty_targets(const DomainCoverage& coverage) {
  std::vector<DomainTarget> targets = coverage.empty_bins();
  const std::vector<DomainTarget> pairs = coverage.empty_pairs();
  targets.insert(targets.end(), pairs.begin(), pairs.end());
  return targets;
}

// All that the encounters cover, in the domain or not.
std::vector<DomainTarget> covered_targets(const DesignDomain& domain, const std::vector<DomainEncounter>& encounters) {
  DomainCoverage alone(domain);
  for (const DomainEncounter& encounter : encounters) alone.add(encounter);
  std::vector<DomainTarget> covered;
  for (std::size_t i = 0; i < alone.conditions.size(); ++i)
    for (std::size_t bin = 0; bin < alone.conditions[i].bins.size(); ++bin)
      if (alone.conditions[i].bins[bin].frames > 0) covered.push_back({i, bin});
  alone.for_each_pair([&](const DomainTarget& target, const DomainCount& count) {
    if (count.frames > 0) covered.push_back(target);
  });
  return covered;
}

struct PlannedFill {
  Json group;
  std::vector<DomainEncounter> encounters;
  std::vector<DomainTarget> covered;
};

// Adds videos to a recipe, round by round.
class DomainFiller {
 public:
  DomainFiller(const Recipe& recipe, DomainCoverage coverage, const std::vector<std::string>& settings,
               const std::atomic<bool>* cancel)
      : recipe_(recipe),
        coverage_(std::move(coverage)),
        settings_(settings),
        cancel_(cancel),
        json_(Json::parse(recipe.text, nullptr, false, true)),
        sources_(sources_of(recipe, json_)),
        is_images_(makes_images(recipe)),
        prefix_(free_prefix(recipe)),
        random_(random_bits({recipe.seed, recipe.name, "domain"})) {}

  [[nodiscard]] Result<DomainFill> fill(const fs::path& file);

 private:
  struct Wish {
    DomainWish wish;
    std::vector<const FillSource*> sources;  // that have the words
  };
  [[nodiscard]] Wish wish_for(const DomainTarget& target) const;
  void constrain(std::size_t condition, std::size_t bin, Wish& wish) const;
  [[nodiscard]] std::optional<Json> group_for(const Wish& wish);
  [[nodiscard]] Json groups_for(const std::vector<DomainTarget>& targets);
  [[nodiscard]] Result<std::vector<PlannedFill>> planned(const Json& groups) const;
  void keep_best(std::vector<PlannedFill> fills);
  [[nodiscard]] std::vector<std::string> unfilled() const;
  [[nodiscard]] std::string why_unfilled(const DomainTarget& target) const;

  const Recipe& recipe_;
  DomainCoverage coverage_;
  const std::vector<std::string>& settings_;
  const std::atomic<bool>* cancel_;
  Json json_;
  std::vector<FillSource> sources_;
  bool is_images_;
  std::string prefix_;
  Random random_;
  std::vector<Result<OpenedBackground>> opened_ = {};
  int number_ = 0;
  Json kept_ = Json::array();
};

// Attitudes of the camera are the footage's and cannot be wished for.
bool can_be_wished(DomainNumber number) {
  return number != DomainNumber::camera_roll_deg && number != DomainNumber::camera_pitch_deg &&
         number != DomainNumber::camera_yaw_deg;
}

void DomainFiller::constrain(std::size_t condition_index, std::size_t bin, Wish& wish) const {
  const DomainCondition& condition = coverage_.domain.conditions[condition_index];
  if (const std::optional<DomainNumber> number = domain_number_named(condition.name)) {
    if (can_be_wished(*number)) wish.wish.numbers[*number] = condition.span_of_bin(bin);
    return;
  }
  if (condition.name == kHorizonCondition) {
    wish.wish.horizon = horizon_side_named(condition.values[bin]);
    return;
  }
  std::erase_if(wish.sources, [&](const FillSource* source) {
    const auto word = source->words.find(condition.name);
    return word == source->words.end() || word->second != condition.values[bin];
  });
}

DomainFiller::Wish DomainFiller::wish_for(const DomainTarget& target) const {
  Wish wish;
  for (const FillSource& source : sources_)
    if (opened_.empty() || opened_[source.background]) wish.sources.push_back(&source);
  constrain(target.condition, target.bin, wish);
  if (target.other) constrain(target.other->first, target.other->second, wish);
  return wish;
}

std::optional<Json> DomainFiller::group_for(const Wish& wish) {
  const FillSource& source = *wish.sources[random_.bits() % wish.sources.size()];
  const Background& background = recipe_.backgrounds[source.background];
  const Aircraft& aircraft = recipe_.aircraft[source.aircraft];
  const OpenedBackground& opened = *opened_[source.background];
  const std::optional<Json> flight = wished_flight(wish.wish, background, opened.lens, aircraft, random_);
  if (!flight) return std::nullopt;
  const int available = opened.frames.last - opened.frames.first + 1;
  const int frames = is_images_ ? 1 : std::min(kFillFrames, available);
  const auto later = static_cast<std::uint64_t>(available - frames + 1);
  Json group{{"name", fmt::format("{}{:04}", prefix_, ++number_)}};
  if (is_images_) group["images"] = 1;
  group["backgrounds"] = {background.name};
  group["aircraft"] = {aircraft.name};
  if (is_images_) group["redraws"] = 0;
  if (!is_images_) group["frames"] = frames;
  group["first_frame"] = random_.bits() % later;
  group["flights"] = Json::array({*flight});
  for (const char* const key : {"light", "appearance", "camera", "footage", "tags"})
    if (source.group != nullptr && source.group->contains(key)) group[key] = source.group->at(key);
  return group;
}

Json DomainFiller::groups_for(const std::vector<DomainTarget>& targets) {
  const std::size_t each =
      std::clamp(kFlightsOfRound / std::max<std::size_t>(1, targets.size()), std::size_t{1}, kFlightsOfTarget);
  Json groups = Json::array();
  for (const DomainTarget& target : targets) {
    const Wish wish = wish_for(target);
    for (std::size_t i = 0; i < each && !wish.sources.empty(); ++i)
      if (std::optional<Json> group = group_for(wish)) groups.push_back(*std::move(group));
  }
  return groups;
}

Result<std::vector<PlannedFill>> DomainFiller::planned(const Json& groups) const {
  Json json = json_;
  json.erase("splits");
  json.erase("images");
  json["videos"] = groups;
  const Result<ReadRecipe> read = parse_recipe(json.dump(), recipe_.file, settings_);
  if (!read) return fail(read.error());
  const Result<Plan> plan = plan_of(read->recipe, cancel_);
  if (!plan) return fail(plan.error());
  std::map<std::string, const Json*> group_of_name;
  for (const Json& group : groups) group_of_name[group.at("name")] = &group;
  VideoVisibility opener;
  std::vector<PlannedFill> fills;
  for (const PlannedVideo& video : plan->videos) {
    if (const Result<void> on = check_interrupt(cancel_); !on) return fail(on.error());
    std::optional<PlannedEncounters> encounters = encounters_of(video, opener);
    if (encounters && !encounters->encounters.empty())
      fills.push_back({.group = *group_of_name.at(video.name),
                       .encounters = encounters->encounters,
                       .covered = covered_targets(coverage_.domain, encounters->encounters)});
  }
  return fills;
}

// Keeps the video that covers most of what is empty, then the one that covers most of the rest, and so on.
void DomainFiller::keep_best(std::vector<PlannedFill> fills) {
  while (!fills.empty()) {
    const std::vector<DomainTarget> targets = empty_targets(coverage_);
    const std::set<DomainTarget> empty(targets.begin(), targets.end());
    std::ptrdiff_t most = 0;
    auto best = fills.end();
    for (auto fill = fills.begin(); fill != fills.end(); ++fill) {
      const std::ptrdiff_t covers =
          std::ranges::count_if(fill->covered, [&](const DomainTarget& target) { return empty.contains(target); });
      if (covers > most) best = fill;
      most = std::max(most, covers);
    }
    if (best == fills.end()) return;
    for (const DomainEncounter& encounter : best->encounters) coverage_.add(encounter);
    kept_.push_back(std::move(best->group));
    fills.erase(best);
  }
}

// Why no video can show it; empty: flights were tried and none did.
std::string DomainFiller::why_unfilled(const DomainTarget& target) const {
  std::vector<std::size_t> conditions{target.condition};
  if (target.other) conditions.push_back(target.other->first);
  for (const std::size_t i : conditions) {
    const std::string& name = coverage_.domain.conditions[i].name;
    const std::optional<DomainNumber> number = domain_number_named(name);
    if (number && !can_be_wished(*number))
      return "the camera's attitude is the footage's; add a background that has it";
    if (number == DomainNumber::closing_speed_mps && is_images_) return "an image tells no closing speed";
    if (name == "flight") return "flights that fill bins have a name of their own; add the flight to the recipe";
    if (name == kHorizonCondition && std::ranges::none_of(recipe_.backgrounds, [](const Background& background) {
          return knows_horizon(background.camera) || !background.camera.track.file.empty();
        }))
      return "no background states the camera's roll or pitch";
  }
  if (!wish_for(target).sources.empty()) return "";
  const std::string what = target.other ? "those words together" : "it";
  const std::string& name = coverage_.domain.conditions[target.condition].name;
  return !target.other && name == kKindCondition ? "no aircraft of the recipe, distractors aside, is of this category"
                                                 : "no background, aircraft or group of videos has " + what;
}

std::vector<std::string> DomainFiller::unfilled() const {
  std::vector<std::string> lines;
  std::set<std::pair<std::size_t, std::size_t>> bins;  // that cannot be filled; their pairs need no line
  for (const DomainTarget& target : coverage_.empty_bins()) {
    const std::string why = why_unfilled(target);
    bins.emplace(target.condition, target.bin);
    lines.push_back(fmt::format("{}: {}", coverage_.text_of(target),
                                why.empty() ? "no flight was found that shows it to these cameras" : why));
  }
  std::vector<std::string> pairs;
  for (const DomainTarget& target : coverage_.empty_pairs()) {
    if (bins.contains({target.condition, target.bin}) || bins.contains(*target.other)) continue;
    const std::string why = why_unfilled(target);
    pairs.push_back(fmt::format("{}: {}", coverage_.text_of(target),
                                why.empty() ? "no flight was found that has both at once" : why));
  }
  const std::size_t listed_pairs = std::min(pairs.size(), kListedUnreached);
  lines.insert(lines.end(), pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(listed_pairs));
  if (pairs.size() > listed_pairs)
    lines.push_back(fmt::format("and {} more pairs of bins", pairs.size() - listed_pairs));
  return lines;
}

Result<DomainFill> DomainFiller::fill(const fs::path& file) {
  Result<std::vector<Result<OpenedBackground>>> opened = opened_backgrounds(recipe_);
  if (!opened) return fail(opened.error());
  opened_ = *std::move(opened);
  for (int round = 0; round < kFillRounds; ++round) {
    std::vector<DomainTarget> targets = empty_targets(coverage_);
    std::erase_if(targets, [&](const DomainTarget& target) { return !why_unfilled(target).empty(); });
    if (targets.empty()) break;
    const Json groups = groups_for(targets);
    if (groups.empty()) break;
    Result<std::vector<PlannedFill>> fills = planned(groups);
    if (!fills) return fail(fills.error());
    keep_best(*std::move(fills));
  }
  Json groups = groups_in(json_);
  for (const Json& group : kept_) groups.push_back(group);
  json_.erase("images");
  json_["videos"] = std::move(groups);
  move_recipe_paths(json_, recipe_.file, file);
  return DomainFill{.recipe = json_text(json_), .videos = static_cast<int>(kept_.size()), .unfilled = unfilled()};
}

}  // namespace

Result<DomainFill> filled_recipe(const Recipe& recipe, DomainCoverage coverage,
                                 const std::vector<std::string>& settings, const fs::path& file,
                                 const std::atomic<bool>* cancel) {
  return DomainFiller(recipe, std::move(coverage), settings, cancel).fill(file);
}

}  // namespace sigs
