// SPDX-License-Identifier: MIT
#include "appearance/haze.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pose.h"
#include "project/project.h"

namespace sigs {

// light = air + land * exp(-3 r / visibility) for one visibility; the prior draws `air` to the sky's colour.
struct HazeLine {
  double air = 0, land = 0, cost = std::numeric_limits<double>::infinity();
};

// The visibility of least cost, with the deviation at which the cost grows by one of its mean per point.
struct FoundHazeLine {
  HazeLine line;
  double visibility_m = 0, sd_m = 0;
};

namespace {

constexpr double kSkyFrom_deg = 1, kSkyTo_deg = 8, kSkyBin_deg = 0.25;
constexpr double kMinDepression_deg = 0.4, kMaxDepression_deg = 35;
constexpr double kGroundBin_deg = 0.05;  // in which light is collected
constexpr int kDistanceBins = 24;        // to which a fit is made; even in the logarithm of the depression
constexpr double kMinCells = 40;         // of a bin that counts
constexpr std::size_t kMinBins = 8;      // that a fit needs
constexpr double kPatches = 0.10;        // by which the land's mean differs from bin to bin, share of its contrast
constexpr double kTexture = 0.02;        // share of all light by which a bin's mean may be off, besides
constexpr double kShoulder = 0.2;        // see expanded()
constexpr double kFloor = 0.004;         // and of all light: noise, coding
constexpr double kCurve = 0.08;          // share by which the camera's tone curve may be off
constexpr double kMinVisibility_m = 100, kMaxVisibility_m = 3e5, kStep = 1.02;
constexpr double kClipped = 0.985;                       // of luma: over-exposed
constexpr double kMaxRelativeSd = 0.5;                   // of a visibility that is known
constexpr double kMinFading = 0.9;                       // of the contrast that is left of the farthest land, at most
constexpr double kMaxDip_deg = 1.5, kDipStep_deg = 0.1;  // of an edge in the image below the horizon
constexpr double kShoulderSd = 0.15;                     // of the visibility, by the shoulder that is not known
constexpr double kColorsApart = 0.2;  // natural logarithm of the visibility in red or blue to that in all light
constexpr double kEdgeSd = 0.5;       // and where the horizon is an edge in the image
constexpr double kWithGround = 0.5;   // of the airlight's deviation, where ground and sky agree on it

double squared(double x) {
  return x * x;
}

// Bin of a depression among those that a fit is made to, 0 for the largest; -1 beyond them.
int distance_bin(double depression_rad) {
  const double nearest = rad_of_deg(kMaxDepression_deg), farthest = rad_of_deg(kMinDepression_deg);
  if (!(depression_rad < nearest) || depression_rad < farthest) return -1;
  const double share = std::log(nearest / depression_rad) / std::log(nearest / farthest);
  return std::min(kDistanceBins - 1, static_cast<int>(share * kDistanceBins));
}

// Lenses darken the image towards its corners; the middle half of the columns has little of that.
int first_column(const LightImage& image) {
  return image.grid.size().width / 4;
}

// Cameras compress highlights more than the transfer function of their footage says, and by how much is not known.
// This undoes about half of what such a shoulder usually does: a seventh at a light of 0.7.
double expanded(double light) {
  return light / (1 - kShoulder * std::min(light, 2.0));
}
double compressed(double light) {
  return light / (1 + kShoulder * std::max(light, 0.0));
}

// value and deviation, at 0, of the parabola through points (least squares); of the line where `is_straight`.
HazePoint at_zero(const std::vector<HazePoint>& points, bool is_straight) {
  const int terms = is_straight ? 2 : 3;
  cv::Mat_<double> a(static_cast<int>(points.size()), terms), b(static_cast<int>(points.size()), 1);
  for (int i = 0; i < a.rows; ++i) {
    const HazePoint& p = points[static_cast<std::size_t>(i)];
    for (int k = 0; k < terms; ++k) a(i, k) = std::pow(p.x, k);
    b(i, 0) = p.y;
  }
  cv::Mat_<double> solution;
  cv::solve(a, b, solution, cv::DECOMP_SVD);
  return {0, solution(0, 0)};
}

HazeLine line_for(const std::vector<HazePoint>& points, double visibility_m, const Estimate& sky) {
  double stt = 0, st = 0, s = 0, sty = 0, sy = 0;
  const auto weight = [&](const HazePoint& p) {
    return 1 / squared(std::hypot(kPatches * (sky.value - p.y), kFloor + kTexture * p.y));
  };
  for (const HazePoint& p : points) {
    const double t = std::exp(-3 * p.x / visibility_m), w = weight(p);
    stt += w * t * t, st += w * t, s += w, sty += w * t * p.y, sy += w * p.y;
  }
  const double prior = 1 / squared(std::max(sky.sd, 1e-4));
  s += prior;
  sy += prior * sky.value;
  const double det = s * stt - st * st;
  if (!(det > 1e-9 * s * stt)) return {};
  HazeLine line{.air = (stt * sy - st * sty) / det, .land = (s * sty - st * sy) / det};
  line.cost = prior * squared(line.air - sky.value);
  for (const HazePoint& p : points)
    line.cost += weight(p) * squared(line.air + line.land * std::exp(-3 * p.x / visibility_m) - p.y);
  return line;
}

// around_m: of the luminance, which that of a colour is drawn to; 0: none.
FoundHazeLine best_line(const std::vector<HazePoint>& points, const Estimate& sky, double around_m = 0) {
  FoundHazeLine found;
  const auto line_at = [&](double visibility_m) {
    HazeLine line = line_for(points, visibility_m, sky);
    if (around_m > 0) line.cost += squared(std::log(visibility_m / around_m) / kColorsApart);
    return line;
  };
  for (double v = kMinVisibility_m; v < kMaxVisibility_m; v *= kStep)
    if (const HazeLine line = line_at(v); line.cost < found.line.cost) found = {line, v, 0};
  const double degrees = std::max(1.0, static_cast<double>(points.size()) - 2);
  // Bins side by side see the same woods and clouds' shadows: about three of them count as one.
  const double limit = found.line.cost + 3 * std::max(1.0 / 3, found.line.cost / degrees);
  double low = found.visibility_m, high = low;
  while (low > kMinVisibility_m && line_at(low).cost < limit) low /= kStep;
  while (high < kMaxVisibility_m && line_at(high).cost < limit) high *= kStep;
  found.sd_m = high >= kMaxVisibility_m ? std::numeric_limits<double>::infinity() : 0.5 * (high - low);
  return found;
}

// Whether the land is darker than its haze, and grows paler with distance by more than its patches differ.
bool is_usable(const std::vector<HazePoint>& points, const FoundHazeLine& found) {
  const double far_share = std::exp(-3 * points.back().x / found.visibility_m);
  return found.line.land < 0 && found.sd_m <= kMaxRelativeSd * found.visibility_m && far_share < kMinFading;
}

Estimate not_known(double value, std::string why) {
  return {.value = value, .why = std::move(why)};
}

std::array<Estimate, 3> default_airlight(const std::string& why) {
  const glm::dvec3 color = HazeSettings{}.airlight_color;
  return {not_known(color.r, why), not_known(color.g, why), not_known(color.b, why)};
}

}  // namespace

// Of luminance, and of red, green and blue.
struct Haze::Fit {
  std::array<std::vector<HazePoint>, 4> points;
  std::array<FoundHazeLine, 4> found;
  double cost = 0;  // of the luminance, for each point
};

void Haze::add(const LightImage& image) {
  if (image.empty()) return;
  ++frames_;
  if (!image.skyline) return;
  ++with_skyline_;
  sky_.resize(static_cast<std::size_t>((kSkyTo_deg - kSkyFrom_deg) / kSkyBin_deg));
  add_sky(image);
  if (!image.rays.angles_are_known()) return;
  ++with_angles_;
  if (!image.view.height_m || !(*image.view.height_m > 0) || !std::isfinite(*image.view.height_m)) return;
  ++with_height_;
  ground_.resize(static_cast<std::size_t>(kMaxDepression_deg / kGroundBin_deg));
  if (image.skyline->from_image) ++with_edge_;
  add_ground(image);
}

void Haze::add_sky(const LightImage& image) {
  for (int y = 0; y < image.grid.size().height; ++y)
    for (int x = first_column(image); x < image.grid.size().width - first_column(image); ++x) {
      const auto up = image.elevation_rad(x, y);
      if (!up) continue;
      const int bin = static_cast<int>(std::floor((deg_of_rad(*up) - kSkyFrom_deg) / kSkyBin_deg));
      if (bin < 0 || bin >= static_cast<int>(sky_.size())) continue;
      ++sky_cells_;
      if (static_cast<double>(image.grid.luma(y, x)) > kClipped) ++clipped_;
      Bin& b = sky_[static_cast<std::size_t>(bin)];
      for (int k = 0; k < 3; ++k)
        b.sum[static_cast<std::size_t>(k)] += expanded(static_cast<double>(image.grid.light(y, x)[k]));
      b.x += *up;
      ++b.count;
    }
}

void Haze::add_ground(const LightImage& image) {
  for (int y = 0; y < image.grid.size().height; ++y)
    for (int x = first_column(image); x < image.grid.size().width - first_column(image); ++x) {
      const auto up = image.elevation_rad(x, y);
      if (!up || *up > 0) continue;
      const auto bin = static_cast<std::size_t>(deg_of_rad(-*up) / kGroundBin_deg);
      if (bin >= ground_.size()) continue;
      Bin& b = ground_[bin];
      for (int k = 0; k < 3; ++k)
        b.sum[static_cast<std::size_t>(k)] += expanded(static_cast<double>(image.grid.light(y, x)[k]));
      b.x -= *up;
      ++b.count;
      height_sum_m_ += *image.view.height_m;
      ++height_count_;
    }
}

// The sky's colour at the horizon: a parabola over the elevation, with the line's difference as its deviation.
std::array<Estimate, 3> Haze::sky_at_horizon() const {
  if (frames_ == 0) return default_airlight("there is no frame");
  if (with_skyline_ == 0) return default_airlight("there is no horizon in the footage");
  std::array<std::vector<HazePoint>, 3> points;
  for (const Bin& bin : sky_)
    for (std::size_t k = 0; k < 3; ++k)
      if (bin.count >= kMinCells) points[k].push_back({bin.x / bin.count, bin.sum[k] / bin.count});
  if (points[0].size() < kMinBins) return default_airlight("too little of the sky above the horizon is seen");
  if (clipped_ > 0.3 * sky_cells_) return default_airlight("the sky above the horizon is over-exposed");
  std::array<Estimate, 3> sky;
  for (std::size_t k = 0; k < 3; ++k) {
    const double curved = at_zero(points[k], false).y, straight = at_zero(points[k], true).y;
    sky[k] = {.value = std::max(curved, 0.0), .is_known = true};
    sky[k].sd = std::hypot(curved - straight, kCurve * sky[k].value, kFloor);
  }
  return sky;
}

// Luminance and colours of the ground against the distance, where the true horizon lies dip_rad above the skyline.
std::array<std::vector<HazePoint>, 4> Haze::ground_points(double dip_rad) const {
  std::array<Bin, kDistanceBins> bins;
  const double height_m = height_sum_m_ / std::max(height_count_, 1.0);
  for (const Bin& fine : ground_) {
    if (fine.count <= 0) continue;
    const double depression_rad = fine.x / fine.count + dip_rad;
    const int i = distance_bin(depression_rad);
    if (i < 0) continue;
    Bin& bin = bins[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 3; ++k) bin.sum[k] += fine.sum[k];
    bin.count += fine.count;
    bin.x += fine.count * height_m / std::sin(depression_rad);
  }
  std::array<std::vector<HazePoint>, 4> points;
  for (const Bin& bin : bins) {
    if (bin.count < kMinCells) continue;
    const double x = bin.x / bin.count;
    points[0].push_back({x, luminance({bin.sum[0], bin.sum[1], bin.sum[2]}) / bin.count});
    for (std::size_t k = 0; k < 3; ++k) points[k + 1].push_back({x, bin.sum[k] / bin.count});
  }
  return points;
}

// An attitude says where the horizon is. An edge in the image lies below it, where the land emerges from the haze;
// how far below is found together with the visibility.
Haze::Fit Haze::fit(const std::array<Estimate, 3>& sky) const {
  const Estimate limit{.value = luminance({sky[0].value, sky[1].value, sky[2].value}),
                       .sd = luminance({sky[0].sd, sky[1].sd, sky[2].sd})};
  Fit fit;
  const double most_dip_deg = with_edge_ > 0 ? kMaxDip_deg : 0;
  for (double dip_deg = 0; dip_deg <= most_dip_deg; dip_deg += kDipStep_deg) {
    auto points = ground_points(rad_of_deg(dip_deg));
    if (points[0].size() < kMinBins) continue;
    const FoundHazeLine found = best_line(points[0], limit);
    const double cost = found.line.cost / static_cast<double>(points[0].size());
    if (!fit.points[0].empty() && cost >= fit.cost) continue;
    fit.cost = cost;
    fit.points = std::move(points);
    fit.found[0] = found;
  }
  if (fit.points[0].empty()) return fit;
  for (std::size_t k = 1; k < 4; ++k) fit.found[k] = best_line(fit.points[k], sky[k - 1], fit.found[0].visibility_m);
  return fit;
}

// The airlight as the footage's light: that of the fit to the ground, where there is one, else the sky's.
std::array<Estimate, 3> Haze::airlight_of(std::array<Estimate, 3> air, const Fit* fit) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = fit != nullptr ? std::max(fit->found[k + 1].line.air, 0.0) : air[k].value;
    air[k].sd *= (fit != nullptr ? kWithGround : 1) * compressed(value) / std::max(value, kFloor);
    air[k].value = compressed(value);
  }
  return air;
}

