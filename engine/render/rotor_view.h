// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/pose.h"
#include "camera/virtual_camera.h"
#include "mesh/rotor.h"
#include "render/gl_objects.h"

namespace sigs {

// When the shutter is open, in which rotors turn. The rows of a rolling shutter are exposed one after the other, so the
// time changes over a view.
struct Shutter {
  // A guess for footage that does not tell: between a bright day (1/1000 s and less) and a dull one (1/200 s).
  static constexpr double kAssumedExposure_s = 1.0 / 500;

  double time_s = 0;                       // the middle of the exposure, of the whole image's middle row
  double exposure_s = kAssumedExposure_s;  // 0 or more
  double center_s = 0;                     // how much later the view's centre is exposed
  glm::dvec2 s_per_px{0, 0};               // how much later each pixel to the right and down
};

// The turn of the blades and where they are, for the program in use.
//   piece  of the view, which is drawn
void set_rotor_uniforms(const Program& program, const Rotor& rotor,
                        const Pose<frame::View, frame::Body>& view_from_body, const VirtualCamera& view,
                        const cv::Rect& piece, const Shutter& shutter);

}  // namespace sigs
