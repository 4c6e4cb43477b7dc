// SPDX-License-Identifier: MIT
#include "plot/canvas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "plot/plot.h"

using namespace sigs;

namespace {

Plot two_series() {
  return {.name = "p",
          .title = "a title",
          .x_label = "frame",
          .y_label = "error, px",
          .x_range = {0, 100},
          .y_range = {0, 10},
          .shaded = {{40, 60}},
          .series = {{.title = "first", .runs = {{{0, 0}, {50, 5}, {100, 10}}}},
                     {.title = "marks", .runs = {{{25, 8}, {75, 8}}}, .kind = SeriesKind::marks},
                     {.title = "none"}}};
}

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(svg.c_str(), pugi::parse_full);
  REQUIRE_MESSAGE(result, result.description());
  return document;
}

std::vector<cv::Point2d> points_of(const pugi::xml_node& line) {
  std::istringstream text(line.attribute("points").value());
  std::vector<cv::Point2d> points;
  char comma = 0;
  for (cv::Point2d point; text >> point.x >> comma >> point.y;) points.push_back(point);
  return points;
}

// The lines of a series: those of its colour.
std::vector<std::vector<cv::Point2d>> lines_of(const pugi::xml_document& svg, const std::string& color) {
  std::vector<std::vector<cv::Point2d>> lines;
  for (const pugi::xpath_node& node : svg.select_nodes(("//polyline[@stroke='" + color + "']").c_str()))
    lines.push_back(points_of(node.node()));
  return lines;
}

constexpr const char* kFirst = "#0072b2";

// The axes' frame: its corners.
struct Corners {
  cv::Point2d low, high;
};

Corners frame_of(const pugi::xml_document& svg) {
  const auto frame = lines_of(svg, "#404040").at(0);
  return {frame.at(0), frame.at(2)};
}

}  // namespace

TEST_CASE("points lie where the ranges put them, in the SVG and in the image alike") {
  const Plot plot = two_series();
  const pugi::xml_document svg = parsed(svg_of(plot));
  const Corners frame = frame_of(svg);
  const cv::Point2d low = frame.low, high = frame.high;
  const auto lines = lines_of(svg, kFirst);
  REQUIRE(lines.size() == 2);  // the line, and its sample in the key
  REQUIRE(lines[0].size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = static_cast<double>(i) / 2;
    CHECK(lines[0][i].x == doctest::Approx(low.x + share * (high.x - low.x)).epsilon(1e-4));  // two decimals
    CHECK(lines[0][i].y == doctest::Approx(high.y + share * (low.y - high.y)).epsilon(1e-4));
  }
  const cv::Mat image = image_of(plot);
  CHECK(image.size() == cv::Size(1440, 750));
  // A quarter of the way along the line, and beside it.
  const cv::Point at(cvRound(1.5 * (low.x + (high.x - low.x) / 8) - 0.5),
                     cvRound(1.5 * (high.y + (low.y - high.y) / 8) - 0.5));
  const cv::Vec3b on = image.at<cv::Vec3b>(at), beside = image.at<cv::Vec3b>(at - cv::Point(0, 20));
  CHECK(on[0] > on[2] + 60);  // blue
  CHECK(std::abs(beside[0] - beside[2]) < 8);
  // Shaded from 40 to 60.
  const double y = low.y + 5;
  const auto gray_at = [&](double share) {
    return image.at<cv::Vec3b>(cvRound(1.5 * y), cvRound(1.5 * (low.x + share * (high.x - low.x))))[0];
  };
  CHECK(gray_at(0.47) < 240);
  CHECK(gray_at(0.33) > 250);
}

TEST_CASE("every series is in the key, with points or without, and no text leaves its element") {
  Plot plot = two_series();
  plot.title = "<script>&\"'\n\x01 \xC3\xA9\xFF";
  plot.series[0].title = "a < b & c";
  const pugi::xml_document svg = parsed(svg_of(plot));
  std::string texts;
  for (const pugi::xpath_node& text : svg.select_nodes("//text")) texts += std::string(text.node().text().get()) + "|";
  for (const char* title : {"a < b & c|", "marks|", "none|", "frame|", "error, px|", "<script>&\"' "})
    CHECK_MESSAGE(texts.find(title) != std::string::npos, texts);
  CHECK(svg.select_nodes("//script").empty());
  CHECK_FALSE(image_of(plot).empty());
}

