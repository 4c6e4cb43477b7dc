// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "project/camera_settings.h"
#include "project/look_settings.h"
#include "spline/trajectory.h"
#include "video/video_writer.h"

namespace sigs {

// The contents of a project file: numbers, names and paths; nothing is opened. The members are described, with unit and
// range, in fields.cpp and docs/project-format.md. Those of footage
// and cameras are in camera_settings.h, those of the look in look_settings.h.

// What lights the intruders: the paper's omnidirectional point light (section 3.1.2) with ambient light, or the sun
// with the light of sky and ground.
enum class LightKind { point, sun };

// The sun's direction. Without azimuth and elevation it follows from the time and the place that the camera's log has.
struct SunSettings {
  std::optional<double> azimuth_deg;    // from world X to the right
  std::optional<double> elevation_deg;  // above the horizon

  [[nodiscard]] bool operator==(const SunSettings&) const = default;
};

// Colours are linear light: 1 makes a white face that it falls on squarely white.
struct LightSettings {
  LightKind kind = LightKind::point;
  glm::dvec3 position_m{-2000, 1000, -3000};  // of the point light, world
  glm::dvec3 color{1, 1, 1};                  // of the point light or of the sun
  double ambient = 0.35;                      // share of the point light that comes from everywhere
  SunSettings sun;
  glm::dvec3 sky_color{0.25, 0.3, 0.38};      // with the sun: what the whole sky gives a face that looks up
  glm::dvec3 ground_color{0.12, 0.12, 0.10};  // with the sun: what the ground gives a face that looks down
  double exposure = 1;                        // with the sun: factor of all light
  double ground_shadow = 0;                   // with the sun: what an intruder's shadow takes of the ground's light
  std::optional<double> white_cdpm2;          // luminance that the footage shows as white; none: by a sunny day

  [[nodiscard]] bool operator==(const LightSettings&) const = default;
};

// The point of the model that flies along the trajectory: the file's origin or the centre of its bounds.
enum class AnchorChoice { origin, bounds };

// The aircraft's model: file, axes and size (ModelAxes in mesh/mesh.h).
// Blades that turn, in place of a part of the model (docs/rotors.md). Body axes: forward, right, down.
struct RotorSettings {
  std::string part;
  int blades = 2;
  std::optional<double> rpm{};
  double chord_m = 0;
  double radius_m = 0;
  double phase_deg = 0;
  double coning_deg = 0;
  glm::dvec3 axis{0, 0, 0};
  glm::dvec3 hub_m{0, 0, 0};
  std::string unknown_json{};

  [[nodiscard]] bool operator==(const RotorSettings&) const = default;
};

struct ModelSettings {
  std::string file;
  std::string forward = "+x";
  std::string up = "+z";
  double scale = 1.0;
  double length_m = 0;  // 0: scale is used
  AnchorChoice anchor = AnchorChoice::origin;
  double gloss = 1;
  std::vector<RotorSettings> rotors;

  [[nodiscard]] bool operator==(const ModelSettings&) const = default;
};

// A place on the Earth (WGS-84) as a project file has it.
struct PlaceSettings {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;  // above the ellipsoid

  [[nodiscard]] bool operator==(const PlaceSettings&) const = default;
};

// A point of the trajectory in the world, and the frame at which it is passed.
struct WaypointSettings {
  std::optional<double> frame;  // none: spread evenly between its neighbours
  glm::dvec3 position_m{0, 0, 0};
  std::optional<double> heading_deg = {};   // of the nose, for what does not fly along its nose; none: by the others
  std::optional<PlaceSettings> place = {};  // where the file gives it so; position_m follows it (project/places.h)
  std::string unknown_json;                 // unknown keys of the file, as JSON; kept on save

  [[nodiscard]] bool operator==(const WaypointSettings&) const = default;
};

// The flight of an intruder, as it is planned: spline/trajectory.h computes the trajectory from it.
struct TrajectoryPlan {
  SplineKind spline = SplineKind::interpolating;
  Timing timing = Timing::frames;
  AttitudeKind attitude = AttitudeKind::path;
  Bank bank = Bank::coordinated;
  double bank_limit_deg = 60;
  std::vector<WaypointSettings> waypoints;

