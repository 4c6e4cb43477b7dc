// SPDX-License-Identifier: MIT
#include "compositor/classic.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "base/ensure.h"
#include "base/pose.h"
#include "base/transfer.h"
#include "compositor/blur.h"
#include "compositor/resample.h"

namespace sigs {

namespace {

const cv::Scalar kGreenBorder(0, 255, 0);

uchar code_of_linear(float linear) {
  return cv::saturate_cast<uchar>(255.0F * display_of_linear(std::clamp(linear, 0.0F, 1.0F)));
}

// An intruder that is pure green itself gives way by one code value, so that the key stays the backdrop's alone.
cv::Vec3b keyed_color(const cv::Vec4f& premultiplied) {
  const float opacity = std::max(premultiplied[3], 1e-6F);
  const cv::Vec3b bgr(code_of_linear(premultiplied[2] / opacity), code_of_linear(premultiplied[1] / opacity),
                      code_of_linear(premultiplied[0] / opacity));
  return bgr == kKeyGreen ? cv::Vec3b(0, 254, 0) : bgr;
}

cv::Mat is_not_green(const cv::Mat& bgr) {
  cv::Mat green;
  cv::inRange(bgr, kGreenBorder, kGreenBorder, green);
  return ~green;
}

cv::Matx33d matrix_of(const LensParameters& lens) {
  return {lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1};
}

// Stage A, equations (3) and (4), with the camera matrix kept.
cv::Mat undistorted(const cv::Mat& picture, const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  const cv::Matx33d matrix = matrix_of(lens);
  cv::Mat out;
  if (lens.model == LensModel::kannala_brandt)
    cv::fisheye::undistortImage(picture, out, matrix, lens.coefficients, matrix);
  else
    cv::undistort(picture, out, matrix, lens.coefficients);
  return out;
}

cv::Mat pasted(const cv::Mat& below, const cv::Mat& above, const cv::Mat& where) {
  cv::Mat out = below.clone();
  above.copyTo(out, where);
  return out;
}

// Blurs along one axis, at places a quarter of sigma apart, and back to pixels.
struct AxisBlur {
  AxisBlur(int size_px, double wanted_sigma_px) {
    // A mirrored picture repeats after twice its size: by then a wider kernel sees nothing but its mean.
    const double sigma_px = std::min(wanted_sigma_px, 2.0 * size_px);
    const double step_px = std::max(1.0, sigma_px / 4);
    const Lattice places = lattice_for(0, size_px, step_px);
    const double kernel_px = std::sqrt(std::max(sigma_px * sigma_px - splined_variance(step_px), 0.25));
    to_places = mirrored_gaussian_taps(places, size_px, kernel_px, std::round(3 * sigma_px) + 0.5);
    to_pixels = spline_taps(0, size_px, places);
  }
  std::vector<Taps> to_places;
  std::vector<Taps> to_pixels;
};

cv::Mat widely_softened(const cv::Mat& picture, double sigma_px) {
  const AxisBlur down(picture.rows, sigma_px);
  const AxisBlur across(picture.cols, sigma_px);
  cv::Mat codes;
  picture.convertTo(codes, CV_32F);
  codes = resampled(codes, down.to_places, across.to_places);
  codes = resampled(codes, down.to_pixels, across.to_pixels);
  codes.convertTo(codes, CV_8U);
  return codes;
}

}  // namespace

cv::Mat on_green_screen(const Layer& layer, cv::Size picture_size_px) {
  cv::Mat picture(picture_size_px, CV_8UC3, kGreenBorder);
  const cv::Rect inside = layer.rect & cv::Rect({0, 0}, picture_size_px);
  for (int y = inside.y; y < inside.y + inside.height; ++y)
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      if (layer.coverage.at<float>(y - layer.rect.y, x - layer.rect.x) < 0.5F) continue;
      picture.at<cv::Vec3b>(y, x) = keyed_color(layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x));
    }
  return picture;
}

DistortMaps distort_maps(const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  DistortMaps maps{cv::Mat(camera.size_px, CV_32FC1, cv::Scalar(-1)),
                   cv::Mat(camera.size_px, CV_32FC1, cv::Scalar(-1))};
  for (int v = 0; v < camera.size_px.height; ++v)
    for (int u = 0; u < camera.size_px.width; ++u) {
      const std::optional<glm::dvec3> ray = camera.lens.ray({u, v});
      if (!ray || ray->x <= 1e-6) continue;  // at 90 degrees and beyond a pinhole picture has no place for it
      const glm::dvec3 optical = optical_of(*ray);
      maps.x.at<float>(v, u) = static_cast<float>(lens.fx * optical.x / optical.z + lens.cx);
      maps.y.at<float>(v, u) = static_cast<float>(lens.fy * optical.y / optical.z + lens.cy);
    }
  return maps;
}

cv::Mat distorted(const cv::Mat& picture, const DistortMaps& maps, const cv::Scalar& border) {
  cv::Mat out;
  cv::remap(picture, out, maps.x, maps.y, cv::INTER_LINEAR, cv::BORDER_CONSTANT, border);
  return out;
}

cv::Mat softened(const cv::Mat& picture, double sigma_px) {
  ENSURE(sigma_px >= 0 && std::isfinite(sigma_px));
  if (sigma_px == 0) return picture;
  if (sigma_px > kSigmaOfCells_px) return widely_softened(picture, sigma_px);
  cv::Mat out;
  cv::GaussianBlur(picture, out, {0, 0}, sigma_px);
  return out;
}

ClassicStages classic_stages(const cv::Mat& input1, const cv::Mat& input2, const Camera& camera,
                             const DistortMaps& maps, double sigma_px) {
  ENSURE(input1.type() == CV_8UC3 && input2.type() == CV_8UC3 && input1.size() == input2.size());
  ClassicStages stages{.input1 = input1, .input2 = input2};
  stages.a = undistorted(input1, camera);
  stages.b = pasted(stages.a, input2, is_not_green(input2));
  stages.c = distorted(stages.b, maps, cv::Scalar::all(0));
  stages.d = softened(stages.c, sigma_px);
  stages.f = softened(distorted(input2, maps, kGreenBorder), sigma_px);
  stages.changed = is_not_green(stages.f);
  stages.output = pasted(input1, stages.d, stages.changed);
  return stages;
}

ClassicStages plain_stages(const cv::Mat& input1, const cv::Mat& input2) {
  ClassicStages stages{.input1 = input1, .input2 = input2};
  stages.changed = is_not_green(input2);
  stages.output = pasted(input1, input2, stages.changed);
  return stages;
}

}  // namespace sigs
