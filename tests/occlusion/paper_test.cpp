// SPDX-License-Identifier: MIT
#include "occlusion/paper.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "flights/flights.h"
#include "occlusion/detect.h"
#include "occlusion/synthetic_masks.h"

namespace sigs::test {

namespace {

const cv::Size kSize_px(320, 240);

// The paper's assumptions, exactly: before a calm world of smooth, low contrast a dark body shakes
// by a pixel to either side.
std::vector<cv::Mat> shaking(const cv::Mat& body, int frames) {
  const cv::Mat world = hills({kSize_px.width + frames, kSize_px.height}, 20, 1) / 16 + 180;
  const std::array<cv::Point, 4> kShake = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<cv::Mat> out;
  for (int n = 0; n < frames; ++n) {
    const cv::Point shift = kShake[static_cast<std::size_t>(n) % kShake.size()];
    const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, shift.x, 0, 1, shift.y);
    cv::Mat moved;
    cv::warpAffine(body, moved, move, body.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
    out.push_back(world(cv::Rect({n, 0}, kSize_px)).clone());
    out.back().setTo(50, moved);
  }
  return out;
}

Verdict verdict_on(const std::vector<cv::Mat>& frames, KeepStages keep = KeepStages::no,
                   const PaperOwnBodySettings& settings = {}) {
  const auto method = paper_method(settings, frames.front().size());
  for (const cv::Mat& frame : frames) method->add(frame);
  return method->verdict(keep);
}

cv::Mat with_shape(std::vector<cv::Point> corners) {
  cv::Mat out = cv::Mat::zeros(kSize_px, CV_8UC1);
  cv::fillPoly(out, std::vector<std::vector<cv::Point>>{std::move(corners)}, cv::Scalar(255));
  return out;
}

const cv::Mat& nose() {
  static const cv::Mat kNose = with_shape({{60, 239}, {120, 150}, {160, 130}, {200, 150}, {260, 239}});
  return kNose;
}

bool covers(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(b & ~a) == 0;
}

bool all_are(const cv::Mat& confidence, float value) {
  return cv::countNonZero(confidence != value) == 0;
}

const std::vector<std::string> kStages = {"difference_sum", "canny",  "dilated", "rough",  "sobel",
                                          "closed",         "padded", "filled",  "refined"};

}  // namespace

TEST_CASE("a shaking body in front of a calm world is found, wherever it enters the image below the top") {
  const std::vector<cv::Mat> bodies = {
      nose(),
      with_shape({{0, 110}, {90, 140}, {90, 170}, {0, 180}}),        // a wing from the left
      with_shape({{319, 110}, {230, 140}, {230, 170}, {319, 180}}),  // and from the right
      with_shape({{0, 180}, {319, 150}, {319, 239}, {0, 239}}),      // across the whole bottom
      with_shape({{100, 80}, {220, 80}, {220, 160}, {100, 160}}),    // touching nothing
      with_shape({{0, 150}, {80, 239}, {0, 239}}) | with_shape({{319, 150}, {240, 239}, {319, 239}}),
  };
  for (const cv::Mat& body : bodies) {
    const Verdict verdict = verdict_on(shaking(body, 24));
    CHECK_FALSE(verdict.undecided);
    CHECK(covers(verdict.own_body, body));
    // One pixel by shaking, one by Canny's ridge beside it, half of the dilation's three, one by Sobel, one by closing.
    CHECK(covers(dilated(body, 2 * 6), verdict.own_body));
  }
}

TEST_CASE("a contour open towards the top is not closed: only its outline is left, and dropped") {
  const cv::Mat hanging = with_shape({{140, 0}, {150, 60}, {170, 60}, {180, 0}});
  CHECK(cv::countNonZero(verdict_on(shaking(hanging, 24)).own_body & hanging) < 0.5 * cv::countNonZero(hanging));
}

TEST_CASE("a brightness change all over an even image has no edges and gives no body") {
  std::vector<cv::Mat> even;
  for (int n = 0; n < 5; ++n) even.emplace_back(kSize_px, CV_8UC1, cv::Scalar(100 + n));
  const Verdict verdict = verdict_on(even);
  CHECK_FALSE(verdict.undecided);
  CHECK(cv::countNonZero(verdict.own_body) == 0);
  CHECK(all_are(verdict.confidence, 0));
}

TEST_CASE("the bodies of synthetic flights that shake are found") {
  for (const std::string name : {"nose", "tail boom"}) {
    CAPTURE(name);
    // Until the outline is brighter all along than the world's differences, it has gaps. At 40 frames the nose has one.
    constexpr int kFrames = 150;
    const flights::Flight flight = flights::by_name(name, {.size_px = {640, 480}, .frames = kFrames});
    const auto method = paper_method({}, flight.size_px);
    cv::Mat luma;
    for (int n = 0; n < kFrames; ++n) {
      cv::cvtColor(flight.bgr(n), luma, cv::COLOR_BGR2GRAY);
      method->add(luma);
    }
    // Not worse than the truth grown by two pixels of shaking and the others as above.
    CHECK(intersection_over_union(method->verdict(KeepStages::no).own_body, flight.own_body) >
          intersection_over_union(dilated(flight.own_body, 2 * 7), flight.own_body));
  }
}

TEST_CASE("each stage follows from the one before") {
  const Verdict verdict = verdict_on(shaking(nose(), 12), KeepStages::yes);
  REQUIRE(verdict.stages.size() == kStages.size());
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    CHECK(verdict.stages[i].name == kStages[i]);
    CHECK_FALSE(verdict.stages[i].title.empty());
    CHECK(verdict.stages[i].image.size() == kSize_px);
    CHECK(verdict.stages[i].image.type() == CV_8UC1);
  }
  const auto image = [&](int i) -> const cv::Mat& { return verdict.stages[static_cast<std::size_t>(i)].image; };
  CHECK(same_bytes(image(1), canny_edges(image(0), canny_thresholds(image(0), {}))));
  CHECK(same_bytes(image(2), dilated(image(1), dilation_px({}, kSize_px))));
  CHECK(same_bytes(image(3), contours_filled(image(2))));
  CHECK(same_bytes(image(4), sobel_edges(image(3))));
  CHECK(same_bytes(image(5), closed(image(4), closing_px({}, kSize_px))));
  CHECK(same_bytes(image(7), unpadded(contours_filled(padded(image(5))))));
  CHECK(same_bytes(image(8), without_small(image(7), 0.5)));
  CHECK(same_bytes(image(8), verdict.own_body));
  // The padding lies outside the image; its stage shows it on the rim.
  CHECK(covers(image(6), image(5)));
  CHECK(cv::countNonZero(image(6).row(kSize_px.height - 1) == 0) == 0);
  CHECK(same_bytes(image(6)(cv::Rect(1, 0, 318, 239)), image(5)(cv::Rect(1, 0, 318, 239))));
}

