// SPDX-License-Identifier: MIT
#include "dataset/recipe_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/paths.h"
#include "base/text.h"
#include "project/fields.h"

namespace sigs {

namespace {

const Json& no_object() {
  static const Json empty = Json::object();
  return empty;
}

std::string found(const Json& json) {
  return ", found " + shown(json);
}

constexpr double kMaxNumber = 1e12;  // of any number that a recipe gives
constexpr double kMaxBoundDeviations =
    8;  // standard deviations from the mean beyond which the remaining probability is too small to sample
constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::optional<double> number_of(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const double number = json.get<double>();
  return std::abs(number) <= kMaxNumber ? std::optional(number) : std::nullopt;
}

Possible<Quantity> uniform_of(const Json& json) {
  const bool is_pair = json.is_array() && json.size() == 2;
  const std::optional<double> low = is_pair ? number_of(json[0]) : std::nullopt;
  const std::optional<double> high = is_pair ? number_of(json[1]) : std::nullopt;
  if (!low || !high || *low > *high)
    return tl::unexpected("expected {\"uniform\": [low, high]} with low <= high, found " + shown(json));
  return Quantity{.kind = Quantity::Kind::uniform, .low = *low, .high = *high};
}

Possible<Quantity> log_uniform_of(const Json& json) {
  Possible<Quantity> quantity = uniform_of(json);
  if (!quantity) return quantity;
  if (!(quantity->low > 0)) return tl::unexpected("\"log_uniform\" needs limits above 0, found " + shown(json));
  quantity->kind = Quantity::Kind::log_uniform;
  return quantity;
}

Possible<Quantity> choice_of(const Json& json) {
  Quantity quantity{.kind = Quantity::Kind::choice};
  if (json.is_array())
    for (const Json& item : json)
      if (const std::optional<double> number = number_of(item)) quantity.choices.push_back(*number);
  if (quantity.choices.empty() || quantity.choices.size() != json.size())
    return tl::unexpected("expected {\"choice\": [numbers]}, at least one, found " + shown(json));
  return quantity;
}

Possible<Quantity> normal_of(const Json& json) {
  const std::string expected =
      "expected {\"normal\": {\"mean\": m, \"deviation\": d, \"low\": a, \"high\": b}}, found " + shown(json);
  if (!json.is_object()) return tl::unexpected(expected);
  Quantity normal{.kind = Quantity::Kind::normal, .low = -kInfinite, .high = kInfinite, .deviation = -1};
  bool has_mean = false;
  for (const auto& [key, item] : json.items()) {
    const std::optional<double> number = number_of(item);
    double* const place = key == "mean"        ? &normal.mean
                          : key == "deviation" ? &normal.deviation
                          : key == "low"       ? &normal.low
                          : key == "high"      ? &normal.high
                                               : nullptr;
    if (!number || place == nullptr) return tl::unexpected(expected);
    *place = *number;
    has_mean = has_mean || key == "mean";
  }
  if (!has_mean || normal.deviation < 0 || normal.low > normal.high) return tl::unexpected(expected);
  const double max_offset = kMaxBoundDeviations * normal.deviation;
  if (normal.low > normal.mean + max_offset || normal.high < normal.mean - max_offset)
    return tl::unexpected(
        std::string("the bounds lie more than 8 deviations from the mean; nothing is left to sample"));
  return normal;
}

constexpr std::array<std::string_view, 4> kParts{"background", "aircraft", "flight", "number"};
constexpr std::array<std::string_view, 5> kOwnNames{"labels", "splits", "index.json", "sha256sums",
                                                    "entry"};  // in lower case

// Of the pattern of a video's name.
std::optional<std::string> part_of(std::string_view name, const NameParts& parts) {
  const auto* const part = std::ranges::find(kParts, name);
  if (part == kParts.end()) return std::nullopt;
  const std::array<std::string, kParts.size()> texts{parts.background, parts.aircraft, parts.flight,
                                                     fmt::format("{:04}", parts.number)};
  return texts.at(static_cast<std::size_t>(part - kParts.begin()));
}

}  // namespace

void RecipeLog::wrong(const std::string& key, const std::string& what, ErrorKind kind) {
  if (!error) error = Error{key.empty() ? file : file + ": " + key, what, kind};
}

void RecipeLog::warn(const std::string& key, const std::string& what) {
  warnings.push_back({file + ": " + key, what});
}

RecipeNode::RecipeNode(const Json& json, std::string key, RecipeLog& log)
    : json_(&json), key_(std::move(key)), log_(&log) {
  if (json.is_object()) return;
  log.wrong(key_, "expected { ... }" + found(json));
  json_ = &no_object();
}

std::string RecipeNode::key_of(std::string_view name) const {
  return key_.empty() ? std::string(name) : key_ + "." + std::string(name);
}

const Json* RecipeNode::value(std::string_view name) {
  known_.emplace(name);
  const auto place = json_->find(std::string(name));
  return place == json_->end() ? nullptr : &*place;
}

std::optional<std::string> RecipeNode::text(std::string_view name) {
  const Json* const json = value(name);
  if (json == nullptr) return std::nullopt;
  if (json->is_string()) return json->get<std::string>();
  log_->wrong(key_of(name), "expected a text in quotes" + found(*json));
  return std::nullopt;
}

std::string RecipeNode::needed_text(std::string_view name) {
  const std::string given = text(name).value_or("");
  if (given.empty()) log_->wrong(key_of(name), "is missing or empty; give it a text");
  return given;
}

std::optional<int> RecipeNode::whole(std::string_view name, int low, int high) {
  const Json* const json = value(name);
  if (json == nullptr) return std::nullopt;
  const double number = json->is_number() ? json->get<double>() : std::nan("");
  if (number == std::floor(number) && number >= low && number <= high) return static_cast<int>(number);
  log_->wrong(key_of(name), fmt::format("expected a whole number from {} to {}{}", low, high, found(*json)));
  return std::nullopt;
}

std::vector<std::string> RecipeNode::texts(std::string_view name) {
  const Json* const json = value(name);
  if (json == nullptr) return {};
  std::vector<std::string> list;
  if (json->is_array())
    for (const Json& item : *json)
      if (item.is_string()) list.push_back(item.get<std::string>());
  if (!json->is_array() || json->empty() || list.size() != json->size())
    log_->wrong(key_of(name), "expected a list of names [\"...\"]" + found(*json));
  return list;
}

std::map<std::string, std::string> RecipeNode::text_map(std::string_view name) {
  const Json* const json = value(name);
  std::map<std::string, std::string> texts;
  if (json == nullptr) return texts;
  if (!json->is_object()) log_->wrong(key_of(name), "expected { ... }" + found(*json));
  for (const auto& [key, item] : json->items())
    if (item.is_string())
      texts[key] = item.get<std::string>();
    else
      log_->wrong(key_of(name) + "." + key, "expected a text in quotes" + found(item));
  return texts;
}

std::filesystem::path from_recipe_folder(const RecipeNode& node, const std::string& name) {
  std::error_code code;
  return (std::filesystem::absolute(node.log().file, code).parent_path() / name).lexically_normal();
}

std::vector<RecipeNode> RecipeNode::nodes(std::string_view name) {
  const Json* const json = value(name);
  std::vector<RecipeNode> list;
  if (json == nullptr || !json->is_array() || json->empty()) {
    log_->wrong(key_of(name), "expected a list [{ ... }] of at least one" + (json ? found(*json) : ""));
    return list;
  }
  for (std::size_t i = 0; i < json->size(); ++i)
    list.emplace_back(json->at(i), fmt::format("{}[{}]", key_of(name), i), *log_);
  return list;
}

void RecipeNode::done() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, item] : json_->items())
    if (!known_.contains(key) && key != "about")
      log_->warn(key_of(key), "unknown key, not used" + suggestion(known, key));
}

