// SPDX-License-Identifier: MIT
#include "plot/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMeanLetter = 0.56;     // of a text's size
constexpr double kPlainFont_px = 21;     // height at which OpenCV's plain font has the scale 1: from top to baseline
constexpr double kCapitalHeight = 0.73;  // of a text's size

std::string number(double value) {
  std::string text = fixed_text(value, 2);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(const PlotColor& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

std::string points_text(const std::vector<cv::Point2d>& points) {
  std::string text;
  for (const cv::Point2d& point : points) text += (text.empty() ? "" : " ") + number(point.x) + "," + number(point.y);
  return text;
}

// The corners of a mark that has any; for `plus` and `cross` the ends of two strokes.
std::vector<cv::Point2d> corners_of(Mark mark, const cv::Point2d& at, double r) {
  switch (mark) {
    case Mark::square:
      return {at + cv::Point2d(-r, -r), at + cv::Point2d(r, -r), at + cv::Point2d(r, r), at + cv::Point2d(-r, r)};
    case Mark::diamond:
      return {at + cv::Point2d(0, -1.3 * r), at + cv::Point2d(1.3 * r, 0), at + cv::Point2d(0, 1.3 * r),
              at + cv::Point2d(-1.3 * r, 0)};
    case Mark::triangle:
      return {at + cv::Point2d(0, -1.2 * r), at + cv::Point2d(1.15 * r, 0.9 * r), at + cv::Point2d(-1.15 * r, 0.9 * r)};
    case Mark::plus:
      return {at + cv::Point2d(-r, 0), at + cv::Point2d(r, 0), at + cv::Point2d(0, -r), at + cv::Point2d(0, r)};
    case Mark::cross:
      return {at + cv::Point2d(-r, -r), at + cv::Point2d(r, r), at + cv::Point2d(-r, r), at + cv::Point2d(r, -r)};
    case Mark::dot:
    case Mark::disc:
      break;
  }
  return {};
}

// The pieces of a line that are drawn.
std::vector<std::vector<cv::Point2d>> dashed(const std::vector<cv::Point2d>& points,
                                             const std::vector<double>& dashes) {
  std::vector<std::vector<cv::Point2d>> pieces;
  std::size_t dash = 0;
  double left = dashes[0];
  std::vector<cv::Point2d> piece{points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const cv::Point2d whole = points[i + 1] - points[i];
    const double length = std::hypot(whole.x, whole.y);
    double gone = 0;
    while (length - gone > left) {
      gone += left;
      const cv::Point2d at = points[i] + whole * (gone / length);
      piece.push_back(at);
      if (dash % 2 == 0) pieces.push_back(piece);
      piece = {at};
      dash = (dash + 1) % dashes.size();
      left = dashes[dash];
    }
    left -= length - gone;
    piece.push_back(points[i + 1]);
  }
  if (dash % 2 == 0 && piece.size() > 1) pieces.push_back(piece);
  return pieces;
}

// OpenCV's plain font has ASCII alone: a letter of several bytes is one question mark.
std::string ascii_of(const std::string& text) {
  std::string plain;
  for (const char c : line_text(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) plain += c;
    if (byte >= 0xC0) plain += '?';
  }
  return plain;
}

}  // namespace

double text_width(std::string_view text, double size) {
  const auto letters =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return kMeanLetter * size * static_cast<double>(letters);
}

SvgCanvas::SvgCanvas(std::string_view name, double width, double height)
    : text_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                      "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" fill=\"#202020\" role=\"img\" "
                      "aria-label=\"{2}\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                      number(width), number(height), escaped_text(line_text(name)))) {}

void SvgCanvas::fill(const cv::Rect2d& rect, const PlotColor& color) {
  text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", number(rect.x),
                       number(rect.y), number(rect.width), number(rect.height), hex(color));
}

void SvgCanvas::polyline(const std::vector<cv::Point2d>& points, const LineStyle& style) {
  std::string dashes;
  for (const double length : style.dashes) dashes += (dashes.empty() ? "" : ",") + number(length);
  if (!dashes.empty()) dashes = " stroke-dasharray=\"" + dashes + "\"";
  text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
                       points_text(points), hex(style.color), number(style.width), dashes);
}

void SvgCanvas::mark(const cv::Point2d& at, Mark mark, double size, const PlotColor& color) {
  const std::vector<cv::Point2d> corners = corners_of(mark, at, size);
  if (corners.empty())
    text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(at.x), number(at.y),
                         number(size), hex(color));
  else if (mark == Mark::plus || mark == Mark::cross)
    for (std::size_t i = 0; i < corners.size(); i += 2) polyline({corners[i], corners[i + 1]}, {color, 2});
  else
    text_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points_text(corners), hex(color));
}

