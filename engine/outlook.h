// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/image.h"
#include "scene/scene.h"

namespace sigs {

enum class Sighting {
  in_view,        // some of it lies in the picture, none of that behind the own body
  partly_hidden,  // part of what lies in the picture is behind the own body
  hidden,         // all of it is
  out_of_view,
};

// What can be told of an intruder in a frame without drawing it.
struct Outlook {
  int frame = 0;
  double distance_m = 0;
  double size_px = 0;             // longer side of the silhouette's box, 0 where it has no image
  std::optional<Box> silhouette;  // within 1 % of the annotation's
  Sighting sighting = Sighting::out_of_view;
};

// Measures many frames of one scene quickly: a body is looked at by its outermost points alone
// (scene/measuring_points.h). For where it is seen, also by points between those and their middle, in the picture: it
// counts as filled, so that a wing tip behind the own body is noticed, and sky between wing and tail as well. An own
// body of less than half opacity hides nothing. The scene must outlive it.
class OutlookPoints {
 public:
  explicit OutlookPoints(const Scene& scene);
  [[nodiscard]] Outlook at(int intruder, int frame) const;

 private:
  const Scene* scene_;
  Camera camera_;
};

}  // namespace sigs
