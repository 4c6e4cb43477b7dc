// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/result.h"
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

// Writes a small file as a whole; one that exists is replaced. Errors cannot_create, write_failed.
[[nodiscard]] Result<void> write_text_file(const std::filesystem::path& path, std::string_view text);

// Creates a folder and those above it; no error where it exists. Error cannot_create.
[[nodiscard]] Result<void> make_inner_folder(const std::filesystem::path& folder);

// Gives the file `from` a second name `to`, which takes no space (a hard link); where the file system cannot, copies
// it. Error write_failed: `to` exists, `from` or the folder of `to` does not, or the disk is full.
[[nodiscard]] Result<void> link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

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

}  // namespace sigs
