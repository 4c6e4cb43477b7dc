// SPDX-License-Identifier: MIT
#include "appearance/point_spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/statistics.h"
#include "video/chroma.h"
#include "video/frame_quantisers.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

PlaneGrid chroma_grid(const Frame& frame) {
  const cv::Size step = chroma_step(frame.layout);
  PlaneGrid grid{.step_px = {step.width, step.height}};
  if (step.width == 2 && !chroma_on_luma_column(frame.color.chroma_site)) grid.offset_px.x = 0.5;
  if (step.height == 2 && !chroma_on_luma_row(frame.color.chroma_site)) grid.offset_px.y = 0.5;
  return grid;
}

// Mean of the bins beyond 6 px on one side, and how much they scatter.
std::optional<Fitted> side_of(const EdgeBins& bins, double sign) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < bins.code.size(); ++i) {
    if (sign * bins.distance_px[i] < 6) continue;
    n += bins.count[i];
    sum += bins.count[i] * bins.code[i];
    squares += bins.count[i] * bins.code[i] * bins.code[i];
  }
  if (n < 1) return std::nullopt;
  return Fitted{sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)))};
}

// The profiles of the chroma planes across an edge that was found in luma: of each plane whose sides differ by at least
// 12 codes and are even. Empty for gray and RGB. Code values are fitted, not light: chroma is spread after the transfer
// curve, by the conversion to fewer samples and by the codec.
std::vector<EdgeSample> chroma_samples(const Frame& frame, const StraightEdge& edge) {
  constexpr double kMinContrast = 12;
  constexpr double kMaxUnevenness = 0.1;
  constexpr double kBin_px = 0.5;
  std::vector<EdgeSample> samples;
  if (frame.layout == PixelLayout::gray || frame.layout == PixelLayout::rgb) return samples;
  const PlaneGrid grid = chroma_grid(frame);
  for (const int plane : {1, 2}) {
    EdgeSample sample{.bins = binned(frame.planes[plane], grid, edge.line, kEdgeHalfWidth_px, kBin_px),
                      .levels = {.transfer = TransferFunction::linear, .pixel_px = grid.step_px.x},
                      .normal = edge.line.normal};
    const std::optional<Fitted> dark = side_of(sample.bins, -1);
    const std::optional<Fitted> bright = side_of(sample.bins, 1);
    if (!dark || !bright) continue;
    const double contrast = std::abs(bright->value - dark->value);
    const double uneven = std::max({dark->sd, bright->sd, sample.bins.noise / 2});
    if (contrast < kMinContrast || uneven > kMaxUnevenness * contrast) continue;
    sample.tolerance = std::hypot(sample.bins.noise, 0.02 * contrast, 0.3);
    samples.push_back(std::move(sample));
  }
  return samples;
}

// The blur of chroma beyond that of luma, in samples of the chroma planes. Nothing where the fit has failed: chroma
// that is sharper than luma or wider than the profile.
//   luma_sigma_px  of the same edge
std::optional<double> chroma_blur_px(const EdgeSample& chroma, double luma_sigma_px) {
  constexpr double kWidest_px = 5;  // luma samples; wider ones do not end within the profile
  const Fitted sigma = fitted_sigma(chroma, {.sigma_px = 2});
  if (sigma.value > kWidest_px || sigma.sd > 0.3 * sigma.value + 0.2) return std::nullopt;
  const double beyond = sigma.value * sigma.value - luma_sigma_px * luma_sigma_px;
  if (beyond < -0.3) return std::nullopt;
  return std::sqrt(std::max(0.0, beyond)) / chroma.levels.pixel_px;
}

constexpr int kEdgesAFrame = 24;
constexpr std::size_t kMaxEdges = 120;    // of which a sigma is fitted
constexpr std::size_t kMaxTogether = 30;  // fitted together
constexpr int kFewestEdges = 24;
constexpr int kFewestAgreeing = 8;
constexpr double kLowQuantile = 0.1;
constexpr double kNormalAtLow = 1.2816;  // the normal distribution's, at that quantile
constexpr double kDrawn_px = 0.13;       // no lens is that sharp

// The best of fits from several starts: a sum of Gaussians has more than one minimum. Sharpening counts only where the
// fit without it is clearly worse: one that is narrower than the blur looks like less blur.
EdgeShape best_shape(std::span<const EdgeSample> edges, const EdgeShape& before) {
  constexpr double kClearlyWorse = 1.05;
  const ShapeFit without = fitted_shape(edges, before, false);
  ShapeFit best = without;
  for (const EdgeShape& start : {EdgeShape{before.sigma_px, 0.3, 1}, EdgeShape{1.3 * before.sigma_px, 1.2, 1.5},
                                 EdgeShape{before.sigma_px, 0.5, 2.5}}) {
    const ShapeFit fit = fitted_shape(edges, start, true);
    if (fit.misfit < best.misfit) best = fit;
  }
  if (without.misfit < kClearlyWorse * best.misfit) return {.sigma_px = without.shape.sigma_px};
  return best.shape;
}