TEST_CASE("lines are cut at the frame, and what lies outside is not drawn") {
  Plot plot = two_series();
  plot.series = {{.title = "out", .runs = {{{-100, 5}, {200, 5}}, {{10, 50}, {20, 50}}, {{50, -10}, {50, 20}}}},
                 {.title = "far", .runs = {{{500, 5}, {50, 1e9}}}, .kind = SeriesKind::marks}};
  const pugi::xml_document svg = parsed(svg_of(plot));
  const Corners frame = frame_of(svg);
  const cv::Point2d low = frame.low, high = frame.high;
  const auto lines = lines_of(svg, kFirst);
  REQUIRE(lines.size() == 3);  // two pieces and the key's
  for (std::size_t i = 0; i < 2; ++i)
    for (const cv::Point2d& point : lines[i]) {
      CHECK(point.x >= low.x - 0.01);
      CHECK(point.x <= high.x + 0.01);
      CHECK(point.y >= low.y - 0.01);
      CHECK(point.y <= high.y + 0.01);
    }
  CHECK(lines[0].front().x == doctest::Approx(low.x));
  CHECK(lines[0].back().x == doctest::Approx(high.x));
}

TEST_CASE("a long key has more rows, and the plot the room for them") {
  Plot plot = two_series();
  plot.series.clear();
  for (int i = 0; i < 20; ++i)
    plot.series.push_back({.title = "a tracker with a long name, number " + std::to_string(i)});
  const pugi::xml_document svg = parsed(svg_of(plot));
  CHECK(svg.child("svg").attribute("height").as_double() > 600);
  for (const pugi::xpath_node& text : svg.select_nodes("//text")) {
    CHECK(text.node().attribute("x").as_double() < 960);
    CHECK(text.node().attribute("y").as_double() < svg.child("svg").attribute("height").as_double());
  }
  CHECK(image_of(plot).rows == doctest::Approx(1.5 * svg.child("svg").attribute("height").as_double()));
}

TEST_CASE("ticks are round, within the range and not too many") {
  CHECK(ticks_of({0, 100}, PlotScale::linear) == std::vector<double>{0, 20, 40, 60, 80, 100});
  CHECK(ticks_of({-1, 1}, PlotScale::linear) == std::vector<double>{-1, -0.5, 0, 0.5, 1});
  CHECK(ticks_of({0, 700}, PlotScale::symlog) == std::vector<double>{0, 2, 5, 10, 20, 50, 100, 200, 500});
  for (double size = 1e-6; size < 1e9; size *= 1.7)
    for (const double first : {-size, 0.0, 0.3 * size, 1e6}) {
      const std::vector<double> ticks = ticks_of({first, first + size}, PlotScale::linear);
      if (first == 1e6 && size < 1e-3) continue;  // closer than a double tells apart there
      CHECK(ticks.size() >= 3);
      CHECK(ticks.size() <= 12);
      for (const double tick : ticks) {
        CHECK(tick >= first - 1e-6 * size);
        CHECK(tick <= first + size + 1e-6 * size);
      }
    }
}

TEST_CASE("a plot of nothing, of a single value or of equal ends is drawn") {
  for (const PlotSpan& range : {PlotSpan{0, 0}, PlotSpan{5, 5}, PlotSpan{3, 1}, PlotSpan{-1e7, 1e7}}) {
    Plot plot{.name = "n", .x_range = range, .y_range = range};
    CHECK_FALSE(image_of(plot).empty());
    plot.series = {{.title = "one", .runs = {{{range.first, range.first}}}}};
    (void)parsed(svg_of(plot));
    CHECK(svg_of(plot).find("nan") == std::string::npos);
  }
  CHECK(svg_of(two_series()) == svg_of(two_series()));
}

