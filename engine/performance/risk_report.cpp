// SPDX-License-Identifier: MIT
#include "performance/risk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "base/text.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// The numbers of a tally for the batches of shards: how many encounters, then the sums.
constexpr std::size_t kTallyNumbers = 1 + kTallySums;

std::array<double, kTallyNumbers> numbers_of_tally(RiskTally tally) {
  std::array<double, kTallyNumbers> numbers{double(tally.encounters)};
  std::ranges::transform(tally.sums(), numbers.begin() + 1, [](const double* sum) { return *sum; });
  return numbers;
}

RiskTally tally_of_numbers(const std::array<double, kTallyNumbers>& numbers) {
  RiskTally tally{.encounters = static_cast<std::int64_t>(numbers[0])};
  auto number = numbers.begin();
  for (double* const sum : tally.sums()) *sum = *++number;
  return tally;
}

Json ratio_json(const RiskRatio& ratio) {
  return {{"value", ratio.ratio}, {"interval_95", {ratio.interval.low, ratio.interval.high}}};
}

Json limit_json(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

Json class_json(const char* name, const RiskTally& tally) {
  const auto share = [&](double part, double whole) { return ratio_json(weighted_share(part, whole, tally)); };
  const auto part = [&](double sum) { return tally.nmac.without > 0 ? Json(sum / tally.nmac.without) : Json(nullptr); };
  return {{"class", name},
          {"encounters", tally.encounters},
          {"risk_ratio_nmac", ratio_json(risk_ratio(tally.nmac))},
          {"risk_ratio_well_clear", ratio_json(risk_ratio(tally.well_clear))},
          {"p_nmac_without", share(tally.nmac.without, tally.weight)},
          {"p_nmac_with", share(tally.nmac.with, tally.weight)},
          {"p_lost_without", share(tally.well_clear.without, tally.weight)},
          {"p_lost_with", share(tally.well_clear.with, tally.weight)},
          {"induced_nmac_ratio", tally.nmac.without > 0 ? Json(tally.induced / tally.nmac.without) : Json(nullptr)},
          {"remaining_nmac",
           {{"out_of_view", part(tally.out_of_view)},
            {"in_view_undeclared", part(tally.undeclared)},
            {"declared_no_manoeuvre", part(tally.waiting)},
            {"manoeuvre_insufficient", part(tally.insufficient)},
            {"induced", part(tally.induced)}}},
          {"declared", share(tally.declared, tally.weight)},
          {"manoeuvred", share(tally.manoeuvred, tally.weight)},
          {"unnecessary_manoeuvres", share(tally.unnecessary, tally.clear)}};
}

Json settings_json(const RiskSettings& settings) {
  const RiskEncounters& e = settings.encounters;
  const Manoeuvre& m = settings.manoeuvre;
  const WellClearVolume& v = settings.well_clear;
  // What recorded pairs do not use.
  const auto if_drawn = [&](const auto& value) { return e.pairs.empty() ? Json(value) : Json(nullptr); };
  Json pairs = Json::array();
  for (const RiskPair& pair : e.pairs) pairs.push_back(line_text(pair.name));
  return {{"sensor", line_text(settings.sensor.detector)},
          {"sensor_model", Json::parse(sensor_model_json(settings.sensor))},
          {"pairs", pairs},
          {"own_model", if_drawn(e.own_model.has_value())},
          {"intruder_models", if_drawn(e.intruder_models.size())},
          {"own_speed_mps", if_drawn(e.own_speed_mps)},
          {"intruder_speed_mps", if_drawn(e.intruder_speed_mps)},
          {"miss_m", if_drawn(e.miss_m)},
          {"vertical_miss_m", if_drawn(e.vertical_miss_m)},
          {"lead_s", if_drawn(e.lead_s)},
          {"after_s", e.after_s},
          {"importance_sampling", if_drawn(e.importance_sampling)},
          {"manoeuvre", kManoeuvreNames[static_cast<std::size_t>(m.kind)]},
          {"delay_s", m.delay_s},
          {"turn_rate_deg_s", limit_json(deg_of_rad(m.turn_rate_radps))},
          {"heading_change_deg", deg_of_rad(m.heading_change_rad)},
          {"climb_mps", m.climb_mps},
          {"vertical_acceleration_mps2", limit_json(m.vertical_acceleration_mps2)},
          {"height_change_m", limit_json(m.height_change_m)},
          {"acceleration_mps2", limit_json(m.acceleration_mps2)},
          {"speed_limits_mps", {m.min_speed_mps, m.max_speed_mps}},
          {"alert_range_m", limit_json(settings.alert_range_m)},
          {"alert_rate_deg_s", limit_json(deg_of_rad(settings.alert_rate_radps))},
          {"well_clear",
           {{"name", v.name},
            {"dmod_m", v.dmod_m},
            {"hmd_m", v.hmd_m},
            {"tau_mod_s", v.tau_mod_s},
            {"zthr_m", v.zthr_m},
            {"tcoa_s", v.tcoa_s}}},
          {"seed", settings.seed},
          {"count", settings.count}};
}

std::string number_of(const Json& json, int decimals) {
  return json.is_number() ? fixed_text(json.get<double>(), decimals) : "-";
}

std::string ratio_text(const Json& ratio, int decimals) {
  if (!ratio.at("value").is_number()) return "-";
  return fmt::format("{} ({} to {})", number_of(ratio.at("value"), decimals),
                     number_of(ratio.at("interval_95").at(0), decimals),
                     number_of(ratio.at("interval_95").at(1), decimals));
}

std::vector<std::string> risk_sentences(const Json& json) {
  const Json& all = json.at("classes").at(0);
  const Json& settings = json.at("settings");
  const Json& left = all.at("remaining_nmac");
  std::vector<std::string> lines{
      fmt::format("Risk ratio of NMAC (500 ft, 100 ft): {}; of losing well clear ({}): {}; {} encounters.",
                  ratio_text(all.at("risk_ratio_nmac"), 3), settings.at("well_clear").at("name").get<std::string>(),
                  ratio_text(all.at("risk_ratio_well_clear"), 3), all.at("encounters").get<std::int64_t>()),
      fmt::format(
          "What is left of the NMACs, as shares of those without the system: {} never in the sensor's view, {} in "
          "view but not declared in time, {} declared without a manoeuvre, {} where the manoeuvre did not "
          "suffice; {} induced by it.",
          number_of(left.at("out_of_view"), 3), number_of(left.at("in_view_undeclared"), 3),
          number_of(left.at("declared_no_manoeuvre"), 3), number_of(left.at("manoeuvre_insufficient"), 3),
          number_of(left.at("induced"), 3)),
      fmt::format("Declared before an NMAC or the end: {}. Manoeuvres where well clear would not have been lost: {} of "
                  "such encounters.",
                  ratio_text(all.at("declared"), 3), ratio_text(all.at("unnecessary_manoeuvres"), 3)),
      fmt::format("The intervals are those of the encounters alone. That the sensor was measured on {} is not in them.",
                  count_text(settings.at("sensor_model").at("encounters").get<std::int64_t>(), "encounter")),
      fmt::format("Manoeuvre: {}, {} s after the declaration.", settings.at("manoeuvre").get<std::string>(),
                  number_of(settings.at("delay_s"), 1))};
  const Json& unnecessary = all.at("unnecessary_manoeuvres").at("value");
  if (settings.at("alert_rate_deg_s").is_null() && unnecessary.is_number() && unnecessary.get<double>() > 0.5)
    lines.emplace_back(
        "Every declared track makes the aircraft manoeuvre; --alert-rate has it wait for lines of sight that hardly "
        "turn.");
  if (!json.at("is_precise").get<bool>())
    lines.emplace_back("The interval is wider than --until asks for: fly more encounters (--count).");
  return lines;
}

Json whole_json(Json settings, const RiskResult& result, bool is_precise) {
  Json json{
      {"sigs_risk", 1}, {"settings", std::move(settings)}, {"is_precise", is_precise}, {"classes", Json::array()}};
  for (std::size_t i = 0; i < kRiskClasses.size(); ++i)
    if (result.tallies[i].encounters > 0 || i == 0)
      json["classes"].push_back(class_json(kRiskClasses[i], result.tallies[i]));
  // As it is read back: NaN is null.
  json = Json::parse(json_text(json));
  json["in_words"] = risk_sentences(json);
  return json;
}

}  // namespace

