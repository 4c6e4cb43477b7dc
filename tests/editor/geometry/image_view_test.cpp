// SPDX-License-Identifier: MIT
#include "editor/geometry/image_view.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigs::editor {
namespace {

const glm::dvec2 kImageSize{1280, 960};
const ScreenRect kPanel{{200, 40}, {1100, 700}};
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

bool is_whole(double value) {
  return value == std::round(value);
}

// The visible part of the image, along x and y, screen pixels.
glm::dvec2 showing(const ImageView& view) {
  const glm::dvec2 low = glm::max(view.screen_of({-0.5, -0.5}), kPanel.low);
  const glm::dvec2 high = glm::min(view.screen_of(kImageSize - 0.5), kPanel.high);
  return high - low;
}

}  // namespace

TEST_CASE("the first pixel's corner lies at the origin and each pixel covers zoom screen pixels") {
  const ImageView view{4, {30, 20}};
  CHECK(view.screen_of({-0.5, -0.5}) == glm::dvec2{30, 20});
  CHECK(view.screen_of({0, 0}) == glm::dvec2{32, 22});
  CHECK(view.screen_of({0.5, 1.5}) == glm::dvec2{34, 28});
}

TEST_CASE("screen and image are each other's inverse") {
  for (const double zoom : {kMinZoom, 0.37, 1.0, 3.3, kMaxZoom})
    for (const glm::dvec2 pixel : {glm::dvec2{0, 0}, glm::dvec2{-70.25, 1e7}, glm::dvec2{1279.5, 959.5}}) {
      const ImageView view{zoom, {17.5, -2000}};
      // 1e7 pixels at zoom 64 leave 1e-7 px of a double.
      CHECK(glm::distance(view.image_of(view.screen_of(pixel)), pixel) < 1e-6);
    }
}

TEST_CASE("a fitted image is whole, in the middle, and touches the rectangle on two sides") {
  for (const glm::dvec2 size : {kImageSize, glm::dvec2{900, 100}, glm::dvec2{100, 3000}, glm::dvec2{33, 41}}) {
    const ImageView view = fitted(size, kPanel);
    const glm::dvec2 low = view.screen_of({-0.5, -0.5});
    const glm::dvec2 high = view.screen_of(size - 0.5);
    CHECK(low.x >= kPanel.low.x - 0.5);  // whole screen pixels may take half a pixel
    CHECK(low.y >= kPanel.low.y - 0.5);
    CHECK(high.x <= kPanel.high.x + 0.5);
    CHECK(high.y <= kPanel.high.y + 0.5);
    CHECK(glm::length((low + high) / 2.0 - (kPanel.low + kPanel.high) / 2.0) <= std::sqrt(0.5));
    const glm::dvec2 spare = kPanel.size() - (high - low);
    CHECK(std::min(spare.x, spare.y) == doctest::Approx(0).scale(1e3));
  }
}

TEST_CASE("an image or rectangle of no size is fitted at zoom 1") {
  CHECK(fitted({0, 0}, kPanel).zoom == 1);
  CHECK(fitted({1280, 0}, kPanel).zoom == 1);
  CHECK(fitted(kImageSize, {}).zoom == 1);
  CHECK(fitted(kImageSize, {{10, 10}, {5, 5}}).zoom == 1);
  CHECK(fitted({kNotANumber, 4}, kPanel).zoom == 1);
}

TEST_CASE("a tiny or huge image is fitted within the limits of zoom") {
  CHECK(fitted({1, 1}, kPanel).zoom == kMaxZoom);
  CHECK(fitted({1e6, 1e6}, kPanel).zoom == kMinZoom);
}

TEST_CASE("zooming leaves the image point under the cursor, but for the step to whole screen pixels") {
  const glm::dvec2 cursor{431, 277};
  for (double zoom = 0.05; zoom < 50; zoom *= 1.3)
    for (const double factor : {0.5, 0.9, 1.01, 1.25, 2.0}) {
      const ImageView before{zoom, zoom >= 1 ? glm::dvec2{13, 26} : glm::dvec2{13.7, 25.9}};
      const ImageView after = zoomed(before, factor, cursor);
      const glm::dvec2 off_px = after.screen_of(before.image_of(cursor)) - cursor;
      const double allowed_px = after.zoom >= 1 ? 0.5 + 1e-9 : 1e-9;
      CHECK(std::abs(off_px.x) <= allowed_px);
      CHECK(std::abs(off_px.y) <= allowed_px);
      if (after.zoom >= 1) CHECK((is_whole(after.origin_on_screen.x) && is_whole(after.origin_on_screen.y)));
    }
}

