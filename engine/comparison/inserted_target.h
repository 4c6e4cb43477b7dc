// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "base/result.h"
#include "comparison/measured_target.h"
#include "frame/compose_context.h"
#include "project/project.h"
#include "scene/posed_intruder.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

namespace sigs {

// Whether the intruder moves with the camera's shake, as a project's does that has the camera's track. The shake is
// taken from the real target's path.
enum class CameraShake { none, as_real_target };

// From where the intruder is seen, and how that changes.
struct InsertedView {
  std::uint32_t seed = 1;     // chooses among the attitudes
  int tries = 1;              // views to choose from: the one whose silhouette's area is most like the real one's
  double highest_rad = 0.45;  // elevation above the horizon: what is seen small is far, and so low
  std::optional<double> growth_per_s = {};  // as IntruderPose::growth_per_s; none: it flies with 60 m/s
};

// The first intruder of a project, put into the frames of a real target, with a silhouette as wide and of about the
// same aspect as the real one's, moving as that moves.
class Insertion {
 public:
  // Chooses the attitude and finds the distance. The project's footage and camera give way to the clip's frames.
  //   middle_px  where, in the middle frame (similar_place() in appearance/target_silhouette.h)
  // The stretch, files and context must outlive this object. Errors: as posed_scene and compose_frame.
  [[nodiscard]] static Result<Insertion> make(const Project& project, const Stretch& stretch, const FootageShape& shape,
                                              const MeasuredTarget& real, cv::Point2d middle_px,
                                              const InsertedView& view, SceneFiles& files, ComposeContext& context);

  // The frames with the intruder of a project that differs from the one above only in how things look, and its boxes.
  struct Composed {
    std::vector<Frame> frames;
    std::vector<Box> boxes;  // loose
  };
  [[nodiscard]] Result<Composed> composed(const Project& project, CameraShake shake);

  // The middle frame alone, measured; without flicker. None as below.
  [[nodiscard]] Result<std::optional<MeasuredTarget>> middle_target(const Project& project, CameraShake shake);

  // All frames, measured. None where it cannot be told from the background, or lies outside the image.
  [[nodiscard]] Result<std::optional<MeasuredTarget>> target(const Project& project, CameraShake shake);

 private:
  Insertion(const Stretch& stretch, const FootageShape& shape, SceneFiles& files, ComposeContext& context)
      : stretch_(&stretch), shape_(shape), files_(&files), context_(&context) {}
  [[nodiscard]] Result<Composed> composed_between(const Project& project, std::size_t first, std::size_t end);

  const Stretch* stretch_;
  FootageShape shape_;
  SceneFiles* files_;
  ComposeContext* context_;
  IntruderPose pose_;
  std::vector<cv::Point2d> real_path_px_;
};

}  // namespace sigs
