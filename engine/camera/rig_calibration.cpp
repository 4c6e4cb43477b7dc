// SPDX-License-Identifier: MIT
#include "camera/rig_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "camera/calibration_formats.h"

namespace sigs::calibration {
namespace {

using Names = std::span<const std::string_view>;

// Keys of a file of one camera.
constexpr std::array<std::string_view, 5> kOneMatrix{"camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "k"};
constexpr std::array<std::string_view, 2> kKalibrKeys{"intrinsics", "camera_model"};
// Those of a stereo pair.
constexpr std::array<std::string_view, 3> kFirstMatrix{"M1", "K1", "cameraMatrix1"};
constexpr std::array<std::string_view, 3> kSecondMatrix{"M2", "K2", "cameraMatrix2"};
constexpr std::array<std::string_view, 2> kFirstCoefficients{"D1", "distCoeffs1"};
constexpr std::array<std::string_view, 2> kSecondCoefficients{"D2", "distCoeffs2"};

bool is_pair(const Fields& fields) {
  return found(fields, kOneMatrix) == nullptr && found(fields, kFirstMatrix) != nullptr &&
         found(fields, kSecondMatrix) != nullptr;
}

// The fields of one of the two, with its matrix and coefficients by the names of a single camera's.
Fields one_of_pair(Fields fields, Names matrix, Names coefficients) {
  if (const Field* field = found(fields, matrix)) fields.insert_or_assign("camera_matrix", Field(*field));
  if (const Field* field = found(fields, coefficients))
    fields.insert_or_assign("distortion_coefficients", Field(*field));
  else if (const Field* unnumbered = found(fields, std::array<std::string_view, 1>{"D"}))
    fields.erase(unnumbered->name);
  return fields;
}

// Maps that are cameras, in the file's order, the outermost ones.
void collect(const Fields& fields, std::vector<Fields::Group>& cameras) {
  for (const Fields::Group& group : fields.groups)
    if (found(group.fields, kKalibrKeys) != nullptr)
      cameras.push_back(group);
    else
      collect(group.fields, cameras);
}

// What a name ends with as a number: 10 of "cam10"; none: no digits, or more than a rig has.
std::optional<int> number_at_end(const std::string& name) {
  const std::size_t at = name.find_last_not_of("0123456789") + 1;
  if (at == name.size() || name.size() - at > 4) return std::nullopt;
  return std::stoi(name.substr(at));
}

// YAML's writers sort keys as texts, so that cam10 stands before cam2.
void sort_by_number(std::vector<Fields::Group>& cameras) {
  const auto all_numbered =
      std::ranges::all_of(cameras, [](const auto& c) { return number_at_end(c.name).has_value(); });
  if (all_numbered)
    std::ranges::stable_sort(cameras, {}, [](const Fields::Group& c) { return *number_at_end(c.name); });
}

}  // namespace

Result<std::vector<Fields::Group>> cameras_in(const Fields& fields, const std::string& file_name) {
  if (is_pair(fields))
    return std::vector<Fields::Group>{{"left", one_of_pair(fields, kFirstMatrix, kFirstCoefficients)},
                                      {"right", one_of_pair(fields, kSecondMatrix, kSecondCoefficients)}};
  std::vector<Fields::Group> cameras;
  if (found(fields, kOneMatrix) == nullptr && found(fields, kKalibrKeys) == nullptr) collect(fields, cameras);
  if (cameras.empty()) {
    Result<Fields> one = from_kalibr(fields, "", file_name);
    if (!one) return fail(one.error());
    return std::vector<Fields::Group>{{"", *std::move(one)}};
  }
  sort_by_number(cameras);
  for (Fields::Group& camera : cameras) {
    Result<Fields> translated = from_kalibr(std::move(camera.fields), camera.name + ".", file_name);
    if (!translated) return fail(translated.error());
    camera.fields = *std::move(translated);
  }
  return cameras;
}

}  // namespace sigs::calibration

namespace sigs {
namespace {

namespace fs = std::filesystem;
using calibration::Field;
using calibration::Fields;

// A rigid motion between two frames of OpenCV's axes: p_to = rotation p_from + translation_m.
struct Motion {
  glm::dmat3 rotation{1};
  glm::dvec3 translation_m{0};

