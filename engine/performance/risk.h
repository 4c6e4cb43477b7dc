// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "encounter/encounter_track.h"
#include "encounter/well_clear.h"
#include "encounter_model/encounter_model.h"
#include "evaluation/reports/report_files.h"
#include "performance/sensor_model.h"
#include "plot/plot.h"

namespace sigs {

// The risk ratio: by how much a sensor and a manoeuvre lower the probability of a near mid-air collision (NMAC) and of
// losing well clear, over many simulated encounters, each flown twice: without and with the manoeuvre. Both aircraft
// are points that move; nothing of an autopilot is simulated. docs/risk.md gives method and limits.

// Away: a turn against the side to which the line of sight drifts, or descending where it drifts upwards, else
// climbing: what makes the miss grow. Where it does not drift by more than 0.1 degree a second, to the right, and by
// the side on which the intruder is.
enum class ManoeuvreKind { none, turn_right, turn_left, turn_away, climb, descend, vertical_away, slow_down, speed_up };
inline constexpr std::array kManoeuvreNames{"none",    "turn-right",    "turn-left", "turn-away", "climb",
                                            "descend", "vertical-away", "slow-down", "speed-up"};
// None: there is no manoeuvre of that name.
[[nodiscard]] std::optional<ManoeuvreKind> manoeuvre_named(std::string_view name);

// How it is flown, until the encounter ends. Numbers may be infinite: at once, without end.
struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::vertical_away;
  double delay_s = 1;            // from the declaration, the sensor's latency included in it, to its begin
  double turn_rate_radps = 0.2;  // a bank of 27 degrees at 25 m/s
  double heading_change_rad = 1.5707963267949;  // after which it flies straight
  double climb_mps = 4;                         // up or down
  double vertical_acceleration_mps2 = 2.5;      // a quarter of g, until that rate is reached
  double height_change_m = std::numeric_limits<double>::infinity();
  double acceleration_mps2 = 1;
  double min_speed_mps = 12;
  double max_speed_mps = 40;
};

// What the aircraft knows of the intruder when it decides: measured, with the sensor model's errors.
struct ThreatView {
  std::int64_t encounter = 0;
  double time_s = 0;  // since the encounter's begin
  double bearing_rad = 0;
  double elevation_rad = 0;
  // How fast the line of sight turns, in the horizontal plane to the right and upwards, against the world; measured
  // over a second. An intruder on a collision course has a line of sight that does not turn.
  double bearing_rate_radps = 0;
  double elevation_rate_radps = 0;
  std::optional<double> range_m;  // where the sensor states one
  double own_speed_mps = 0;
};

// Decides at each of the sensor's frames in which a track is declared and comes nearer (what recedes needs no
// manoeuvre: it shrinks in the image), until it answers with a manoeuvre. Empty: the
// manoeuvre of the settings, at once. Errors end the run.
using Logic = std::function<Result<ManoeuvreKind>(const ThreatView&)>;

// A table of rules as a decision: a CSV whose columns may be bearing_min_deg, bearing_max_deg, elevation_min_deg,
// elevation_max_deg, rate_max_deg_s (of the line of sight's turning, either way), range_max_m and must have manoeuvre.
// The first row whose limits hold decides; an empty cell is no limit; where none holds, none. Errors bad_data with the
// line.
[[nodiscard]] Result<Logic> logic_table(const std::string& text, const std::string& file);

// Two flights that were recorded or made, over the time that they share.
struct RiskPair {
  std::string name;
  EncounterTrack own;
  EncounterTrack intruder;
  // When a track was declared by images, latency included; none: never. Where is_from_images, no sensor is drawn.
  std::optional<double> declared_s = {};
  bool is_from_images = false;
};

// Where encounters come from. Of both kinds of flights, speeds lie evenly between two limits, unless a model flies.
struct RiskEncounters {
  std::vector<RiskPair> pairs;                  // not empty: nothing else counts, and all weigh alike
  std::optional<EncounterModel> own_model;      // none: straight and level
  std::vector<EncounterModel> intruder_models;  // each as often; none: straight and level
  std::array<double, 2> own_speed_mps{25, 25};
  std::array<double, 2> intruder_speed_mps{30, 80};
  // At the closest approach of both flights if neither manoeuvres, horizontal and vertical offset are even within
  // these limits to both sides, and the intruder's course is any. Encounters weigh by their relative speed, since so
  // many more come by in a time.
  double miss_m = 1000;
  double vertical_miss_m = 150;
  int lead_s = 90;                  // before the closest approach
  int after_s = 30;                 // behind it
  bool importance_sampling = true;  // half of the encounters have small misses, and weigh less
};

// An intruder of a clip as a pair: both flights of the clip, then straight on for some seconds, as fast as in the last
// second. None where the truth has no places of camera and intruder, or fewer than two frames.
[[nodiscard]] std::optional<RiskPair> risk_pair_of(const ClipTruth& clip, const TargetTruth& target,
                                                   const std::string& name, double after_s);

struct RiskSettings {
  RiskEncounters encounters;
  SensorModel sensor;
  Manoeuvre manoeuvre;
  WellClearVolume well_clear = {"small-uas", 609.6, 609.6, 0, 76.2, 0};
  // A declared track waits while it is farther away, or its line of sight turns faster.
  double alert_range_m = std::numeric_limits<double>::infinity();
  double alert_rate_radps = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;
  std::int64_t count = 100'000;
  double until = 0;  // stop when half the interval of the NMAC ratio is within this share of it; 0: never
  int shard = 1;     // of shards, from 1: every so many batches of kRiskBatch encounters
  int shards = 1;
  int threads = 1;
};
inline constexpr int kRiskBatch = 1000;

