// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/input_file.h"
#include "base/json.h"
#include "base/staged_outputs.h"
#include "performance/sensor_model.h"

namespace sigs {

std::optional<FieldOfView> field_of_view_of(
    const std::function<std::optional<glm::dvec3>(double x_px, double y_px)>& ray_of_pixel, cv::Size size_px) {
  const double x = (size_px.width - 1) / 2.0, y = (size_px.height - 1) / 2.0;
  const std::optional<glm::dvec3> left = ray_of_pixel(-0.5, y), right = ray_of_pixel(size_px.width - 0.5, y);
  const std::optional<glm::dvec3> up = ray_of_pixel(x, -0.5), down = ray_of_pixel(x, size_px.height - 0.5);
  if (!left || !right || !up || !down) return std::nullopt;
  return FieldOfView{.left_rad = angles_of(*left).x,
                     .right_rad = angles_of(*right).x,
                     .down_rad = angles_of(*down).y,
                     .up_rad = angles_of(*up).y};
}

ViewClass view_class_of(HorizonSide horizon, double aspect_rad) {
  constexpr double kQuarter = std::numbers::pi / 4;
  return {.horizon = horizon == HorizonSide::on      ? 1
                     : horizon == HorizonSide::below ? 2
                                                     : 0,
          .aspect = aspect_rad > 3 * kQuarter ? 2
                    : aspect_rad >= kQuarter  ? 1
                                              : 0};
}

double SensorModel::quantile_at(double place_m, HorizonSide horizon, double aspect_rad) const {
  if (range_m.empty() || !(place_m <= range_m.back())) return -std::numeric_limits<double>::infinity();
  const ViewClass at = view_class_of(horizon, aspect_rad);
  const double shift = std::array{0.0, on_horizon, below_horizon}.at(static_cast<std::size_t>(at.horizon)) +
                       std::array{0.0, from_side, from_behind}.at(static_cast<std::size_t>(at.aspect));
  if (place_m <= range_m.front()) return quantiles.front() + shift;
  const auto next = static_cast<std::size_t>(std::ranges::lower_bound(range_m, place_m) - range_m.begin());
  const double part = std::log(place_m / range_m[next - 1]) / std::log(range_m[next] / range_m[next - 1]);
  return quantiles[next - 1] + part * (quantiles[next] - quantiles[next - 1]) + shift;
}

double SensorModel::probability(double place_m, HorizonSide horizon, double aspect_rad) const {
  return normal_share_below(quantile_at(place_m, horizon, aspect_rad));
}

double normal_number(Random& random) {
  return normal_quantile(random.uniform() + 0x1p-54);
}

SensorDraw::SensorDraw(const SensorModel& model, Random& random)
    : model_(model), encounter_(normal_number(random)), fading_(normal_number(random)) {}

bool SensorDraw::detects(double quantile, double step_s, Random& random) {
  const double keep = model_.correlation_s > 0 ? std::exp(-step_s / model_.correlation_s) : 0;
  fading_ = keep * fading_ + std::sqrt(1 - keep * keep) * normal_number(random);
  const double rest = std::max(0.0, 1 - model_.encounter_share - model_.fading_share);
  const double noise = std::sqrt(model_.encounter_share) * encounter_ + std::sqrt(model_.fading_share) * fading_ +
                       std::sqrt(rest) * normal_number(random);
  return quantile + noise > 0;
}

bool SensorDraw::is_declared(bool is_detected) {
  last_ = (last_ << 1) | (is_detected ? 1 : 0);
  const std::uint64_t window =
      model_.declare_window >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << model_.declare_window) - 1;
  return std::popcount(last_ & window) >= model_.declare_hits;
}

namespace {

constexpr double kSurest = 6;  // quantiles in files: P within 1e-9 of 0 and 1

double rounded(double number) {
  return std::stod(fmt::format("{:.6g}", number));
}

// Reads members of a JSON object and keeps the first error, so that callers need not check each of them.
class MemberReader {
 public:
  MemberReader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  [[nodiscard]] bool has(const char* name) {
    known_.insert(name);
    return json_.contains(name) && !json_[name].is_null();
  }

  // A member that nobody asked for is a misspelt one.
  void check_unknown() {
    for (const auto& [name, value] : json_.items())
      if (!known_.contains(name) && name != "about") wrong(name, "is no member; docs/risk.md lists them");
  }

