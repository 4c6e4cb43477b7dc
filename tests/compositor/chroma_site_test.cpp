// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/blend.h"
#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

// Chroma is placed at the footage's site: each way to composite onto an image, against the same in doubles over the
// whole image at full resolution.
namespace sigs::test {
namespace {

// The error of rounding to a code value, and some 24-bit roundings.
constexpr double kBlendRounding = 0.502;

std::vector<Sort> sorts_with_subsampled_chroma() {
  std::vector<Sort> sorts = all_sorts();
  std::erase_if(sorts, [](const Sort& sort) { return sort.step.area() == 1; });
  return sorts;
}

// Random luma, and chroma that rises by a whole number of codes from sample to sample: bilinear interpolation at its
// site gives the plane everywhere, and averaging that gives the samples back. At the image's edges only even chroma
// does so.
Frame graded(const Sort& sort, cv::Size size_px, int rise_across, int rise_down) {
  Frame frame = grainy(sort, size_px);
  for (std::size_t plane = 1; plane < 3; ++plane)
    for (int y = 0; y < frame.planes[plane].rows; ++y)
      for (int x = 0; x < frame.planes[plane].cols; ++x)
        frame.planes[plane].at<uchar>(y, x) = static_cast<uchar>(plane == 1 ? 100 + rise_across * x + rise_down * y
                                                                            : 150 - rise_down * x - rise_across * y);
  return frame;
}

// One axis: where luma sample i lies among chroma samples.
double place_among_chroma(int i, int step, bool on_pixel) {
  return step == 1 ? i : (i - (on_pixel ? 0.0 : 0.5)) / 2;
}

// Chroma at a pixel, bilinear at its site.
double chroma_at(const cv::Mat& plane, const Sort& sort, int x, int y) {
  const double u =
      std::clamp(place_among_chroma(x, sort.step.width, sort.site != ChromaSite::center), 0.0, plane.cols - 1.0);
  const double v =
      std::clamp(place_among_chroma(y, sort.step.height, sort.site == ChromaSite::top_left), 0.0, plane.rows - 1.0);
  const int left = std::min(static_cast<int>(u), plane.cols - 1);
  const int top = std::min(static_cast<int>(v), plane.rows - 1);
  const int right = std::min(left + 1, plane.cols - 1);
  const int low = std::min(top + 1, plane.rows - 1);
  const double a = plane.at<uchar>(top, left) * (1 - (u - left)) + plane.at<uchar>(top, right) * (u - left);
  const double b = plane.at<uchar>(low, left) * (1 - (u - left)) + plane.at<uchar>(low, right) * (u - left);
  return a * (1 - (v - top)) + b * (v - top);
}

// The frame's code values at full resolution: CV_64FC3, luma and colour differences.
cv::Mat whole_codes(const Frame& frame, const Sort& sort) {
  cv::Mat codes(frame.size_px(), CV_64FC3);
  for (int y = 0; y < codes.rows; ++y)
    for (int x = 0; x < codes.cols; ++x)
      codes.at<cv::Vec3d>(y, x) = {double(frame.planes[0].at<uchar>(y, x)), chroma_at(frame.planes[1], sort, x, y),
                                   chroma_at(frame.planes[2], sort, x, y)};
  return codes;
}

cv::Vec3d display_of(const Sort& sort, const cv::Vec3d& codes) {
  cv::Matx33d from_display;
  for (int c = 0; c < 3; ++c) {
    cv::Vec3d one(0, 0, 0);
    one[c] = 1;
    const cv::Vec3d column = codes_of(sort, one) - codes_of(sort, {0, 0, 0});
    for (int row = 0; row < 3; ++row) from_display(row, c) = column[row];
  }
  return from_display.inv() * (codes - codes_of(sort, {0, 0, 0}));
}

double mirrored(double (*curve)(double), double x) {
  return std::copysign(curve(std::abs(x)), x);
}

// The layer's pixel over a pixel's code values.
cv::Vec3d blended(const Sort& sort, const cv::Vec4f& layer, const cv::Vec3d& codes, BlendSpace space) {
  if (!(layer[3] > 0)) return codes;
  const cv::Vec3d below = display_of(sort, codes);
  cv::Vec3d out;
  for (int c = 0; c < 3; ++c)
    out[c] = space == BlendSpace::linear
                 ? mirrored(display_value, layer[c] + (1.0 - layer[3]) * mirrored(linear_value, below[c]))
                 : layer[3] * mirrored(display_value, double(layer[c]) / layer[3]) + (1.0 - layer[3]) * below[c];
  return codes_of(sort, out);
}

cv::Vec4f color_at(const Layer& layer, int x, int y) {
  if (!layer.rect.contains({x, y})) return {0, 0, 0, 0};
  return layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
}

cv::Mat blended(const Sort& sort, const Layer& layer, const cv::Mat& codes, BlendSpace space) {
  cv::Mat out = codes.clone();
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x)
      out.at<cv::Vec3d>(y, x) = blended(sort, color_at(layer, x, y), codes.at<cv::Vec3d>(y, x), space);
  return out;
}

// The sample of a plane that the image at full resolution averages to.
double averaged(const cv::Mat& codes, const Sort& sort, int plane, int x, int y) {
  if (plane == 0) return codes.at<cv::Vec3d>(y, x)[0];
  double sum = 0;
  for (const Share& down : shares_down(sort, y, codes.rows))
    for (const Share& across : shares_across(sort, x, codes.cols))
      sum += down.weight * across.weight * codes.at<cv::Vec3d>(down.pixel, across.pixel)[plane];
  return sum;
}

// margin: outermost samples of each plane that are left out
double largest_error(const Frame& frame, const cv::Mat& codes, const Sort& sort, int margin = 0) {
  double largest = 0;
  for (int plane = 0; plane < 3; ++plane) {
    const cv::Mat& samples = frame.planes[static_cast<std::size_t>(plane)];
    for (int y = margin; y < samples.rows - margin; ++y)
      for (int x = margin; x < samples.cols - margin; ++x)
        largest = std::max(
            largest, std::abs(samples.at<uchar>(y, x) - std::clamp(averaged(codes, sort, plane, x, y), 0.0, 255.0)));
  }
  return largest;
}

// Every pixel a colour and an opacity of its own, a third of them empty.
Layer speckled_layer(const cv::Rect& rect, unsigned seed) {
  cv::RNG random(seed);
  Layer layer = even_layer(rect, {0, 0, 0, 0});
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x) {
      const float opacity = std::max(0.0F, random.uniform(-0.5F, 1.0F));
      cv::Vec4f& color = layer.color.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) color[c] = opacity * random.uniform(0.0F, 1.0F);
      color[3] = opacity;
    }
  return layer;
}

