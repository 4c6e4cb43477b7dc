// SPDX-License-Identifier: MIT
#include "compositor/classic.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "base/pose.h"
#include "compositor/blur.h"
#include "compositor/resample.h"
#include "video/color_space.h"

namespace sigs {

namespace {

const cv::Scalar kGreenBorder(0, 255, 0);

// An intruder that is pure green itself is changed by one code value, so that the key colour occurs in the backdrop
// alone.
cv::Vec3b keyed_color(const cv::Vec4f& premultiplied, const TransferCurve& curve) {
  const float opacity = std::max(premultiplied[3], 1e-6F);
  cv::Vec3b bgr;
  for (int c = 0; c < 3; ++c)
    bgr[2 - c] = cv::saturate_cast<uchar>(255.0F * curve.display_of_linear(std::max(premultiplied[c] / opacity, 0.0F)));
  return bgr == kKeyGreen ? cv::Vec3b(0, 254, 0) : bgr;
}

cv::Mat is_not_green(const cv::Mat& bgr, cv::Mat buffer) {
  cv::inRange(bgr, kGreenBorder, kGreenBorder, buffer);
  cv::bitwise_not(buffer, buffer);
  return buffer;
}

cv::Matx33d matrix_of(const LensParameters& lens) {
  return {lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1};
}

// Stage A, equations (3) and (4), with the camera matrix kept.
FixedMap undistorting_map(const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  const LensParameters pinhole = camera.lens.pinhole().parameters();
  const cv::Matx33d matrix = matrix_of(lens);
  FixedMap map;
  if (lens.model == LensModel::brown_conrady) {
    cv::initUndistortRectifyMap(matrix, lens.coefficients, cv::noArray(), matrix, camera.size_px, CV_16SC2, map.pixels,
                                map.shares);
  } else if (lens.model == LensModel::kannala_brandt) {
    cv::fisheye::initUndistortRectifyMap(matrix, lens.coefficients, cv::Matx33d::eye(), matrix, camera.size_px,
                                         CV_16SC2, map.pixels, map.shares);
  } else {  // OpenCV has no function for it
    cv::Mat_<cv::Vec2f> sources(camera.size_px, cv::Vec2f::all(-2));
    for (int v = 0; v < sources.rows; ++v)
      for (int u = 0; u < sources.cols; ++u)
        if (const auto source = camera.lens.pixel({1, (u - lens.cx) / pinhole.fx, (v - lens.cy) / pinhole.fy}))
          sources(v, u) = cv::Vec2f(glm::vec2(*source).x, glm::vec2(*source).y);
    cv::convertMaps(sources, cv::noArray(), map.pixels, map.shares, CV_16SC2);
  }
  return map;
}

void find_origins(const Camera& camera, int v, DistortMaps& maps) {
  const LensParameters lens = camera.lens.pinhole().parameters();
  for (int u = 0; u < camera.size_px.width; ++u) {
    const std::optional<glm::dvec3> ray = camera.lens.ray({u, v});
    if (!ray || ray->x <= 1e-6) continue;  // a pinhole has no image at 90 degrees and beyond
    const glm::dvec3 optical = optical_of(*ray);
    maps.x.at<float>(v, u) = static_cast<float>(lens.fx * optical.x / optical.z + lens.cx);
    maps.y.at<float>(v, u) = static_cast<float>(lens.fy * optical.y / optical.z + lens.cy);
  }
}

cv::Mat moved(const cv::Mat& image, const FixedMap& map, const cv::Scalar& border, cv::Mat buffer = {}) {
  cv::remap(image, buffer, map.pixels, map.shares, cv::INTER_LINEAR, cv::BORDER_CONSTANT, border);
  return buffer;
}

cv::Mat pasted(const cv::Mat& below, const cv::Mat& above, const cv::Mat& where, cv::Mat buffer) {
  below.copyTo(buffer);
  above.copyTo(buffer, where);
  return buffer;
}

// Where a stage changes nothing, its image is the one before: no buffer of its own.
ClassicStages apart(ClassicStages buffers) {
  if (buffers.d.data == buffers.c.data) buffers.d.release();
  if (buffers.f.data == buffers.e.data) buffers.f.release();
  if (buffers.changed.data == buffers.key.data) buffers.changed.release();
  return buffers;
}

// Blurs along one axis, at positions a quarter of sigma apart, and back to pixels.
struct AxisBlur {
  AxisBlur(int size_px, double wanted_sigma_px) {
    // A mirrored image repeats after twice its size: a wider kernel gives its mean.
    const double sigma_px = std::min(wanted_sigma_px, 2.0 * size_px);
    const double step_px = std::max(1.0, sigma_px / 4);
    const UniformGrid places = uniform_grid_for(0, size_px, step_px);
    const double kernel_px = std::sqrt(std::max(sigma_px * sigma_px - splined_variance(step_px), 0.25));
    to_places = mirrored_gaussian_taps(places, size_px, kernel_px, std::round(3 * sigma_px) + 0.5);
    to_pixels = spline_taps(0, size_px, places);
  }
  std::vector<Taps> to_places;
  std::vector<Taps> to_pixels;
};

cv::Mat coarse_gaussian_blurred(const cv::Mat& image, double sigma_px) {
  const AxisBlur down(image.rows, sigma_px);
  const AxisBlur across(image.cols, sigma_px);
  cv::Mat codes;
  image.convertTo(codes, CV_32F);
  codes = resampled(codes, down.to_places, across.to_places);
  codes = resampled(codes, down.to_pixels, across.to_pixels);
  codes.convertTo(codes, CV_8U);
  return codes;
}

}  // namespace

cv::Mat on_green_screen(const Layer& layer, const ColorInfo& color, cv::Size image_size_px, cv::Mat buffer) {
  const cv::Mat layer_color = in_footage_primaries(layer.color, color);
  const TransferCurve curve = transfer_curve_of(color);
  buffer.create(image_size_px, CV_8UC3);
  buffer.setTo(kGreenBorder);
  const cv::Rect inside = layer.rect & cv::Rect({0, 0}, image_size_px);
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      if (layer.coverage.at<float>(y - layer.rect.y, x - layer.rect.x) < 0.5F) continue;
      buffer.at<cv::Vec3b>(y, x) = keyed_color(layer_color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x), curve);
    }
  return buffer;
}