TEST_CASE("the sum is of the differences of successive frames, each scaled to a maximum of one") {
  const std::vector<cv::Mat> frames = shaking(nose(), 9);
  std::vector<double> sum(frames.front().total(), 0);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    std::vector<int> differences;
    for (int y = 0; y < kSize_px.height; ++y)
      for (int x = 0; x < kSize_px.width; ++x)
        differences.push_back(std::abs(frames[n].at<uchar>(y, x) - frames[n - 1].at<uchar>(y, x)));
    const double largest = *std::max_element(differences.begin(), differences.end());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += differences[i] / largest;
  }
  const auto [minimum, maximum] = std::minmax_element(sum.begin(), sum.end());
  const cv::Mat stage = verdict_on(frames, KeepStages::yes).stages.front().image;
  for (std::size_t i = 0; i < sum.size(); ++i)  // rounding to 8 bits
    REQUIRE(std::abs(stage.data[i] - (sum[i] - *minimum) / (*maximum - *minimum) * 255) <= 0.5 + 1e-3);
}

TEST_CASE("a footage of half the contrast gives the same mask") {
  std::vector<cv::Mat> frames = shaking(nose(), 12);
  for (cv::Mat& frame : frames) frame &= 0xFE;
  const Verdict full = verdict_on(frames);
  for (cv::Mat& frame : frames) frame /= 2;
  CHECK(cv::countNonZero(full.own_body) > 0);
  CHECK(same_bytes(verdict_on(frames).own_body, full.own_body));
}

