// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "calibration/board.h"
#include "calibration/board_calibration.h"
#include "calibration_cases/case_score.h"
#include "made_boards/board_cases.h"

namespace sigs {
namespace {

std::vector<BoardView> views_seen(const std::vector<cv::Mat>& images, const CalibrationBoard& board) {
  std::vector<BoardView> views;
  for (const cv::Mat& image : images)
    if (std::optional<BoardView> view = found_board(image, board)) views.push_back(std::move(*view));
  return views;
}

}  // namespace

TEST_CASE("from images with half the views bad the focal length comes within 0.3 percent") {
  for (const char* const name : {"brown5-chessboard-hard", "fisheye170-charuco-hard"}) {
    CAPTURE(name);
    const made::BoardCase one = made::board_case(name);
    const made::BoardRenderer renderer(one.camera, one.board, 2);
    const CalibrationBoard board = test::board_of(one.board);
    std::vector<BoardView> views = views_seen(made::case_images(one, renderer, 3, 40), board);
    test::spoil(views, one, 3);
    const ViewSelection selection = selected_views(std::move(views), board, one.camera.size_px);
    const Result<BoardCalibration> found = calibrate_views(selection.views, board, one.camera.size_px);
    REQUIRE_MESSAGE(found, name);
    const test::LensError error = test::error_of(found->best().model, found->best().lens, renderer);
    CHECK(error.focal_percent < 0.3);
    CHECK(error.field_px < 0.1);  // less than what the noise does to a single corner
    CHECK(is_fisheye(found->best().lens.model) == one.camera.fisheye);
    const cv::Mat plot = board_plot(*found);
    CHECK(plot.type() == CV_8UC3);
    CHECK(plot.cols >= 1000);
  }
}

TEST_CASE("corners are found within a tenth of a pixel of where OpenCV projects them") {
  for (const char* const name : {"brown5-chessboard", "fisheye170-charuco"}) {
    const made::BoardCase one = made::board_case(name);
    const made::BoardRenderer renderer(one.camera, one.board, 2);
    made::PoseRange range;
    if (one.camera.fisheye) range.smallest_share = 0.4, range.largest_share = 1.1;
    for (const cv::Affine3d& pose : made::made_poses(renderer, 3, range, 8)) {
      const auto view = found_board(renderer.image(std::span(&pose, 1), one.exposure), test::board_of(one.board));
      REQUIRE_MESSAGE(view, name);
      const std::vector<cv::Point2d> truth = renderer.corners_px(pose);
      // The board looks the same upside down: corners count from either end.
      const auto last = static_cast<int>(truth.size()) - 1;
      const auto rms_px = [&](bool is_turned) {
        double squares = 0;
        for (std::size_t i = 0; i < view->size(); ++i) {
          const int id = is_turned ? last - view->ids[i] : view->ids[i];
          const cv::Point2d off = view->at_px[i] - truth[static_cast<std::size_t>(id)];
          squares += off.ddot(off);
        }
        return std::sqrt(squares / static_cast<double>(view->size()));
      };
      const bool may_turn = one.board.marker_m <= 0;
      CHECK_MESSAGE(std::min(rms_px(false), may_turn ? rms_px(true) : INFINITY) < 0.12, name);
    }
  }
}

TEST_CASE("edges are as wide as the blur makes them, and wider across a motion") {
  made::BoardCase one = made::board_case("pinhole-chessboard");
  const made::BoardRenderer renderer(one.camera, one.board, 2);
  const CalibrationBoard board = test::board_of(one.board);
  made::PoseRange facing;
  facing.largest_tilt_deg = 5;
  facing.smallest_share = 0.6;
  const cv::Affine3d pose = made::made_poses(renderer, 1, facing, 2).front();
  const auto edge_px = [&](double blur_px, double motion_px) {
    one.exposure.blur_px = blur_px;
    const auto view = found_board(renderer.image(made::moving(renderer, pose, motion_px, 1), one.exposure), board);
    REQUIRE(view);
    return view->edge_px;
  };
  // From 10 to 90 % a Gaussian's edge is 2.563 standard deviations wide. The pixel's square adds 1/12 to the variance,
  // bilinear samples between pixels up to 1/4.
  for (const double blur_px : {1.0, 2.0}) {
    const double narrowest = 2.563 * std::sqrt(blur_px * blur_px + 1.0 / 12);
    CHECK(edge_px(blur_px, 0) > 0.93 * narrowest);
    CHECK(edge_px(blur_px, 0) < 1.15 * 2.563 * std::sqrt(blur_px * blur_px + 1.0 / 12 + 1.0 / 4));
  }
  CHECK(edge_px(0.7, 6) > 1.5 * edge_px(0.7, 0));
}

TEST_CASE("a board with another number of corners, or with other markers, is named") {
  const made::BoardCase plain = made::board_case("pinhole-chessboard");
  const made::BoardRenderer renderer(plain.camera, plain.board, 2);
  made::PoseRange near;
  near.smallest_share = 0.6;
  const cv::Affine3d pose = made::made_poses(renderer, 1, near, 2).front();
  const cv::Mat image = renderer.image(std::span(&pose, 1), plain.exposure);
  CalibrationBoard wrong = test::board_of(plain.board);
  wrong.corners = {8, 5};
  CHECK_FALSE(found_board(image, wrong));
  const std::string seen = other_board_in(image, wrong);
  CHECK_MESSAGE((seen.find("9x6") != std::string::npos || seen.find("6x9") != std::string::npos), seen);
  const made::BoardCase marked = made::board_case("pinhole-charuco");
  const made::BoardRenderer markers(marked.camera, marked.board, 2);
  const cv::Mat with_markers = markers.image(std::span(&pose, 1), marked.exposure);
  CalibrationBoard other = test::board_of(marked.board);
  other.dictionary = *dictionary_of("DICT_6X6_250");
  CHECK(other_board_in(with_markers, other).find("DICT_4X4") != std::string::npos);
  const cv::Mat nothing(plain.camera.size_px, CV_8UC1, cv::Scalar(90));
  CHECK_FALSE(found_board(nothing, wrong));
  CHECK(other_board_in(nothing, wrong).empty());
}

TEST_CASE("of a board that is held still one view is taken, and blurred views are left out") {
  const made::BoardRenderer truth(made::board_case("pinhole-chessboard").camera, {}, 1);
  const CalibrationBoard board = test::board_of(truth.board());
  std::vector<BoardView> views;
  for (const cv::Affine3d& pose : made::made_poses(truth, 10, {}, 4))
    for (int again = 0; again < 5; ++again) {
      BoardView view{.edge_px = again == 3 ? 6 : 1.5};
      for (const cv::Point2d& at : truth.corners_px(pose)) {
        view.ids.push_back(static_cast<int>(view.ids.size()));
        view.at_px.push_back(at + cv::Point2d(0.1 * again, 0));
      }
      views.push_back(std::move(view));
    }
  const ViewSelection selection = selected_views(views, board, truth.camera().size_px);
  CHECK(selection.views.size() == 10);
  CHECK(selection.blurred == 10);
  CHECK(selection.alike == 30);
  CHECK(selected_views(views, board, truth.camera().size_px, 4).views.size() == 4);
  CHECK(selected_views({}, board, truth.camera().size_px).views.empty());
}

TEST_CASE("boards that cannot be looked for are refused in words") {
  CalibrationBoard board{.corners = {2, 6}};
  CHECK_FALSE(check_board(board));
  board = {.kind = BoardKind::charuco, .square_m = 0.02, .marker_m = 0.02, .dictionary = 0};
  CHECK(check_board(board).error().where == "--marker-m");
  board = {.kind = BoardKind::charuco, .corners = {20, 20}, .square_m = 0.03, .marker_m = 0.02, .dictionary = 0};
  CHECK(check_board(board).error().what.find("220") != std::string::npos);  // 21 * 21 / 2 of 50 markers
  CHECK_FALSE(dictionary_of("DICT_9X9_50"));
}

}  // namespace sigs
