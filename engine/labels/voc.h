// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

inline constexpr std::array<std::string_view, 4> kVocFiles{"Annotations/frame_#.xml", "ImageSets/Main/*train.txt",
                                                           "ImageSets/Main/*val.txt", "JPEGImages/frame_#.png"};

// Pascal VOC folder (http://host.robots.ox.ac.uk/pascal/VOC/voc2012). docs/label-formats.md.
//   Annotations/frame_000123.xml  the first pixel is (1, 1), xmax and ymax belong to the box
//   ImageSets/Main/               train and trainval list all images, val none; the same for each category with 1
//   where
//                                 an image shows it, 0 where all it shows of it is difficult, -1 else
//   JPEGImages/frame_000123.png   where images are written; PNG all the same, as `filename` says
// The flags follow VOC's annotation guidelines:
//   truncated  more than 15 % of it lies beyond the image
//   occluded   more than 5 % of what lies in the image is hidden
//   difficult  less than 20 % of it can be seen; VOC's evaluation then neither asks for it nor holds it against a
//   detector
// <trackid>, as in ImageNet VID, is the intruder's id.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_voc(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
