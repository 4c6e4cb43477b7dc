// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <sstream>

#include "annotation/number_text.h"
#include "base/partial_file.h"
#include "base/text_pieces.h"
#include "cli/interrupt.h"
#include "cli/labelled_pictures.h"
#include "cli/progress.h"
#include "cli/track_request.h"
#include "evaluation/tracker_group.h"
#include "film.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Which intruder is followed. Names are those of the film's, in their order.
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
  return truth == TruthBox::visible ? *frame.visible : *frame.silhouette;
}

// Hands the next picture to the trackers. They start in the first frame in which the target can be followed.
void feed(TrackerGroup& group, TrackedFilm& film, int frame, const cv::Mat& picture, const TrackRequest& request) {
  if (group.is_started()) return group.follow(frame, picture);
  const TargetTruth& target = film.truth.targets[static_cast<std::size_t>(film.target)];
  const TargetFrame& here = target.frames[static_cast<std::size_t>(frame - film.truth.footage.first_frame)];
  group.start(frame, picture, start_box(here, request.policy.truth));
}

std::optional<TrackPolicy> started(const TrackRequest& request, const TrackedFilm& film) {
  return policy_from_start(film.truth, film.truth.targets[static_cast<std::size_t>(film.target)], request.policy,
                           request.least_side_px);
}

Result<void> go_on() {
  if (interrupt_flag().load()) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
  return {};
}

Error never_seen(const TrackRequest& request, const TrackedFilm& film) {
  const TargetTruth& target = film.truth.targets[static_cast<std::size_t>(film.target)];
  std::string what = "intruder " + std::to_string(target.id) + " is in no frame seen with sides of at least " +
                     number_text(request.least_side_px, 3) + " px";
  if (request.policy.least_visible_fraction > 0)
    what += " and to " + number_text(100 * request.policy.least_visible_fraction, 3) + " %";
  return {request.input.file.string(), what + ": there is nothing to follow"};
}

Result<TrackedFilm> finished(const TrackRequest& request, TrackedFilm film, const TrackerGroup& group) {
  const std::optional<TrackPolicy> policy = started(request, film);
  if (!policy) return fail(never_seen(request, film));
  film.policy = *policy;
  film.results = group.results();
  film.remarks = group.remarks();
  if (film.results.empty() && !request.trackers.empty() && request.results.empty())
    return fail("--tracker", "none could be started: " + film.remarks.front());
  return film;
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

Result<TrackedFilm> on_project(const TrackRequest& request, TrackerGroup group) {
  const Result<Project> project = project_of(request.input);
  if (!project) return fail(project.error());
  std::vector<std::string> names;
  for (const IntruderSettings& intruder : project->intruders) names.push_back(intruder.name);
  const Result<int> target = target_of(request, names);
  if (!target) return fail(target.error());
  Result<Film> film = Film::open(*project, request.frames, &interrupt_flag());
  if (!film) return fail(film.error());
  if (const Result<void> good = check_results(request, film->footage()); !good) return fail(good.error());
  for (const Warning& warning : film->warnings()) print_warning(warning);
  TrackedFilm tracked{.name = project->name, .truth = {.footage = film->footage()}, .target = *target};
  const int total = film->footage().last_frame - film->footage().first_frame + 1;
  Progress progress(progress_style(request.progress));
  const Result<int> damaged = film->show(request.jobs, [&](const FilmFrame& frame) -> Result<void> {
    if (const Result<void> on = go_on(); !on) return on;
    if (const Result<void> added = add_frame(tracked.truth, frame.truth); !added) return added;
    if (!request.trackers.empty() && (group.is_started() || started(request, tracked)))
      feed(group, tracked, frame.truth.index, frame.picture, request);
    progress.update(tracked.truth.frames(), total);
    return {};
  });
  progress.end();
  if (!damaged) return fail(damaged.error());
  if (*damaged > 0)
    print_warning({film->footage().video, std::to_string(*damaged) + " of " + std::to_string(total) +
                                              " frames are damaged; the last sound one before each stands in"});
  return finished(request, std::move(tracked), group);
}

// The pictures from the first on that the trackers are shown.
Result<void> follow_pictures(const TrackRequest& request, TrackedFilm& film, TrackerGroup& group, int first) {
  Result<fs::path> path = request.video;
  if (path->empty()) path = LabelledPictures::beside(request.input.file);
  if (!path) return fail(path.error());
  Result<LabelledPictures> pictures = LabelledPictures::open(*path, film.truth);
  if (!pictures) return fail(pictures.error());
  Progress progress(progress_style(request.progress));
  const int last = film.truth.footage.last_frame;
  Result<void> step;
  for (int frame = first; step && frame <= last; ++frame) {
    step = go_on();
    const Result<cv::Mat> picture = step ? pictures->at(frame) : Result<cv::Mat>(cv::Mat());
    if (step && !picture) step = fail(picture.error());
    if (step) feed(group, film, frame, *picture, request);
    if (step) progress.update(frame - first + 1, last - first + 1);
  }
  progress.end();
  return step;
}

Result<TrackedFilm> on_labels(const TrackRequest& request, TrackerGroup group) {
  const std::string file = request.input.file.string();
  if (!request.input.settings.empty()) return fail("--set", "goes with a project, not with labels", ErrorKind::usage);
  if (request.frames) return fail("--frames", "goes with a project; labels have their own", ErrorKind::usage);
  Result<FilmTruth> truth = read_truth(request.input.file);
  if (!truth) return fail(truth.error());
  TrackedFilm film{.name = request.input.file.stem().string(), .truth = std::move(*truth)};
  std::vector<std::string> names;
  for (const TargetTruth& target : film.truth.targets) names.push_back(target.name);
  const Result<int> target = target_of(request, names);
  if (!target) return fail(target.error());
  film.target = *target;
  const std::optional<TrackPolicy> policy = started(request, film);
  if (!policy) return fail(never_seen(request, film));
  if (!request.trackers.empty())
    if (const Result<void> shown = follow_pictures(request, film, group, policy->from_frame); !shown)
      return fail(shown.error());
  return finished(request, std::move(film), group);
}

}  // namespace

Result<TrackedFilm> tracked_film(const TrackRequest& request) {
  Result<TrackerGroup> group = TrackerGroup::make(request.trackers);
  if (!group) return fail("--tracker " + group.error().where, group.error().what, group.error().kind);
  const std::string extension = extension_of(request.input.file);
  if (extension == ".xml") return on_labels(request, std::move(*group));
  if (extension != ".json")
    return fail(request.input.file.string(), "is neither a project (.json) nor labels (.xml)", ErrorKind::usage);
  if (!request.video.empty())
    return fail("--video", "goes with labels; a project makes its pictures", ErrorKind::usage);
  return on_project(request, std::move(*group));
}

}  // namespace sigs::cli
