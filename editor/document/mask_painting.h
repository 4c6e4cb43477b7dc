// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs::editor {

// A round brush for masks, in pixels of the image. It covers a pixel completely where the pixel's centre lies up to
// radius_px - edge_px / 2 from its middle, not at all from radius_px + edge_px / 2 on, linearly between; with edge_px 0
// completely up to radius_px.
struct Brush {
  double radius_px = 20;
  double edge_px = 1;   // width of the soft edge, centred on the radius
  bool erases = false;  // true: takes the mask away instead of adding to it
};

inline constexpr double kMinRadius_px = 0.5;
inline constexpr double kMaxRadius_px = 500;

// Share of a pixel that the brush covers, 0..1, for the distance of the pixel's centre from the brush's centre.
[[nodiscard]] double covered(const Brush& brush, double distance_px);

// Moves the brush over a mask (CV_8UC1) in a straight line; a line of no length is a dot. What is covered becomes no
// less than that share of 255, or, where the brush erases, no more than the rest: passing twice changes nothing more.
// The pixels that may have changed; empty where the brush stays beside the image or a number is not finite.
cv::Rect move_brush(cv::Mat& mask, const Brush& brush, const glm::dvec2& from, const glm::dvec2& to);

// The next larger (steps > 0) or smaller radius, within the limits.
[[nodiscard]] double stepped_radius_px(double radius_px, int steps);

// Whether both, CV_8UC1, have the same bytes.
[[nodiscard]] bool is_same_mask(const cv::Mat& a, const cv::Mat& b);

// A mask as a PNG: 8 bits, one channel. Appears under its name when it is complete. Errors: cannot_create,
// write_failed.
[[nodiscard]] Result<void> write_mask(const cv::Mat& mask, const std::filesystem::path& path, bool overwrite);

// What write_mask wrote, CV_8UC1, of whatever size it has. Errors: cannot_read; bad_data where it is no such image.
[[nodiscard]] Result<cv::Mat> read_mask(const std::filesystem::path& path);

// A mask that is painted, with its history. A stroke is one step, and so is replacing the whole mask; undo restores
// every byte.
class MaskPainting {
 public:
  // Without a mask: the size of the image is not known yet, and nothing can be painted.
  MaskPainting() = default;
  // mask: CV_8UC1, copied; it counts as saved. States are numbered from first_state on, so that paintings that follow
  // each other have no number in common.
  explicit MaskPainting(const cv::Mat& mask, std::uint64_t first_state = 1);

  // The mask as it is painted, CV_8UC1. Later strokes change its pixels: clone it to keep it.
  [[nodiscard]] const cv::Mat& mask() const { return mask_; }
  [[nodiscard]] bool empty() const { return mask_.empty(); }

  // A stroke, from press to release, in pixels of the image. Its segments join without a gap. take_back_stroke()
  // restores the mask from before it.
  void begin_stroke(const Brush& brush, const glm::dvec2& at);
  void extend_stroke(const glm::dvec2& to);
  void end_stroke();
  void take_back_stroke();
  [[nodiscard]] bool is_stroking() const { return stroke_.has_value(); }

  void replace(const cv::Mat& mask, std::string name);  // another mask of the same size, as a step of its own

  [[nodiscard]] bool can_undo() const { return !past_.empty() && !stroke_; }
  [[nodiscard]] bool can_redo() const { return !future_.empty() && !stroke_; }
  [[nodiscard]] std::string undo_name() const { return past_.empty() ? "" : past_.back().name; }
  [[nodiscard]] std::string redo_name() const { return future_.empty() ? "" : future_.back().name; }
  void undo();
  void redo();

  // Number of the present state; each state has its own, and undo brings it back.
  [[nodiscard]] std::uint64_t state() const { return state_; }
  [[nodiscard]] bool has_unsaved_changes() const { return state_ != saved_state_; }
  void mark_saved() { saved_state_ = state_; }
  // For a mask that was recovered after a crash.
  void mark_unsaved() { saved_state_ = 0; }
  // The largest number that was given to a state so far.
  [[nodiscard]] std::uint64_t last_state() const { return last_state_; }
  // Whether there are strokes since the last mask that was set as a whole.
  [[nodiscard]] bool has_strokes() const { return state_ != whole_state_; }
  // Has has_strokes() return true for a mask whose strokes are not in the history (one that was recovered).
  void mark_strokes() { whole_state_ = 0; }
  // The state before these strokes.
  [[nodiscard]] std::uint64_t whole_state() const { return whole_state_; }

 private:
  struct Stroke {
    Brush brush;
    glm::dvec2 at{0, 0};
    cv::Mat before;
    cv::Rect touched;
  };
  // What a part of the image held before the step (in past_) or after it (in future_).
  struct Step {
    std::string name;
    cv::Rect place;
    cv::Mat other;
    std::uint64_t other_state = 0;
    std::uint64_t other_whole_state = 0;
  };

  void remember(std::string name, const cv::Rect& place, const cv::Mat& before, bool is_whole);
  void move_last(std::vector<Step>& from, std::vector<Step>& to);
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