Json risk_json(const RiskSettings& settings, const RiskResult& result) {
  Json json = whole_json(settings_json(settings), result, result.is_precise);
  if (settings.shards == 1) return json;
  json["shard"] = settings.shard;
  json["shards"] = settings.shards;
  for (const RiskBatch& batch : result.batches) {
    Json tallies = Json::array();
    for (const RiskTally& tally : batch.tallies) tallies.push_back(numbers_of_tally(tally));
    json["batches"].push_back({{"number", batch.number}, {"tallies", tallies}});
  }
  return json;
}

Result<RiskShard> risk_shard_of(const Json& json, const std::string& file) {
  const auto wrong = [&](const char* what) { return fail(file, what); };
  if (!json.is_object() || json.value("sigs_risk", Json()) != 1) return wrong("is no result of sigs risk --json");
  if (!json.contains("batches") || !json["batches"].is_array() || !json.value("shard", Json()).is_number_integer() ||
      !json.value("shards", Json()).is_number_integer() || !json.value("settings", Json()).is_object())
    return wrong("is no shard: sigs risk --shard I/N --json writes one");
  RiskShard shard{.settings = json["settings"], .shard = json["shard"], .shards = json["shards"], .batches = {}};
  for (const Json& one : json["batches"]) {
    if (!one.is_object() || !one.value("number", Json()).is_number_integer() ||
        !one.value("tallies", Json()).is_array() || one["tallies"].size() != kRiskClasses.size())
      return wrong("batches: one of them is damaged");
    RiskBatch batch{.number = one["number"], .tallies = {}};
    for (std::size_t i = 0; i < kRiskClasses.size(); ++i) {
      const Json& numbers = one["tallies"][i];
      if (!numbers.is_array() || numbers.size() != kTallyNumbers ||
          !std::ranges::all_of(numbers, [](const Json& n) { return n.is_number(); }))
        return wrong("batches: one of them is damaged");
      batch.tallies[i] = tally_of_numbers(numbers.get<std::array<double, kTallyNumbers>>());
    }
    shard.batches.push_back(batch);
  }
  return shard;
}

