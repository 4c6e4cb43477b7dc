// SPDX-License-Identifier: MIT
#include "project/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "base/text.h"
#include "camera/lens_model.h"
#include "project/field_list.h"
#include "project/json.h"
#include "project/places.h"

namespace sigs {

namespace {

Choice lens_model_choice(std::optional<LensModel>& model) {
  std::vector<std::string_view> names{"auto"};
  for (const LensModelTraits& traits : lens_models()) names.push_back(traits.word);
  return {
      .names = std::move(names),
      .get = [&model] { return model ? 1 + static_cast<int>(*model) : 0; },
      .set = [&model](
                 int index) { model = index == 0 ? std::nullopt : std::optional(static_cast<LensModel>(index - 1)); }};
}

void add_footage(FieldList list, FootageSettings& footage) {
  list.path("video", footage.video, true,
            "the background: a video of a real flight, or its images: a folder, or a pattern as images/%06d.png");
  list.number("frame_rate", &footage.frame_rate_hz, "Hz", 0.001, 1e6,
              "of footage in images: frames a second; null: 25, with a warning");
  list.path("timestamps", footage.timestamps, false,
            "of footage in images: text file with a line for each, its time in seconds; empty: evenly spaced");
  list.number("first_frame", &footage.first_frame, "frame", 0, 1e9, "first frame that is used, counted from 0");
  list.number("last_frame", &footage.last_frame, "frame", 0, 1e9, "last frame that is used; null: the footage's last");
  list.number(
      "crop.left_px", &footage.crop.left_px, "px", 0, 1e5,
      "the camera's image begins at this column of the footage's, an even one where colour has half as many; the rest "
      "is not used");
  list.number("crop.top_px", &footage.crop.top_px, "px", 0, 1e5, "and at this row, likewise");
  list.number("crop.width_px", &footage.crop.width_px, "px", 0, 1e5, "and has so many columns; 0: all to the right");
  list.number("crop.height_px", &footage.crop.height_px, "px", 0, 1e5, "and so many rows; 0: all below");
  list.path("calibration", footage.calibration, needs_calibration(footage.lens_model),
            "the camera's calibration file; of equirectangular footage none is needed");
  list.add("spectrum", choice_of(footage.spectrum, {"visible", "thermal"}), "",
           "thermal: the camera sees heat; light has no effect, appearance.thermal and intruders[].heat have");
  list.add("palette", choice_of(footage.palette, {kHeatPaletteNames.begin(), kHeatPaletteNames.end()}), "",
           "of thermal footage: the colours in which it shows heat; gray: white-hot or black-hot");
  list.add("lens_model", lens_model_choice(footage.lens_model), "",
           "lens model of the calibration's numbers; auto: as the file says, else as they look; equirectangular: 360 "
           "degree footage");
  list.path("occluder_mask", footage.occluder_mask, false,
            "image of the footage's size, white where trees or hills hide what is farther away; empty: none");
  list.number("occluder_frame", &footage.occluder_frame, "frame", 0, 1e9,
              "frame that the occluder mask was made of; elsewhere it follows the camera's motion");
  list.number("occluder_distance_m", &footage.occluder_distance_m, "m", 0, 1e7,
              "how far the occluder is; nearer intruders are before it; 0: none is");
  list.number("cloud_distance_m", &footage.cloud_distance_m, "m", 0, 1e7,
              "how far the footage's clouds are, which hide what is farther; assumed; null: they hide nothing");
  list.number("cloud_depth_m", &footage.cloud_depth_m, "m", 0, 1e6,
              "how deep into the clouds they hide as much as they do at all");
  list.path("real_aircraft", footage.real_aircraft, false,
            "CSV (frame,label,x,y,w,h) with boxes of real aircraft in the footage, which labels ignore; empty: none");
  list.path("own_body_mask", footage.own_body_mask, false,
            "image of the footage's size, white where the UAV's own body hides the intruder; empty: none");
  list.number("max_substituted_percent", &footage.max_substituted_percent, "%", 0, 100,
              "how many of the exported frames may be damaged, an intact one is used instead; more are an error");
}

void add_own_body(FieldList list, OwnBodySettings& own_body) {
  list.add("method", choice_of(own_body.method, {"stable", "paper"}), "",
           "stable: what stays put while the world moves; paper: section 4 of the paper");
  list.number("frames", &own_body.frames, "frame", 2, 1e9, "how many of the footage's frames are looked through");
  list.number("every", &own_body.every, "frame", 1, 1e6, "of these, each K-th is used; 1: all");
  list.number("settled_percent", &own_body.settled_percent, "%", 0, 100,
              "stop early once the mask changes by less than this; 0: never");
  list.number("soft_edge_px", &own_body.soft_edge_px, "px", 0, 100,
              "width of the mask's edge, from black to white; up to 1: hard");
  list.number("paper.canny_low", &own_body.paper.canny_low, "", 0, 1e6, "lower threshold; 0: as the clip asks for");
  list.number("paper.canny_high", &own_body.paper.canny_high, "", 0, 1e6, "upper threshold; 0: as the clip asks for");
  list.number("paper.dilation_px", &own_body.paper.dilation_px, "px", 0, 1000,
              "diameter by which edges grow before they are filled; 0: as the image's size asks for");
  list.number("paper.closing_px", &own_body.paper.closing_px, "px", 0, 1000,
              "gaps in contours that are closed; 0: as the image's size asks for");
  list.number("paper.min_area_percent", &own_body.paper.min_area_percent, "%", 0, 100,
              "smaller contours are dropped; of the image");
  list.number("stable.vibration_px", &own_body.stable.vibration_px, "px", 0, 50, "how far the body may shake");
  list.number("stable.min_area_percent", &own_body.stable.min_area_percent, "%", 0, 100,
              "smaller parts are dropped; of the image");
  list.number("stable.min_moving_percent", &own_body.stable.min_moving_percent, "%", 0, 100,
              "of the image that has to move, or nothing can be told");
}

void add_camera(FieldList list, CameraSettings& camera) {
  list.number("position_m", &camera.position_m, "m", -kFarthest_m, kFarthest_m,
              "where the camera is at frame 0, in the world");
  list.number("attitude_deg.roll", &camera.roll_deg, "deg", -180, 180, "right side down; null: not known");
  list.number("attitude_deg.pitch", &camera.pitch_deg, "deg", -90, 90, "axis up; null: not known");
  list.number("attitude_deg.yaw", &camera.yaw_deg, "deg", -180, 180, "axis to the right of world X");
  list.path("attitude_file", camera.attitude_file, false,
            "CSV with the attitude, at each frame, of what carries the camera; empty: level");
  list.number("speed_mps", &camera.speed_mps, "m/s", -1000, 1000, "constant speed along world X");
  list.path("track.file", camera.track.file, false,
            "flight log or CSV by which the camera moves and turns; empty: none");
  list.number("track.offset_s", &camera.track.offset_s, "s", -1e9, 1e9, "time in the log at the footage's frame 0");
  list.add("track.position", choice_of(camera.track.position, {"auto", "log", "none"}), "",
           "the log's positions: used where there are some; must be there; left out");
  list.add("track.attitude", choice_of(camera.track.attitude, {"auto", "camera", "airframe", "none"}), "",
           "the log's attitude: the camera's, else the airframe's; or just one of them; or none");
  list.add("track.mount", choice_of(camera.track.mount, {"auto", "attitude_deg", "none"}), "",
           "the mount on what that attitude describes: camera.attitude_deg; none: it is the camera's own; auto: as the "
           "log says, else camera.attitude_deg");
  list.add("track.incomplete", choice_of(camera.track.incomplete, {"refuse", "use"}), "",
           "a log that is damaged or does not cover all frames: an error, or its sound part is used");
  list.number("readout_s", &camera.readout_s, "s", 0, 1,
              "time from the first to the last row of the rolling shutter; null: as the log says, else 0");
  list.number("exposure_s", &camera.exposure_s, "s", 0, 1,
              "how long the shutter is open, for motion blur; null: as the log says, else 0");
}

void add_mount_and_clock(FieldList list, MountSettings& mount, ClockSettings& clock) {
  list.number("mount.position_m", &mount.position_m, "m", -1000, 1000,
              "where it sits on the aircraft: ahead, to the right, down");
  list.number("mount.attitude_deg.roll", &mount.roll_deg, "deg", -180, 180, "right side down");
  list.number("mount.attitude_deg.pitch", &mount.pitch_deg, "deg", -90, 90, "axis up against the aircraft's");
  list.number("mount.attitude_deg.yaw", &mount.yaw_deg, "deg", -180, 180, "axis to the right of the nose");
  list.number("clock.offset_s", &clock.offset_s, "s", -1e6, 1e6,
              "time of the first camera at this one's frame 0; 0 for the first");
  list.number("clock.drift_ppm", &clock.drift_ppm, "ppm", -1e4, 1e4,
              "by how much its seconds are longer than the first camera's");
}

void add_rig_camera(std::vector<Field>& fields, const std::string& prefix, RigCamera& camera) {
  FieldList list(fields, prefix);
  list.add("name", &camera.name, "", "what results and labels call it").required = true;
  add_footage(FieldList(fields, prefix + "footage."), camera.footage);
  add_mount_and_clock(list, camera.mount, camera.clock);
  list.number("readout_s", &camera.readout_s, "s", 0, 1, "as camera.readout_s");
  list.number("exposure_s", &camera.exposure_s, "s", 0, 1, "as camera.exposure_s");
  if (camera.appearance) add_appearance(FieldList(fields, prefix + "appearance."), *camera.appearance);
}

void add_geo(FieldList list, GeoSettings& geo) {
  list.number("latitude_deg", &geo.latitude_deg, "deg", -90, 90,
              "of the world's origin, WGS-84; null: from the camera's log");
  list.number("longitude_deg", &geo.longitude_deg, "deg", -180, 180,
              "of the world's origin, WGS-84; null: from the camera's log");
  list.number("height_m", &geo.height_m, "m", -1e4, 1e5,
              "of the world's plane z = 0 above the ellipsoid; null: from the camera's log, else 0");
  list.number("heading_deg", &geo.heading_deg, "deg", -360, 360,
              "of world X, from true north to the right; null: the camera's at frame 0 by its log");
}

void add_output(FieldList list, ExportSettings& output) {
  list.add("video.codec",
           choice_of(output.codec, {"ffv1", "h264", "hevc", "av1", "mjpeg", "png", "tiff", "jpeg", "raw", "source"}),
           "",
           "ffv1: lossless; h264: small; hevc, av1: smaller, slower; mjpeg; png, tiff, jpeg: numbered images; raw: "
           "uncompressed; source: the footage's own, copied where no intruder is");
  list.add("video.container", choice_of(output.container, {"auto", "mkv", "mp4", "avi", "nut", "y4m"}), "",
           "auto: mkv for ffv1, mp4 for h264, hevc and av1, avi for mjpeg (mkv where the footage's frames are not "
           "evenly spaced), nut for raw");
  list.number("video.crf", &output.crf, "", 0, 63,
              "quality: 0 lossless, 18 visually so, worst is 51 of h264 and hevc, 63 of av1");
  list.number("video.quality", &output.jpeg_quality, "", 1, 100, "quality of jpeg: 1 worst, 100 best");
  list.number("video.max_bit_depth", &output.max_bit_depth, "", 8, 16,
              "samples of more bits are rounded to this many: 8 for players that know no more");
  list.add("masks", choice_of(output.masks, {"none", "video", "png"}), "",
           "opacity of the intruders, as video or images");
  static const std::string label_help = "annotation formats to write: " + listed(kLabelNames);  // a Field keeps no copy
  list.add("labels", &output.labels, "", label_help);
  // Formats that leave nothing out are those without LabelFormat::has_thresholds (engine/labels/labels.h); boxes are
  // widened where they have LabelFormat::widens_boxes.
  list.number("label_min_pixels", &output.label_min_pixels, "px", 1, 1e9,
              "fewer visible pixels: no label; xml, csv and jsonl leave nothing out");
  list.number("label_min_visible_fraction", &output.label_min_visible_fraction, "", 0, 1,
              "less of it to be seen: no label; xml, csv and jsonl leave nothing out");
  list.number("label_box_scale", &output.label_box_scale, "", 1, 10,
              "boxes of coco, yolo and voc: so many times as wide and high as what is visible");
  list.number("label_box_margin_px", &output.label_box_margin_px, "px", 0, 1000,
              "and so much more on each side; annotators often leave 4 to 10");
  list.add("label_rotors", choice_of(output.label_rotors, {"seen", "none"}), "",
           "whether boxes, areas and visible shares hold the blades that can be seen, or the aircraft without rotors");
  list.add("categories", &output.categories, "",
           "categories that labels count, in this order; empty: those of the intruders");
  static const std::string rig_help = "of several cameras, tables for all of them: " + listed(kRigTableNames);
  list.add("rig", &output.rig, "", rig_help);
  static const std::string encounter_help =
      "volumes for the truth of the encounter; empty: none is written: " + listed(kWellClearNames);
  list.add("encounter", &output.encounter, "", encounter_help);
}

}  // namespace

std::vector<Field> fields_of(Project& project) {
  std::vector<Field> fields;
  FieldList(fields, "").add("name", &project.name, "", "what the results are called").required = true;
  if (project.cameras.empty()) add_footage(FieldList(fields, "footage."), project.footage);
  if (project.rig_view) add_mount_and_clock(FieldList(fields, ""), project.rig_view->mount, project.rig_view->clock);
  add_own_body(FieldList(fields, "own_body."), project.own_body);
  add_camera(FieldList(fields, "camera."), project.camera);
  for (std::size_t i = 0; i < project.cameras.size(); ++i)
    add_rig_camera(fields, fmt::format("cameras[{}].", i), project.cameras[i]);
  add_geo(FieldList(fields, "geo."), project.geo);
  add_light(FieldList(fields, "light."), project.light);
  for (std::size_t i = 0; i < project.intruders.size(); ++i)
    add_intruder(fields, fmt::format("intruders[{}].", i), project.intruders[i]);
  add_compositing(FieldList(fields, "compositing."), project.compositing);
  add_appearance(FieldList(fields, "appearance."), project.appearance);
  add_output(FieldList(fields, "export."), project.output);
  return fields;
}

Project default_project_like(const Project& project) {
  Project plain;
  if (project.rig_view) plain.rig_view.emplace();
  for (const RigCamera& camera : project.cameras)
    if (RigCamera& like = plain.cameras.emplace_back(); camera.appearance) like.appearance.emplace();
  for (const IntruderSettings& intruder : project.intruders) {
    IntruderSettings& like = plain.intruders.emplace_back();
    like.model.rotors.resize(intruder.model.rotors.size());
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints)
      if (WaypointSettings& twin = like.trajectory.waypoints.emplace_back(); waypoint.place) twin.place.emplace();
  }
  return plain;
}