struct Place {
  cv::Size size_px;
  cv::Rect rect;
};
// Within, at each edge, at odd and even first pixels; whole odd and tiny images.
const Place kPlaces[] = {{{38, 24}, {11, 7, 9, 8}},  {{38, 24}, {12, 6, 8, 9}},  {{37, 23}, {0, 0, 6, 5}},
                         {{37, 23}, {30, 17, 7, 6}}, {{38, 24}, {31, 18, 7, 6}}, {{7, 5}, {0, 0, 7, 5}},
                         {{8, 6}, {0, 0, 8, 6}},     {{1, 1}, {0, 0, 1, 1}},     {{2, 3}, {0, 0, 2, 3}},
                         {{38, 24}, {15, 9, 1, 1}},  {{38, 24}, {16, 10, 1, 1}}};

}  // namespace

TEST_CASE("planes are those of the blended full-resolution image averaged at the chroma's site") {
  for (const Sort& sort : sorts_with_subsampled_chroma())
    for (const BlendSpace space : {BlendSpace::linear, BlendSpace::display})
      for (const Place& place : kPlaces) {
        CAPTURE(sort.name);
        CAPTURE(place.size_px);
        CAPTURE(place.rect);
        const bool is_within = place.rect.x > 4 && place.rect.br().x < 30;
        Frame frame = graded(sort, place.size_px, is_within ? 2 : 0, is_within ? 1 : 0);
        const Layer layer = speckled_layer(place.rect, 3);
        const cv::Mat codes = blended(sort, layer, whole_codes(frame, sort), space);
        blend_over(frame, layer, space);
        CHECK(largest_error(frame, codes, sort, is_within ? 1 : 0) < kBlendRounding);
      }
}

TEST_CASE("an opaque layer of many colours leaves nothing of the chroma below") {
  for (const Sort& sort : sorts_with_subsampled_chroma()) {
    CAPTURE(sort.name);
    const cv::Size size(19, 13);
    Frame frame = grainy(sort, size);
    Layer layer = speckled_layer({{0, 0}, size}, 5);
    for (cv::Vec4f& color : cv::Mat_<cv::Vec4f>(layer.color)) color[3] = 1;
    const cv::Mat codes = blended(sort, layer, whole_codes(frame, sort), BlendSpace::linear);
    blend_over(frame, layer, BlendSpace::linear);
    CHECK(largest_error(frame, codes, sort) < kBlendRounding);
  }
}

