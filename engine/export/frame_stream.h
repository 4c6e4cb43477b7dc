// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "frame/composed_frame.h"
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

  // The frames, and the footage's properties as in a label file of that export.
  [[nodiscard]] const FrameRange& range() const;
  [[nodiscard]] const FootageTruth& footage() const;
  [[nodiscard]] const std::vector<Warning>& warnings() const;

  // Begins to compose `jobs` frames in parallel, from the first one on, some frames ahead of next(). To be called
  // before next(); not together with show().
  void start(int jobs);

  // The next frame, in the footage's planes, with mask and truth; waits for it. None after the last one, which also
  // ends the threads. Not to be called after an error.
  [[nodiscard]] Result<std::optional<ComposedFrame>> next();

  // Composes `jobs` frames in parallel and passes each to `see`, on the calling thread. Ends early where that returns
  // an error, and returns it. Returns how many frames of the footage were damaged.
  [[nodiscard]] Result<int> show(int jobs, const std::function<Result<void>(const StreamFrame&)>& see);

 private:
  struct Inside;
  explicit FrameStream(std::unique_ptr<Inside> inside);
  [[nodiscard]] Result<int> show_all(const std::function<Result<void>(const StreamFrame&)>& see);
  std::unique_ptr<Inside> inside_;
};

// The footage's properties in the labels of these frames.
[[nodiscard]] FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range);

}  // namespace sigs
