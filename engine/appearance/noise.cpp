// SPDX-License-Identifier: MIT
#include "appearance/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kBins = 20;  // of brightness
constexpr int kFewestBlocks = 12;
constexpr double kRounding = 1.0 / 12;  // variance of rounding to whole codes
constexpr double kNone = 0.004;         // variance below which there is no noise: a code here and there
constexpr double kWidestSpread_px = 3;  // the limit of the search is 4: a noise that has it has no end in a block
constexpr double kUntextured = 1.3;     // variance over that of the noise
// A block with more than this many times the variance of the floor is textured. Where neighbours share noise, blocks
// have fewer independent samples, and their variances differ more.
constexpr double kReach = 2;
constexpr double kReachOfShared = 5;

// The least variance that many blocks share.
struct Floor {
  double value = 0;
  bool is_shared = false;  // many blocks agree: noise. Texture alone has all sizes
  int count = 0;           // of blocks that agree
};

//   start  share of the blocks that are surely no larger than noise
//   reach  how many times the mean a block of noise alone may have
Floor floor_of(const std::vector<double>& variances, double start, double reach) {
  if (std::ssize(variances) < kFewestBlocks) return {};
  Floor found{.value = std::max(quantile(variances, start), kNone)};
  for (int round = 0; round < 10; ++round) {
    const double limit = reach * found.value;
    double sum = 0, n = 0;
    for (const double variance : variances) {  // without branches, which processors guess wrongly here
      sum += variance > limit ? 0 : variance;
      n += variance > limit ? 0 : 1;
    }
    found.value = std::max(sum / std::max(n, 1.0), kNone);
  }
  const auto between = [&](double low, double high) {
    return std::count_if(variances.begin(), variances.end(),
                         [&](double v) { return v >= low * found.value && v < high * found.value; });
  };
  found.count = static_cast<int>(between(0, reach));
  // Two intervals of the same ratio: of texture alone the upper one has about as many blocks, or more.
  found.is_shared = found.count >= kFewestBlocks && 2 * between(1 / reach, reach) > 3 * between(reach, 8);
  return found;
}

double root_of(double variance) {
  return std::sqrt(std::max(0.0, variance));
}

Estimate sd_estimate(double variance, double variance_sd) {
  constexpr double kRoundingDiffers = 0.02;  // of little noise, 1/12 is not the variance that rounding adds
  variance_sd = std::hypot(variance_sd, kRoundingDiffers);
  const double sd = root_of(variance);
  // Of a square root; at 0 the root of the error itself.
  return {sd, sd > root_of(variance_sd) ? variance_sd / (2 * sd) : root_of(variance_sd), true, ""};
}

// The work of Noise::finish(), step by step.
class NoiseFit {
 public:
  NoiseFit(const std::vector<NoiseBlock>& blocks, double black, double white, bool has_pairs)
      : blocks_(blocks), black_(black), white_(white), has_pairs_(has_pairs) {
    find_levels();
    if (shared_.value < 0.2 || levels_.empty()) return;
    reach_ = kReachOfShared;
    find_levels();
  }

  [[nodiscard]] bool has_levels() const { return !levels_.empty(); }
  [[nodiscard]] const std::vector<const NoiseBlock*>& plain() const { return plain_; }

  // All plain blocks are of one colour: nothing was photographed, or the codec left nothing.
  [[nodiscard]] bool is_without_noise() const {
    constexpr double kNearlyAll = 0.8;
    const auto even = std::count_if(plain_.begin(), plain_.end(),
                                    [](const NoiseBlock* block) { return block->variance < 2 * kNone; });
    return static_cast<double>(even) > kNearlyAll * static_cast<double>(plain_.size());
  }

  // Even the strongest texture does not move.
  [[nodiscard]] bool stands_still() const {
    std::vector<double> variances;
    for (const NoiseBlock& block : blocks_) variances.push_back(block.variance);
    const double strong = std::max(quantile(variances, 0.9), 40.0);
    double variance = 0, covariance = 0;
    for (const NoiseBlock& block : blocks_) {
      if (block.variance < strong) continue;
      variance += (block.variance + block.next_variance) / 2;
      covariance += block.covariance;
    }
    return variance > 0 && covariance > 0.97 * variance;
  }

  [[nodiscard]] Fitted correlation_length_px() const {
    const double correlation_length_px = spread_of_ratio(shared_.value, kNoiseBlock_px);
    const double more_px = spread_of_ratio(shared_.value + shared_.sd, kNoiseBlock_px);
    return {correlation_length_px, more_px - correlation_length_px};
  }

