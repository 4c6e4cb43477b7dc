// SPDX-License-Identifier: MIT
#include "compositor/warp.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "compositor/area_mean.h"

namespace sigs {

namespace {

constexpr int kNone = -1;

struct Source {
  glm::dvec3 axis;         // of the view, camera frame
  glm::dmat3 from_camera;  // x along the axis; y and z times the focal length
  glm::dvec2 center_px;    // measured from the corner of the layer
  AreaReader reader;
};

Source source_of(const RenderedView& drawn) {
  const glm::dmat3 turn = glm::mat3_cast(drawn.view.view_from_camera.rotation);
  const double f = drawn.view.focal_px;
  const glm::dmat3 scale{{1, 0, 0}, {0, f, 0}, {0, 0, f}};
  return {glm::transpose(turn)[0], scale * turn, drawn.view.center_px + 0.5, AreaReader(drawn.layer)};
}

// Where a ray meets the view; not a number behind the view and where there is no ray.
glm::dvec2 projected(const Source& source, const glm::dvec3& ray) {
  const glm::dvec3 p = source.from_camera * ray;
  if (!(p.x > 0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  return source.center_px + glm::dvec2(p.y, p.z) / p.x;
}

// The source that looks most nearly along the ray.
int nearest_source(std::span<const Source> sources, const glm::dvec3& ray) {
  if (ray == glm::dvec3(0)) return kNone;
  int nearest = 0;
  double longest = glm::dot(sources[0].axis, ray);
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const double along = glm::dot(sources[i].axis, ray);
    if (along > longest) longest = along, nearest = static_cast<int>(i);
  }
  return nearest;
}

// One row of pixels after the other, with the corners' rays on both sides of it.
class Warper {
 public:
  Warper(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target, const TurnOfRow& turn_of_row)
      : lens_(lens), target_(target), turn_of_row_(turn_of_row) {
    for (const RenderedView& drawn : views) sources_.push_back(source_of(drawn));
  }

  Layer layer() {
    Layer out{target_, cv::Mat::zeros(target_.size(), CV_32FC4), cv::Mat::zeros(target_.size(), CV_32FC1)};
    if (target_.empty()) return out;
    find_lower_rays(0);
    for (int j = 0; j < target_.height; ++j) {
      std::swap(upper_, lower_);
      find_lower_rays(j + 1);
      warp_row(out.color.ptr<cv::Vec4f>(j), out.coverage.ptr<float>(j));
    }
    return out;
  }

 private:
  void find_lower_rays(int j) {
    const std::span<const glm::dvec3> rays = lens_.corner_rays(target_.x, target_.y + j, target_.width + 1);
    lower_.assign(rays.begin(), rays.end());
    if (!turn_of_row_) return;
    const RowMotion::Turn turn = turn_of_row_(target_.y + j - 0.5);
    for (glm::dvec3& ray : lower_) ray = turn * ray;
  }

  // Pixels that ask the same source, one run after the other.
  void warp_row(cv::Vec4f* color, float* coverage) {
    for (int i = 0; i < target_.width;) {
      const int nearest = nearest_source(sources_, upper_[static_cast<std::size_t>(i)]);
      int end = i + 1;
      while (end < target_.width && nearest_source(sources_, upper_[static_cast<std::size_t>(end)]) == nearest) ++end;
      if (nearest != kNone) warp_run(sources_[static_cast<std::size_t>(nearest)], i, end, color, coverage);
      i = end;
    }
  }

  void warp_run(Source& source, int first, int end, cv::Vec4f* color, float* coverage) {
    glm::dvec2 upper_left = projected(source, upper_[static_cast<std::size_t>(first)]);
    glm::dvec2 lower_left = projected(source, lower_[static_cast<std::size_t>(first)]);
    for (int i = first; i < end; ++i) {
      const glm::dvec2 upper_right = projected(source, upper_[static_cast<std::size_t>(i) + 1]);
      const glm::dvec2 lower_right = projected(source, lower_[static_cast<std::size_t>(i) + 1]);
      const AreaMean mean = source.reader.mean_over({upper_left, upper_right, lower_right, lower_left});
      color[i] = mean.color;
      coverage[i] = mean.coverage;
      upper_left = upper_right;
      lower_left = lower_right;
    }
  }

  LensTable& lens_;
  cv::Rect target_;
  const TurnOfRow& turn_of_row_;
  std::vector<Source> sources_;
  std::vector<glm::dvec3> upper_;
  std::vector<glm::dvec3> lower_;
};

}  // namespace

Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
             const TurnOfRow& turn_of_row) {
  ENSURE(!views.empty());
  return Warper(views, lens, target, turn_of_row).layer();
}

Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target) {
  LensTable lens(camera);
  return warped(views, lens, target);
}

}  // namespace sigs
