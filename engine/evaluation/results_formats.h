// SPDX-License-Identifier: MIT
#pragma once

// How results.cpp reads each layout; docs/evaluation.md defines them.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "evaluation/results.h"

namespace sigs {

// One file on its way in.
struct ResultsFile {
  std::filesystem::path path;
  std::string text;
  FootageTruth clip;
  ResultsOptions options;

  // "scores.txt: line 12: what"
  [[nodiscard]] tl::unexpected<Error> wrong(int line, const std::string& what) const;
};

// Where a layout counts pixels from: its x, less this, is the left edge of base/image.h.
inline constexpr double kEdgeFrom0 = 0.5;  // x is the first column, counted from 0
inline constexpr double kEdgeFrom1 = 1.5;  // ... from 1

// Takes boxes in and looks at each, whatever the layout.
class ResultsBuilder {
 public:
  explicit ResultsBuilder(const ResultsFile& file) : ResultsBuilder(file, file.clip.first_frame) {}
  // first_number: what the file calls the clip's first frame, for messages.
  ResultsBuilder(const ResultsFile& file, int first_number) : file_(file), first_number_(first_number) {}

  // frame: the footage's number.
  [[nodiscard]] Result<void> add(int frame, const ReportedBox& reported);
  void mark_initialization(int frame) { results_.initializations.insert(frame); }

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

// Frame number at the end of an image's name without extension: "flight/frame_000123.png" is 123.
[[nodiscard]] std::optional<int> frame_of_image(std::string_view image);

// The folder that an image lies in: of "flights/one/frame_000123.png" it is "one"; empty: it says none.
[[nodiscard]] std::string folder_of_image(const std::string& image);

// Which of the layouts in JSON a text has: told by the first entry's keys. An empty list is both; aot is said.
// Error bad_data: its entries have the keys of neither.
[[nodiscard]] Result<ResultsFormat> json_format(const ResultsFile& file);

[[nodiscard]] Result<Results> read_otb(const ResultsFile& file);
[[nodiscard]] Result<Results> read_vot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_mot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_csv(const ResultsFile& file);
[[nodiscard]] Result<Results> read_aot(const ResultsFile& file);
[[nodiscard]] Result<Results> read_coco(const ResultsFile& file);

}  // namespace sigs
