// SPDX-License-Identifier: MIT
#include "editor/widgets/zoomable_image.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace sigs;
using namespace sigs::editor;

namespace {

const cv::Size kImage(1280, 960);
const glm::dvec2 kArea(780, 611);

ZoomableImage laid_out() {
  ZoomableImage look;
  look.lay_out(kImage, kArea);
  return look;
}

double apart(const glm::dvec2& a, const glm::dvec2& b) {
  return glm::distance(a, b);
}

}  // namespace

TEST_CASE("a fitted image fills its area in one direction, centred, and follows the area's size") {
  ZoomableImage look = laid_out();
  for (const glm::dvec2 area : {kArea, glm::dvec2(300, 900), glm::dvec2(2000, 1500)}) {
    look.lay_out(kImage, area);
    CHECK(look.is_fitted());
    CHECK(look.zoom() == doctest::Approx(std::min(area.x / 1280, area.y / 960)));
    // Whole pixels from 1:1 on.
    CHECK(apart(look.view({0, 0}).screen_of({639.5, 479.5}), area / 2.0) < 1);
  }
}

TEST_CASE("zooming keeps the image point under the cursor") {
  ZoomableImage look = laid_out();
  const glm::dvec2 at(400, 300);
  for (int notch = 0; notch < 12; ++notch) {
    const glm::dvec2 before = look.view({0, 0}).image_of(at);
    look.zoom_by(1.25, at);
    // Whole screen pixels: at most half of one to every side.
    CHECK(apart(look.view({0, 0}).screen_of(before), at) < 0.75);
  }
  CHECK_FALSE(look.is_fitted());
}

TEST_CASE("at 1:1 and above, image pixels begin at whole screen pixels") {
  ZoomableImage look = laid_out();
  for (const double zoom : {1.0, 2.0, 4.0, 37.0}) {
    look.zoom_to(zoom, {123, 77});
    CHECK(look.zoom() == zoom);
    const glm::dvec2 corner = look.view({17, 40}).screen_of({-0.5, -0.5});
    CHECK(apart(corner, glm::round(corner)) < 1e-9);
    look.begin_pan();
    look.pan({13, -8});
    const glm::dvec2 moved = look.view({17, 40}).screen_of({-0.5, -0.5});
    CHECK(apart(moved, glm::round(moved)) < 1e-9);
  }
}

TEST_CASE("panning follows the mouse from its start, not update by update") {
  ZoomableImage look = laid_out();
  look.zoom_to(3, kArea / 2.0);
  const glm::dvec2 before = look.view({0, 0}).screen_of({640, 480});
  look.begin_pan();
  for (int step = 1; step <= 50; ++step) look.pan(glm::dvec2(1, -2) * static_cast<double>(step));
  CHECK(apart(look.view({0, 0}).screen_of({640, 480}), before + glm::dvec2(50, -100)) < 1e-9);
}

TEST_CASE("however far it is panned, some of the image stays in view") {
  ZoomableImage look = laid_out();
  for (const glm::dvec2 by : {glm::dvec2(1e6, 1e6), glm::dvec2(-1e6, -1e6), glm::dvec2(1e6, -1e6)}) {
    look.begin_pan();
    look.pan(by);
    CHECK_FALSE(pixels_in_sight(look.view({0, 0}), kImage, {{0, 0}, kArea}).empty());
  }
}

TEST_CASE("a growing area keeps the image point at its centre") {
  ZoomableImage look = laid_out();
  look.zoom_to(4, {200, 500});
  const glm::dvec2 middle = look.view({0, 0}).image_of(kArea / 2.0);
  const glm::dvec2 larger(1000, 801);
  look.lay_out(kImage, larger);
  CHECK(look.zoom() == 4);
  CHECK(apart(look.view({0, 0}).screen_of(middle), larger / 2.0) <= 1);
}

TEST_CASE("another image size is fitted again") {
  ZoomableImage look = laid_out();
  look.zoom_to(4, {200, 500});
  look.lay_out({640, 480}, kArea);
  CHECK(look.is_fitted());
}

TEST_CASE("a shown part is centred with a margin around it") {
  ZoomableImage look = laid_out();
  for (const Box part : {Box{600, 400, 40, 10}, Box{500, 300, 400, 300}, Box{640, 480, 0.2, 0.1}}) {
    look.show(part);
    const ImageView view = look.view({0, 0});
    CHECK(apart(view.screen_of({part.x + part.width / 2, part.y + part.height / 2}), kArea / 2.0) <= 1);
    // A whole zoom less than 3 % away is taken instead.
    CHECK(part.width * look.zoom() <= 1.03 * kArea.x / 2);
    CHECK(part.height * look.zoom() <= 1.03 * kArea.y / 2);
  }
}

