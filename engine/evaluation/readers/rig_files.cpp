// SPDX-License-Identifier: MIT
#include "evaluation/readers/rig_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/input_file.h"
#include "base/text.h"
#include "evaluation/readers/json_reading.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// A list of objects; empty, and an error, where it is none.
const Json& list_in(JsonFields& fields, const Json& object, const char* key) {
  static const Json none = Json::array();
  const Json* const list = JsonFields::field(object, key);
  if (list != nullptr && list->is_array()) return *list;
  fields.wrong(key, "is no list");
  return none;
}

std::size_t camera_in(JsonFields& fields, const Json& handover, const char* key, const RigClip& rig) {
  const std::string name = fields.text(handover, key);
  const auto found = std::find(rig.cameras.begin(), rig.cameras.end(), name);
  if (found == rig.cameras.end()) fields.wrong(key, "names no camera of the rig");
  return static_cast<std::size_t>(found - rig.cameras.begin());
}

RigTarget target_in(JsonFields& fields, const Json& intruder, const std::string& place, const RigClip& rig) {
  fields.enter(place);
  RigTarget target{.id = fields.whole(intruder, "id"), .name = fields.text(intruder, "name")};
  int n = 0;
  for (const Json& one : list_in(fields, intruder, "handovers")) {
    fields.enter(fmt::format("{}.handovers[{}]", place, n++));
    target.handovers.push_back({camera_in(fields, one, "from", rig), camera_in(fields, one, "to", rig),
                                fields.number(one, "time_s"), fields.number(one, "gap_s")});
  }
  return target;
}

Result<RigClip> cameras_and_handovers(const fs::path& path) {
  JsonFields fields(path);
  const Result<Json> document = fields.document();
  if (!document) return fail(document.error());
  const Json* const version = JsonFields::field(*document, "sigs_rig");
  if (version == nullptr || *version != 1)
    return fields.failure("is no NAME.rig.json of an export, whose sigs_rig is 1");
  RigClip rig{.name = fields.text(*document, "name")};
  int n = 0;
  for (const Json& camera : list_in(fields, *document, "cameras")) {
    fields.enter(fmt::format("cameras[{}]", n++));
    rig.cameras.push_back(fields.text(camera, "name"));
    rig.labels.push_back(path.parent_path() / (rig.name + "." + rig.cameras.back() + ".xml"));
  }
  n = 0;
  for (const Json& intruder : list_in(fields, *document, "intruders"))
    rig.targets.push_back(target_in(fields, intruder, fmt::format("intruders[{}]", n++), rig));
  if (!fields.is_wrong() && rig.cameras.empty()) return fields.failure("names no camera");
  if (fields.is_wrong()) return fields.failure();
  return rig;
}

// Columns of NAME.rig.csv, by number.
struct RigColumns {
  std::size_t time = 0;
  std::size_t intruder = 0;
  std::size_t range = 0;
  std::size_t bearing = 0;
  std::size_t elevation = 0;
  std::size_t count = 0;
};

std::optional<RigColumns> columns_of_header(std::string_view line) {
  const std::vector<std::string_view> names = csv_fields(line);
  const auto number = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const RigColumns columns{number("time_s"),      number("intruder"),      number("range_m"),
                           number("bearing_deg"), number("elevation_deg"), names.size()};
  const bool has_all =
      std::max({columns.time, columns.intruder, columns.range, columns.bearing, columns.elevation}) < names.size();
  return has_all ? std::optional(columns) : std::nullopt;
}

glm::dvec3 point_of(double range_m, double bearing_deg, double elevation_deg) {
  constexpr double kDegree_rad = std::numbers::pi / 180;
  const double level_m = range_m * std::cos(elevation_deg * kDegree_rad);
  return {level_m * std::cos(bearing_deg * kDegree_rad), level_m * std::sin(bearing_deg * kDegree_rad),
          -range_m * std::sin(elevation_deg * kDegree_rad)};
}

// What is wrong with a line; empty: nothing.
std::string add_place(RigClip& rig, const RigColumns& columns, std::string_view line) {
  const std::vector<std::string_view> cells = csv_fields(line);
  if (cells.size() != columns.count)
    return fmt::format("has {} fields, the first line {}", cells.size(), columns.count);
  const std::optional<int> id = integer_of(cells[columns.intruder]);
  const auto target = std::ranges::find_if(rig.targets, [&](const RigTarget& one) { return id && one.id == *id; });
  if (target == rig.targets.end())
    return fmt::format("intruder {} is none of the rig's", in_quotes(cells[columns.intruder]));
  std::vector<double> numbers;
  for (const std::size_t column : {columns.time, columns.range, columns.bearing, columns.elevation}) {
    const std::optional<double> number = parsed_number<double>(cells[column]);
    if (!number || !std::isfinite(*number)) return in_quotes(cells[column]) + " is no number";
    numbers.push_back(*number);
  }
  if (!target->places.empty() && numbers[0] <= target->places.back().time_s)
    return "its time is not after the one before";
  target->places.push_back({numbers[0], point_of(numbers[1], numbers[2], numbers[3])});
  return {};
}

Result<void> add_places(RigClip& rig, const fs::path& table) {
  const Result<std::string> text = read_text(table);
  if (!text) return fail(text.error());
  TextLines lines(*text);
  const std::optional<TextLine> header = lines.next();
  const std::optional<RigColumns> columns = header ? columns_of_header(header->text) : std::nullopt;
  if (!columns) return fail(table.string(), "has no columns time_s, intruder, range_m, bearing_deg and elevation_deg");
  while (const std::optional<TextLine> line = lines.next())
    if (const std::string wrong = add_place(rig, *columns, line->text); !wrong.empty())
      return fail(place_of(table, line->number), wrong);
  for (const RigTarget& target : rig.targets)
    if (target.places.empty()) return fail(table.string(), fmt::format("has no line of intruder {}", target.id));
  return {};
}

}  // namespace

Result<RigClip> read_rig(const fs::path& path) {
  Result<RigClip> rig = cameras_and_handovers(path);
  if (!rig) return rig;
  if (const Result<void> added = add_places(*rig, path.parent_path() / (rig->name + ".rig.csv")); !added)
    return fail(added.error());
  return rig;
}

glm::dvec3 place_at(const RigTarget& target, double time_s) {
  if (target.places.size() < 2) return target.places.front().p_in_body;
  const auto after = std::lower_bound(target.places.begin() + 1, target.places.end() - 1, time_s,
                                      [](const RigPlace& one, double wanted_s) { return one.time_s < wanted_s; });
  const RigPlace& before = *std::prev(after);
  const double share = std::clamp((time_s - before.time_s) / (after->time_s - before.time_s), -1.0, 2.0);
  return before.p_in_body + (after->p_in_body - before.p_in_body) * share;
}

}  // namespace sigs
