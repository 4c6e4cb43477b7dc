// SPDX-License-Identifier: MIT
#include "evaluation/readers/clip_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <pugixml.hpp>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace {

// The first frame defines the targets.
Result<void> add_targets(ClipTruth& clip, const std::vector<TargetInFrame>& targets) {
  for (const TargetInFrame& target : targets) {
    if (!clip.targets.empty() && target.id <= clip.targets.back().id) {
      const int before = clip.targets.back().id;
      clip.targets.clear();
      return fail("", fmt::format("intruder {} stands behind intruder {}: they must be in order, each once", target.id,
                                  before));
    }
    clip.targets.push_back({.id = target.id, .name = target.name});
  }
  return {};
}

Result<void> check_targets(const ClipTruth& clip, int index, const std::vector<TargetInFrame>& targets) {
  if (targets.size() != clip.targets.size())
    return fail("", fmt::format("frame {} has {}, the frames before it {}", index,
                                count_text(std::ssize(targets), "intruder"), clip.targets.size()));
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (targets[i].id != clip.targets[i].id)
      return fail("", fmt::format("frame {} has intruder {} where the frames before it have {}", index, targets[i].id,
                                  clip.targets[i].id));
  return {};
}

}  // namespace

void set_geometry(TargetFrame& frame, const glm::dvec3& position_m, const glm::dquat& world_from_camera,
                  const glm::dquat& world_from_body) {
  frame.position_m = position_m;
  frame.offset_m = world_from_camera * position_m;
  frame.aspect_rad = angle_between(world_from_body * glm::dvec3(1, 0, 0), -*frame.offset_m);
}

TargetFrame target_frame_of(const IntruderTruth& truth, const glm::dquat& world_from_camera) {
  TargetFrame frame{.amodal_box = truth.amodal_box,
                    .visible_fraction = truth.visible_fraction,
                    .visible_pixels = truth.visible_pixels,
                    .distance_m = glm::length(truth.position_m),
                    .horizon = truth.horizon};
  if (truth.visible_box) frame.visible = box_of(*truth.visible_box);
  if (truth.detectability) frame.rms_contrast = truth.detectability->rms_contrast;
  if (truth.clouds) frame.cloud_hidden = truth.clouds->hidden;
  set_geometry(frame, truth.position_m, world_from_camera, truth.world_from_body);
  return frame;
}

Box box_of(const cv::Rect& pixels) {
  return {pixels.x - 0.5, pixels.y - 0.5, double(pixels.width), double(pixels.height)};
}

Result<void> add_frame(ClipTruth& clip, int index, double time_s, const std::vector<TargetInFrame>& targets) {
  const int next = clip.footage.first_frame + clip.frames();
  if (index != next) return fail("", fmt::format("frame {} stands where frame {} belongs", index, next));
  const Result<void> known = clip.frames() == 0 ? add_targets(clip, targets) : check_targets(clip, index, targets);
  if (!known) return fail(known.error());
  clip.times_s.push_back(time_s);
  for (std::size_t i = 0; i < targets.size(); ++i) clip.targets[i].frames.push_back(targets[i].frame);
  return {};
}

Result<void> add_frame(ClipTruth& clip, const FrameTruth& truth) {
  std::vector<TargetInFrame> targets;
  targets.reserve(truth.intruders.size());
  for (const IntruderTruth& intruder : truth.intruders)
    if (!intruder.is_distractor)
      targets.push_back(
          {.id = intruder.id, .name = intruder.name, .frame = target_frame_of(intruder, truth.world_from_camera)});
  const Result<void> added = add_frame(clip, truth.index, truth.time_s, targets);
  if (added) clip.camera_positions_m.push_back(truth.camera_position_m);
  return added;
}

namespace {

// Reads attributes of an XML file and keeps the first error, so that callers need not check each of them.
class AttributeReader {
 public:
  AttributeReader(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {}

  [[nodiscard]] bool failed() const { return error_.has_value(); }
  [[nodiscard]] const Error& error() const { return *error_; }

  void wrong(pugi::xml_node node, const std::string& what) {
    if (error_) return;
    const int line = line_at(text_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)));
    error_ = Error{place_of(path_, line), what};
  }

