// SPDX-License-Identifier: MIT
#include "dataset/domain_coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "base/pose.h"
#include "base/text.h"
#include "base/threads.h"
#include "dataset/index.h"
#include "scene/scene_at.h"
#include "scene/visibility.h"
#include "truth/measure.h"

namespace sigs {

namespace {

constexpr double kUntold = std::numeric_limits<double>::quiet_NaN();

double& number_of(DomainSight& sight, DomainNumber number) {
  return sight.numbers.at(static_cast<std::size_t>(number));
}

// Where a value falls.
enum class Fit { bin, outside, untold };
struct Placed {
  Fit fit = Fit::untold;
  std::size_t bin = 0;
};

Placed placed_value(const std::optional<std::size_t>& bin) {
  return bin ? Placed{Fit::bin, *bin} : Placed{Fit::outside, 0};
}

Placed placed_value(const DomainCondition& condition, const DomainEncounter& encounter, const DomainSight& sight) {
  if (const std::optional<DomainNumber> number = domain_number_named(condition.name)) {
    const double value = sight.numbers.at(static_cast<std::size_t>(*number));
    return std::isfinite(value) ? placed_value(condition.bin_of(value)) : Placed{};
  }
  if (condition.name == kHorizonCondition)
    return sight.horizon == HorizonSide::unknown ? Placed{} : placed_value(condition.bin_of(name_of(sight.horizon)));
  const auto word = encounter.words.find(condition.name);
  return word == encounter.words.end() ? Placed{} : placed_value(condition.bin_of(word->second));
}

// Whether a zone allows what is told of a sight.
bool allows(const DomainZone& zone, const DomainSight& sight) {
  return std::ranges::all_of(zone.limits, [&](const auto& limit) {
    const double value = sight.numbers.at(static_cast<std::size_t>(*domain_number_named(limit.first)));
    return !std::isfinite(value) || (value >= limit.second.low && value <= limit.second.high);
  });
}

// Counts frames, and an encounter once.
class EncounterTally {
 public:
  void count(DomainCount& count) {
    ++count.frames;
    if (counted_.insert(&count).second) ++count.encounters;
  }

