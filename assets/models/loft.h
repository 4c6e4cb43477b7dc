// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "model.h"
#include "patch.h"

namespace sigs::models {

// Piecewise cubic through (x, y) that does not overshoot (Fritsch and Carlson 1980); constant beyond the ends.
class SmoothCurve {
 public:
  explicit SmoothCurve(std::vector<glm::dvec2> points);
  [[nodiscard]] double operator()(double x) const;

 private:
  std::vector<glm::dvec2> points_;
  std::vector<double> slopes_;
};

// One airfoil of a wing: where its nose lies and how it is turned. Chord runs backwards (-x).
struct WingStation {
  glm::dvec3 leading_edge_m;
  double chord_m = 1;
  double thickness = 0.12;   // share of the chord
  double incidence_rad = 0;  // nose up
  glm::dvec3 up{0, 0, 1};    // unit, across the chord
  double camber = 0.015;     // share of the chord
};

// Trailing edge, over the upper side to the nose, back along the lower side; 2 * points + 1 points.
// Thickness after NACA 4-digit with a closed trailing edge (Abbott and von Doenhoff, 1959).
[[nodiscard]] Ring airfoil(const WingStation& station, int points);

// A lofted wing with both ends closed. Texture: u runs from the first station to the last, v around the airfoil from
// the upper trailing edge (1) over the nose (0.5) to the lower one (0).
[[nodiscard]] Patch wing(const std::vector<WingStation>& stations, int points, const std::string& material);

// A body of revolution around x: profile points are (x, radius). Texture: u along the profile, v around.
[[nodiscard]] Patch revolved(const std::vector<glm::dvec2>& profile, int sides, const std::string& material);

// A flat disc facing along +x, radius_m around the origin. Texture: the disc is the circle inscribed in the image.
[[nodiscard]] Patch disc(double radius_m, int sides, const std::string& material);

// A streamlined strut between two points: an ellipse of chord_m along x and thickness_m across, both ends closed.
[[nodiscard]] Patch strut(const glm::dvec3& from_m, const glm::dvec3& to_m, double chord_m, double thickness_m,
                          const std::string& material);

// A round tube through points, each piece with closed ends that reach into the next.
[[nodiscard]] Patch tube(const std::vector<glm::dvec3>& points_m, double diameter_m, const std::string& material);

// An ovoid: half axes in metres, blunt in front, elongated behind (tail_stretch times as long behind as in front).
[[nodiscard]] Patch teardrop(const glm::dvec3& half_axes_m, double tail_stretch, int sides,
                             const std::string& material);

// Blades that turn. Their disc is a material of its own, whose statements let the renderer turn them.
struct TurningBlades {
  std::string material;
  int count = 2;
  double root_m = 0.1;  // radius at which the blades begin
  double tip_m = 1;     // and end
  double root_chord_m = 0.1;
  double tip_chord_m = 0.1;
  double rpm = 0;       // positive: counter-clockwise for an eye to which the disc's x axis points
  double coning_m = 0;  // how much higher (+x) the tips lie than the roots
  double reflectance = 0.05;
};

// The ring around the x axis in which the blades are, one layer, facing +x. Its rims lie beyond roots and tips, so that
// no blade is cut by the straight sides.
[[nodiscard]] Patch blade_disc(const TurningBlades& blades, int rings, int sides);

// Matt, so that no glass is seen in it. For programs that know no rotors it is as opaque as the blades are on average.
[[nodiscard]] MaterialSpec blade_material(const TurningBlades& blades);

}  // namespace sigs::models
