// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "editor/preview/previewer.h"
#include "evaluation/clip_truth.h"

namespace sigs::editor {

// What result files of this scene's footage count in.
[[nodiscard]] FootageTruth footage_truth_of(const OpenedScene& scene);

// The footage's truth as far as it is known without drawing: by the outlines of the surveys, one for each of the
// project's intruders. Boxes are within a pixel or so of those that are measured in drawn frames; what stands behind
// the own body in part counts as seen whole. Null where a survey is missing or not complete.
[[nodiscard]] std::shared_ptr<const ClipTruth> outline_truth(const OpenedScene& scene,
                                                             const std::vector<std::shared_ptr<const Survey>>& surveys);

}  // namespace sigs::editor