Possible<Quantity> quantity_of(const Json& json) {
  if (const std::optional<double> number = number_of(json))
    return Quantity{.kind = Quantity::Kind::fixed, .value = *number};
  if (json.is_object() && json.size() == 1) {
    const std::string& kind = json.begin().key();
    const Json& rest = json.begin().value();
    if (kind == "uniform") return uniform_of(rest);
    if (kind == "log_uniform") return log_uniform_of(rest);
    if (kind == "normal") return normal_of(rest);
    if (kind == "choice") return choice_of(rest);
  }
  return tl::unexpected(
      "expected a number up to 1e12, {\"uniform\": [low, high]}, {\"log_uniform\": [low, high]}, {\"normal\": {...}} "
      "or " +
      std::string("{\"choice\": [...]}, found ") + shown(json));
}

std::optional<Quantity> read_quantity(RecipeNode& node, std::string_view name) {
  const Json* const json = node.value(name);
  if (json == nullptr) return std::nullopt;
  const Possible<Quantity> quantity = quantity_of(*json);
  if (quantity) return *quantity;
  node.log().wrong(node.key_of(name), quantity.error());
  return std::nullopt;
}

std::optional<Quantity> quantity_between(RecipeNode& node, std::string_view name, double low, double high) {
  const std::optional<Quantity> quantity = read_quantity(node, name);
  const Span span = quantity ? span_of(*quantity) : Span{low, high};
  if (span.low < low || span.high > high)
    node.log().wrong(node.key_of(name),
                     fmt::format("must lie between {} and {}", short_number_text(low), short_number_text(high)));
  return quantity;
}

std::string name_from(const std::string& pattern, const NameParts& parts) {
  std::string name;
  for (std::size_t i = 0; i < pattern.size();) {
    const std::size_t end = pattern[i] == '{' ? pattern.find('}', i) : std::string::npos;
    const std::optional<std::string> part =
        end == std::string::npos ? std::nullopt : part_of(std::string_view(pattern).substr(i + 1, end - i - 1), parts);
    name += part ? *part : std::string(1, pattern[i]);
    i = part ? end + 1 : i + 1;
  }
  return name;
}

std::string wrong_with_pattern(const std::string& pattern) {
  if (pattern.empty()) return "is empty; it names the videos";
  for (std::size_t begin = pattern.find('{'); begin != std::string::npos; begin = pattern.find('{', begin + 1)) {
    const std::size_t end = pattern.find('}', begin);
    if (end == std::string::npos) return "has a { without a }";
    const std::string part = pattern.substr(begin + 1, end - begin - 1);
    if (std::ranges::count(kParts, part) == 0)
      return "has no such part: {" + part + "}; there are {background}, {aircraft}, {flight} and {number}";
  }
  return {};
}

std::string wrong_with_video_name(const std::string& name) {
  if (std::ranges::count(kOwnNames, lower_case(name)) > 0)
    return "is kept for what the dataset has beside its videos; choose another name";
  return file_name_error(name);
}

}  // namespace sigs