  // Nothing where no frame followed.
  [[nodiscard]] std::optional<Fitted> temporal_correlation() const {
    if (kept_.value < 0) return std::nullopt;
    const double changing = 1 - repeated_ / static_cast<double>(plain_.size());
    return Fitted{std::min(0.99, 1 - (1 - kept_.value) * changing), kept_.sd * changing};
  }

  // Variance of luma by brightness, of noise alone.
  [[nodiscard]] NoiseLine line(double correlation_length_px) const {
    const double left = block_rest(correlation_length_px, kNoiseBlock_px).variance;
    std::vector<NoiseLevel> corrected = levels_;
    for (NoiseLevel& level : corrected) level.variance = std::max(0.0, level.variance - kRounding) / left;
    return line_through(corrected);
  }

  [[nodiscard]] Fitted chroma_variance() const {
    std::vector<double> variances;
    for (const NoiseBlock* const block : plain_)
      if (block->chroma >= 0) variances.push_back(block->chroma);
    const Floor floor = floor_of(variances, 0.2, reach_);
    if (floor.count < kFewestBlocks) return {-1, 0};
    return {std::max(0.0, floor.value - kRounding),
            std::max(0.05 * floor.value, floor.value / std::sqrt(static_cast<double>(floor.count)))};
  }

  [[nodiscard]] Panel panel(const NoiseLine& line, double correlation_length_px) const {
    const double left = block_rest(correlation_length_px, kNoiseBlock_px).variance;
    PanelSeries all{.label = "blocks", .is_points = true}, floors{.label = "noise", .is_points = true};
    const double top = std::max(0.5, 4 * std::max(line.dark, line.bright));
    for (const NoiseLevel& level : levels_) {
      floors.x.push_back(level.brightness);
      floors.y.push_back(std::max(0.0, level.variance - kRounding) / left);
    }
    const std::size_t every = std::max<std::size_t>(1, blocks_.size() / 3000);
    for (std::size_t i = 0; i < blocks_.size(); i += every) {
      const double variance = std::max(0.0, blocks_[i].variance - kRounding) / left;
      if (variance > top) continue;
      all.x.push_back(brightness_of(blocks_[i]));
      all.y.push_back(variance);
    }
    return {.title = "variance of luma in blocks, square codes",
            .x_title = "brightness, 0 black, 1 white",
            .series = {std::move(all), std::move(floors), {"line", {0, 1}, {line.dark, line.bright}}}};
  }

 private:
  [[nodiscard]] double brightness_of(const NoiseBlock& block) const {
    return std::clamp((block.mean - black_) / (white_ - black_), 0.0, 1.0);
  }

  struct Bin {
    std::vector<const NoiseBlock*> blocks;
    Floor variance;
  };

  void sort_by_brightness() {
    bins_.assign(kBins, {});
    for (const NoiseBlock& block : blocks_)
      bins_[std::min(kBins - 1, static_cast<int>(brightness_of(block) * kBins))].blocks.push_back(&block);
    for (Bin& bin : bins_) {
      std::vector<double> variances;
      for (const NoiseBlock* const block : bin.blocks) variances.push_back(block->variance);
      bin.variance = floor_of(variances, 0.2, reach_);
    }
    std::erase_if(bins_, [](const Bin& bin) { return bin.variance.count < kFewestBlocks; });
  }

  // The codec gave the block of the frame before again, or nearly.
  [[nodiscard]] static bool is_repeated(const NoiseBlock& block) { return block.change() < 0.02 * block.variance; }

  [[nodiscard]] Floor change_floor(const std::vector<const NoiseBlock*>& blocks) const {
    std::vector<double> changes;
    for (const NoiseBlock* const block : blocks)
      if (!is_repeated(*block)) changes.push_back(block->change());
    return floor_of(changes, 0.1, reach_);
  }

  // Noise lasts equally in every bin; texture that hardly moves adds what lasts in some. So the bin in which least
  // lasts tells what noise does.
  void find_persistence() {
    std::vector<double> kept;
    for (Bin& bin : bins_) {
      const Floor change = change_floor(bin.blocks);
      if (change.count < kFewestBlocks) continue;
      std::vector<const NoiseBlock*> even;
      for (const NoiseBlock* const block : bin.blocks)
        if (!is_repeated(*block) && block->change() <= reach_ * change.value &&
            block->variance <= reach_ * bin.variance.value)
          even.push_back(block);
      if (std::ssize(even) >= kFewestBlocks) kept.push_back(lasting_share(even));
    }
    if (kept.empty()) return;
    std::sort(kept.begin(), kept.end());
    const double next = kept[std::min<std::size_t>(1, kept.size() - 1)];
    kept_ = {std::min(kept[0], 0.95), std::max(0.04, next - kept[0])};
  }