  double number(const char* name, double low, double high, std::optional<double> otherwise = {}) {
    if (!has(name) && otherwise) return *otherwise;
    if (!has(name) || !json_[name].is_number()) return wrong(name, "must be a number"), 0;
    const double value = json_[name].get<double>();
    if (!(value >= low && value <= high))
      wrong(name, fmt::format("must be from {:g} to {:g}, is {}", low, high, shown(json_[name])));
    return value;
  }

  std::vector<double> numbers(const char* name, double low, double high) {
    std::vector<double> values;
    if (!has(name) || !json_[name].is_array() || json_[name].empty())
      return wrong(name, "must be a list of numbers"), values;
    for (const Json& value : json_[name]) {
      if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high)) {
        wrong(name, fmt::format("must have numbers from {:g} to {:g}, has {}", low, high, shown(value)));
        return values;
      }
      values.push_back(value.get<double>());
    }
    return values;
  }

  MemberReader object(const char* name) {
    static const Json kNothing = Json::object();
    if (has(name) && json_[name].is_object()) return {json_[name], place_ + "." + name};
    if (has(name)) wrong(name, "must be an object");
    return {kNothing, place_ + "." + name};
  }

  // When all of it was read.
  void take_error(MemberReader& other) {
    other.check_unknown();
    if (!error_) error_ = other.error_;
  }
  void wrong(const std::string& name, const std::string& what) {
    if (!error_) error_ = Error{place_ + "." + name, what};
  }

 private:
  const Json& json_;
  std::string place_;
  std::set<std::string, std::less<>> known_;
  std::optional<Error> error_;
};

void read_detection(MemberReader& root, SensorModel& model) {
  MemberReader detection = root.object("detection");
  model.range_m = detection.numbers("range_m", 1e-3, 1e9);
  const std::vector<double> shares = detection.numbers("probability", 0, 1);
  for (std::size_t i = 1; i < model.range_m.size(); ++i)
    if (!(model.range_m[i] > model.range_m[i - 1]))
      detection.wrong("range_m", "must rise from each number to the next");
  if (shares.size() != model.range_m.size()) detection.wrong("probability", "must have a number for each of range_m");
  for (const double share : shares) model.quantiles.push_back(std::clamp(normal_quantile(share), -kSurest, kSurest));
  MemberReader shift = detection.object("shift");
  model.on_horizon = shift.number("on_horizon", -20, 20, 0);
  model.below_horizon = shift.number("below_horizon", -20, 20, 0);
  model.from_side = shift.number("from_side", -20, 20, 0);
  model.from_behind = shift.number("from_behind", -20, 20, 0);
  detection.take_error(shift);
  MemberReader noise = root.object("correlation");
  model.encounter_share = noise.number("encounter_share", 0, 1, 0);
  model.fading_share = noise.number("fading_share", 0, 1, 0);
  model.correlation_s = noise.number("time_s", 0, 1e6, 1);
  if (model.encounter_share + model.fading_share > 1 + 1e-9)
    noise.wrong("fading_share", "and encounter_share must not add up to more than 1");
  root.take_error(detection);
  root.take_error(noise);
}

void read_field(MemberReader& root, SensorModel& model) {
  model.is_field_known = root.has("field_of_view_deg");
  if (!model.is_field_known) return;
  MemberReader field = root.object("field_of_view_deg");
  model.field_of_view = {.left_rad = rad_of_deg(field.number("left", -180, 180)),
                         .right_rad = rad_of_deg(field.number("right", -180, 180)),
                         .down_rad = rad_of_deg(field.number("down", -90, 90)),
                         .up_rad = rad_of_deg(field.number("up", -90, 90))};
  if (model.field_of_view.left_rad > model.field_of_view.right_rad)
    field.wrong("left", "must not be greater than right");
  if (model.field_of_view.down_rad > model.field_of_view.up_rad) field.wrong("down", "must not be greater than up");
  root.take_error(field);
}

}  // namespace

