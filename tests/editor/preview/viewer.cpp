// SPDX-License-Identifier: MIT
#include "viewer.h"

#include <doctest/doctest.h>

#include <chrono>
#include <stdexcept>

#include "project/json.h"
#include "support/test_data.h"

namespace sigs::test {

Viewer::Viewer(editor::PreviewLimits limits)
    : previewer_(limits, [this] {
        const std::lock_guard lock(mutex_);
        ++calls_;
        woken_.notify_all();
      }) {}

// By being woken alone: what was put down without a call is never seen.
editor::Shown Viewer::wait(const std::function<bool(const editor::Shown&)>& is_there) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  std::unique_lock lock(mutex_);
  while (true) {
    const unsigned long seen = calls_;
    editor::Shown shown = previewer_.shown();
    if (is_there(shown)) return shown;
    if (!woken_.wait_until(lock, end, [&] { return calls_ != seen; })) throw std::runtime_error("nothing came");
  }
}

editor::Shown Viewer::show(const editor::Wanted& wanted) {
  want(wanted);
  return wait(is_current);
}

Project sample(const std::string& name) {
  return read_project(source_dir() / "projects" / name / (name + ".json")).value().project;
}

editor::Revision revision(std::uint64_t number, Project project) {
  return {number, std::make_shared<const Project>(std::move(project))};
}

bool is_current(const editor::Shown& shown) {
  return shown.picture_is_current;
}

bool is_same_picture(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace sigs::test
