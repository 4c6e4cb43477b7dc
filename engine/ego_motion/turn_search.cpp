// SPDX-License-Identifier: MIT
#include "ego_motion/turn_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>

#include "base/least_squares.h"
#include "base/statistics.h"
#include "ego_motion/rotation_fit.h"

namespace sigs {

namespace {

void add_slopes(AnglePath::Piece& piece) {
  const std::size_t last = piece.times_s.size() - 1;
  const auto step = [&](std::size_t i) { return piece.times_s[i + 1] - piece.times_s[i]; };
  const auto rate = [&](std::size_t i) { return (piece.angles_rad[i + 1] - piece.angles_rad[i]) / step(i); };
  for (std::size_t i = 0; i <= last; ++i) {
    if (i == 0 || i == last) {
      piece.slopes_radps.push_back(rate(i == 0 ? 0 : last - 1));
      continue;
    }
    piece.slopes_radps.push_back((step(i) * rate(i - 1) + step(i - 1) * rate(i)) / (step(i - 1) + step(i)));
  }
}

constexpr double kRateWindow_s = 0.1;  // in which features are followed well

// Rates at equal steps; a known one is the mean over the window.
struct RateGrid {
  double first_s = 0;
  std::vector<glm::dvec3> rates_radps;
  std::vector<char> known;

