// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "mesh/obj_file.h"

namespace sigs {
namespace {

// Newell's method: right for concave and slightly warped polygons too.
glm::dvec3 normal_of(std::span<const glm::vec3> corners) {
  glm::dvec3 normal{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 here = corners[i] - corners[0];
    const glm::dvec3 next = corners[(i + 1) % corners.size()] - corners[0];
    normal += glm::cross(here, next);
  }
  return normal;
}

// The polygon projected along the longest component of its normal, so that it runs counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
  const glm::dvec3 normal = normal_of(corners);
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners)
    flat.push_back(normal[axis] >= 0 ? glm::dvec2{corner[u], corner[v]} : glm::dvec2{corner[v], corner[u]});
  return flat;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<int>& left, std::size_t i) {
  const std::size_t count = left.size();
  const glm::dvec2 a = flat[left[(i + count - 1) % count]];
  const glm::dvec2 b = flat[left[i]];
  const glm::dvec2 c = flat[left[(i + 1) % count]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const int other : left)
    if (inside(flat[other], a, b, c)) return false;
  return true;
}

// Where no ear is found the polygon crosses itself or has no area; any corner will do.
std::size_t next_ear(const std::vector<glm::dvec2>& flat, const std::vector<int>& left) {
  for (std::size_t i = 0; i < left.size(); ++i)
    if (is_ear(flat, left, i)) return i;
  return 0;
}

// Each corner against each other: for the usual polygons of models.
std::vector<std::array<int, 3>> clipped_one_by_one(const std::vector<glm::dvec2>& flat) {
  std::vector<int> left(flat.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    const std::size_t ear = next_ear(flat, left);
    const std::size_t count = left.size();
    triangles.push_back({left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

// Points in the squares of a grid over all of them, some two a square.
class PointGrid {
 public:
  explicit PointGrid(const std::vector<glm::dvec2>& points) : points_(points), low_(points[0]) {
    glm::dvec2 high = points[0];
    for (const glm::dvec2& point : points) {
      low_ = glm::min(low_, point);
      high = glm::max(high, point);
    }
    const glm::dvec2 size = glm::max(high - low_, glm::dvec2(1e-300));
    const double wanted = std::max(1.0, 0.5 * static_cast<double>(points.size()));
    across_ = static_cast<int>(std::clamp(std::sqrt(wanted * size.x / size.y), 1.0, wanted));
    down_ = std::max(1, static_cast<int>(wanted) / across_);
    per_unit_ = glm::dvec2(across_, down_) / size;
    squares_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_));
  }

  void put(int point) { square(cell(points_[point])).push_back(point); }
  void take(int point) { std::erase(square(cell(points_[point])), point); }

  // Whether meets(point) for one of those in squares that the box from low to high touches. Tests max_looks points
  // and squares at most, and subtracts their number from it.
  template <class Meets>
  bool any_in(const glm::dvec2& low, const glm::dvec2& high, std::int64_t& max_looks, const Meets& meets) {
    const glm::ivec2 first = cell(low);
    const glm::ivec2 last = cell(high);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x && max_looks > 0; ++x) {
        const std::vector<int>& there = square({x, y});
        max_looks -= 1 + static_cast<std::int64_t>(there.size());
        if (std::any_of(there.begin(), there.end(), meets)) return true;
      }
    return false;
  }

 private:
  [[nodiscard]] glm::ivec2 cell(const glm::dvec2& point) const {
    const glm::dvec2 place = (point - low_) * per_unit_;
    return {std::clamp(static_cast<int>(place.x), 0, across_ - 1), std::clamp(static_cast<int>(place.y), 0, down_ - 1)};
  }
  std::vector<int>& square(const glm::ivec2& at) {
    return squares_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(across_) +
                    static_cast<std::size_t>(at.x)];
  }

  const std::vector<glm::dvec2>& points_;
  glm::dvec2 low_;
  glm::dvec2 per_unit_{};
  int across_ = 1;
  int down_ = 1;
  std::vector<std::vector<int>> squares_;
};

// The same for many corners: only those that point inwards can lie in an ear (Meisters 1975), and a grid finds those
// near it. Corners are a ring, traversed repeatedly.
class Clipper {
 public:
  explicit Clipper(const std::vector<glm::dvec2>& flat)
      : flat_(flat), next_(flat.size()), before_(flat.size()), is_inward_(flat.size()), grid_(flat) {
    const int count = static_cast<int>(flat.size());
    for (int i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      before_[i] = (i + count - 1) % count;
    }
    for (int i = 0; i < count; ++i) update(i);
  }

  // nullopt: more tests than that would be needed.
  std::optional<std::vector<std::array<int, 3>>> clipped(std::int64_t max_looks) {
    std::vector<std::array<int, 3>> triangles;
    triangles.reserve(flat_.size());
    int left = static_cast<int>(flat_.size());
    int at = 0;
    for (int passed = 0; left > 3;) {
      if (--max_looks < 0) return std::nullopt;
      const bool is_forced = passed > left;  // crosses itself or has no area: any corner will do
      if (!is_forced && !is_ear(at, max_looks)) {
        at = next_[at];
        ++passed;
        continue;
      }
      triangles.push_back({before_[at], at, next_[at]});
      cut(at);
      at = next_[next_[at]];  // not the neighbour again: a fan would give slivers
      --left;
      passed = 0;
    }
    triangles.push_back({before_[at], at, next_[at]});
    return triangles;
  }

 private:
  [[nodiscard]] double turn_at(int i) const { return turn(flat_[before_[i]], flat_[i], flat_[next_[i]]); }

  // A corner once pointing outwards stays so in a simple polygon; one pointing inwards may come to point outwards.
  void update(int i) {
    const bool is_inward = !(turn_at(i) > 0);
    if (is_inward == is_inward_[i]) return;
    is_inward_[i] = is_inward;
    is_inward ? grid_.put(i) : grid_.take(i);
  }

  bool is_ear(int i, std::int64_t& max_looks) {
    if (is_inward_[i]) return false;
    const glm::dvec2 a = flat_[before_[i]];
    const glm::dvec2 b = flat_[i];
    const glm::dvec2 c = flat_[next_[i]];
    return !grid_.any_in(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), max_looks,
                         [&](int other) { return inside(flat_[other], a, b, c); });
  }

  void cut(int i) {
    if (is_inward_[i]) grid_.take(i);
    next_[before_[i]] = next_[i];
    before_[next_[i]] = before_[i];
    update(before_[i]);
    update(next_[i]);
  }

  const std::vector<glm::dvec2>& flat_;
  std::vector<int> next_;
  std::vector<int> before_;
  std::vector<bool> is_inward_;
  PointGrid grid_;
};

}  // namespace

std::optional<std::vector<std::array<int, 3>>> triangulated(std::span<const glm::vec3> corners) {
  constexpr std::size_t kFewCorners = 256;
  constexpr std::int64_t kLooksPerCorner = 2000;  // a hundred times the number for outlines of real objects
  if (corners.size() < 3) return std::vector<std::array<int, 3>>();
  if (corners.size() == 3) return std::vector<std::array<int, 3>>{{0, 1, 2}};
  const std::vector<glm::dvec2> flat = flattened(corners);
  if (corners.size() <= kFewCorners) return clipped_one_by_one(flat);
  return Clipper(flat).clipped(kLooksPerCorner * static_cast<std::int64_t>(corners.size()));
}

}  // namespace sigs
