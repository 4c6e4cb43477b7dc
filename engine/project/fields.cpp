// SPDX-License-Identifier: MIT
#include "project/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "base/nesting.h"
#include "base/text.h"
#include "project/json.h"
#include "project/places.h"

namespace sigs {

namespace {

constexpr double kFarthest_m = 1e8;  // farther than any aircraft; beyond it even double metres lose their millimetres

template <class Enum>
Choice choice_of(Enum& value, std::vector<std::string_view> names) {
  return {.names = std::move(names),
          .get = [&value] { return static_cast<int>(value); },
          .set = [&value](int index) { value = static_cast<Enum>(index); }};
}

// Collects fields under a common beginning of their keys.
class FieldList {
 public:
  FieldList(std::vector<Field>& fields, std::string prefix) : fields_(fields), prefix_(std::move(prefix)) {}

  Field& add(std::string_view key, FieldValue value, std::string_view unit, std::string_view help) {
    return fields_.emplace_back(
        Field{.key = prefix_ + std::string(key), .value = std::move(value), .unit = unit, .help = help});
  }

  void number(std::string_view key, FieldValue value, std::string_view unit, double minimum, double maximum,
              std::string_view help) {
    Field& field = add(key, std::move(value), unit, help);
    field.minimum = minimum;
    field.maximum = maximum;
  }

  void path(std::string_view key, std::string& value, bool required, std::string_view help) {
    Field& field = add(key, &value, "", help);
    field.is_path = true;
    field.required = required;
  }

