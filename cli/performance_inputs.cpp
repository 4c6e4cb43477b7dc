// SPDX-License-Identifier: MIT
#include "cli/performance_inputs.h"

#include <optional>
#include <tuple>
#include <utility>

#include "base/input_file.h"
#include "base/paths.h"
#include "camera/camera.h"
#include "cli/options.h"
#include "dataset/video_folder.h"
#include "project/json.h"
#include "scene/scene_parts.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

// "3/5"
Result<void> read_declare(const std::string& text, PerformancePolicy& policy) {
  const std::optional<std::pair<int, int>> declare = fraction_of(text);
  if (!declare || declare->first < 1 || declare->second < declare->first || declare->second > 64)
    return fail("--declare " + text, "must be M/N, as in 3/5: M of N frames, 1 <= M <= N <= 64", ErrorKind::usage);
  std::tie(policy.declare_hits, policy.declare_window) = *declare;
  return {};
}

using RayOfPixel = std::function<std::optional<glm::dvec3>(double x_px, double y_px)>;

// A lens as a function.
Result<RayOfPixel> rays_of(const fs::path& calibration, cv::Size size_px, std::optional<LensModel> model) {
  Result<Camera> camera = read_calibration(calibration, size_px, model);
  if (!camera) return fail(camera.error());
  return RayOfPixel([lens = std::move(camera->lens)](double x_px, double y_px) { return lens.ray({x_px, y_px}); });
}

// Of a clip of a dataset, whose project says more than its labels.
Result<void> add_project(PerformanceClip& clip, const ClipFiles& files) {
  const fs::path file = fs::path(files.labels).replace_extension(".json");
  std::error_code code;
  if (files.tags.empty() && files.split.empty()) return {};  // labels alone
  if (!fs::is_regular_file(file, code)) return {};
  const Result<ReadProject> read = read_project(file);
  if (!read) return fail(read.error());
  const Project project = project_of_video(read->project, files.tags);
  for (std::size_t i = 0; i < project.intruders.size(); ++i)
    clip.kinds[static_cast<int>(i)] = project.intruders[i].category;
  if (clip.ray_of_pixel) return {};
  Result<RayOfPixel> rays = rays_of(resolved(project, project.footage.calibration), clip.detected.truth.footage.size_px,
                                    project.footage.lens_model);
  if (rays) clip.ray_of_pixel = std::move(*rays);
  return {};  // a calibration that is not where it was costs the errors of angles, no more
}

Result<std::vector<PerformanceClip>> performance_clips(const PerformanceInputs& options, const DetectInputs& inputs) {
  if (inputs.detectors.size() != 1)
    return fail("--results", "performance is of one detector; name one folder or file of results for each clip",
                ErrorKind::usage);
  Result<std::vector<std::vector<DetectedClip>>> clips = clips_by_detector(inputs, options.sources.format);
  if (!clips) return fail(clips.error());
  std::vector<PerformanceClip> all;
  for (std::size_t i = 0; i < inputs.clips.size(); ++i) {
    PerformanceClip clip{.detected = std::move(clips->front()[i]), .tags = inputs.clips[i].tags};
    if (!options.calibration.empty()) {
      Result<RayOfPixel> rays = rays_of(options.calibration, clip.detected.truth.footage.size_px, std::nullopt);
      if (!rays) return fail(rays.error());
      clip.ray_of_pixel = std::move(*rays);
    }
    if (const Result<void> added = add_project(clip, inputs.clips[i]); !added) return fail(added.error());
    all.push_back(std::move(clip));
  }
  return all;
}

// Footage without intruders has no labels: its frames are what is known of it. Its results lie in the same folder.
Result<void> add_empty_clips(const PerformanceInputs& options, std::vector<PerformanceClip>& clips) {
  if (options.empty.empty()) return {};
  if (options.sources.results.size() != 1 || !is_folder(options.sources.results.front()))
    return fail("--empty", "needs a folder of results, in which a file is called as the video", ErrorKind::usage);
  for (const fs::path& path : options.empty) {
    for (const PerformanceClip& clip : clips)
      if (clip.detected.name == path.stem().string())
        return fail("--empty " + path.string(),
                    "is called as a clip with labels; it is for footage without any aircraft", ErrorKind::usage);
    const Result<FrameSource> video = FrameSource::open(path);
    if (!video) return fail(video.error());
    const VideoInfo& info = video->info();
    ClipTruth truth{.footage = {.video = path.filename().string(),
                                .size_px = info.size_px,
                                .first_frame = 0,
                                .last_frame = info.frame_count() - 1,
                                .frame_rate_num = info.frame_rate_num,
                                .frame_rate_den = info.frame_rate_den}};
    truth.times_s = info.times_s;
    const Result<fs::path> file = results_in(options.sources.results.front(), path.stem().string());
    if (!file) return fail(file.error());
    Result<Results> results =
        read_results(*file, truth.footage, {.format = options.sources.format, .multiple_per_frame = true});
    if (!results) return fail(results.error());
    clips.push_back(
        {.detected = {.name = path.stem().string(), .truth = std::move(truth), .results = *std::move(results)}});
  }
  return {};
}

}  // namespace

Result<Json> json_of_file(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  return text ? parsed_json(*text, file.string(), ErrorKind::bad_data) : fail(text.error());
}

Result<ReadPerformance> read_performance(const PerformanceInputs& inputs) {
  ReadPerformance read{.policy = inputs.policy, .clips = {}, .observations = {}};
  if (const Result<void> declared = read_declare(inputs.declare, read.policy); !declared) return fail(declared.error());
  const Result<DetectInputs> found = detect_inputs(inputs.sources);
  if (!found) return fail(found.error());
  Result<std::vector<PerformanceClip>> clips = performance_clips(inputs, *found);
  if (!clips) return fail(clips.error());
  read.clips = *std::move(clips);
  if (const Result<void> added = add_empty_clips(inputs, read.clips); !added) return fail(added.error());
  Result<Observations> observations = observations_of(found->detectors.front(), read.clips, read.policy);
  if (!observations) return fail(observations.error());
  read.observations = *std::move(observations);
  return read;
}

}  // namespace sigs::cli
