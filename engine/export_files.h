// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "annotation/labels.h"
#include "base/partial_file.h"
#include "export.h"
#include "export_writer.h"
#include "frame.h"

namespace sigs {

// The files of one export, written frame by frame: each video on a thread of its own, the labels on the caller's.
class ExportFiles {
 public:
  [[nodiscard]] static Result<ExportFiles> open(const ExportRequest& request, const VideoInfo& footage,
                                                const Scene& scene, const FrameRange& range);

  // Frames in order. An error is that of the first frame that could not be written, which may be an earlier one.
  [[nodiscard]] Result<void> write(ComposedFrame frame);

  // Waits until everything handed over is written. Error: that of the first frame that could not be.
  [[nodiscard]] Result<void> settle();

  // Completes all of them, then gives them their final names. Returns those.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> keep();

  // Seconds spent encoding and writing, added up over the outputs. Call it after settle() or keep().
  [[nodiscard]] double spent_s() const;

 private:
  ExportFiles() = default;

  // A file or, for numbered pictures, a folder.
  struct Video {
    PartialFile file;
    std::unique_ptr<WriterThread> writer;
  };
  // Likewise.
  struct Labels {
    PartialFile file;
    std::unique_ptr<LabelWriter> writer;
    std::optional<FrameFailure> failure{};
  };
  [[nodiscard]] static Result<Video> open_video(const std::filesystem::path& path, const VideoFormat& format,
                                                bool overwrite);
  [[nodiscard]] static Result<Labels> open_labels(const std::filesystem::path& path, const LabelFormat& format,
                                                  const LabelSequence& sequence, bool overwrite);
  [[nodiscard]] bool write_labels(const FrameTruth& truth);
  [[nodiscard]] Result<void> finish();

  std::optional<Video> video_;
  std::optional<Video> masks_;
  std::vector<Labels> labels_;
  std::filesystem::path pictures_;  // where numbered pictures are written to; empty: a video is
};

}  // namespace sigs