  [[nodiscard]] bool operator==(const TrajectoryPlan&) const = default;
};

// The trail of ice behind a jet (docs/contrails.md).
struct ContrailSettings {
  int strands = 0;          // 0: none; 1 to 4, one for each engine
  double length_m = 4000;   // behind which nothing of it is left
  double width_m = 4;       // of a strand where it begins: four sigmas of its profile
  double spread_mps = 1;    // by which sigma grows with age
  double opacity = 0.5;     // of a strand's middle where it begins, seen from the side, 0..1
  double brightness = 0.5;  // of a white surface squarely in the sun

  [[nodiscard]] bool operator==(const ContrailSettings&) const = default;
};

// The lights that an aircraft shows (docs/aircraft-lights.md). Intensities of 0: it shows none.
struct LampSettings {
  double position_cd = 0;          // of red and green straight ahead; the white one astern has half
  double strobe_cd = 0;            // effective intensity of the white flashes at wing tips and tail
  double beacon_cd = 0;            // likewise of the red ones above and below
  double landing_cd = 0;           // of the beam's middle
  double landing_beam_deg = 12;    // its full width at half of the intensity
  double flashes_per_minute = 60;  // of strobes and beacons, by turns
  double flash_s = 0.001;          // how long one flash lasts
  double phase = 0;                // of the first strobe's flash at time 0, in flashes

  [[nodiscard]] bool is_dark() const { return position_cd <= 0 && strobe_cd <= 0 && beacon_cd <= 0 && landing_cd <= 0; }
  [[nodiscard]] bool operator==(const LampSettings&) const = default;
};

// How much warmer than the clear sky the parts of an aircraft look to a thermal camera, in 8-bit code values before
// they clip (docs/thermal.md). Which part a surface belongs to is told by its material.
struct HeatSettings {
  double skin = 260;
  double engine = 360;
  double exhaust = 460;
  double glass = 210;
  double rotor = 160;

  [[nodiscard]] bool operator==(const HeatSettings&) const = default;
};

// What a detector should make of it: an intruder, or something else in the air that it should not report, such as a
// bird, which labels state with its own category.
enum class RoleChoice { intruder, distractor };

// One intruder: its name in the annotations, its category in the labels, its model and its flight.
struct IntruderSettings {
  std::string name = "intruder";
  std::string category = "airplane";
  RoleChoice role = RoleChoice::intruder;
  ModelSettings model;
  ContrailSettings contrail;
  LampSettings lights;
  HeatSettings heat;  // used with Spectrum::thermal
  TrajectoryPlan trajectory;
  std::string unknown_json;

  [[nodiscard]] bool operator==(const IntruderSettings&) const = default;
};

// The lights that aircraft of a category mostly have at night; docs/aircraft-lights.md has the numbers.
[[nodiscard]] LampSettings usual_lights(const std::string& category);

// How things of a category fly: "helicopter", "drone" as a multirotor, "balloon"; all others along their path.
[[nodiscard]] AttitudeKind attitude_of_category(const std::string& category);

// Formats of the exported video and masks; automatic: the container that suits the codec.
enum class ContainerChoice { automatic, mkv, mp4, avi, nut, y4m };
enum class MasksChoice { none, video, png };

// Whether blades that can be seen, or nothing of a rotor, count in an intruder's boxes, area and visible share.
enum class LabelRotorsChoice { seen, none };

// The label formats that export.labels may contain: the names of the table in engine/labels/labels.cpp, in its order.
// They are repeated because this module may not include labels; tests/labels/labels_test.cpp compares them.
inline constexpr auto kLabelNames = std::to_array<std::string_view>(
    {"xml", "coco", "yolo", "voc", "mot", "kitti", "cvat", "vot", "aot", "csv", "jsonl"});

// The volumes that export.encounter may contain: the names of well_clear_volumes() in engine/encounter/well_clear.h, in
// its order. They are repeated because this module may not include encounter; tests/scene/encounter_tracks_test.cpp
// compares them.
inline constexpr auto kWellClearNames =
    std::to_array<std::string_view>({"dwc-en-route", "dwc-non-cooperative", "dwc-terminal", "small-uas", "nmac"});

// The tables that export.rig may contain: rig/rig_truth.h.
inline constexpr auto kRigTableNames = std::to_array<std::string_view>({"nuscenes", "kitti"});

// What an export writes. crf: quality of h264 and hevc, 0 (lossless) to 51, and of av1, to 63. max_bit_depth: samples
// of more bits are rounded to this many. The two thresholds leave out labels of intruders with fewer visible pixels, or
// a smaller visible share.
struct ExportSettings {
  VideoCodec codec = VideoCodec::ffv1;
  ContainerChoice container = ContainerChoice::automatic;
  int crf = 18;
  int jpeg_quality = 95;  // 1 to 100
  int max_bit_depth = 16;
  MasksChoice masks = MasksChoice::video;
  std::vector<std::string> labels{"xml"};
  int label_min_pixels = 1;
  double label_min_visible_fraction = 0;
  double label_box_scale = 1;   // boxes of coco, yolo and voc: so much wider and higher than what is visible ...
  int label_box_margin_px = 0;  // ... and so much more on each side, as annotators draw them
  LabelRotorsChoice label_rotors = LabelRotorsChoice::seen;
  std::vector<std::string> categories;  // empty: those of the intruders, in their order
  std::vector<std::string> rig;         // tables of the whole of several cameras
  std::vector<std::string> encounter;   // volumes of well clear; empty: no truth of the encounter is written

