// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "base/text.h"
#include "calibration/board.h"
#include "calibration/board_calibration.h"
#include "cli/calibrate_options.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"

namespace sigs::cli {

namespace {

Result<CalibrationBoard> board_of(const CalibrateOptions& options) {
  CalibrationBoard board;
  if (options.corners.empty())
    return fail("--corners", "is missing: the inner corners in a row and in a column, as 9x6", ErrorKind::usage);
  const Result<cv::Size> corners = size_of_option(options.corners);
  if (!corners) return fail("--corners", options.corners + " is no size such as 9x6", ErrorKind::usage);
  board.corners = *corners;
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

Result<BoardFootage> found_in(const CalibrateOptions& options, const CalibrationBoard& board) {
  Progress progress(options.progress);
  const BoardSearch search{.progress = [&](int done, int total) { progress.update(done, total); },
                           .cancel = &interrupt_flag()};
  Result<BoardFootage> found = board_footage(options.inputs, board, search);
  progress.end();
  if (!found) return found;
  for (const Warning& warning : found->warnings) print_warning(warning);
  if (found->views.empty()) return fail(nothing_found(options, *found));
  return found;
}

Result<BoardCalibration> calibrated(const CalibrateOptions& options, const CalibrationBoard& board) {
  Result<BoardFootage> found = found_in(options, board);
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

}  // namespace

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

}  // namespace sigs::cli