  [[nodiscard]] int size() const { return static_cast<int>(known.size()); }
};

RateGrid sampled(const AnglePath& path, double step_s) {
  const double half_s = std::max(kRateWindow_s, step_s) / 2;
  RateGrid grid{.first_s = path.first_s(), .rates_radps = {}, .known = {}};
  const auto count = static_cast<std::size_t>((path.last_s() - path.first_s()) / step_s) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = grid.first_s + static_cast<double>(i) * step_s;
    const auto from = path.at(t - half_s);
    const auto to = path.at(t + half_s);
    const bool is_known = from && to && from->piece == to->piece;
    grid.known.push_back(is_known ? 1 : 0);
    grid.rates_radps.push_back(is_known ? (to->angle_rad - from->angle_rad) / (2 * half_s) : glm::dvec3(0));
  }
  return grid;
}

// Each rate by a function, less the mean of all known ones.
template <class Change>
RateGrid changed(RateGrid grid, const Change& change) {
  glm::dvec3 sum(0);
  double count = 0;
  for (std::size_t i = 0; i < grid.known.size(); ++i) {
    if (grid.known[i] == 0) continue;
    grid.rates_radps[i] = change(grid.rates_radps[i]);
    sum += grid.rates_radps[i];
    ++count;
  }
  for (std::size_t i = 0; i < grid.known.size(); ++i)
    if (grid.known[i] != 0) grid.rates_radps[i] -= sum / std::max(1.0, count);
  return grid;
}

RateGrid lengths_of(const RateGrid& grid) {
  return changed(grid, [](const glm::dvec3& rate) { return glm::dvec3(glm::length(rate), 0, 0); });
}

// Sums over the samples that both have at a lag: sample i of the second one beside i + lag of the first.
struct Overlap {
  double count = 0;
  double correlation = 0;
};

Overlap overlap_at(const RateGrid& first, const RateGrid& second, int lag, int begin = 0,
                   int end = std::numeric_limits<int>::max()) {
  double squares_first = 0;
  double squares_second = 0;
  double mixed = 0;
  Overlap overlap;
  const int from = std::max({begin, 0, -lag});
  const int to = std::min({end, second.size(), first.size() - lag});
  for (int i = from; i < to; ++i) {
    const auto a = static_cast<std::size_t>(i + lag);
    const auto b = static_cast<std::size_t>(i);
    if (first.known[a] == 0 || second.known[b] == 0) continue;
    const glm::dvec3& x = first.rates_radps[a];
    const glm::dvec3& y = second.rates_radps[b];
    squares_first += glm::dot(x, x);
    squares_second += glm::dot(y, y);
    mixed += glm::dot(x, y);
    ++overlap.count;
  }
  if (squares_first > 0 && squares_second > 0) overlap.correlation = mixed / std::sqrt(squares_first * squares_second);
  return overlap;
}

// The same at all lags, those of negative ones at the end; by Fourier transforms, so to rounding of the whole sums.
std::vector<Overlap> overlaps_at_all_lags(const RateGrid& first, const RateGrid& second) {
  const int length = cv::getOptimalDFTSize(first.size() + second.size());
  const auto spectrum_of = [&](const RateGrid& grid, const auto& value_at) {
    cv::Mat values = cv::Mat::zeros(1, length, CV_64F);
    for (int i = 0; i < grid.size(); ++i)
      if (grid.known[static_cast<std::size_t>(i)] != 0)
        values.at<double>(i) = value_at(grid.rates_radps[static_cast<std::size_t>(i)]);
    cv::dft(values, values, cv::DFT_COMPLEX_OUTPUT);
    return values;
  };
  const auto sums_of = [&](const auto& of_first, const auto& of_second) {
    cv::Mat sums;
    cv::mulSpectrums(spectrum_of(first, of_first), spectrum_of(second, of_second), sums, 0, true);
    cv::idft(sums, sums, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    return sums;
  };
  const auto one = [](const glm::dvec3&) { return 1.0; };
  const auto square = [](const glm::dvec3& rate) { return glm::dot(rate, rate); };
  const cv::Mat counts = sums_of(one, one);
  const cv::Mat squares_first = sums_of(square, one);
  const cv::Mat squares_second = sums_of(one, square);
  cv::Mat mixed = cv::Mat::zeros(1, length, CV_64F);
  for (int axis = 0; axis < 3; ++axis) {
    const auto part = [axis](const glm::dvec3& rate) { return rate[axis]; };
    mixed += sums_of(part, part);
  }
  constexpr double kRounding = 1e-12;  // of the largest sum
  const double least_first = kRounding * cv::norm(squares_first, cv::NORM_INF);
  const double least_second = kRounding * cv::norm(squares_second, cv::NORM_INF);
  std::vector<Overlap> overlaps(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    const double a = squares_first.at<double>(i);
    const double b = squares_second.at<double>(i);
    overlaps[static_cast<std::size_t>(i)] = {
        std::round(counts.at<double>(i)),
        a > least_first && b > least_second ? std::clamp(mixed.at<double>(i) / std::sqrt(a * b), -1.0, 1.0) : 0};
  }
  return overlaps;
}

// Samples that follow one another are alike. How many of them count as one that is independent (Bartlett: On the
// theoretical specification and sampling properties of autocorrelated time-series, 1946).
double samples_per_independent(const RateGrid& first, const RateGrid& second, int steps) {
  const std::vector<Overlap> of_first = overlaps_at_all_lags(first, first);
  const std::vector<Overlap> of_second = overlaps_at_all_lags(second, second);
  double sum = 1;
  for (int lag = 1; lag <= std::min({steps, first.size() - 1, second.size() - 1}); ++lag)
    sum +=
        2 * of_first[static_cast<std::size_t>(lag)].correlation * of_second[static_cast<std::size_t>(lag)].correlation;
  return std::max(1.0, sum);
}

struct Candidate {
  int lag = 0;
  double evidence = -1;  // logarithm of the likelihood against that of no relation
  Overlap overlap;
};

class CoarseSearch {
 public:
  CoarseSearch(RateGrid first, RateGrid second, double step_s, double max_offset_s, const StepControl& control)
      : first_(std::move(first)),
        second_(std::move(second)),
        first_varying_(changed(first_, [](const glm::dvec3& rate) { return rate; })),
        step_s_(step_s),
        max_offset_s_(max_offset_s),
        control_(control) {}

  // The offsets at which the rates agree, the most likely first, with the rotation of each.
  struct Found {
    Candidate best;
    glm::dquat first_from_second{1, 0, 0, 0};
    std::optional<Candidate> rival;
  };

  std::optional<Found> with_rotation(const glm::dquat& first_from_second) {
    const RateGrid turned = second_in_first(first_from_second);
    const std::vector<Candidate> candidates = ranked(first_varying_, turned);
    if (candidates.empty()) return std::nullopt;
    Found found{.best = candidates[0], .first_from_second = first_from_second, .rival = {}};
    const double unexplained = unexplained_about(turned, candidates[0].lag);
    constexpr double kSaysLittle = 0.75;  // then all offsets agree about as well, which is no repetition
    for (const Candidate& other : candidates)
      if (unexplained < kSaysLittle && other.lag != found.best.lag &&
          other.overlap.count > found.best.overlap.count / 2 && !found.rival &&
          unexplained_about(turned, other.lag) < 1.5 * unexplained + 0.005)
        found.rival = other;
    return found;
  }

  std::optional<Found> without_rotation() {
    std::vector<Candidate> candidates = ranked(lengths_of(first_), lengths_of(second_));
    constexpr std::size_t kTried = 12;
    if (candidates.size() > kTried) candidates.resize(kTried);
    std::optional<glm::dquat> best;
    double highest = -1;
    for (const Candidate& candidate : candidates) {
      const glm::dquat rotation = rotation_at(candidate.lag);
      const RateGrid turned = second_in_first(rotation);
      const double evidence =
          evidence_of(overlap_at(first_varying_, turned, candidate.lag),
                      samples_per_independent(first_varying_, turned, memory_steps()), independent_axes(turned));
      if (evidence > highest) {
        highest = evidence;
        best = rotation;
      }
    }
    if (!best) return std::nullopt;
    std::optional<Found> found = with_rotation(*best);
    if (!found) return std::nullopt;
    return with_rotation(rotation_at(found->best.lag));
  }

  // Offsets that were looked at, as many as differ: half a window apart.
  [[nodiscard]] double offsets_compared() const {
    const double range_s = std::min((first_.size() + second_.size()) * step_s_, 2 * max_offset_s_);
    return std::max(1.0, range_s / (kRateWindow_s / 2));
  }

  [[nodiscard]] double offset_s(double lag) const { return first_.first_s - second_.first_s + lag * step_s_; }

  // The drift that parts of the clip, each compared for itself, show about the offset found.
  [[nodiscard]] double drift_about(const Found& found) const {
    constexpr double kLong_s = 60;
    constexpr int kPieces = 12;
    constexpr double kMaxDrift = 0.002;
    const int from = std::max(0, -found.best.lag);
    const int to = std::min(second_.size(), first_.size() - found.best.lag);
    if ((to - from) * step_s_ < kLong_s) return 0;
    const RateGrid turned = second_in_first(found.first_from_second);
    const int range = static_cast<int>(std::ceil((0.2 + kMaxDrift * (to - from) * step_s_ / 2) / step_s_));
    std::vector<glm::dvec2> points;
    for (int part = 0; part < kPieces; ++part) {
      const int begin = from + (to - from) * part / kPieces;
      const int end = from + (to - from) * (part + 1) / kPieces;
      double highest = 0.5;
      std::optional<int> best;
      for (int lag = found.best.lag - range; lag <= found.best.lag + range; ++lag)
        if (const Overlap o = overlap_at(first_varying_, turned, lag, begin, end); o.correlation > highest) {
          highest = o.correlation;
          best = lag;
        }
      if (best) points.push_back({(begin + end) / 2.0, *best});
    }
    std::vector<double> slopes;  // Theil and Sen's line
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = i + 1; k < points.size(); ++k)
        slopes.push_back((points[k].y - points[i].y) / (points[k].x - points[i].x));
    return slopes.empty() ? 0.0 : std::clamp(median(std::move(slopes)), -kMaxDrift, kMaxDrift);
  }

 private:
  [[nodiscard]] RateGrid second_in_first(const glm::dquat& rotation) const {
    return changed(second_, [&](const glm::dvec3& rate) { return rotation * rate; });
  }
  [[nodiscard]] int memory_steps() const { return static_cast<int>(5 / step_s_); }

  // How many axes a camera turns about independently of one another, 1 to 3.
  [[nodiscard]] static double independent_axes(const RateGrid& grid) {
    glm::dmat3 sum(0);
    for (const glm::dvec3& rate : grid.rates_radps) sum += glm::outerProduct(rate, rate);
    const glm::dvec3 spread = principal_axes(sum).values;
    const double squares = glm::dot(spread, spread);
    return squares > 0 ? std::pow(spread.x + spread.y + spread.z, 2) / squares : 1;
  }

  // The share of the rates that the best offset beside a lag leaves unexplained, between lags too.
  [[nodiscard]] double unexplained_about(const RateGrid& turned, int lag) const {
    const double at = overlap_at(first_varying_, turned, lag).correlation;
    const double before = overlap_at(first_varying_, turned, lag - 1).correlation;
    const double after = overlap_at(first_varying_, turned, lag + 1).correlation;
    const double bend = before - 2 * at + after;
    const double peak = bend < 0 ? at - std::pow(after - before, 2) / (8 * bend) : at;
    return 1 - std::min(1.0, peak * peak);
  }

  [[nodiscard]] static double evidence_of(const Overlap& overlap, double per_independent, double axes) {
    const double independent = overlap.count / per_independent * axes;
    if (independent < 4 || !(overlap.correlation > 0)) return -1;
    return -0.5 * (independent - 3) * std::log(std::max(1e-9, 1 - overlap.correlation * overlap.correlation));
  }

  // All lags that are better than those beside them, by falling evidence; lags within half a second of a better one
  // are left out.
  std::vector<Candidate> ranked(const RateGrid& first, const RateGrid& second) const {
    const double per_independent = samples_per_independent(first, second, memory_steps());
    const double axes = independent_axes(second);
    std::vector<Candidate> all;
    const double between_s = first.first_s - second.first_s;
    const std::vector<Overlap> overlaps = overlaps_at_all_lags(first, second);
    for (int lag = -second.size() + 1; lag < first.size() && !control_.is_cancelled(); ++lag) {
      if (std::abs(between_s + lag * step_s_) > max_offset_s_) continue;
      const Overlap& overlap = overlaps[static_cast<std::size_t>(lag < 0 ? std::ssize(overlaps) + lag : lag)];
      if (overlap.count * step_s_ < kMinOverlap_s) continue;
      all.push_back({lag, evidence_of(overlap, per_independent, axes), overlap});
    }
    std::vector<Candidate> peaks;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool rises = i == 0 || all[i].evidence > all[i - 1].evidence;
      const bool falls = i + 1 == all.size() || all[i].evidence >= all[i + 1].evidence;
      if (rises && falls && all[i].evidence > 0) peaks.push_back(all[i]);
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
    std::vector<Candidate> apart;
    constexpr double kApart_s = 0.5;
    constexpr std::size_t kMost = 50;
    for (const Candidate& peak : peaks) {
      if (apart.size() == kMost) break;
      const bool is_new = std::all_of(apart.begin(), apart.end(), [&](const Candidate& other) {
        return std::abs(other.lag - peak.lag) * step_s_ > kApart_s;
      });
      if (is_new) apart.push_back(peak);
    }
    return apart;
  }

  [[nodiscard]] glm::dquat rotation_at(int lag) const {
    std::vector<RayPair> pairs;
    for (int i = std::max(0, -lag); i < std::min(second_.size(), first_.size() - lag); ++i) {
      const auto a = static_cast<std::size_t>(i + lag);
      const auto b = static_cast<std::size_t>(i);
      if (first_.known[a] != 0 && second_.known[b] != 0)
        pairs.push_back({second_.rates_radps[b], first_.rates_radps[a]});
    }
    return best_rotation(pairs, std::vector<double>(pairs.size(), 1));
  }

  static constexpr double kMinOverlap_s = 1;

  RateGrid first_;
  RateGrid second_;
  RateGrid first_varying_;
  double step_s_;
  double max_offset_s_;
  const StepControl& control_;
};

}  // namespace

