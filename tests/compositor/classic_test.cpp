// SPDX-License-Identifier: MIT
#include "compositor/classic.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compositor/synthetic_layers.h"
#include "reference/exact_lens.h"
#include "reference/opencv_lens.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

const cv::Scalar kGreen(0, 255, 0);

struct Stages {
  cv::Mat a, b, c, d, f, output;
};

// Section 3.2 of the paper, line by line, in OpenCV's calls alone; the maps of a lens model that OpenCV lacks are by
// truth::ExactLens.
class Paper {
 public:
  explicit Paper(const Camera& camera)
      : is_fisheye_(camera.lens.parameters().model == LensModel::kannala_brandt),
        size_(camera.size_px),
        coefficients_(camera.lens.parameters().coefficients) {
    const LensParameters& p = camera.lens.parameters();
    matrix_ = {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};
    if (truth::OpencvLens(p).is_opencvs())
      make_inverse_map();
    else
      make_exact_maps(p);
  }

  [[nodiscard]] Stages stages(const cv::Mat& input1, const cv::Mat& input2, double sigma) const {
    Stages s;
    // "Firstly the background image (input 1) is undistorted to obtain image A."
    if (!undistorting_map_.empty())
      cv::remap(input1, s.a, undistorting_map_, cv::Mat(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
    else if (is_fisheye_)
      cv::fisheye::undistortImage(input1, s.a, matrix_, coefficients_, matrix_);
    else
      cv::undistort(input1, s.a, matrix_, coefficients_);
    // "Pixels corresponding to the simulated intruder are segmented and copied into image A to obtain image B."
    cv::Mat backdrop;
    cv::inRange(input2, kGreen, kGreen, backdrop);
    s.b = s.a.clone();
    input2.copyTo(s.b, ~backdrop);
    // "image B is distorted using an inverse mapping procedure ... the result is stored in image C."
    cv::remap(s.b, s.c, map_, cv::Mat(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
    // "This image is then blurred using a gaussian kernel to produce image D."
    s.d = s.c.clone();
    if (sigma > 0) cv::GaussianBlur(s.c, s.d, {0, 0}, sigma);
    // "we perform a similar distortion and blur process on input 2 image, generating image F."
    cv::remap(input2, s.f, map_, cv::Mat(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, kGreen);
    if (sigma > 0) cv::GaussianBlur(s.f.clone(), s.f, {0, 0}, sigma);
    // "Pixels which are pure green have not been modified and therefore are copied directly from input 1 into the
    // final image. Modified pixels ... are copied from image D."
    cv::Mat unmodified;
    cv::inRange(s.f, kGreen, kGreen, unmodified);
    s.output = s.d.clone();
    input1.copyTo(s.output, unmodified);
    return s;
  }

  [[nodiscard]] const cv::Mat& map() const { return map_; }

 private:
  // Where every pixel of the distorted image lies in the undistorted one.
  void make_inverse_map() {
    std::vector<cv::Point2d> pixels;
    for (int v = 0; v < size_.height; ++v)
      for (int u = 0; u < size_.width; ++u) pixels.emplace_back(u, v);
    std::vector<cv::Point2d> undistorted;
    const cv::TermCriteria tight(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 200, 1e-13);
    if (is_fisheye_)
      cv::fisheye::undistortPoints(pixels, undistorted, matrix_, coefficients_, cv::Matx33d::eye(), matrix_, tight);
    else
      cv::undistortPoints(pixels, undistorted, matrix_, coefficients_, cv::noArray(), matrix_, tight);
    cv::Mat(undistorted).reshape(2, size_.height).convertTo(map_, CV_32FC2);
  }

  // Through a pinhole that shows the middle of the image at the lens' own scale.
  void make_exact_maps(const LensParameters& p) {
    const truth::ExactLens<double> exact(p);
    constexpr double kStep = 1e-6;
    const double scale = (exact.pixel({1, kStep, 0})->x - exact.pixel({1, -kStep, 0})->x) / (2 * kStep) / p.fx;
    const glm::dvec2 focal_px = scale * glm::dvec2(p.fx, p.fy);
    const glm::dvec2 center_px(p.cx, p.cy);
    undistorting_map_.create(size_, CV_32FC2);
    map_.create(size_, CV_32FC2);
    for (int v = 0; v < size_.height; ++v)
      for (int u = 0; u < size_.width; ++u) {
        const glm::dvec2 at(u, v);
        const glm::dvec2 flat = (at - center_px) / focal_px;
        const auto distorted = exact.pixel({1, flat.x, flat.y});
        const auto ray = exact.ray(at);
        REQUIRE(distorted);
        REQUIRE(ray);
        const glm::vec2 source(*distorted);
        const glm::vec2 place(glm::dvec2(ray->y, ray->z) / ray->x * focal_px + center_px);
        undistorting_map_.at<cv::Vec2f>(v, u) = {source.x, source.y};
        map_.at<cv::Vec2f>(v, u) = {place.x, place.y};
      }
  }

  bool is_fisheye_;
  cv::Size size_;
  std::vector<double> coefficients_;
  cv::Matx33d matrix_;
  cv::Mat undistorting_map_;  // empty: OpenCV has functions for the lens
  cv::Mat map_;
};

// Noise that is soft enough for bilinear reading to be smooth from one 1/32 pixel to the next, over gradients.
cv::Mat textured(cv::Size size) {
  cv::RNG random(5);
  cv::Mat noise(size, CV_8UC3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {0, 0}, 1.5);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      noise.at<cv::Vec3b>(y, x) =
          noise.at<cv::Vec3b>(y, x) * 0.4 + cv::Vec3b(cv::saturate_cast<uchar>(140.0 * x / size.width),
                                                      cv::saturate_cast<uchar>(140.0 * y / size.height), 60);
  return noise;
}

// Intruders before pure green: hard edges, a hole, one that touches the image's border, one pixel alone.
cv::Mat green_screen(cv::Size size) {
  cv::Mat image(size, CV_8UC3, kGreen);
  const int w = size.width;
  const int h = size.height;
  cv::ellipse(image, {w * 2 / 5, h * 9 / 20}, {w / 7, h / 17}, 20, 0, 360, {210, 190, 200}, cv::FILLED);
  cv::rectangle(image, {w * 2 / 5, h * 2 / 5, 9, 7}, kGreen, cv::FILLED);
  cv::rectangle(image, {w - 20, h / 4, 20, 30}, {20, 30, 220}, cv::FILLED);
  cv::circle(image, {w / 5, h * 4 / 5}, 11, {5, 5, 5}, cv::FILLED);
  image.at<cv::Vec3b>(h / 5, w / 5) = {255, 255, 255};
  return image;
}

struct Difference {
  double maximum = 0;
  int samples = 0;  // that differ at all
};

Difference between(const cv::Mat& a, const cv::Mat& b) {
  REQUIRE(a.size() == b.size());
  REQUIRE(a.type() == b.type());
  cv::Mat apart;
  cv::absdiff(a, b, apart);
  return {cv::norm(apart, cv::NORM_INF), cv::countNonZero(apart.reshape(1))};
}

void check_stage(const char* name, const cv::Mat& ours, const cv::Mat& papers, Difference& worst) {
  CAPTURE(name);
  const Difference d = between(ours, papers);
  CHECK(d.maximum <= 1);
  worst = {std::max(worst.maximum, d.maximum), worst.samples + d.samples};
}

Difference check_stages(const NamedCamera& named, const cv::Mat& input1, const cv::Mat& input2, double sigma_px) {
  const Paper paper(named.camera);
  const Stages wanted = paper.stages(input1, input2, sigma_px);
  const ClassicStages stages = classic_stages(input1, input2, distort_maps(named.camera), sigma_px);
  Difference worst;
  check_stage("a", stages.a, wanted.a, worst);
  check_stage("b", stages.b, wanted.b, worst);
  check_stage("c", stages.c, wanted.c, worst);
  check_stage("d", stages.d, wanted.d, worst);
  check_stage("f", stages.f, wanted.f, worst);
  check_stage("output", stages.output, wanted.output, worst);
  CHECK(same_bytes(stages.input1, input1));
  CHECK(same_bytes(stages.input2, input2));
  return worst;
}

}  // namespace

TEST_CASE("the classic stages are those of the paper's section 3.2 done with OpenCV alone") {
  const cv::Size size(400, 300);
  for (const NamedCamera& named : distorting_cameras(size))
    for (const double sigma_px : {0.0, 0.6, 2.0}) {
      CAPTURE(named.name);
      CAPTURE(sigma_px);
      const Difference worst = check_stages(named, textured(size), green_screen(size), sigma_px);
      MESSAGE(named.name << ", sigma " << sigma_px << ": " << worst.samples << " of " << 6 * size.area() * 3
                         << " samples differ at all, by at most " << worst.maximum);
    }
}

TEST_CASE("the classic stages are those of the paper on a real image too") {
  if (!has_real_data()) return;
  const cv::Mat whole = cv::imread((real_data() / "stills/skylink/skylink_0.jpeg").string());
  REQUIRE(!whole.empty());
  for (const NamedCamera& named : distorting_cameras(whole.size())) {
    CAPTURE(named.name);
    if (named.name == "omnidirectional") continue;  // ExactLens takes too long for so many pixels
    const Difference worst = check_stages(named, whole, green_screen(whole.size()), 1.2);
    MESSAGE(named.name << ": " << worst.samples << " of " << 6 * whole.total() * 3
                       << " samples differ at all, by at most " << worst.maximum);
  }
}

TEST_CASE("the way back through the lens is the one that OpenCV finds") {
  const cv::Size size(400, 300);
  for (const NamedCamera& named : distorting_cameras(size)) {
    CAPTURE(named.name);
    const Paper paper(named.camera);
    const DistortMaps maps = distort_maps(named.camera);
    cv::Mat both;
    cv::merge(std::vector<cv::Mat>{maps.x, maps.y}, both);
    CHECK(cv::norm(both, paper.map(), cv::NORM_INF) < 1e-4);  // floats of some hundred pixels: steps of 3e-5
  }
}

TEST_CASE("a part of a warped and blurred image is cut from the whole one") {
  const cv::Size size(400, 300);
  const cv::Mat image = green_screen(size);
  for (const NamedCamera& named : distorting_cameras(size)) {
    const DistortMaps maps = distort_maps(named.camera);
    const cv::Mat warped = distorted(image, maps, kGreen);
    for (const double sigma_px : {0.0, 0.3, 0.6, 2.0, 7.7, 16.0, 16.1, 90.0})
      for (const cv::Rect& part : {cv::Rect(150, 120, 60, 31), cv::Rect(0, 0, 9, 5), cv::Rect(390, 200, 10, 100),
                                   cv::Rect(0, 0, 400, 300), cv::Rect(200, 150, 1, 1)}) {
        CAPTURE(named.name);
        CAPTURE(sigma_px);
        const cv::Rect from = gaussian_blur_source(part, sigma_px, size);
        REQUIRE((from & part) == part);
        const cv::Mat soft = gaussian_blurred(distorted(image, maps, kGreen, from), sigma_px);
        CHECK(same_bytes(soft(part - from.tl()), gaussian_blurred(warped, sigma_px)(part)));
      }
  }
}

TEST_CASE("stages written over those of another frame are those written to fresh memory") {
  const cv::Size size(200, 150);
  const NamedCamera named = distorting_cameras(size).front();
  const DistortMaps maps = distort_maps(named.camera);
  ClassicStages used;
  int n = 0;
  for (const double sigma_px : {0.0, 2.0, -1.0, 0.6, 0.0, 0.0, -1.0, 20.0, 0.0, 1.0}) {  // -1: plain
    CAPTURE(n);
    const cv::Mat input1 = textured(size) * (0.5 + 0.05 * n);
    const cv::Mat input2 = green_screen(size) * (n % 2 == 0 ? 1.0 : 0.9);
    const bool is_plain = sigma_px < 0;
    const ClassicStages fresh =
        is_plain ? plain_stages(input1, input2) : classic_stages(input1, input2, maps, sigma_px);
    used = is_plain ? plain_stages(input1, input2, std::move(used))
                    : classic_stages(input1, input2, maps, sigma_px, std::move(used));
    const std::pair<const cv::Mat*, const cv::Mat*> all[] = {
        {&used.a, &fresh.a},    {&used.b, &fresh.b}, {&used.c, &fresh.c},           {&used.d, &fresh.d},
        {&used.e, &fresh.e},    {&used.f, &fresh.f}, {&used.output, &fresh.output}, {&used.changed, &fresh.changed},
        {&used.key, &fresh.key}};
    for (const auto& [over, anew] : all) CHECK(same_bytes(*over, *anew));
    ++n;
  }
}

TEST_CASE("green comes out of the key as input 1 bit for bit") {
  const cv::Size size(400, 300);
  const cv::Mat input1 = textured(size);
  for (const NamedCamera& named : distorting_cameras(size)) {
    CAPTURE(named.name);
    const cv::Mat nothing(size, CV_8UC3, kGreen);
    const ClassicStages stages = classic_stages(input1, nothing, distort_maps(named.camera), 2.5);
    CHECK(same_bytes(stages.output, input1));
    CHECK(cv::countNonZero(stages.changed) == 0);
  }
}

TEST_CASE("the plain method composites without lens and blur") {
  const cv::Size size(200, 150);
  const cv::Mat input1 = textured(size);
  const cv::Mat input2 = green_screen(size);
  const ClassicStages stages = plain_stages(input1, input2);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const cv::Vec3b key = input2.at<cv::Vec3b>(y, x);
      const bool is_green = key == cv::Vec3b(0, 255, 0);
      REQUIRE(stages.output.at<cv::Vec3b>(y, x) == (is_green ? input1.at<cv::Vec3b>(y, x) : key));
      REQUIRE(stages.changed.at<uchar>(y, x) == (is_green ? 0 : 255));
    }
}

TEST_CASE("an intruder before green has its own colour and no green in its edge") {
  Layer layer = even_layer({3, 2, 4, 1}, {0, 0, 0, 0});
  layer.color.at<cv::Vec4f>(0, 0) = cv::Vec4f(0.5F, 0.25F, 0.125F, 1) * 0.5F;  // half covered: its own colour
  layer.coverage.at<float>(0, 0) = 0.5F;
  layer.color.at<cv::Vec4f>(0, 1) = cv::Vec4f(0.5F, 0.25F, 0.125F, 1) * 0.499F;  // less than half: green
  layer.coverage.at<float>(0, 1) = 0.499F;
  layer.color.at<cv::Vec4f>(0, 2) = {0, 1, 0, 1};  // pure green itself: changed by one code
  layer.color.at<cv::Vec4f>(0, 3) = {2, 1, 0, 1};  // brighter than white: clipped
  const cv::Mat image = on_green_screen(layer, {}, {10, 5});
  const auto code = [](double linear) {
    const double display = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<uchar>(std::lround(255 * display));
  };
  CHECK(image.at<cv::Vec3b>(2, 3) == cv::Vec3b(code(0.125), code(0.25), code(0.5)));
  CHECK(image.at<cv::Vec3b>(2, 4) == cv::Vec3b(0, 255, 0));
  CHECK(image.at<cv::Vec3b>(2, 5) == cv::Vec3b(0, 254, 0));
  CHECK(image.at<cv::Vec3b>(2, 6) == cv::Vec3b(0, 255, 255));
  CHECK(image.at<cv::Vec3b>(0, 0) == cv::Vec3b(0, 255, 0));
}

TEST_CASE("an intruder before green may lie across the image's edge or be empty") {
  const cv::Mat cut = on_green_screen(even_layer({-3, -2, 5, 4}, {1, 0, 0, 1}), {}, {10, 5});
  CHECK(cut.at<cv::Vec3b>(0, 0) == cv::Vec3b(0, 0, 255));
  CHECK(cut.at<cv::Vec3b>(1, 1) == cv::Vec3b(0, 0, 255));
  CHECK(cut.at<cv::Vec3b>(2, 2) == cv::Vec3b(0, 255, 0));
  const cv::Mat empty = on_green_screen(Layer{}, {}, {10, 5});
  CHECK(cv::norm(empty, cv::Mat(5, 10, CV_8UC3, kGreen), cv::NORM_INF) == 0);
}

}  // namespace sigs::test
