// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "annotation/sigs_xml.h"
#include "base/partial_file.h"
#include "export.h"
#include "frame.h"
#include "video/video_writer.h"

namespace sigs {

// The files of one export, written frame by frame.
class ExportFiles {
 public:
  [[nodiscard]] static Result<ExportFiles> open(const ExportRequest& request, const VideoInfo& footage,
                                                const FrameRange& range);

  [[nodiscard]] Result<void> write(const ComposedFrame& frame);

  // Completes all of them, then gives them their final names. Returns those.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> keep();

 private:
  ExportFiles() = default;

  // A file or, for numbered pictures, a folder.
  struct Video {
    PartialFile file;
    VideoWriter writer;
  };
  struct Labels {
    PartialFile file;
    SigsXmlWriter writer;
  };
  [[nodiscard]] static Result<Video> open_video(const std::filesystem::path& path, const VideoFormat& format,
                                                bool overwrite);
  [[nodiscard]] static Result<Labels> open_labels(const std::filesystem::path& path, const FootageTruth& footage,
                                                  bool overwrite);
  [[nodiscard]] Result<void> finish();

  std::optional<Video> video_;
  std::optional<Video> masks_;
  std::optional<Labels> labels_;
};

}  // namespace sigs
