// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "project/project.h"
#include "truth/annotation.h"
#include "video/frame_source.h"

namespace sigs {

// One composed frame for callers that process it rather than write it.
struct StreamFrame {
  cv::Mat image;  // CV_8UC3, BGR
  FrameTruth truth;
};

// The frames that an export of a project would write, in order, without writing them.
class FrameStream {
 public:
  // Checks the project and opens what it names. frames: none: the project's own range; numbers are the footage's.
  //   cancel  set: opening and composing end soon with the error interrupted; null, or outlives the stream
  // Errors as export_project's.
  [[nodiscard]] static Result<FrameStream> open(const Project& project, const std::optional<FrameRange>& frames = {},
                                                const std::atomic<bool>* cancel = nullptr);
  FrameStream(FrameStream&&) noexcept;
  FrameStream& operator=(FrameStream&&) noexcept;
  ~FrameStream();

  // As in a label file of that export.
  [[nodiscard]] const FootageTruth& footage() const;
  [[nodiscard]] const std::vector<Warning>& warnings() const;

  // Composes `jobs` frames in parallel and passes each to `see`, on the calling thread. Ends early where that returns
  // an error, and returns it. Returns how many frames of the footage were damaged.
  [[nodiscard]] Result<int> show(int jobs, const std::function<Result<void>(const StreamFrame&)>& see);

 private:
  struct Inside;
  explicit FrameStream(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

// The footage's properties in the labels of these frames.
[[nodiscard]] FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range);

}  // namespace sigs
