// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "evaluation/readers/results.h"

namespace sigs {

// The readers of the layouts of results, one function for each, which read_results() (results.cpp) chooses from. They
// give every box to a ResultsBuilder. docs/evaluation-reference.md defines the layouts.

// A file of results that is being read.
struct ResultsFile {
  std::filesystem::path path;  // for messages
  std::string text;            // all of it
  FootageTruth clip;           // that it is about
  ResultsOptions options;

  // Error bad_data: "scores.txt: line 12: what". line counts from 1.
  [[nodiscard]] tl::unexpected<Error> wrong(int line, const std::string& what) const;
};

// Subtracted from a layout's x, these give the left edge of a Box (base/image.h); likewise for y.
inline constexpr double kEdgeFrom0 = 0.5;  // x is the first column of the box, counted from 0
inline constexpr double kEdgeFrom1 = 1.5;  // ... counted from 1

// Collects the boxes of a file and checks each of them, whatever its layout.
class ResultsBuilder {
 public:
  explicit ResultsBuilder(const ResultsFile& file) : ResultsBuilder(file, file.clip.first_frame) {}

  // first_number: the file's number of the clip's first frame, for messages.
  ResultsBuilder(const ResultsFile& file, int first_number) : file_(file), first_number_(first_number) {}

  // Adds a box. frame: the footage's number. Error bad_data: numbers that are NaN, infinite or beyond a billion pixels,
  // no area, a frame outside the clip, a second box or a second use of a track id in the frame.
  [[nodiscard]] Result<void> add(int frame, const ReportedBox& reported);

  // The frame's box was given to the tracker (Results::initializations).
  void mark_initialization(int frame) { results_.initializations.insert(frame); }

  // What was added; call it once, at the end.
  [[nodiscard]] Results results() { return std::move(results_); }

 private:
  [[nodiscard]] Result<void> check_box(const ReportedBox& reported) const;
  [[nodiscard]] Result<void> check_place(int frame, const ReportedBox& reported) const;

  [[nodiscard]] std::string frame_text(int frame) const;

  const ResultsFile& file_;
  int first_number_ = 0;
  Results results_;
};

// "frames 0 to 99"
[[nodiscard]] std::string frames_text(const FootageTruth& clip);

// Which layout a file in JSON has (aot or coco), judged by the keys of its first entry; aot for an empty list, which is
// valid in both. Error bad_data: the entry has the keys of neither.
[[nodiscard]] Result<ResultsFormat> json_format(const ResultsFile& file);

// An image's name without folder and extension.
[[nodiscard]] std::string_view stem_of_image(std::string_view image);

// The frame number at the end of an image's name without extension: 123 of "flight/frame_000123.png". nullopt: there
// are no digits, or more than an int has.
[[nodiscard]] std::optional<int> frame_of_image(std::string_view image);

// One reader for each layout. Error bad_data names file and line.
[[nodiscard]] Result<Results> read_otb(const ResultsFile& file);
[[nodiscard]] Result<Results> read_vot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_mot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_csv(const ResultsFile& file);
[[nodiscard]] Result<Results> read_aot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_coco(const ResultsFile& file);

}  // namespace sigs