 private:
  std::set<const DomainCount*> counted_;
};

// --- What a plan tells.

void set_place(DomainSight& sight, const glm::dvec3& in_camera_m) {
  number_of(sight, DomainNumber::bearing_deg) = deg_of_rad(std::atan2(in_camera_m.y, in_camera_m.x));
  number_of(sight, DomainNumber::elevation_deg) =
      deg_of_rad(std::atan2(-in_camera_m.z, std::hypot(in_camera_m.x, in_camera_m.y)));
}

void set_camera(DomainSight& sight, const Attitude& camera) {
  number_of(sight, DomainNumber::camera_roll_deg) = deg_of_rad(camera.roll_rad);
  number_of(sight, DomainNumber::camera_pitch_deg) = deg_of_rad(camera.pitch_rad);
  number_of(sight, DomainNumber::camera_yaw_deg) = deg_of_rad(camera.yaw_rad);
}

DomainSight untold_sight() {
  DomainSight sight;
  sight.numbers.fill(kUntold);
  return sight;
}

// Speeds at which the distances fall, from the neighbouring frames: central differences, at both ends one-sided ones. A
// single frame tells none.
std::vector<double> closing_speeds(const std::vector<double>& times_s, const std::vector<double>& ranges_m) {
  std::vector<double> speeds(ranges_m.size(), kUntold);
  for (std::size_t i = 0; i < ranges_m.size() && ranges_m.size() > 1; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, ranges_m.size() - 1);
    const double passed_s = times_s[after] - times_s[before];
    if (passed_s > 0) speeds[i] = (ranges_m[before] - ranges_m[after]) / passed_s;
  }
  return speeds;
}

// Whether an estimate counts as in view.
bool is_seen(const VisibilityEstimate& estimate) {
  return estimate.visibility_state == VisibilityState::in_view ||
         estimate.visibility_state == VisibilityState::partly_occluded;
}

DomainSight planned_sight(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& body,
                          const VisibilityEstimate& estimate) {
  DomainSight sight = untold_sight();
  const glm::dvec3& place_m = body.camera_from_body.translation_m;
  number_of(sight, DomainNumber::range_m) = estimate.distance_m;
  number_of(sight, DomainNumber::size_px) = estimate.size_px;
  const glm::dvec3 nose = body.camera_from_body.rotation * glm::dvec3(1, 0, 0);
  number_of(sight, DomainNumber::aspect_deg) = deg_of_rad(angle_between(nose, -place_m));
  set_place(sight, place_m);
  if (!scene.horizon_is_known) return sight;
  set_camera(sight, attitude_of(moment.world_from_camera.rotation));
  const Model& model = *scene.intruders[static_cast<std::size_t>(body.id)].model;
  sight.horizon = horizon_side_of(model.outermost_m, body.camera_from_body, moment.up_in_camera);
  return sight;
}

// --- What annotations tell.

Attitude attitude_in(pugi::xml_node node) {
  return {.roll_rad = rad_of_deg(attribute_of(node, "roll_deg")),
          .pitch_rad = rad_of_deg(attribute_of(node, "pitch_deg")),
          .yaw_rad = rad_of_deg(attribute_of(node, "yaw_deg"))};
}

DomainSight sight_in(pugi::xml_node camera, pugi::xml_node intruder) {
  DomainSight sight = untold_sight();
  const pugi::xml_node position = intruder.child("position"), silhouette = intruder.child("silhouette");
  const glm::dvec3 place_m(attribute_of(position, "x_m"), attribute_of(position, "y_m"), attribute_of(position, "z_m"));
  number_of(sight, DomainNumber::range_m) = attribute_of(intruder.child("distance"), "m");
  number_of(sight, DomainNumber::size_px) =
      std::max(attribute_of(silhouette, "width"), attribute_of(silhouette, "height"));
  set_place(sight, place_m);
  const Attitude of_camera = attitude_in(camera);
  const glm::dquat camera_from_world = glm::conjugate(rotation_of(of_camera));
  const glm::dvec3 nose =
      camera_from_world * (rotation_of(attitude_in(intruder.child("attitude"))) * glm::dvec3(1, 0, 0));
  number_of(sight, DomainNumber::aspect_deg) = deg_of_rad(angle_between(nose, -place_m));
  number_of(sight, DomainNumber::closing_speed_mps) = attribute_of(intruder.child("encounter"), "closing_speed_mps");
  sight.horizon = horizon_side_named(intruder.attribute("horizon").value()).value_or(HorizonSide::unknown);
  // Where the horizon is not known, the attitude is not either; the numbers stated are defaults.
  if (sight.horizon != HorizonSide::unknown) set_camera(sight, of_camera);
  return sight;
}

// One intruder of a video, as its annotations tell it frame by frame.
struct AnnotatedIntruder {
  std::vector<double> times_s, ranges_m;                    // of all frames
  std::vector<std::pair<std::size_t, DomainSight>> sights;  // those in view, each with its place in these lists
};

DomainEncounter encounter_of(const AnnotatedIntruder& intruder, const IndexedVideo& video, const std::string& kind) {
  DomainEncounter encounter{.words = video.tags, .sights = {}};
  if (!kind.empty()) encounter.words[kKindCondition] = kind;
  const std::vector<double> speeds = closing_speeds(intruder.times_s, intruder.ranges_m);
  for (auto [at, sight] : intruder.sights) {
    double& speed = number_of(sight, DomainNumber::closing_speed_mps);
    if (!std::isfinite(speed)) speed = speeds[at];
    encounter.sights.push_back(sight);
  }
  return encounter;
}

void count_domain_video(const IndexedVideo& video, pugi::xml_node annotations, DomainCoverage& coverage) {
  std::map<std::string, AnnotatedIntruder> intruders;  // by id
  for (const pugi::xml_node frame : annotations.children("frame")) {
    ++coverage.frames;
    for (const pugi::xml_node node : frame.children("intruder")) {
      if (std::string_view(node.attribute("role").value()) == "distractor") continue;
      AnnotatedIntruder& intruder = intruders[node.attribute("id").value()];
      intruder.times_s.push_back(attribute_of(frame, "time_s"));
      intruder.ranges_m.push_back(attribute_of(node.child("distance"), "m"));
      if (node.child("box"))
        intruder.sights.emplace_back(intruder.ranges_m.size() - 1, sight_in(frame.child("camera"), node));
    }
  }
  ++coverage.videos;
  std::map<std::string, std::string> kinds = video.categories;
  for (const auto& [id, intruder] : intruders) coverage.add(encounter_of(intruder, video, kinds[id]));
}

}  // namespace

DomainCoverage::DomainCoverage(DesignDomain of) : domain(std::move(of)) {
  for (const DomainCondition& condition : domain.conditions)
    conditions.push_back({.bins = std::vector<DomainCount>(condition.bins()), .outside = {}, .untold = {}});
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (std::size_t j = i + 1; j < conditions.size(); ++j)
      pairs.push_back({i, j, std::vector<DomainCount>(conditions[i].bins.size() * conditions[j].bins.size())});
}

void DomainCoverage::add(const DomainEncounter& encounter) {
  EncounterTally tally;
  for (const DomainSight& sight : encounter.sights) {
    tally.count(in_view);
    std::vector<Placed> at;
    for (const DomainCondition& condition : domain.conditions) at.push_back(placed_value(condition, encounter, sight));
    for (std::size_t i = 0; i < at.size(); ++i)
      tally.count(at[i].fit == Fit::bin       ? conditions[i].bins[at[i].bin]
                  : at[i].fit == Fit::outside ? conditions[i].outside
                                              : conditions[i].untold);
    for (PairCoverage& pair : pairs)
      if (at[pair.first].fit == Fit::bin && at[pair.second].fit == Fit::bin)
        tally.count(pair.cells[at[pair.first].bin * conditions[pair.second].bins.size() + at[pair.second].bin]);
    const auto allows_sight = [&](const DomainZone& zone) { return allows(zone, sight); };
    const bool is_in_zone = domain.zones.empty() || std::ranges::any_of(domain.zones, allows_sight);
    if (!is_in_zone || std::ranges::find(at, Fit::outside, &Placed::fit) != at.end()) tally.count(outside);
  }
}