AnglePath::AnglePath(std::span<const SeenTurn> turns) {
  constexpr double kSame_s = 1e-6;
  for (const SeenTurn& turn : turns) {
    if (!is_finite(turn.turn_rad) || !(turn.to_s > turn.from_s)) continue;
    if (!pieces_.empty() && turn.from_s < pieces_.back().times_s.back() - kSame_s) continue;
    if (pieces_.empty() || turn.from_s > pieces_.back().times_s.back() + kSame_s)
      pieces_.push_back({.times_s = {turn.from_s}, .angles_rad = {glm::dvec3(0)}, .slopes_radps = {}});
    pieces_.back().times_s.push_back(turn.to_s);
    pieces_.back().angles_rad.push_back(pieces_.back().angles_rad.back() + turn.turn_rad);
  }
  for (Piece& piece : pieces_) add_slopes(piece);
}

std::optional<AnglePath::At> AnglePath::at(double time_s) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time_s,
                                      [](double t, const Piece& piece) { return t < piece.times_s.front(); });
  if (after == pieces_.begin()) return std::nullopt;
  const Piece& piece = *(after - 1);
  if (time_s > piece.times_s.back()) return std::nullopt;
  const auto next = std::upper_bound(piece.times_s.begin() + 1, piece.times_s.end() - 1, time_s);
  const auto i = static_cast<std::size_t>(next - piece.times_s.begin()) - 1;
  const double length_s = piece.times_s[i + 1] - piece.times_s[i];
  const double s = (time_s - piece.times_s[i]) / length_s;
  const glm::dvec3 step = piece.angles_rad[i + 1] - piece.angles_rad[i];
  const glm::dvec3 from = length_s * piece.slopes_radps[i];
  const glm::dvec3 to = length_s * piece.slopes_radps[i + 1];
  const glm::dvec3 square = 3.0 * step - 2.0 * from - to;
  const glm::dvec3 cube = from + to - 2.0 * step;
  return At{static_cast<std::size_t>(after - pieces_.begin()) - 1,
            piece.angles_rad[i] + s * (from + s * (square + s * cube)),
            (from + s * (2.0 * square + 3.0 * s * cube)) / length_s};
}

std::optional<CoarseOffset> coarse_offset(const AnglePath& first, const AnglePath& second,
                                          const std::optional<glm::dquat>& first_from_second, double max_offset_s,
                                          const StepControl& control) {
  constexpr double kCoarseStep_s = 0.01;
  constexpr double kMostSteps = 15000;
  const double longest_s = std::max(first.last_s() - first.first_s(), second.last_s() - second.first_s());
  const double step_s = std::max(kCoarseStep_s, longest_s / kMostSteps);
  CoarseSearch search(sampled(first, step_s), sampled(second, step_s), step_s, max_offset_s, control);
  const auto found = first_from_second ? search.with_rotation(*first_from_second) : search.without_rotation();
  if (!found || control.is_cancelled()) return std::nullopt;
  CoarseOffset offset{.offset_s = search.offset_s(found->best.lag),
                      .drift = search.drift_about(*found),
                      .first_from_second = found->first_from_second,
                      .correlation = found->best.overlap.correlation,
                      .evidence = found->best.evidence,
                      .chance = std::min(1.0, search.offsets_compared() * std::exp(-found->best.evidence))};
  if (found->rival) offset.rival_offset_s = search.offset_s(found->rival->lag);
  return offset;
}

}  // namespace sigs
