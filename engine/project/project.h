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
#include "spline/trajectory.h"
#include "video/video_writer.h"

namespace sigs {

// The lens model that the numbers of the calibration file belong to; automatic: as the file states or, where it does
// not, judged by its numbers (docs/calibration-files.md).
enum class LensModelChoice { automatic, brown_conrady, fisheye };

// What the camera's sensor responds to: light, or the heat that things send out (long-wave infrared).
enum class Spectrum { visible, thermal };

// The contents of a project file: numbers, names and paths; nothing is opened. The members are described, with unit and
// range, in fields.cpp and docs/project-format.md.
// The background: which video, which of its frames, and the camera that took it.
struct FootageSettings {
  std::string video;                    // a file, a folder of images, or a pattern such as images/%06d.png
  std::optional<double> frame_rate_hz;  // of images; none: not known
  std::string timestamps;               // file with the time of each image; empty: evenly spaced
  int first_frame = 0;
  std::optional<int> last_frame;  // the last one used; none: the footage's last
  std::string calibration;
  std::string own_body_mask;  // empty: none
  // What stands in the world nearer than the intruders, such as trees: a mask of one frame. Empty: nothing.
  std::string occluder_mask;
  int occluder_frame = 0;          // the frame that the mask was made of, counted from 0
  double occluder_distance_m = 0;  // intruders nearer than this are before it; 0: none is
  std::string real_aircraft;       // file with the boxes of aircraft that the footage itself shows; empty: none
  Spectrum spectrum = Spectrum::visible;
  LensModelChoice lens_model = LensModelChoice::automatic;
  double max_substituted_percent = 1;  // of the exported frames; more damaged ones are an error

  [[nodiscard]] bool operator==(const FootageSettings&) const = default;
};

// The method that finds the UAV's own body: the project's own one, or that of section 4 of the paper.
enum class OwnBodyMethod { stable, paper };

// Section 4 of the paper. Where the paper gives no number, 0 means: chosen for the clip (occlusion/README.md).
struct PaperOwnBodySettings {
  double canny_low = 0;
  double canny_high = 0;
  int dilation_px = 0;
  int closing_px = 0;
  double min_area_percent = 0.5;  // of the image; paper section 4.2

  [[nodiscard]] bool operator==(const PaperOwnBodySettings&) const = default;
};

// Parameters of the method `stable` (occlusion/README.md).
struct StableOwnBodySettings {
  double vibration_px = 2;
  double min_area_percent = 0.1;
  double min_moving_percent = 5;

  [[nodiscard]] bool operator==(const StableOwnBodySettings&) const = default;
};

// How the UAV's own body is found in the footage (occlusion/detect.h).
struct OwnBodySettings {
  OwnBodyMethod method = OwnBodyMethod::stable;
  int frames = 1500;
  int every = 1;
  double settled_percent = 0;
  double soft_edge_px = 1;
  PaperOwnBodySettings paper;
  StableOwnBodySettings stable;

  [[nodiscard]] bool operator==(const OwnBodySettings&) const = default;
};

// Which attitude of a flight log is used: the camera's or gimbal's where it has one, else the airframe's; one of the
// two; or none.
enum class TrackAttitudeChoice { automatic, camera, airframe, none };

// Whether the log's positions are used: where it has some; always (it is an error if it has none); never.
enum class TrackPositionChoice { automatic, log, none };

// How the camera sits on what the log's attitude describes: at camera.attitude_deg, the mount's angles; not at all, as
// that attitude is the camera's own; or as the log itself says (Track::attitude_is_whole), else at camera.attitude_deg.
enum class TrackMountChoice { automatic, attitude_deg, none };

// What happens with a log that is damaged or does not cover all frames: it is an error, or its sound part is used.
enum class IncompleteTrackChoice { refuse, use };

// The flight log by which the camera moves (telemetry/read_track.h).
struct TrackSettings {
  std::string file;     // empty: none
  double offset_s = 0;  // time in the log at the footage's frame 0
  TrackPositionChoice position = TrackPositionChoice::automatic;
  TrackAttitudeChoice attitude = TrackAttitudeChoice::automatic;
  TrackMountChoice mount = TrackMountChoice::automatic;
  IncompleteTrackChoice incomplete = IncompleteTrackChoice::refuse;

