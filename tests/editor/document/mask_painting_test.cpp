// SPDX-License-Identifier: MIT
#include "editor/document/mask_painting.h"

#include <doctest/doctest.h>

#include <random>

using namespace sigs::editor;

namespace {

const cv::Size kSize{80, 60};

cv::Mat black() {
  return cv::Mat::zeros(kSize, CV_8UC1);
}

cv::Mat noise() {
  cv::Mat mask(kSize, CV_8UC1);
  cv::RNG(7).fill(mask, cv::RNG::UNIFORM, 0, 256);
  return mask;
}

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

void stroke(MaskPainting& painting, const Brush& brush, std::initializer_list<glm::dvec2> way) {
  painting.begin_stroke(brush, *way.begin());
  for (const glm::dvec2& at : way) painting.extend_stroke(at);
  painting.end_stroke();
}

}  // namespace

TEST_CASE("undo and redo restore every state byte for byte") {
  MaskPainting painting(noise());
  std::vector<cv::Mat> masks{painting.mask().clone()};
  std::vector<std::uint64_t> states{painting.state()};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20, 100);
  for (int i = 0; i < 30; ++i) {
    if (i % 7 == 6) {
      painting.replace(i % 2 == 0 ? black() : noise(), "another");
    } else {
      const Brush brush{2.0 + i % 5, 1.5, i % 3 == 0};
      stroke(painting, brush, {{place(random), place(random)}, {place(random), place(random)}, {40, 30}});
    }
    if (is_same(painting.mask(), masks.back())) continue;  // painted where all was set already
    masks.push_back(painting.mask().clone());
    states.push_back(painting.state());
  }
  REQUIRE(masks.size() > 20);
  for (int rounds = 0; rounds < 2; ++rounds) {
    for (std::size_t i = masks.size() - 1; i > 0; --i) {
      REQUIRE(painting.can_undo());
      painting.undo();
      CHECK(is_same(painting.mask(), masks[i - 1]));
      CHECK(painting.state() == states[i - 1]);
    }
    CHECK_FALSE(painting.can_undo());
    for (std::size_t i = 1; i < masks.size(); ++i) {
      painting.redo();
      CHECK(is_same(painting.mask(), masks[i]));
      CHECK(painting.state() == states[i]);
    }
    CHECK_FALSE(painting.can_redo());
  }
}

TEST_CASE("a stroke is one step, however many pieces it has") {
  MaskPainting painting(black());
  stroke(painting, {5, 1}, {{10, 10}, {20, 20}, {30, 15}, {60, 50}});
  CHECK(cv::countNonZero(painting.mask()) > 300);
  painting.undo();
  CHECK(cv::countNonZero(painting.mask()) == 0);
  CHECK_FALSE(painting.can_undo());
}

TEST_CASE("a stroke is drawn without gaps between the places it passed") {
  MaskPainting in_pieces(black());
  stroke(in_pieces, {3, 1}, {{5, 30}, {25, 30}, {75, 30}});
  CHECK(cv::countNonZero(in_pieces.mask().row(30)) >= 70);
  for (int x = 5; x <= 75; ++x) CHECK(in_pieces.mask().at<uchar>(30, x) == 255);
}

TEST_CASE("a cancelled stroke leaves no trace") {
  MaskPainting painting(noise());
  const std::uint64_t state = painting.state();
  painting.begin_stroke({8, 2}, {20, 20});
  painting.extend_stroke({60, 40});
  CHECK_FALSE(is_same(painting.mask(), noise()));
  CHECK_FALSE(painting.can_undo());
  painting.take_back_stroke();
  CHECK(is_same(painting.mask(), noise()));
  CHECK(painting.state() == state);
  CHECK_FALSE(painting.can_undo());
  painting.extend_stroke({10, 10});  // no stroke any more
  CHECK(is_same(painting.mask(), noise()));
}