// `most` of the items, evenly over all.
template <class Item>
std::vector<const Item*> thinned(const std::vector<Item>& items, std::size_t most) {
  std::vector<const Item*> chosen;
  const std::size_t count = std::min(items.size(), most);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(&items[i * items.size() / count]);
  return chosen;
}

// Whether one side of an edge lies on the own body.
bool is_near_body(const EdgeLine& line, const cv::Mat& own_body, cv::Size size) {
  if (own_body.empty() || own_body.size() != size) return false;
  for (const double distance_px : {-kEdgeHalfWidth_px, 0.0, kEdgeHalfWidth_px}) {
    const glm::ivec2 at(glm::round(line.at_px + distance_px * line.normal));
    const cv::Point pixel(std::clamp(at.x, 0, size.width - 1), std::clamp(at.y, 0, size.height - 1));
    if (own_body.at<uchar>(pixel) > 127) return true;
  }
  return false;
}

}  // namespace

struct PointSpread::SharpEnd {
  std::size_t edges_counted = 0;
  std::vector<const Edge*> edges;  // as many of them as are fitted
  std::vector<Fitted> sigmas_px;   // one for each edge
  Fitted sigma_px;                 // at the sharp end
  double error_px = 0;             // usual error of one edge
  EdgeShape shape;                 // of the edges that agree with it
  std::vector<const Edge*> agreeing;
  std::vector<std::size_t> agreeing_at;  // their places in `edges`
};

void PointSpread::add(const Frame& frame, const cv::Mat& own_body) {
  ++frames_;
  if (frame.quantisers && frame.quantisers->kind == QuantiserKind::jpeg) ++jpeg_frames_;
  layout_ = frame.layout;
  const bool is_limited = frame.layout != PixelLayout::rgb && frame.color.range == ColorRange::limited;
  const int lowest = is_limited ? 16 : 0;
  const int highest = is_limited ? 235 : 255;
  const TransferFunction transfer = transfer_function_of(frame.color.transfer).value_or(TransferFunction::srgb);
  const auto display_of = [&](double code) { return (code - lowest) / (highest - lowest); };
  for (const StraightEdge& edge : straight_edges(luma_of(frame), lowest, highest, kEdgesAFrame)) {
    if (is_near_body(edge.line, own_body, frame.size_px()) || is_seen_again(edge.line)) continue;
    const double tolerance = std::hypot(edge.bins.noise, 0.01 * (edge.bright - edge.dark), 0.3);
    edges_.push_back({.line = edge.line,
                      .luma = {.bins = edge.bins,
                               .levels = {display_of(edge.dark), display_of(edge.bright), transfer, 1},
                               .normal = edge.line.normal,
                               .tolerance = tolerance},
                      .chroma = chroma_samples(frame, edge)});
  }
}

bool PointSpread::is_seen_again(const EdgeLine& line) {
  constexpr double kSamePlace_px = 2;
  constexpr double kSameDirection = 0.995;  // cosine
  for (Edge& edge : edges_) {
    const glm::dvec2 off = line.at_px - edge.line.at_px;
    if (std::abs(glm::dot(off, line.normal)) > kSamePlace_px || glm::length(off) > line.half_length_px) continue;
    if (glm::dot(line.normal, edge.line.normal) < kSameDirection) continue;
    ++edge.times_seen;
    return true;
  }
  return false;
}

std::vector<const PointSpread::Edge*> PointSpread::counted_edges() const {
  constexpr int kStaying = 3;
  std::vector<const Edge*> passing, all;
  for (const Edge& edge : edges_) {
    all.push_back(&edge);
    if (edge.times_seen < kStaying) passing.push_back(&edge);
  }
  return std::ssize(passing) >= kFewestEdges ? passing : all;
}

