// SPDX-License-Identifier: MIT
#include "telemetry/plot_axes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kTextSize = 0.45;
const cv::Scalar kGrid(225, 225, 225);

int width_of(const std::string& text) {
  int base = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kTextSize, 1, &base).width;
}

}  // namespace

double tick_step(double range) {
  const double rough = std::max(range, 1e-9) / 6;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

std::vector<Tick> ticks_between(double low, double high, double step) {
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 6);
  std::vector<Tick> ticks;
  for (double value = std::ceil(low / step) * step; value <= high; value += step)
    ticks.push_back({value, fixed_text(value, decimals)});
  return ticks;
}

void draw_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& ink) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, kTextSize, ink, 1, cv::LINE_AA);
}

void draw_text_until(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& ink) {
  draw_text(image, text, {at.x - width_of(text), at.y}, ink);
}

void draw_axes(cv::Mat& image, cv::Point low_px, cv::Point high_px, const std::vector<PlacedTick>& x,
               const std::vector<PlacedTick>& y, const AxisTexts& texts) {
  for (const auto& [tick, at_px] : x) {
    cv::line(image, {at_px, low_px.y}, {at_px, high_px.y}, kGrid);
    const int width = width_of(tick.text);
    const int begin_px = texts.is_centred ? at_px - width / 2 : at_px + texts.end_px - width;
    draw_text(image, tick.text, {begin_px, high_px.y + texts.below_px}, texts.ink);
  }
  for (const auto& [tick, at_px] : y) {
    cv::line(image, {low_px.x, at_px}, {high_px.x, at_px}, kGrid);
    draw_text_until(image, tick.text, {low_px.x - 8, at_px + 5}, texts.ink);
  }
  cv::rectangle(image, low_px, high_px, texts.ink);
}

}  // namespace sigs
