// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "scene/scene.h"
#include "scene/scene_at.h"
#include "scene/visibility.h"

namespace sigs {

enum class VisibilityState {
  in_view,          // some of it lies in the image, none of that behind the own body
  partly_occluded,  // part of what lies in the image is behind the own body
  occluded,         // all of it is
  out_of_view,
};

// What can be told of an intruder in a frame without drawing it.
struct VisibilityEstimate {
  int frame = 0;
  double distance_m = 0;
  double size_px = 0;             // longer side of the silhouette's box, 0 where it has no image
  std::optional<Box> silhouette;  // within 1 % of the annotation's
  VisibilityState visibility_state = VisibilityState::out_of_view;
  bool is_behind_camera = false;  // all of it
};

// Measures many frames of one scene quickly: a body is looked at by its outermost points alone
// (scene/measuring_points.h). For where it is seen, also by points between those and their middle, in the image: it
// counts as filled, so that a wing tip behind the own body is noticed, and sky between wing and tail as well. An own
// body of less than half opacity hides nothing. The scene must outlive it.
class VisibilityEstimator {
 public:
  explicit VisibilityEstimator(const Scene& scene);
  [[nodiscard]] VisibilityEstimate at(int intruder, int frame) const;

  // Of all intruders of the scene, by number.
  [[nodiscard]] std::vector<VisibilityEstimate> all_at(int frame) const;

 private:
  [[nodiscard]] VisibilityEstimate of(const PlacedIntruder& placed, int frame) const;

  const Scene* scene_;
  Camera camera_;
};

// How visible the scene's intruders are, estimated. Looks at up to `max_frames` frames, spread over the scene's with
// first and last; where an intruder is seen in none of these, at all of them, so that nobody is told that it is never
// seen because it was seen in between. Of scenes with very many intruders and frames fewer are looked at, some 100,000
// intruders in frames in all.
[[nodiscard]] std::vector<Visibility> estimated_visibilities(const Scene& scene, int max_frames);

// Adds one more frame.
void add(Visibility& visibility, const VisibilityEstimate& estimate);

// What is worth telling where an intruder is never visible, and why it is not: in "intruders[0].trajectory".
[[nodiscard]] std::optional<Problem> never_visible(const Visibility& visibility, const std::string& name,
                                                   std::size_t intruder);

}  // namespace sigs
