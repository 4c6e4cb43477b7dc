// SPDX-License-Identifier: MIT
#include "cli/tracked_clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/paths.h"
#include "base/result.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/process.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/truth_files.h"
#include "export/frame_stream.h"
#include "labels/labels.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

Result<void> check_size(const fs::path& path, cv::Size size, const FootageTruth& footage) {
  if (size == footage.size_px || footage.size_px.empty()) return {};
  return fail(path.string(),
              fmt::format("is {}, the labels are of {}", image_size_text(size), image_size_text(footage.size_px)));
}

Result<void> check_count(const fs::path& path, int count, const ClipTruth& clip) {
  if (count == clip.frames()) return {};
  return fail(path.string(), fmt::format("has {} frames, the labels have {}", count, clip.frames()));
}

bool is_image_of(const fs::path& path, ImageNames names) {
  const std::string extension = lower_extension(path);
  if (names == ImageNames::by_frame)
    return path.filename().string().starts_with("frame_") &&
           (extension == ".png" || extension == ".jpg" || extension == ".tiff");
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".bmp";
}

// In order of the number at the end of the name, those without behind, then of the name.
Result<std::vector<fs::path>> images_by_number(const fs::path& folder, ImageNames names) {
  Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  std::erase_if(*paths, [&](const fs::path& path) { return !is_image_of(path, names); });
  const auto number_at_end = [](const fs::path& path) {
    const std::string stem = path.stem().string();
    const std::size_t begin = stem.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
    std::string digits = stem.substr(begin);
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return std::pair(digits.size(), digits);  // as numbers of any length are compared
  };
  std::ranges::stable_sort(*paths, {}, number_at_end);
  return paths;
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

// Passes the next image to the trackers. They start in the first frame in which the target can be tracked.
void track_frame(TrackerGroup& group, TrackedClip& clip, int frame, const cv::Mat& image, const TrackRequest& request) {
  if (group.is_started()) return group.follow(frame, image);
  const TargetTruth& target = clip.truth.targets[static_cast<std::size_t>(clip.target)];
  const TargetFrame& here = target.frames[static_cast<std::size_t>(frame - clip.truth.footage.first_frame)];
  group.start(frame, image, request.policy.truth == TruthBox::visible ? *here.visible : *here.amodal_box);
}

Error never_trackable(const TrackRequest& request, const TrackedClip& clip, const fs::path& file) {
  const TargetTruth& target = clip.truth.targets[static_cast<std::size_t>(clip.target)];
  std::string what = fmt::format("intruder {} is in no frame seen with sides of at least {} px", target.id,
                                 number_text(request.min_side_px, 3));
  if (request.policy.min_visible_fraction > 0)
    what += fmt::format(" and to {} %", number_text(100 * request.policy.min_visible_fraction, 3));
  return {file.string(), what + ": there is nothing to follow"};
}

// A tracker of which nothing else is known must have started.
Result<TrackedClip> checked_start(const TrackRequest& request, TrackedClip clip) {
  if (clip.results.empty() && !request.trackers.empty() && request.results.empty())
    return fail("--tracker", "none could be started: " + clip.remarks.front());
  return clip;
}

Result<TrackedClip> finished(const TrackRequest& request, TrackedClip clip, const TrackerGroup& group) {
  const std::optional<TrackPolicy> policy = started_policy(request, clip.truth, clip.target);
  if (!policy) return fail(never_trackable(request, clip, request.input.file));
  clip.policy = *policy;
  clip.results = group.results();
  clip.remarks = group.remarks();
  return checked_start(request, std::move(clip));
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
  Progress progress(request.progress);
  const Result<int> damaged = clip->show(request.jobs, [&](const StreamFrame& frame) -> Result<void> {
    if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return on;
    if (const Result<void> added = add_frame(tracked.truth, frame.truth); !added) return added;
    if (!request.trackers.empty() && (group.is_started() || started_policy(request, tracked.truth, tracked.target)))
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

Result<TrackedClip> tracked_labels(const TrackRequest& request, TrackerGroup group) {
  Result<TrackInput> input = read_track_input(request, request.input.file);
  if (!input) return fail(input.error());
  std::vector<std::string> names;
  for (const TargetTruth& target : input->truth.targets) names.push_back(target.name);
  const Result<int> target = target_of(request, names);
  if (!target) return fail(target.error());
  Progress progress(request.progress);
  Result<TrackedClip> clip = tracked_input(request, *input, *target, std::move(group), [&](int done, int total) {
    progress.update(done, total);
    return true;
  });
  progress.end();
  if (!clip) return clip;
  return checked_start(request, std::move(*clip));
}

// The images that labels belong to: an exported video, or a folder of images.
class LabelledImages {
 public:
  // Error bad_data where number or size of the images are not those of the labels. A size that the labels do not state
  // is not compared.
  static Result<LabelledImages> open(const fs::path& path, const ClipTruth& clip, ImageNames names) {
    LabelledImages images(clip.footage);
    if (is_folder(path)) {
      Result<std::vector<fs::path>> files = images_by_number(path, names);
      if (!files) return fail(files.error());
      if (const Result<void> fits = check_count(path, static_cast<int>(files->size()), clip); !fits)
        return fail(fits.error());
      for (int frame = clip.footage.first_frame; frame <= clip.footage.last_frame && names == ImageNames::by_frame;
           ++frame)
        (*files)[static_cast<std::size_t>(frame - clip.footage.first_frame)] =
            path / image_name(frame, files->front().extension().string());
      images.files_ = std::move(*files);
      const Result<cv::Mat> first = images.at(clip.footage.first_frame);
      if (!first) return fail(first.error());
      images.footage_.size_px = first->size();  // of all others too, where the labels state none
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

  // The image of a frame, by the footage's number; CV_8UC3, BGR.
  Result<cv::Mat> at(int frame) {
    if (video_) {
      const Result<Frame> image = video_->read(frame - footage_.first_frame);
      if (!image) return fail(image.error());
      return bgr_of(*image);
    }
    const fs::path& file = files_[static_cast<std::size_t>(frame - footage_.first_frame)];
    Result<cv::Mat> image = read_image_file(file, cv::IMREAD_COLOR);
    if (!image) return fail(image.error());
    if (const Result<void> fits = check_size(file, image->size(), footage_); !fits) return fail(fits.error());
    return image;
  }

 private:
  explicit LabelledImages(const FootageTruth& footage) : footage_(footage) {}

  FootageTruth footage_;
  std::vector<fs::path> files_;       // of a folder, one for each frame
  std::optional<FrameSource> video_;  // none: a folder
};

// Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
Result<fs::path> images_beside(const fs::path& labels) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const char* const extension : {".mkv", ".mp4", ".mov", ".avi", ".nut", ".y4m", ""})
    if (const fs::path path = fs::path(labels).replace_extension(extension); fs::exists(path, code))
      found.push_back(path);
  if (found.empty())
    return fail(
        labels.string(),
        fmt::format(
            "has neither {}.mkv, .mp4, .mov, .avi, .nut, .y4m nor a folder {} beside it; name its images with --video",
            labels.stem().string(), labels.stem().string()),
        ErrorKind::cannot_read);
  if (found.size() > 1)
    return fail(labels.string(),
                fmt::format("has both {} and {} beside it; choose with --video", found[0].filename().string(),
                            found[1].filename().string()),
                ErrorKind::cannot_read);
  return found.front();
}

Result<LabelledImages> images_of(const TrackRequest& request, const TrackInput& input) {
  Result<fs::path> path = request.video.empty() ? input.images : request.video;
  if (path->empty() && is_folder(input.labels))
    return fail(input.labels.string(),
                "has neither images (img/, color/ or its own) nor a video; name them with --video",
                ErrorKind::cannot_read);
  if (path->empty()) path = images_beside(input.labels);
  if (!path) return fail(path.error());
  return LabelledImages::open(*path, input.truth, input.image_names);
}

// The images that the trackers get, from the first on.
Result<void> track_images(const TrackRequest& request, const TrackInput& input, TrackedClip& clip, TrackerGroup& group,
                          const FrameCounter& on_frame) {
  Result<LabelledImages> images = images_of(request, input);
  if (!images) return fail(images.error());
  const int first = clip.policy.from_frame;
  const int last = clip.truth.footage.last_frame;
  for (int frame = first; frame <= last; ++frame) {
    if (const Result<void> on = check_interrupt(&interrupt_flag()); !on) return on;
    const Result<cv::Mat> image = images->at(frame);
    if (!image) return fail(image.error());
    if (clip.truth.footage.size_px.empty()) clip.truth.footage.size_px = image->size();
    track_frame(group, clip, frame, *image, request);
    if (!on_frame(frame - first + 1, last - first + 1)) return fail("", "stopped", ErrorKind::interrupted);
  }
  return {};
}

}  // namespace

Result<TrackInput> read_track_input(const TrackRequest& request, const fs::path& path) {
  if (!request.input.settings.empty()) return fail("--set", "goes with a project, not with labels", ErrorKind::usage);
  if (request.frames) return fail("--frames", "goes with a project; labels have their own", ErrorKind::usage);
  if (!is_sequence_folder(path)) {
    Result<ClipTruth> truth = read_truth(path);
    if (!truth) return fail(truth.error());
    return TrackInput{.name = path.stem().string(), .labels = path, .truth = std::move(*truth)};
  }
  if (request.policy.truth == TruthBox::amodal)
    return fail("--truth silhouette", "the truth of " + path.string() + " has one box, of what can be seen",
                ErrorKind::usage);
  Result<SequenceTruth> sequence = read_sequence_truth(path);
  if (!sequence) return fail(sequence.error());
  return TrackInput{.name = sequence->name,
                    .labels = path,
                    .truth = std::move(sequence->truth),
                    .images = sequence->images,
                    .image_names = ImageNames::in_order};
}

std::optional<TrackPolicy> started_policy(const TrackRequest& request, const ClipTruth& truth, int target) {
  return policy_from_start(truth, truth.targets[static_cast<std::size_t>(target)], request.policy, request.min_side_px);
}

Result<TrackedClip> tracked_input(const TrackRequest& request, const TrackInput& input, int target, TrackerGroup group,
                                  const FrameCounter& on_frame) {
  TrackedClip clip{.name = input.name, .truth = input.truth, .target = target};
  const std::optional<TrackPolicy> policy = started_policy(request, input.truth, target);
  if (!policy) return fail(never_trackable(request, clip, input.labels));
  clip.policy = *policy;
  if (!request.trackers.empty())
    if (const Result<void> shown = track_images(request, input, clip, group, on_frame); !shown)
      return fail(shown.error());
  clip.results = group.results();
  clip.remarks = group.remarks();
  return clip;
}

Result<TrackedClip> tracked_clip(const TrackRequest& request) {
  Result<TrackerGroup> group = TrackerGroup::make(request.trackers);
  if (!group) return fail("--tracker " + group.error().where, group.error().what, group.error().kind);
  const std::string extension = lower_extension(request.input.file);
  if (extension == ".xml" || is_sequence_folder(request.input.file)) return tracked_labels(request, std::move(*group));
  if (extension != ".json")
    return fail(
        request.input.file.string(),
        "is neither a project (.json) nor labels (.xml), nor a folder of a dataset or of an otb or vot sequence",
        ErrorKind::usage);
  if (!request.video.empty()) return fail("--video", "goes with labels; a project makes its images", ErrorKind::usage);
  return tracked_project(request, std::move(*group));
}

}  // namespace sigs::cli