TEST_CASE("an even opacity keeps the rest of every chroma sample below") {
  constexpr float kOpacity = 0.375F;
  for (const Sort& sort : sorts_with_subsampled_chroma()) {
    CAPTURE(sort.name);
    const cv::Size size(19, 13);
    Frame frame = grainy(sort, size);
    const Frame before = cloned(frame);
    Layer layer = speckled_layer({{0, 0}, size}, 7);
    Layer opaque = speckled_layer({{0, 0}, size}, 7);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        cv::Vec4f& color = opaque.color.at<cv::Vec4f>(y, x);
        color[3] = 1;
        layer.color.at<cv::Vec4f>(y, x) = color * kOpacity;
      }
    const cv::Mat above = blended(sort, opaque, whole_codes(frame, sort), BlendSpace::display);
    blend_over(frame, layer, BlendSpace::display);
    for (int plane = 1; plane < 3; ++plane) {
      const cv::Mat& samples = frame.planes[static_cast<std::size_t>(plane)];
      for (int y = 0; y < samples.rows; ++y)
        for (int x = 0; x < samples.cols; ++x) {
          const double old_code = before.planes[static_cast<std::size_t>(plane)].at<uchar>(y, x);
          const double wanted = kOpacity * averaged(above, sort, plane, x, y) + (1 - kOpacity) * old_code;
          REQUIRE(std::abs(samples.at<uchar>(y, x) - std::clamp(wanted, 0.0, 255.0)) < kBlendRounding);
        }
    }
  }
}

TEST_CASE("the colour of a soft spot lies where its brightness does") {
  for (const Sort& sort : sorts_with_subsampled_chroma())
    for (const cv::Point2d middle : {cv::Point2d(20, 16), cv::Point2d(20.5, 16.5), cv::Point2d(21, 17)}) {
      CAPTURE(sort.name);
      CAPTURE(middle);
      const cv::Size size(42, 34);
      Frame frame = even(sort, size, 60);
      Layer layer = even_layer({{0, 0}, size}, {0, 0, 0, 0});
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const double square = (x - middle.x) * (x - middle.x) + (y - middle.y) * (y - middle.y);
          const auto opacity = static_cast<float>(std::exp(-square / (2 * 3.0 * 3.0)));
          layer.color.at<cv::Vec4f>(y, x) = cv::Vec4f(1, 0.1F, 0, 1) * opacity;
        }
      blend_over(frame, layer, BlendSpace::display);
      const cv::Mat codes = whole_codes(frame, sort);
      const cv::Vec3d ground = codes_of(sort, display_of(sort, codes.at<cv::Vec3d>(0, 0)));
      for (const int plane : {0, 1, 2}) {
        double sum = 0;
        cv::Point2d place(0, 0);
        for (int y = 0; y < size.height; ++y)
          for (int x = 0; x < size.width; ++x) {
            const double change = codes.at<cv::Vec3d>(y, x)[plane] - ground[plane];
            sum += change;
            place += change * cv::Point2d(x, y);
          }
        CAPTURE(plane);
        // Rounding of a thousand samples; without regard to the site it would be half a pixel.
        CHECK(std::abs(place.x / sum - middle.x) < 0.06);
        CHECK(std::abs(place.y / sum - middle.y) < 0.06);
      }
    }
}

TEST_CASE("an image put in place of pixels has its chroma at the footage's site") {
  for (const Sort& sort : sorts_with_subsampled_chroma())
    for (const Place& place : kPlaces) {
      CAPTURE(sort.name);
      CAPTURE(place.rect);
      Frame frame = graded(sort, place.size_px, 0, 0);
      cv::RNG random(9);
      cv::Mat bgr(place.rect.size(), CV_8UC3);
      cv::Mat weight(place.rect.size(), CV_32FC1);
      random.fill(bgr, cv::RNG::UNIFORM, 0, 256);
      random.fill(weight, cv::RNG::UNIFORM, -0.5, 1.0);
      weight = cv::max(weight, 0);
      cv::Mat codes = whole_codes(frame, sort);
      for (int y = 0; y < bgr.rows; ++y)
        for (int x = 0; x < bgr.cols; ++x) {
          cv::Vec3d& code = codes.at<cv::Vec3d>(place.rect.y + y, place.rect.x + x);
          const cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
          const double share = weight.at<float>(y, x);
          code = share * codes_of(sort, {pixel[2] / 255.0, pixel[1] / 255.0, pixel[0] / 255.0}) + (1 - share) * code;
        }
      replace_pixels(frame, place.rect, bgr, weight);
      CHECK(largest_error(frame, codes, sort) < kBlendRounding);
    }
}

TEST_CASE("two layers far from each other give the same planes in either order") {
  for (const Sort& sort : sorts_with_subsampled_chroma()) {
    CAPTURE(sort.name);
    Frame first = grainy(sort, {38, 24});
    Frame second = cloned(first);
    const Layer left = speckled_layer({5, 4, 8, 9}, 1);
    const Layer right = speckled_layer({17, 9, 9, 7}, 2);
    blend_over(first, left, BlendSpace::linear);
    blend_over(first, right, BlendSpace::linear);
    blend_over(second, right, BlendSpace::linear);
    blend_over(second, left, BlendSpace::linear);
    for (std::size_t plane = 0; plane < 3; ++plane) CHECK(same_bytes(first.planes[plane], second.planes[plane]));
  }
}

}  // namespace sigs::test
