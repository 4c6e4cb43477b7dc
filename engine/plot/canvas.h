// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plot/plot.h"

namespace sigs {

struct LineStyle {
  PlotColor color;
  double width = 1;
  std::vector<double> dashes = {};  // lengths drawn and left out by turns, pixels; empty: solid
};

enum class Mark { dot, disc, square, diamond, triangle, plus, cross };

enum class TextAnchor { start, middle, end };

// Something that a plot is drawn on. Coordinates are pixels of the SVG from the upper left corner, y down.
class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void fill(const cv::Rect2d& rect, const PlotColor& color) = 0;
  virtual void polyline(const std::vector<cv::Point2d>& points, const LineStyle& style) = 0;
  virtual void mark(const cv::Point2d& at, Mark mark, double size, const PlotColor& color) = 0;
  // With its baseline at a point. Upright text reads from below.
  virtual void text(const cv::Point2d& at, const std::string& text, TextAnchor anchor, double size, bool upright) = 0;
};

// An XML element `svg` of this size with a white background.
class SvgCanvas : public Canvas {
 public:
  SvgCanvas(std::string_view name, double width, double height);
  void fill(const cv::Rect2d& rect, const PlotColor& color) override;
  void polyline(const std::vector<cv::Point2d>& points, const LineStyle& style) override;
  void mark(const cv::Point2d& at, Mark mark, double size, const PlotColor& color) override;
  void text(const cv::Point2d& at, const std::string& text, TextAnchor anchor, double size, bool upright) override;
  // The whole of it.
  [[nodiscard]] std::string finished() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

// A white image, `scale` times as large.
class ImageCanvas : public Canvas {
 public:
  ImageCanvas(double width, double height, double scale);
  void fill(const cv::Rect2d& rect, const PlotColor& color) override;
  void polyline(const std::vector<cv::Point2d>& points, const LineStyle& style) override;
  void mark(const cv::Point2d& at, Mark mark, double size, const PlotColor& color) override;
  void text(const cv::Point2d& at, const std::string& text, TextAnchor anchor, double size, bool upright) override;
  [[nodiscard]] const cv::Mat& image() const { return image_; }

 private:
  [[nodiscard]] cv::Point fine(const cv::Point2d& at) const;  // in 16ths of a pixel

  double scale_;
  cv::Mat image_;
};

// About how wide a text of this size is on either canvas, pixels.
[[nodiscard]] double text_width(std::string_view text, double size);

// The range of an axis in pixels.
struct Axis {
  PlotSpan range;
  PlotScale scale = PlotScale::linear;
  double first_px = 0;
  double last_px = 0;

  [[nodiscard]] double at(double value) const;
  [[nodiscard]] double length_px() const;
  [[nodiscard]] double per_px() const;

  // To this many units a pixel, about the middle.
  void widen(double wanted_per_px);
};

// Labelled places of an axis with this scale, at most 12, rising.
[[nodiscard]] std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale);

// The same with their texts; of a linear axis at most this many.
[[nodiscard]] std::vector<PlotTick> ticks_on(const Axis& axis, double most);

}  // namespace sigs
