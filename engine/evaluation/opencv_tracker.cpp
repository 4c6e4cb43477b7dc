// SPDX-License-Identifier: MIT
#include "evaluation/opencv_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <opencv2/tracking.hpp>
#include <opencv2/tracking/tracking_legacy.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "base/text.h"

namespace sigs {

// What OpenCV's two interfaces to its trackers, with whole and with fractional pixels, have in common. In OpenCV's
// boxes x is the first column covered.
class TrackerAdapter {
 public:
  virtual ~TrackerAdapter() = default;
  virtual bool init(const cv::Mat& image, const cv::Rect& box) = 0;
  virtual std::optional<cv::Rect2d> update(const cv::Mat& image) = 0;
};

namespace {

class CurrentTracker : public TrackerAdapter {
 public:
  explicit CurrentTracker(cv::Ptr<cv::Tracker> tracker) : tracker_(std::move(tracker)) {}

  bool init(const cv::Mat& image, const cv::Rect& box) override {
    tracker_->init(image, box);
    return true;
  }
  std::optional<cv::Rect2d> update(const cv::Mat& image) override {
    cv::Rect box;
    return tracker_->update(image, box) ? std::optional<cv::Rect2d>(box) : std::nullopt;
  }

 private:
  cv::Ptr<cv::Tracker> tracker_;
};

class LegacyTracker : public TrackerAdapter {
 public:
  explicit LegacyTracker(cv::Ptr<cv::legacy::Tracker> tracker) : tracker_(std::move(tracker)) {}

  bool init(const cv::Mat& image, const cv::Rect& box) override { return tracker_->init(image, cv::Rect2d(box)); }
  std::optional<cv::Rect2d> update(const cv::Mat& image) override {
    cv::Rect2d box;
    return tracker_->update(image, box) ? std::optional(box) : std::nullopt;
  }

 private:
  cv::Ptr<cv::legacy::Tracker> tracker_;
};

constexpr std::array<std::string_view, 7> kTrackerNames{"csrt", "kcf", "mil", "mosse", "medianflow", "tld", "boosting"};

std::unique_ptr<TrackerAdapter> new_tracker(std::string_view name) {
  namespace legacy = cv::legacy;
  if (name == "csrt") return std::make_unique<CurrentTracker>(cv::TrackerCSRT::create());
  if (name == "kcf") return std::make_unique<CurrentTracker>(cv::TrackerKCF::create());
  if (name == "mil") return std::make_unique<CurrentTracker>(cv::TrackerMIL::create());
  if (name == "mosse") return std::make_unique<LegacyTracker>(legacy::TrackerMOSSE::create());
  if (name == "medianflow") return std::make_unique<LegacyTracker>(legacy::TrackerMedianFlow::create());
  if (name == "tld") return std::make_unique<LegacyTracker>(legacy::TrackerTLD::create());
  return std::make_unique<LegacyTracker>(legacy::TrackerBoosting::create());
}

// Of the trackers these draw from the C library's generator, which all threads share.
bool uses_c_generator(std::string_view name) {
  return name == "mil" || name == "tld" || name == "boosting";
}

// One call of such a tracker at a time, from the seed to its end, so that its numbers do not depend on other clips.
std::mutex& c_generator_mutex() {
  static std::mutex mutex;
  return mutex;
}

// OpenCV's trackers use the thread's random generator, some the C library's too. Both are seeded for each image, so
// that no tracker depends on the others.
void seed(std::string_view name, int frame) {
  cv::theRNG().state = 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(frame) + 1);
  if (uses_c_generator(name)) std::srand(static_cast<unsigned>(frame) + 1U);
}

// The box in whole pixels: edges rounded to the nearest border between pixels, at least one pixel wide and high.
cv::Rect pixels_of(const Box& box, cv::Size size) {
  const auto border = [](double edge, int end) {
    return static_cast<int>(std::lround(std::clamp(edge + 0.5, 0.0, static_cast<double>(end))));
  };
  const int left = std::min(border(box.x, size.width), size.width - 1);
  const int top = std::min(border(box.y, size.height), size.height - 1);
  const int right = std::max(border(box.x + box.width, size.width), left + 1);
  const int bottom = std::max(border(box.y + box.height, size.height), top + 1);
  return {left, top, right - left, bottom - top};
}

// MIL and boosting look for rectangles of 9 px or more that fit into the box, at random and without end where none
// does: one of 3 by 3, twice beside or below itself, must fit. TLD enlarges the image until the box's shorter side
// has 20 px and searches all of it: with a box of 2 px that takes minutes for each frame.
bool is_large_enough(std::string_view name, const cv::Rect& box) {
  if (name != "mil" && name != "boosting" && name != "tld") return true;
  return std::min(box.width, box.height) >= 4 && std::max(box.width, box.height) >= 8;
}

bool lies_in(const Box& box, cv::Size size) {
  const bool is_finite =
      std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) && std::isfinite(box.height);
  return is_finite && box.width > 0 && box.height > 0 && box.x < size.width - 0.5 && box.y < size.height - 0.5 &&
         box.x + box.width > -0.5 && box.y + box.height > -0.5;
}

