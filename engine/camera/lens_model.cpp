// SPDX-License-Identifier: MIT
#include "camera/lens_model.h"

#include <algorithm>
#include <array>

namespace sigs {
namespace {

constexpr std::size_t kBrownConradyCounts[] = {0, 4, 5, 8, 12, 14};
constexpr std::string_view kBrownConradyCoefficients[] = {"k1", "k2", "p1", "p2", "k3", "k4",    "k5",
                                                          "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"};
constexpr std::string_view kBrownConradyNames[] = {"plumb_bob",         "rational_polynomial", "thin_prism", "radtan",
                                                   "radial-tangential", "brown_conrady",       "none"};
constexpr std::size_t kKannalaBrandtCounts[] = {4};
constexpr std::string_view kKannalaBrandtCoefficients[] = {"k1", "k2", "k3", "k4"};
constexpr std::string_view kKannalaBrandtNames[] = {"equidistant",     "equi",          "fisheye", "kannala_brandt",
                                                    "kannala_brandt4", "opencv_fisheye"};
constexpr std::size_t kOmnidirectionalCounts[] = {1, 5, 6};
constexpr std::string_view kOmnidirectionalCoefficients[] = {"xi", "k1", "k2", "p1", "p2", "skew"};
constexpr std::string_view kOmnidirectionalNames[] = {"omnidirectional", "omni", "mei"};
constexpr std::size_t kTwoCoefficients[] = {2};
constexpr std::string_view kDoubleSphereCoefficients[] = {"xi", "alpha"};
constexpr std::string_view kDoubleSphereNames[] = {"double_sphere", "ds"};
constexpr std::string_view kExtendedUnifiedCoefficients[] = {"alpha", "beta"};
constexpr std::string_view kExtendedUnifiedNames[] = {"extended_unified", "eucm"};
constexpr std::size_t kNoCoefficients[] = {0};
constexpr std::string_view kEquirectangularNames[] = {"equirectangular", "spherical"};

constexpr std::array kModels{
    LensModelTraits{.model = LensModel::brown_conrady,
                    .name = "Brown-Conrady",
                    .word = "brown_conrady",
                    .names_in_files = kBrownConradyNames,
                    .coefficient_counts = kBrownConradyCounts,
                    .coefficient_names = kBrownConradyCoefficients,
                    .coefficients_text = "0, 4, 5, 8, 12 or 14 distortion",
                    .is_fisheye = false,
                    .needs_calibration = true},
    LensModelTraits{.model = LensModel::kannala_brandt,
                    .name = "Kannala-Brandt",
                    .word = "fisheye",
                    .names_in_files = kKannalaBrandtNames,
                    .coefficient_counts = kKannalaBrandtCounts,
                    .coefficient_names = kKannalaBrandtCoefficients,
                    .coefficients_text = "4 fisheye",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.model = LensModel::omnidirectional,
                    .name = "omnidirectional",
                    .word = "omnidirectional",
                    .names_in_files = kOmnidirectionalNames,
                    .coefficient_counts = kOmnidirectionalCounts,
                    .coefficient_names = kOmnidirectionalCoefficients,
                    .coefficients_text = "1, 5 or 6 omnidirectional",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.model = LensModel::double_sphere,
                    .name = "double sphere",
                    .word = "double_sphere",
                    .names_in_files = kDoubleSphereNames,
                    .coefficient_counts = kTwoCoefficients,
                    .coefficient_names = kDoubleSphereCoefficients,
                    .coefficients_text = "2 double sphere",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.model = LensModel::extended_unified,
                    .name = "extended unified",
                    .word = "extended_unified",
                    .names_in_files = kExtendedUnifiedNames,
                    .coefficient_counts = kTwoCoefficients,
                    .coefficient_names = kExtendedUnifiedCoefficients,
                    .coefficients_text = "2 extended unified",
                    .is_fisheye = true,
                    .needs_calibration = true},
    LensModelTraits{.model = LensModel::equirectangular,
                    .name = "equirectangular",
                    .word = "equirectangular",
                    .names_in_files = kEquirectangularNames,
                    .coefficient_counts = kNoCoefficients,
                    .coefficient_names = {},
                    .coefficients_text = "0 equirectangular",
                    .is_fisheye = false,
                    .needs_calibration = false},
};

constexpr bool is_complete() {
  for (std::size_t i = 0; i < kModels.size(); ++i) {
    const LensModelTraits& traits = kModels.at(i);
    if (static_cast<std::size_t>(traits.model) != i) return false;
    if (std::ranges::max(traits.coefficient_counts) != traits.coefficient_names.size()) return false;
  }
  return true;
}
static_assert(is_complete(), "rows in the order of LensModel, each with a name for every coefficient");

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
  return it->model;
}

}  // namespace sigs