DistortMaps distort_maps(const Camera& camera) {
  DistortMaps maps{.x = cv::Mat(camera.size_px, CV_32FC1, cv::Scalar(-1)),
                   .y = cv::Mat(camera.size_px, CV_32FC1, cv::Scalar(-1)),
                   .undistorting = undistorting_map(camera)};
  cv::parallel_for_({0, camera.size_px.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) find_origins(camera, v, maps);
  });
  cv::convertMaps(maps.x, maps.y, maps.distorting.pixels, maps.distorting.shares, CV_16SC2);
  return maps;
}

cv::Mat distorted(const cv::Mat& image, const DistortMaps& maps, const cv::Scalar& border) {
  return moved(image, maps.distorting, border);
}

cv::Mat distorted(const cv::Mat& image, const DistortMaps& maps, const cv::Scalar& border, const cv::Rect& part) {
  return moved(image, {maps.distorting.pixels(part), maps.distorting.shares(part)}, border);
}

cv::Mat gaussian_blurred(const cv::Mat& image, double sigma_px, cv::Mat buffer) {
  ENSURE(sigma_px >= 0 && std::isfinite(sigma_px));
  if (sigma_px == 0) return image;
  if (sigma_px > kWideSigma_px) return coarse_gaussian_blurred(image, sigma_px);
  cv::GaussianBlur(image, buffer, {0, 0}, sigma_px);
  return buffer;
}

cv::Rect gaussian_blur_source(const cv::Rect& part, double sigma_px, cv::Size image_size_px) {
  const cv::Rect whole({0, 0}, image_size_px);
  if (sigma_px == 0) return part;
  if (sigma_px > kWideSigma_px) return whole;
  const int radius_px = static_cast<int>(std::ceil(3 * sigma_px)) + 1;  // of OpenCV's kernel for 8 bits
  return cv::Rect(part.x - radius_px, part.y - radius_px, part.width + 2 * radius_px, part.height + 2 * radius_px) &
         whole;
}

ClassicStages classic_stages(const cv::Mat& input1, const cv::Mat& input2, const DistortMaps& maps, double sigma_px,
                             ClassicStages buffers) {
  ENSURE(input1.type() == CV_8UC3 && input2.type() == CV_8UC3 && input1.size() == input2.size());
  buffers = apart(std::move(buffers));
  ClassicStages stages{.input1 = input1, .input2 = input2};
  stages.key = is_not_green(input2, buffers.key);
  stages.a = moved(input1, maps.undistorting, cv::Scalar::all(0), buffers.a);
  stages.b = pasted(stages.a, input2, stages.key, buffers.b);
  stages.c = moved(stages.b, maps.distorting, cv::Scalar::all(0), buffers.c);
  stages.d = gaussian_blurred(stages.c, sigma_px, buffers.d);
  stages.e = moved(input2, maps.distorting, kGreenBorder, buffers.e);
  stages.f = gaussian_blurred(stages.e, sigma_px, buffers.f);
  stages.changed = is_not_green(stages.f, buffers.changed);
  stages.output = pasted(input1, stages.d, stages.changed, buffers.output);
  return stages;
}

ClassicStages plain_stages(const cv::Mat& input1, const cv::Mat& input2, ClassicStages buffers) {
  ClassicStages stages{.input1 = input1, .input2 = input2};
  stages.key = is_not_green(input2, buffers.key);
  stages.changed = stages.key;
  stages.output = pasted(input1, input2, stages.changed, buffers.output);
  return stages;
}

}  // namespace sigs
