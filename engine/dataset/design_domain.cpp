// SPDX-License-Identifier: MIT
#include "dataset/design_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/json.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "dataset/recipe_reading.h"
#include "project/fields.h"
#include "project/json.h"
#include "truth/annotation.h"

namespace sigs {

namespace {

constexpr int kDomainVersion = 1;
constexpr std::size_t kMaxBins = 500;  // of all conditions together: 125,000 pairs
constexpr int kMaxMinEncounters = 1'000'000;

std::vector<std::string> number_names() {
  return {kDomainNumberNames.begin(), kDomainNumberNames.end()};
}

// "bins": [100, 300, 700]
std::vector<double> read_edges(const Json& list, const std::string& key, RecipeLog& log) {
  std::vector<double> edges;
  if (!list.is_array() || list.size() < 2) {
    log.wrong(key, "expected a list of at least two numbers, the edges of the bins, found " + shown(list));
    return edges;
  }
  for (const Json& edge : list) {
    if (!edge.is_number() || !std::isfinite(edge.get<double>()))
      log.wrong(fmt::format("{}[{}]", key, edges.size()), "expected a number, found " + shown(edge));
    else if (!edges.empty() && edge.get<double>() <= edges.back())
      log.wrong(fmt::format("{}[{}]", key, edges.size()),
                fmt::format("is {} after {}; edges must rise", short_number_text(edge.get<double>()),
                            short_number_text(edges.back())));
    edges.push_back(edge.is_number() ? edge.get<double>() : 0);
  }
  return edges;
}

// "values": ["above", "below"]
std::vector<std::string> read_values(const Json& list, const std::string& key, RecipeLog& log) {
  std::vector<std::string> values;
  if (!list.is_array() || list.empty()) log.wrong(key, "expected a list of at least one text, found " + shown(list));
  for (const Json& value : list.is_array() ? list : Json::array()) {
    const std::string place = fmt::format("{}[{}]", key, values.size());
    if (!value.is_string() || value.get<std::string>().empty())
      log.wrong(place, "expected a text, found " + shown(value));
    values.push_back(value.is_string() ? value.get<std::string>() : "");
    if (std::count(values.begin(), values.end(), values.back()) > 1) log.wrong(place, "stands there twice");
  }
  return values;
}

DomainCondition read_condition(const std::string& name, const Json& json, RecipeLog& log) {
  RecipeNode node(json, "conditions." + name, log);
  DomainCondition condition{.name = name, .edges = {}, .values = {}};
  const Json* const bins = node.value("bins");
  const Json* const values = node.value("values");
  const bool is_number = domain_number_named(name).has_value();
  if ((bins == nullptr) == (values == nullptr)) {
    log.wrong(node.key_of("bins"), is_number ? "give \"bins\": [EDGE, EDGE, ...]"
                                             : "give \"values\": [TEXT, ...] in its place, or a number's \"bins\"");
  } else if (bins != nullptr && !is_number) {
    log.wrong(node.key_of("bins"), fmt::format("bins are of numbers, which are {}{}", listed(kDomainNumberNames),
                                               suggestion(number_names(), name)));
  } else if (values != nullptr && is_number) {
    log.wrong(node.key_of("values"), "it is a number; give \"bins\": [EDGE, EDGE, ...]");
  } else if (bins != nullptr) {
    condition.edges = read_edges(*bins, node.key_of("bins"), log);
  } else {
    condition.values = read_values(*values, node.key_of("values"), log);
    for (const std::string& value : condition.values)
      if (name == kHorizonCondition && (!horizon_side_named(value) || value == name_of(HorizonSide::unknown)))
        log.wrong(node.key_of("values"), fmt::format("has \"{}\"; there are above, on, below", value));
  }
  node.done();
  return condition;
}

// "zones": {"far": {"range_m": [4500, 6000]}}
DomainZone read_zone(const std::string& name, const Json& json, const DesignDomain& domain, RecipeLog& log) {
  DomainZone zone{.name = name, .limits = {}};
  const std::string key = "zones." + name;
  if (!json.is_object()) {
    log.wrong(key, "expected {CONDITION: [LOW, HIGH]}, found " + shown(json));
    return zone;
  }
  for (const auto& [condition, pair] : json.items()) {
    const std::string place = key + "." + condition;
    const auto there = std::ranges::find(domain.conditions, condition, &DomainCondition::name);
    if (there == domain.conditions.end() || there->edges.empty())
      log.wrong(place, "is no condition of this file with bins");
    const bool is_pair = pair.is_array() && pair.size() == 2 && pair[0].is_number() && pair[1].is_number();
    const Span limits = is_pair ? Span{pair[0].get<double>(), pair[1].get<double>()} : Span{1, 0};
    if (!(limits.low < limits.high)) log.wrong(place, "expected [LOW, HIGH] with LOW below HIGH, found " + shown(pair));
    zone.limits.emplace_back(condition, limits);
  }
  return zone;
}

void check_size(const DesignDomain& domain, RecipeLog& log) {
  std::size_t bins = 0;
  for (const DomainCondition& condition : domain.conditions) bins += condition.bins();
  if (bins > kMaxBins) log.wrong("conditions", fmt::format("have {} bins; at most {} are read", bins, kMaxBins));
}

DesignDomain read_json_domain(const Json& json, RecipeLog& log) {
  RecipeNode node(json, "", log);
  DesignDomain domain;
  const Json* const version = node.value("sigs_domain");
  if (version == nullptr || !version->is_number_integer() || *version != kDomainVersion)
    log.wrong("sigs_domain", "a design domain begins with \"sigs_domain\": 1");
  domain.name = node.text("name").value_or("");
  domain.min_encounters = node.whole("min_encounters", 1, kMaxMinEncounters).value_or(1);
  const Json* const conditions = node.value("conditions");
  if (conditions == nullptr || !conditions->is_object() || conditions->empty())
    log.wrong("conditions", "expected {NAME: {\"bins\": [...]} or {\"values\": [...]}} with at least one condition");
  else
    for (const auto& [name, condition] : conditions->items())
      domain.conditions.push_back(read_condition(name, condition, log));
  if (const Json* const zones = node.value("zones"); zones != nullptr) {
    if (!zones->is_object())
      log.wrong("zones", "expected {NAME: {CONDITION: [LOW, HIGH]}}");
    else
      for (const auto& [name, zone] : zones->items()) domain.zones.push_back(read_zone(name, zone, domain, log));
  }
  check_size(domain, log);
  node.done();
  return domain;
}

// The names that LARD's table has for numbers of this module.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kLardNames{
    {{"distance_m", "range_m"}, {"yaw", "camera_yaw_deg"}, {"pitch", "camera_pitch_deg"}, {"roll", "camera_roll_deg"}}};

// "max_distance_m", "yaw_min": the quantity, and whether it is its upper limit; an empty quantity: neither.
std::pair<std::string, bool> lard_quantity(std::string_view key) {
  for (const bool is_max : {false, true}) {
    const std::string_view word = is_max ? "max" : "min";
    if (key.starts_with(word) && key.substr(3).starts_with('_')) return {std::string(key.substr(4)), is_max};
    if (key.ends_with(word) && key.substr(0, key.size() - 3).ends_with('_'))
      return {std::string(key.substr(0, key.size() - 4)), is_max};
  }
  return {};
}

// The lines of LARD's table, zone by zone.
class LardTable {
 public:
  explicit LardTable(RecipeLog& log) : log_(log) {}

