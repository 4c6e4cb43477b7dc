// SPDX-License-Identifier: MIT
#include "plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

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
constexpr PlotColor kGridColor{0xD8, 0xD8, 0xD8}, kFrameColor{0x40, 0x40, 0x40}, kShade{0xEC, 0xEC, 0xEC},
    kLevelColor{0x90, 0x90, 0x90};

constexpr double kLeft = 78, kRight = 24, kTop = 44, kBelowFrame = 52;  // room around the frame
constexpr double kRemark = 18, kLabelRoom = 34;                         // of a remark above it, a label beside it
constexpr double kKeyRow = 22, kKeySample = 38, kKeyGap = 28;
constexpr double kTextSize = 13, kTitleSize = 15, kNoteSize = 11;
constexpr double kImageScale = 1.5;
constexpr double kTickWidth = 90, kTickHeight = 25;  // room for each tick, at least

// Room for the texts left of the frame.
double left_of(const Plot& plot) {
  double widest = 0;
  for (const PlotTick& tick : plot.y_ticks.value_or(std::vector<PlotTick>{}))
    widest = std::max(widest, text_width(tick.text, kTextSize));
  return std::max(kLeft, widest + 16 + (plot.y_label.empty() ? 0 : kLabelRoom));
}

// Where the parts of a plot lie.
class Layout {
 public:
  explicit Layout(const Plot& plot) : plot_(plot) {
    double x = kLeft, row = 0;
    bool has_key = false;
    for (const PlotSeries& series : plot.series) {
      const double width = kKeySample + 8 + text_width(series.title, kTextSize) + kKeyGap;
      if (!series.title.empty() && x > kLeft && x + width > plot.width - kRight + kKeyGap) {
        x = kLeft;
        ++row;
      }
      key_.push_back({x, row});
      if (series.title.empty()) continue;
      x += width;
      has_key = true;
    }
    rows_ = has_key ? row + 1 : 0;
    if (plot.height <= 0) return;
    const double left = left_of(plot), top = kTop + (plot.remark.empty() ? 0 : kRemark);
    frame_ = {left, top, plot.width - left - kRight, plot.height - top - kBelowFrame - kKeyRow};
    x_ = {plot.x_range, plot.x_scale, frame_.x, frame_.x + frame_.width};
    y_ = {plot.y_range, plot.y_scale, frame_.y + frame_.height, frame_.y};
    if (!plot.same_scale) return;
    const double per_px = std::max(x_.per_px(), y_.per_px());
    x_.widen(per_px);
    y_.widen(per_px);
  }

  [[nodiscard]] double height() const {
    return plot_.height <= 0 ? rows_ * kKeyRow + 10 : plot_.height + std::max(0.0, rows_ - 1) * kKeyRow;
  }
  [[nodiscard]] const cv::Rect2d& frame() const { return frame_; }
  [[nodiscard]] const Axis& x() const { return x_; }
  [[nodiscard]] const Axis& y() const { return y_; }
  [[nodiscard]] cv::Point2d at(const PlotPoint& point) const { return {x_.at(point.x), y_.at(point.y)}; }
  // The left end of an entry of the key, on its text's baseline.
  [[nodiscard]] cv::Point2d key_at(std::size_t series) const {
    const double first = plot_.height <= 0 ? kKeyRow : plot_.height - 10;
    return {key_[series].x, first + kKeyRow * key_[series].y};
  }

