// SPDX-License-Identifier: MIT
#include "evaluation/aot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "base/nesting.h"
#include "base/text.h"

namespace sigs {

namespace {

using AotJson = nlohmann::json;

// Reads fields of one file; the first that is wrong is the file's error.
class AotFields {
 public:
  explicit AotFields(std::filesystem::path path) : path_(std::move(path)) {}

  // The document, or nothing.
  [[nodiscard]] Result<AotJson> document() const {
    const Result<std::string> text = read_text(path_);
    if (!text) return fail(text.error());
    if (json_depth(*text) > kMaxNesting) return fail(path_.string(), "is nested too deeply");
    try {
      return AotJson::parse(*text);
    } catch (const AotJson::parse_error& error) {
      return fail(path_.string(), "is no JSON: wrong at " + text_position(*text, error.byte));
    } catch (const AotJson::exception& error) {  // a number that is too large
      return fail(path_.string(), std::string("is no JSON: ") + error.what());
    }
  }

  void enter(std::string place) { place_ = std::move(place); }

  std::string text(const AotJson& object, const char* key) {
    const AotJson* const found = field(object, key);
    if (found == nullptr || !found->is_string()) {
      wrong(key, "is not a text");
      return {};
    }
    return found->get<std::string>();
  }

  double number(const AotJson& object, const char* key) {
    const AotJson* const found = field(object, key);
    const double value = found != nullptr && found->is_number() ? found->get<double>() : std::nan("");
    if (!(std::abs(value) <= 1e9)) wrong(key, "is not a number of a magnitude up to 1e9");
    return value;
  }

  int whole(const AotJson& object, const char* key) {
    const double value = number(object, key);
    if (error_.empty() && value != std::floor(value)) wrong(key, "is not a whole number");
    return error_.empty() ? static_cast<int>(value) : 0;
  }

  static const AotJson* field(const AotJson& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
  }

  AotBox checked(const AotBox& box) {
    if (error_.empty() && !(box.width_px > 0 && box.height_px > 0)) wrong("box", "has no area");
    return box;
  }

  void wrong(const char* key, const char* what) {
    if (error_.empty()) error_ = fmt::format("{}.{} {}", place_, key, what);
  }
  [[nodiscard]] bool is_wrong() const { return !error_.empty(); }
  [[nodiscard]] tl::unexpected<Error> failure() const { return fail(path_.string(), error_); }
  [[nodiscard]] tl::unexpected<Error> failure(const std::string& what) const { return fail(path_.string(), what); }

 private:
  std::filesystem::path path_;
  std::string place_;
  std::string error_;
};

// Left, top, width, height.
AotBox box_of_corner(AotFields& fields, const AotJson& entity) {
  const AotJson* const bb = AotFields::field(entity, "bb");
  std::array<double, 4> edges{};
  bool is_good = bb != nullptr && bb->is_array() && bb->size() == 4;
  for (std::size_t i = 0; is_good && i < 4; ++i) {
    is_good = (*bb)[i].is_number();
    if (is_good) edges[i] = (*bb)[i].get<double>();
    is_good = is_good && std::abs(edges[i]) <= 1e9;
  }
  if (!is_good) {
    fields.wrong("bb", "is not a list of 4 numbers of a magnitude up to 1e9");
    return {};
  }
  return fields.checked({edges[0] + edges[2] / 2, edges[1] + edges[3] / 2, edges[2], edges[3]});
}

AotObject object_of(AotFields& fields, const AotJson& entity, int flight) {
  AotObject object{.flight = flight, .image = fields.text(entity, "img_name")};
  const AotJson* const blob = AotFields::field(entity, "blob");
  if (blob == nullptr) {
    fields.wrong("blob", "is missing");
    return object;
  }
  object.frame = fields.whole(*blob, "frame");
  if (AotFields::field(entity, "id") == nullptr) return object;
  object.id = fields.text(entity, "id");
  if (AotFields::field(*blob, "range_distance_m") != nullptr) object.range_m = fields.number(*blob, "range_distance_m");
  object.box = box_of_corner(fields, entity);
  const AotJson* const labels = AotFields::field(entity, "labels");
  if (labels != nullptr && AotFields::field(*labels, "is_above_horizon") != nullptr)
    object.above_horizon = fields.number(*labels, "is_above_horizon");
  return object;
}

}  // namespace

Result<AotTruth> read_aot_truth(const std::filesystem::path& path) {
  AotFields fields(path);
  const Result<AotJson> document = fields.document();
  if (!document) return fail(document.error());
  const AotJson* const samples = AotFields::field(*document, "samples");
  if (samples == nullptr || !samples->is_object()) return fields.failure("has no object \"samples\" of flights");
  AotTruth truth;
  for (const auto& [flight, sample] : samples->items()) {
    const AotJson* const entities = AotFields::field(sample, "entities");
    if (entities == nullptr || !entities->is_array())
      return fields.failure(fmt::format("samples.{} has no list \"entities\"", flight));
    const auto index = static_cast<int>(truth.flights.size());
    truth.flights.push_back(flight);
    for (std::size_t i = 0; i < entities->size(); ++i) {
      fields.enter(fmt::format("samples.{}.entities[{}]", flight, i));
      truth.objects.push_back(object_of(fields, (*entities)[i], index));
      if (fields.is_wrong()) return fields.failure();
    }
  }
  std::stable_sort(truth.objects.begin(), truth.objects.end(), [](const AotObject& a, const AotObject& b) {
    return std::pair(a.flight, a.frame) < std::pair(b.flight, b.frame);
  });
  return truth;
}

Result<std::vector<AotReport>> read_aot_reports(const std::filesystem::path& path) {
  AotFields fields(path);
  const Result<AotJson> document = fields.document();
  if (!document) return fail(document.error());
  if (!document->is_array()) return fields.failure("is not a list of images");
  std::vector<AotReport> reports;
  int without_track = 0;
  for (std::size_t i = 0; i < document->size(); ++i) {
    const AotJson& image = (*document)[i];
    fields.enter(fmt::format("[{}]", i));
    const std::string name = fields.text(image, "img_name");
    const AotJson* const detections = AotFields::field(image, "detections");
    if (detections == nullptr || !detections->is_array()) fields.wrong("detections", "is not a list");
    for (std::size_t k = 0; !fields.is_wrong() && k < detections->size(); ++k) {
      const AotJson& d = (*detections)[k];
      fields.enter(fmt::format("[{}].detections[{}]", i, k));
      AotReport report{.image = name,
                       .box = fields.checked({fields.number(d, "x"), fields.number(d, "y"), fields.number(d, "w"),
                                              fields.number(d, "h")}),
                       .score = fields.number(d, "s")};
      const char* const track = AotFields::field(d, "track_id") != nullptr ? "track_id" : "object_id";
      report.track = AotFields::field(d, track) != nullptr ? fields.whole(d, track) : --without_track;
      reports.push_back(std::move(report));
    }
    if (fields.is_wrong()) return fields.failure();
  }
  return reports;
}

}  // namespace sigs
