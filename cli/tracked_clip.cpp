// SPDX-License-Identifier: MIT
#include "cli/tracked_clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/paths.h"
#include "base/result.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/process.h"
#include "cli/progress.h"
#include "evaluation/clip_truth.h"
#include "evaluation/opencv_tracker.h"
#include "export/frame_stream.h"
#include "labels/labels.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

// The images that a label file belongs to: an exported video, or a folder of numbered images.
class LabelledImages {
 public:
  // Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
  [[nodiscard]] static Result<fs::path> beside(const fs::path& labels);

  // Error bad_data where number or size of the images are not those of the labels.
  [[nodiscard]] static Result<LabelledImages> open(const fs::path& path, const ClipTruth& clip);

  // The image of a frame, by the footage's number; CV_8UC3, BGR.
  [[nodiscard]] Result<cv::Mat> at(int frame);

 private:
  LabelledImages(fs::path path, FootageTruth footage) : path_(std::move(path)), footage_(footage) {}

  fs::path path_;
  FootageTruth footage_;
  std::optional<FrameSource> video_;  // none: path_ is a folder
};

Result<void> check_size(const fs::path& path, cv::Size size, const FootageTruth& footage) {
  if (size == footage.size_px) return {};
  return fail(path.string(),
              fmt::format("is {}, the labels are of {}", image_size_text(size), image_size_text(footage.size_px)));
}

Result<void> check_count(const fs::path& path, int count, const ClipTruth& clip) {
  if (count == clip.frames()) return {};
  return fail(path.string(), fmt::format("has {} frames, the labels have {}", count, clip.frames()));
}

Result<int> image_count_in(const fs::path& folder) {
  const Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  return static_cast<int>(std::count_if(paths->begin(), paths->end(), [](const fs::path& path) {
    return path.filename().string().starts_with("frame_") && path.extension() == ".png";
  }));
}

// Empty: it cannot be read.
cv::Mat read_image(const fs::path& file) {
  try {
    return image_codecs::imread(file.string(), cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
    return {};
  }
}

Result<fs::path> LabelledImages::beside(const fs::path& labels) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const char* const extension : {".mkv", ".mp4", ".avi", ""})
    if (const fs::path path = fs::path(labels).replace_extension(extension); fs::exists(path, code))
      found.push_back(path);
  if (found.empty())
    return fail(labels.string(),
                fmt::format("has neither {}.mkv, .mp4, .avi nor a folder {} beside it; name its images with --video",
                            labels.stem().string(), labels.stem().string()),
                ErrorKind::cannot_read);
  if (found.size() > 1)
    return fail(labels.string(),
                fmt::format("has both {} and {} beside it; choose with --video", found[0].filename().string(),
                            found[1].filename().string()),
                ErrorKind::cannot_read);
  return found.front();
}

Result<LabelledImages> LabelledImages::open(const fs::path& path, const ClipTruth& clip) {
  LabelledImages images(path, clip.footage);
  if (is_folder(path)) {
    const Result<int> count = image_count_in(path);
    if (!count) return fail(count.error());
    if (const Result<void> fits = check_count(path, *count, clip); !fits) return fail(fits.error());
    if (const Result<cv::Mat> first = images.at(clip.footage.first_frame); !first) return fail(first.error());
    return images;
  }
  Result<FrameSource> video = FrameSource::open(path, &interrupt_flag());
  if (!video) return fail(video.error());
  Result<void> fits = check_size(path, video->info().size_px, clip.footage);
  if (fits) fits = check_count(path, video->info().frame_count(), clip);
  if (!fits) return fail(fits.error());
  images.video_ = std::move(*video);
  return images;
}

Result<cv::Mat> LabelledImages::at(int frame) {
  if (video_) {
    const Result<Frame> image = video_->read(frame - footage_.first_frame);
    if (!image) return fail(image.error());
    return bgr_of(*image);
  }
  const fs::path file = path_ / image_name(frame);
  if (const Result<void> there = check_input_file(file, "image"); !there) return fail(there.error());
  const cv::Mat image = read_image(file);
  if (image.empty()) return fail(file.string(), "cannot be read as an image");
  if (const Result<void> fits = check_size(file, image.size(), footage_); !fits) return fail(fits.error());
  return image;
}