 private:
  const Plot& plot_;
  cv::Rect2d frame_;
  Axis x_, y_;
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

// Of many points one after the other in the same column of pixels the first, the least, the greatest and the last
// show the same.
std::vector<cv::Point2d> places_of(const Layout& layout, const std::vector<PlotPoint>& run) {
  std::vector<cv::Point2d> places;
  const bool is_long = static_cast<double>(run.size()) > 8 * layout.frame().width;
  for (std::size_t i = 0; i < run.size();) {
    std::size_t low = i, high = i, end = i + 1;
    const cv::Point2d first = layout.at(run[i]);
    for (; is_long && end < run.size() && std::floor(layout.x().at(run[end].x)) == std::floor(first.x); ++end) {
      if (run[end].y < run[low].y) low = end;
      if (run[end].y > run[high].y) high = end;
    }
    std::array<std::size_t, 4> kept{i, std::min(low, high), std::max(low, high), end - 1};
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (k == 0 || kept[k] != kept[k - 1]) places.push_back(layout.at(run[kept[k]]));
    i = end;
  }
  return places;
}

void draw_run(Canvas& canvas, const Layout& layout, const std::vector<PlotPoint>& run, const LineStyle& style) {
  std::vector<cv::Point2d> line;
  const auto flush = [&] {
    if (line.size() > 1) canvas.polyline(line, style);
    line.clear();
  };
  const std::vector<cv::Point2d> places = places_of(layout, run);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    cv::Point2d a = places[i], b = places[i + 1];
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

SeriesStyle style_of(const PlotSeries& series, std::size_t number) {
  const std::size_t round = number + number / kColors.size();
  if (series.color) return {{*series.color, 1.5}, kMarks[round % kMarks.size()]};
  const bool is_dashed = series.kind == SeriesKind::line;
  return {{kColors[number % kColors.size()], 2, is_dashed ? kDashes[round % kDashes.size()] : kDashes[0]},
          kMarks[round % kMarks.size()]};
}

void draw_areas(Canvas& canvas, const Layout& layout, const PlotSeries& series, const PlotColor& color) {
  for (const std::vector<PlotPoint>& run : series.runs) {
    const cv::Point2d a = layout.at(run.front()), b = layout.at(run.back());
    cv::Rect2d area(cv::Point2d(std::min(a.x, b.x), std::min(a.y, b.y)),
                    cv::Point2d(std::max(a.x, b.x), std::max(a.y, b.y)));
    area.width = std::max(area.width, 1.0);  // the shortest times are seen, too
    if (area &= layout.frame(); !area.empty()) canvas.fill(area, color);
  }
}

void draw_marks(Canvas& canvas, const Layout& layout, const std::vector<PlotPoint>& run, Mark mark, double size,
                const PlotColor& color) {
  for (const PlotPoint& point : run)
    if (const cv::Point2d at = layout.at(point); is_within(layout.frame(), at)) canvas.mark(at, mark, size, color);
}

constexpr double kMarkSize = 4.5, kDotSize = 2;

void draw_series(Canvas& canvas, const Layout& layout, const PlotSeries& series, const SeriesStyle& style) {
  for (const std::vector<PlotPoint>& run : series.runs) {
    if (series.kind != SeriesKind::marks && run.size() > 1) draw_run(canvas, layout, run, style.line);
    if (series.kind != SeriesKind::line)
      draw_marks(canvas, layout, run, style.mark, kMarkSize, style.line.color);
    else if (run.size() == 1)  // a line needs two
      draw_marks(canvas, layout, run, Mark::dot, kDotSize, style.line.color);
  }
}

void draw_key(Canvas& canvas, const cv::Point2d& at, const PlotSeries& series, const SeriesStyle& style) {
  const cv::Point2d middle = at + cv::Point2d(kKeySample / 2, -4.5);
  if (series.kind == SeriesKind::areas) canvas.fill({at.x, at.y - 11, kKeySample, 12}, style.line.color);
  if (series.kind == SeriesKind::line || series.kind == SeriesKind::marked_line)
    canvas.polyline({{at.x, middle.y}, {at.x + kKeySample, middle.y}}, style.line);
  if (series.kind == SeriesKind::marks || series.kind == SeriesKind::marked_line)
    canvas.mark(middle, style.mark, kMarkSize, style.line.color);
  canvas.text({at.x + kKeySample + 8, at.y}, series.title, TextAnchor::start, kTextSize, false);
}

// The size in which a text is no wider than this: smaller where it has to be.
double fitted_size(const std::string& text, double size, double room) {
  return size * std::clamp(room / std::max(1.0, text_width(text, 1.2 * size)), 0.6, 1.0);
}

// So small that stated texts stand beside one another.
double x_text_size(const Layout& layout, const Plot& plot) {
  if (!plot.x_ticks || plot.x_ticks->empty()) return kTextSize;
  const double room = layout.frame().width / static_cast<double>(plot.x_ticks->size());
  double size = kTextSize;
  for (const PlotTick& tick : *plot.x_ticks) size = std::min(size, fitted_size(tick.text, kTextSize, room));
  return size;
}

void draw_axes(Canvas& canvas, const Layout& layout, const Plot& plot) {
  const double x_size = x_text_size(layout, plot);
  const cv::Rect2d& frame = layout.frame();
  const double right = frame.x + frame.width, bottom = frame.y + frame.height;
  for (const PlotTick& tick : plot.x_ticks ? *plot.x_ticks : ticks_on(layout.x(), frame.width / kTickWidth)) {
    const double x = layout.x().at(tick.at);
    canvas.polyline({{x, frame.y}, {x, bottom}}, {kGridColor, 1});
    canvas.text({x, bottom + 18}, tick.text, TextAnchor::middle, x_size, false);
  }
  for (const PlotTick& tick : plot.y_ticks ? *plot.y_ticks : ticks_on(layout.y(), frame.height / kTickHeight)) {
    const double y = layout.y().at(tick.at);
    canvas.polyline({{frame.x, y}, {right, y}}, {kGridColor, 1});
    canvas.text({frame.x - 8, y + 4.5}, tick.text, TextAnchor::end, kTextSize, false);
  }
  canvas.polyline({{frame.x, frame.y}, {right, frame.y}, {right, bottom}, {frame.x, bottom}, {frame.x, frame.y}},
                  {kFrameColor, 1});
  const double middle = frame.x + frame.width / 2;
  canvas.text({middle, 28}, plot.title, TextAnchor::middle, kTitleSize, false);
  canvas.text({middle, 28 + kRemark}, plot.remark, TextAnchor::middle,
              fitted_size(plot.remark, kTextSize, frame.width + kLeft), false);
  canvas.text({middle, bottom + 40}, plot.x_label, TextAnchor::middle, kTextSize, false);
  canvas.text({20, frame.y + frame.height / 2}, plot.y_label, TextAnchor::middle, kTextSize, true);
}

void draw_frame(Canvas& canvas, const Layout& layout, const Plot& plot) {
  const cv::Rect2d& frame = layout.frame();
  for (const PlotSpan& span : plot.shaded) {
    const double from = std::clamp(layout.x().at(span.first), frame.x, frame.x + frame.width);
    const double to = std::clamp(layout.x().at(span.last), frame.x, frame.x + frame.width);
    if (to > from) canvas.fill({from, frame.y, to - from, frame.height}, kShade);
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    if (plot.series[i].kind == SeriesKind::areas)
      draw_areas(canvas, layout, plot.series[i], style_of(plot.series[i], i).line.color);
  draw_axes(canvas, layout, plot);
  for (const double level : plot.levels)
    if (const double y = layout.y().at(level); y >= frame.y && y <= frame.y + frame.height)
      canvas.polyline({{frame.x, y}, {frame.x + frame.width, y}}, {kLevelColor, 1.2, {3, 4}});
}

void draw(Canvas& canvas, const Layout& layout, const Plot& plot) {
  const bool has_frame = plot.height > 0;
  if (has_frame) draw_frame(canvas, layout, plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const SeriesStyle style = style_of(series, i);
    if (has_frame && series.kind != SeriesKind::areas) draw_series(canvas, layout, series, style);
    if (!series.title.empty()) draw_key(canvas, layout.key_at(i), series, style);
  }
  for (const PlotNote& note : plot.notes)
    if (const cv::Point2d at = layout.at(note.at); is_within(layout.frame(), at))
      canvas.text(at - cv::Point2d(0, 8), note.text, TextAnchor::middle, kNoteSize, false);
}

// Ranges that an axis can have.
Plot drawable(Plot plot) {
  for (PlotSpan* const range : {&plot.x_range, &plot.y_range})
    if (range->last == range->first) *range = {range->first - 0.5, range->first + 0.5};
  return plot;
}

}  // namespace

PlotSpan range_of(const std::vector<PlotSeries>& series, double PlotPoint::*value, double margin) {
  PlotSpan range{INFINITY, -INFINITY};
  for (const PlotSeries& one : series)
    for (const std::vector<PlotPoint>& run : one.runs)
      for (const PlotPoint& point : run)
        range = {std::min(range.first, point.*value), std::max(range.last, point.*value)};
  if (range.first > range.last) return {0, 1};
  const double least = 1e-6 * std::max(std::abs(range.first), std::abs(range.last));
  const double wider = std::max(margin * (range.last - range.first), least);
  return wider > 0 ? PlotSpan{range.first - wider, range.last + wider} : PlotSpan{-0.5, 0.5};
}

std::string svg_of(const Plot& plot) {
  const Plot whole = drawable(plot);
  const Layout layout(whole);
  SvgCanvas canvas(whole.name, whole.width, layout.height());
  draw(canvas, layout, whole);
  return canvas.finished();
}

cv::Mat image_of(const Plot& plot) {
  const Plot whole = drawable(plot);
  const Layout layout(whole);
  ImageCanvas canvas(whole.width, layout.height(), kImageScale);
  draw(canvas, layout, whole);
  return canvas.image();
}

cv::Mat image_of(const std::vector<Plot>& plots, int columns) {
  std::vector<cv::Mat> images;
  std::vector<cv::Point> places;
  cv::Size page_px(0, 0);
  cv::Point next(0, 0);
  for (const Plot& plot : plots) {
    if (images.size() % static_cast<std::size_t>(columns) == 0) next = {0, page_px.height};
    images.push_back(image_of(plot));
    places.push_back(next);
    next.x += images.back().cols;
    page_px = {std::max(page_px.width, next.x), std::max(page_px.height, next.y + images.back().rows)};
  }
  if (images.empty()) return {};
  cv::Mat page(page_px, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < images.size(); ++i) images[i].copyTo(page(cv::Rect(places[i], images[i].size())));
  return page;
}

}  // namespace sigs
