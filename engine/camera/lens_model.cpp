// SPDX-License-Identifier: MIT
#include "camera/lens_model.h"

#include <algorithm>
#include <array>

namespace sigs {
namespace {

constexpr std::size_t kBrownConradyCounts[] = {0, 4, 5, 8, 12, 14};
constexpr std::string_view kBrownConradyNames[] = {"plumb_bob",         "rational_polynomial", "thin_prism", "radtan",
                                                   "radial-tangential", "brown_conrady",       "none"};
constexpr std::size_t kKannalaBrandtCounts[] = {4};
constexpr std::string_view kKannalaBrandtNames[] = {"equidistant",     "equi",          "fisheye", "kannala_brandt",
                                                    "kannala_brandt4", "opencv_fisheye"};
constexpr std::size_t kOmnidirectionalCounts[] = {1, 5, 6};
constexpr std::string_view kOmnidirectionalNames[] = {"omnidirectional", "omni", "mei"};
constexpr std::size_t kTwoCoefficients[] = {2};
constexpr std::string_view kDoubleSphereNames[] = {"double_sphere", "ds"};
constexpr std::string_view kExtendedUnifiedNames[] = {"extended_unified", "eucm"};
constexpr std::size_t kNoCoefficients[] = {0};
constexpr std::string_view kEquirectangularNames[] = {"equirectangular", "spherical"};

constexpr std::array kModels{
    LensModelTraits{.name = "Brown-Conrady",
                    .word = "brown_conrady",
                    .names_in_files = kBrownConradyNames,
                    .coefficient_counts = kBrownConradyCounts,
                    .coefficients_text = "0, 4, 5, 8, 12 or 14 distortion",
                    .is_fisheye = false,
                    .needs_calibration = true},
    LensModelTraits{.name = "Kannala-Brandt",
                    .word = "fisheye",
                    .names_in_files = kKannalaBrandtNames,
                    .coefficient_counts = kKannalaBrandtCounts,
                    .coefficients_text = "4 fisheye",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.name = "omnidirectional",
                    .word = "omnidirectional",
                    .names_in_files = kOmnidirectionalNames,
                    .coefficient_counts = kOmnidirectionalCounts,
                    .coefficients_text = "1, 5 or 6 omnidirectional",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.name = "double sphere",
                    .word = "double_sphere",
                    .names_in_files = kDoubleSphereNames,
                    .coefficient_counts = kTwoCoefficients,
                    .coefficients_text = "2 double sphere",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.name = "extended unified",
                    .word = "extended_unified",
                    .names_in_files = kExtendedUnifiedNames,
                    .coefficient_counts = kTwoCoefficients,
                    .coefficients_text = "2 extended unified",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.name = "equirectangular",
                    .word = "equirectangular",
                    .names_in_files = kEquirectangularNames,
                    .coefficient_counts = kNoCoefficients,
                    .coefficients_text = "0 equirectangular",
                    .is_fisheye = false,
                    .needs_calibration = false},
};

}  // namespace

std::span<const LensModelTraits> lens_models() {
  return kModels;
}

const LensModelTraits& traits_of(LensModel model) {
  return kModels.at(static_cast<std::size_t>(model));
}

std::optional<LensModel> lens_model_named(std::string_view name_in_file) {
  const auto* const it = std::ranges::find_if(kModels, [&](const LensModelTraits& traits) {
    return std::ranges::find(traits.names_in_files, name_in_file) != traits.names_in_files.end();
  });
  if (it == kModels.end()) return std::nullopt;
  return static_cast<LensModel>(it - kModels.begin());
}

}  // namespace sigs
