// SPDX-License-Identifier: MIT
#include "horizon/horizon.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kColumnStep_px = 5;
constexpr std::size_t kPerColumn = 4;  // candidates
constexpr std::size_t kTried = 2;      // of them, through which planes are laid
constexpr float kMinStep = 4;          // codes by which the sky is brighter than what lies below it
constexpr int kStep_px = 4;            // above and below the edge, where the two are compared
constexpr double kNear_rad = 0.0025;   // a candidate on the plane
constexpr double kMinShare = 0.25;     // of the columns, side by side
constexpr int kGap = 4;                // a column without the edge counts as much as so many with it
constexpr int kHorizonTrials = 600;
constexpr double kSteepest = 1.7;        // tangent of the roll
constexpr int kAlike = 10;               // columns whose errors are alike: swell, coding, haze
constexpr int kPlanes = 4;               // that are tried, one after the other
constexpr int kSkyAbove_cells = 3;       // from an edge up to the next sky
constexpr int kBand_px = 14;             // above and below the edge, where texture is compared
constexpr double kRougher = 0.7;         // of the texture below: that of a sky, at most
constexpr double kSmooth_codes = 3;      // smooth, whatever is below
constexpr double kDeep_rad = 0.1;        // below the edge: ground with little haze
constexpr double kHazePerWidth = 0.271;  // 2 / e^2, see horizon.h
constexpr double kSharp_px = 2;          // width that a sharp edge seems to have by differences over two rows
constexpr double kPeak_rad = 0.01;       // edges farther from the plane are of something else

struct Candidate {
  int column = 0;
  int rank = 0;         // 0: the strongest of its column
  glm::dvec2 at_px{0};  // in the reduced image
  glm::dvec3 ray;
};

// Columns side by side that have the edge, but for a few.
struct Stretch {
  int first = 0;
  int last = -1;
  int columns = 0;  // that have it

  [[nodiscard]] int length() const { return last - first + 1; }
};

// Rows where it is brighter above than below by most, to parts of a row, with the step in codes.
std::vector<std::pair<float, float>> edges_in(const cv::Mat& gradient, const cv::Mat& mean, int x) {
  std::vector<std::pair<float, float>> edges;
  for (int y = kStep_px; y + kStep_px < gradient.rows; ++y) {
    const float before = -gradient.at<float>(y - 1, x);
    const float here = -gradient.at<float>(y, x);
    const float after = -gradient.at<float>(y + 1, x);
    if (here <= 0 || here < before || here <= after) continue;
    const float step = mean.at<float>(y - kStep_px, x) - mean.at<float>(y + kStep_px, x);
    if (step < kMinStep) continue;
    const float bend = before - 2 * here + after;
    const float part = bend < 0 ? 0.5F * (before - after) / bend : 0;
    edges.emplace_back(step, static_cast<float>(y) + std::clamp(part, -0.5F, 0.5F));
  }
  const std::size_t kept = std::min(edges.size(), kPerColumn);
  std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(kept), edges.end(), std::greater<>());
  edges.resize(kept);
  return edges;
}

bool has_sky_over(const SkyMap& sky, double x, double y) {
  for (int k = 1; k <= kSkyAbove_cells; ++k)
    if (y >= k * SkyMap::kCell_px && sky.is_sky(x, y - k * SkyMap::kCell_px)) return true;
  return false;
}

std::vector<Candidate> candidates_in(const cv::Mat& reduced, double scale, const Camera& camera,
                                     const cv::Mat& own_body, const SkyMap& sky) {
  cv::Mat smooth;
  cv::Mat gradient;
  cv::Mat mean;
  cv::GaussianBlur(reduced, smooth, {5, 5}, 1.2);
  cv::Sobel(smooth, gradient, CV_32F, 0, 1);
  cv::boxFilter(reduced, mean, CV_32F, {5, 2 * kStep_px - 3});
  std::vector<Candidate> candidates;
  for (int x = kColumnStep_px; x < reduced.cols - kColumnStep_px; x += kColumnStep_px) {
    int rank = 0;
    for (const auto& [step, y] : edges_in(gradient, mean, x)) {
      const glm::dvec2 pixel((x + 0.5) * scale - 0.5, (static_cast<double>(y) + 0.5) * scale - 0.5);
      if (is_own_body(own_body, pixel.x, pixel.y) || !has_sky_over(sky, x, static_cast<double>(y))) continue;
      if (const auto ray = camera.lens.ray(pixel)) candidates.push_back({x / kColumnStep_px, rank++, {x, y}, *ray});
    }
  }
  return candidates;
}