void SvgCanvas::text(const cv::Point2d& at, const std::string& text, TextAnchor anchor, double size, bool upright) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  const std::string place = number(at.x) + (upright ? " " : "\" y=\"") + number(at.y);
  const std::string where =
      upright ? fmt::format("transform=\"translate({}) rotate(-90)\"", place) : fmt::format("x=\"{}\"", place);
  text_ += fmt::format("<text {} font-size=\"{}\" text-anchor=\"{}\">{}</text>\n", where, number(size),
                       kAnchors[static_cast<int>(anchor)], escaped_text(line_text(text)));
}

ImageCanvas::ImageCanvas(double width, double height, double scale)
    : scale_(scale), image_(cvRound(height * scale), cvRound(width * scale), CV_8UC3, cv::Scalar::all(255)) {}

namespace {

constexpr int kFine = 4;  // bits behind the point

cv::Scalar bgr(const PlotColor& color) {
  return {static_cast<double>(color.blue), static_cast<double>(color.green), static_cast<double>(color.red)};
}

}  // namespace

cv::Point ImageCanvas::fine(const cv::Point2d& at) const {
  // An SVG's pixel begins where its number says; in an image its centre is there.
  return {cvRound((at.x * scale_ - 0.5) * (1 << kFine)), cvRound((at.y * scale_ - 0.5) * (1 << kFine))};
}

void ImageCanvas::fill(const cv::Rect2d& rect, const PlotColor& color) {
  const cv::Point from(cvRound(rect.x * scale_), cvRound(rect.y * scale_));
  const cv::Point to(cvRound((rect.x + rect.width) * scale_), cvRound((rect.y + rect.height) * scale_));
  image_(cv::Rect(from, to) & cv::Rect({0, 0}, image_.size())).setTo(bgr(color));
}

void ImageCanvas::polyline(const std::vector<cv::Point2d>& points, const LineStyle& style) {
  if (points.size() < 2) return;
  // OpenCV's smooth lines are about half a pixel wider than they are asked to be.
  const int width_px = std::max(1, static_cast<int>(style.width * scale_ - 0.5));
  const auto pieces =
      style.dashes.empty() ? std::vector<std::vector<cv::Point2d>>{points} : dashed(points, style.dashes);
  for (const std::vector<cv::Point2d>& piece : pieces) {
    std::vector<cv::Point> corners;
    for (const cv::Point2d& point : piece) corners.push_back(fine(point));
    cv::polylines(image_, corners, false, bgr(style.color), width_px, cv::LINE_AA, kFine);
  }
}

void ImageCanvas::mark(const cv::Point2d& at, Mark mark, double size, const PlotColor& color) {
  const std::vector<cv::Point2d> corners = corners_of(mark, at, size);
  if (corners.empty()) {
    cv::circle(image_, fine(at), cvRound(size * scale_ * (1 << kFine)), bgr(color), cv::FILLED, cv::LINE_AA, kFine);
  } else if (mark == Mark::plus || mark == Mark::cross) {
    for (std::size_t i = 0; i < corners.size(); i += 2) polyline({corners[i], corners[i + 1]}, {color, 2});
  } else {
    std::vector<cv::Point> fine_corners;
    for (const cv::Point2d& corner : corners) fine_corners.push_back(fine(corner));
    cv::fillConvexPoly(image_, fine_corners, bgr(color), cv::LINE_AA, kFine);
  }
}

