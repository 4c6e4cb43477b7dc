// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "cli/calibrate_options.h"
#include "cli/commands.h"
#include "cli/options.h"

namespace sigs::cli {

namespace {

constexpr const char* kCalibrateFooter =
    "Examples:\n"
    "  sigs calibrate board.mp4 --board chessboard --corners 9x6 --square-m 0.025 --out camera.xml\n"
    "  sigs calibrate board.mp4 --board charuco --corners 10x7 --square-m 0.03 --marker-m 0.022 \\\n"
    "    --dictionary DICT_5X5_100 --out camera.xml --plot residuals.png\n"
    "  sigs calibrate flight.mp4 --out rough.xml --json rough.json";

// What the board is, and which lens is fitted to it.
void add_board_options(CLI::App& command, CalibrateOptions& options) {
  command.add_option("--board", options.board, "what was shown to the camera; without it a rough calibration")
      ->option_text("chessboard|charuco")
      ->check(CLI::IsMember({"chessboard", "charuco"}));
  command.add_option("--corners", options.corners, "inner corners in a row and in a column: one less than squares")
      ->option_text("9x6");
  command.add_option("--square-m", options.square_m, "side of a square, metres")
      ->option_text("M")
      ->check(from_to(1e-5, 1e3));
  command.add_option("--marker-m", options.marker_m, "charuco: side of a marker, metres")
      ->option_text("M")
      ->check(from_to(1e-5, 1e3));
  command.add_option("--dictionary", options.dictionary, "charuco: the markers' dictionary, as DICT_4X4_50")
      ->option_text("NAME");
  command.add_option("--model", options.model, "the lens model; auto: the one with the smallest held-out error")
      ->option_text("auto|pinhole|brown-conrady|fisheye")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "pinhole", "brown-conrady", "fisheye"}));
}

}  // namespace

Command add_calibrate_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("calibrate", "find the lens of a camera, with a board or roughly");
  const auto options = std::make_shared<CalibrateOptions>();
  command->add_option("INPUT", options->inputs, "a video, or images of the same size")->required()->check(not_empty());
  add_board_options(*command, *options);
  command->add_option("--out", options->out, "the calibration, as OpenCV XML")
      ->option_text("FILE")
      ->required()
      ->check(output_path());
  command->add_option("--plot", options->plot, "draw why; a PNG")->option_text("FILE")->check(output_path());
  command->add_option("--json", options->json, "write all that was found as JSON")
      ->option_text("FILE")
      ->check(output_path());
  add_autocalibration_options(*command, *options);
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kCalibrateFooter);
  return [options] { return options->board.empty() ? autocalibrate(*options) : calibrate_with_board(*options); };
}

}  // namespace sigs::cli
