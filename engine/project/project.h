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

namespace sigs {

// Which lens model the numbers of the calibration file are of; automatic: as the file says or, where it does not, as
// its numbers look (docs/calibration-files.md).
enum class LensModelChoice { automatic, brown_conrady, fisheye };

// A project as its file has it: numbers, names and paths; nothing is opened. Units and ranges: project/fields.h.
struct FootageSettings {
  std::string video;
  int first_frame = 0;
  std::optional<int> last_frame;  // the last one used; none: the footage's last
  std::string calibration;
  std::string own_body_mask;  // empty: none
  LensModelChoice lens_model = LensModelChoice::automatic;
  double max_substituted_percent = 1;  // of the exported frames; more damaged ones are an error

  [[nodiscard]] bool operator==(const FootageSettings&) const = default;
};

enum class OwnBodyMethod { stable, paper };

// Section 4 of the paper. Where the paper gives no number, 0 means: as the clip asks for (occlusion/README.md).
struct PaperOwnBodySettings {
  double canny_low = 0;
  double canny_high = 0;
  int dilation_px = 0;
  int closing_px = 0;
  double least_area_percent = 0.5;  // of the image; paper section 4.2

  [[nodiscard]] bool operator==(const PaperOwnBodySettings&) const = default;
};

struct StableOwnBodySettings {
  double vibration_px = 2;
  double least_area_percent = 0.1;
  double least_moving_percent = 5;

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

struct CameraSettings {
  glm::dvec3 position_m{0, 0, -150};  // world, at frame 0 (paper section 3.1.3)
  std::optional<double> roll_deg;     // none: not known; mount_attitude() takes it as 0
  std::optional<double> pitch_deg;    // likewise
  double yaw_deg = 0;
  std::string attitude_file;  // how what carries the camera is turned, frame by frame; empty: level
  double speed_mps = 0;       // along world X

  [[nodiscard]] bool operator==(const CameraSettings&) const = default;
};

struct LightSettings {
  glm::dvec3 position_m{-2000, 1000, -3000};  // world
  glm::dvec3 color{1, 1, 1};
  double ambient = 0.35;

  [[nodiscard]] bool operator==(const LightSettings&) const = default;
};

enum class AnchorChoice { origin, bounds };

struct ModelSettings {
  std::string file;
  std::string forward = "+x";
  std::string up = "+z";
  double scale = 1.0;
  double length_m = 0;  // 0: scale says how large
  AnchorChoice anchor = AnchorChoice::origin;

  [[nodiscard]] bool operator==(const ModelSettings&) const = default;
};

struct WaypointSettings {
  std::optional<double> frame;  // none: spread evenly between its neighbours
  glm::dvec3 position_m{0, 0, 0};
  std::string unknown_json;  // keys of the file that this program does not know, kept on save

  [[nodiscard]] bool operator==(const WaypointSettings&) const = default;
};

enum class SplineChoice { interpolating, approximating };
enum class TimingChoice { frames, constant_speed };
enum class BankChoice { coordinated, level };

struct TrajectoryPlan {
  SplineChoice spline = SplineChoice::interpolating;
  TimingChoice timing = TimingChoice::frames;
  BankChoice bank = BankChoice::coordinated;
  double bank_limit_deg = 60;
  std::vector<WaypointSettings> waypoints;

  [[nodiscard]] bool operator==(const TrajectoryPlan&) const = default;
};

struct IntruderSettings {
  std::string name = "intruder";
  std::string category = "airplane";
  ModelSettings model;
  TrajectoryPlan trajectory;
  std::string unknown_json;

  [[nodiscard]] bool operator==(const IntruderSettings&) const = default;
};

enum class MethodChoice { direct, classic, plain };
enum class BlendChoice { linear, display };

struct CompositingSettings {
  MethodChoice method = MethodChoice::direct;
  BlendChoice blend = BlendChoice::linear;
  double blur_px_per_m = 0.002;
  int supersampling = 3;

  [[nodiscard]] bool operator==(const CompositingSettings&) const = default;
};

enum class CodecChoice { ffv1, h264, mjpeg, png };
enum class ContainerChoice { automatic, mkv, mp4, avi };
enum class MasksChoice { none, video, png };

// What export.labels may hold.
inline constexpr std::array<std::string_view, 10> kLabelNames{"xml",   "coco", "yolo", "voc", "mot",
                                                              "kitti", "cvat", "vot",  "aot", "csv"};

struct ExportSettings {
  CodecChoice codec = CodecChoice::ffv1;
  ContainerChoice container = ContainerChoice::automatic;
  int crf = 18;
  MasksChoice masks = MasksChoice::video;
  std::vector<std::string> labels{"xml"};
  int label_least_pixels = 1;
  double label_least_visible_fraction = 0;
  std::vector<std::string> categories;  // empty: those of the intruders, in their order

  [[nodiscard]] bool operator==(const ExportSettings&) const = default;
};

struct Project {
  std::filesystem::path file;  // where it was read from; paths in it are relative to this file's folder
  std::string name = "untitled";
  FootageSettings footage;
  OwnBodySettings own_body;
  CameraSettings camera;
  LightSettings light;
  std::vector<IntruderSettings> intruders;
  CompositingSettings compositing;
  ExportSettings output;
  std::string unknown_json;

  [[nodiscard]] bool operator==(const Project&) const = default;
};

// How the camera is fixed to what carries it. A roll or pitch that is not set counts as 0.
[[nodiscard]] Attitude mount_attitude(const CameraSettings& camera);

// Whether the project says where the horizon lies: roll or pitch is set, or an attitude file is named.
[[nodiscard]] bool knows_horizon(const CameraSettings& camera);

// The categories that labels count: export.categories or, where that is empty, those of the intruders, each once.
[[nodiscard]] std::vector<std::string> categories_of(const Project& project);

// A path of the project as the file system knows it: absolute ones as they are, others from the project file's folder.
[[nodiscard]] std::filesystem::path resolved(const Project& project, const std::string& path);

}  // namespace sigs
