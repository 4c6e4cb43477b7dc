// SPDX-License-Identifier: MIT
#include "compositor/warp.h"

#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kNone = -1;

struct Source {
  glm::dvec3 axis;         // of the view, camera frame
  glm::dmat3 from_camera;  // x along the axis; y and z times the focal length
  glm::dvec2 center_px;    // measured from the corner of the layer
  const RenderedView* drawn;
};

Source source_of(const RenderedView& drawn) {
  const glm::dmat3 turn = glm::mat3_cast(drawn.view.view_from_camera.rotation);
  const double f = drawn.view.focal_px;
  const glm::dmat3 scale{{1, 0, 0}, {0, f, 0}, {0, 0, f}};
  return {glm::transpose(turn)[0], scale * turn, drawn.view.center_px + 0.5, &drawn};
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

// The pixels of a target as quadrilaterals of the views, one row after the other.
class Quadrilaterals {
 public:
  Quadrilaterals(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
                 const RowTransform& row_transform)
      : lens_(lens), target_(target), row_transform_(row_transform) {
    for (const RenderedView& drawn : views) sources_.push_back(source_of(drawn));
  }

  //   visit  called with the number of a view, a column and a row of the target, and the corners in the view
  template <class Visit>
  void for_each(const Visit& visit) {
    if (target_.empty()) return;
    find_lower_rays(0);
    for (int j = 0; j < target_.height; ++j) {
      std::swap(upper_, lower_);
      find_lower_rays(j + 1);
      visit_row(j, visit);
    }
  }

 private:
  void find_lower_rays(int j) {
    const std::span<const glm::dvec3> rays = lens_.corner_rays(target_.x, target_.y + j, target_.width + 1);
    lower_.assign(rays.begin(), rays.end());
    if (!row_transform_) return;
    const RowMotion::Turn turn = row_transform_(target_.y + j - 0.5);
    for (glm::dvec3& ray : lower_) ray = turn * ray;
  }

  // Pixels that ask the same source, one run after the other.
  template <class Visit>
  void visit_row(int j, const Visit& visit) {
    for (int i = 0; i < target_.width;) {
      const int nearest = nearest_source(sources_, upper_[static_cast<std::size_t>(i)]);
      int end = i + 1;
      while (end < target_.width && nearest_source(sources_, upper_[static_cast<std::size_t>(end)]) == nearest) ++end;
      if (nearest != kNone) visit_run(static_cast<std::size_t>(nearest), i, end, j, visit);
      i = end;
    }
  }

  template <class Visit>
  void visit_run(std::size_t n, int first, int end, int j, const Visit& visit) {
    const Source& source = sources_[n];
    glm::dvec2 upper_left = projected(source, upper_[static_cast<std::size_t>(first)]);
    glm::dvec2 lower_left = projected(source, lower_[static_cast<std::size_t>(first)]);
    for (int i = first; i < end; ++i) {
      const glm::dvec2 upper_right = projected(source, upper_[static_cast<std::size_t>(i) + 1]);
      const glm::dvec2 lower_right = projected(source, lower_[static_cast<std::size_t>(i) + 1]);
      visit(n, i, j, Quadrilateral{upper_left, upper_right, lower_right, lower_left});
      upper_left = upper_right;
      lower_left = lower_right;
    }
  }

  LensTable& lens_;
  cv::Rect target_;
  const RowTransform& row_transform_;
  std::vector<Source> sources_;
  std::vector<glm::dvec3> upper_;
  std::vector<glm::dvec3> lower_;
};

// A view, read by area, and from its coarse layer where that tells enough.
class ViewReader {
 public:
  explicit ViewReader(const RenderedView& drawn)
      : coarse_(drawn.coarse ? &*drawn.coarse : nullptr),
        fine_(drawn.coarse ? LayerPyramid::of_parts(drawn.layer) : LayerPyramid(drawn.layer)) {}

  [[nodiscard]] AreaMean mean_over(const Quadrilateral& corners) {
    if (coarse_ == nullptr) return fine_.mean_over(corners);
    const cv::Rect cells = cells_touched(*coarse_, corners);
    if (cells.empty()) return {};
    return is_rough_in(*coarse_, cells) ? fine_.mean_over(corners) : interpolated(*coarse_, corners);
  }

 private:
  const CoarseView* coarse_;
  AreaReader fine_;
};

// One of steps by steps parts of a quadrilateral: column x, row y.
Quadrilateral part_of(const Quadrilateral& whole, int x, int y, int steps) {
  const auto at = [&](int i, int j) {
    const double across = double(i) / steps, down = double(j) / steps;
    return glm::mix(glm::mix(whole[0], whole[1], across), glm::mix(whole[3], whole[2], across), down);
  };
  return {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
}

}  // namespace

Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
             const RowTransform& row_transform) {
  return finely_warped(views, lens, target, 1, row_transform);
}