  // Blocks in which no more lasts than noise does: the rest would be texture.
  [[nodiscard]] std::vector<const NoiseBlock*> without_texture(const Bin& bin) const {
    constexpr double kMaxTexture = 0.25;  // of the noise that does not last
    if (kept_.value < 0) return bin.blocks;
    const double change = change_floor(bin.blocks).value;
    std::vector<const NoiseBlock*> plain;
    for (const NoiseBlock* const block : bin.blocks) {
      const double lasting = kept_.value * (block->variance + block->next_variance) / 2;
      if (is_repeated(*block) || block->covariance - lasting < kMaxTexture * change) plain.push_back(block);
    }
    return plain;
  }

  // Strong compression takes all noise from some blocks and leaves errors of its own in others: no variance is shared
  // by many. The middle one is taken, where it is little.
  [[nodiscard]] static Floor left_by_codec(const std::vector<double>& variances) {
    constexpr double kMaxLeft = 4;
    if (std::ssize(variances) < kFewestBlocks) return {};
    const double middle = median(variances);
    return {middle, middle < kMaxLeft, static_cast<int>(variances.size() / 2)};
  }

  // Brightnesses that few blocks have and in which all of them vary much are of an object: its edges and its texture.
  void leave_out_objects() {
    constexpr double kMaxAboveUsual = 10;
    std::vector<double> by_blocks;
    for (const NoiseLevel& level : levels_)
      by_blocks.insert(by_blocks.end(), level.blocks.size() / kFewestBlocks + 1, level.variance);
    const double usual = median(by_blocks);
    std::erase_if(levels_, [&](const NoiseLevel& level) { return level.variance > kMaxAboveUsual * usual + 0.5; });
  }

  // What neighbours share of the noise: the mean over the blocks up to reach_ times the floor.
  [[nodiscard]] double shared_by_neighbours(const std::vector<const NoiseBlock*>& blocks, bool by_change,
                                            double floor) const {
    double products = 0, squares = 0;
    for (const NoiseBlock* const block : blocks) {
      const double square = by_change ? block->change() : block->variance;
      if (square > reach_ * floor || (by_change && is_repeated(*block))) continue;
      products += by_change ? block->change_neighbours : block->neighbours;
      squares += std::max(square - kRounding, 0.1 * square);
    }
    return squares > 0 ? products / squares : 0;
  }

  void find_levels() {
    levels_.clear();
    plain_.clear();
    repeated_ = 0;
    sort_by_brightness();
    if (has_pairs_) find_persistence();
    for (const Bin& bin : bins_) {
      const std::vector<const NoiseBlock*> blocks = without_texture(bin);
      std::vector<double> variances;
      double brightness = 0;
      for (const NoiseBlock* const block : blocks) {
        variances.push_back(block->variance);
        brightness += brightness_of(*block);
      }
      Floor floor = floor_of(variances, 0.2, reach_);
      const Floor change = kept_.value < 0 ? Floor{} : change_floor(blocks);
      const double by_change = change.value / (1 - kept_.value);
      const bool is_by_change = change.is_shared && by_change < floor.value;
      if (!is_by_change && !floor.is_shared) floor = left_by_codec(variances);
      if (!is_by_change && !floor.is_shared) continue;
      const double ratio = shared_by_neighbours(blocks, is_by_change, is_by_change ? change.value : floor.value);
      if (is_by_change) floor = {by_change, true, change.count};
      NoiseLevel level{brightness / static_cast<double>(blocks.size()), floor.value,
                       static_cast<double>(std::min(200, floor.count)), ratio};
      for (const NoiseBlock* const block : blocks)
        if (block->variance <= reach_ * floor.value + kNone) level.blocks.push_back(block);
      levels_.push_back(std::move(level));
    }
    leave_out_objects();
    for (const NoiseLevel& level : levels_) {
      for (const NoiseBlock* const block : level.blocks) {
        plain_.push_back(block);
        repeated_ += is_repeated(*block) ? 1 : 0;
      }
    }
    // By texture alone there is no telling how large the noise is, but it is no larger than that: nothing is taken.
    if (plain_.empty()) levels_.clear();
    take_rest_of_texture();
  }

  // Neighbours share more of texture, or of texture that has moved, than of noise. The bin in which they share least
  // shows what they share of noise; in the others the variance is a mixture of both.
  void take_rest_of_texture() {
    constexpr double kOfTexture = 0.7;  // what they share of smooth texture, the plane being subtracted
    constexpr double kMaxOfNoise = 0.55;
    std::vector<double> ratios;
    for (const NoiseLevel& level : levels_)
      if (level.weight >= 60) ratios.push_back(level.shared);
    if (ratios.empty())
      for (const NoiseLevel& level : levels_) ratios.push_back(level.shared);
    if (ratios.empty()) return;
    std::sort(ratios.begin(), ratios.end());
    shared_ = {ratios[0], std::max(0.02, ratios[std::min<std::size_t>(1, ratios.size() - 1)] - ratios[0])};
    if (shared_.value > kMaxOfNoise) return;
    for (NoiseLevel& level : levels_)
      level.variance *= std::clamp((kOfTexture - level.shared) / (kOfTexture - shared_.value), 0.2, 1.0);
  }

