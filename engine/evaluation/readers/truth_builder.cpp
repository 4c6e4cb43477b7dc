// SPDX-License-Identifier: MIT
#include "evaluation/readers/truth_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace {

constexpr double kMaxTrue_px = 1e9;
constexpr double kInventedRate_hz = 25;

bool is_counted_class(const TruthOptions& options, const std::string& category) {
  return options.classes.empty() || std::ranges::find(options.classes, category) != options.classes.end();
}

std::vector<double> times_at(const FootageTruth& footage, double rate_hz) {
  std::vector<double> times_s;
  for (int frame = footage.first_frame; frame <= footage.last_frame; ++frame) times_s.push_back(frame / rate_hz);
  return times_s;
}

}  // namespace

TruthBuilder::TruthBuilder(FootageTruth footage, double rate_hz, std::vector<double> times_s,
                           const TruthOptions& options)
    : clip_{.footage = std::move(footage), .times_s = std::move(times_s)}, options_(options) {
  if (options.rate_hz > 0) clip_.times_s.clear();
  const double rate = options.rate_hz > 0 ? options.rate_hz : rate_hz;
  clip_.has_times = rate > 0 || !clip_.times_s.empty();
  // The ratio is a clip's nominal rate, for reports alone; the times are exact.
  const double nominal = rate > 0 ? rate : kInventedRate_hz;
  clip_.footage.frame_rate_num = std::max(1, static_cast<int>(std::lround(std::min(nominal, 1e6) * 1000)));
  clip_.footage.frame_rate_den = 1000;
  if (clip_.times_s.empty()) clip_.times_s = times_at(clip_.footage, nominal);
}

Result<void> TruthBuilder::check(const TrueBox& box) const {
  for (const double number : {box.box.x, box.box.y, box.box.width, box.box.height})
    if (!(std::abs(number) <= kMaxTrue_px))
      return fail("", "the box has a number that is NaN or beyond a billion pixels");
  if (!(box.box.width > 0 && box.box.height > 0))
    return fail("", fmt::format("the box is {} wide and {} high: both must be more than 0",
                                number_text(box.box.width, 6), number_text(box.box.height, 6)));
  if (!(box.visible_fraction >= 0 && box.visible_fraction <= 1))
    return fail("", "the visible share is not from 0 to 1");
  if (box.distance_m < 0 || std::isinf(box.distance_m)) return fail("", "the distance is below 0 or infinite");
  const FootageTruth& footage = clip_.footage;
  if (box.frame < footage.first_frame || box.frame > footage.last_frame)
    return fail("", fmt::format("frame {} is not of the clip, which is frames {} to {}", box.frame, footage.first_frame,
                                footage.last_frame));
  return {};
}

Result<void> TruthBuilder::add(const TrueBox& box) {
  if (const Result<void> good = check(box); !good) return good;
  categories_.insert(box.category);
  TrueBox kept = box;
  kept.is_ignored = box.is_ignored || !is_counted_class(options_, box.category);
  if (!kept.is_ignored && !kept.id) clip_.has_ids = false;
  if (kept.id && !there_.emplace(box.frame, *kept.id).second)
    return fail("", fmt::format("object {} a second time in frame {}", *kept.id, box.frame));
  boxes_.push_back(std::move(kept));
  return {};
}

void TruthBuilder::number_boxes() {
  std::map<int, int> boxes_in;
  for (TrueBox& box : boxes_)
    if (!box.is_ignored) box.id = boxes_in[box.frame]++;
}

Result<TruthClip> TruthBuilder::clip(std::string name, FramesOfImages images) {
  if (!clip_.has_ids) number_boxes();
  std::map<int, const TrueBox*> first_of;
  bool has_ignored = false;
  for (const TrueBox& box : boxes_) {
    has_ignored |= box.is_ignored;
    if (!box.is_ignored) first_of.emplace(*box.id, &box);
  }
  // What a file can make us allocate is bounded by its own size.
  const std::size_t cells = first_of.size() * clip_.times_s.size();
  if (cells > 2'000'000 + 100 * boxes_.size())
    return fail("", fmt::format("{} objects in {} frames are more than {} boxes account for", first_of.size(),
                                clip_.times_s.size(), boxes_.size()));
  std::map<int, std::size_t> place_of;
  for (const auto& [id, box] : first_of) {
    place_of[id] = clip_.targets.size();
    const bool is_one = clip_.has_ids;
    clip_.targets.push_back({.id = id, .name = is_one && !box->name.empty() ? box->name : box->category});
    clip_.targets.back().frames.resize(clip_.times_s.size(), {.distance_m = std::nan("")});
  }
  if (has_ignored) clip_.ignored.resize(clip_.times_s.size());
  for (const TrueBox& box : boxes_) {
    const auto index = static_cast<std::size_t>(box.frame - clip_.footage.first_frame);
    if (box.is_ignored) {
      clip_.ignored[index].push_back(box.box);
      continue;
    }
    clip_.targets[place_of[*box.id]].frames[index] = {.visible = box.box,
                                                      .amodal_box = box.amodal_box,
                                                      .visible_fraction = box.visible_fraction,
                                                      .distance_m = box.distance_m,
                                                      .horizon = box.horizon,
                                                      .rms_contrast = box.rms_contrast};
  }
  return TruthClip{.name = std::move(name),
                   .truth = std::move(clip_),
                   .images = std::move(images),
                   .categories = std::move(categories_)};
}

void add_short_names(FramesOfImages& images) {
  std::map<std::string, int, std::less<>> uses;
  for (const auto& [name, frame] : images.by_name) ++uses[std::string(stem_of_image(name))];
  const std::map<std::string, int, std::less<>> full = images.by_name;
  for (const auto& [name, frame] : full)
    if (const std::string stem(stem_of_image(name)); uses[stem] == 1) images.by_name.emplace(stem, frame);
}

Result<std::vector<int>> frames_of_images(const std::vector<std::string>& names, bool stills) {
  std::vector<int> frames;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<int> number = stills ? static_cast<int>(i) : frame_of_image(names[i]);
    if (!number)
      return fail(names[i], "has no frame number at its end, as frame_000123 has; for single images use --stills");
    if (*number > kMaxClipFrames) return fail(names[i], fmt::format("frame {} is beyond {}", *number, kMaxClipFrames));
    frames.push_back(*number);
  }
  std::vector<std::size_t> order(frames.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return frames[i]; });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const int before = frames[order[i - 1]];
    const int here = frames[order[i]];
    if (here == before)
      return fail(names[order[i]], fmt::format("has the number of {}: frame {}", names[order[i - 1]], here));
    if (here - 1 != before)
      return fail(names[order[i]], fmt::format("frame {} follows frame {}: those between are missing; images that are "
                                               "no video are read with --stills",
                                               here, before));
  }
  return frames;
}

Result<void> check_length(int frames, std::size_t boxes, const char* stated_by) {
  if (frames > 0 && static_cast<std::size_t>(frames) <= 100'000 + 1000 * boxes) return {};
  return fail("", fmt::format("{} is {}, but there are {}", stated_by, frames,
                              count_text(static_cast<std::int64_t>(boxes), "row")));
}

}  // namespace sigs