  [[nodiscard]] Motion inverse() const {
    const glm::dmat3 back = glm::transpose(rotation);
    return {back, -(back * translation_m)};
  }
  [[nodiscard]] Motion operator*(const Motion& first) const {
    return {rotation * first.rotation, rotation * first.translation_m + translation_m};
  }
};

const Field* field_in(const Fields& fields, std::string_view name) {
  return found(fields, {&name, 1});
}

// A matrix of 9 numbers, row by row, as the nearest rotation. `stride`: numbers from row to row.
Result<glm::dmat3> rotation_in(std::span<const double> rows, std::size_t stride, const std::string& where) {
  cv::Matx33d given;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      given(row, column) = rows[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)];
  constexpr double kRounding = 2e-3;  // of files with three decimals
  const double off = cv::norm(given * given.t() - cv::Matx33d::eye(), cv::NORM_INF);
  if (!(off <= kRounding))
    return fail(where,
                fmt::format("is no rotation: its rows are not of length 1 and at right angles, off by {:.3g}", off));
  if (cv::determinant(given) < 0) return fail(where, "is no rotation: it mirrors; one axis points the other way");
  cv::Matx31d sizes;
  cv::Matx33d left;
  cv::Matx33d right;
  cv::SVD::compute(given, sizes, left, right);
  const cv::Matx33d nearest = left * right;
  glm::dmat3 rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[column][row] = nearest(row, column);
  return rotation;
}

Result<glm::dvec3> place_in(const glm::dvec3& place_m, const std::string& where) {
  constexpr double kFar_m = 1000;
  if (!(glm::length(place_m) <= kFar_m))
    return fail(where, fmt::format("puts the cameras {:.3g} m apart; lengths are in metres", glm::length(place_m)));
  return place_m;
}

// A 4x4 matrix, row by row.
Result<Motion> motion_in(const Field& field, const std::string& file_name) {
  const std::string where = file_name + ": " + field.name;
  if (const auto good = calibration::check_numbers(field, file_name); !good) return fail(good.error());
  const std::vector<double>& m = field.numbers;
  if (m.size() != 16) return fail(where, fmt::format("expected 16 numbers, 4 rows of 4, found {}", m.size()));
  if (std::abs(m[12]) + std::abs(m[13]) + std::abs(m[14]) + std::abs(m[15] - 1) > 1e-9)
    return fail(where, "the last row must be 0 0 0 1");
  const Result<glm::dmat3> rotation = rotation_in(m, 4, where);
  if (!rotation) return fail(rotation.error());
  const Result<glm::dvec3> place_m = place_in({m[3], m[7], m[11]}, where);
  if (!place_m) return fail(place_m.error());
  return Motion{*rotation, *place_m};
}

// From the optical axes of files to our own.
Pose<frame::FirstCamera, frame::Camera> pose_of(const Motion& first_from_camera) {
  glm::dmat3 turned;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 along(0);
    along[axis] = 1;
    turned[axis] = camera_of(first_from_camera.rotation * optical_of(along));
  }
  return {glm::normalize(glm::quat_cast(turned)), camera_of(first_from_camera.translation_m)};
}

// The cameras of a chain against the first one.
class Chain {
 public:
  Chain(const std::vector<Fields::Group>& cameras, const std::string& file_name)
      : cameras_(cameras), file_name_(file_name) {}

  Result<std::vector<Motion>> first_from_cameras(std::vector<Warning>& warnings) const {
    std::vector<Motion> all{Motion{}};
    const Result<std::optional<Motion>> first_from_imu = camera_from_imu(0);
    if (!first_from_imu) return fail(first_from_imu.error());
    for (std::size_t i = 1; i < cameras_.size(); ++i) {
      const Result<std::optional<Motion>> link = from_before(i);
      if (!link) return fail(link.error());
      const Result<std::optional<Motion>> imu = camera_from_imu(i);
      if (!imu) return fail(imu.error());
      std::optional<Motion> over_imu;
      if (*first_from_imu && *imu) over_imu = **first_from_imu * (*imu)->inverse();
      if (!*link && !over_imu)
        return fail(
            file_name_ + ": " + cameras_[i].name,
            fmt::format("the chain breaks here: no T_cn_cnm1, and no T_cam_imu of both it and {}", cameras_[0].name));
      all.push_back(*link ? all.back() * (*link)->inverse() : *over_imu);
      if (*link && over_imu) compare(i, all.back(), *over_imu, warnings);
    }
    return all;
  }

