// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/brush.h"

namespace sigs::editor {

// A mask that is painted, and its history. Every stroke is one step, so is every other mask that takes its place; undo
// brings back the very bytes.
class MaskPainting {
 public:
  // None: no image is known yet, and nothing can be painted.
  MaskPainting() = default;
  // CV_8UC1. It counts as saved. States are numbered from first_state on: who begins one painting after the other
  // keeps them apart so.
  explicit MaskPainting(const cv::Mat& mask, std::uint64_t first_state = 1);

  // Changes with what is painted: copy what is to be kept.
  [[nodiscard]] const cv::Mat& mask() const { return mask_; }
  [[nodiscard]] bool empty() const { return mask_.empty(); }

  // From press to release. Pieces of a stroke join without a gap; one that is taken back leaves no trace.
  void begin_stroke(const Brush& brush, const glm::dvec2& at);
  void extend_stroke(const glm::dvec2& to);
  void end_stroke();
  void take_back_stroke();
  [[nodiscard]] bool is_stroking() const { return stroke_.has_value(); }

  // Another mask of the same size, as a step of its own.
  void replace(const cv::Mat& mask, std::string name);

  [[nodiscard]] bool can_undo() const { return !past_.empty() && !stroke_; }
  [[nodiscard]] bool can_redo() const { return !future_.empty() && !stroke_; }
  [[nodiscard]] std::string undo_name() const { return past_.empty() ? "" : past_.back().name; }
  [[nodiscard]] std::string redo_name() const { return future_.empty() ? "" : future_.back().name; }
  void undo();
  void redo();

  // A number of its own for each state; undo comes back to the one it had.
  [[nodiscard]] std::uint64_t state() const { return state_; }
  [[nodiscard]] bool has_unsaved_changes() const { return state_ != saved_state_; }
  void mark_saved() { saved_state_ = state_; }
  // One that was recovered after a crash is on no disk that counts.
  void mark_unsaved() { saved_state_ = 0; }
  // The largest number that was given to a state so far.
  [[nodiscard]] std::uint64_t last_state() const { return last_state_; }
  // Strokes by hand since the last mask that came as a whole.
  [[nodiscard]] bool has_strokes() const { return state_ != whole_state_; }
  // There are such strokes already, though their steps are not known.
  void mark_strokes() { whole_state_ = 0; }
  // The state that had this mask, before these strokes.
  [[nodiscard]] std::uint64_t whole_state() const { return whole_state_; }

 private:
  struct Stroke {
    Brush brush;
    glm::dvec2 at{0, 0};
    cv::Mat before;
    cv::Rect touched;
  };
  // What a part of the image held on the other side of the step.
  struct Step {
    std::string name;
    cv::Rect place;
    cv::Mat other;
    std::uint64_t other_state = 0;
    std::uint64_t other_whole_state = 0;
  };

  void remember(std::string name, const cv::Rect& place, const cv::Mat& before, bool is_whole);
  void swap_with(Step& step);
  void move(const glm::dvec2& to);
  void forget_oldest();

  cv::Mat mask_;
  std::uint64_t state_ = 1;
  std::uint64_t last_state_ = 1;
  std::uint64_t saved_state_ = 1;
  std::uint64_t whole_state_ = 1;
  std::optional<Stroke> stroke_;
  std::vector<Step> past_;
  std::vector<Step> future_;
};

}  // namespace sigs::editor
