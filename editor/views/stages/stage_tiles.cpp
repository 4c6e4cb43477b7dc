// SPDX-License-Identifier: MIT
#include "editor/views/stages/stage_tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

namespace sigs::editor {

namespace {

constexpr std::size_t kDifferencesKept = 1;

struct Words {
  const char* stage;
  const char* label;
  const char* tooltip;
};

constexpr std::array kWords{
    Words{"input1", "Input 1", "The footage"},
    Words{"input2", "Input 2", "The intruder before pure green, as a camera without distortion sees it"},
    Words{"a", "A: undistorted", "Input 1 without the lens' distortion"},
    Words{"b", "B: keyed", "Input 2 keyed into A"},
    Words{"c", "C: distorted", "B through the lens"},
    Words{"d", "D: blurred", "C blurred as the lens does at the intruder's distance"},
    Words{"f", "F: key, distorted and blurred",
          "Input 2 distorted and blurred the same way: where it is not green, D is taken"},
    Words{"keyed", "Keyed",
          "What the key gives, before the own body hides any of it: classic takes D where F is not green"},
    Words{"layer", "Layer", "The intruder alone in its virtual view, before it is warped"},
    Words{"bent", "Warped", "The layer through the lens"},
    Words{"blurred", "Blurred", "Blurred as the lens does at the intruder's distance"},
    Words{"hidden", "Hidden", "Without what the own body hides"},
    Words{"mask", "Mask", "Opacity with which intruders are composited"},
    Words{"output", "Output", "The finished frame, as it is exported"},
};

StageTile tile_of(const std::string& stage, const cv::Mat& image) {
  const auto words =
      std::find_if(kWords.begin(), kWords.end(), [&](const Words& known) { return stage == known.stage; });
  if (words == kWords.end()) return {stage, "", image};
  return {words->label, words->tooltip, image};
}

}  // namespace

StageName stage_name(const std::string& name) {
  int number = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (code != std::errc() || end == name.data() + name.size() || *end != '_' || number < 0) return {std::nullopt, name};
  return {number, std::string(end + 1, name.data() + name.size())};
}

std::vector<int> intruders_of(const std::vector<Stage>& stages) {
  std::set<int> numbers;
  for (const Stage& stage : stages)
    if (const std::optional<int> intruder = stage_name(stage.name).intruder) numbers.insert(*intruder);
  return {numbers.begin(), numbers.end()};
}

std::vector<StageTile> stage_tiles(const std::vector<Stage>& stages, std::optional<int> intruder) {
  std::vector<StageTile> tiles;
  for (const Stage& stage : stages) {
    const StageName name = stage_name(stage.name);
    if (stage.image.empty() || (name.intruder && name.intruder != intruder)) continue;
    tiles.push_back(tile_of(name.stage, stage.image));
  }
  return tiles;
}

cv::Mat difference(const cv::Mat& a, const cv::Mat& b, double gain) {
  if (a.empty() || a.size() != b.size() || a.type() != b.type()) return {};
  cv::Mat apart;
  cv::absdiff(a, b, apart);
  cv::Mat shown;
  apart.convertTo(shown, -1, gain);
  return shown;
}

cv::Mat Differences::of(const cv::Mat& a, const cv::Mat& b, double gain) {
  const auto known = std::find_if(made_.begin(), made_.end(), [&](const CachedDifference& made) {
    return made.a.data == a.data && made.b.data == b.data && made.gain == gain;
  });
  if (known != made_.end()) return known->image;
  if (made_.size() >= kDifferencesKept) made_.erase(made_.begin());
  made_.push_back({a, b, gain, difference(a, b, gain)});
  return made_.back().image;
}

}  // namespace sigs::editor
