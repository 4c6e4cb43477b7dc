// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "comparison/inserted_target.h"
#include "realism/samples.h"

namespace sigs::bench {

// A target to follow: frames and its box in each.
struct TrackedTarget {
  std::vector<Frame> frames;
  std::vector<Box> boxes;
};

// In what an inserted target equals the real one, beyond the width in the middle frame, the aspect and the boxes' size.
struct Equalities {
  const char* name;         // what the last of them adds; "" for none
  bool path = false;        // it goes as the real target's silhouette does, not as the hand-drawn boxes
  bool growth = false;      // it grows or shrinks as the real target's silhouette
  bool silhouette = false;  // as large a silhouette: of all models and some views the most similar one
  bool contrast = false;    // the same contrast (Weber, root of the mean square)
};

inline constexpr Equalities kNoEquality{.name = ""};
inline constexpr Equalities kEqualitySteps[] = {
    kNoEquality,
    {.name = "path", .path = true},
    {.name = "growth", .path = true, .growth = true},
    {.name = "silhouette", .path = true, .growth = true, .silhouette = true},
    {.name = "contrast", .path = true, .growth = true, .silhouette = true, .contrast = true}};

// What a target is like, measured in its frames alone. 0 where it is not found.
struct TargetFigures {
  double area_px = 0, aspect = 0, weber_rms = 0;  // of its silhouette in the middle frame
  double growth_per_s = 0;                        // of the root of the silhouette's area, share per second
  int frames_cut = 0;                             // in which a part of its box lies outside the image
};

// The targets that are put into one clip beside its real one, all at the same place.
class TrackerTargets {
 public:
  // None where the clip does not give 61 successive frames with boxes, where its target is not found in the middle
  // one, or where there is no other place for its path.
  [[nodiscard]] static std::optional<TrackerTargets> make(const RealClip& clip, const SampleOptions& options);
  [[nodiscard]] TrackedTarget real() const { return {stretch_.frames, stretch_.boxes}; }

  // The real target itself, cut out and put to the place; none where it is not found in each frame.
  [[nodiscard]] std::optional<TrackedTarget> moved() const;

  // Looks once for the model and the view with the silhouette most like the real target's, as it is with these
  // settings.
  void look_for_silhouette(const LookSettings& settings, Workplace& workplace);

  // None where it lies outside the image, or where no light gives the same contrast.
  [[nodiscard]] std::optional<TrackedTarget> inserted(const LookSettings& settings, const Equalities& equal,
                                                      Workplace& workplace) const;

  [[nodiscard]] TargetFigures figures_of(const TrackedTarget& target) const;

 private:
  // Model and view with a silhouette like the real target's.
  struct Chosen {
    Project project;
    InsertedView view;
  };
  [[nodiscard]] Insertion insertion_of(const Chosen& chosen, const MeasuredTarget& real, Workplace& workplace) const;
  [[nodiscard]] std::vector<Box> boxes_of(const Insertion::Composed& composed, bool on_own_path) const;

  RealClip clip_;
  Stretch stretch_;
  FootageShape shape_;
  Project project_;
  ModelSettings similar_model_;
  InsertedView similar_view_;
  MeasuredTarget real_;
  std::vector<cv::Point2d> box_path_px_, own_path_px_;
  double growth_per_s_ = 0;
  cv::Point2d place_px_;
  std::uint32_t seed_ = 0;
};

}  // namespace sigs::bench