std::optional<Box> reported_box(const std::optional<cv::Rect2d>& found) {
  if (!found || !(found->width > 0) || !(found->height > 0)) return std::nullopt;
  for (const double number : {found->x, found->y, found->width, found->height})
    if (!std::isfinite(number)) return std::nullopt;
  return Box{found->x - 0.5, found->y - 0.5, found->width, found->height};
}

// The message of an exception on one line, without OpenCV's prefix (place in its sources) and line break.
std::string one_line(const std::exception& thrown) {
  const auto* const of_opencv = dynamic_cast<const cv::Exception*>(&thrown);
  std::string text = of_opencv != nullptr ? of_opencv->err : thrown.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

}  // namespace

struct OpenCvTracker::Impl {
  Results results;
  std::unique_ptr<TrackerAdapter> tracker;
  double spent_s = 0;
  int followed = 0;

  // For errors.
  [[nodiscard]] std::string place(int frame) const { return fmt::format("{}: frame {}", results.name, frame); }

  // Calls OpenCV; no exception of its own gets out.
  Result<void> guarded(int frame, const char* what, const std::function<Result<void>()>& call) const {
    std::unique_lock<std::mutex> lock(c_generator_mutex(), std::defer_lock);
    if (uses_c_generator(results.name)) lock.lock();
    try {
      seed(results.name, frame);
      return call();
    } catch (const std::exception& thrown) {
      return fail(place(frame), fmt::format("OpenCV cannot {} it: {}", what, one_line(thrown)));
    }
  }
};

OpenCvTracker::OpenCvTracker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OpenCvTracker::OpenCvTracker(OpenCvTracker&&) noexcept = default;
OpenCvTracker& OpenCvTracker::operator=(OpenCvTracker&&) noexcept = default;
OpenCvTracker::~OpenCvTracker() = default;

std::span<const std::string_view> tracker_names() {
  return kTrackerNames;
}

Result<OpenCvTracker> OpenCvTracker::make(std::string_view name) {
  if (std::find(kTrackerNames.begin(), kTrackerNames.end(), name) == kTrackerNames.end())
    return fail(std::string(name), "no such tracker; there are " + listed(kTrackerNames), ErrorKind::usage);
  auto impl = std::make_unique<Impl>();
  impl->results.name = name;
  return OpenCvTracker(std::move(impl));
}

Result<void> OpenCvTracker::start(int frame, const cv::Mat& image, const Box& box) {
  ENSURE(image.type() == CV_8UC3);
  Impl& in = *impl_;
  ENSURE(!in.tracker);
  if (!lies_in(box, image.size())) return fail(in.place(frame), "cannot be started with a box outside the image");
  const cv::Rect pixels = pixels_of(box, image.size());
  if (!is_large_enough(in.results.name, pixels))
    return fail(in.place(frame), fmt::format("cannot be started with a box of {} px: it takes 8x4 or more",
                                             image_size_text(pixels.size())));
  return in.guarded(frame, "start on", [&]() -> Result<void> {
    std::unique_ptr<TrackerAdapter> tracker = new_tracker(in.results.name);
    if (!tracker->init(image, pixels)) return fail(in.place(frame), "OpenCV cannot start on it");
    in.tracker = std::move(tracker);
    in.results.frames[frame] = {{.box = *reported_box(cv::Rect2d(pixels))}};
    return {};
  });
}

Result<void> OpenCvTracker::follow(int frame, const cv::Mat& image) {
  ENSURE(image.type() == CV_8UC3);
  Impl& in = *impl_;
  ENSURE(in.tracker);
  return in.guarded(frame, "follow in", [&]() -> Result<void> {
    const Stopwatch watch;
    const std::optional<Box> box = reported_box(in.tracker->update(image));
    in.spent_s += watch.elapsed_s();
    ++in.followed;
    if (in.spent_s > 0) in.results.frames_per_s = in.followed / in.spent_s;
    if (box) in.results.frames[frame] = {{.box = *box}};
    return {};
  });
}

const Results& OpenCvTracker::results() const {
  return impl_->results;
}

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