 private:
  // T_cn_cnm1. The camera before has to be that of the number before.
  [[nodiscard]] Result<std::optional<Motion>> from_before(std::size_t i) const {
    const Field* field = field_in(cameras_[i].fields, "T_cn_cnm1");
    if (field == nullptr) return std::nullopt;
    const auto number = calibration::number_at_end(cameras_[i].name);
    const auto before = calibration::number_at_end(cameras_[i - 1].name);
    if (number && before && *number != *before + 1)
      return fail(file_name_ + ": " + field->name,
                  fmt::format("is against camera {}, which is not in the file", *number - 1));
    const Result<Motion> motion = motion_in(*field, file_name_);
    if (!motion) return fail(motion.error());
    return *motion;
  }

  [[nodiscard]] Result<std::optional<Motion>> camera_from_imu(std::size_t i) const {
    for (const auto& [key, is_inverse] : std::array<std::pair<std::string_view, bool>, 3>{
             {{"T_cam_imu", false}, {"T_imu_cam", true}, {"T_BS", true}}}) {
      const Field* field = field_in(cameras_[i].fields, key);
      if (field == nullptr) continue;
      const Result<Motion> motion = motion_in(*field, file_name_);
      if (!motion) return fail(motion.error());
      return is_inverse ? motion->inverse() : *motion;
    }
    return std::nullopt;
  }

  void compare(std::size_t i, const Motion& by_chain, const Motion& over_imu, std::vector<Warning>& warnings) const {
    const Motion between = by_chain.inverse() * over_imu;
    const double angle_deg = deg_of_rad(glm::length(vector_of(glm::normalize(glm::quat_cast(between.rotation)))));
    const double apart_m = glm::length(by_chain.translation_m - over_imu.translation_m);
    constexpr double kAngle_deg = 0.5;
    constexpr double kApart_m = 0.01;
    if (angle_deg > kAngle_deg || apart_m > kApart_m)
      warnings.push_back(
          {file_name_ + ": " + cameras_[i].name,
           fmt::format("T_cn_cnm1 and T_cam_imu differ by {:.1f} degrees and {:.3f} m; T_cn_cnm1 is used", angle_deg,
                       apart_m)});
  }

  const std::vector<Fields::Group>& cameras_;
  const std::string& file_name_;
};

// timeshift_cam_imu, t_imu = t_cam + shift; none where it is not there.
Result<std::optional<double>> time_shift_s(const Fields& fields, const std::string& file_name) {
  const Field* field = field_in(fields, "timeshift_cam_imu");
  if (field == nullptr) return std::nullopt;
  if (const auto good = calibration::check_numbers(*field, file_name); !good) return fail(good.error());
  if (field->numbers.size() != 1) return fail(file_name + ": " + field->name, "expected one number, seconds");
  return field->numbers.front();
}

Result<RigCalibration> chain_rig(const std::vector<Fields::Group>& cameras, const std::string& file_name,
                                 const RigReading& reading) {
  RigCalibration rig{.format = "Kalibr chain"};
  const Result<std::vector<Motion>> poses = Chain(cameras, file_name).first_from_cameras(rig.warnings);
  if (!poses) return fail(poses.error());
  std::optional<double> first_shift_s;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Result<std::optional<double>> shift_s = time_shift_s(cameras[i].fields, file_name);
    if (!shift_s) return fail(shift_s.error());
    if (i == 0) first_shift_s = *shift_s;
    Result<Camera> camera = calibration::camera_of(cameras[i].fields, file_name, {}, {});
    // A size that the file does not state is the caller's.
    if (!camera && reading.size_px && field_in(cameras[i].fields, "image_size") == nullptr)
      camera = calibration::camera_of(cameras[i].fields, file_name, reading.size_px, {});
    if (!camera) return fail(camera.error());
    CalibratedCamera one{
        .name = cameras[i].name, .camera = *std::move(camera), .first_from_camera = pose_of((*poses)[i])};
    if (first_shift_s && *shift_s) one.clock_offset_s = **shift_s - *first_shift_s;
    rig.cameras.push_back(std::move(one));
  }
  return rig;
}

