// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "camera/lens.h"
#include "reference/dual.h"

namespace sigs::truth {

// The lens models as OpenCV's documentation writes them (calib3d's "Detailed Description" and fisheye's), the
// equirectangular one as maps have it (Snyder 1987, chapter 12), those that look at spheres as their authors write the
// projection (Mei and Rives 2007, Usenko et al. 2018, Khomutenko et al. 2016), and their inverse to the last digits of
// Real. The only thing taken from the engine is the struct of parameters.
//
// Points lie on a plane: (x / z, y / z) for Brown-Conrady; longitude and latitude, the latter down, for the
// equirectangular model; for all others away from the axis by the angle from it. Its pixels are those of longitudes -pi
// to pi.
template <class Real>
class ExactLens {
 public:
  using Vec2 = glm::vec<2, Real>;
  using Vec3 = glm::vec<3, Real>;

  explicit ExactLens(const LensParameters& parameters);

  // Radius of the disk of the plane on which the map is one to one: up to the first circle on which the determinant of
  // the Jacobian (by automatic differentiation) is not positive somewhere, or the model has no value.
  [[nodiscard]] Real field_radius() const { return field_radius_; }
  [[nodiscard]] Real field_angle_rad() const;

  // Pixel of a point in the camera frame. Nothing beyond the field.
  [[nodiscard]] std::optional<Vec2> pixel(const Vec3& p_in_camera) const;

  // Point of the plane that a pixel shows, by Newton's method from a guess. Nothing where that does not converge within
  // the field: another guess may.
  [[nodiscard]] std::optional<Vec2> plane_point_near(const Vec2& pixel_px, const Vec2& guess) const;

  // The same from the nearest of some thousand known points.
  [[nodiscard]] std::optional<Vec2> plane_point(const Vec2& pixel_px) const;

  // Unit ray in the camera frame.
  [[nodiscard]] Vec3 ray_of(const Vec2& plane_point) const;
  [[nodiscard]] std::optional<Vec3> ray(const Vec2& pixel_px) const;

 private:
  using Number = Dual<Real>;
  struct Image {
    Number x;
    Number y;
    bool is_sane = true;  // no denominator has passed zero
  };
  // A unit direction, optical (x right, y down, z forward), of a point away from the axis by the angle from it.
  struct Ray {
    Number x;
    Number y;
    Number z;
  };
  [[nodiscard]] static Ray ray_by_angle(const Vec2& point);
  struct Known {
    Vec2 point;
    Vec2 pixel_px;
  };

  [[nodiscard]] Image brown_conrady(const Vec2& point) const;
  [[nodiscard]] Image kannala_brandt(const Vec2& point) const;
  [[nodiscard]] Image omnidirectional(const Ray& ray) const;
  [[nodiscard]] Image double_sphere(const Ray& ray) const;
  [[nodiscard]] Image extended_unified(const Ray& ray) const;
  [[nodiscard]] Image flat(const Vec2& point) const;
  [[nodiscard]] Image image(const Vec2& point) const;  // pixels, with their slopes
  [[nodiscard]] bool folds_at(Real radius) const;
  [[nodiscard]] Real first_fold() const;
  [[nodiscard]] std::vector<Known> known_points() const;

  LensModel model_;
  bool is_by_angle_;  // the plane's points lie away from the axis by the angle from it
  bool is_sphere_;
  Vec2 focal_px_;
  Vec2 center_px_;
  std::array<Real, 14> k_{};
  std::array<std::array<Real, 3>, 3> tilt_{};
  Real field_radius_ = 0;
  std::vector<Known> known_;
};

extern template class ExactLens<double>;
extern template class ExactLens<long double>;

}  // namespace sigs::truth
