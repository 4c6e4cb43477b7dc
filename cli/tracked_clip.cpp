// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "evaluation/tracker_group.h"
#include "export/frame_stream.h"
#include "interrupt.h"
#include "labelled_images.h"
#include "progress.h"
#include "tracked_clip.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Which intruder is followed. Names are those of the clip's, in their order.
Result<int> target_of(const TrackRequest& request, const std::vector<std::string>& names) {
  const std::string file = request.input.file.string();
  const int count = static_cast<int>(names.size());
  if (count == 0) return fail(file, "has no intruder: there is nothing to follow");
  const int chosen = request.intruder.value_or(count == 1 ? 0 : -1);
  if (chosen >= 0 && chosen < count) return chosen;
  std::string there;
  for (int i = 0; i < count; ++i) there += (i == 0 ? "" : ", ") + std::to_string(i) + " " + names[i];
  if (request.intruder)
    return fail("--intruder " + std::to_string(chosen), "there is none of that number; there are " + there,
                ErrorKind::usage);
  return fail(file, "has " + std::to_string(count) + " intruders; choose with --intruder: " + there, ErrorKind::usage);
}

const Box& start_box(const TargetFrame& frame, TruthBox truth) {
  return truth == TruthBox::visible ? *frame.visible : *frame.amodal_box;
}

// Hands the next image to the trackers. They start in the first frame in which the target can be followed.
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
  std::string what = "intruder " + std::to_string(target.id) + " is in no frame seen with sides of at least " +
                     number_text(request.min_side_px, 3) + " px";
  if (request.policy.min_visible_fraction > 0)
    what += " and to " + number_text(100 * request.policy.min_visible_fraction, 3) + " %";
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

// Whatever can be wrong with results is said before a long pass, but for where the tracker was started: a layout with a
// line a frame is taken at its word.
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
    print_warning({clip->footage().video, std::to_string(*damaged) + " of " + std::to_string(total) +
                                              " frames are damaged; the last intact one before each stands in"});
  return finished(request, std::move(tracked), group);
}

// The images from the first on that the trackers are shown.
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
  const std::string extension = extension_of(request.input.file);
  if (extension == ".xml") return tracked_labels(request, std::move(*group));
  if (extension != ".json")
    return fail(request.input.file.string(), "is neither a project (.json) nor labels (.xml)", ErrorKind::usage);
  if (!request.video.empty()) return fail("--video", "goes with labels; a project makes its images", ErrorKind::usage);
  return tracked_project(request, std::move(*group));
}

}  // namespace sigs::cli