  void add_line(std::string_view line, int number) {
    line = line.substr(0, line.find('#'));
    const bool is_indented = line.starts_with(' ') || line.starts_with('\t');
    line = trimmed(line);
    if (line.empty() || line == "---") return;
    const std::size_t colon = line.find(':');
    const std::string_view key = trimmed(line.substr(0, colon));
    const std::string_view value = colon == line.npos ? "" : trimmed(line.substr(colon + 1));
    if (colon == line.npos || is_indented == value.empty() || (is_indented && domain_.zones.empty()))
      return log_.wrong(fmt::format("line {}", number),
                        "expected a zone's name and a colon, or an indented KEY: NUMBER");
    if (!is_indented) {
      domain_.zones.push_back({.name = std::string(key), .limits = {}});
      return;
    }
    add_limit(std::string(key), value);
  }

  [[nodiscard]] DesignDomain domain() {
    for (const auto& [lard_name, name] : kLardNames) {
      std::set<double> edges;
      for (DomainZone& zone : domain_.zones)
        if (const Span* const limits = zone.limits_of(name)) {
          if (limits->low < limits->high)
            edges.insert({limits->low, limits->high});
          else
            log_.wrong(fmt::format("{}.{}", zone.name, lard_name), "its minimum must be below its maximum, both given");
        }
      if (!edges.empty())
        domain_.conditions.push_back({.name = std::string(name), .edges = {edges.begin(), edges.end()}, .values = {}});
    }
    if (domain_.conditions.empty()) log_.wrong("zones", "none of them has distance_m, yaw, pitch or roll");
    check_size(domain_, log_);
    if (!ignored_.empty())
      log_.warn(listed(ignored_), "not read: angles of the approach to a runway have no counterpart in encounters");
    if (domain_.conditions.empty()) return domain_;
    log_.warn(
        "yaw, distance_m",
        "are against the runway in LARD; here yaw is that of the camera in the world, distance is to the intruder");
    return domain_;
  }

