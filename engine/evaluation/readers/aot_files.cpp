// SPDX-License-Identifier: MIT
#include "evaluation/readers/aot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "evaluation/readers/json_fields.h"

namespace sigs {

namespace {

AotBox checked(JsonFields& fields, const AotBox& box) {
  if (!fields.is_wrong() && !(box.width_px > 0 && box.height_px > 0)) fields.wrong("box", "has no area");
  return box;
}

// Left, top, width, height.
AotBox box_of_corner(JsonFields& fields, const Json& entity) {
  const std::array<double, 4> edges = fields.four_numbers(entity, "bb");
  if (fields.is_wrong()) return {};
  return checked(fields, {edges[0] + edges[2] / 2, edges[1] + edges[3] / 2, edges[2], edges[3]});
}

// What the metadata state, where they do; whether it can be true is for those to check who use it.
AotFlight flight_of(JsonFields& fields, const std::string& name, const Json& sample) {
  AotFlight flight{.name = name};
  const Json* const metadata = JsonFields::field(sample, "metadata");
  if (metadata == nullptr) return flight;
  fields.enter(fmt::format("samples.{}.metadata", name));
  flight.rate_hz = fields.optional_number(*metadata, "fps").value_or(0);
  flight.frames = fields.optional_whole(*metadata, "number_of_frames").value_or(0);
  if (const Json* const size = JsonFields::field(*metadata, "resolution"))
    flight.size_px = {fields.whole(*size, "width"), fields.whole(*size, "height")};
  return flight;
}

AotObject object_of(JsonFields& fields, const Json& entity, int flight) {
  AotObject object{.flight = flight, .image = fields.text(entity, "img_name")};
  const Json* const blob = JsonFields::field(entity, "blob");
  if (blob == nullptr) {
    fields.wrong("blob", "is missing");
    return object;
  }
  object.frame = fields.whole(*blob, "frame");
  if (JsonFields::field(entity, "id") == nullptr) return object;
  object.id = fields.text(entity, "id");
  object.range_m = fields.optional_number(*blob, "range_distance_m");
  object.box = box_of_corner(fields, entity);
  if (const Json* const labels = JsonFields::field(entity, "labels"))
    object.above_horizon = fields.optional_number(*labels, "is_above_horizon").value_or(0);
  return object;
}

}  // namespace

Result<AotTruth> read_aot_truth(const std::filesystem::path& path) {
  JsonFields fields(path);
  const Result<Json> document = fields.document();
  if (!document) return fail(document.error());
  const Json* const samples = JsonFields::field(*document, "samples");
  if (samples == nullptr || !samples->is_object()) return fields.failure("has no object \"samples\" of flights");
  std::map<std::string, const Json*> by_name;
  for (const auto& [flight, sample] : samples->items()) by_name[flight] = &sample;
  AotTruth truth;
  for (const auto& [flight, sample] : by_name) {
    const Json* const entities = JsonFields::field(*sample, "entities");
    if (entities == nullptr || !entities->is_array())
      return fields.failure(fmt::format("samples.{} has no list \"entities\"", flight));
    const auto index = static_cast<int>(truth.flights.size());
    truth.flights.push_back(flight_of(fields, flight, *sample));
    if (fields.is_wrong()) return fields.failure();
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
  JsonFields fields(path);
  const Result<Json> document = fields.document();
  if (!document) return fail(document.error());
  if (!document->is_array()) return fields.failure("is not a list of images");
  std::vector<AotReport> reports;
  int without_track = 0;
  for (std::size_t i = 0; i < document->size(); ++i) {
    const Json& image = (*document)[i];
    fields.enter(fmt::format("[{}]", i));
    const std::string name = fields.text(image, "img_name");
    const Json* const detections = JsonFields::field(image, "detections");
    if (detections == nullptr || !detections->is_array()) fields.wrong("detections", "is not a list");
    for (std::size_t k = 0; !fields.is_wrong() && k < detections->size(); ++k) {
      const Json& d = (*detections)[k];
      fields.enter(fmt::format("[{}].detections[{}]", i, k));
      AotReport report{.image = name,
                       .box = checked(fields, {fields.number(d, "x"), fields.number(d, "y"), fields.number(d, "w"),
                                               fields.number(d, "h")}),
                       .score = fields.number(d, "s")};
      const char* const track = JsonFields::field(d, "track_id") != nullptr ? "track_id" : "object_id";
      report.track = JsonFields::field(d, track) != nullptr ? fields.whole(d, track) : --without_track;
      reports.push_back(std::move(report));
    }
    if (fields.is_wrong()) return fields.failure();
  }
  return reports;
}

}  // namespace sigs