  std::string_view text(pugi::xml_node node, const char* name) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) wrong(node, fmt::format("{} has no attribute {}", node.name(), name));
    return attribute.value();
  }

  double number(pugi::xml_node node, const char* name) {
    const std::string_view value = text(node, name);
    const std::optional<double> number = finite_number(trimmed(value));
    if (!number) wrong(node, fmt::format("{} {}: {} is no number", node.name(), name, in_quotes(value)));
    return number.value_or(0);
  }

  int integer(pugi::xml_node node, const char* name, int min, int max = std::numeric_limits<int>::max()) {
    const std::string_view value = text(node, name);
    const std::optional<int> number = integer_of(trimmed(value));
    if (!number || *number < min || *number > max)
      wrong(node, fmt::format("{} {}: {} is no whole number from {}{}", node.name(), name, in_quotes(value), min,
                              max == std::numeric_limits<int>::max() ? " on" : fmt::format(" to {}", max)));
    return number.value_or(min);
  }

 private:
  const std::filesystem::path& path_;
  const std::string& text_;
  std::optional<Error> error_;
};

constexpr int kMinInt = std::numeric_limits<int>::min();
constexpr int kMaxSide_px = 1 << 20;         // a side of an image; keeps sums of a box within an int
constexpr double kMaxSilhouette_px = 1e100;  // of a silhouette; keeps areas finite

HorizonSide parsed_horizon(AttributeReader& reader, pugi::xml_node intruder) {
  if (!intruder.attribute("horizon")) return HorizonSide::unknown;  // files written before SIGS had the attribute
  const std::string_view name = reader.text(intruder, "horizon");
  const std::optional<HorizonSide> side = horizon_side_named(name);
  if (!side)
    reader.wrong(intruder, fmt::format("intruder horizon: {} is not above, on or below, nor unknown", in_quotes(name)));
  return side.value_or(HorizonSide::unknown);
}

std::optional<Box> visible_of(AttributeReader& reader, pugi::xml_node box) {
  if (!box) return std::nullopt;
  return box_of({reader.integer(box, "x", -kMaxSide_px, kMaxSide_px),
                 reader.integer(box, "y", -kMaxSide_px, kMaxSide_px), reader.integer(box, "width", 1, kMaxSide_px),
                 reader.integer(box, "height", 1, kMaxSide_px)});
}

std::optional<Box> silhouette_of(AttributeReader& reader, pugi::xml_node node) {
  if (!node) return std::nullopt;
  const Box box{reader.number(node, "x"), reader.number(node, "y"), reader.number(node, "width"),
                reader.number(node, "height")};
  if (box.width < 0 || box.height < 0) reader.wrong(node, "silhouette width and height must not be negative");
  for (const double number : {box.x, box.y, box.width, box.height})
    if (std::abs(number) > kMaxSilhouette_px) reader.wrong(node, "silhouette reaches beyond 1e100 pixels");
  return box;
}

glm::dvec3 vector_of(AttributeReader& reader, pugi::xml_node node) {
  return {reader.number(node, "x_m"), reader.number(node, "y_m"), reader.number(node, "z_m")};
}

glm::dquat attitude_in(AttributeReader& reader, pugi::xml_node node) {
  return rotation_of({.roll_rad = rad_of_deg(reader.number(node, "roll_deg")),
                      .pitch_rad = rad_of_deg(reader.number(node, "pitch_deg")),
                      .yaw_rad = rad_of_deg(reader.number(node, "yaw_deg"))});
}

// Files written before SIGS had all of these elements lack some; scoring boxes does not need them.
void read_geometry(AttributeReader& reader, pugi::xml_node intruder, TargetFrame& frame) {
  const pugi::xml_node position = intruder.child("position");
  const pugi::xml_node attitude = intruder.child("attitude");
  const pugi::xml_node camera = intruder.parent().child("camera");
  if (position && attitude && camera)
    set_geometry(frame, vector_of(reader, position), attitude_in(reader, camera), attitude_in(reader, attitude));
  if (const pugi::xml_node clouds = intruder.child("clouds")) frame.cloud_hidden = reader.number(clouds, "hidden");
}

TargetInFrame target_of(AttributeReader& reader, pugi::xml_node intruder) {
  TargetInFrame target{.id = reader.integer(intruder, "id", 0), .name = std::string(reader.text(intruder, "name"))};
  target.frame.visible_fraction = reader.number(intruder, "visible_fraction");
  target.frame.horizon = parsed_horizon(reader, intruder);
  const pugi::xml_node distance = intruder.child("distance");
  if (!distance) reader.wrong(intruder, "intruder has no element distance");
  target.frame.distance_m = reader.number(distance, "m");
  const pugi::xml_node box = intruder.child("box");
  target.frame.visible = visible_of(reader, box);
  if (box.attribute("pixels")) target.frame.visible_pixels = reader.integer(box, "pixels", 0);
  target.frame.amodal_box = silhouette_of(reader, intruder.child("silhouette"));
  if (const pugi::xml_node appearance = intruder.child("appearance"); appearance.attribute("rms_contrast"))
    target.frame.rms_contrast = reader.number(appearance, "rms_contrast");
  read_geometry(reader, intruder, target.frame);
  return target;
}

