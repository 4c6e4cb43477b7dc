// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "labels/labels.h"

namespace sigs {

// COCO instances JSON (https://cocodataset.org/#format-data), with the lists of videos and tracks that TAO and
// YouTube-VIS add. docs/label-formats.md.
// - bbox: [x, y, width, height]; the left upper corner of the first pixel is (0, 0). area: pixels.
// - segmentation: compressed RLE of the whole image.
// - ids count from 1 (pycocotools takes an annotation of id 0 for none), but track_id is the intruder's, from 0.
// - the own body: in each image, an annotation of iscrowd 1 for each of its parts and for each category, since
//   pycocotools forgives a detection in a crowd region only where both are of one category.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_coco(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
