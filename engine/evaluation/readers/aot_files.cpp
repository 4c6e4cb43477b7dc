// SPDX-License-Identifier: MIT
#include "evaluation/readers/aot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "evaluation/readers/json_reading.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/truth_builder.h"

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

namespace {

HorizonSide side_of(const AotObject& object) {
  if (object.above_horizon > 0) return HorizonSide::above;
  // 0 is "across" or "not stated", which the layout does not distinguish.
  return object.above_horizon < 0 ? HorizonSide::below : HorizonSide::on;
}

// "Airplane" of "Airplane12".
std::string class_of(const std::string& id) {
  return id.substr(0, id.find_last_not_of("0123456789") + 1);
}

// The frames of a flight: as many as its metadata state, else those that the file has.
Result<FootageTruth> footage_of_flight(const AotFlight& flight, std::span<const AotObject> objects) {
  FootageTruth footage{
      .video = flight.name, .size_px = flight.size_px, .first_frame = 0, .last_frame = flight.frames - 1};
  if (objects.empty()) return fail("", "has no entity, so its images are not known");
  if (flight.frames != 0)
    if (const Result<void> good = check_length(flight.frames, objects.size(), "metadata.number_of_frames"); !good)
      return fail(good.error());
  const int first = objects.front().frame;
  const int last = objects.back().frame;
  // The original counts from 0; SIGS writes the footage's frames, which may begin later.
  if (flight.frames > 0 && last - first >= flight.frames)
    return fail("", fmt::format("blob.frame goes from {} to {}, but metadata.number_of_frames is {}", first, last,
                                flight.frames));
  if (last >= flight.frames) {
    footage.first_frame = first;
    footage.last_frame = flight.frames > 0 ? first + flight.frames - 1 : last;
  }
  if (first < 0 || footage.last_frame > kMaxClipFrames)
    return fail("", fmt::format("blob.frame {} is not from 0 to {}", first < 0 ? first : last, kMaxClipFrames));
  return footage;
}

Result<TruthClip> clip_of_flight(const AotFlight& flight, std::span<const AotObject> objects,
                                 const std::map<std::string, int>& number_of, const TruthOptions& options) {
  const Result<FootageTruth> footage = footage_of_flight(flight, objects);
  if (!footage) return fail(footage.error());
  if (flight.rate_hz < 0) return fail("", "metadata.fps is below 0");
  TruthBuilder builder(*footage, flight.rate_hz, {}, options);
  FramesOfImages images;
  for (const AotObject& object : objects) {
    const auto [there, is_new] = images.by_name.emplace(object.image, object.frame);
    if (there->second != object.frame)
      return fail("", fmt::format("image {} is both frame {} and frame {}", object.image, there->second, object.frame));
    if (object.id.empty()) continue;
    const AotBox& box = object.box;
    const Result<void> added =
        builder.add({.frame = object.frame,
                     .id = number_of.at(object.id),
                     .name = object.id,
                     .category = class_of(object.id),
                     .box = {box.x_px - box.width_px / 2 - kEdgeFrom0, box.y_px - box.height_px / 2 - kEdgeFrom0,
                             box.width_px, box.height_px},
                     .distance_m = object.range_m.value_or(std::nan("")),
                     .horizon = side_of(object)});
    if (!added) return fail(object.id, added.error().what);
  }
  add_short_names(images);
  return builder.clip(flight.name, std::move(images));
}

}  // namespace

Result<std::vector<TruthClip>> read_aot_clips(const std::filesystem::path& path, const TruthOptions& options) {
  const Result<AotTruth> aot = read_aot_truth(path);
  if (!aot) return fail(aot.error());
  std::vector<TruthClip> clips;
  std::size_t at = 0;
  for (std::size_t flight = 0; flight < aot->flights.size(); ++flight) {
    const std::size_t begin = at;
    std::map<std::string, int> number_of;  // objects of the flight in order of their names
    for (; at < aot->objects.size() && aot->objects[at].flight == static_cast<int>(flight); ++at)
      number_of[aot->objects[at].id] = 0;
    number_of.erase("");
    int next = 0;
    for (auto& [id, number] : number_of) number = next++;
    Result<TruthClip> clip =
        clip_of_flight(aot->flights[flight], std::span(aot->objects).subspan(begin, at - begin), number_of, options);
    if (!clip) {
      const Error& error = clip.error();
      return fail(fmt::format("{}: samples.{}{}", path.string(), aot->flights[flight].name,
                              error.where.empty() ? "" : ", " + error.where),
                  error.what);
    }
    clips.push_back(std::move(*clip));
  }
  return clips;
}

}  // namespace sigs