// Twice: sharpening is known only once the edges at the sharp end have been fitted together.
PointSpread::SharpEnd PointSpread::sharp_end() const {
  const std::vector<const Edge*> counted = counted_edges();
  SharpEnd end{.edges_counted = counted.size()};
  for (const Edge* const* const edge : thinned(counted, kMaxEdges)) end.edges.push_back(*edge);
  if (end.edges.empty()) return end;
  for (int round = 0; round < 2; ++round) {
    std::vector<double> values, errors;
    end.sigmas_px.clear();
    for (const Edge* const edge : end.edges) {
      end.sigmas_px.push_back(fitted_sigma(edge->luma, end.shape));
      values.push_back(end.sigmas_px.back().value);
      errors.push_back(end.sigmas_px.back().sd);
    }
    const double spread_px = (quantile(values, 0.84) - quantile(values, 0.16)) / 2;
    end.error_px = std::min(median(errors), spread_px);
    end.sigma_px.value = quantile(values, kLowQuantile) + kNormalAtLow * end.error_px;
    const double below_px = (quantile(values, 2 * kLowQuantile) - quantile(values, kLowQuantile / 2)) / 2;
    end.sigma_px.sd = std::max(below_px - 0.4 * end.error_px, end.error_px / std::sqrt(std::ssize(values)));
    const double window_px = 2 * std::max(end.error_px, 0.05 * end.sigma_px.value);
    end.agreeing.clear();
    end.agreeing_at.clear();
    for (std::size_t i = 0; i < end.edges.size(); ++i) {
      if (std::abs(values[i] - end.sigma_px.value) > window_px) continue;
      end.agreeing.push_back(end.edges[i]);
      end.agreeing_at.push_back(i);
    }
    if (std::ssize(counted) < kFewestEdges || is_one_direction(end)) break;  // nothing but the edges' own sigmas counts
    std::vector<EdgeSample> together;
    for (const Edge* const* const edge : thinned(end.agreeing, kMaxTogether)) together.push_back((*edge)->luma);
    if (together.empty()) break;
    end.shape = best_shape(together, {.sigma_px = end.sigma_px.value});
  }
  return end;
}

// A horizon or a road has many edges and yet is one object, whose own softness counts each time.
bool PointSpread::is_one_direction(const SharpEnd& end) {
  constexpr double kMaxAlike = 0.9;  // length of the mean of unit vectors at twice the edges' angles
  glm::dvec2 sum(0);
  for (const Edge* const edge : end.edges) {
    const glm::dvec2 n = edge->line.normal;
    sum += glm::dvec2(n.x * n.x - n.y * n.y, 2 * n.x * n.y);
  }
  return glm::length(sum) > kMaxAlike * static_cast<double>(end.edges.size());
}

std::string PointSpread::why_not(const SharpEnd& end) const {
  if (frames_ == 0) return "no frame";
  if (edges_.empty()) return "no edge that is straight, isolated, strong and oblique to the rows";
  if (std::ssize(edges_) < kFewestEdges)
    return fmt::format("only {} edges that are straight, isolated and strong", edges_.size());
  if (is_one_direction(end))
    return fmt::format("all edges lie in one direction, as those of a horizon do, the sharpest of {:.2f} px",
                       end.sigma_px.value);
  if (std::ssize(end.agreeing) < kFewestAgreeing)
    return fmt::format("of {} edges only {} are about as sharp as the sharpest", edges_.size(), end.agreeing.size());
  if (end.sigma_px.value < kDrawn_px && end.shape.sigma_px < kDrawn_px)
    return "edges as sharp as no lens makes them: a drawing or a screen";
  if (end.sigma_px.sd > std::max(0.12, 0.25 * end.sigma_px.value))
    return fmt::format("the sharpest edges differ too much, by {:.2f} px around {:.2f} px", end.sigma_px.sd,
                       end.sigma_px.value);
  return "";
}

