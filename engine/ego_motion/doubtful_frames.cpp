// SPDX-License-Identifier: MIT
#include "ego_motion/doubtful_frames.h"

#include <fmt/format.h>

#include <vector>

namespace sigs {

namespace {

constexpr double kStill_s = 0.5;  // doubled frames of a converted rate are shorter

// Frames of still runs: the camera may have done anything meanwhile.
std::vector<int> still_frames(const EgoMotion& motion) {
  std::vector<int> still;
  for (std::size_t begin = 0; begin < motion.frames.size();) {
    std::size_t end = begin + 1;
    while (end < motion.frames.size() && motion.frames[end].is_repeated) ++end;
    const bool is_all = begin == 0 && end == motion.frames.size();
    if (is_all || motion.frames[end - 1].time_s - motion.frames[begin].time_s > kStill_s)
      for (std::size_t k = begin + 1; k < end; ++k) still.push_back(static_cast<int>(k));
    begin = end;
  }
  return still;
}

}  // namespace

std::string ranges_text(std::span<const int> numbers) {
  constexpr int kShown = 10;
  std::string text;
  int shown = 0;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t j = i;
    while (j + 1 < numbers.size() && numbers[j + 1] == numbers[j] + 1) ++j;
    if (shown++ == kShown) return text + fmt::format(" and {} more", numbers.size() - i);
    if (!text.empty()) text += ", ";
    text += i == j ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[j]);
    i = j + 1;
  }
  return text;
}

void add_doubtful_frames(EgoMotion& motion, const std::string& where) {
  const std::vector<int> still = still_frames(motion);
  const bool has_gyro = motion.gyro && motion.gyro->is_fused;
  if (!has_gyro)
    for (const int k : still) motion.frames[static_cast<std::size_t>(k)].is_lost = true;
  std::vector<int> lost;
  std::vector<int> cuts;
  bool known = true;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    EgoFrame& frame = motion.frames[k];
    known = known && !frame.is_lost;
    if (!known) frame.sd_rad = glm::dvec3(kUnknownRotation_rad);
    if (frame.is_cut)
      cuts.push_back(static_cast<int>(k));
    else if (frame.is_lost && !frame.is_repeated)
      lost.push_back(static_cast<int>(k));
  }
  const auto warn = [&](const char* what, const std::vector<int>& frames) {
    if (!frames.empty()) motion.warnings.push_back({where, fmt::format("frames {}: {}", ranges_text(frames), what)});
  };
  warn("too few features agree on how the camera turned; its attitude from here on is not known against frame 0", lost);
  warn("nothing of the frame before is seen again (a cut?); attitude from here on is not known against frame 0", cuts);
  warn(has_gyro ? "the image stands still; the gyroscope alone tells how the camera turned"
                : "the image stands still; how the camera turned is not known",
       still);
  if (const int unknown = unknown_frames(motion); unknown > 0)
    motion.warnings.insert(
        motion.warnings.begin(),
        {where, fmt::format("how the camera turned since frame 0 is not known in {} of {} frames, {:.0f} %", unknown,
                            motion.frames.size(), 100.0 * unknown / static_cast<double>(motion.frames.size()))});
}

}  // namespace sigs