 private:
  std::vector<Field>& fields_;
  std::string prefix_;
};

void add_footage(FieldList list, FootageSettings& footage) {
  list.path("video", footage.video, true,
            "the background: a video of a real flight, or its images: a folder, or a pattern as images/%06d.png");
  list.number("frame_rate", &footage.frame_rate_hz, "Hz", 0.001, 1e6,
              "of footage in images: frames a second; null: 25, with a warning");
  list.path("timestamps", footage.timestamps, false,
            "of footage in images: text file with a line for each, its time in seconds; empty: evenly spaced");
  list.number("first_frame", &footage.first_frame, "frame", 0, 1e9, "first frame that is used, counted from 0");
  list.number("last_frame", &footage.last_frame, "frame", 0, 1e9, "last frame that is used; null: the footage's last");
  list.path("calibration", footage.calibration, true, "the camera's calibration file");
  list.add("spectrum", choice_of(footage.spectrum, {"visible", "thermal"}), "",
           "thermal: the camera sees heat; light has no effect, appearance.thermal and intruders[].heat have");
  list.add("lens_model", choice_of(footage.lens_model, {"auto", "brown_conrady", "fisheye"}), "",
           "lens model of the calibration's numbers; auto: as the file says, else as they look");
  list.path("occluder_mask", footage.occluder_mask, false,
            "image of the footage's size, white where trees or hills hide what is farther away; empty: none");
  list.number("occluder_frame", &footage.occluder_frame, "frame", 0, 1e9,
              "frame that the occluder mask was made of; elsewhere it follows the camera's motion");
  list.number("occluder_distance_m", &footage.occluder_distance_m, "m", 0, 1e7,
              "how far the occluder is; nearer intruders are before it; 0: none is");
  list.path("real_aircraft", footage.real_aircraft, false,
            "CSV (frame,label,x,y,w,h) with boxes of real aircraft in the footage, which labels ignore; empty: none");
  list.path("own_body_mask", footage.own_body_mask, false,
            "image of the footage's size, white where the UAV's own body hides the intruder; empty: none");
  list.number("max_substituted_percent", &footage.max_substituted_percent, "%", 0, 100,
              "how many of the exported frames may be damaged, an intact one is used instead; more are an error");
}

void add_contrail(FieldList list, ContrailSettings& contrail) {
  list.number("strands", &contrail.strands, "", 0, 4, "trails of ice behind a jet, one for each engine; 0: none");
  list.number("length_m", &contrail.length_m, "m", 1, 1e6, "how far behind the aircraft nothing of it is left");
  list.number("width_m", &contrail.width_m, "m", 0.01, 1000, "of a strand where it begins");
  list.number("spread_mps", &contrail.spread_mps, "m/s", 0, 100, "how fast a strand widens: a quarter of its width");
  list.number("opacity", &contrail.opacity, "", 0, 1, "of a strand where it begins, seen from the side");
  list.number("brightness", &contrail.brightness, "", 0, 10, "1: as bright as a white surface squarely in the sun");
}

void add_heat(FieldList list, HeatSettings& heat) {
  list.number("skin", &heat.skin, "code", 0, 10'000, "thermal: how much warmer than the sky its skin looks");
  list.number("engine", &heat.engine, "code", 0, 10'000, "the same of engines, nacelles and cowls");
  list.number("exhaust", &heat.exhaust, "code", 0, 10'000, "of exhausts and nozzles");
  list.number("glass", &heat.glass, "code", 0, 10'000, "of glass, which is opaque to heat");
  list.number("rotor", &heat.rotor, "code", 0, 10'000, "of blades");
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

void add_light(FieldList list, LightSettings& light) {
  list.add("kind", choice_of(light.kind, {"point", "sun"}), "",
           "point: the paper's lamp and ambient light; sun: parallel light, sky and ground");
  list.number("position_m", &light.position_m, "m", -1e12, 1e12,
              "where the light is, in the world; it shines every way");
  list.number("color", &light.color, "", 0, 100, "red, green, blue in linear light; 1: white faces become white");
  list.number("ambient", &light.ambient, "", 0, 1, "share of the light that comes from everywhere");
  list.number("sun.azimuth_deg", &light.sun.azimuth_deg, "deg", -360, 360,
              "sun: from world X to the right; null: by time and place of the camera's log");
  list.number("sun.elevation_deg", &light.sun.elevation_deg, "deg", -90, 90,
              "sun: above the horizon; null: by time and place of the camera's log");
  list.number("sky_color", &light.sky_color, "", 0, 100, "sun: light of the whole sky on a face that looks up");
  list.number("ground_color", &light.ground_color, "", 0, 100, "sun: light of the ground on a face that looks down");
  list.number("exposure", &light.exposure, "", 0, 1000, "sun: factor of all light");
}

void add_model(FieldList list, ModelSettings& model) {
  list.path("file", model.file, true, "the aircraft: a Wavefront OBJ file");
  list.add("forward", &model.forward, "", "axis of the file that points out of the nose: +x -x +y -y +z -z");
  list.add("up", &model.up, "", "axis of the file that points up");
  list.number("scale", &model.scale, "m", 1e-9, 1e9, "metres a unit of the file");
  list.number("length_m", &model.length_m, "m", 0, 1e6, "wanted length from nose to tail; 0: scale says");
  list.add("anchor", choice_of(model.anchor, {"origin", "bounds"}), "",
           "reference point that flies along the trajectory: the file's origin or the centre of its bounds");
}

void add_trajectory(FieldList list, TrajectoryPlan& plan) {
  list.add("spline", choice_of(plan.spline, {"interpolating", "approximating"}), "",
           "through the waypoints, or the paper's uniform B-spline that takes them as control points");
  list.add("timing", choice_of(plan.timing, {"frames", "constant_speed"}), "",
           "at each waypoint in its frame, or along the same curve at one speed");
  list.add(
      "attitude", choice_of(plan.attitude, {"path", "helicopter", "multirotor", "balloon"}), "",
      "path: nose along the path, as airplanes fly; the others: heading apart from it, tilted by the thrust; level");
  list.add("bank", choice_of(plan.bank, {"coordinated", "level"}), "", "bank as in a coordinated turn, or wings level");
  list.number("bank_limit_deg", &plan.bank_limit_deg, "deg", 0, 90, "steepest bank");
}

void add_place(FieldList& list, PlaceSettings& place) {
  list.number("latitude_deg", &place.latitude_deg, "deg", -90, 90, "instead of position_m: where on the Earth, WGS-84");
  list.number("longitude_deg", &place.longitude_deg, "deg", -180, 180, "with latitude_deg");
  list.number("height_m", &place.height_m, "m", -1e4, 1e8, "with latitude_deg: above the ellipsoid");
}

void add_compositing(FieldList list, CompositingSettings& compositing) {
  list.add("method", choice_of(compositing.method, {"direct", "classic", "plain"}), "",
           "direct: layer through the lens; classic: the paper's section 3.2; plain: keyed paste");
  list.add("blend", choice_of(compositing.blend, {"linear", "display"}), "",
           "mix light, or mix code values as the paper does (direct only)");
  list.number("blur_px_per_m", &compositing.blur_px_per_m, "px/m", 0, 10,
              "Gaussian blur: sigma a metre of distance; null: 0.002 with classic, else 0");
  list.number("supersampling", &compositing.supersampling, "", 1, 8, "drawn pixels an image pixel, each way");
}

void add_appearance(FieldList list, AppearanceSettings& appearance) {
  list.number("psf_sigma_px", &appearance.psf_sigma_px, "px", 0, 20, "sigma of the lens' and the sensor's blur");
  list.number("sharpening", &appearance.sharpening, "", 0, 5, "the camera's own: how much of the detail is added");
  list.number("sharpening_px", &appearance.sharpening_px, "px", 0.2, 20, "sigma of the blur that detail is told by");
  list.number("chroma_blur_px", &appearance.chroma_blur_px, "px", 0, 20,
              "blur of the colours alone, in samples of the chroma planes");
  list.number("black", &appearance.black, "", 0, 1, "linear light that is added to all of the intruder: flare");
  list.number("saturation", &appearance.saturation, "", 0, 4, "of the intruder's colours; 1: as painted");
  GrainSettings& grain = appearance.grain;
  list.number("grain.sd_dark", &grain.sd_dark, "code", 0, 64, "noise of luma where the image is black");
  list.number("grain.sd_bright", &grain.sd_bright, "code", 0, 64, "noise of luma where the image is white");
  list.number("grain.sd_chroma", &grain.sd_chroma, "code", 0, 64, "noise of chroma");
  list.number("grain.correlation_length_px", &grain.correlation_length_px, "px", 0, 10,
              "sigma over which neighbours share noise; 0: none");
  list.number("grain.temporal_correlation", &grain.temporal_correlation, "", 0, 0.99,
              "correlation of the noise from frame to frame");
  list.number("grain.seed", &grain.seed, "", 0, 2e9, "another number gives other noise of the same kind");
  HazeSettings& haze = appearance.haze;
  list.number("haze.visibility_m", &haze.visibility_m, "m", 0.1, 1e7,
              "distance at which 5 % of the contrast is left; null: clear air");
  list.add("haze.airlight", choice_of(haze.airlight, {"behind", "color"}), "",
           "colour of the haze: as the footage is around the intruder, or airlight_color");
  list.number("haze.airlight_color", &haze.airlight_color, "", 0, 100, "red, green, blue in linear light");
  ThermalSettings& thermal = appearance.thermal;
  list.number("thermal.sky", &thermal.sky, "code", 0, 255, "thermal: code value of the clear sky");
  list.add("thermal.hot", choice_of(thermal.hot, {"white", "black"}), "", "thermal: how what is warm is shown");
  list.number("thermal.halo", &thermal.halo, "", 0, 5,
              "thermal: how much the camera takes away of the mean around each place; 0: no halo");
  list.number("thermal.halo_px", &thermal.halo_px, "px", 0.2, 100, "thermal: sigma of the blur that this mean is of");
  list.add("codec.match", choice_of(appearance.codec.match, {"none", "footage", "h264", "mjpeg"}), "",
           "codec that the image around the intruder goes through once; footage: its own");
  list.number("codec.quantiser", &appearance.codec.quantiser, "", 0, 100,
              "QP of H.264, 0 to 51, or quality of MJPEG in percent; null: as the footage's stream says");
  list.number("codec.predicted_frames", &appearance.codec.predicted_frames, "", 0, 16,
              "frames before this one from which H.264 and MPEG carry what they left");
}

void add_output(FieldList list, ExportSettings& output) {
  list.add("video.codec",
           choice_of(output.codec, {"ffv1", "h264", "hevc", "av1", "mjpeg", "png", "tiff", "jpeg", "raw"}), "",
           "ffv1: lossless; h264: small; hevc, av1: smaller, slower; mjpeg; png, tiff, jpeg: numbered images; raw: "
           "uncompressed");
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
  // Formats that leave nothing out are those without LabelFormat::has_thresholds (engine/labels/labels.h).
  list.number("label_min_pixels", &output.label_min_pixels, "px", 1, 1e9,
              "fewer visible pixels: no label; xml, csv and jsonl leave nothing out");
  list.number("label_min_visible_fraction", &output.label_min_visible_fraction, "", 0, 1,
              "less of it to be seen: no label; xml, csv and jsonl leave nothing out");
  list.number("label_box_scale", &output.label_box_scale, "", 1, 10,
              "boxes of coco, yolo and voc: so many times as wide and high as what is visible");
  list.number("label_box_margin_px", &output.label_box_margin_px, "px", 0, 1000,
              "and so much more on each side; annotators often leave 4 to 10");
  list.add("categories", &output.categories, "",
           "categories that labels count, in this order; empty: those of the intruders");
  static const std::string encounter_help =
      "volumes for the truth of the encounter; empty: none is written: " + listed(kWellClearNames);
  list.add("encounter", &output.encounter, "", encounter_help);
}

}  // namespace

std::vector<Field> fields_of(Project& project) {
  std::vector<Field> fields;
  FieldList(fields, "").add("name", &project.name, "", "what the results are called").required = true;
  add_footage(FieldList(fields, "footage."), project.footage);
  add_own_body(FieldList(fields, "own_body."), project.own_body);
  add_camera(FieldList(fields, "camera."), project.camera);
  add_geo(FieldList(fields, "geo."), project.geo);
  add_light(FieldList(fields, "light."), project.light);
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    IntruderSettings& intruder = project.intruders[i];
    const std::string prefix = fmt::format("intruders[{}].", i);
    FieldList(fields, prefix).add("name", &intruder.name, "", "what the annotations call it");
    FieldList(fields, prefix).add("category", &intruder.category, "", "what kind of thing labels call it").required =
        true;
    FieldList(fields, prefix)
        .add("role", choice_of(intruder.role, {"intruder", "distractor"}), "",
             "distractor: what detectors should not report, such as a bird; evaluation counts it as no intruder");
    add_model(FieldList(fields, prefix + "model."), intruder.model);
    add_contrail(FieldList(fields, prefix + "contrail."), intruder.contrail);
    add_heat(FieldList(fields, prefix + "heat."), intruder.heat);
    add_trajectory(FieldList(fields, prefix + "trajectory."), intruder.trajectory);
    for (std::size_t j = 0; j < intruder.trajectory.waypoints.size(); ++j) {
      WaypointSettings& waypoint = intruder.trajectory.waypoints[j];
      FieldList list(fields, fmt::format("{}trajectory.waypoints[{}].", prefix, j));
      list.number("frame", &waypoint.frame, "frame", -1e9, 1e9, "frame at which it is passed; none: spread evenly");
      list.number(
          "heading_deg", &waypoint.heading_deg, "deg", -360, 360,
          "of the nose, from world X to the right; null: between those of others, else the path's; not of path");
      list.number("position_m", &waypoint.position_m, "m", -kFarthest_m, kFarthest_m, "where, in the world");
      if (waypoint.place) add_place(list, *waypoint.place);
    }
  }
  add_compositing(FieldList(fields, "compositing."), project.compositing);
  add_appearance(FieldList(fields, "appearance."), project.appearance);
  add_output(FieldList(fields, "export."), project.output);
  return fields;
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

std::optional<std::string> near_key(std::span<const std::string> keys, const std::string& key) {
  std::optional<std::string> nearest;
  std::size_t min_distance = 0;
  for (const std::string& known : keys) {
    const std::size_t distance = edit_distance(known, key);
    if (2 * distance > std::max(known.size(), key.size())) continue;
    if (nearest && distance >= min_distance) continue;
    nearest = known;
    min_distance = distance;
  }
  return nearest;
}

std::string suggestion(std::span<const std::string> keys, const std::string& key) {
  const std::optional<std::string> near = near_key(keys, key);
  return near ? fmt::format("; did you mean {}?", *near) : "";
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
  const std::string where = "--set " + assignment;
  if (equals == std::string::npos || equals == 0)
    return fail(where, "expected key=value, as in camera.speed_mps=30", ErrorKind::usage);
  const std::string key = current_key(assignment.substr(0, equals));
  const std::string text = assignment.substr(equals + 1);
  const std::vector<Field> fields = fields_of(project);
  const auto field = std::find_if(fields.begin(), fields.end(), [&key](const Field& f) { return f.key == key; });
  const bool is_group = std::any_of(fields.begin(), fields.end(), [&key](const Field& f) {
    return f.key.starts_with(key + ".") || f.key.starts_with(key + "[");
  });
  if (is_group) return fail(where, "is a group of settings; set one of its members by its key", ErrorKind::usage);
  if (field == fields.end()) return fail(where, "no such setting" + suggestion(keys_of(fields), key), ErrorKind::usage);
  const bool takes_text = std::holds_alternative<std::string*>(field->value) && text != "null";
  const std::string wrong = put_json(takes_text ? Json(text) : json_or_text(text), *field);
  if (!wrong.empty()) return fail(where, wrong, ErrorKind::usage);
  place_waypoints(project);
  return {};
}

}  // namespace sigs