Layer finely_warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target, int steps,
                    const RowTransform& row_transform) {
  ENSURE(!views.empty() && steps >= 1);
  std::vector<ViewReader> readers(views.begin(), views.end());
  const cv::Rect rect(target.x * steps, target.y * steps, target.width * steps, target.height * steps);
  Layer out{rect, cv::Mat::zeros(rect.size(), CV_32FC4), cv::Mat::zeros(rect.size(), CV_32FC1)};
  Quadrilaterals(views, lens, target, row_transform)
      .for_each([&](std::size_t view, int i, int j, const Quadrilateral& corners) {
        for (int y = 0; y < steps; ++y)
          for (int x = 0; x < steps; ++x) {
            const AreaMean mean = readers[view].mean_over(steps == 1 ? corners : part_of(corners, x, y, steps));
            out.color.ptr<cv::Vec4f>(j * steps + y)[i * steps + x] = mean.color;
            out.coverage.ptr<float>(j * steps + y)[i * steps + x] = mean.coverage;
          }
      });
  return out;
}

Layer averaged(const Layer& fine, int steps) {
  if (fine.empty()) return {};
  const auto pixel_of = [steps](int sample) { return (sample - column_round(sample, steps)) / steps; };
  const cv::Point first(pixel_of(fine.rect.x), pixel_of(fine.rect.y));
  const cv::Point last(pixel_of(fine.rect.br().x - 1), pixel_of(fine.rect.br().y - 1));
  const cv::Rect rect(first, last + cv::Point(1, 1));
  const cv::Point begin = fine.rect.tl() - first * steps;
  const cv::Point end = rect.br() * steps - fine.rect.br();
  const auto means_of = [&](const cv::Mat& samples) {
    cv::Mat whole, means;
    cv::copyMakeBorder(samples, whole, begin.y, end.y, begin.x, end.x, cv::BORDER_CONSTANT, cv::Scalar::all(0));
    cv::resize(whole, means, rect.size(), 0, 0, cv::INTER_AREA);
    return means;
  };
  return {rect, means_of(fine.color), means_of(fine.coverage)};
}

std::optional<std::vector<cv::Mat>> cells_read(std::span<const RenderedView> views, LensTable& lens,
                                               const cv::Rect& target, const RowTransform& row_transform) {
  constexpr int kMostCells = 8;  // each way, that a pixel may touch
  std::vector<cv::Mat> read;
  for (const RenderedView& drawn : views) {
    ENSURE(drawn.coarse);
    read.push_back(cv::Mat::zeros(drawn.coarse->is_rough.size(), CV_8UC1));
  }
  bool are_small = true;
  Quadrilaterals(views, lens, target, row_transform)
      .for_each([&](std::size_t view, int /*i*/, int /*j*/, const Quadrilateral& corners) {
        const CoarseView& coarse = *views[view].coarse;
        const cv::Rect cells = cells_touched(coarse, corners);
        are_small = are_small && cells.width <= kMostCells && cells.height <= kMostCells;
        if (!are_small || !is_rough_in(coarse, cells)) return;
        for (int j = cells.y; j < cells.br().y; ++j)
          for (int i = cells.x; i < cells.br().x; ++i) read[view].ptr<unsigned char>(j)[i] = 255;
      });
  return are_small ? std::optional(std::move(read)) : std::nullopt;
}

Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target) {
  LensTable lens(camera);
  return warped(views, lens, target);
}

}  // namespace sigs