Result<Json> merged_risk_json(const std::vector<RiskShard>& shards, const std::vector<std::string>& files) {
  std::vector<RiskBatch> batches;
  std::vector<bool> there(static_cast<std::size_t>(std::max(1, shards.front().shards)));
  for (std::size_t i = 0; i < shards.size(); ++i) {
    const RiskShard& shard = shards[i];
    if (shard.settings != shards.front().settings || shard.shards != shards.front().shards)
      return fail(files[i], fmt::format("was flown with other settings than {}", files.front()));
    const auto index = static_cast<std::size_t>(shard.shard - 1);
    if (shard.shard < 1 || index >= there.size() || there[index])
      return fail(files[i],
                  fmt::format("shard {} of {} is there twice or is no such shard", shard.shard, shard.shards));
    there[index] = true;
    batches.insert(batches.end(), shard.batches.begin(), shard.batches.end());
  }
  for (std::size_t i = 0; i < there.size(); ++i)
    if (!there[i]) return fail(files.front(), fmt::format("shard {} of {} is missing", i + 1, there.size()));
  return whole_json(shards.front().settings, merged_risk(std::move(batches)), true);
}

std::vector<TableColumn> risk_table(const Json& json) {
  std::vector<TableColumn> columns{{"class", ""},
                                   {"encounters", ""},
                                   {"risk ratio NMAC", "95 %"},
                                   {"risk ratio well clear", "95 %"},
                                   {"P(NMAC) without", ""},
                                   {"induced", "of these"},
                                   {"declared", ""},
                                   {"unnecessary", "manoeuvres"}};
  for (const Json& one : json.at("classes"))
    add_row(columns,
            {one.at("class").get<std::string>(), std::to_string(one.at("encounters").get<std::int64_t>()),
             ratio_text(one.at("risk_ratio_nmac"), 3), ratio_text(one.at("risk_ratio_well_clear"), 3),
             number_of(one.at("p_nmac_without").at("value"), 5), number_of(one.at("induced_nmac_ratio"), 4),
             number_of(one.at("declared").at("value"), 3), number_of(one.at("unnecessary_manoeuvres").at("value"), 3)});
  return columns;
}

std::string risk_text(const Json& json) {
  std::string text;
  for (const Json& line : json.at("in_words")) text += line.get<std::string>() + "\n";
  return text + "\n" + aligned(risk_table(json));
}

Result<void> check_risk_json(const Json& json, const std::string& file) {
  try {  // the table reads every member that the others need
    if (json.at("sigs_risk") == 1 && !json.at("classes").empty()) {
      (void)risk_table(json);
      (void)risk_plot(json);
      if (json.at("in_words").is_array()) return {};
    }
  } catch (const Json::exception&) {
  }
  return fail(file, "is no result of sigs risk --json");
}

Plot risk_plot(const Json& json) {
  Plot plot{.name = "risk_ratio",
            .title = "Risk ratio with the system: NMAC and loss of well clear, 95 %",
            .x_label = "risk ratio",
            .x_range = {0, 1.05},
            .y_range = {-0.6, 0},
            .y_ticks = std::vector<PlotTick>{}};
  const Json& classes = json.at("classes");
  const auto rows = static_cast<double>(classes.size());
  plot.y_range.last = rows - 0.4;
  for (const auto& [member, title, color, offset] :
       {std::tuple("risk_ratio_nmac", "NMAC", PlotColor{200, 50, 40}, 0.14),
        std::tuple("risk_ratio_well_clear", "well clear", PlotColor{31, 119, 180}, -0.14)}) {
    PlotSeries marks{.title = title, .kind = SeriesKind::marks, .color = color};
    PlotSeries bars{.kind = SeriesKind::line, .color = color};
    for (std::size_t i = 0; i < classes.size(); ++i) {
      const Json& ratio = classes[i].at(member);
      const double y = rows - 1 - static_cast<double>(i) + offset;
      if (!ratio.at("value").is_number()) continue;
      const double high = ratio.at("interval_95").at(1).get<double>();
      plot.x_range.last = std::max(plot.x_range.last, 1.05 * high);
      marks.runs.push_back({{ratio.at("value").get<double>(), y}});
      bars.runs.push_back({{ratio.at("interval_95").at(0).get<double>(), y}, {high, y}});
    }
    plot.series.push_back(marks);
    plot.series.push_back(bars);
  }
  for (std::size_t i = 0; i < classes.size(); ++i)
    plot.y_ticks->push_back({rows - 1 - static_cast<double>(i), classes[i].at("class").get<std::string>()});
  plot.height = 120 + 45 * rows;
  return plot;
}

}  // namespace sigs
