// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

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

// A point of the world that the mouse may pick, as the screen shows it.
struct PickPoint {
  std::optional<glm::dvec2> at;  // on the screen; none: not in sight
  double depth_m = 0;            // before the eye
};

// The point nearest to the mouse and no farther than the reach. Of points that are as near to within a pixel, the one
// nearest to the eye; of those, the first.
[[nodiscard]] std::optional<std::size_t> nearest_point(std::span<const PickPoint> points, const glm::dvec2& mouse,
                                                       double reach_px);

// A place of a polyline on the screen (window pixels).
struct PlaceOnLine {
  std::size_t segment = 0;  // from point `segment` to the next
  double share = 0;         // of the segment on the screen, 0..1
  glm::dvec2 at{0, 0};
  double distance_px = 0;  // from the mouse
};

// The place of a polyline on the screen that is nearest to the mouse, within the reach; segments with an end out of
// sight do not count.
[[nodiscard]] std::optional<PlaceOnLine> nearest_place(std::span<const std::optional<glm::dvec2>> line,
                                                       const glm::dvec2& mouse, double reach_px);

// The share of a segment in the world (0 at its first end, 1 at its last) that appears at a share of it on the screen,
// in perspective. The depths of the ends are those before the eye, in metres.
[[nodiscard]] double share_in_world(double share_on_screen, double first_depth_m, double last_depth_m);

// Thins marks that are drawn in order: a mark nearer than min_px (screen pixels) to the last one drawn is left out.
class Thinning {
 public:
  explicit Thinning(double min_px) : min_px_(min_px) {}

  // True: leave it out. False: it is drawn, and what follows is compared with it.
  [[nodiscard]] bool leaves_out(const glm::dvec2& at) {
    if (glm::distance(last_, at) < min_px_) return true;
    last_ = at;
    return false;
  }

 private:
  double min_px_;
  glm::dvec2 last_{std::numeric_limits<double>::infinity()};  // none yet: far from everything
};

// Finds places for labels so that none covers another one or an area that has to stay free.
class LabelPlacer {
 public:
  // margin_px: kept free around each label as well.
  explicit LabelPlacer(double margin_px = 0) : margin_px_(margin_px) {}

  // No label placed later may overlap this area.
  void keep_free(const ScreenRect& area) { taken_.push_back(area); }

  // The first candidate that overlaps nothing; that area is taken from then on. Where there is none: the first
  // candidate of all with in_any_case, else nothing.
  [[nodiscard]] std::optional<ScreenRect> place(std::span<const ScreenRect> candidates, bool in_any_case = false);

 private:
  double margin_px_;
  std::vector<ScreenRect> taken_;
};

}  // namespace sigs::editor