  [[nodiscard]] bool operator==(const TrackSettings&) const = default;
};

// Position, mounting and speed of the camera. The world's X axis is the camera's heading at frame 0.
struct CameraSettings {
  glm::dvec3 position_m{0, 0, -150};  // world, at frame 0 (paper section 3.1.3)
  std::optional<double> roll_deg;     // none: not known; mount_attitude() takes it as 0
  std::optional<double> pitch_deg;    // likewise
  double yaw_deg = 0;
  std::string attitude_file;  // attitude, at each frame, of what carries the camera; empty: level
  double speed_mps = 0;       // along world X
  TrackSettings track;
  std::optional<double> readout_s;   // of the rolling shutter, first to last row; none: as the log says, else 0
  std::optional<double> exposure_s;  // how long the shutter is open; none: as the log says, else 0

  [[nodiscard]] bool operator==(const CameraSettings&) const = default;
};

// Where the world lies on the Earth (geo/geodetic.h): the place of its origin and the heading of X. Without place or
// heading they come from the camera's log, where it has them.
struct GeoSettings {
  std::optional<double> latitude_deg;
  std::optional<double> longitude_deg;
  std::optional<double> height_m;     // of the world's plane z = 0 above the WGS-84 ellipsoid
  std::optional<double> heading_deg;  // of world X, from true north to the right

  [[nodiscard]] bool operator==(const GeoSettings&) const = default;
};

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

  [[nodiscard]] bool operator==(const LightSettings&) const = default;
};

// The point of the model that flies along the trajectory: the file's origin or the centre of its bounds.
enum class AnchorChoice { origin, bounds };

// The aircraft's model: file, axes and size (ModelAxes in mesh/mesh.h).
struct ModelSettings {
  std::string file;
  std::string forward = "+x";
  std::string up = "+z";
  double scale = 1.0;
  double length_m = 0;  // 0: scale is used
  AnchorChoice anchor = AnchorChoice::origin;

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

// How much warmer than the clear sky the parts of an aircraft look to a thermal camera, in 8-bit code values before
// they clip (docs/thermal.md). Which part a surface belongs to is told by its material.
struct HeatSettings {
  double skin = 200;
  double engine = 300;
  double exhaust = 400;
  double glass = 150;
  double rotor = 100;

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
  HeatSettings heat;  // used with Spectrum::thermal
  TrajectoryPlan trajectory;
  std::string unknown_json;

  [[nodiscard]] bool operator==(const IntruderSettings&) const = default;
};

// How things of a category fly: "helicopter", "drone" as a multirotor, "balloon"; all others along their path.
[[nodiscard]] AttitudeKind attitude_of_category(const std::string& category);

// How the intruder gets into the image: directly through the lens, by section 3.2 of the paper, or by a keyed paste;
// and whether light is mixed, which adds as in the lens, or code values, as the paper does. No project states `heat`:
// code values as sRGB has them whatever the footage's curve, since they stand for heat, and none clips before the
// stages that follow.
enum class MethodChoice { direct, classic, plain };
enum class BlendChoice { linear, display, heat };

// The blur by distance with which SIGS follows the paper, which gives no number: sigma 2 px at 1 km.
inline constexpr double kPaperBlur_px_per_m = 0.002;

// How layers become part of the image. blur_px_per_m: standard deviation of the Gaussian blur for each metre of
// distance, none: blur_by_distance_px_per_m(); supersampling: rendered pixels for each image pixel, along each axis.
struct CompositingSettings {
  MethodChoice method = MethodChoice::direct;
  BlendChoice blend = BlendChoice::linear;
  std::optional<double> blur_px_per_m;
  int supersampling = 3;

  [[nodiscard]] bool operator==(const CompositingSettings&) const = default;
};

// As the settings state it, else by the method: the paper's for `classic`; 0 for `direct`, since lenses blur what is
// far no more than what is near (AppearanceSettings::psf_sigma_px).
[[nodiscard]] inline double blur_by_distance_px_per_m(const CompositingSettings& compositing) {
  return compositing.blur_px_per_m.value_or(compositing.method == MethodChoice::classic ? kPaperBlur_px_per_m : 0.0);
}

// Random noise of the footage, in 8-bit code values, as the codec left it. Its variance is linear in brightness.
struct GrainSettings {
  double sd_dark = 0;    // standard deviation of luma where the image is black
  double sd_bright = 0;  // where it is white
  double sd_chroma = 0;  // of both chroma planes
  double correlation_length_px =
      0;  // sigma of the Gaussian that neighbouring pixels share noise by; 0: each has its own
  double temporal_correlation = 0;  // correlation from one frame to the next, 0..1
  int seed = 1;