// Which intruder is tracked. Names are those of the clip's, in their order.
Result<int> target_of(const TrackRequest& request, const std::vector<std::string>& names) {
  const std::string file = request.input.file.string();
  const int count = static_cast<int>(names.size());
  if (count == 0) return fail(file, "has no intruder: there is nothing to follow");
  const int chosen = request.intruder.value_or(count == 1 ? 0 : -1);
  if (chosen >= 0 && chosen < count) return chosen;
  std::string there;
  for (int i = 0; i < count; ++i) there += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
  if (request.intruder)
    return fail(fmt::format("--intruder {}", chosen), "there is none of that number; there are " + there,
                ErrorKind::usage);
  return fail(file, fmt::format("has {} intruders; choose with --intruder: {}", count, there), ErrorKind::usage);
}

const Box& start_box(const TargetFrame& frame, TruthBox truth) {
  return truth == TruthBox::visible ? *frame.visible : *frame.amodal_box;
}

// Passes the next image to the trackers. They start in the first frame in which the target can be tracked.
void track_frame(TrackerGroup& group, TrackedClip& clip, int frame, const cv::Mat& image, const TrackRequest& request) {
  if (group.is_started()) return group.follow(frame, image);
  const TargetTruth& target = clip.truth.targets[static_cast<std::size_t>(clip.target)];
  const TargetFrame& here = target.frames[static_cast<std::size_t>(frame - clip.truth.footage.first_frame)];
  group.start(frame, image, start_box(here, request.policy.truth));
}

std::optional<TrackPolicy> started(const TrackRequest& request, const TrackedClip& clip) {
  return policy_from_start(clip.truth, clip.truth.targets[static_cast<std::size_t>(clip.target)], request.policy,
                           request.min_side_px);
}

Result<void> check_interrupt() {
  if (interrupt_flag().load()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  return {};
}

Error never_trackable(const TrackRequest& request, const TrackedClip& clip) {
  const TargetTruth& target = clip.truth.targets[static_cast<std::size_t>(clip.target)];
  std::string what = fmt::format("intruder {} is in no frame seen with sides of at least {} px", target.id,
                                 number_text(request.min_side_px, 3));
  if (request.policy.min_visible_fraction > 0)
    what += fmt::format(" and to {} %", number_text(100 * request.policy.min_visible_fraction, 3));
  return {request.input.file.string(), what + ": there is nothing to follow"};
}

Result<TrackedClip> finished(const TrackRequest& request, TrackedClip clip, const TrackerGroup& group) {
  const std::optional<TrackPolicy> policy = started(request, clip);
  if (!policy) return fail(never_trackable(request, clip));
  clip.policy = *policy;
  clip.results = group.results();
  clip.remarks = group.remarks();
  if (clip.results.empty() && !request.trackers.empty() && request.results.empty())
    return fail("--tracker", "none could be started: " + clip.remarks.front());
  return clip;
}

// Errors in results are reported before a long pass, except the frame in which the tracker was started: a layout with a
// line for each frame is not checked for that.
Result<void> check_results(const TrackRequest& request, const FootageTruth& footage) {
  for (const fs::path& file : request.results) {
    const Result<std::string> text = read_text(file);
    if (!text) return fail(text.error());
    std::istringstream lines(*text);
    int filled = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::string_view words = trimmed(line);
      filled += !words.empty() && !words.starts_with('#');
    }
    const int start = std::max(footage.first_frame, footage.last_frame - filled + 1);
    const Result<Results> read = read_results(file, footage, {.format = request.format, .start_frame = start});
    if (!read) return fail(read.error());
  }
  return {};
}

