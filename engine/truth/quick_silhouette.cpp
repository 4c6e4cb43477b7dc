// SPDX-License-Identifier: MIT
#include "truth/quick_silhouette.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/ensure.h"

namespace sigs {

namespace {

using Node = PointTree::Node;

constexpr std::size_t kMinBallPoints = 16;  // points: the image of a ball costs as much as that of some of them

// A BallImage in body axes: dot(v, pose * p) is dot(v_in_body, p) + v_at_origin.
struct Plane {
  glm::dvec3 in_body{0};
  double at_origin = 0;
};

struct BodyBall {
  bool none_has_image = false;
  bool all_have_image = false;
  Plane along;
  std::array<Plane, 2> across;
  double error_px = 0;
};

class SilhouetteSearch {
 public:
  SilhouetteSearch(std::span<const glm::vec3> points, const PointTree& tree,
                   const Pose<frame::Camera, frame::Body>& pose, const Lens& lens)
      : points_(points),
        tree_(tree),
        pose_(pose),
        body_from_camera_(glm::mat3_cast(glm::conjugate(pose.rotation))),
        lens_(lens),
        max_magnitude_m_(glm::length(tree.nodes.front().center) + tree.nodes.front().radius +
                         glm::length(pose.translation_m)) {}

  [[nodiscard]] QuickSilhouette result() {
    const BodyBall whole = image_of(tree_.nodes.front());
    if (whole.all_have_image) visit_extreme_leaves(whole);
    visit_node(tree_.nodes.front(), whole);
    if (!found_any()) return {std::nullopt, evaluations_};
    return {Silhouette{{low_.x, low_.y, high_.x - low_.x, high_.y - low_.y}, all_have_image_}, evaluations_};
  }

 private:
  [[nodiscard]] bool found_any() const { return low_.x <= high_.x; }

  [[nodiscard]] Plane in_body(const glm::dvec3& in_camera) const {
    return {body_from_camera_ * in_camera, glm::dot(in_camera, pose_.translation_m)};
  }

  BodyBall image_of(const Node& node) {
    ++evaluations_;
    const BallImage ball = lens_.ball_image(pose_ * node.center, node.radius);
    return {ball.none_has_image,
            ball.all_have_image,
            in_body(ball.along),
            {in_body(ball.across[0]), in_body(ball.across[1])},
            ball.error_px};
  }

  void visit_point(const glm::dvec3& p_in_camera) {
    ++evaluations_;
    const std::optional<glm::dvec2> pixel = lens_.pixel(p_in_camera);
    if (!pixel) {
      all_have_image_ = false;
      return;
    }
    low_ = glm::min(low_, *pixel);
    high_ = glm::max(high_, *pixel);
  }

  //   around  as for visit_node
  void visit_points(const Node& node, const BodyBall& around) {
    const bool is_bounded = around.all_have_image;
    for (const glm::vec3& point : points_.subspan(node.first, node.count)) {
      const Node alone{.center = glm::dvec3(point)};
      if (!is_bounded || can_extend(alone, around)) visit_point(pose_ * alone.center);
    }
  }

  // The most that sign (dot(across, p) - x_px dot(along, p)) can be for points of the node.
  [[nodiscard]] double support(const Node& node, const Plane& across, const Plane& along, double x_px,
                               double sign) const {
    constexpr double kRounding = 1e-14;
    const glm::dvec3 normal = across.in_body - x_px * along.in_body;
    const glm::dvec3 magnitude = glm::abs(normal);
    return sign * (glm::dot(normal, node.center) + across.at_origin - x_px * along.at_origin) +
           glm::dot(magnitude, node.half) + kRounding * (magnitude.x + magnitude.y + magnitude.z) * max_magnitude_m_;
  }

  // Whether any point of a node within the ball can lie outside what was found: a pixel is more than x where
  // dot(across, p) - x dot(along, p) is positive.
  [[nodiscard]] bool can_extend(const Node& node, const BodyBall& ball) const {
    if (!found_any()) return true;
    for (int i = 0; i < 2; ++i) {
      const Plane& across = ball.across[static_cast<std::size_t>(i)];
      // Not "positive": with a NaN in it nothing is known.
      if (!(support(node, across, ball.along, high_[i] - ball.error_px, 1) < 0)) return true;
      if (!(support(node, across, ball.along, low_[i] + ball.error_px, -1) < 0)) return true;
    }
    return false;
  }

  // Where the ends are likely to be, so that the search has much to compare with from the start.
  void visit_extreme_leaves(const BodyBall& whole) {
    const Node& root = tree_.nodes.front();
    const auto at_center = [&](const Plane& plane) { return glm::dot(plane.in_body, root.center) + plane.at_origin; };
    for (const Plane& across : whole.across)
      for (const double sign : {-1.0, 1.0}) {
        const double middle_px = at_center(across) / at_center(whole.along);
        const auto extent = [&](const Node& node) { return support(node, across, whole.along, middle_px, sign); };
        const Node* node = &root;
        while (!node->is_leaf()) {
          const Node& left = tree_.nodes[node->left];
          const Node& right = tree_.nodes[node->right];
          node = extent(left) > extent(right) ? &left : &right;
        }
        visit_points(*node, whole);
      }
  }

  // Whether a bound is so wide that a closer look is worth its while.
  [[nodiscard]] bool is_loose_bound(const BodyBall& ball) const {
    constexpr double kMaxError = 1e-4;  // of the box
    if (!ball.all_have_image || !found_any()) return true;
    return ball.error_px > kMaxError * std::max(high_.x - low_.x, high_.y - low_.y);
  }

  //   around  what is known of a ball that holds the node's points
  void visit_node(const Node& node, const BodyBall& around) {
    if (around.none_has_image) {
      all_have_image_ = false;
      return;
    }
    if (around.all_have_image && !can_extend(node, around)) return;
    if (node.is_leaf()) {
      visit_points(node, around);
      return;
    }
    for (const std::size_t next : {node.left, node.right}) {
      const Node& child = tree_.nodes[next];
      if (child.count < kMinBallPoints || !is_loose_bound(around)) {
        visit_node(child, around);
        continue;
      }
      if (around.all_have_image && !can_extend(child, around)) continue;
      const BodyBall own = image_of(child);
      visit_node(child, own.all_have_image || !around.all_have_image ? own : around);
    }
  }

  std::span<const glm::vec3> points_;
  const PointTree& tree_;
  const Pose<frame::Camera, frame::Body>& pose_;
  glm::dmat3 body_from_camera_;
  const Lens& lens_;
  double max_magnitude_m_ = 0;  // no number that a bound is made of is larger
  glm::dvec2 low_{std::numeric_limits<double>::infinity()};
  glm::dvec2 high_{-std::numeric_limits<double>::infinity()};
  bool all_have_image_ = true;
  std::int64_t evaluations_ = 0;
};

}  // namespace

QuickSilhouette silhouette_of(std::span<const glm::vec3> points_in_body, const PointTree& tree,
                              const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  ENSURE(tree.nodes.empty() == points_in_body.empty());
  if (points_in_body.empty()) return {};
  return SilhouetteSearch(points_in_body, tree, camera_from_body, lens).result();
}

}  // namespace sigs
