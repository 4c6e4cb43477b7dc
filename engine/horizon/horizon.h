// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "horizon/sky_map.h"

namespace sigs {

// A straight edge across the image, as the far edge of the sea or of a plain is: a great circle on the sphere.
struct HorizonLine {
  int frame = 0;
  glm::dvec3 up;      // unit, camera axes, normal of the circle's plane, on the side of the image's upper border
  double sd_rad = 0;  // of the fit
  // By how much the edge may lie off the level, by the image itself; 0: by nothing.
  double haze_rad = 0;   // below it, as far ground fades into the sky
  double hills_rad = 0;  // above it
};

// The longest such edge below a sky. Candidates are the rows of each fifth column at which it is brighter above than
// below by 4 codes or more; two of them define a plane, and the plane that has most columns side by side is fitted to
// those (Fischler, Bolles 1981). Nothing where they are fewer than a quarter of the image's columns, or where what lies
// above the edge is rougher than 0.7 of what lies below. Rolls beyond 60 degrees are not seen.
//
// Sky: each candidate has some above it (sky_map.h). 0.7 of what lies above the plane is sky, the rest stands on the
// ground; of what lies below it at most 0.15, and in at most 0.3 times as many columns as have the edge: ground may
// rise above the horizon, but sky is never below it, as it is beside a roof or a slope. The plane crosses nine tenths
// of the image's columns, or has at least 0.15 of the image on each side: less is not told from a roof in the corner.
// Up to four planes are tried.
//
// Haze: ground at distance d shows exp(-d / visual range) of its contrast against the sky (Koschmieder 1924). Seen from
// height h that is exp(-a / t) at the angle t below the level, with a = h / visual range. It falls most steeply at
// t = a / 2, where the edge is found, by 4 / (a e^2) of all of it: an edge that is as wide as w (contrast over greatest
// slope) lies 2 w / e^2 too low. Hills: heights that spread evenly from the level to the highest peak have a mean of
// sqrt(3) times their standard deviation, which the skyline shows.
//   reduced   CV_8UC1, the frame reduced by `scale`
//   own_body  of the footage's size, above 127 where the own body is; may be empty
[[nodiscard]] std::optional<HorizonLine> horizon_in(const cv::Mat& reduced, double scale, const Camera& camera,
                                                    const cv::Mat& own_body, int frame);

// An image of luma reduced for horizon_in() and sky_map_of(): its longer side is at most 640 px.
struct ReducedLuma {
  cv::Mat luma;  // CV_8UC1
  double scale = 1;
};
[[nodiscard]] ReducedLuma reduced_luma(const cv::Mat& luma);

// The camera's pitch where it is not rolled and the lower end of the sky is level: the median over the columns. For
// images without a straight horizon, with woods, hills and houses: off by some degrees, mostly upwards less than that.
// Nothing where fewer than 0.6 of the columns begin with sky, or where it ends within the image in fewer than half.
//   scale  as of horizon_in()
[[nodiscard]] std::optional<double> skyline_pitch_rad(const SkyMap& sky, double scale, const Camera& camera);

// What lines of several frames say together.
struct Level {
  glm::dvec3 up_in_start;  // unit, in the axes of the camera at frame 0
  double sd_rad = 0;  // of roll and pitch; the horizon's dip below the level, which is not known, haze and hills are
                      // part of it
  int lines = 0;      // that agree
};

// Lines that stay in place while the camera turns belong to the horizon; roads and shores do not. Nothing where fewer
// than 5 lines, or fewer than half of all, agree within half a degree.
//   start_from_camera  of each frame
[[nodiscard]] std::optional<Level> level_of(std::span<const HorizonLine> lines,
                                            std::span<const glm::dquat> start_from_camera);

// The rotation from the axes of the camera at frame 0 to a level world whose X is its heading.
[[nodiscard]] glm::dquat world_from_start(const glm::dvec3& up_in_start);

}  // namespace sigs