// The file that OpenCV's sample writes beside this one: extrinsics.yml beside intrinsics.yml. Empty: none is there.
fs::path other_of_pair(const fs::path& path) {
  constexpr std::array<std::string_view, 2> kWords{"intrinsics", "extrinsics"};
  std::string name = path.filename().string();
  for (std::size_t i = 0; i < kWords.size(); ++i)
    if (const std::size_t at = name.rfind(kWords[i]); at != std::string::npos) {
      name.replace(at, kWords[i].size(), kWords[1 - i]);
      const fs::path other = path.parent_path() / name;
      std::error_code ignored;
      return fs::exists(other, ignored) ? other : fs::path();
    }
  return {};
}

bool has_motion(const Fields& fields) {
  return field_in(fields, "R") != nullptr && field_in(fields, "T") != nullptr;
}

Result<Motion> pair_motion(const Fields& fields, const std::string& file_name, const RigReading& reading,
                           std::vector<Warning>& warnings) {
  const Field& turn = *field_in(fields, "R");
  const Field& place = *field_in(fields, "T");
  for (const auto& [field, count] : {std::pair(&turn, std::size_t{9}), {&place, std::size_t{3}}}) {
    if (const auto good = calibration::check_numbers(*field, file_name); !good) return fail(good.error());
    if (field->numbers.size() != count)
      return fail(file_name + ": " + field->name,
                  fmt::format("expected {} numbers, found {}", count, field->numbers.size()));
  }
  const Result<glm::dmat3> rotation = rotation_in(turn.numbers, 3, file_name + ": R");
  if (!rotation) return fail(rotation.error());
  const glm::dvec3 stated(place.numbers[0], place.numbers[1], place.numbers[2]);
  const Result<glm::dvec3> place_m = place_in(reading.opencv_unit_m * stated, file_name + ": T");
  if (!place_m) return fail(place_m.error());
  constexpr double kFar_m = 5;
  if (glm::length(*place_m) > kFar_m)
    warnings.push_back({file_name + ": T",
                        fmt::format("puts the cameras {:.1f} m apart: its unit is that of the board's squares, which "
                                    "may be millimetres",
                                    glm::length(*place_m))});
  return Motion{*rotation, *place_m};
}

Result<RigCalibration> pair_rig(const Fields& fields, const std::string& file_name, const RigReading& reading) {
  const auto cameras = calibration::cameras_in(fields, file_name);
  if (!cameras) return fail(cameras.error());
  RigCalibration rig{.format = "OpenCV stereo pair"};
  const Result<Motion> second_from_first = pair_motion(fields, file_name, reading, rig.warnings);
  if (!second_from_first) return fail(second_from_first.error());
  for (const Fields::Group& one : *cameras) {
    Result<Camera> camera = calibration::camera_of(one.fields, file_name, reading.size_px, {});
    if (!camera) return fail(camera.error());
    const bool is_first = rig.cameras.empty();
    rig.cameras.push_back(
        CalibratedCamera{.name = one.name,
                         .camera = *std::move(camera),
                         .first_from_camera = pose_of(is_first ? Motion{} : second_from_first->inverse())});
  }
  return rig;
}

}  // namespace

Result<RigCalibration> read_rig_calibration(const fs::path& path, const RigReading& reading) {
  const std::string file_name = path.filename().string();
  Result<Fields> fields = calibration::fields_of_file(path);
  if (!fields) return fail(fields.error());
  if (calibration::is_pair(*fields) != has_motion(*fields))
    if (const fs::path other = other_of_pair(path); !other.empty()) {
      Result<Fields> rest = calibration::fields_of_file(other);
      if (!rest) return fail(rest.error());
      fields->merge(*rest);
    }
  if (calibration::is_pair(*fields) && has_motion(*fields)) return pair_rig(*fields, file_name, reading);
  if (calibration::is_pair(*fields))
    return fail(file_name,
                "has two lenses, but no R and T that say how the cameras lie; they are looked for in it, and in "
                "extrinsics.yml beside intrinsics.yml");
  const auto cameras = calibration::cameras_in(*fields, file_name);
  if (!cameras) return fail(cameras.error());
  if (cameras->size() < 2)
    return fail(file_name,
                "is no calibration of a rig: looked for two or more cameras (cam0 and cam1 of Kalibr), or "
                "for M1 D1 M2 D2 R T of OpenCV");
  return chain_rig(*cameras, file_name, reading);
}

}  // namespace sigs