// The best stretch of columns with a candidate on the plane: most columns with less those without, times kGap.
Stretch stretch_on(const std::vector<Candidate>& candidates, const glm::dvec3& normal) {
  Stretch best;
  Stretch here;
  int score = 0;
  int best_score = 0;
  for (const Candidate& c : candidates) {
    if (std::abs(glm::dot(normal, c.ray)) > kNear_rad || (here.columns > 0 && c.column == here.last)) continue;
    score -= here.columns > 0 ? kGap * (c.column - here.last - 1) : 0;
    if (score <= 0) {
      score = 0;
      here = {.first = c.column, .last = c.column};
    }
    ++score;
    ++here.columns;
    here.last = c.column;
    if (score <= best_score) continue;
    best_score = score;
    best = here;
  }
  return best;
}

// Whether a candidate belongs to the edge.
bool is_on(const Candidate& c, const glm::dvec3& normal, const Stretch& stretch) {
  return c.column >= stretch.first && c.column <= stretch.last && std::abs(glm::dot(normal, c.ray)) <= kNear_rad;
}

// The sky is smoother than what lies below it; of an edge within fields or streets both sides are alike.
// Texture is how neighbours at the same distance from the edge differ.
bool has_smooth_side_above(const cv::Mat& reduced, const std::vector<Candidate>& candidates, const glm::dvec3& normal,
                           const Stretch& stretch) {
  double above = 0;
  double below = 0;
  int count = 0;
  const Candidate* before = nullptr;
  for (const Candidate& c : candidates) {
    if (!is_on(c, normal, stretch)) continue;
    if (before != nullptr && before->column < c.column) {
      const cv::Point a(cvRound(before->at_px.x), cvRound(before->at_px.y));
      const cv::Point b(cvRound(c.at_px.x), cvRound(c.at_px.y));
      const int room = std::min({std::min(a.y, b.y), reduced.rows - 1 - std::max(a.y, b.y), kBand_px});
      for (int d = kStep_px; d <= room; ++d) {
        above += std::abs(reduced.at<uchar>(a.y - d, a.x) - reduced.at<uchar>(b.y - d, b.x));
        below += std::abs(reduced.at<uchar>(a.y + d, a.x) - reduced.at<uchar>(b.y + d, b.x));
        ++count;
      }
    }
    before = &c;
  }
  return count > 0 && above <= std::max(kRougher * below, kSmooth_codes * count);
}

// The plane through two candidates that has the longest stretch.
std::optional<glm::dvec3> plane_of(const std::vector<Candidate>& candidates, int columns) {
  std::vector<const Candidate*> strong;
  for (const Candidate& c : candidates)
    if (c.rank < static_cast<int>(kTried)) strong.push_back(&c);
  if (strong.size() < 2 || static_cast<double>(strong.size()) < kMinShare * columns) return std::nullopt;
  cv::RNG chance(1);
  const int count = static_cast<int>(strong.size());
  int best = 0;
  glm::dvec3 normal(0);
  for (int trial = 0; trial < kHorizonTrials; ++trial) {
    const Candidate& a = *strong[static_cast<std::size_t>(chance.uniform(0, count))];
    const Candidate& b = *strong[static_cast<std::size_t>(chance.uniform(0, count))];
    const glm::dvec2 way = b.at_px - a.at_px;
    if (std::abs(a.column - b.column) < columns / 8 || std::abs(way.y) > kSteepest * std::abs(way.x)) continue;
    const glm::dvec3 tried = glm::normalize(glm::cross(a.ray, b.ray));
    if (const int found = stretch_on(candidates, tried).columns; found > best) {
      best = found;
      normal = tried;
    }
  }
  if (best < kMinShare * columns) return std::nullopt;
  return normal;
}

// Angle below the edge's plane that a row makes there.
double row_angle_rad(const Candidate& c, double scale, const Camera& camera, const glm::dvec3& up) {
  constexpr double kRows = 4;
  const auto lower = camera.lens.ray({(c.at_px.x + 0.5) * scale - 0.5, (c.at_px.y + kRows + 0.5) * scale - 0.5});
  return lower ? (glm::dot(up, c.ray) - glm::dot(up, *lower)) / kRows : 0;
}

// Mean luma of rows from `above_px` above the edge to `below_px` below it, over the edge's columns that have room.
std::vector<double> profile_of(const cv::Mat& reduced, const std::vector<Candidate>& on_edge, const glm::dvec3& up,
                               double row_rad, int above_px, int below_px) {
  std::vector<double> profile(static_cast<std::size_t>(above_px + below_px + 1), 0);
  int count = 0;
  for (const Candidate& c : on_edge) {
    const int y = cvRound(c.at_px.y + glm::dot(up, c.ray) / row_rad);  // on the plane
    if (y < above_px || y + below_px >= reduced.rows) continue;
    for (std::size_t i = 0; i < profile.size(); ++i)
      profile[i] += reduced.at<uchar>(y - above_px + static_cast<int>(i), static_cast<int>(c.at_px.x));
    ++count;
  }
  for (double& mean : profile) mean /= std::max(1, count);
  return profile;
}

