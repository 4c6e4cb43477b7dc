// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// Polynomials of the place in an image that clear sky follows: of the second degree across (u) and of the fourth down
// (v), both from -1 to 1.
inline constexpr int kSkyTerms = 8;
using SkyTerms = std::array<double, kSkyTerms>;

[[nodiscard]] SkyTerms sky_terms(double u, double v);
[[nodiscard]] double value_of(const SkyTerms& fit, const SkyTerms& terms);

// A place of the sky.
struct SkyPlace {
  SkyTerms terms{};
  cv::Vec3f light;        // linear red, green, blue
  double saturation = 0;  // blue less red, of the luminance
};

// Weighted least squares, held a little towards 0 where the sky does not determine a term, and more so across the
// image: clear sky differs from row to row, and clouds on one side are not to pass for it.
[[nodiscard]] SkyTerms fitted(const std::vector<SkyPlace>& samples, const std::function<double(const SkyPlace&)>& value,
                              const std::function<double(const SkyPlace&)>& weight);

// The bluest sky: the 0.97 expectile of saturation, in which residuals above count 0.97 and those below 0.03.
[[nodiscard]] SkyTerms bluest(const std::vector<SkyPlace>& samples);

}  // namespace sigs
