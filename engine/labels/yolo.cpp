// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// Readers replace the last images/ of a path by labels/, so the sequence's folder must not be called that.
std::string folder_name_of(const std::string& name) {
  return name == "images" ? "images-" : name;
}

// A box along one axis, in units of the last decimal written. The rounded numbers never describe a box that leaves the
// image, which some readers check to the last digit.
struct Span {
  static constexpr int kDecimals = 8;
  static constexpr double kUnit = 1e8;
  std::int64_t centre = 0;
  std::int64_t length = 0;
};

Span span_of(int first, int count, int of) {
  const std::int64_t centre = std::llround((first + 0.5 * count) / of * Span::kUnit);
  const std::int64_t length = std::llround(double(count) / of * Span::kUnit);
  const auto whole = static_cast<std::int64_t>(Span::kUnit);
  return {centre, std::min({length, 2 * centre, 2 * (whole - centre)})};
}

std::string decimal(std::int64_t units) {
  return number_text(static_cast<double>(units) / Span::kUnit, Span::kDecimals);
}

class YoloLabels : public LabelWriter {
 public:
  YoloLabels(fs::path root, const LabelSequence& sequence)
      : root_(std::move(root)), folder_(folder_name_of(sequence.name)), sequence_(sequence) {}

  Result<void> begin() {
    if (const Result<void> created = make_inner_folder(root_ / "labels" / folder_); !created) return created;
    const std::vector<std::string>& categories = sequence_.categories;
    std::string text = "# One video: train and val are the same pictures. Point val elsewhere to measure a detector.\n";
    for (const char* const part : {"train", "val"})
      text += fmt::format("{}: {}\n", part, yaml_text("images/" + folder_));
    text += fmt::format("nc: {}\nnames:{}\n", categories.size(), categories.empty() ? " {}" : "");
    for (std::size_t i = 0; i < categories.size(); ++i) text += fmt::format("  {}: {}\n", i, yaml_text(categories[i]));
    return write_text_file(root_ / "data.yaml", text);
  }

  Result<void> write(const FrameTruth& truth) override {
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds)) text += line_of(intruder);
    images_.emplace_back(image_name(truth.index, sequence_.image_extension));
    return write_text_file(root_ / "labels" / folder_ / fs::path(images_.back()).replace_extension(".txt"), text);
  }

  Result<void> finish(const fs::path& images) override {
    return link_images(images, images_, root_ / "images" / folder_);
  }

 private:
  [[nodiscard]] std::string line_of(const IntruderTruth& intruder) const {
    const cv::Size size_px = sequence_.footage.size_px;
    const cv::Rect labelled = labelled_box(intruder, sequence_);
    const Span across = span_of(labelled.x, labelled.width, size_px.width);
    const Span down = span_of(labelled.y, labelled.height, size_px.height);
    return fmt::format("{} {} {} {} {}\n", category_index(sequence_, intruder.id), decimal(across.centre),
                       decimal(down.centre), decimal(across.length), decimal(down.length));
  }

  fs::path root_;
  std::string folder_;
  LabelSequence sequence_;
  std::vector<fs::path> images_;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_yolo(const fs::path& path, const LabelSequence& sequence) {
  auto writer = std::make_unique<YoloLabels>(path, sequence);
  if (const Result<void> begun = writer->begin(); !begun) return fail(begun.error());
  return writer;
}

}  // namespace sigs
