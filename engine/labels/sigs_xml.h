// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "base/result.h"
#include "labels/label_files.h"
#include "truth/annotation.h"

namespace sigs {

// Positions are in metres, angles in degrees, boxes in pixels with the first pixel at 0, 0. Numbers have up to six
// digits after the point, those of an amodal box up to four.

// The truth of one frame as the element <frame> of a SIGS annotation file, indented, with a line break at its end.
[[nodiscard]] std::string xml_of(const FrameTruth& truth);

// Writes a SIGS annotation file (docs/annotation-format.md, docs/sigs-annotations.xsd) frame by frame, so that memory
// does not grow with the video. open_sigs_xml() (labels/formats.h) is the same as one of the label formats.
class SigsXmlWriter {
 public:
  // Creates the file and writes its beginning. The caller gives it its final name when it is complete. Errors
  // cannot_create, write_failed.
  [[nodiscard]] static Result<SigsXmlWriter> open(const std::filesystem::path& path, const FootageTruth& footage);

  // Appends the next frame; finish() closes the document and the file. Errors write_failed.
  [[nodiscard]] Result<void> write(const FrameTruth& truth);
  [[nodiscard]] Result<void> finish();

 private:
  explicit SigsXmlWriter(TextFile file) : file_(std::move(file)) {}

  TextFile file_;
};

}  // namespace sigs