 private:
  void add_limit(const std::string& key, std::string_view value) {
    const auto [quantity, is_max] = lard_quantity(key);
    const auto name = std::ranges::find(kLardNames, quantity, [](const auto& names) { return names.first; });
    if (name == kLardNames.end()) {
      ignored_.insert(quantity.empty() ? key : quantity);
      return;
    }
    DomainZone& zone = domain_.zones.back();
    const std::optional<double> number = finite_number(value);
    if (!number) return log_.wrong(zone.name + "." + key, fmt::format("expected a number, found \"{}\"", value));
    auto there = std::ranges::find(zone.limits, name->second, [](const auto& limit) { return limit.first; });
    if (there == zone.limits.end())
      there = zone.limits.insert(there, {std::string(name->second), {std::nan(""), std::nan("")}});
    (is_max ? there->second.high : there->second.low) = *number;
  }

  RecipeLog& log_;
  DesignDomain domain_;
  std::set<std::string> ignored_;
};

DesignDomain read_lard_domain(std::string_view text, const std::string& name, RecipeLog& log) {
  LardTable table(log);
  int number = 0;
  while (!text.empty()) table.add_line(next_line(text), ++number);
  DesignDomain domain = table.domain();
  domain.name = name;
  return domain;
}

bool overlap(const Span& a, const Span& b) {
  return std::min(a.high, b.high) > std::max(a.low, b.low);
}

bool zone_has(const DomainZone& zone, const DomainCondition& condition, std::size_t bin) {
  const Span* const limits = zone.limits_of(condition.name);
  return limits == nullptr || overlap(*limits, condition.span_of_bin(bin));
}

}  // namespace

std::optional<DomainNumber> domain_number_named(std::string_view name) {
  const auto there = std::ranges::find(kDomainNumberNames, name);
  if (there == kDomainNumberNames.end()) return std::nullopt;
  return static_cast<DomainNumber>(there - kDomainNumberNames.begin());
}

std::string DomainCondition::bin_name(std::size_t bin) const {
  if (edges.empty()) return values.at(bin);
  return short_number_text(edges.at(bin)) + " to " + short_number_text(edges.at(bin + 1));
}

std::optional<std::size_t> DomainCondition::bin_of(double value) const {
  if (edges.empty() || !(value >= edges.front() && value <= edges.back())) return std::nullopt;
  const auto above = std::upper_bound(edges.begin(), edges.end(), value);
  return std::min(static_cast<std::size_t>(above - edges.begin()) - 1, bins() - 1);
}

std::optional<std::size_t> DomainCondition::bin_of(std::string_view value) const {
  const auto there = std::ranges::find(values, value);
  if (there == values.end()) return std::nullopt;
  return static_cast<std::size_t>(there - values.begin());
}

const Span* DomainZone::limits_of(std::string_view condition) const {
  const auto there = std::ranges::find(limits, condition, [](const auto& limit) { return limit.first; });
  return there == limits.end() ? nullptr : &there->second;
}

bool DesignDomain::has(std::size_t condition, std::size_t bin) const {
  return zones.empty() || std::ranges::any_of(zones, [&](const DomainZone& zone) {
           return zone_has(zone, conditions.at(condition), bin);
         });
}

bool DesignDomain::has(std::size_t condition, std::size_t bin, std::size_t other, std::size_t other_bin) const {
  return zones.empty() || std::ranges::any_of(zones, [&](const DomainZone& zone) {
           return zone_has(zone, conditions.at(condition), bin) && zone_has(zone, conditions.at(other), other_bin);
         });
}

Result<ReadDomain> parse_design_domain(const std::string& text, const std::filesystem::path& path) {
  const std::string file = path.string();
  RecipeLog log{.file = file, .error = {}, .warnings = {}};
  ReadDomain read;
  const std::string_view content = trimmed(without_bom(text));
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  if (first == content.npos) return fail(file, "is empty; a design domain begins with \"sigs_domain\": 1");
  if (content[first] == '{' || content[first] == '[') {
    const Result<Json> json = parsed_json(text, file, ErrorKind::bad_data);
    if (!json) return fail(json.error());
    read.domain = read_json_domain(*json, log);
  } else {
    read.domain = read_lard_domain(content, path.stem().string(), log);
  }
  if (log.error) return fail(*log.error);
  read.warnings = std::move(log.warnings);
  if (read.domain.name.empty()) read.domain.name = path.stem().string();
  return read;
}

Result<ReadDomain> read_design_domain(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path, kProjectLimit_bytes);
  if (!text) return fail(text.error());
  return parse_design_domain(*text, path);
}

}  // namespace sigs
