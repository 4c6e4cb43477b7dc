// SPDX-License-Identifier: MIT
#include "evaluation/readers/truth_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "evaluation/readers/truth_builder.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// Whether a JSON file begins as one with a key of this name would: the first keys of its outermost object. A whole
// parse would be made twice.
bool has_outer_key(const std::string& text, std::string_view key) {
  int depth = 0;
  bool in_string = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (in_string) {
      if (letter == '\\') ++i;
      if (letter != '"') continue;
      in_string = false;
      if (depth != 1 || std::string_view(text).substr(begin, i - begin) != key) continue;
      // A value has no colon behind it.
      const std::size_t next = text.find_first_not_of(" \t\r\n", i + 1);
      if (next != std::string::npos && text[next] == ':') return true;
    } else if (letter == '"') {
      in_string = true;
      begin = i + 1;
    } else if (letter == '{' || letter == '[') {
      ++depth;
    } else if (letter == '}' || letter == ']') {
      --depth;
    }
  }
  return false;
}

Result<std::vector<TruthClip>> read_json(const fs::path& path, const TruthOptions& options) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  if (has_outer_key(*text, "samples")) return read_aot_clips(path, options);
  if (has_outer_key(*text, "images")) return read_coco_clips(path, options);
  return fail(path.string(),
              "is not labels (.xml); of a project sigs export makes them. As another program's truth it has neither "
              "\"samples\" (aot) nor \"images\" and \"annotations\" (coco)",
              ErrorKind::usage);
}

Result<void> check_classes(const fs::path& path, const TruthOptions& options, const std::vector<TruthClip>& clips) {
  std::set<std::string> there;
  for (const TruthClip& clip : clips) there.insert(clip.categories.begin(), clip.categories.end());
  for (const std::string& name : options.classes)
    if (!there.contains(name))
      return fail(path.string(),
                  fmt::format("no box is of class {}; there are: {}", name, there.empty() ? "none" : listed(there)));
  return {};
}

}  // namespace

Result<std::vector<TruthClip>> read_truth_clips(const fs::path& path, const TruthOptions& options) {
  Result<std::vector<TruthClip>> clips = std::vector<TruthClip>();
  if (!is_folder(path))
    clips = read_json(path, options);
  else if (!mot_sequences_in(path).empty())
    clips = read_mot_clips(path, options);
  else if (is_folder(path / "labels"))
    clips = read_yolo_clips(path, options);
  else
    clips = fail(path.string(),
                 "is no truth: it has neither gt/gt.txt (mot) nor labels/ (yolo), and no index.json as a dataset has; "
                 "of other labels of SIGS name the file .xml");
  if (!clips) return clips;
  if (const Result<void> good = check_classes(path, options, *clips); !good) return fail(good.error());
  std::ranges::stable_sort(*clips, {}, &TruthClip::name);
  return clips;
}

Result<std::vector<Results>> read_shared_results(const fs::path& path, const std::vector<const TruthClip*>& clips,
                                                 ResultsFormat format) {
  // All clips one behind the other as if they were one.
  FramesOfImages images;
  std::set<std::string, std::less<>> ambiguous;
  std::vector<int> begins{0};
  std::int64_t total = 0;
  for (const TruthClip* const clip : clips) {
    const int offset = begins.back() - clip->truth.footage.first_frame;
    for (const auto& [name, frame] : clip->images.by_name)
      if (!images.by_name.emplace(name, frame + offset).second) ambiguous.insert(name);
    for (const auto& [id, frame] : clip->images.by_id) images.by_id.emplace(id, frame + offset);
    total += clip->truth.frames();
    if (total > 1'000'000'000) return fail(path.string(), "is of more than 1e9 frames");
    begins.push_back(static_cast<int>(total));
  }
  for (const std::string& name : ambiguous) images.by_name.erase(name);
  const FootageTruth whole{.first_frame = 0, .last_frame = static_cast<int>(total) - 1};
  const Result<Results> all = read_results(
      path, whole,
      {.format = format, .multiple_per_frame = true, .last_image_id = whole.last_frame + 1, .images = &images});
  if (!all) return fail(all.error());
  std::vector<Results> parts(clips.size(), Results{.name = all->name});
  parts.front().boxes_elsewhere = all->boxes_elsewhere;
  for (const auto& [frame, boxes] : all->frames) {
    const auto clip = static_cast<std::size_t>(std::ranges::upper_bound(begins, frame) - begins.begin()) - 1;
    parts[clip].frames[frame - begins[clip] + clips[clip]->truth.footage.first_frame] = boxes;
  }
  return parts;
}

}  // namespace sigs
