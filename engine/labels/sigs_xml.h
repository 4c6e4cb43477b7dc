// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/result.h"
#include "labels/labels.h"
#include "labels/text_file.h"
#include "truth/annotation.h"

namespace sigs {

// The truth of one frame as an element of the file, indented, with its line end.
[[nodiscard]] std::string xml_of(const FrameTruth& truth);

// Writes a SIGS annotation file (docs/annotation-format.md, docs/sigs-annotations.xsd) frame by frame: memory does not
// grow with the video.
class SigsXmlWriter {
 public:
  // Error cannot_create. path is the place to write to; the caller gives it its final name.
  [[nodiscard]] static Result<SigsXmlWriter> open(const std::filesystem::path& path, const FootageTruth& footage);

  // Error write_failed.
  [[nodiscard]] Result<void> write(const FrameTruth& truth);
  [[nodiscard]] Result<void> finish();

 private:
  explicit SigsXmlWriter(TextFile file) : file_(std::move(file)) {}

  TextFile file_;
};

// The same as one of the label formats.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_sigs_xml(const std::filesystem::path& path,
                                                                 const LabelSequence& sequence);

}  // namespace sigs
