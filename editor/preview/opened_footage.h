// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "editor/preview/previewer.h"
#include "project/project.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs::editor {

// A video, or why there is none. Without one the footage has no shape yet: that depends on the project.
struct OpenedFootage {
  std::unique_ptr<FrameSource> source;  // null: could not be opened
  std::shared_ptr<const Footage> footage;
};
[[nodiscard]] OpenedFootage opened_footage(const std::filesystem::path& video);

// The footage itself where it is a video, else the grey frames that replace it in this project.
[[nodiscard]] std::shared_ptr<const Footage> footage_for(const Project& project,
                                                         const std::shared_ptr<const Footage>& footage);

// A frame of placeholder footage: 4:2:0, limited range, every sample 128.
[[nodiscard]] Frame grey_frame(const FootageShape& footage, int frame);

}  // namespace sigs::editor
