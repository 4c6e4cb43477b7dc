// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace sigs {

// The lens models, and what tells them apart where nothing is computed by them. Their formulas are in
// distortion_models.h; README.md says how one is added.
enum class LensModel {
  brown_conrady,     // OpenCV calib3d: 0, 4, 5, 8, 12 or 14 coefficients k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty
  kannala_brandt,    // OpenCV fisheye: 4 coefficients k1 k2 k3 k4
  omnidirectional,   // OpenCV omnidir, Kalibr omni: xi, or xi k1 k2 p1 p2, or these and the skew as a share of fx
  double_sphere,     // 2 coefficients xi alpha
  extended_unified,  // 2 coefficients alpha beta
  equirectangular,   // 360 degree footage: columns are azimuths, rows elevations; no coefficients
};

struct LensModelTraits {
  LensModel model;
  const char* name;       // for people, by its authors: "Brown-Conrady"
  std::string_view word;  // in footage.lens_model, and in messages about files
  std::span<const std::string_view>
      names_in_files;  // values of distortion_model in calibration files; written: the first
  std::span<const std::size_t> coefficient_counts;      // those that it can have
  std::span<const std::string_view> coefficient_names;  // in their order
  const char* coefficients_text;                        // in messages: "4 fisheye"
  bool is_fisheye;         // its images reach 90 degrees from the axis and beyond, round about the axis
  bool needs_calibration;  // the image's size alone does not determine the lens
};

// Of all models, in the order of LensModel.
[[nodiscard]] std::span<const LensModelTraits> lens_models();

[[nodiscard]] const LensModelTraits& traits_of(LensModel model);

// The model with this name in calibration files; none has it.
[[nodiscard]] std::optional<LensModel> lens_model_named(std::string_view name_in_file);

[[nodiscard]] inline const char* name_of(LensModel model) {
  return traits_of(model).name;
}
[[nodiscard]] inline bool is_fisheye(LensModel model) {
  return traits_of(model).is_fisheye;
}

// Whether footage of this model has to name a calibration file; none: the model that a file states.
[[nodiscard]] inline bool needs_calibration(std::optional<LensModel> model) {
  return !model || traits_of(*model).needs_calibration;
}

}  // namespace sigs