TEST_CASE("frames may be overwritten after they are added, and intermediate verdicts change nothing") {
  const std::vector<cv::Mat> frames = shaking(nose(), 10);
  const auto method = paper_method({}, kSize_px);
  cv::Mat buffer(kSize_px, CV_8UC1);
  for (const cv::Mat& frame : frames) {
    frame.copyTo(buffer);
    method->add(buffer);
    buffer.setTo(7);
    CHECK(method->verdict(KeepStages::no).stages.empty());
  }
  const Verdict once = verdict_on(frames);
  CHECK(same_bytes(method->verdict(KeepStages::no).own_body, once.own_body));
  CHECK(same_bytes(method->verdict(KeepStages::yes).confidence, once.confidence));
}

TEST_CASE("the verdict is the same on one thread as on all of the machine's") {
  const std::vector<cv::Mat> frames = shaking(nose(), 10);
  const Verdict shared = verdict_on(frames);
  const int threads_before = cv::getNumThreads();
  cv::setNumThreads(1);
  const Verdict alone = verdict_on(frames);
  cv::setNumThreads(threads_before);
  CHECK(same_bytes(alone.own_body, shared.own_body));
  CHECK(same_bytes(alone.confidence, shared.confidence));
}

TEST_CASE("where no frame differs from the one before, the method is undecided") {
  for (const int frames : {0, 1, 2, 30}) {
    const auto method = paper_method({}, kSize_px);
    for (int n = 0; n < frames; ++n) method->add(shaking(nose(), 1).front());
    const Verdict verdict = method->verdict(KeepStages::yes);
    REQUIRE(verdict.undecided);
    CHECK(cv::countNonZero(verdict.own_body) == 0);
    CHECK(all_are(verdict.confidence, 0.5F));
    CHECK(verdict.stages.size() == kStages.size());
  }
}

TEST_CASE("a pair of equal frames leaves the sum unchanged") {
  std::vector<cv::Mat> frames = shaking(nose(), 10);
  const Verdict without = verdict_on(frames, KeepStages::yes);
  frames.insert(frames.begin() + 4, 3, frames[4]);
  const Verdict with = verdict_on(frames, KeepStages::yes);
  for (std::size_t i = 0; i < kStages.size(); ++i) CHECK(same_bytes(with.stages[i].image, without.stages[i].image));
}

TEST_CASE("confidence is one half at the mask's border, 0 or 1 far from it, and consistent with the mask") {
  const Verdict verdict = verdict_on(shaking(nose(), 12));
  REQUIRE(verdict.confidence.type() == CV_32FC1);
  double minimum = 0;
  double maximum = 0;
  cv::minMaxLoc(verdict.confidence, &minimum, &maximum);
  CHECK(minimum == 0);
  CHECK(maximum == 1);
  CHECK(same_bytes(verdict.confidence > 0.5, verdict.own_body));
  CHECK(verdict.confidence.at<float>(10, 10) == 0);
  CHECK(verdict.confidence.at<float>(239, 160) == 1);
  int first = 0;  // of the body's pixels in the column through its middle; the border runs halfway to the one above
  while (verdict.own_body.at<uchar>(first, 160) == 0) ++first;
  CHECK(verdict.confidence.at<float>(first, 160) + verdict.confidence.at<float>(first - 1, 160) == doctest::Approx(1));
}

TEST_CASE("the mask is empty where every part is too small") {
  const Verdict verdict = verdict_on(shaking(nose(), 12), KeepStages::no, {.min_area_percent = 100});
  CHECK_FALSE(verdict.undecided);
  CHECK(cv::countNonZero(verdict.own_body) == 0);
  CHECK(all_are(verdict.confidence, 0));
}

TEST_CASE("images of one pixel, of one row and of one column have a verdict with all its stages") {
  for (const cv::Size size : small_sizes()) {
    std::vector<cv::Mat> frames;
    for (std::uint64_t n = 0; n < 4; ++n) frames.push_back(sprinkled(size, 0.5, n));
    const Verdict verdict = verdict_on(frames, KeepStages::yes);
    CHECK(verdict.own_body.size() == size);
    CHECK(verdict.confidence.size() == size);
    REQUIRE(verdict.stages.size() == kStages.size());
    for (const DetectionStage& stage : verdict.stages) CHECK(stage.image.size() == size);
  }
}

}  // namespace sigs::test
