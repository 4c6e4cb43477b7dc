// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "labels/labels.h"

namespace sigs::test::labels {

// A clip of 640x480, frames first to last of its footage at 25 a second, with intruders 0, 1, ... of the categories
// given.
[[nodiscard]] LabelSequence synthetic_sequence(int first, int last, const std::vector<std::string>& categories);

// An intruder that is wholly visible in a box, 100 m ahead.
[[nodiscard]] IntruderTruth visible_intruder(int id, const cv::Rect& box);

// The same with a value of its own for each number that can be told of it; two volumes, "dwc-en-route" and "nmac".
[[nodiscard]] IntruderTruth full_truth(int id);

// One that is not visible.
[[nodiscard]] IntruderTruth invisible_intruder(int id);

[[nodiscard]] FrameTruth frame_of(int index, std::vector<IntruderTruth> intruders);

// Writes labels as an export does: at an empty file or folder, all frames, then the end.
//   images  as LabelWriter::finish takes it
void write_labels(const std::string& format, const std::filesystem::path& path, const LabelSequence& clip,
                  const std::vector<FrameTruth>& frames, const std::filesystem::path& images = {});

// Makes a folder with an image of each frame of the clip, called as an export calls them. Each holds its number.
void write_synthetic_images(const std::filesystem::path& folder, const LabelSequence& clip);

// The lines of a file, without their ends; the last must have one.
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& path);

// The parts between separators, as many as there are plus one.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& text, char separator);

// A sequence of images of 64 x 48 px, frames 100 to `last` at 30000/1001 a second, called "crossing", with two
// intruders: 0, an "airplane", and 1, a "glider".
[[nodiscard]] LabelSequence label_sequence(int last = 100);

// Frames from 100 on.
[[nodiscard]] std::vector<FrameTruth> frames_of(const std::vector<std::vector<IntruderTruth>>& intruders);

// Names that formats have to quote or escape, in UTF-8.
[[nodiscard]] std::vector<std::string> special_names();

}  // namespace sigs::test::labels
