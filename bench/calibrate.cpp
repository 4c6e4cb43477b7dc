// SPDX-License-Identifier: MIT
// Accuracy of calibration with boards, against lenses that are known and against OpenCV's calibration of the same
// views:
//   bench_calibrate FIRST_SEED LAST_SEED          a line of CSV for each case and seed
//   bench_calibrate FIRST_SEED LAST_SEED CASE     of one case
//   bench_calibrate raw CASE SEED FRAMES          a video of such a board: grey 8-bit frames on stdout, one after
//   another
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "calibration/board.h"
#include "calibration/board_calibration.h"
#include "calibration_cases/case_score.h"
#include "made_boards/board_cases.h"

namespace {

using namespace sigs;

void measure(const made::BoardCase& one, const made::BoardRenderer& renderer, std::uint32_t seed) {
  const CalibrationBoard board = test::board_of(one.board);
  std::vector<BoardView> views;
  int number = 0;
  Stopwatch watch;
  double detect_s = 0;
  for (const cv::Mat& image : made::case_images(one, renderer, seed, one.frames)) {
    const double before_s = watch.elapsed_s();
    std::optional<BoardView> view = found_board(image, board);
    detect_s += watch.elapsed_s() - before_s;
    if (view) view->name = fmt::format("frame {}", number);
    if (view) views.push_back(std::move(*view));
    ++number;
  }
  test::spoil(views, one, seed);
  const std::size_t found = views.size();
  const test::LensError theirs = test::error_of_opencv(one, renderer, views);
  const double before_s = watch.elapsed_s();
  const ViewSelection selection = selected_views(std::move(views), board, one.camera.size_px);
  const Result<BoardCalibration> ours = calibrate_views(selection.views, board, one.camera.size_px);
  const double fit_s = watch.elapsed_s() - before_s;
  if (!ours) {
    fmt::print("{},{},{},failed: {}\n", one.name, seed, found, ours.error().text());
    return;
  }
  const CalibratedModel& best = ours->best();
  const test::LensError error = test::error_of(best.model, best.lens, renderer);
  fmt::print("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f}\n", one.name, seed,
             found, ours->views_used(), name_of(best.model), error.focal_percent, best.sd[0] / best.lens.fx * 100,
             error.center_px, error.field_px, theirs.focal_percent, theirs.center_px, theirs.field_px, best.rms_px,
             detect_s / number, fit_s);
  std::fflush(stdout);
}

void write_raw(const std::string& name, std::uint32_t seed, int frames) {
  for (const sigs::made::BoardCase& one : sigs::made::board_cases()) {
    if (one.name != name) continue;
    const sigs::made::BoardRenderer renderer(one.camera, one.board);
    for (int i = 0; i < frames; ++i) {
      const cv::Mat image = sigs::made::video_frame(one, renderer, seed, frames, i);
      std::fwrite(image.data, 1, image.total(), stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && argv[1] == std::string("raw")) {
    write_raw(argv[2], static_cast<std::uint32_t>(std::atoi(argv[3])), std::atoi(argv[4]));
    return 0;
  }
  if (argc < 3) return 64;
  const int first = std::atoi(argv[1]);
  const int last = std::atoi(argv[2]);
  fmt::print(
      "case,seed,found,used,model,focal_percent,sd_percent,center_px,field_px,cv_focal_percent,cv_center_px,cv_field_"
      "px,"
      "rms_px,detect_s,fit_s\n");
  for (const sigs::made::BoardCase& one : sigs::made::board_cases()) {
    if (argc > 3 && one.name != argv[3]) continue;
    const sigs::made::BoardRenderer renderer(one.camera, one.board);
    for (int seed = first; seed <= last; ++seed) measure(one, renderer, static_cast<std::uint32_t>(seed));
  }
  return 0;
}
