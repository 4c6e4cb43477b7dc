// SPDX-License-Identifier: MIT
#include "plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/text.h"
#include "plot/canvas.h"

namespace sigs {

namespace {

// Okabe and Ito, "Color universal design" (2008), without yellow, which is hard to see on white.
constexpr std::array<PlotColor, 7> kColors{{{0x00, 0x72, 0xB2},
                                            {0xD5, 0x5E, 0x00},
                                            {0x00, 0x9E, 0x73},
                                            {0xCC, 0x79, 0xA7},
                                            {0xE6, 0x9F, 0x00},
                                            {0x56, 0xB4, 0xE9},
                                            {0, 0, 0}}};
const std::array<std::vector<double>, 5> kDashes{{{}, {10, 5}, {3, 4}, {12, 4, 3, 4}, {16, 4, 3, 4, 3, 4}}};
constexpr std::array<Mark, 7> kMarks{Mark::disc,  Mark::square, Mark::triangle, Mark::diamond,
                                     Mark::cross, Mark::plus,   Mark::disc};
constexpr PlotColor kGridColor{0xD8, 0xD8, 0xD8}, kFrameColor{0x40, 0x40, 0x40}, kShade{0xEC, 0xEC, 0xEC};

constexpr double kWidth = 960, kHeight = 500;
constexpr double kLeft = 78, kRight = 24, kTop = 44, kBelowFrame = 52;  // room around the frame
constexpr double kKeyRow = 22, kKeySample = 38, kKeyGap = 28;
constexpr double kTextSize = 13, kTitleSize = 15;
constexpr double kImageScale = 1.5;
constexpr double kMaxTicks = 8;

double placed(double value, PlotScale scale) {
  return scale == PlotScale::symlog ? std::asinh(value / 10) : value;
}

std::vector<double> symlog_ticks(const PlotSpan& range) {
  constexpr double kMinGap = 0.035;  // of the axis; about a label's height
  const double gap = kMinGap * (placed(range.last, PlotScale::symlog) - placed(range.first, PlotScale::symlog));
  std::vector<double> ticks;
  if (range.first <= 0 && range.last >= 0) ticks.push_back(0);
  double last = 0;
  for (const double tick : {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}) {
    if (placed(tick, PlotScale::symlog) - last < gap) continue;
    last = placed(tick, PlotScale::symlog);
    if (tick <= range.last && tick >= range.first) ticks.push_back(tick);
    if (-tick >= range.first && -tick <= range.last) ticks.push_back(-tick);
  }
  std::sort(ticks.begin(), ticks.end());
  return ticks;
}

// 1, 2 or 5 times a power of ten, so that at most kMaxTicks steps fit into the range.
double step_of(double range) {
  const double rough = range / kMaxTicks;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

// With as many decimals as tell the ticks apart.
std::string tick_text(double value, const std::vector<double>& ticks) {
  double step = std::abs(value);
  for (std::size_t i = 0; i + 1 < ticks.size(); ++i) step = std::min(step > 0 ? step : 1e300, ticks[i + 1] - ticks[i]);
  if (step <= 0 || step >= 1e300) return fixed_text(value, 0);
  return fixed_text(value, std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9));
}

// Where the parts of a plot lie.
class Layout {
 public:
  explicit Layout(const Plot& plot) : plot_(plot) {
    double x = kLeft, row = 0;
    for (const PlotSeries& series : plot.series) {
      const double width = kKeySample + 8 + text_width(series.title, kTextSize) + kKeyGap;
      if (x > kLeft && x + width > kWidth - kRight + kKeyGap) {
        x = kLeft;
        ++row;
      }
      key_.push_back({x, row});
      x += width;
    }
    rows_ = plot.series.empty() ? 0 : row + 1;
    frame_ = {kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBelowFrame - kKeyRow};
  }