TEST_CASE("a falling axis begins with its greater number, and a logarithmic one has a decade as far as the next") {
  Plot plot{.name = "p",
            .x_range = {1000, 0},
            .y_range = {0.01, 100},
            .y_scale = PlotScale::log,
            .series = {{.title = "a", .runs = {{{1000, 0.01}, {500, 1}, {0, 100}}}}}};
  const pugi::xml_document svg = parsed(svg_of(plot));
  const Corners frame = frame_of(svg);
  const auto line = lines_of(svg, kFirst).at(0);
  REQUIRE(line.size() == 3);
  CHECK(line[0].x == doctest::Approx(frame.low.x));
  CHECK(line[1].x == doctest::Approx((frame.low.x + frame.high.x) / 2).epsilon(1e-4));
  CHECK(line[1].y == doctest::Approx((frame.low.y + frame.high.y) / 2).epsilon(1e-4));
  CHECK(ticks_of({0.01, 100}, PlotScale::log) == std::vector<double>{0.01, 0.1, 1, 10, 100});
}

TEST_CASE("with the same scale a circle's height and width are the same in pixels") {
  Plot plot{.name = "p", .x_range = {-5, 5}, .y_range = {-5, 5}, .same_scale = true};
  PlotSeries circle{.title = "c", .runs = {{}}};
  for (int i = 0; i <= 360; ++i) circle.runs[0].push_back({4 * std::cos(i * 0.0174533), 4 * std::sin(i * 0.0174533)});
  plot.series = {circle};
  double low_x = 1e9, high_x = 0, low_y = 1e9, high_y = 0;
  const auto lines = lines_of(parsed(svg_of(plot)), kFirst);
  for (const cv::Point2d& at : lines.at(0)) {
    low_x = std::min(low_x, at.x), high_x = std::max(high_x, at.x);
    low_y = std::min(low_y, at.y), high_y = std::max(high_y, at.y);
  }
  CHECK(high_x - low_x == doctest::Approx(high_y - low_y).epsilon(1e-3));  // two decimals of some 300 px
}

TEST_CASE("areas are filled from corner to corner, and a line of very many points keeps its peaks") {
  Plot plot{.name = "p", .x_range = {0, 10}, .y_range = {0, 10}};
  plot.series = {{.title = "a", .runs = {{{2, 8}, {4, 2}}}, .kind = SeriesKind::areas, .color = PlotColor{10, 20, 30}}};
  const pugi::xml_document svg = parsed(svg_of(plot));
  const Corners frame = frame_of(svg);
  const pugi::xml_node area = svg.select_node("//rect[@fill='#0a141e']").node();
  CHECK(area.attribute("width").as_double() == doctest::Approx(0.2 * (frame.high.x - frame.low.x)).epsilon(1e-4));
  CHECK(area.attribute("height").as_double() == doctest::Approx(0.6 * (frame.high.y - frame.low.y)).epsilon(1e-4));
  PlotSeries noisy{.title = "n", .runs = {{}}};
  for (int i = 0; i < 100000; ++i) noisy.runs[0].push_back({i * 1e-4, i == 54321 ? 9.0 : 1.0});
  plot.series = {noisy};
  const auto line = lines_of(parsed(svg_of(plot)), kFirst).at(0);
  CHECK(line.size() < 5000);
  double highest = 1e9;
  for (const cv::Point2d& at : line) highest = std::min(highest, at.y);
  CHECK(highest == doctest::Approx(frame.low.y + 0.1 * (frame.high.y - frame.low.y)).epsilon(1e-3));
}

TEST_CASE("several plots stand beside and below one another") {
  const Plot plot = two_series();
  const cv::Size one = image_of(plot).size();
  CHECK(image_of(std::vector<Plot>{}).empty());
  CHECK(image_of(std::vector{plot, plot, plot}).size() == cv::Size(one.width, 3 * one.height));
  CHECK(image_of(std::vector{plot, plot, plot}, 2).size() == cv::Size(2 * one.width, 2 * one.height));
}
