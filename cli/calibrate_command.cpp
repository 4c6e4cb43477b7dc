// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autocalibration/autocalibration.h"
#include "base/paths.h"
#include "base/pose.h"
#include "base/text.h"
#include "calibration/board.h"
#include "calibration/board_calibration.h"
#include "camera/calibration_text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "telemetry/track.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

// What the command line of sigs calibrate says.
struct CalibrateOptions {
  std::vector<fs::path> inputs;  // a video, images, or folders of images
  std::string board;             // "chessboard", "charuco"; empty: without a board
  std::string corners;           // "9x6"
  double square_m = 0;           // 0: not given
  double marker_m = 0;           // likewise
  std::string dictionary;        // empty: not given
  std::string model = "auto";
  fs::path out;
  fs::path plot;                  // empty: none
  fs::path json;                  // likewise
  SequenceTiming timing;          // without a board: of images
  fs::path log;                   // without a board: with angular rates; empty: the video's own
  std::optional<double> fov_deg;  // without a board: horizontal field of view that the user knows
  int max_frames = 1800;          // without a board: that are looked at
  bool force = false;
  std::string progress = "auto";

  [[nodiscard]] std::vector<CommandOutput> outputs() const {
    return {{"--out", out}, {"--plot", plot}, {"--json", json}};
  }
};

Result<CalibrationBoard> board_of(const CalibrateOptions& options) {
  CalibrationBoard board;
  if (options.corners.empty())
    return fail("--corners", "is missing: the inner corners in a row and in a column, as 9x6", ErrorKind::usage);
  const Result<std::optional<cv::Size>> corners = size_of_option(options.corners);
  if (!corners) return fail("--corners", options.corners + " is no size such as 9x6", ErrorKind::usage);
  board.corners = **corners;
  if (options.square_m == 0) return fail("--square-m", "is missing: the side of a square, metres", ErrorKind::usage);
  board.square_m = options.square_m;
  if (options.board == "charuco") {
    board.kind = BoardKind::charuco;
    if (options.marker_m == 0) return fail("--marker-m", "is missing: the side of a marker, metres", ErrorKind::usage);
    if (options.dictionary.empty())
      return fail("--dictionary", "is missing: the markers' dictionary, as DICT_4X4_50", ErrorKind::usage);
    board.marker_m = options.marker_m;
    const Result<int> dictionary = dictionary_of(options.dictionary);
    if (!dictionary) return fail(dictionary.error());
    board.dictionary = *dictionary;
  } else if (options.marker_m != 0 || !options.dictionary.empty()) {
    return fail(options.marker_m != 0 ? "--marker-m" : "--dictionary", "goes with --board charuco", ErrorKind::usage);
  }
  if (const Result<void> good = check_board(board); !good) return fail(good.error());
  return board;
}

ModelWanted wanted_of(const std::string& model) {
  if (model == "pinhole") return ModelWanted::pinhole;
  if (model == "brown-conrady") return ModelWanted::brown_conrady;
  return model == "fisheye" ? ModelWanted::fisheye : ModelWanted::automatic;
}

Error nothing_found(const CalibrateOptions& options, const BoardFootage& footage) {
  const std::string where = options.inputs.size() == 1 ? options.inputs.front().string() : "";
  if (!footage.seen_instead.empty())
    return {where, fmt::format("no {} with --corners {} in any of {}, but {}", options.board, options.corners,
                               count_text(footage.searched, "frame"), footage.seen_instead)};
  return {where, fmt::format("no board found in any of {}; is it --corners {} inner corners, one less than squares?",
                             count_text(footage.searched, "frame"), options.corners)};
}

Result<BoardFootage> views_in(const CalibrateOptions& options, const CalibrationBoard& board) {
  Progress progress(options.progress);
  const BoardSearch search{.progress = progress.counter(), .cancel = &interrupt_flag()};
  Result<BoardFootage> found = board_footage(options.inputs, board, search);
  progress.end();
  if (!found) return found;
  for (const Warning& warning : found->warnings) print_warning(warning);
  if (found->views.empty()) return fail(nothing_found(options, *found));
  return found;
}

