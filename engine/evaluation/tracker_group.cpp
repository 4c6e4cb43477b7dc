// SPDX-License-Identifier: MIT
#include "evaluation/tracker_group.h"

#include <algorithm>
#include <utility>

#include "base/ensure.h"

namespace sigs {

Result<TrackerGroup> TrackerGroup::make(const std::vector<std::string>& names) {
  TrackerGroup group;
  for (auto name = names.begin(); name != names.end(); ++name) {
    Result<OpenCvTracker> tracker = OpenCvTracker::make(*name);
    if (!tracker) return fail(tracker.error());
    if (std::find(names.begin(), name, *name) != name) return fail(*name, "is named twice", ErrorKind::usage);
    group.members_.push_back({.tracker = std::move(*tracker)});
  }
  return group;
}

void TrackerGroup::start(int frame, const cv::Mat& image, const Box& box) {
  ENSURE(!is_started_);
  is_started_ = true;
  for (Member& member : members_) {
    const Result<void> step = member.tracker.start(frame, image, box);
    member.has_started = step.has_value();
    if (!step) remarks_.push_back(step.error().text() + "; it is left out");
  }
}

void TrackerGroup::follow(int frame, const cv::Mat& image) {
  ENSURE(is_started_);
  for (Member& member : members_) {
    if (!member.has_started || member.has_failed) continue;
    const Result<void> step = member.tracker.follow(frame, image);
    member.has_failed = !step.has_value();
    if (!step) remarks_.push_back(step.error().text() + "; it reports nothing from there on");
  }
}

std::vector<Results> TrackerGroup::results() const {
  std::vector<Results> results;
  for (const Member& member : members_)
    if (member.has_started) results.push_back(member.tracker.results());
  return results;
}

}  // namespace sigs
