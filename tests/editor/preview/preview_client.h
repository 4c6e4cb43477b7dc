// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>

#include "editor/preview/preview_state.h"
#include "project/project.h"

namespace sigs::test {

// The window's part in previewing: requests, sleeps until it is woken, reads the state.
class PreviewClient {
 public:
  explicit PreviewClient(editor::PreviewLimits limits = {});

  void want(const editor::PreviewRequest& wanted) { previewer_.want(wanted); }
  [[nodiscard]] editor::PreviewOutput shown() const { return previewer_.shown(); }
  void set_prefetch_paused(bool paused) { previewer_.set_prefetch_paused(paused); }

  // Sleeps until there is something of that kind to show. Fails the test after five minutes.
  editor::PreviewOutput wait(const std::function<bool(const editor::PreviewOutput&)>& is_there);

  // Asks and waits for the image that was asked for.
  editor::PreviewOutput show(const editor::PreviewRequest& wanted);

 private:
  std::mutex mutex_;
  std::condition_variable woken_;
  unsigned long calls_ = 0;
  editor::Previewer previewer_;
};

// A sample project, and any project as a revision with a number.
[[nodiscard]] Project sample(const std::string& name);
[[nodiscard]] editor::Revision revision(std::uint64_t number, Project project);

// A frame of a project whose footage has 200.
[[nodiscard]] editor::PreviewRequest frame_of(editor::Revision revision, int frame);

[[nodiscard]] bool is_current(const editor::PreviewOutput& shown);
[[nodiscard]] bool is_same_image(const cv::Mat& a, const cv::Mat& b);

}  // namespace sigs::test