TEST_CASE("zoom stays within its limits, however far the wheel is turned") {
  for (const double factor : {1e-300, 1e300, std::numeric_limits<double>::infinity()}) {
    const ImageView view = zoomed({1.7, {5, 5}}, factor, {100, 100});
    CHECK(view.zoom == (factor < 1 ? kMinZoom : kMaxZoom));
    CHECK(std::isfinite(view.origin_on_screen.x));
  }
}

TEST_CASE("a zoom that comes close to a whole number takes it") {
  CHECK(zoomed({0.8, {0, 0}}, 1.25 * 1.01, {0, 0}).zoom == 1);
  CHECK(zoomed({1.6, {0, 0}}, 1.25 * 0.99, {0, 0}).zoom == 2);
  CHECK(zoomed({0.4, {0, 0}}, 0.82, {0, 0}).zoom == doctest::Approx(1.0 / 3).epsilon(1e-15));
  CHECK(zoomed({1.2, {0, 0}}, 1.25, {0, 0}).zoom == doctest::Approx(1.5));
}

TEST_CASE("slow zooming gets away from a whole number in both directions") {
  for (const double factor : {1.004, 1 / 1.004}) {
    ImageView view{1, {0, 0}};
    for (int i = 0; i < 1000; ++i) view = zoomed(view, factor, {50, 50});
    CHECK((factor > 1 ? view.zoom > 20 : view.zoom < 0.05));
  }
}

TEST_CASE("an invalid factor leaves the view unchanged") {
  const ImageView view{1.37, {4.5, 5.5}};
  for (const double factor : {1.0, 0.0, -2.0, kNotANumber}) CHECK(zoomed(view, factor, {50, 50}) == view);
  CHECK(zoomed(view, 2, {kNotANumber, 50}) == view);
}

TEST_CASE("a small pan moves the image by as much") {
  const ImageView view{1, {200, 40}};
  CHECK(panned(view, {-30, 12}, kImageSize, kPanel).origin_on_screen == glm::dvec2{170, 52});
  const ImageView small{0.5, {300.25, 40}};
  CHECK(panned(small, {0.5, 0}, kImageSize, kPanel).origin_on_screen == glm::dvec2{300.75, 40});
}

TEST_CASE("however far it is panned, a quarter of the rectangle or of the image shows") {
  for (const double zoom : {0.05, 0.3, 1.0, 7.0, 64.0})
    for (const glm::dvec2 by : {glm::dvec2{1e7, 1e7}, glm::dvec2{-1e7, -1e7}, glm::dvec2{1e7, -1e7}}) {
      const ImageView view = panned({zoom, {250, 60}}, by, kImageSize, kPanel);
      const glm::dvec2 minimum = glm::min(kImageSize * zoom, kPanel.size()) / 4.0;
      const double slack_px = zoom >= 1 ? 1 : 1e-6;  // whole screen pixels, never to the outside
      CHECK(showing(view).x >= minimum.x - 1e-6);
      CHECK(showing(view).y >= minimum.y - 1e-6);
      CHECK(showing(view).x <= minimum.x + slack_px);
      CHECK(showing(view).y <= minimum.y + slack_px);
      if (zoom >= 1) CHECK((is_whole(view.origin_on_screen.x) && is_whole(view.origin_on_screen.y)));
    }
}

TEST_CASE("panning by NaN moves nothing") {
  const ImageView view{2, {4, 5}};
  CHECK(panned(view, {kNotANumber, 3}, kImageSize, kPanel) == view);
  CHECK(panned(view, {3, std::numeric_limits<double>::infinity()}, kImageSize, kPanel) == view);
  CHECK(panned(view, {3, 3}, {0, 0}, kPanel) == view);
}

}  // namespace sigs::editor