  [[nodiscard]] bool operator==(const ExportSettings&) const = default;
};

// A whole project file.
struct Project {
  std::filesystem::path file;  // where it was read from; paths in it are relative to this file's folder
  std::string name = "untitled";
  FootageSettings footage;
  OwnBodySettings own_body;
  CameraSettings camera;
  std::vector<RigCamera> cameras;   // of a rig; empty: one camera, which `footage` and `camera` describe
  std::optional<RigView> rig_view;  // the project as one camera of a rig sees it; no part of the file
  GeoSettings geo;
  LightSettings light;
  std::vector<IntruderSettings> intruders;
  CompositingSettings compositing;
  AppearanceSettings appearance;
  ExportSettings output;
  std::string unknown_json;

  [[nodiscard]] bool operator==(const Project&) const = default;
};

// The attitude at which the camera is mounted on what carries it. A roll or pitch that is not set counts as 0.
[[nodiscard]] Attitude mount_attitude(const CameraSettings& camera);

// Whether the project alone defines where the horizon is: roll or pitch is set, or an attitude file is named. A log
// (camera.track) defines it too where it has an attitude; that is known once it has been read.
[[nodiscard]] bool knows_horizon(const CameraSettings& camera);

// The categories of the labels: export.categories or, where that is empty, those of the intruders, each once.
[[nodiscard]] std::vector<std::string> categories_of(const Project& project);

// A path of the project for the file system: absolute ones as they are, others relative to the project file's folder.
[[nodiscard]] std::filesystem::path resolved(const Project& project, const std::string& path);

// A range of frames of the footage, counted from 0.
struct FrameRange {
  int first = 0;
  int last = 0;  // included
};

// A rig is an aircraft with several cameras (Project::cameras): one flight, one encounter, one truth. What the engine
// works with has one camera: seen_by() gives the project as each of them sees it.

// The project with the footage, mount, clock, readout, exposure and look of one of its cameras in place of those of a
// project with one. Its name is NAME.CAMERA. `cameras` is empty in it, and rig_view says where it comes from. Its
// fields (project/fields.h) are those of a project with one camera, and mount and clock: "mount.position_m",
// "clock.offset_s".
//   camera  index in project.cameras
[[nodiscard]] Project seen_by(const Project& project, std::size_t camera);

// The reverse, after `seen` was changed: what a camera of a rig has of its own goes back to that camera, all else is
// the rig's. A look that was changed is from then on the camera's own. Without a rig_view `seen` itself.
[[nodiscard]] Project put_back(const Project& whole, Project seen);

// All cameras of a project as projects with one: of a rig seen_by() each; else the project itself.
[[nodiscard]] std::vector<Project> seen_by_each(const Project& project);

// The index of a camera. Errors of the kind usage: the project has no such camera; those that it has are named.
[[nodiscard]] Result<std::size_t> camera_named(const Project& project, const std::string& name);

// Where a field of a project with one camera stands in its file: what seen_by() has taken from a camera of a rig stands
// with that camera. "footage.video" -> "cameras[1].footage.video".
[[nodiscard]] std::string field_in_file(const Project& project, const std::string& field);

// Camera in the axes of the aircraft.
[[nodiscard]] Pose<frame::Body, frame::Camera> body_from_camera(const MountSettings& mount);

}  // namespace sigs