  [[nodiscard]] bool is_none() const { return sd_dark == 0 && sd_bright == 0 && sd_chroma == 0; }
  [[nodiscard]] bool operator==(const GrainSettings&) const = default;
};

// Where the haze's colour comes from: the footage around the intruder, or a colour that is given.
enum class AirlightChoice { behind, color };

// Haze in front of the intruder (Koschmieder): contrast falls by exp(-3 r / visibility_m).
struct HazeSettings {
  std::optional<double> visibility_m;  // at which 5 % of the contrast is left; none: clear
  AirlightChoice airlight = AirlightChoice::behind;
  glm::dvec3 airlight_color{0.6, 0.65, 0.7};  // linear light

  [[nodiscard]] bool operator==(const HazeSettings&) const = default;
};

// One generation of compression that the image around the intruder goes through: none, the footage's own codec, or one
// that is named.
enum class CodecMatchChoice { none, footage, h264, mjpeg };

struct CodecMatchSettings {
  CodecMatchChoice match = CodecMatchChoice::none;
  int predicted_frames = 0;         // images before this one that H.264 or MPEG has predicted from one another, 0..16
  std::optional<double> quantiser;  // QP of H.264 (0..51) or percent of JPEG's table; none: as the stream says

  [[nodiscard]] bool operator==(const CodecMatchSettings&) const = default;
};

// Which end of the scale things that are warm have.
enum class HotChoice { white, black };

// Of thermal footage: its scale, and the camera's enhancement of local contrast, by which a warm thing darkens what is
// around it.
struct ThermalSettings {
  double sky = 96;  // 8-bit code value of the clear sky
  HotChoice hot = HotChoice::white;
  double halo = 0.35;   // how much of the surroundings' mean is taken away, 0..5
  double halo_px = 12;  // sigma of the Gaussian that this mean is taken by

  [[nodiscard]] bool operator==(const ThermalSettings&) const = default;
};

// How the footage looks, and so how an intruder in it has to look (method direct). Each part but the point
// spread is left out at its default.
struct AppearanceSettings {
  double psf_sigma_px = 0.45;  // sigma of the lens' and the sensor's Gaussian
  double sharpening = 0;       // of the camera: how much of the detail is added, 0..5
  double sharpening_px = 1;    // sigma of the Gaussian that detail is told by
  double chroma_blur_px = 0;   // sigma of the Gaussian over the samples of the chroma planes
  double black = 0;            // linear light that the footage's black stands for: flare of the lens
  double saturation = 1;       // of the intruder's colours
  GrainSettings grain;
  HazeSettings haze;
  ThermalSettings thermal;  // used with Spectrum::thermal
  CodecMatchSettings codec;

  [[nodiscard]] bool operator==(const AppearanceSettings&) const = default;
};

// Formats of the exported video and masks; automatic: the container that suits the codec.
enum class ContainerChoice { automatic, mkv, mp4, avi, nut, y4m };
enum class MasksChoice { none, video, png };

// The label formats that export.labels may contain: the names of the table in engine/labels/labels.cpp, in its order.
// They are repeated because this module may not include labels; tests/labels/labels_test.cpp compares them.
inline constexpr auto kLabelNames = std::to_array<std::string_view>(
    {"xml", "coco", "yolo", "voc", "mot", "kitti", "cvat", "vot", "aot", "csv", "jsonl"});

// The volumes that export.encounter may contain: the names of well_clear_volumes() in engine/encounter/well_clear.h, in
// its order. They are repeated because this module may not include encounter; tests/scene/encounter_tracks_test.cpp
// compares them.
inline constexpr auto kWellClearNames =
    std::to_array<std::string_view>({"dwc-en-route", "dwc-non-cooperative", "dwc-terminal", "small-uas", "nmac"});

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
  std::vector<std::string> categories;  // empty: those of the intruders, in their order
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

}  // namespace sigs
