// SPDX-License-Identifier: MIT
#include "paint.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sigs::models {

Colour display_colour(const Colour& reflectance) {
  const auto coded = [](double r) { return r <= 0.0031308 ? 12.92 * r : 1.055 * std::pow(r, 1 / 2.4) - 0.055; };
  const Colour r = glm::clamp(reflectance, 0.0, 1.0);
  return {coded(r.r), coded(r.g), coded(r.b)};
}

double streaks(double across_m, double along_m) {
  const double drift = across_m + 0.03 * std::sin(0.9 * along_m);
  const double sum = std::sin(31 * drift) + std::sin(53 * drift + 1.3) + std::sin(87 * drift + 4.1 + 0.2 * along_m);
  return std::pow(0.5 + sum / 6, 2.0);
}

cv::Mat painted(cv::Size size_px, const std::function<Colour(const glm::dvec2& place)>& colour_at) {
  constexpr int kFine = 5;
  cv::Mat bgr(size_px, CV_8UC3);
  for (int y = 0; y < size_px.height; ++y)
    for (int x = 0; x < size_px.width; ++x) {
      Colour sum{0};
      for (int i = 0; i < kFine * kFine; ++i) {
        const glm::dvec2 fine{(i % kFine + 0.5) / kFine, (i / kFine + 0.5) / kFine};
        sum += colour_at((glm::dvec2(x, y) + fine) / glm::dvec2(size_px.width, size_px.height));
      }
      const Colour mean = display_colour(sum / double(kFine * kFine)) * 255.0;
      bgr.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(mean.b), cv::saturate_cast<uchar>(mean.g),
                                 cv::saturate_cast<uchar>(mean.r)};
    }
  return bgr;
}

Lettering::Lettering(const std::string& text) {
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX, kThickness = 12;
  constexpr double kScale = 3;
  int below = 0;
  const cv::Size size = cv::getTextSize(text, kFont, kScale, kThickness, &below);
  cv::Mat canvas(size.height + 3 * kThickness, size.width + 3 * kThickness, CV_8UC1, cv::Scalar(0));
  cv::putText(canvas, text, {kThickness, canvas.rows - kThickness}, kFont, kScale, 255, kThickness, cv::LINE_8);
  mask_ = canvas(cv::boundingRect(canvas)).clone();
  aspect_ = static_cast<double>(mask_.cols) / mask_.rows;
}

bool Lettering::covers(double x, double y) const {
  if (x < 0 || y < 0 || x >= 1 || y >= 1) return false;
  return mask_.at<uchar>(static_cast<int>(y * mask_.rows), static_cast<int>(x * mask_.cols)) > 127;
}

constexpr double kFourPercent = 0.16;  // Ks

MaterialSpec lacquer(const std::string& name, const Colour& reflectance) {
  return {.name = name, .reflectance = reflectance, .specular = kFourPercent, .shininess = 100};
}

MaterialSpec lacquer_image(const std::string& name, const std::string& file) {
  return {.name = name, .specular = kFourPercent, .shininess = 100, .texture = file};
}

MaterialSpec matt(const std::string& name, const Colour& reflectance) {
  return {.name = name, .reflectance = reflectance};
}

MaterialSpec metal(const std::string& name, double reflectance) {
  return {.name = name, .reflectance = grey(reflectance), .specular = 0.8, .shininess = 40};
}

MaterialSpec glass(const std::string& name, double opacity) {
  return {.name = name,
          .reflectance = {0.013, 0.02, 0.026},
          .specular = kFourPercent,
          .shininess = 200,
          .opacity = opacity};
}

std::vector<MaterialSpec> lamps() {
  return {matt("light_red", {1, 0.02, 0.02}), matt("light_green", {0.02, 1, 0.2}), matt("light_white", grey(1))};
}

std::vector<MaterialSpec> together(const std::vector<std::vector<MaterialSpec>>& lists) {
  std::vector<MaterialSpec> all;
  for (const std::vector<MaterialSpec>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace sigs::models
