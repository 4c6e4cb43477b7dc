// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/output_stream.h"
#include "base/result.h"
#include "labels/labels.h"

namespace sigs {

// The truth of one frame as one JSON object on a line of its own, with its line break. Fields and numbers are those of
// the element <frame> of a SIGS annotation file (labels/sigs_xml.h); docs/label-formats.md lists them.
[[nodiscard]] std::string json_line_of(const FrameTruth& truth, const LabelSequence& sequence);

// Writes each line to a stream at once, for programs that read while the frames are made. open_jsonl()
// (labels/formats.h) writes the same to a file.
class JsonLinesStream : public LabelWriter {
 public:
  JsonLinesStream(OutputStream out, LabelSequence sequence) : out_(std::move(out)), sequence_(std::move(sequence)) {}

  // Errors: write_failed (also where the reader has closed its end), interrupted.
  [[nodiscard]] Result<void> write(const FrameTruth& truth) override {
    return out_.write(json_line_of(truth, sequence_));
  }
  [[nodiscard]] Result<void> finish(const std::filesystem::path& /*images*/) override { return out_.close(); }

 private:
  OutputStream out_;
  LabelSequence sequence_;
};

}  // namespace sigs
