// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evaluation/readers/aot_files.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/truth_builder.h"

namespace sigs {

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