void ImageCanvas::text(const cv::Point2d& at, const std::string& text, TextAnchor anchor, double size, bool upright) {
  const std::string plain = ascii_of(text);
  const double font = kCapitalHeight * size * scale_ / kPlainFont_px;
  constexpr int width_px = 1;
  int below_px = 0;
  const cv::Size box = cv::getTextSize(plain, cv::FONT_HERSHEY_SIMPLEX, font, width_px, &below_px);
  const int before_px = anchor == TextAnchor::start ? 0 : anchor == TextAnchor::end ? box.width : box.width / 2;
  const cv::Point place(cvRound(at.x * scale_), cvRound(at.y * scale_));
  const cv::Scalar ink = cv::Scalar::all(0x20);
  if (!upright) {
    cv::putText(image_, plain, {place.x - before_px, place.y}, cv::FONT_HERSHEY_SIMPLEX, font, ink, width_px,
                cv::LINE_AA);
    return;
  }
  cv::Mat lying(box.height + 2 * below_px, box.width + 2, CV_8UC3, cv::Scalar::all(255));
  cv::putText(lying, plain, {1, box.height + below_px / 2}, cv::FONT_HERSHEY_SIMPLEX, font, ink, width_px, cv::LINE_AA);
  cv::Mat standing;
  cv::rotate(lying, standing, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect wanted(place.x - box.height, place.y + before_px - standing.rows, standing.cols, standing.rows);
  const cv::Rect there = wanted & cv::Rect({0, 0}, image_.size());
  if (!there.empty()) standing(there - wanted.tl()).copyTo(image_(there));
}

namespace {

constexpr double kMaxTicks = 8;

double placed(double value, PlotScale scale) {
  if (scale == PlotScale::log) return std::log10(std::max(value, 1e-300));
  return scale == PlotScale::symlog ? std::asinh(value / 10) : value;
}

// Powers of ten, and 2 and 5 times these where there are few of them.
std::vector<double> log_ticks(const PlotSpan& range) {
  const double first = std::log10(std::max(range.first, 1e-300)), last = std::log10(range.last);
  const double step = std::max(1.0, std::ceil((last - first) / kMaxTicks));
  std::vector<double> ticks;
  for (double power = std::floor(first / step) * step; power <= last; power += step)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10, power);
      const bool is_wanted = factor == 1 || last - first < 3;
      if (is_wanted && tick >= range.first * (1 - 1e-9) && tick <= range.last * (1 + 1e-9)) ticks.push_back(tick);
    }
  return ticks;
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

// 1, 2 or 5 times a power of ten, so that at most this many steps fit into the range.
double step_of(double range, double most) {
  const double rough = range / most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<double> round_numbers(const PlotSpan& range, double most) {
  const double step = step_of(range.last - range.first, most);
  std::vector<double> ticks;
  // By whole numbers: sums of steps would not end at round numbers.
  const double slack = 1e-9 * (range.last - range.first);
  for (double n = std::ceil((range.first - slack) / step); n * step <= range.last + slack; ++n)
    ticks.push_back(n == 0 ? 0 : n * step);
  return ticks;
}

// With as many decimals as tell the ticks apart.
std::string tick_text(double value, const std::vector<double>& ticks) {
  double step = std::abs(value);
  for (std::size_t i = 0; i + 1 < ticks.size(); ++i) step = std::min(step > 0 ? step : 1e300, ticks[i + 1] - ticks[i]);
  if (step <= 0 || step >= 1e300) return fixed_text(value, 0);
  return fixed_text(value, std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9));
}

// 1e-4, 0.001, 20, 1e5
std::string decade_text(double value) {
  if (value >= 1e-3 * (1 - 1e-9) && value < 1e5 * (1 - 1e-9)) return short_number_text(value);
  const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  return short_number_text(std::round(value / std::pow(10, power))) + "e" + std::to_string(power);
}

}  // namespace

double Axis::at(double value) const {
  const double first = placed(range.first, scale), last = placed(range.last, scale);
  const double share = (placed(value, scale) - first) / (last - first);
  return std::isfinite(share) ? first_px + share * (last_px - first_px) : first_px;  // of numbers beyond 1e308
}

double Axis::length_px() const {
  return std::abs(last_px - first_px);
}

double Axis::per_px() const {
  return std::abs(range.last - range.first) / length_px();
}

void Axis::widen(double wanted_per_px) {
  const double middle = (range.first + range.last) / 2;
  const double half = std::copysign(wanted_per_px * length_px() / 2, range.last - range.first);
  range = {middle - half, middle + half};
}

std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale) {
  if (!(range.last > range.first)) return {range.first};
  if (scale == PlotScale::symlog) return symlog_ticks(range);
  return scale == PlotScale::log ? log_ticks(range) : round_numbers(range, kMaxTicks);
}

std::vector<PlotTick> ticks_on(const Axis& axis, double most) {
  const PlotSpan rising{std::min(axis.range.first, axis.range.last), std::max(axis.range.first, axis.range.last)};
  const std::vector<double> numbers =
      axis.scale == PlotScale::linear ? round_numbers(rising, std::min(most, kMaxTicks)) : ticks_of(rising, axis.scale);
  std::vector<PlotTick> ticks;
  for (const double number : numbers)
    ticks.push_back({number, axis.scale == PlotScale::log ? decade_text(number) : tick_text(number, numbers)});
  return ticks;
}

}  // namespace sigs