Result<TrackedClip> tracked_project(const TrackRequest& request, TrackerGroup group) {
  const Result<Project> project = project_of(request.input);
  if (!project) return fail(project.error());
  std::vector<std::string> names;
  for (const IntruderSettings& intruder : project->intruders) names.push_back(intruder.name);
  const Result<int> target = target_of(request, names);
  if (!target) return fail(target.error());
  Result<FrameStream> clip = FrameStream::open(*project, request.frames, &interrupt_flag());
  if (!clip) return fail(clip.error());
  if (const Result<void> good = check_results(request, clip->footage()); !good) return fail(good.error());
  for (const Warning& warning : clip->warnings()) print_warning(warning);
  TrackedClip tracked{.name = project->name, .truth = {.footage = clip->footage()}, .target = *target};
  const int total = clip->footage().last_frame - clip->footage().first_frame + 1;
  Progress progress(progress_style(request.progress));
  const Result<int> damaged = clip->show(request.jobs, [&](const StreamFrame& frame) -> Result<void> {
    if (const Result<void> on = check_interrupt(); !on) return on;
    if (const Result<void> added = add_frame(tracked.truth, frame.truth); !added) return added;
    if (!request.trackers.empty() && (group.is_started() || started(request, tracked)))
      track_frame(group, tracked, frame.truth.index, frame.image, request);
    progress.update(tracked.truth.frames(), total);
    return {};
  });
  progress.end();
  if (!damaged) return fail(damaged.error());
  if (*damaged > 0)
    print_warning(
        {clip->footage().video,
         fmt::format("{} of {} frames are damaged; the last intact one before each stands in", *damaged, total)});
  return finished(request, std::move(tracked), group);
}

// The images that the trackers get, from the first on.
Result<void> track_images(const TrackRequest& request, TrackedClip& clip, TrackerGroup& group, int first) {
  Result<fs::path> path = request.video;
  if (path->empty()) path = LabelledImages::beside(request.input.file);
  if (!path) return fail(path.error());
  Result<LabelledImages> images = LabelledImages::open(*path, clip.truth);
  if (!images) return fail(images.error());
  Progress progress(progress_style(request.progress));
  const int last = clip.truth.footage.last_frame;
  Result<void> step;
  for (int frame = first; step && frame <= last; ++frame) {
    step = check_interrupt();
    const Result<cv::Mat> image = step ? images->at(frame) : Result<cv::Mat>(cv::Mat());
    if (step && !image) step = fail(image.error());
    if (step) track_frame(group, clip, frame, *image, request);
    if (step) progress.update(frame - first + 1, last - first + 1);
  }
  progress.end();
  return step;
}

Result<TrackedClip> tracked_labels(const TrackRequest& request, TrackerGroup group) {
  const std::string file = request.input.file.string();
  if (!request.input.settings.empty()) return fail("--set", "goes with a project, not with labels", ErrorKind::usage);
  if (request.frames) return fail("--frames", "goes with a project; labels have their own", ErrorKind::usage);
  Result<ClipTruth> truth = read_truth(request.input.file);
  if (!truth) return fail(truth.error());
  TrackedClip clip{.name = request.input.file.stem().string(), .truth = std::move(*truth)};
  std::vector<std::string> names;
  for (const TargetTruth& target : clip.truth.targets) names.push_back(target.name);
  const Result<int> target = target_of(request, names);
  if (!target) return fail(target.error());
  clip.target = *target;
  const std::optional<TrackPolicy> policy = started(request, clip);
  if (!policy) return fail(never_trackable(request, clip));
  if (!request.trackers.empty())
    if (const Result<void> shown = track_images(request, clip, group, policy->from_frame); !shown)
      return fail(shown.error());
  return finished(request, std::move(clip), group);
}

}  // namespace

Result<TrackedClip> tracked_clip(const TrackRequest& request) {
  Result<TrackerGroup> group = TrackerGroup::make(request.trackers);
  if (!group) return fail("--tracker " + group.error().where, group.error().what, group.error().kind);
  const std::string extension = lower_extension(request.input.file);
  if (extension == ".xml") return tracked_labels(request, std::move(*group));
  if (extension != ".json")
    return fail(request.input.file.string(), "is neither a project (.json) nor labels (.xml)", ErrorKind::usage);
  if (!request.video.empty()) return fail("--video", "goes with labels; a project makes its images", ErrorKind::usage);
  return tracked_project(request, std::move(*group));
}

}  // namespace sigs::cli