TEST_CASE("the pixels in view are those whose squares meet the rect") {
  const ScreenRect rect{{10, 20}, {110, 90}};
  for (const ImageView view : {ImageView{1, {30, 40}}, ImageView{7, {-200, -333}}, ImageView{0.3, {11, 15.5}}}) {
    cv::Rect expected;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 300; ++x) {
        const glm::dvec2 low = view.screen_of(glm::dvec2(x, y) - 0.5);
        const glm::dvec2 high = view.screen_of(glm::dvec2(x, y) + 0.5);
        const bool meets = high.x > rect.low.x && high.y > rect.low.y && low.x < rect.high.x && low.y < rect.high.y;
        if (meets) expected = expected.empty() ? cv::Rect(x, y, 1, 1) : expected | cv::Rect(x, y, 1, 1);
      }
    const cv::Rect found = pixels_in_sight(view, {300, 200}, rect);
    CHECK((found & expected) == expected);
    CHECK(found.width <= expected.width + 1);  // a pixel that only touches the rect
    CHECK(found.height <= expected.height + 1);
  }
}

TEST_CASE("a reduced image is averaged, so that a single bright pixel leaves a trace") {
  cv::Mat image(12, 12, CV_8UC1, cv::Scalar(0));
  image.at<uchar>(4, 7) = 160;
  const auto from = [&image](double zoom) { return reduced_copy(image, divisor_at(zoom)); };
  CHECK(from(1).data == image.data);
  CHECK(from(0.51).data == image.data);
  const cv::Mat quarter = from(0.25);
  CHECK(quarter.size() == cv::Size(3, 3));
  CHECK(quarter.at<uchar>(1, 1) == 10);  // 160 / 16
  CHECK(cv::countNonZero(quarter) == 1);
  CHECK(from(1e-6).size() == cv::Size(1, 1));
}

TEST_CASE("each pixel of a reduced image is the mean of a block, at the right and lower edge of what there is") {
  cv::Mat image(23, 31, CV_8UC1);
  cv::RNG(5).fill(image, cv::RNG::UNIFORM, 0, 256);
  for (const int divisor : {2, 3, 4, 7, 40}) {
    const cv::Mat reduced = reduced_copy(image, divisor);
    REQUIRE(reduced.size() == reduced_size(image.size(), divisor));
    for (int j = 0; j < reduced.rows; ++j)
      for (int i = 0; i < reduced.cols; ++i) {
        const cv::Rect block = cv::Rect(i * divisor, j * divisor, divisor, divisor) & cv::Rect({0, 0}, image.size());
        REQUIRE_FALSE(block.empty());
        CHECK(std::abs(reduced.at<uchar>(j, i) - cv::mean(image(block))[0]) <= 0.5 + 1e-6);  // rounded
      }
  }
}

TEST_CASE("a patch drawn from a smaller copy has the pixels of the smaller copy of the whole image") {
  cv::RNG random(7);
  cv::Mat ground(301, 407, CV_8UC3);
  random.fill(ground, cv::RNG::UNIFORM, 0, 256);
  PatchedImage image{.ground = ground, .patch = {}, .patch_at = {}};
  // In the middle; in a corner, where it has a margin on two sides alone; over the whole.
  for (const cv::Rect& changed : {cv::Rect(150, 120, 60, 40), cv::Rect(380, 290, 27, 11), cv::Rect(0, 0, 407, 301)}) {
    const cv::Rect part = cv::Rect(changed.x - kPatchMargin_px, changed.y - kPatchMargin_px,
                                   changed.width + 2 * kPatchMargin_px, changed.height + 2 * kPatchMargin_px) &
                          cv::Rect({0, 0}, image.size());
    const cv::Mat pixels = ground(part).clone();
    cv::Mat inner = pixels(changed - part.tl());
    random.fill(inner, cv::RNG::UNIFORM, 0, 256);
    image.patch = pixels;
    image.patch_at = part.tl();
    for (int divisor = 1; divisor <= kPatchMargin_px / 2; ++divisor) {
      const cv::Mat expected = reduced_copy(image.whole(), divisor);
      cv::Mat drawn = reduced_copy(ground, divisor).clone();
      const DrawnPatch patch = drawn_patch(image, divisor);
      const cv::Mat reduced = image.patch.reduced(patch.reduced - image.patch_at, divisor);
      reduced.copyTo(drawn(cv::Rect(patch.reduced.tl() / divisor, reduced.size())));
      // What smoothing reads of either texture, too.
      CHECK(cv::norm(drawn, expected, cv::NORM_INF) == 0);
      CHECK((patch.drawn & changed) == changed);
    }
  }
}