Result<BoardCalibration> calibrated(const CalibrateOptions& options, const CalibrationBoard& board) {
  Result<BoardFootage> found = views_in(options, board);
  if (!found) return fail(found.error());
  const std::size_t seen = found->views.size();
  const ViewSelection selection = selected_views(std::move(found->views), board, found->size_px);
  Result<BoardCalibration> calibration =
      calibrate_views(selection.views, board, found->size_px, wanted_of(options.model));
  if (!calibration) return calibration;
  if (options.progress != "none")
    std::fprintf(stderr, "board found in %zu of %s; %d too blurred, %d alike, %d do not agree; %s used\n", seen,
                 count_text(found->searched, "frame").c_str(), selection.blurred, selection.alike,
                 static_cast<int>(calibration->views.size()) - calibration->views_used(),
                 count_text(calibration->views_used(), "view").c_str());
  return calibration;
}

Result<void> calibrate_with_board(const CalibrateOptions& options) {
  if (const Result<void> named = check_outputs(options.outputs(), options.inputs); !named) return named;
  const Result<CalibrationBoard> board = board_of(options);
  if (!board) return fail(board.error());
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> free = files.reserve(options.outputs()); !free) return free;
  const Result<BoardCalibration> calibration = calibrated(options, *board);
  if (!calibration) return fail(calibration.error());
  for (const Warning& warning : calibration->warnings) print_warning(warning);
  const Result<void> done =
      files.write_and_commit({{options.out, [&] { return calibration_xml(calibration_text_of(*calibration, *board)); }},
                              {options.plot, [&] { return png_bytes(board_plot(*calibration)); }},
                              {options.json, [&] { return board_report_json(*calibration, *board); }}});
  if (!done) return done;
  std::fputs(board_report_text(*calibration).c_str(), stdout);
  return {};
}

struct AutocalibrationInputs {
  std::optional<Track> log;
  fs::path log_file;  // empty: the footage itself
};

// The log that is named, else the one that the footage carries, if it does.
Result<AutocalibrationInputs> inputs_of(const CalibrateOptions& options) {
  AutocalibrationInputs inputs{.log = std::nullopt, .log_file = options.log};
  const bool is_named = !options.log.empty();
  Result<Track> log = read_track(is_named ? options.log : options.inputs[0], &interrupt_flag());
  if (!log && (is_named || log.error().kind == ErrorKind::interrupted)) return fail(log.error());
  if (!log) return inputs;
  for (const Warning& warning : log->warnings) print_warning(warning);
  inputs.log = std::move(*log);
  return inputs;
}

Result<Autocalibration> found_in(const CalibrateOptions& options) {
  Result<FrameSource> footage =
      FrameSource::open(options.inputs[0], &interrupt_flag(), Quantisers::leave_out, options.timing);
  if (!footage) return fail(footage.error());
  for (const Warning& warning : footage->info().warnings) print_warning(warning);
  const Result<AutocalibrationInputs> inputs = inputs_of(options);
  if (!inputs) return fail(inputs.error());
  AutocalibrationSettings settings{.max_frames = options.max_frames};
  if (options.fov_deg) settings.given_field_rad = rad_of_deg(*options.fov_deg);
  Progress progress(options.progress);
  const AutocalibrationControl control{.progress = progress.counter(), .cancel = &interrupt_flag()};
  return autocalibrated(*footage, inputs->log ? &*inputs->log : nullptr, inputs->log_file, settings, control);
}

// Takes the names of the outputs.
Result<void> begin(OutputFiles& files, const CalibrateOptions& options) {
  if (options.inputs.size() != 1)
    return fail("INPUT", "is one video where there is no --board; there are " + std::to_string(options.inputs.size()),
                ErrorKind::usage);
  if (!options.plot.empty())
    if (const Result<void> named = check_png_output("--plot", options.plot, {}); !named) return named;
  for (const CommandOutput& output : options.outputs()) {
    if (output.path.empty()) continue;
    if (const Result<void> kept =
            check_inputs_not_overwritten(std::vector{output.path}, std::vector{options.inputs[0], options.log});
        !kept)
      return fail(output.path.string(), kept.error().what, ErrorKind::cannot_create);
    if (const Result<void> reserved = files.reserve(output.path); !reserved) return reserved;
  }
  return {};
}