std::vector<DomainTarget> DomainCoverage::empty_bins() const {
  std::vector<DomainTarget> empty;
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (std::size_t bin = 0; bin < conditions[i].bins.size(); ++bin)
      if (domain.has(i, bin) && is_empty(conditions[i].bins[bin])) empty.push_back({.condition = i, .bin = bin});
  return empty;
}

std::vector<DomainTarget> DomainCoverage::empty_pairs() const {
  std::vector<DomainTarget> empty;
  for_each_pair([&](const DomainTarget& target, const DomainCount& count) {
    if (has(target) && is_empty(count)) empty.push_back(target);
  });
  return empty;
}

std::pair<long long, long long> DomainCoverage::pairs_covered() const {
  std::pair<long long, long long> covered_and_all{0, 0};
  for_each_pair([&](const DomainTarget& target, const DomainCount& count) {
    if (!has(target)) return;
    ++covered_and_all.second;
    if (!is_empty(count)) ++covered_and_all.first;
  });
  return covered_and_all;
}

std::string DomainCoverage::text_of(const DomainTarget& target) const {
  const auto text = [&](std::size_t condition, std::size_t bin) {
    const DomainCondition& of = domain.conditions.at(condition);
    return of.name + " " + of.bin_name(bin);
  };
  const std::string first = text(target.condition, target.bin);
  return target.other ? first + " with " + text(target.other->first, target.other->second) : first;
}

std::optional<PlannedEncounters> encounters_of(const PlannedVideo& video, VideoVisibility& opener) {
  const std::optional<Scene> scene = opener.scene_of(video.project);
  if (!scene) return std::nullopt;
  const VisibilityEstimator estimator(*scene);
  const std::size_t bodies = scene->intruders.size();
  std::vector<DomainEncounter> all(bodies);
  std::vector<std::vector<double>> ranges_m(bodies);
  std::vector<std::vector<std::size_t>> places(bodies);
  std::vector<double> times_s;
  for (int frame = scene->first_frame; frame <= scene->last_frame; ++frame) {
    const SceneMoment moment = scene_at(*scene, frame);
    const std::vector<VisibilityEstimate> estimates = estimator.all_at(frame);
    times_s.push_back(moment.time_s);
    for (const PlacedIntruder& body : moment.intruders) {
      const auto i = static_cast<std::size_t>(body.id);
      ranges_m[i].push_back(body.distance_m());
      if (scene->intruders[i].is_distractor || !is_seen(estimates[i])) continue;
      all[i].sights.push_back(planned_sight(*scene, moment, body, estimates[i]));
      places[i].push_back(times_s.size() - 1);
    }
  }
  PlannedEncounters planned{.frames = static_cast<int>(times_s.size()), .encounters = {}};
  for (std::size_t i = 0; i < bodies; ++i) {
    const std::vector<double> speeds = closing_speeds(times_s, ranges_m[i]);
    for (std::size_t k = 0; k < places[i].size(); ++k)
      number_of(all[i].sights[k], DomainNumber::closing_speed_mps) = speeds[places[i][k]];
    all[i].words = video.tags;
    all[i].words[kKindCondition] = video.project.intruders[i].category;
    if (!all[i].sights.empty()) planned.encounters.push_back(std::move(all[i]));
  }
  return planned;
}

Result<DomainCoverage> predicted_domain_coverage(const DesignDomain& domain,
                                                 const std::vector<const PlannedVideo*>& videos,
                                                 const std::atomic<bool>* cancel) {
  VideoVisibility opener;
  DomainCoverage coverage(domain);
  for (const PlannedVideo* const video : videos) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    const std::optional<PlannedEncounters> planned = encounters_of(*video, opener);
    ++(planned ? coverage.videos : coverage.unopened);
    if (!planned) continue;
    coverage.frames += planned->frames;
    for (const DomainEncounter& encounter : planned->encounters) coverage.add(encounter);
  }
  return coverage;
}

Result<DomainCoverage> counted_domain_coverage(const DesignDomain& domain, const std::filesystem::path& folder,
                                               const std::atomic<bool>* cancel) {
  DomainCoverage coverage(domain);
  const Result<Json> index = for_each_indexed_video(
      folder, cancel, [&](const IndexedVideo& video, pugi::xml_node annotations) -> Result<void> {
        count_domain_video(video, annotations, coverage);
        return {};
      });
  if (!index) return fail(index.error());
  return coverage;
}

}  // namespace sigs