  const std::vector<NoiseBlock>& blocks_;
  double black_, white_;
  bool has_pairs_;
  double reach_ = kReach;
  std::vector<Bin> bins_;
  std::vector<NoiseLevel> levels_;
  std::vector<const NoiseBlock*> plain_;  // without texture
  Fitted kept_{-1, 0};                    // of noise, by the next frame, in blocks that are not repeated; -1: not known
  Fitted shared_;                         // of noise, by neighbours
  double repeated_ = 0;                   // plain blocks that are
};

}  // namespace

void Noise::add(const Frame& frame, const Frame* next) {
  ++frames_;
  if (next != nullptr) ++pairs_;
  layout_ = frame.layout;
  const bool is_limited = frame.layout != PixelLayout::rgb && frame.color.range == ColorRange::limited;
  black_ = is_limited ? 16 : 0;
  white_ = is_limited ? 235 : 255;
  const std::vector<NoiseBlock> found = noise_blocks(frame, next);
  blocks_.insert(blocks_.end(), found.begin(), found.end());
  const cv::Size size = frame.size_px();
  blocks_looked_at_ += static_cast<double>(size.width / kNoiseBlock_px) * (size.height / kNoiseBlock_px);
}

NoiseFound Noise::finish() const {
  NoiseFound found;
  const auto give_up = [&](const std::string& why) {
    for (Estimate* const estimate : {&found.sd_dark, &found.sd_bright, &found.sd_chroma, &found.correlation_length_px,
                                     &found.temporal_correlation})
      if (!estimate->is_known && estimate->why.empty()) estimate->why = why;
    if (found.panels.empty()) found.panels.push_back({.title = "noise", .remark = "not known: " + why});
    return found;
  };
  if (frames_ == 0) return give_up("no frame");
  if (blocks_looked_at_ == 0) return give_up("frames smaller than a block of 8x8 pixels");
  if (static_cast<double>(blocks_.size()) < 0.01 * blocks_looked_at_)
    return give_up("all of it is black, white or clipped");
  const NoiseFit fit(blocks_, black_, white_, pairs_ > 0);
  if (!fit.has_levels()) return give_up("no flat parts: all is textured");
  if (fit.is_without_noise()) return give_up("flat parts have no noise at all: a drawing, or the codec removed it");
  Fitted spread = fit.correlation_length_px();
  const bool is_left_of_image = spread.value > kWidestSpread_px;
  if (is_left_of_image) spread = {0, 0};
  const NoiseLine line = fit.line(spread.value);
  found.sd_dark = sd_estimate(line.dark, line.dark_sd);
  found.sd_bright = sd_estimate(line.bright, line.bright_sd);
  if (is_left_of_image)
    found.correlation_length_px.why = "neighbours share nearly all: that is what is left of the image, not noise";
  else if (found.sd_dark.value <= found.sd_dark.sd && found.sd_bright.value <= found.sd_bright.sd)
    found.correlation_length_px.why = "too little noise";
  else
    found.correlation_length_px = {spread.value, spread.sd, true, ""};
  found.panels.push_back(fit.panel(line, spread.value));
  found.panels.back().remark =
      fmt::format("sd {:.2f} at black, {:.2f} at white; {} blocks{}", found.sd_dark.value, found.sd_bright.value,
                  fit.plain().size(), line.is_level ? "; no slope to be told" : "");
  const Fitted chroma = fit.chroma_variance();
  if (chroma.value >= 0)
    found.sd_chroma = sd_estimate(chroma.value, chroma.sd);
  else
    found.sd_chroma.why = layout_ == PixelLayout::gray  ? "gray footage has no chroma"
                          : layout_ == PixelLayout::rgb ? "RGB footage has no chroma planes"
                                                        : "no flat parts in chroma";
  if (pairs_ == 0) {
    found.temporal_correlation.why = "one frame alone";
  } else if (fit.stands_still() && fit.temporal_correlation().value_or(Fitted{1, 0}).value > 0.3) {
    found.temporal_correlation.why = "the camera stands still: fixed texture and lasting noise look the same";
  } else {
    const std::optional<Fitted> temporal_correlation = fit.temporal_correlation();
    if (temporal_correlation)
      found.temporal_correlation = {temporal_correlation->value, temporal_correlation->sd, true, ""};
    else
      found.temporal_correlation.why = "the codec repeats all flat parts from frame to frame";
  }
  return found;
}

}  // namespace sigs