// Weighted numbers of encounters with an event, without and with the system, and of their squared weights.
struct EventSums {
  double without = 0, with = 0;
  double without_squares = 0, with_squares = 0, both_squares = 0;
};

inline constexpr std::size_t kTallySums = 21;

struct RiskTally {
  std::int64_t encounters = 0;
  double weight = 0;
  double weight_squares = 0;
  EventSums nmac;
  EventSums well_clear;
  double induced = 0;  // NMAC with the system and not without
  // NMACs with the system and without it, by what failed: never in the sensor's view before; in view, not declared in
  // time; declared, but no manoeuvre before; a manoeuvre that did not suffice.
  double out_of_view = 0, undeclared = 0, waiting = 0, insufficient = 0;
  double declared = 0;  // before the end
  double manoeuvred = 0;
  double clear = 0;        // without loss of well clear without the system
  double unnecessary = 0;  // of these, with a manoeuvre

  void add(RiskTally other);
  [[nodiscard]] std::array<double*, kTallySums> sums();  // all but `encounters`, in a fixed order
};

// Classes of encounters by the courses at the closest approach (within 45 degrees of opposite; between; of equal, where
// the faster one comes from behind) and
// by the side on which the intruder is when both begin.
inline constexpr std::array kRiskClasses{"all", "head-on", "crossing", "same way", "above", "below"};
using RiskTallies = std::array<RiskTally, kRiskClasses.size()>;

struct RiskBatch {
  std::int64_t number = 0;
  RiskTallies tallies;
};

struct RiskResult {
  RiskTallies tallies;
  std::vector<RiskBatch> batches;
  bool is_precise = true;  // what `until` asks for was reached, or nothing was asked
};

// A ratio and its interval: by the delta method on the logarithm; with no event with the system from 0 to the limit of
// 3 events. NaN where there is no event without it.
struct RiskRatio {
  double ratio = 0;
  Interval interval;
};
[[nodiscard]] RiskRatio risk_ratio(const EventSums& sums);
// Share of weighted encounters, with the interval of their effective number.
[[nodiscard]] RiskRatio weighted_share(double part, double whole, const RiskTally& tally);

// Flies all encounters. The result depends on the settings alone, not on threads. Errors: interrupted; those of the
// logic; bad_data where a model cannot fly or no encounter is possible.
//   progress  called after each batch from any thread, with the number of encounters so far
[[nodiscard]] Result<RiskResult> simulated_risk(const RiskSettings& settings, const Logic& logic,
                                                const std::atomic<bool>* cancel = nullptr,
                                                const std::function<void(std::int64_t)>& progress = {});

// Batches of shards in their order, summed as one run sums them.
[[nodiscard]] RiskResult merged_risk(std::vector<RiskBatch> batches);

// One encounter of a simulation of risk: drawn (risk_encounter.cpp), flown without the system, seen by the sensor,
// flown again with the manoeuvre.

// Both flights at equal steps of time. World axes: X north, Y east, Z down.
struct FlownPair {
  double step_s = 0.1;
  double weight = 1;
  std::vector<AircraftState> own;
  std::vector<AircraftState> intruder;
};

// Steps no longer than 0.1 s, a whole number of them from each frame of the sensor to the next.
struct Steps {
  double step_s = 0.1;
  int of_frame = 1;
};
[[nodiscard]] Steps steps_of(double rate_hz);

// Drawn out of the settings, at most one number of the sequence after the other; or as recorded.
[[nodiscard]] FlownPair drawn_pair(const RiskEncounters& encounters, const Steps& steps, Random& random);
[[nodiscard]] FlownPair recorded_pair(const RiskPair& recorded, const Steps& steps);

struct FlownOutcome {
  double weight = 1;
  Geometry geometry = Geometry::head_on;
  bool is_above = false;  // the intruder, when both begin
  bool nmac_without = false, nmac_with = false;
  bool lost_without = false, lost_with = false;  // well clear
  bool is_in_view = false;   // within the sensor's field and reach at some frame before an NMAC without the system
  bool is_declared = false;  // before one
  bool is_manoeuvred = false;
};

// The encounter of this number: the same for the same settings, on any thread. Errors: those of the logic.
[[nodiscard]] Result<FlownOutcome> flown_encounter(const RiskSettings& settings, std::int64_t number,
                                                   const Logic& logic);

// Whether the models can fly and the limits make sense. Errors bad_data, usage.
[[nodiscard]] Result<void> check_flights(const RiskEncounters& encounters);

// The result of a simulation of risk, for people and for programs.

// All settings and figures, NaN as null. A shard of several has its batches too, which risk_shard_of() reads.
[[nodiscard]] Json risk_json(const RiskSettings& settings, const RiskResult& result);

// What a run of one shard wrote.
struct RiskShard {
  Json settings;
  int shard = 1;
  int shards = 1;
  std::vector<RiskBatch> batches;
};
// Errors bad_data that name the member.
[[nodiscard]] Result<RiskShard> risk_shard_of(const Json& json, const std::string& file);

// All shards as one run: the JSON that it would have written. Errors bad_data: other settings, a shard that is missing
// or twice.
[[nodiscard]] Result<Json> merged_risk_json(const std::vector<RiskShard>& shards,
                                            const std::vector<std::string>& files);

// A result in JSON as a table, and with its sentences as text. It must be of risk_json() or merged_risk_json(), or have
// passed check_risk_json().
[[nodiscard]] std::vector<TableColumn> risk_table(const Json& json);
[[nodiscard]] std::string risk_text(const Json& json);

// Whether a file's content is such a result. Error bad_data.
[[nodiscard]] Result<void> check_risk_json(const Json& json, const std::string& file);

// Ratios by class, with their intervals.
[[nodiscard]] Plot risk_plot(const Json& json);

}  // namespace sigs
