// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace sigs::editor {

// How an image lies on the screen. Image coordinates are base/image.h's (centre of the first pixel at 0, 0); screen
// coordinates are window pixels, y down, pixel (i, j) covering [i, i + 1) x [j, j + 1).
struct ImageView {
  double zoom = 1;                    // screen pixels an image pixel
  glm::dvec2 origin_on_screen{0, 0};  // where the image's upper left corner, (-0.5, -0.5), lies

  [[nodiscard]] glm::dvec2 screen_of(const glm::dvec2& image) const;
  [[nodiscard]] glm::dvec2 image_of(const glm::dvec2& screen) const;
  [[nodiscard]] bool operator==(const ImageView&) const = default;
};

// A rectangle of the screen in window pixels: low is its upper left corner, high the lower right one (not included).
struct ScreenRect {
  glm::dvec2 low{0, 0};
  glm::dvec2 high{0, 0};
  [[nodiscard]] glm::dvec2 size() const { return high - low; }
  [[nodiscard]] bool contains(const glm::dvec2& p) const {
    return p.x >= low.x && p.y >= low.y && p.x < high.x && p.y < high.y;
  }
};

// Whether no coordinate is infinite or NaN.
[[nodiscard]] bool is_finite(const glm::dvec2& p);
[[nodiscard]] bool is_finite(const glm::dvec3& p);

// The point of the segment from a to b that is nearest to p.
struct SegmentPoint {
  double share = 0;  // along the segment: 0 at a, 1 at b; 0 where a == b
  glm::dvec2 at{0, 0};
};
[[nodiscard]] SegmentPoint nearest_on_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b);
// How far p is from that point.
[[nodiscard]] double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b);

inline constexpr double kMinZoom = 1.0 / 32;
inline constexpr double kMaxZoom = 64;

// The whole image, centred. A rect or image of no size gives zoom 1.
[[nodiscard]] ImageView fitted(const glm::dvec2& image_size, const ScreenRect& rect);

// Zoomed by a factor about a point of the screen, whose image point stays where it is. Zoom stays within the limits,
// and coming within 3 percent of a whole number of screen pixels an image pixel (or the inverse) it takes that; at 1
// and above the origin lies on whole screen pixels, so that pixels are exact.
[[nodiscard]] ImageView zoomed(const ImageView& view, double factor, const glm::dvec2& fixed_on_screen);

// Moved, but so that at least a quarter of the rect or of the image (what is smaller) still shows. At zoom 1 and
// above the origin is rounded to whole screen pixels: add the moves of a drag up rather than panning by parts of one.
[[nodiscard]] ImageView panned(const ImageView& view, const glm::dvec2& by_px, const glm::dvec2& image_size,
                               const ScreenRect& rect);

}  // namespace sigs::editor
