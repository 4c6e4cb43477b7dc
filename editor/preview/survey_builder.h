// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "editor/preview/previewer.h"

namespace sigs::editor {

// Makes the surveys of a scene bit by bit, so that a long one holds nothing up. Frames first, for all intruders side by
// side, then what is known of the whole flight.
class SurveyBuilder {
 public:
  // From the beginning.
  void begin(std::shared_ptr<const OpenedScene> scene);

  [[nodiscard]] bool done() const { return !scene_ || (next_frame_ > last_frame() && next_whole_ >= surveys_.size()); }

  // Goes on for about that long, at least one step. True where there is enough new to be shown.
  bool work(double budget_s);

  // What there is, one for each of the project's intruders; one that flies nowhere has an empty one.
  [[nodiscard]] std::vector<std::shared_ptr<const Survey>> surveys();

 private:
  [[nodiscard]] int last_frame() const { return scene_->draft.scene.last_frame; }
  void step();
  void look_at_frame(int frame);
  void look_at_whole(std::size_t intruder);

  std::shared_ptr<const OpenedScene> scene_;
  std::optional<VisibilityEstimator> points_;
  std::vector<Survey> surveys_;
  int next_frame_ = 0;
  std::size_t next_whole_ = 0;
  std::size_t handed_out_ = 0;  // frames
};

}  // namespace sigs::editor