bool is_distractor(AttributeReader& reader, pugi::xml_node intruder) {
  if (!intruder.attribute("role")) return false;
  const std::string_view role = reader.text(intruder, "role");
  if (role != "distractor" && role != "intruder")
    reader.wrong(intruder, fmt::format("intruder role: {} is neither intruder nor distractor", in_quotes(role)));
  return role == "distractor";
}

// "30000/1001"
void read_rate(AttributeReader& reader, pugi::xml_node node, FootageTruth& footage) {
  const std::string_view rate = reader.text(node, "frame_rate");
  const std::size_t slash = rate.find('/');
  const std::optional<int> num = integer_of(rate.substr(0, slash));
  const std::optional<int> den = slash == std::string_view::npos ? 1 : integer_of(rate.substr(slash + 1));
  if (!num || !den || *num <= 0 || *den <= 0)
    return reader.wrong(node, fmt::format("footage frame_rate: {} is no ratio such as 25/1", in_quotes(rate)));
  footage.frame_rate_num = *num;
  footage.frame_rate_den = *den;
}

FootageTruth footage_of(AttributeReader& reader, pugi::xml_node node) {
  FootageTruth footage{
      .video = std::string(reader.text(node, "video")),
      .size_px = {reader.integer(node, "width", 1, kMaxSide_px), reader.integer(node, "height", 1, kMaxSide_px)},
      .first_frame = reader.integer(node, "first_frame", 0),
      .last_frame = reader.integer(node, "last_frame", 0)};
  read_rate(reader, node, footage);
  if (footage.last_frame < footage.first_frame) reader.wrong(node, "footage last_frame is before its first_frame");
  return footage;
}

void read_frame(AttributeReader& reader, pugi::xml_node node, ClipTruth& clip) {
  const int index = reader.integer(node, "index", kMinInt);
  const double time_s = reader.number(node, "time_s");
  std::vector<TargetInFrame> targets;
  for (const pugi::xml_node intruder : node.children("intruder"))
    if (!is_distractor(reader, intruder)) targets.push_back(target_of(reader, intruder));
  if (reader.failed()) return;
  if (index > clip.footage.last_frame)
    return reader.wrong(node,
                        fmt::format("frame {} is past the footage's last_frame, {}", index, clip.footage.last_frame));
  const Result<void> added = add_frame(clip, index, time_s, targets);
  if (!added) return reader.wrong(node, added.error().what);
  // Of all frames or of none.
  const std::size_t before = clip.times_s.size() - 1;
  if (const pugi::xml_node camera = node.child("camera"); camera && clip.camera_positions_m.size() == before)
    clip.camera_positions_m.push_back(vector_of(reader, camera));
  else
    clip.camera_positions_m.clear();
}

ClipTruth clip_of(AttributeReader& reader, const pugi::xml_document& document) {
  ClipTruth clip;
  const pugi::xml_node root = document.child("sigs");
  const pugi::xml_node footage = root.child("footage");
  if (!footage) reader.wrong(root, "there is no element footage");
  if (!reader.failed()) clip.footage = footage_of(reader, footage);
  for (const pugi::xml_node node : root.children("frame")) {
    if (reader.failed()) return clip;
    read_frame(reader, node, clip);
  }
  const int next = clip.footage.first_frame + clip.frames();
  if (!reader.failed() && next <= clip.footage.last_frame)
    reader.wrong(
        clip.frames() > 0 ? root.last_child() : footage,
        fmt::format("ends before frame {}, but its footage element says last_frame {}", next, clip.footage.last_frame));
  return clip;
}

}  // namespace

Result<ClipTruth> read_truth(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  pugi::xml_document document;
  // The parser works on a copy, so that the text keeps its lines.
  const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
  if (!parsed)
    return fail(place_of(path, line_at(*text, static_cast<std::size_t>(parsed.offset))),
                std::string("is not XML from here on: ") + parsed.description());
  const pugi::xml_node root = document.child("sigs");
  if (!root || std::string_view(root.attribute("version").value()) != "1")
    return fail(path.string(), "is no SIGS annotation file: it does not begin with <sigs version=\"1\">");
  AttributeReader reader(path, *text);
  ClipTruth clip = clip_of(reader, document);
  if (reader.failed()) return fail(reader.error());
  return clip;
}

}  // namespace sigs
