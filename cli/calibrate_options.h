// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/output_files.h"
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

  [[nodiscard]] std::vector<CommandOutput> outputs() const {
    return {{"--out", out}, {"--plot", plot}, {"--json", json}};
  }
};

// With a board (calibrate_board.cpp).
[[nodiscard]] Result<void> calibrate_with_board(const CalibrateOptions& options);

}  // namespace sigs::cli
