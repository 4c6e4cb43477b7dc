// SPDX-License-Identifier: MIT
#include "preview_client.h"

#include <doctest/doctest.h>

#include <chrono>
#include <stdexcept>

#include "project/json.h"
#include "support/test_data.h"

namespace sigs::test {

PreviewClient::PreviewClient(editor::PreviewLimits limits)
    : previewer_(limits, [this] {
        const std::lock_guard lock(mutex_);
        ++calls_;
        woken_.notify_all();
      }) {}

// Only when woken: a result without a notification is never observed.
editor::PreviewOutput PreviewClient::wait(const std::function<bool(const editor::PreviewOutput&)>& is_there) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  std::unique_lock lock(mutex_);
  while (true) {
    const unsigned long observed = calls_;
    editor::PreviewOutput shown = previewer_.shown();
    if (is_there(shown)) return shown;
    if (!woken_.wait_until(lock, end, [&] { return calls_ != observed; })) throw std::runtime_error("nothing came");
  }
}

editor::PreviewOutput PreviewClient::show(const editor::PreviewRequest& wanted) {
  want(wanted);
  return wait(is_current);
}

Project sample(const std::string& name) {
  return read_project(source_dir() / "projects" / name / (name + ".json")).value().project;
}

editor::Revision revision(std::uint64_t number, Project project) {
  return {number, std::make_shared<const Project>(std::move(project))};
}

editor::PreviewRequest frame_of(editor::Revision revision, int frame) {
  return {.revision = std::move(revision), .frame = frame, .range_first = 0, .range_last = 199};
}

bool is_current(const editor::PreviewOutput& shown) {
  return shown.image_is_current;
}

bool is_same_image(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace sigs::test
