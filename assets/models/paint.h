// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>

namespace sigs::models {

using Colour = glm::dvec3;  // red, green, blue; display code values 0..1

// An image whose pixels are the mean of the colours at 5 x 5 places in each. place: x right, y down, 0..1 over the
// image.
[[nodiscard]] cv::Mat painted(cv::Size size_px, const std::function<Colour(const glm::dvec2& place)>& colour_at);

// Letters as a mask: 1 inside, 0 outside, (0, 0) the upper left corner of the text, (1, 1) its lower right.
class Lettering {
 public:
  explicit Lettering(const std::string& text);
  [[nodiscard]] bool covers(double x, double y) const;
  [[nodiscard]] double aspect() const { return aspect_; }  // width over height

 private:
  cv::Mat mask_;
  double aspect_ = 1;
};

}  // namespace sigs::models