// HorizonLine::haze_rad.
double haze_at(const cv::Mat& reduced, double scale, const Camera& camera, const std::vector<Candidate>& on_edge,
               const glm::dvec3& up) {
  const double row_rad = row_angle_rad(on_edge[on_edge.size() / 2], scale, camera, up);
  if (!(row_rad > 0)) return 0;
  constexpr int kAbove_px = 2 * kStep_px;
  const int below_px = std::clamp(cvRound(kDeep_rad / row_rad), kAbove_px, std::max(kAbove_px, reduced.rows / 4));
  const std::vector<double> profile = profile_of(reduced, on_edge, up, row_rad, kAbove_px, below_px);
  const auto mean = [&](std::size_t from, std::size_t count) {
    double sum = 0;
    for (std::size_t i = from; i < from + count; ++i) sum += profile[i];
    return sum / static_cast<double>(count);
  };
  const double contrast = mean(0, kStep_px) - mean(profile.size() - kStep_px, kStep_px);
  double slope = 0;  // codes a row
  for (std::size_t i = kAbove_px - 2; i <= kAbove_px + 2; ++i)
    slope = std::max(slope, (profile[i - 1] - profile[i + 1]) / 2);
  if (!(contrast > 0) || !(slope > 0)) return 0;
  const double width_px = std::min(contrast / slope, static_cast<double>(below_px));
  return kHazePerWidth * row_rad * std::sqrt(std::max(0.0, width_px * width_px - kSharp_px * kSharp_px));
}

// HorizonLine::hills_rad, by the edge nearest to the plane in each column of the stretch. What lies beside the stretch
// does not count: a coast beside the sea says nothing of the sea's horizon.
double hills_at(const std::vector<Candidate>& candidates, const glm::dvec3& up, const Stretch& stretch) {
  double squares = 0;
  int count = 0;
  for (auto it = candidates.begin(); it != candidates.end();) {
    const int column = it->column;
    double nearest_rad = kPeak_rad;
    for (; it != candidates.end() && it->column == column; ++it)
      nearest_rad = std::min(nearest_rad, std::abs(glm::dot(up, it->ray)));
    if (column < stretch.first || column > stretch.last || nearest_rad >= kPeak_rad) continue;
    squares += nearest_rad * nearest_rad;
    ++count;
  }
  return count > 0 ? std::sqrt(3 * squares / count) : 0;
}

// A plane that is fitted to the candidates near it.
struct FittedEdge {
  glm::dvec3 up;
  Stretch stretch;
  double sd_rad = 0;
};

std::optional<FittedEdge> fitted_edge(const std::vector<Candidate>& candidates, glm::dvec3 normal, int columns) {
  FittedEdge edge;
  for (int round = 0; round < 3; ++round) {
    const Stretch stretch = stretch_on(candidates, normal);
    if (stretch.columns < kMinShare * columns) return std::nullopt;
    glm::dmat3 sum(0);
    for (const Candidate& c : candidates)
      if (is_on(c, normal, stretch)) sum += glm::outerProduct(c.ray, c.ray);
    const PrincipalAxes found = principal_axes(sum);
    normal = found.axes[0];
    // The smallest value is the sum of squared misses; the next one tells how long the edge is.
    const double miss2 = std::max(found.values[0], 0.0) / stretch.columns + 1e-8;
    edge.sd_rad = std::sqrt(miss2 * kAlike / std::max(found.values[1], 1e-9));
  }
  edge.up = normal.z > 0 ? -normal : normal;  // Z is down
  edge.stretch = stretch_on(candidates, edge.up);
  return edge;
}

constexpr double kMinSkyColumns = 0.6, kMinEnds = 0.5;  // of the columns, for skyline_pitch_rad()
constexpr double kAgree_rad = 0.0087;                   // half a degree
constexpr double kDip_rad = 0.0068;                     // sqrt(2 h / R): the horizon's dip seen from 150 m
constexpr int kMinLines = 5;

}  // namespace

