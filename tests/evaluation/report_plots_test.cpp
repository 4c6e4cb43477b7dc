// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "base/text.h"
#include "evaluation/readers/results.h"
#include "evaluation/reports/report_files.h"
#include "evaluation/synthetic_report.h"
#include "labels/label_text.h"
#include "plot/canvas.h"

namespace sigs::test {
namespace {

const Plot& plot_called(const std::vector<Plot>& plots, const std::string& name) {
  const auto found = std::find_if(plots.begin(), plots.end(), [&](const Plot& plot) { return plot.name == name; });
  REQUIRE(found != plots.end());
  return *found;
}

}  // namespace

TEST_CASE("a line stops where nothing is reported or scored, and a lone frame is a point") {
  const std::vector<Plot> plots = plots_of(synthetic_track_report());
  const Plot& errors = plot_called(plots, "center_error");
  const PlotSeries& off = errors.series.at(0);
  REQUIRE(off.runs.size() == 2);  // hidden in frames 20 to 24
  CHECK(off.runs[0].front().x == 0);
  CHECK(off.runs[0].back().x == 19);
  CHECK(off.runs[1].front().x == 25);
  CHECK(off.runs[1].back().x == 29);
  for (const PlotPoint& point : off.runs[0]) CHECK(point.y == doctest::Approx(5).epsilon(1e-12));
  const PlotSeries& odd = errors.series.at(1);
  REQUIRE(odd.runs.size() == 2);
  CHECK(odd.runs[0].size() == 10);
  CHECK(odd.runs[1].size() == 1);
  CHECK(errors.series.at(2).runs.empty());
  REQUIRE(errors.shaded.size() == 1);
  CHECK(errors.shaded[0].first == 19.5);
  CHECK(errors.shaded[0].last == 24.5);
}

TEST_CASE("signed errors keep their sign, and curves run from 0 to the last threshold") {
  const std::vector<Plot> plots = plots_of(synthetic_track_report());
  CHECK(plot_called(plots, "x_error").series[0].runs[0][7].y == doctest::Approx(3).epsilon(1e-12));
  CHECK(plot_called(plots, "y_error").series[0].runs[0][7].y == doctest::Approx(4).epsilon(1e-12));
  const auto& precision = plot_called(plots, "precision").series[0].runs[0];
  CHECK(precision.size() == 51);
  CHECK(precision.back().x == 50);
  CHECK(plot_called(plots, "success").series[0].runs[0].back().x == 1);
  CHECK(plot_called(plots, "normalized_precision").series[0].runs[0].back().x == 0.5);
}

TEST_CASE("large errors have an axis on which small ones still differ visibly, as its label says") {
  TrackReport report = synthetic_track_report();
  report.scores[0].frames[3].center_error_px = 700;
  const std::vector<Plot> plots = plots_of(report);
  const Plot& errors = plot_called(plots, "center_error");
  CHECK(errors.y_scale == PlotScale::symlog);
  CHECK(errors.y_label.find("logarithmic") != std::string::npos);
  CHECK(errors.y_range.last > 700);
  CHECK(ticks_of(errors.y_range, errors.y_scale) == std::vector<double>{0, 2, 5, 10, 20, 50, 100, 200, 500});
  CHECK(plot_called(plots, "x_error").y_scale == PlotScale::linear);
}

TEST_CASE("numbers in reports read back the same, and none is empty") {
  for (const double number : {0.0, 1.0 / 3, 1e-300, -7.25, 1e7 + 1e-9, 123456789.125})
    CHECK(std::stod(exact_text(number)) == number);
  CHECK(exact_text(-0.0) == "0");
  CHECK(exact_text(std::numeric_limits<double>::quiet_NaN()).empty());
  CHECK(exact_text(std::numeric_limits<double>::infinity()).empty());
  CHECK(fixed_text(-0.001, 2) == "0.00");
  CHECK(fixed_text(2.5, 1) == "2.5");
  CHECK(fixed_text(std::numeric_limits<double>::infinity(), 1) == "-");
  CHECK(line_text("a\nb\x01"
                  "\xFF") == "a b\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST_CASE("every value equal to the best one is marked, and none where all are equal or there is none") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(best_of({1, 3, 2}, true, 1) == std::vector<bool>{false, true, false});
  CHECK(best_of({1, 3, 2}, false, 1) == std::vector<bool>{true, false, false});
  CHECK(best_of({3.04, 3.01, nan}, true, 1) == std::vector<bool>{true, true, false});
  CHECK(best_of({nan, nan}, true, 1) == std::vector<bool>{false, false});
  CHECK(best_of({2, 2}, true, 1) == std::vector<bool>{false, false});
  CHECK(best_of({2}, true, 1) == std::vector<bool>{false});
}

}  // namespace sigs::test