namespace {

// Levenshtein's distance: the number of letters to change, add or leave out.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggestion(std::span<const std::string> keys, const std::string& key) {
  std::optional<std::string> nearest;
  std::size_t min_distance = 0;
  for (const std::string& known : keys) {
    const std::size_t distance = edit_distance(known, key);
    if (2 * distance > std::max(known.size(), key.size())) continue;
    if (nearest && distance >= min_distance) continue;
    nearest = known;
    min_distance = distance;
  }
  return nearest ? fmt::format("; did you mean {}?", *nearest) : "";
}

namespace {

std::vector<std::string> keys_of(const std::vector<Field>& fields) {
  std::vector<std::string> keys;
  for (const Field& field : fields) keys.push_back(field.key);
  return keys;
}

Json json_or_text(const std::string& text) {
  if (json_depth(text) > kMaxNesting) return text;
  Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json(text) : json;
}

}  // namespace

Result<void> set_field(Project& project, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    return fail(assignment, "expected key=value, as in camera.speed_mps=30", ErrorKind::usage);
  const std::string key = current_key(assignment.substr(0, equals));
  const std::string text = assignment.substr(equals + 1);
  const std::vector<Field> fields = fields_of(project);
  const auto field = std::find_if(fields.begin(), fields.end(), [&key](const Field& f) { return f.key == key; });
  const bool is_group = std::any_of(fields.begin(), fields.end(), [&key](const Field& f) {
    return f.key.starts_with(key + ".") || f.key.starts_with(key + "[");
  });
  if (is_group) return fail(assignment, "is a group of settings; set one of its members by its key", ErrorKind::usage);
  if (field == fields.end())
    return fail(assignment, "no such setting" + suggestion(keys_of(fields), key), ErrorKind::usage);
  const bool takes_text = std::holds_alternative<std::string*>(field->value) && text != "null";
  const std::string wrong = put_json(takes_text ? Json(text) : json_or_text(text), *field);
  if (!wrong.empty()) return fail(assignment, wrong, ErrorKind::usage);
  place_waypoints(project);
  return {};
}

}  // namespace sigs