  [[nodiscard]] double height() const { return kHeight + std::max(0.0, rows_ - 1) * kKeyRow; }
  [[nodiscard]] const cv::Rect2d& frame() const { return frame_; }
  [[nodiscard]] double x_of(double value) const {
    return frame_.x + frame_.width * (value - plot_.x_range.first) / (plot_.x_range.last - plot_.x_range.first);
  }
  [[nodiscard]] double y_of(double value) const {
    const double first = placed(plot_.y_range.first, plot_.y_scale), last = placed(plot_.y_range.last, plot_.y_scale);
    return frame_.y + frame_.height * (1 - (placed(value, plot_.y_scale) - first) / (last - first));
  }
  // The left end of an entry of the key, on its text's baseline.
  [[nodiscard]] cv::Point2d key_at(std::size_t series) const {
    return {key_[series].x, kHeight - 10 + kKeyRow * key_[series].y};
  }

 private:
  const Plot& plot_;
  cv::Rect2d frame_;
  std::vector<cv::Point2d> key_;  // x, row
  double rows_ = 0;
};

// The part of a piece of line within the frame, by Liang and Barsky (1984). False: none is.
bool clip(const cv::Rect2d& frame, cv::Point2d& a, cv::Point2d& b) {
  const cv::Point2d way = b - a;
  double from = 0, to = 1;
  const auto cut = [&](double towards, double room) {
    if (towards == 0) return room >= 0;
    const double at = room / towards;
    (towards < 0 ? from : to) = towards < 0 ? std::max(from, at) : std::min(to, at);
    return from <= to;
  };
  if (!cut(-way.x, a.x - frame.x) || !cut(way.x, frame.x + frame.width - a.x) || !cut(-way.y, a.y - frame.y) ||
      !cut(way.y, frame.y + frame.height - a.y))
    return false;
  b = a + to * way;
  a = a + from * way;
  return true;
}

void draw_run(Canvas& canvas, const Layout& layout, const std::vector<PlotPoint>& run, const LineStyle& style) {
  std::vector<cv::Point2d> line;
  const auto flush = [&] {
    if (line.size() > 1) canvas.polyline(line, style);
    line.clear();
  };
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    cv::Point2d a(layout.x_of(run[i].x), layout.y_of(run[i].y));
    cv::Point2d b(layout.x_of(run[i + 1].x), layout.y_of(run[i + 1].y));
    if (!clip(layout.frame(), a, b)) {
      flush();
      continue;
    }
    if (line.empty() || line.back() != a) {
      flush();
      line.push_back(a);
    }
    line.push_back(b);
  }
  flush();
}

bool is_within(const cv::Rect2d& frame, const cv::Point2d& at) {
  constexpr double kEdge = 1e-6;
  return at.x >= frame.x - kEdge && at.x <= frame.x + frame.width + kEdge && at.y >= frame.y - kEdge &&
         at.y <= frame.y + frame.height + kEdge;
}

// Colours repeat after seven series, then with other dashes and marks.
struct SeriesStyle {
  LineStyle line;
  Mark mark;
};

SeriesStyle style_of(std::size_t number) {
  const std::size_t round = number + number / kColors.size();
  return {{kColors[number % kColors.size()], 2, kDashes[round % kDashes.size()]}, kMarks[round % kMarks.size()]};
}

void draw_series(Canvas& canvas, const Layout& layout, const PlotSeries& series, std::size_t number) {
  const SeriesStyle style = style_of(number);
  for (const std::vector<PlotPoint>& run : series.runs) {
    if (!series.is_scatter && run.size() > 1) {
      draw_run(canvas, layout, run, style.line);
      continue;
    }
    for (const PlotPoint& point : run) {  // a line needs two
      const cv::Point2d at(layout.x_of(point.x), layout.y_of(point.y));
      if (!is_within(layout.frame(), at)) continue;
      canvas.mark(at, series.is_scatter ? style.mark : Mark::dot, series.is_scatter ? 4.5 : 2, style.line.color);
    }
  }
  const cv::Point2d key = layout.key_at(number);
  const cv::Point2d middle = key + cv::Point2d(kKeySample / 2, -4.5);
  if (series.is_scatter)
    canvas.mark(middle, style.mark, 4.5, style.line.color);
  else
    canvas.polyline({{key.x, middle.y}, {key.x + kKeySample, middle.y}}, style.line);
  canvas.text({key.x + kKeySample + 8, key.y}, series.title, TextAnchor::start, kTextSize, false);
}

void draw_axes(Canvas& canvas, const Layout& layout, const Plot& plot) {
  const cv::Rect2d& frame = layout.frame();
  const double right = frame.x + frame.width, bottom = frame.y + frame.height;
  const std::vector<double> x_ticks = ticks_of(plot.x_range, PlotScale::linear);
  for (const double tick : x_ticks) {
    const double x = layout.x_of(tick);
    canvas.polyline({{x, frame.y}, {x, bottom}}, {kGridColor, 1});
    canvas.text({x, bottom + 18}, tick_text(tick, x_ticks), TextAnchor::middle, kTextSize, false);
  }
  const std::vector<double> y_ticks = ticks_of(plot.y_range, plot.y_scale);
  for (const double tick : y_ticks) {
    const double y = layout.y_of(tick);
    canvas.polyline({{frame.x, y}, {right, y}}, {kGridColor, 1});
    canvas.text({frame.x - 8, y + 4.5}, tick_text(tick, y_ticks), TextAnchor::end, kTextSize, false);
  }
  canvas.polyline({{frame.x, frame.y}, {right, frame.y}, {right, bottom}, {frame.x, bottom}, {frame.x, frame.y}},
                  {kFrameColor, 1});
  const double middle = frame.x + frame.width / 2;
  canvas.text({middle, 28}, plot.title, TextAnchor::middle, kTitleSize, false);
  canvas.text({middle, bottom + 40}, plot.x_label, TextAnchor::middle, kTextSize, false);
  canvas.text({20, frame.y + frame.height / 2}, plot.y_label, TextAnchor::middle, kTextSize, true);
}

void draw(Canvas& canvas, const Layout& layout, const Plot& plot) {
  const cv::Rect2d& frame = layout.frame();
  for (const PlotSpan& span : plot.shaded) {
    const double from = std::clamp(layout.x_of(span.first), frame.x, frame.x + frame.width);
    const double to = std::clamp(layout.x_of(span.last), frame.x, frame.x + frame.width);
    if (to > from) canvas.fill({from, frame.y, to - from, frame.height}, kShade);
  }
  draw_axes(canvas, layout, plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) draw_series(canvas, layout, plot.series[i], i);
}

// Ranges that an axis can have.
Plot drawable(Plot plot) {
  for (PlotSpan* const range : {&plot.x_range, &plot.y_range})
    if (!(range->last > range->first)) *range = {range->first - 0.5, range->first + 0.5};
  return plot;
}

}  // namespace

std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale) {
  if (!(range.last > range.first)) return {range.first};
  if (scale == PlotScale::symlog) return symlog_ticks(range);
  const double step = step_of(range.last - range.first);
  std::vector<double> ticks;
  // By whole numbers: sums of steps would not end at round numbers.
  const double slack = 1e-9 * (range.last - range.first);
  for (double n = std::ceil((range.first - slack) / step); n * step <= range.last + slack; ++n)
    ticks.push_back(n == 0 ? 0 : n * step);
  return ticks;
}

std::string svg_of(const Plot& plot) {
  const Plot whole = drawable(plot);
  const Layout layout(whole);
  SvgCanvas canvas(whole.name, kWidth, layout.height());
  draw(canvas, layout, whole);
  return canvas.finished();
}

cv::Mat image_of(const Plot& plot) {
  const Plot whole = drawable(plot);
  const Layout layout(whole);
  ImageCanvas canvas(kWidth, layout.height(), kImageScale);
  draw(canvas, layout, whole);
  return canvas.image();
}

}  // namespace sigs
