// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "annotation/labels.h"

namespace sigs::test::labels {

// A film of 640x480, frames first to last of its footage at 25 a second, with intruders 0, 1, ... of the categories
// given.
[[nodiscard]] LabelSequence label_film(int first, int last, const std::vector<std::string>& categories);

// An intruder that shows in a box, the whole of it visible, 100 m ahead.
[[nodiscard]] IntruderTruth seen(int id, const cv::Rect& box);

// One that does not.
[[nodiscard]] IntruderTruth unseen(int id);

[[nodiscard]] FrameTruth frame_of(int index, std::vector<IntruderTruth> intruders);

// Writes labels as an export does: at an empty file or folder, all frames, then the end.
//   pictures  as LabelWriter::finish takes it
void write_labels(const std::string& format, const std::filesystem::path& path, const LabelSequence& film,
                  const std::vector<FrameTruth>& frames, const std::filesystem::path& pictures = {});

// Makes a folder with a picture of each frame of the film, called as an export calls them. Each holds its number.
void make_pictures(const std::filesystem::path& folder, const LabelSequence& film);

// The whole of a file, which must be there.
[[nodiscard]] std::string text_of(const std::filesystem::path& path);

// Its lines, without their ends; the last must have one.
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& path);

// The parts between separators, as many as there are plus one.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& text, char separator);

// Every file below a folder, by its path from there, in order.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace sigs::test::labels
