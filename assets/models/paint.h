// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "model.h"

namespace sigs::models {

using Colour = glm::dvec3;  // red, green, blue: diffuse reflectance 0..1, linear

[[nodiscard]] inline Colour grey(double reflectance) {
  return Colour(reflectance);
}

// Display code values 0..1 of a reflectance (sRGB, IEC 61966-2-1), as MTL files and textures have them.
[[nodiscard]] Colour display_colour(const Colour& reflectance);

// An image whose pixels are the mean of the reflectances at 5 x 5 places in each. place: x right, y down, 0..1 over the
// image.
[[nodiscard]] cv::Mat painted(cv::Size size_px, const std::function<Colour(const glm::dvec2& place)>& colour_at);

// Dirt that the air stream draws out along a surface: 0 where clean, 1 where dirtiest, some 0.1 m wide.
[[nodiscard]] double streaks(double across_m, double along_m);

// Letters as a mask: 1 inside, 0 outside, (0, 0) the upper left corner of the text, (1, 1) its lower right.
class Lettering {
 public:
  explicit Lettering(const std::string& text);
  [[nodiscard]] bool covers(double x, double y) const;
  [[nodiscard]] double aspect() const { return aspect_; }  // width over height

 private:
  cv::Mat mask_;
  double aspect_ = 1;
};

// Finishes of surfaces: reflectances of what is alike on all models.
inline constexpr double kTyre = 0.05, kSeam = 0.22, kOpening = 0.03;

// Lacquer and glass reflect 4 % (index of refraction 1.5); the renderer takes a quarter of Ks.
[[nodiscard]] MaterialSpec lacquer(const std::string& name, const Colour& reflectance);
[[nodiscard]] MaterialSpec lacquer_image(const std::string& name, const std::string& file);
[[nodiscard]] MaterialSpec matt(const std::string& name, const Colour& reflectance);
[[nodiscard]] MaterialSpec metal(const std::string& name, double reflectance);
[[nodiscard]] MaterialSpec glass(const std::string& name, double opacity);

// Lamps: light_red, light_green, light_white. The renderer has no light of a surface's own, so they are as bright as a
// lit surface can be.
[[nodiscard]] std::vector<MaterialSpec> lamps();

[[nodiscard]] std::vector<MaterialSpec> together(const std::vector<std::vector<MaterialSpec>>& lists);

}  // namespace sigs::models
