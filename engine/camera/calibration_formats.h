// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "camera/lens.h"

namespace sigs::calibration {

// The value of one key of a calibration file, the same for all formats: a number, a list, a list of lists (read row by
// row) or a matrix with its rows, cols and data.
struct Field {
  std::string name{};  // as written in the file, for messages
  std::vector<double> numbers{};
  std::optional<std::size_t> stated_count{};  // rows x cols, where the file states them
  std::string text{};                         // of a single value
  std::optional<std::string> not_a_number{};  // the first element that is not a number
};

// The fields of a file by key. Formats with keys of their own (Gyroflow) are translated to OpenCV's keys.
struct Fields : std::map<std::string, Field, std::less<>> {
  struct Group;
  std::vector<Group> groups;  // maps of YAML and JSON that are no matrix, in the file's order: cam0, cam1 of Kalibr
  // Only Gyroflow's profiles state these:
  double kept_share = 1;      // share of each side of the image that the camera's stabilisation has kept
  cv::Point2d stretch{1, 1};  // how much wider and higher than the footage the calibration's images are
  std::vector<Warning> warnings{};
};

struct Fields::Group {
  std::string name;
  Fields fields;
};

// The field of the first of these names that there is; nullptr: of none.
[[nodiscard]] const Field* found(const Fields& fields, std::span<const std::string_view> names);

// The fields of a calibration text, whose format is recognised by how it begins:
//   '<'            OpenCV FileStorage XML
//   '{'            JSON. A text with fisheye_params is a Gyroflow lens profile: fisheye_params holds matrix and
//                  coefficients of the OpenCV fisheye model for images of calib_dimension. Its stabilisation crop and
//                  stretches are read; crops that only its compatible_settings name give a warning. Other distortion
//                  models and a second ("digital") lens are errors that name them. Other JSON is read like YAML
//   anything else  YAML as ROS (camera_info), Python scripts and OpenCV's FileStorage (first line "%YAML:1.0") write it
// Errors (bad_data) name file_name and, where known, the line or the key. Texts nested deeper than kMaxNesting
// (base/input_file.h) and aliases in YAML are errors.
[[nodiscard]] Result<Fields> fields_in(const std::string& text, const std::string& file_name);

// Kalibr's keys of one camera as those of a file of one camera: camera_model, intrinsics, resolution.
//   prefix  of the fields' names in messages: "cam1."
// Errors (bad_data) name file and field: a camera model that is not known, intrinsics of another number, a distortion
// that the camera model does not come with here.
[[nodiscard]] Result<Fields> from_kalibr(Fields fields, const std::string& prefix, const std::string& file_name);

// The cameras of a file by name, each in the keys of a file of one camera, with what ties it to the others (T_cn_cnm1,
// T_cam_imu) left among its fields. Which files: rig_calibration.h. A file of one camera alone gives it without a name.
// Errors (bad_data) name file and field: those of from_kalibr().
[[nodiscard]] Result<std::vector<Fields::Group>> cameras_in(const Fields& fields, const std::string& file_name);

// The camera that the fields of one describe. Parameters and errors as those of read_calibration().
[[nodiscard]] Result<Camera> camera_of(const Fields& fields, const std::string& file_name,
                                       std::optional<cv::Size> footage_size_px, std::optional<LensModel> wanted_model,
                                       const std::optional<ImagePart>& part = std::nullopt);

// The fields of a file. Errors as those of fields_in(), and cannot_read.
[[nodiscard]] Result<Fields> fields_of_file(const std::filesystem::path& path);

// Error where a field has an element that is no finite number, or not as many as its rows and cols say.
[[nodiscard]] Result<void> check_numbers(const Field& field, const std::string& file_name);

// Shortest text that reads back as the number; "nan" whatever the sign.
[[nodiscard]] std::string text_of(double number);

// Whether a calibration fits the footage and is plausible: what the file leaves open is assumed, another
// image size is scaled to, and warnings name what is implausible.

// A lens model, and the reason for it where the file does not state one.
struct AssumedModel {
  LensModel model = LensModel::brown_conrady;
  std::string why;  // empty: there is only one model with these coefficients
};

// The model of coefficients for which the file states none. Four can be OpenCV's Brown-Conrady k1 k2 p1 p2 or its
// fisheye k1 k2 k3 k4. The tangential p1 p2 describe a lens that is not parallel to its sensor and are thousandths to
// hundredths: larger ones are taken as fisheye, all else as Brown-Conrady, as in OpenCV's own functions. Four zeros are
// a pinhole.
[[nodiscard]] AssumedModel assumed_model(std::span<const double> coefficients);

// Why a matrix without a stated image size cannot belong to images of this size: its principal point lies outside them.
// Empty where it can.
[[nodiscard]] std::string why_not_made_for(const LensParameters& lens, cv::Size size_px);

// One text for each thing about the intrinsics that is hardly intended: a principal point outside the image or, where
// the file states no size, far from its middle; a field of view below 1 degree or, of a pinhole, above 166, of a
// fisheye above 360.
[[nodiscard]] std::vector<std::string> matrix_warnings(const LensParameters& lens, cv::Size size_px,
                                                       bool size_is_stated);

// Whether a calibration made for made_px can be scaled to images of this size: they have the same shape.
[[nodiscard]] bool has_shape_of(cv::Size made_px, cv::Size size_px);

// The intrinsics after the camera has cropped the image to this share of each side, around the middle, and enlarged it
// to the old size.
void crop(LensParameters& lens, cv::Size size_px, double kept_share);

// Whether a calibration that was made for images of this size was made for the larger ones that the footage is a part
// of. Error: it may be either.
[[nodiscard]] Result<bool> is_made_for_whole(cv::Size made_px, cv::Size part_px, const ImagePart& part,
                                             const std::string& file_name);

// The lens of a calibration for images of from_px after they are resized to to_px, each side by its own scale.
// Shapes count as the same where they differ by at most 1 %, as with encoders that require sides of whole blocks
// (848x480 for 853.3x480); otherwise the error names both. Where they differ by more than the rounding of half a pixel,
// a warning states both scales, and how far off the image's edges are if the camera has cropped instead.
//   stretch    how much wider and higher the calibration's images are than the footage (Gyroflow's anamorphic lenses)
//   file_name  for messages
//   warnings   receives the warning
[[nodiscard]] Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                                        const cv::Point2d& stretch, const std::string& file_name,
                                                        std::vector<Warning>& warnings);

}  // namespace sigs::calibration
