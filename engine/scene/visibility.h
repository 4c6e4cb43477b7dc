// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "project/validate.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs {

// In how many frames an intruder is visible, and how large it is there. Counted from the truth of an export, or
// estimated without rendering (estimated_visibilities).
struct Visibility {
  int frames = 0;          // of the range
  int frames_checked = 0;  // of these; the counts below are of the checked frames
  int visible = 0;         // some of the intruder is in the image and not behind the own body
  int behind_camera = 0;   // all of it is
  int occluded = 0;        // it is in the image, all of that behind the own body
  double smallest_px = 0;  // where it is visible: longer side of the whole silhouette's box, not cut off by the image
  double largest_px = 0;
  bool is_estimate = false;
  bool has_attitude = true;  // false: none is known of the camera, which therefore looks along world X

  // Counts one more frame in which it is visible. size_px: longer side of the silhouette's box; <= 0: not known.
  void count_visible(double size_px);
};

// "visible in 112 of 200 frames, 8 to 61 px"; of an estimate "visible in about 112 of 200 frames, ..."; where not all
// frames were checked "visible in about 11 of 20 frames looked at (of 5000), ..."; "never visible in 200 frames".
[[nodiscard]] std::string text_of(const Visibility& visibility);

// A pixel of the own-body mask with at least this opacity occludes, for estimates and warnings.
inline constexpr float kOccludingOpacity = 0.5F;

enum class VisibilityState {
  in_view,          // some of the intruder is in the image, none of that behind the own body
  partly_occluded,  // part of what is in the image is behind the own body
  occluded,         // all of what is in the image is behind the own body
  out_of_view,      // nothing of it is in the image
};

// What is known of an intruder in one frame without rendering it.
struct VisibilityEstimate {
  int frame = 0;                  // of the footage, from 0
  double distance_m = 0;          // from the camera to the intruder's reference point
  double size_px = 0;             // longer side of the silhouette's box; 0 where it has no image
  std::optional<Box> silhouette;  // box of the whole silhouette, within 1 % of the annotation's amodal box
  VisibilityState visibility_state = VisibilityState::out_of_view;
  bool is_behind_camera = false;  // all of it, where the lens does not reach
};

// Estimates visibility in many frames of one scene. The silhouette is measured by the model's outermost points alone
// (scene/model.h). Its place in the image and behind the own body is judged by these points and by points between them
// and their mean, as if the silhouette were filled: a wing tip behind the own body is noticed, but so is sky between
// wing and tail. The scene must outlive the estimator.
class VisibilityEstimator {
 public:
  explicit VisibilityEstimator(const Scene& scene);

  // intruder: index in scene.intruders; frame: of the footage, from 0.
  [[nodiscard]] VisibilityEstimate at(int intruder, int frame) const;

  // Of all intruders of the scene, by index.
  [[nodiscard]] std::vector<VisibilityEstimate> all_at(int frame) const;

 private:
  [[nodiscard]] VisibilityEstimate of(const PlacedIntruder& placed, int frame) const;

  const Scene* scene_;
  Camera camera_;
};

// Whether some of any intruder is in the image of a frame (of the footage, from 0), by these estimates.
[[nodiscard]] bool any_in_view(const Scene& scene, int frame);

// Counts one more frame by its estimate.
void add(Visibility& visibility, const VisibilityEstimate& estimate);

// Estimated visibility of each intruder of the scene, from at most max_frames frames spread evenly over the scene's
// range, first and last included. For an intruder that is visible in none of these, all frames of the range are
// checked, so that one that is visible in between is not reported as never visible. At most some 100,000 estimates are
// made in all: with very many intruders and frames, fewer frames are checked.
[[nodiscard]] std::vector<Visibility> estimated_visibilities(const Scene& scene, int max_frames);

// The problem, in the field "intruders[0].trajectory", that an intruder is never visible, with the reasons by number of
// frames, or that it is below 1 px wherever it is. None where it is visible or no frame was checked.
//   intruder  index in the project's intruders
[[nodiscard]] std::optional<Problem> never_visible(const Visibility& visibility, const std::string& name,
                                                   std::size_t intruder);

}  // namespace sigs
