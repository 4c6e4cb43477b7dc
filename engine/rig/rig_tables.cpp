// SPDX-License-Identifier: MIT
// The tables that others read (rig_truth.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.h"
#include "project/project.h"
#include "rig/rig_truth.h"

namespace sigs {

namespace {

// From X forward, Y right, Z down to X forward, Y left, Z up: half a turn about X, and the same back.
const glm::dquat kUpwards(0, 1, 0, 0);

glm::dvec3 upwards(const glm::dvec3& p) {
  return {p.x, -p.y, -p.z};
}

// Axes of a camera's optical frame (x right, y down, z forward) in those of the camera (X forward, Y right, Z down).
const glm::dquat kCameraFromOptical(0.5, 0.5, 0.5, 0.5);

Json numbers_of(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}
Json numbers_of(const glm::dquat& q) {
  return Json::array({q.w, q.x, q.y, q.z});
}

// 32 hexadecimal digits that depend on the text alone (FNV-1a, two of 64 bits).
std::string token_of(std::string_view text) {
  std::array<std::uint64_t, 2> hash{0xcbf29ce484222325, 0x84222325cbf29ce4};
  for (std::size_t k = 0; k < 2; ++k)
    for (const char c : text) hash[k] = (hash[k] ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{:016x}{:016x}", hash[0], hash[1]);
}

std::int64_t microseconds(double time_s) {
  return std::llround(time_s * 1e6);
}

// Writes the tables of one scene, record by record.
class NuScenes {
 public:
  NuScenes(const RigTruth& rig, std::string name, std::string extension)
      : rig_(rig), name_(std::move(name)), extension_(std::move(extension)) {}

  TextFiles tables() {
    add_statics();
    add_samples();
    for (std::size_t camera = 0; camera < rig_.cameras().size(); ++camera) add_images(camera);
    for (std::size_t intruder = 0; intruder < rig_.intruders().size(); ++intruder) add_annotations(intruder);
    TextFiles files;
    for (const auto& [table, records] : tables_) files.emplace("v1.0-sigs/" + table + ".json", json_text(records, 0));
    return files;
  }

 private:
  template <class... Parts>
  [[nodiscard]] std::string token(const Parts&... parts) const {
    std::string text = name_;
    ((text += fmt::format("\n{}", parts)), ...);
    return token_of(text);
  }
  [[nodiscard]] std::string sample_token(const RigFrame& frame) const { return token("sample", frame.frame); }
  Json& table(const std::string& name) {
    Json& records = tables_[name];
    if (records.is_null()) records = Json::array();
    return records;
  }

  void add_statics() {
    const std::vector<RigFrame>& frames = rig_.frames(0);
    table("log").push_back(
        {{"token", token("log")}, {"logfile", name_}, {"vehicle", ""}, {"date_captured", ""}, {"location", ""}});
    table("map").push_back(
        {{"token", token("map")}, {"log_tokens", Json::array({token("log")})}, {"category", "none"}, {"filename", ""}});
    table("scene").push_back({{"token", token("scene")},
                              {"log_token", token("log")},
                              {"nbr_samples", frames.size()},
                              {"first_sample_token", frames.empty() ? "" : sample_token(frames.front())},
                              {"last_sample_token", frames.empty() ? "" : sample_token(frames.back())},
                              {"name", name_},
                              {"description", ""}});
    // Its readers open all tables, whatever is in them.
    for (const char* const name : {"attribute", "category", "instance", "sample_annotation"})
      table(name) = Json::array();
    constexpr std::array<const char*, 4> kLevels{"v0-40", "v40-60", "v60-80", "v80-100"};
    for (std::size_t i = 0; i < kLevels.size(); ++i)
      table("visibility").push_back({{"token", std::to_string(i + 1)}, {"level", kLevels[i]}, {"description", ""}});
    for (const RigCameraGeometry& camera : rig_.cameras()) {
      const Pose<frame::Body, frame::Camera> mount = body_from_camera(camera.mount);
      const LensParameters& lens = camera.camera.lens.parameters();
      table("sensor").push_back(
          {{"token", token("sensor", camera.name)}, {"channel", camera.name}, {"modality", "camera"}});
      table("calibrated_sensor")
          .push_back(
              {{"token", token("calibrated", camera.name)},
               {"sensor_token", token("sensor", camera.name)},
               {"translation", numbers_of(upwards(mount.translation_m))},
               {"rotation", numbers_of(kUpwards * mount.rotation * kCameraFromOptical)},
               {"camera_intrinsic", Json::array({Json::array({lens.fx, 0.0, lens.cx}),
                                                 Json::array({0.0, lens.fy, lens.cy}), Json::array({0.0, 0.0, 1.0})})},
               {"camera_model", name_of(lens.model)},
               {"camera_distortion", lens.coefficients}});
    }
    std::vector<std::string> categories;
    for (const RigIntruder& intruder : rig_.intruders())
      if (std::find(categories.begin(), categories.end(), intruder.category) == categories.end())
        categories.push_back(intruder.category);
    table("category") = Json::array();
    for (const std::string& category : categories)
      table("category").push_back({{"token", token("category", category)}, {"name", category}, {"description", ""}});
  }

  void add_samples() {
    const std::vector<RigFrame>& frames = rig_.frames(0);
    table("sample") = Json::array();
    for (std::size_t n = 0; n < frames.size(); ++n)
      table("sample").push_back({{"token", sample_token(frames[n])},
                                 {"timestamp", microseconds(frames[n].time_s)},
                                 {"prev", n > 0 ? sample_token(frames[n - 1]) : ""},
                                 {"next", n + 1 < frames.size() ? sample_token(frames[n + 1]) : ""},
                                 {"scene_token", token("scene")}});
  }

  // The frame of the first camera that is nearest to a time; it has frames.
  [[nodiscard]] const RigFrame& sample_of(double time_s) const {
    const std::vector<RigFrame>& samples = rig_.frames(0);
    return *std::min_element(samples.begin(), samples.end(), [&](const RigFrame& a, const RigFrame& b) {
      return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
    });
  }

  void add_images(std::size_t camera) {
    const RigCameraGeometry& one = rig_.cameras()[camera];
    const std::vector<RigFrame>& frames = rig_.frames(camera);
    table("sample_data");
    table("ego_pose");
    for (std::size_t n = 0; n < frames.size() && !rig_.frames(0).empty(); ++n) {
      const RigFrame& frame = frames[n];
      const RigFrame& sample = sample_of(frame.time_s);
      const std::string pose = token("pose", one.name, frame.frame);
      table("ego_pose")
          .push_back({{"token", pose},
                      {"timestamp", microseconds(frame.time_s)},
                      {"rotation", numbers_of(kUpwards * frame.world_from_aircraft.rotation * kUpwards)},
                      {"translation", numbers_of(upwards(frame.world_from_aircraft.translation_m))}});
      const auto image = [&](std::size_t k) { return token("image", one.name, frames[k].frame); };
      table("sample_data")
          .push_back({{"token", image(n)},
                      {"sample_token", sample_token(sample)},
                      {"ego_pose_token", pose},
                      {"calibrated_sensor_token", token("calibrated", one.name)},
                      {"filename", fmt::format("../{}.{}/frame_{:06}{}", name_, one.name, frame.frame, extension_)},
                      {"fileformat", extension_.substr(1)},
                      {"width", one.camera.size_px.width},
                      {"height", one.camera.size_px.height},
                      {"timestamp", microseconds(frame.time_s)},
                      {"is_key_frame", rig_.frame_at(camera, sample.time_s) == &frame},
                      {"prev", n > 0 ? image(n - 1) : ""},
                      {"next", n + 1 < frames.size() ? image(n + 1) : ""}});
    }
  }

  // In how much of it, at most, any camera sees it at a time; none: no pixel of it.
  [[nodiscard]] std::optional<double> visible_fraction(std::size_t intruder, double time_s) const {
    std::optional<double> most;
    for (std::size_t camera = 0; camera < rig_.cameras().size(); ++camera) {
      const RigFrame* const frame = rig_.frame_at(camera, time_s);
      if (frame == nullptr || !frame->intruders[intruder].is_visible) continue;
      most = std::max(most.value_or(0), frame->intruders[intruder].visible_fraction);
    }
    return most;
  }

  void add_annotations(std::size_t intruder) {
    const RigIntruder& what = rig_.intruders()[intruder];
    Json& records = table("sample_annotation");
    const auto annotation = [&](const RigFrame& frame) { return token("annotation", intruder, frame.frame); };
    std::vector<std::pair<const RigFrame*, double>> seen;
    for (const RigFrame& frame : rig_.frames(0))
      if (const std::optional<double> fraction = visible_fraction(intruder, frame.time_s))
        seen.emplace_back(&frame, *fraction);
    const glm::dvec3 size_m = what.high_m - what.low_m;
    for (std::size_t n = 0; n < seen.size(); ++n) {
      const auto& [frame, fraction] = seen[n];
      const RigSighting& sighting = frame->intruders[intruder];
      const glm::dvec3 middle_m = frame->world_from_aircraft * sighting.position_m +
                                  sighting.world_from_intruder * ((what.low_m + what.high_m) / 2.0);
      const int level = fraction < 0.4 ? 1 : fraction < 0.6 ? 2 : fraction < 0.8 ? 3 : 4;
      records.push_back({{"token", annotation(*frame)},
                         {"sample_token", sample_token(*frame)},
                         {"instance_token", token("instance", intruder)},
                         {"visibility_token", std::to_string(level)},
                         {"attribute_tokens", Json::array()},
                         {"translation", numbers_of(upwards(middle_m))},
                         {"size", Json::array({size_m.y, size_m.x, size_m.z})},
                         {"rotation", numbers_of(kUpwards * sighting.world_from_intruder * kUpwards)},
                         {"num_lidar_pts", 0},
                         {"num_radar_pts", 0},
                         {"prev", n > 0 ? annotation(*seen[n - 1].first) : ""},
                         {"next", n + 1 < seen.size() ? annotation(*seen[n + 1].first) : ""}});
    }
    if (seen.empty()) return;
    table("instance")
        .push_back({{"token", token("instance", intruder)},
                    {"category_token", token("category", what.category)},
                    {"nbr_annotations", seen.size()},
                    {"first_annotation_token", annotation(*seen.front().first)},
                    {"last_annotation_token", annotation(*seen.back().first)}});
  }

  const RigTruth& rig_;
  std::string name_;
  std::string extension_;
  std::map<std::string, Json> tables_;
};

// A rotation between optical frames, row by row, as KITTI writes matrices.
std::string matrix_text(const glm::dquat& rotation) {
  const glm::dmat3 matrix = glm::mat3_cast(rotation);
  std::string text;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      text += fmt::format("{}{:.12e}", text.empty() ? "" : " ", matrix[column][row]);
  return text;
}

std::string vector_text(const glm::dvec3& v) {
  return fmt::format("{:.12e} {:.12e} {:.12e}", v.x, v.y, v.z);
}

// As OpenCV has them: k1 k2 p1 p2 k3. None where it takes more or another model.
std::optional<std::array<double, 5>> five_coefficients(const LensParameters& lens) {
  if (lens.model != LensModel::brown_conrady) return std::nullopt;
  std::array<double, 5> five{};
  for (std::size_t i = 0; i < lens.coefficients.size(); ++i) {
    if (i < five.size())
      five[i] = lens.coefficients[i];
    else if (lens.coefficients[i] != 0)
      return std::nullopt;
  }
  return five;
}

}  // namespace

TextFiles nuscenes_tables(const RigTruth& rig, const std::string& name, const std::string& image_extension) {
  return NuScenes(rig, name, image_extension).tables();
}

Result<TextFiles> kitti_tables(const RigTruth& rig) {
  std::string calibration = "corner_dist: 0.000000000000e+00\n";
  const Pose<frame::Body, frame::Camera> first = body_from_camera(rig.cameras().at(0).mount);
  const glm::dquat optical_from_camera = glm::conjugate(kCameraFromOptical);
  for (std::size_t k = 0; k < rig.cameras().size(); ++k) {
    const RigCameraGeometry& camera = rig.cameras()[k];
    const LensParameters& lens = camera.camera.lens.parameters();
    const auto coefficients = five_coefficients(lens);
    if (!coefficients)
      return fail("export.rig",
                  fmt::format("kitti describes lenses by five coefficients, which camera \"{}\", {}, does "
                              "not have; leave kitti out",
                              camera.name, name_of(lens.model)),
                  ErrorKind::bad_project);
    const cv::Size size_px = camera.camera.size_px;
    // x in camera k = R x in the first camera + T, both optical.
    const Pose<frame::Camera, frame::Camera> from_first = inverse(body_from_camera(camera.mount)) * first;
    const glm::dquat rotation = optical_from_camera * from_first.rotation * kCameraFromOptical;
    const std::string intrinsic =
        fmt::format("{:.12e} 0 {:.12e} 0 {:.12e} {:.12e} 0 0 1", lens.fx, lens.cx, lens.fy, lens.cy);
    calibration += fmt::format("S_{:02}: {:.12e} {:.12e}\n", k, double(size_px.width), double(size_px.height));
    calibration += fmt::format("K_{:02}: {}\nD_{:02}:", k, intrinsic, k);
    for (const double coefficient : *coefficients) calibration += fmt::format(" {:.12e}", coefficient);
    calibration += fmt::format("\nR_{:02}: {}\nT_{:02}: {}\n", k, matrix_text(rotation), k,
                               vector_text(optical_of(from_first.translation_m)));
  }
  TextFiles files{{"calib_cam_to_cam.txt", calibration}, {"poses.txt", ""}, {"times.txt", ""}};
  for (const RigFrame& frame : rig.frames(0)) {
    const Pose<frame::World, frame::Camera> start = rig.frames(0).front().world_from_aircraft * first;
    const Pose<frame::Camera, frame::Camera> moved = inverse(start) * (frame.world_from_aircraft * first);
    const glm::dmat3 matrix = glm::mat3_cast(optical_from_camera * moved.rotation * kCameraFromOptical);
    const glm::dvec3 shift_m = optical_of(moved.translation_m);
    for (int row = 0; row < 3; ++row)
      files["poses.txt"] += fmt::format("{:.12e} {:.12e} {:.12e} {:.12e}{}", matrix[0][row], matrix[1][row],
                                        matrix[2][row], shift_m[row], row < 2 ? " " : "\n");
    files["times.txt"] += fmt::format("{:.9f}\n", frame.time_s);
  }
  return files;
}

}  // namespace sigs
