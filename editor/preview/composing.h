// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "editor/preview/board.h"
#include "editor/preview/composer.h"
#include "editor/preview/picture_names.h"
#include "editor/preview/survey_maker.h"

namespace sigs::editor {

// The composing thread's work. Each step looks at what is wanted by then and does the first thing that is missing:
// the newest revision's wanted picture, what else the view asked for, and in turns the next frames, the survey and
// the model. A step that opens a revision composes it too, so edits that come faster than pictures starve nothing.
class Composing {
 public:
  explicit Composing(Board& board) : board_(board) {}

  // Until the board says stop.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // Each returns whether there was anything to do.
  bool step(const Turn& turn);
  bool show_wanted(const Turn& turn);
  bool show_extras(const Turn& turn);
  bool fetch_ahead(const Turn& turn);
  bool survey();
  bool turn_model(const Turn& turn);
  bool compose(int frame, bool was_wanted);

  void name_revision(const Turn& turn);
  void open_revision(const Turn& turn);
  [[nodiscard]] bool scene_fits() const { return scene_ && scene_state_ == state_; }
  [[nodiscard]] int clamped(int frame) const;
  [[nodiscard]] std::shared_ptr<const Decoded> footage_frame(int frame) const;

  Board& board_;
  Composer composer_;
  NameBook<PictureName> picture_names_;
  NameBook<FileStamp> footage_names_;

  std::uint64_t revision_ = 0;  // that was named last
  Clock::time_point named_{};
  std::uint64_t state_ = 0;
  FootageId footage_;

  std::shared_ptr<const OpenedScene> scene_;
  std::uint64_t scene_state_ = 0;
  std::uint64_t scene_footage_ = 0;

  SurveyMaker survey_maker_;
  std::uint64_t survey_state_ = 0;
  bool survey_is_shown_ = false;
  Clock::time_point survey_begun_{};

  struct ModelKey {
    std::uint64_t state = 0;
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;
    [[nodiscard]] bool operator==(const ModelKey&) const = default;
  };
  std::optional<ModelKey> model_;
  int whose_turn_ = 0;
};

}  // namespace sigs::editor
