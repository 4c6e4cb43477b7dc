// SPDX-License-Identifier: MIT
#include "labels/numbered_images.h"

#include <string>

#include "labels/hard_link.h"
#include "labels/labels.h"
#include "labels/text_file.h"

namespace sigs {

namespace {

std::string padded(int number, int digits) {
  const std::string text = std::to_string(number);
  const auto wanted = static_cast<std::size_t>(digits);
  return std::string(text.size() < wanted ? wanted - text.size() : 0, '0') + text;
}

}  // namespace

Result<void> link_numbered_images(const std::filesystem::path& images, const FootageTruth& footage,
                                  const std::filesystem::path& folder, ImageNumbers numbers) {
  if (images.empty()) return {};
  if (const Result<void> made = make_inner_folder(folder); !made) return made;
  for (int frame = footage.first_frame; frame <= footage.last_frame; ++frame) {
    const int number = frame - footage.first_frame + numbers.first;
    const std::filesystem::path name = folder / (padded(number, numbers.digits) + ".png");
    if (const Result<void> linked = link_or_copy(images / image_name(frame), name); !linked) return linked;
  }
  return {};
}

}  // namespace sigs