std::optional<HorizonLine> horizon_in(const cv::Mat& reduced, double scale, const Camera& camera,
                                      const cv::Mat& own_body, int frame) {
  const SkyMap sky = sky_map_of(reduced, own_body);
  std::vector<Candidate> candidates = candidates_in(reduced, scale, camera, own_body, sky);
  const int columns = reduced.cols / kColumnStep_px;
  for (int plane = 0; plane < kPlanes; ++plane) {
    const std::optional<glm::dvec3> rough = plane_of(candidates, columns);
    if (!rough) return std::nullopt;
    const std::optional<FittedEdge> edge = fitted_edge(candidates, *rough, columns);
    if (edge && has_smooth_side_above(reduced, candidates, edge->up, edge->stretch)) {
      const SkyEdge below_sky{.up = edge->up,
                              .first_px = edge->stretch.first * kColumnStep_px,
                              .last_px = edge->stretch.last * kColumnStep_px,
                              .seen_px = edge->stretch.columns * kColumnStep_px};
      if (divides_sky(below_sky, sky, reduced, scale, camera, own_body)) {
        std::vector<Candidate> on_edge;
        for (const Candidate& c : candidates)
          if (is_on(c, edge->up, edge->stretch) && (on_edge.empty() || on_edge.back().column < c.column))
            on_edge.push_back(c);
        if (on_edge.empty()) return std::nullopt;
        return HorizonLine{.frame = frame,
                           .up = edge->up,
                           .sd_rad = edge->sd_rad,
                           .haze_rad = haze_at(reduced, scale, camera, on_edge, edge->up),
                           .hills_rad = hills_at(candidates, edge->up, edge->stretch)};
      }
    }
    const glm::dvec3 normal = edge ? edge->up : *rough;
    const Stretch stretch = stretch_on(candidates, normal);
    const std::size_t before = candidates.size();
    std::erase_if(candidates, [&](const Candidate& c) { return is_on(c, normal, stretch); });
    if (candidates.size() == before) return std::nullopt;
  }
  return std::nullopt;
}

ReducedLuma reduced_luma(const cv::Mat& luma) {
  constexpr double kLongest_px = 640;
  const double scale = std::max({luma.cols / kLongest_px, luma.rows / kLongest_px, 1.0});
  ReducedLuma reduced{.luma = luma, .scale = scale};
  const cv::Size size(std::max(1, cvRound(luma.cols / scale)), std::max(1, cvRound(luma.rows / scale)));
  if (size != luma.size()) cv::resize(luma, reduced.luma, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

std::optional<double> skyline_pitch_rad(const SkyMap& sky, double scale, const Camera& camera) {
  if (sky.empty() || sky.columns < kMinSkyColumns) return std::nullopt;
  std::vector<double> pitches_rad;
  for (int x = 0; x < sky.sky.cols; ++x) {
    const int end = sky.end_of(x);
    if (end == 0 || end == sky.sky.rows) continue;
    const auto ray = camera.lens.ray(
        {(x + 0.5) * SkyMap::kCell_px * scale - 0.5, static_cast<double>(end) * SkyMap::kCell_px * scale - 0.5});
    if (ray) pitches_rad.push_back(std::atan2(ray->z, ray->x));
  }
  if (static_cast<double>(pitches_rad.size()) < kMinEnds * sky.sky.cols) return std::nullopt;
  return median(std::move(pitches_rad));
}

std::optional<Level> level_of(std::span<const HorizonLine> lines, std::span<const glm::dquat> start_from_camera) {
  std::vector<glm::dvec3> ups;
  for (const HorizonLine& line : lines)
    ups.push_back(start_from_camera[static_cast<std::size_t>(line.frame)] * line.up);
  Level level;
  glm::dvec3 best(0);
  for (const glm::dvec3& middle : ups) {
    int count = 0;
    glm::dvec3 sum(0);
    for (const glm::dvec3& up : ups) {
      if (glm::length(up - middle) > kAgree_rad) continue;
      sum += up;
      ++count;
    }
    if (count > level.lines) {
      level.lines = count;
      best = sum;
    }
  }
  if (level.lines < kMinLines || 2 * level.lines < static_cast<int>(ups.size())) return std::nullopt;
  level.up_in_start = glm::normalize(best);
  double squares = 0;
  for (std::size_t i = 0; i < ups.size(); ++i) {
    if (glm::length(ups[i] - level.up_in_start) > kAgree_rad) continue;
    const HorizonLine& line = lines[i];
    squares += std::max(squared_length(ups[i] - level.up_in_start) / 2, line.sd_rad * line.sd_rad) +
               line.haze_rad * line.haze_rad + line.hills_rad * line.hills_rad;
  }
  // Haze and hills bias all lines alike, so that none of this shrinks with their number.
  level.sd_rad = std::sqrt(squares / level.lines + kDip_rad * kDip_rad);
  return level;
}

glm::dquat world_from_start(const glm::dvec3& up_in_start) {
  const glm::dvec3 down = -up_in_start;
  glm::dvec3 forward = glm::dvec3(1, 0, 0) - glm::dot(glm::dvec3(1, 0, 0), down) * down;
  if (glm::length(forward) < 1e-6) forward = glm::dvec3(0, 0, 1) - glm::dot(glm::dvec3(0, 0, 1), down) * down;
  forward = glm::normalize(forward);
  const glm::dmat3 start_from_world(forward, glm::cross(down, forward), down);
  return glm::conjugate(glm::normalize(glm::dquat(start_from_world)));
}

}  // namespace sigs
