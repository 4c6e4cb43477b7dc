// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "labels/labels.h"
#include "truth/annotation.h"

namespace sigs {

// The files and folders of a set of labels. They are written below a temporary path that the caller gives its final
// name (base/staged_outputs.h). Errors name the file.

// A text file that is written piece by piece, so that memory does not grow with the video.
class TextFile {
 public:
  // Creates the file; one that exists is emptied. Error cannot_create.
  [[nodiscard]] static Result<TextFile> create(std::filesystem::path path);

  // Appends the text. Error write_failed.
  [[nodiscard]] Result<void> put(std::string_view text);

  // Writes what is still buffered. Error write_failed, as when the disk is full.
  [[nodiscard]] Result<void> close();

 private:
  TextFile(std::filesystem::path path, std::ofstream out);

  std::filesystem::path path_;
  std::ofstream out_;
};

// Labels that are one text file. `begin` writes what comes before the first frame, `finish` what comes after the last.
class OneFileLabels : public LabelWriter {
 public:
  OneFileLabels(TextFile file, const LabelSequence& sequence) : file_(std::move(file)), sequence_(sequence) {}
  [[nodiscard]] virtual Result<void> begin() { return {}; }
  Result<void> finish(const std::filesystem::path& /*images*/) override { return file_.close(); }

 protected:
  TextFile file_;
  LabelSequence sequence_;
};

template <class Labels>
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> begun_file(const std::filesystem::path& path,
                                                              const LabelSequence& sequence) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  auto labels = std::make_unique<Labels>(std::move(*file), sequence);
  if (const Result<void> begun = labels->begin(); !begun) return fail(begun.error());
  return labels;
}

// Writes a small file as a whole; one that exists is replaced. Errors cannot_create, write_failed.
[[nodiscard]] Result<void> write_text_file(const std::filesystem::path& path, std::string_view text);

// Creates a folder and those above it; no error where it exists. Error cannot_create.
[[nodiscard]] Result<void> make_inner_folder(const std::filesystem::path& folder);

// Gives the file `from` a second name `to`, which takes no space (a hard link); where the file system cannot, copies
// it. Error write_failed: `to` exists, `from` or the folder of `to` does not, or the disk is full.
[[nodiscard]] Result<void> link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

// Links images of a folder into another one, which is created, under their own names.
//   images  Empty: there are none, nothing is done
// Errors cannot_create, write_failed.
[[nodiscard]] Result<void> link_images(const std::filesystem::path& images,
                                       const std::vector<std::filesystem::path>& names,
                                       const std::filesystem::path& folder);

// How a format names the images of a sequence: 000001.png, 000002.png, ...
struct ImageNumbers {
  int first = 0;                        // number of the sequence's first image
  int digits = 6;                       // minimum number of digits, filled with zeros at the front
  std::string_view extension = ".png";  // LabelSequence::image_extension
};

// Links the images of all frames of the footage's range into a folder, which is created, under numbered names.
//   images  folder with the images, named by image_name() (labels/labels.h). Empty: there are none, nothing is done
// Errors cannot_create, write_failed.
[[nodiscard]] Result<void> link_numbered_images(const std::filesystem::path& images, const FootageTruth& footage,
                                                const std::filesystem::path& folder, ImageNumbers numbers);

// Masks as label formats describe them: the own body as regions to ignore, and run lengths. Boxes are boxes of whole
// pixels; the first pixel is (0, 0).

// A connected component of the own body (8-connected).
struct OwnBodyPart {
  cv::Rect box;    // around it
  cv::Mat mask;    // CV_8UC1 of box's size: 255 where it is, else 0
  int pixels = 0;  // how many it has
};

// The connected components of the pixels where the own body hides at least half of what is behind it: the boxes of a
// left and a right wing do not cover the sky between them. Largest first. Components smaller than a ten thousandth of
// the image are left out.
//   own_body  CV_32FC1, 0 to 1, as LabelSequence::own_body. Empty: no parts
[[nodiscard]] std::vector<OwnBodyPart> own_body_parts(const cv::Mat& own_body);

// Boxes that together cover the own body, for formats whose regions to ignore are boxes. A box of which the body fills
// less than three quarters is split in two halves across its longer side, down to a sixteenth of the image's longer
// side, so that a thin diagonal strut does not exclude half of the image. Every pixel of the body lies in exactly one
// box, and each box is the smallest around the pixels in it.
//   mask  CV_32FC1, as LabelSequence::own_body; body where it is 0.5 or more. Empty: no boxes
[[nodiscard]] std::vector<cv::Rect> own_body_boxes(const cv::Mat& mask);

// Run lengths of a mask in COCO's order: down each column, columns from left to right. Runs of pixels that are off and
// on alternate; the first is of pixels that are off and may have length 0. Their sum is the number of pixels of the
// image.
//   mask   CV_8UC1 of box's size; on where it is not 0
//   box    where the mask lies, within the image; all pixels outside it are off
//   image  size of the image, of fewer than 2^32 pixels
[[nodiscard]] std::vector<std::uint32_t> column_runs(const cv::Mat& mask, const cv::Rect& box, cv::Size image);

// Run lengths as the string that COCO's API calls a compressed RLE (maskApi.c, rleToString). From the fourth run on,
// the difference to the run before the previous one is written. A number has five bits in each character, lowest first;
// a sixth bit says that more follow, and the highest of the last five is the sign. '0' is added to each character.
[[nodiscard]] std::string coco_counts(std::span<const std::uint32_t> runs);

}  // namespace sigs