std::string sensor_model_json(const SensorModel& model) {
  Json ranges = Json::array(), shares = Json::array();
  for (std::size_t i = 0; i < model.range_m.size(); ++i) {
    ranges.push_back(rounded(model.range_m[i]));
    shares.push_back(rounded(normal_share_below(model.quantiles[i])));
  }
  Json json{{"sigs_sensor_model", 1},
            {"detector", model.detector},
            {"encounters", model.encounters},
            {"frames", model.frames},
            {"frame_rate_hz", rounded(model.rate_hz)},
            {"declare", {{"hits", model.declare_hits}, {"window", model.declare_window}}},
            {"latency_s", model.latency_s}};
  const auto degrees = [](double angle_rad) { return rounded(deg_of_rad(angle_rad)); };
  if (model.is_field_known)
    json["field_of_view_deg"] = {{"left", degrees(model.field_of_view.left_rad)},
                                 {"right", degrees(model.field_of_view.right_rad)},
                                 {"down", degrees(model.field_of_view.down_rad)},
                                 {"up", degrees(model.field_of_view.up_rad)}};
  json["detection"] = {{"range_m", ranges},
                       {"probability", shares},
                       {"shift",
                        {{"on_horizon", rounded(model.on_horizon)},
                         {"below_horizon", rounded(model.below_horizon)},
                         {"from_side", rounded(model.from_side)},
                         {"from_behind", rounded(model.from_behind)}}}};
  json["correlation"] = {{"encounter_share", model.encounter_share},
                         {"fading_share", model.fading_share},
                         {"time_s", rounded(model.correlation_s)}};
  json["errors"] = {{"bearing_bias_deg", degrees(model.bearing_bias_rad)},
                    {"bearing_sd_deg", degrees(model.bearing_sd_rad)},
                    {"elevation_bias_deg", degrees(model.elevation_bias_rad)},
                    {"elevation_sd_deg", degrees(model.elevation_sd_rad)},
                    {"range_sd", model.range_sd ? Json(rounded(*model.range_sd)) : Json(nullptr)}};
  json["false_tracks_per_hour"] =
      model.false_tracks_per_hour ? Json(rounded(*model.false_tracks_per_hour)) : Json(nullptr);
  return json_text(json);
}

Result<SensorModel> read_sensor_model(const std::filesystem::path& file) {
  const Result<std::string> text = read_text(file);
  return text ? sensor_model_of(*text, file.string()) : fail(text.error());
}

Result<SensorModel> sensor_model_of(const std::string& text, const std::string& file) {
  const Result<Json> json = parsed_json(text, file, ErrorKind::bad_data);
  if (!json) return fail(json.error());
  if (!json->is_object() || json->value("sigs_sensor_model", Json()) != 1)
    return fail(file,
                "is no sensor model: it has no \"sigs_sensor_model\": 1; sigs evaluate performance --out DIR writes "
                "one, DIR/sensor.json");
  SensorModel model;
  MemberReader root(*json, file + ": sensor model");
  if (root.has("detector") && (*json)["detector"].is_string()) model.detector = (*json)["detector"];
  model.encounters = static_cast<int>(root.number("encounters", 0, 1e9, 0));
  model.frames = static_cast<int>(root.number("frames", 0, 2e9, 0));
  model.rate_hz = root.number("frame_rate_hz", 0.01, 1000);
  model.latency_s = root.number("latency_s", 0, 1e4, 0);
  MemberReader declare = root.object("declare");
  model.declare_hits = static_cast<int>(declare.number("hits", 1, 64, 3));
  model.declare_window = static_cast<int>(declare.number("window", 1, 64, 5));
  if (model.declare_hits > model.declare_window) declare.wrong("hits", "must not be more than window");
  root.take_error(declare);
  read_field(root, model);
  read_detection(root, model);
  MemberReader errors = root.object("errors");
  model.bearing_bias_rad = rad_of_deg(errors.number("bearing_bias_deg", -180, 180, 0));
  model.bearing_sd_rad = rad_of_deg(errors.number("bearing_sd_deg", 0, 180, 0));
  model.elevation_bias_rad = rad_of_deg(errors.number("elevation_bias_deg", -180, 180, 0));
  model.elevation_sd_rad = rad_of_deg(errors.number("elevation_sd_deg", 0, 180, 0));
  if (errors.has("range_sd")) model.range_sd = errors.number("range_sd", 0, 100);
  root.take_error(errors);
  if (root.has("false_tracks_per_hour")) model.false_tracks_per_hour = root.number("false_tracks_per_hour", 0, 1e9);
  (void)root.has("sigs_sensor_model");
  root.check_unknown();
  if (root.error()) return fail(*root.error());
  return model;
}

}  // namespace sigs