void PointSpread::find_luma(PointSpreadFound& found, const SharpEnd& end) const {
  // Fits that leave out a fifth of the edges each tell how sure the fit of all is (jackknife).
  constexpr std::size_t kParts = 5;
  std::vector<double> sigmas, amounts, sizes;
  for (std::size_t part = 0; part < kParts; ++part) {
    std::vector<EdgeSample> rest;
    const std::vector<const Edge* const*> together = thinned(end.agreeing, kMaxTogether);
    for (std::size_t i = 0; i < together.size(); ++i)
      if (i % kParts != part) rest.push_back((*together[i])->luma);
    const EdgeShape shape = fitted_shape(rest, end.shape, end.shape.sharpening > 0).shape;
    sigmas.push_back(shape.sigma_px);
    amounts.push_back(shape.sharpening);
    sizes.push_back(shape.sharpening_px);
  }
  const double factor = std::sqrt(static_cast<double>(kParts - 1));  // of the jackknife: (n - 1) / n * n
  const double amount_sd = factor * standard_deviation(amounts);
  const double natural_sd = end.sigma_px.sd;
  const EdgeShape& shape = end.shape;
  constexpr double kOfModel = 0.03;  // no lens' blur is exactly a Gaussian
  found.sigma_px = {shape.sigma_px,
                    std::hypot(factor * standard_deviation(sigmas), natural_sd, kOfModel * shape.sigma_px), true, ""};
  found.edges_used = static_cast<int>(end.agreeing.size());
  constexpr double kSureAmount = 0.2;  // half of a usual camera's
  if (shape.sharpening > 0 && amount_sd < std::max(kSureAmount, 0.35 * shape.sharpening)) {
    found.sharpening = {shape.sharpening, amount_sd, true, ""};
    found.sharpening_px = {shape.sharpening_px, factor * standard_deviation(sizes), true, ""};
  } else if (shape.sharpening == 0) {
    found.sharpening = {0, natural_sd / shape.sigma_px, true, ""};
    found.sharpening_px.why = "no sharpening";
  } else {
    found.sharpening.why = found.sharpening_px.why = "edges of nature differ more than sharpening shows";
  }
  Panel panel{.title = "edge profiles of the sharpest edges, 0 dark side, 1 bright side",
              .x_title = "distance from the edge, px",
              .remark = fmt::format("{} of {} edges; line: fit, sigma {:.2f} px, sharpening {:.2f}", found.edges_used,
                                    found.edges_found, shape.sigma_px, found.sharpening.value)};
  PanelSeries points{.label = "measured", .is_points = true};
  for (const Edge* const* const edge : thinned(end.agreeing, 12)) {
    const AlignedProfile profile = aligned_profile((*edge)->luma, shape);
    points.x.insert(points.x.end(), profile.distance_px.begin(), profile.distance_px.end());
    points.y.insert(points.y.end(), profile.value.begin(), profile.value.end());
  }
  PanelSeries line{.label = "fit"};
  const EdgeSample& middle = end.agreeing[end.agreeing.size() / 2]->luma;
  const EdgeCurve curve(shape, middle.levels, middle.normal);
  for (double x = -kEdgeHalfWidth_px; x <= kEdgeHalfWidth_px; x += 0.1) {
    line.x.push_back(x);
    line.y.push_back(curve(x));
  }
  panel.series = {std::move(points), std::move(line)};
  found.panels.push_back(std::move(panel));
}

void PointSpread::find_chroma(PointSpreadFound& found, const SharpEnd& end) const {
  constexpr int kFewest = 6;
  Estimate& spread = found.chroma_blur_px;
  if (layout_ == PixelLayout::gray || layout_ == PixelLayout::rgb) {
    spread = {0, 0, false,
              layout_ == PixelLayout::gray ? "gray footage has no chroma" : "RGB footage has no chroma planes"};
    return;
  }
  std::vector<double> spreads_px;
  PanelSeries points{.label = "measured", .is_points = true};
  for (std::size_t i = 0; i < end.edges.size(); ++i) {
    for (const EdgeSample& chroma : end.edges[i]->chroma) {
      const std::optional<double> one = chroma_blur_px(chroma, end.sigmas_px[i].value);
      if (!one) continue;
      spreads_px.push_back(*one);
      if (spreads_px.size() > 12) continue;
      const AlignedProfile profile = aligned_profile(chroma, {.sigma_px = 2});
      points.x.insert(points.x.end(), profile.distance_px.begin(), profile.distance_px.end());
      points.y.insert(points.y.end(), profile.value.begin(), profile.value.end());
    }
  }
  if (std::ssize(spreads_px) < kFewest) {
    spread.why = spreads_px.empty() ? "no edge whose sides differ in colour"
                                    : fmt::format("only {} edges whose sides differ in colour", spreads_px.size());
    return;
  }
  const double quartiles = quantile(spreads_px, 0.75) - quantile(spreads_px, 0.25);
  const double sd = 1.25 * 0.741 * quartiles / std::sqrt(static_cast<double>(spreads_px.size()));
  spread = {median(spreads_px), std::max(sd, 0.02), true, ""};
  found.panels.push_back(
      {.title = "chroma across edges, 0 dark side, 1 bright side",
       .x_title = "distance from the edge, luma px",
       .series = {std::move(points)},
       .remark = fmt::format("{} profiles; spread {:.2f} samples of chroma", spreads_px.size(), spread.value)});
}

PointSpreadFound PointSpread::finish() const {
  const bool is_jpeg = frames_ > 0 && jpeg_frames_ == frames_;
  PointSpreadFound found{.sigma_px = {.value = kDefaultPointSpread_px},
                         .sharpening = {.value = kDefaultSharpening},
                         .sharpening_px = {.value = kDefaultSharpening_px},
                         .chroma_blur_px = {.value = is_jpeg ? kDefaultJpegChromaBlur_px : kDefaultChromaBlur_px},
                         .edges_found = static_cast<int>(edges_.size())};
  const SharpEnd end = edges_.empty() ? SharpEnd{} : sharp_end();
  const std::string why = why_not(end);
  if (why.empty()) {
    find_luma(found, end);
  } else {
    found.sigma_px.why = found.sharpening.why = found.sharpening_px.why = why;
    found.panels.push_back({.title = "edge profiles", .remark = "not known: " + why});
  }
  find_chroma(found, end);
  return found;
}

}  // namespace sigs
