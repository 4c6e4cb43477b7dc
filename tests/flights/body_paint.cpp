// SPDX-License-Identifier: MIT
#include "flights/body_paint.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "flights/mosaic.h"
#include "flights/random.h"

namespace sigs::flights {

namespace {

constexpr int kFine = 4;  // drawn so many times larger, then averaged

// From shares of the image to pixels of the fine canvas.
struct Canvas {
  cv::Size size_px;
  int margin_px = 0;

  [[nodiscard]] cv::Size fine() const {
    return cv::Size(size_px.width + 2 * margin_px, size_px.height + 2 * margin_px) * kFine;
  }
  [[nodiscard]] cv::Point2d place(cv::Point2d share) const {
    return kFine * cv::Point2d(share.x * size_px.width + margin_px, share.y * size_px.height + margin_px);
  }
  [[nodiscard]] cv::Point fixed(cv::Point2d share) const {
    const cv::Point2d p = place(share);
    return {cvRound((p.x - 0.5) * (1 << kDrawingShift)), cvRound((p.y - 0.5) * (1 << kDrawingShift))};
  }
};

// Corners cut at a quarter, again and again (Chaikin 1974).
Part::Outline rounded(Part::Outline points) {
  for (int round = 0; round < 4; ++round) {
    Part::Outline cut;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const cv::Point2d a = points[i], b = points[(i + 1) % points.size()];
      cut.push_back(0.75 * a + 0.25 * b);
      cut.push_back(0.25 * a + 0.75 * b);
    }
    points = std::move(cut);
  }
  return points;
}

cv::Mat filled(const std::vector<Part::Outline>& outlines, bool round_off, const Canvas& canvas) {
  std::vector<std::vector<cv::Point>> polygons;
  for (const Part::Outline& outline : outlines) {
    polygons.emplace_back();
    for (const cv::Point2d& p : round_off ? rounded(outline) : outline) polygons.back().push_back(canvas.fixed(p));
  }
  cv::Mat fine = cv::Mat::zeros(canvas.fine(), CV_8UC1), cover;
  if (!polygons.empty()) cv::fillPoly(fine, polygons, cv::Scalar(255), cv::LINE_8, kDrawingShift);
  cv::resize(fine, cover, {}, 1.0 / kFine, 1.0 / kFine, cv::INTER_AREA);
  return cover;
}

// Lighter where the rounded-off surface turns up, darker where it turns down: a factor, CV_32FC1.
cv::Mat relief(const cv::Mat& cover, double strength, double softness_px) {
  cv::Mat height, slope_x, slope_y;
  cover.convertTo(height, CV_32F, 1.0 / 255);
  cv::GaussianBlur(height, height, {}, softness_px);
  cv::Sobel(height, slope_x, CV_32F, 1, 0, 3, 0.125 * softness_px);
  cv::Sobel(height, slope_y, CV_32F, 0, 1, 3, 0.125 * softness_px);
  return cv::Mat(1 + strength * (2.2 * slope_y + 1.2 * slope_x) + 0.4 * strength * (height - 0.6));
}

// Seams with rivets along them, where the part is: darkening, CV_8UC1.
cv::Mat panel_lines(const cv::Mat& cover, int count, double scale, std::uint32_t seed) {
  cv::Mat lines = cv::Mat::zeros(cover.size(), CV_8UC1);
  const cv::Rect where = cv::boundingRect(cover);
  const auto fixed = [](cv::Point2d p) { return cv::Point(cvRound(p.x * 16), cvRound(p.y * 16)); };
  for (int k = 0; k < count && !where.empty(); ++k) {
    const bool upright = k % 2 == 0;
    const double a = random_share(k, 1, seed), b = a + 0.12 * (random_share(k, 2, seed) - 0.5);
    const cv::Point2d begin =
        upright ? cv::Point2d(where.x + a * where.width, where.y) : cv::Point2d(where.x, where.y + a * where.height);
    const cv::Point2d end = upright ? cv::Point2d(where.x + b * where.width, where.br().y)
                                    : cv::Point2d(where.br().x, where.y + b * where.height);
    cv::line(lines, fixed(begin), fixed(end), cv::Scalar(70), std::max(1, cvRound(scale)), cv::LINE_AA, kDrawingShift);
    const double length = cv::norm(end - begin), step = 9 * scale;
    const cv::Point2d along = (end - begin) / length, aside = 3 * scale * cv::Point2d(-along.y, along.x);
    for (double s = 0; s < length; s += step)
      cv::circle(lines, fixed(begin + s * along + aside), cvRound(0.8 * scale * 16), cv::Scalar(55), cv::FILLED,
                 cv::LINE_AA, kDrawingShift);
  }
  return lines;
}

// The part's colour everywhere, CV_32FC3.
cv::Mat colored(const Part& part, const cv::Mat& cover, const Canvas& canvas, std::uint32_t seed) {
  const double scale = canvas.size_px.width / 640.0;
  cv::Mat color(cover.size(), CV_32FC3, part.color);
  const cv::Mat stripes = filled(part.stripes, false, canvas);
  const cv::Mat shade = relief(cover, part.relief, 14 * scale),
                lines = panel_lines(cover, part.panel_lines, scale, seed);
  const cv::Mat dirt = tiled_noise(512, 16, 5, 0.7, seed);
  const cv::Vec3f stripe_color(static_cast<float>(part.stripe_color[0]), static_cast<float>(part.stripe_color[1]),
                               static_cast<float>(part.stripe_color[2]));
  for (int y = 0; y < color.rows; ++y)
    for (int x = 0; x < color.cols; ++x) {
      cv::Vec3f& c = color.at<cv::Vec3f>(y, x);
      c += (stripe_color - c) * (static_cast<float>(stripes.at<uchar>(y, x)) / 255);
      c *= shade.at<float>(y, x) * (1 - static_cast<float>(lines.at<uchar>(y, x)) / 255) *
           (1 + 0.03F * dirt.at<float>(y & 511, x & 511));
    }
  return color;
}

}  // namespace

Painted painted_parts(const std::vector<Part>& parts, cv::Size size_px, int margin_px, std::uint32_t seed) {
  const Canvas canvas{size_px, margin_px};
  const cv::Size size = canvas.fine() / kFine;
  cv::Mat paint = cv::Mat::zeros(size, CV_32FC4);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const cv::Mat cover = filled(parts[i].outlines, parts[i].rounded, canvas);
    const cv::Mat color = colored(parts[i], cover, canvas, seed + static_cast<std::uint32_t>(i));
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const float share = static_cast<float>(cover.at<uchar>(y, x)) / 255;
        const cv::Vec3f c = color.at<cv::Vec3f>(y, x);
        const cv::Vec4f over(c[0] * share, c[1] * share, c[2] * share, 255 * share);
        cv::Vec4f& under = paint.at<cv::Vec4f>(y, x);
        under = over + under * (1 - share);
      }
  }
  Painted painted;
  cv::Mat alpha;
  cv::extractChannel(paint, alpha, 3);
  alpha.convertTo(painted.cover, CV_8U);
  cv::GaussianBlur(paint, paint, {}, 0.7 * std::max(1.0, size_px.width / 640.0));  // the lens is focused far away
  paint.convertTo(painted.premultiplied, CV_8U);
  return painted;
}

}  // namespace sigs::flights
