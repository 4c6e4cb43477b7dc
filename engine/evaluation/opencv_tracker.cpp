// SPDX-License-Identifier: MIT
#include "evaluation/opencv_tracker.h"

namespace sigs {

struct OpenCvTracker::Inside {
  Results results;
};

OpenCvTracker::OpenCvTracker(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
OpenCvTracker::OpenCvTracker(OpenCvTracker&&) noexcept = default;
OpenCvTracker& OpenCvTracker::operator=(OpenCvTracker&&) noexcept = default;
OpenCvTracker::~OpenCvTracker() = default;

std::span<const std::string_view> tracker_names() {
  return {};
}

Result<OpenCvTracker> OpenCvTracker::make(std::string_view name) {
  return fail(std::string(name), "not yet", ErrorKind::unavailable);
}

Result<void> OpenCvTracker::start(int, const cv::Mat&, const Box&) {
  return {};
}

Result<void> OpenCvTracker::follow(int, const cv::Mat&) {
  return {};
}

const Results& OpenCvTracker::results() const {
  return inside_->results;
}

}  // namespace sigs