HazeEstimate Haze::finish() const {
  const std::array<Estimate, 3> sky = sky_at_horizon();
  if (!sky[0].is_known) return {.visibility_m = not_known(0, sky[0].why), .airlight = sky};
  HazeEstimate haze{.visibility_m = not_known(0, ""), .airlight = airlight_of(sky, nullptr)};
  const Fit best = fit(sky);
  const FoundHazeLine& found = best.found[0];
  if (with_angles_ == 0)
    haze.visibility_m.why = "the camera's calibration is not known";
  else if (with_height_ == 0)
    haze.visibility_m.why = "the camera's height is not known";
  else if (best.points[0].size() < kMinBins)
    haze.visibility_m.why = "too little ground is seen";
  else if (!is_usable(best.points[0], found))
    haze.visibility_m.why = "the ground does not grow paler with distance";
  else {
    haze.visibility_m = {.value = found.visibility_m, .is_known = true};
    haze.visibility_m.sd = std::hypot(found.sd_m, (with_edge_ > 0 ? kEdgeSd : kShoulderSd) * found.visibility_m);
    haze.airlight = airlight_of(sky, &best);
  }
  return haze;
}

HazeCurve Haze::curve() const {
  HazeCurve curve;
  const std::array<Estimate, 3> sky = sky_at_horizon();
  if (!sky[0].is_known) return curve;
  const Fit best = fit(sky);
  for (const HazePoint& p : best.points[0]) {
    curve.distance_m.push_back(p.x);
    curve.ground_luminance.push_back(compressed(p.y));
    const HazeLine& line = best.found[0].line;
    const bool is_fitted = best.found[0].visibility_m > 0;
    curve.fitted_luminance.push_back(
        is_fitted ? compressed(line.air + line.land * std::exp(-3 * p.x / best.found[0].visibility_m))
                  : curve.ground_luminance.back());
  }
  return curve;
}

}  // namespace sigs
