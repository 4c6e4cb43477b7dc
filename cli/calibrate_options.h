// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "video/image_sequence.h"

namespace sigs::cli {

// What the command line of sigs calibrate says.
struct CalibrateOptions {
  std::vector<std::filesystem::path> inputs;  // a video, images, or folders of images
  std::string board;                          // "chessboard", "charuco"; empty: without a board
  std::string corners;                        // "9x6"
  double square_m = 0;                        // 0: not given
  double marker_m = 0;                        // likewise
  std::string dictionary;                     // empty: not given
  std::string model = "auto";
  std::filesystem::path out;
  std::filesystem::path plot;     // empty: none
  std::filesystem::path json;     // likewise
  SequenceTiming timing;          // without a board: of images
  std::filesystem::path log;      // without a board: with angular rates; empty: the video's own
  std::optional<double> fov_deg;  // without a board: horizontal field of view that the user knows
  int max_frames = 1800;          // without a board: that are looked at
  bool force = false;
  std::string progress = "auto";
};

// With a board (calibrate_board.cpp).
[[nodiscard]] Result<void> calibrate_with_board(const CalibrateOptions& options);

// Without one, from the footage itself (calibrate_command.cpp), and the options that only this has.
[[nodiscard]] Result<void> autocalibrate(const CalibrateOptions& options);
void add_autocalibration_options(CLI::App& command, CalibrateOptions& options);

}  // namespace sigs::cli