TEST_CASE("a change of no byte is not a step of the history") {
  MaskPainting painting(black());
  stroke(painting, {5, 1, true}, {{20, 20}, {40, 40}});  // black stays black
  stroke(painting, {5, 1}, {{-50, -50}, {-60, -50}});    // beside the image
  painting.replace(black(), "clear");
  CHECK_FALSE(painting.can_undo());
  CHECK_FALSE(painting.has_unsaved_changes());
}

TEST_CASE("a step after an undo replaces the undone ones") {
  MaskPainting painting(black());
  stroke(painting, {5, 1}, {{20, 20}});
  stroke(painting, {5, 1}, {{60, 20}});
  painting.undo();
  CHECK(painting.can_redo());
  stroke(painting, {5, 1, true}, {{20, 20}});
  CHECK_FALSE(painting.can_redo());
  CHECK(painting.undo_name() == "erase");
}

TEST_CASE("the saved state counts as saved, also after undo and redo") {
  MaskPainting painting(black());
  CHECK_FALSE(painting.has_unsaved_changes());
  stroke(painting, {5, 1}, {{20, 20}});
  CHECK(painting.has_unsaved_changes());
  painting.mark_saved();
  stroke(painting, {5, 1}, {{60, 20}});
  CHECK(painting.has_unsaved_changes());
  painting.undo();
  CHECK_FALSE(painting.has_unsaved_changes());
  painting.undo();
  CHECK(painting.has_unsaved_changes());
  painting.redo();
  CHECK_FALSE(painting.has_unsaved_changes());
}

TEST_CASE("painted strokes are distinguished from masks set as a whole") {
  MaskPainting painting(black());
  CHECK_FALSE(painting.has_strokes());
  painting.replace(noise(), "detected mask");
  CHECK_FALSE(painting.has_strokes());
  stroke(painting, {5, 1}, {{20, 20}, {50, 40}});
  CHECK(painting.has_strokes());
  painting.undo();
  CHECK_FALSE(painting.has_strokes());
  painting.undo();
  CHECK_FALSE(painting.has_strokes());
  painting.redo();
  painting.redo();
  CHECK(painting.has_strokes());
}

TEST_CASE("the painting is a copy: the original mask is unchanged") {
  const cv::Mat given = black();
  MaskPainting painting(given);
  stroke(painting, {5, 1}, {{20, 20}});
  painting.replace(given, "clear");
  stroke(painting, {5, 1}, {{20, 20}});
  CHECK(cv::countNonZero(given) == 0);
}

TEST_CASE("long painting discards its oldest steps and never its newest") {
  MaskPainting painting(black());
  for (int i = 0; i < 1200; ++i) stroke(painting, {3, 0, i % 2 == 1}, {{40, 30}});
  int steps = 0;
  for (; painting.can_undo(); ++steps) painting.undo();
  CHECK(steps == 1000);
}

TEST_CASE("every function of an empty painting can be called") {
  MaskPainting painting;
  CHECK(painting.empty());
  stroke(painting, {5, 1}, {{20, 20}, {30, 30}});
  painting.undo();
  painting.redo();
  painting.take_back_stroke();
  CHECK_FALSE(painting.has_unsaved_changes());
  CHECK_FALSE(painting.is_stroking());
}

TEST_CASE("paintings that begin one after the other share no state, and a recovered one is unsaved") {
  MaskPainting first(black());
  stroke(first, {5, 1}, {{20, 20}, {40, 30}});
  MaskPainting second(noise(), first.last_state() + 1);
  CHECK(second.state() > first.state());
  CHECK_FALSE(second.has_unsaved_changes());
  CHECK_FALSE(second.has_strokes());
  second.mark_unsaved();
  second.mark_strokes();
  CHECK(second.has_unsaved_changes());
  CHECK(second.has_strokes());
  const std::uint64_t recovered = second.state();
  stroke(second, {5, 1, true}, {{20, 20}, {40, 30}});
  second.undo();
  CHECK(second.state() == recovered);
  CHECK(second.has_unsaved_changes());
  second.mark_saved();
  CHECK_FALSE(second.has_unsaved_changes());
}