void add_autocalibration_options(CLI::App& command, CalibrateOptions& options) {
  add_input(command, "--log", options.log, "without a board: a log with the camera's rates; else the video's own");
  add_range(command, "--fov", options.fov_deg, "DEG", 1, 300,
            "without a board: the horizontal field of view, where it is known; degrees");
  add_timing_options(command, options.timing);
  add_number(command, "--max-frames", options.max_frames, "N", 2, 1000000,
             "without a board: look at no more frames than these");
}

Result<void> autocalibrate(const CalibrateOptions& options) {
  defer_interrupts();
  OutputFiles files(options.force);
  if (const Result<void> begun = begin(files, options); !begun) return begun;
  const Result<Autocalibration> found = found_in(options);
  if (!found) return fail(found.error());
  for (const Warning& warning : found->warnings) print_warning(warning);
  const Result<CalibrationText> text = calibration_text(*found);
  if (!text) return fail(text.error());
  const Result<void> written =
      files.write_and_commit({{options.out, [&] { return calibration_xml(*text); }},
                              {options.json, [&] { return json_of(*found); }},
                              {options.plot, [&] { return png_bytes(autocalibration_plot(*found)); }}});
  if (!written) return written;
  print_written(files.final_paths());
  std::fprintf(stderr, "rough: %s\n", summary_of(*found).c_str());
  return {};
}

constexpr const char* kCalibrateFooter =
    "Examples:\n"
    "  sigs calibrate board.mp4 --board chessboard --corners 9x6 --square-m 0.025 --out camera.xml\n"
    "  sigs calibrate board.mp4 --board charuco --corners 10x7 --square-m 0.03 --marker-m 0.022 \\\n"
    "    --dictionary DICT_5X5_100 --out camera.xml --plot residuals.png\n"
    "  sigs calibrate flight.mp4 --out rough.xml --json rough.json";

// What the board is, and which lens is fitted to it.
void add_board_options(CLI::App& command, CalibrateOptions& options) {
  add_value(command, "--board", options.board, "chessboard|charuco",
            "what was shown to the camera; without it a rough calibration")
      ->check(CLI::IsMember({"chessboard", "charuco"}));
  add_value(command, "--corners", options.corners, "9x6",
            "inner corners in a row and in a column: one less than squares");
  add_range(command, "--square-m", options.square_m, "M", 1e-5, 1e3, "side of a square, metres");
  add_range(command, "--marker-m", options.marker_m, "M", 1e-5, 1e3, "charuco: side of a marker, metres");
  add_value(command, "--dictionary", options.dictionary, "NAME", "charuco: the markers' dictionary, as DICT_4X4_50");
  add_value(command, "--model", options.model, "auto|pinhole|brown-conrady|fisheye",
            "the lens model; auto: the one with the smallest held-out error")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "pinhole", "brown-conrady", "fisheye"}));
}

}  // namespace

Command add_calibrate_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("calibrate", "find the lens of a camera, with a board or roughly");
  const auto options = std::make_shared<CalibrateOptions>();
  command->add_option("INPUT", options->inputs, "a video, or images of the same size")->required()->check(not_empty());
  add_board_options(*command, *options);
  add_output(*command, "--out", options->out, "the calibration, as OpenCV XML")->required();
  add_output(*command, "--plot", options->plot, "draw why; a PNG");
  add_output(*command, "--json", options->json, "write all that was found as JSON");
  add_autocalibration_options(*command, *options);
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kCalibrateFooter);
  return [options] { return options->board.empty() ? autocalibrate(*options) : calibrate_with_board(*options); };
}

}  // namespace sigs::cli
