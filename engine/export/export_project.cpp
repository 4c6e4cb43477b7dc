// SPDX-License-Identifier: MIT
#include "export/export_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>
#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/threads.h"
#include "export/export_files.h"
#include "export/frame_stream.h"
#include "frame/compose_frame.h"
#include "labels/labels.h"
#include "scene/opened_project.h"
#include "scene/scene.h"

namespace sigs {

namespace {

void say(const ExportControl& control, ExportReport& report, const Warning& warning) {
  report.warnings.push_back(warning);
  if (control.warn) control.warn(warning);
}

void count(const ComposedFrame& frame, ExportReport& report) {
  ++report.frames;
  report.damaged_frames += frame.image.damaged ? 1 : 0;
  for (const IntruderTruth& truth : frame.truth.intruders) {
    Visibility& seen = report.visibilities[static_cast<std::size_t>(truth.id)];
    ++seen.frames_checked;
    if (truth.visible_box)
      seen.count_visible(truth.amodal_box ? std::max(truth.amodal_box->width, truth.amodal_box->height) : 0);
  }
  report.times.draw_s += frame.times.draw_s;
  report.times.composite_s += frame.times.composite_s;
}

std::string damaged_text(const ExportReport& report, int total) {
  return fmt::format("{} of {} frames of the footage are damaged", report.damaged_frames, total);
}

// As soon as there are too many: the remaining frames cannot change that.
Result<void> check_substituted(const ExportReport& report, int total, const VideoInfo& footage,
                               const ExportRequest& request) {
  const double max_percent = request.project.footage.max_substituted_percent;
  if (report.damaged_frames * 100.0 <= max_percent * total) return {};
  std::ostringstream limit;
  limit << max_percent;
  return fail(footage.path.string(),
              fmt::format("at least {}, more than footage.max_substituted_percent, {}, allows; {}. "
                          "Repair or cut the footage, or raise the limit: footage.max_substituted_percent=100",
                          damaged_text(report, total), limit.str(),
                          request.video_descriptor < 0 ? "nothing was written" : "the stream ends early"));
}

// Waits until as much time has passed as lies between the first frame and this one in the footage.
Result<void> wait_for_time_of(const ComposedFrame& frame, double first_time_s, const Stopwatch& since_first,
                              const ExportControl& control) {
  constexpr double kStep_s = 0.05;  // how soon an interruption is noticed
  while (true) {
    if (const Result<void> on = check_interrupt(control.cancel); !on) return on;
    const double left_s = frame.image.time_s - first_time_s - since_first.elapsed_s();
    if (left_s <= 0) return {};
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, kStep_s)));
  }
}

Result<void> write_frames(FramePipeline& pipeline, const FrameRange& range, const OpenedProject& opened,
                          const ExportRequest& request, ExportFiles& files, const ExportControl& control,
                          ExportReport& report) {
  std::optional<std::pair<Stopwatch, double>> first;  // since the first frame, and its time
  const int total = range.last - range.first + 1;
  for (int done = 1; done <= total; ++done) {
    if (const Result<void> on = check_interrupt(control.cancel); !on) return on;
    Result<ComposedFrame> frame = pipeline.next();
    if (!frame) {
      const Result<void> before = files.join();
      return fail(before ? frame.error() : before.error());
    }
    count(*frame, report);
    if (const Result<void> valid = check_substituted(report, total, opened.source.info(), request); !valid)
      return valid;
    if (request.see_truth) request.see_truth(frame->truth);
    if (!first) first.emplace(Stopwatch(), frame->image.time_s);
    if (request.in_real_time)
      if (const Result<void> due = wait_for_time_of(*frame, first->second, first->first, control); !due) return due;
    if (const Result<void> step = files.write(std::move(*frame)); !step) return step;
    if (control.progress) control.progress(done, total);
  }
  report.times.decode_s = pipeline.decode_s();
  report.renderer_description = pipeline.renderer_description();
  return {};
}

void warn_of_missing_images(const ExportSettings& output, const ExportControl& control, ExportReport& report) {
  if (const std::string names = labels_without_images(output); !names.empty())
    say(control, report,
        {"", fmt::format("labels {} name images (frame_000000.png ...) that are not written beside a video; set "
                         "export.video.codec to png, or make them with FFmpeg as docs/label-formats.md says",
                         names)});
}

void warn_of_other_container(const Project& project, const VideoInfo& footage, const ExportControl& control,
                             ExportReport& report) {
  const ExportSettings& output = project.output;
  if (output.codec != VideoCodec::mjpeg || output.container != ContainerChoice::automatic) return;
  if (container_of(output, footage) == Container::mkv)
    say(control, report,
        {project.file.string() + ": export.video.container",
         "mkv is written, not avi, which has no times: the footage's frames are not evenly spaced"});
}

// What is known of an export before its first frame.
ExportReport begun_report(const Scene& scene, const FrameRange& range, const std::vector<Warning>& warnings,
                          const ExportControl& control) {
  ExportReport report;
  report.visibilities.assign(scene.intruders.size(), {.frames = range.last - range.first + 1});
  for (const Warning& warning : warnings) say(control, report, warning);
  return report;
}

// With the field that asks for the codec source, where the footage does not allow it.
Result<void> of_source(const Project& project, const Result<void>& spliced) {
  if (spliced || spliced.error().kind != ErrorKind::usage) return spliced;
  return fail(project.file.string() + ": export.video.codec",
              fmt::format("source cannot be used: {} {}", spliced.error().where, spliced.error().what),
              ErrorKind::bad_project);
}

// Which frames of the range an intruder changes.
Result<ChangedFrames> changed_frames(const VideoInfo& footage, const Scene& scene, const FrameRange& range,
                                     const ExportControl& control) {
  ComposeContext context;
  const VisibilityEstimator estimator(scene);
  ChangedFrames frames{.first = range.first};
  for (int frame = range.first; frame <= range.last; ++frame) {
    if (const Result<void> on = check_interrupt(control.cancel); !on) return fail(on.error());
    const std::vector<VisibilityEstimate> estimates = estimator.all_at(frame);
    constexpr double kSurely_px = 4;  // what is smaller may be too faint: it is drawn to see
    const bool surely = std::any_of(estimates.begin(), estimates.end(), [](const VisibilityEstimate& estimate) {
      return estimate.visibility_state == VisibilityState::in_view && estimate.size_px > kSurely_px;
    });
    if (surely) {
      frames.changed.push_back(true);
      continue;
    }
    const Result<std::optional<FrameTruth>> truth =
        truth_without_image(scene, frame, footage.color, footage.bit_depth, context);
    if (!truth) return fail(truth.error());
    frames.changed.push_back(!truth->has_value());
  }
  return frames;
}

// Of the codec source; none: another codec.
Result<std::optional<SplicePlan>> splice_plan(const ExportRequest& request, const VideoInfo& footage,
                                              const Scene& scene, const FrameRange& range,
                                              const ExportControl& control) {
  if (request.project.output.codec != VideoCodec::source) return std::optional<SplicePlan>();
  const Result<ChangedFrames> frames = changed_frames(footage, scene, range, control);
  if (!frames) return fail(frames.error());
  Result<SplicePlan> plan = plan_splice(footage, *frames, control.cancel);
  if (plan) return std::optional(*std::move(plan));
  return fail(of_source(request.project, fail(plan.error())).error());
}

void tell(const std::optional<SplicePlan>& splice, const ExportControl& control, ExportReport& report) {
  if (!splice) return;
  for (const Warning& warning : splice->warnings) say(control, report, warning);
  report.copied_frames = static_cast<int>(std::count(splice->encoded.begin(), splice->encoded.end(), false));
}

// Gives the files their names, once all frames are written.
Result<void> finish(const ExportRequest& request, const VideoInfo& footage, ExportFiles& files, const Stopwatch& watch,
                    const ExportControl& control, ExportReport& report) {
  Result<std::vector<std::filesystem::path>> written = files.commit(request.outputs);
  if (!written) return fail(written.error());
  report.times.encode_s = files.spent_s();
  report.written = std::move(*written);
  report.times.wall_s = watch.elapsed_s();
  if (request.video_descriptor < 0) warn_of_missing_images(request.project.output, control, report);
  if (report.damaged_frames > 0)
    say(control, report,
        {footage.path.string(),
         damaged_text(report, report.frames) +
             ": the last intact one before each is used instead; labels mark them as substituted"});
  return {};
}

// An export before its first frame.
struct BegunExport {
  FrameRange range;
  ExportReport report;
  std::optional<SplicePlan> splice;
  ExportFiles files;
};

// tells: whether what the splice copies and leaves out is said.
Result<BegunExport> begin_export(const ExportRequest& request, const VideoInfo& footage, const Scene& scene,
                                 const std::vector<Warning>& warnings, bool tells, const ExportControl& control) {
  if (const Result<void> output = check_output(request.project, footage); !output) return fail(output.error());
  const Result<FrameRange> range = range_in(scene, request.frames);
  if (!range) return fail(range.error());
  ExportReport report = begun_report(scene, *range, warnings, control);
  warn_of_other_container(request.project, footage, control, report);
  Result<std::optional<SplicePlan>> splice = splice_plan(request, footage, scene, *range, control);
  if (!splice) return fail(splice.error());
  if (tells) tell(*splice, control, report);
  Result<ExportFiles> files =
      ExportFiles::open({request, footage, scene, *range, *splice ? &**splice : nullptr, control.cancel});
  if (!files) return fail(files.error());
  return BegunExport{*range, std::move(report), *std::move(splice), *std::move(files)};
}

Result<ExportReport> exported(const ExportRequest& request, const ExportControl& control) {
  const Stopwatch watch;
  Result<OpenedProject> opened = open_project(request.project, control.cancel, request.footage, request.files);
  if (!opened) return fail(opened.error());
  const VideoInfo& video = opened->source.info();
  Result<BegunExport> begun = begin_export(request, video, opened->scene, opened->warnings, true, control);
  if (!begun) return fail(begun.error());
  auto& [range, report, splice, files] = *begun;
  {
    FramePipeline pipeline(opened->scene, opened->source, range, std::max(1, request.jobs),
                           splice ? splice->encoded : std::vector<bool>());
    if (const Result<void> step = write_frames(pipeline, range, *opened, request, files, control, report); !step)
      return fail(step.error());
  }
  if (const Result<void> step = finish(request, video, files, watch, control, report); !step) return fail(step.error());
  return std::move(report);
}

Result<ExportReport> exported_frame(const ExportRequest& request, FrameRenderer& renderer,
                                    const ExportControl& control) {
  const Stopwatch watch;
  const Result<FrameRenderer::Opened> opened = renderer.open(request.project, control.cancel);
  if (!opened) return fail(opened.error());
  const VideoInfo& video = *opened->footage;
  Result<BegunExport> begun = begin_export(request, video, *opened->scene, opened->warnings, false, control);
  if (!begun) return fail(begun.error());
  auto& [range, report, splice, files] = *begun;
  ENSURE(range.first == range.last);
  Result<ComposedFrame> frame = renderer.render(request.project, range.first, {}, control.cancel);
  if (!frame) return fail(frame.error());
  count(*frame, report);
  if (const Result<void> valid = check_substituted(report, 1, video, request); !valid) return fail(valid.error());
  if (const Result<void> step = files.write(std::move(*frame)); !step) return fail(step.error());
  if (control.progress) control.progress(1, 1);
  if (const Result<void> step = finish(request, video, files, watch, control, report); !step) return fail(step.error());
  return std::move(report);
}

// Whether a reader that knows the nominal rate alone shows each frame at its time, to 1 ms: the tick of Matroska, whose
// times of a constant rate are as uneven as that.
bool has_even_times(const VideoInfo& footage) {
  constexpr double kTick_s = 1e-3 + 1e-9;
  const double interval_s = double(footage.frame_rate_den) / footage.frame_rate_num;
  for (std::size_t n = 0; n < footage.times_s.size(); ++n)
    if (std::abs(footage.times_s[n] - static_cast<double>(n) * interval_s) > kTick_s) return false;
  return true;
}

}  // namespace

Result<ExportReport> export_project(const ExportRequest& request, const ExportControl& control) {
  Result<ExportReport> report = guarded([&] { return exported(request, control); });
  if (!report && report.error().kind == ErrorKind::interrupted && request.video_descriptor >= 0)
    return fail("", "interrupted; the stream ends early", ErrorKind::interrupted);
  if (!report) return fail(composing_error(request.project, report.error()));
  return report;
}

Result<ExportReport> export_frame(const ExportRequest& request, FrameRenderer& renderer, const ExportControl& control) {
  return guarded([&] { return exported_frame(request, renderer, control); });
}

Container container_of(const ExportSettings& output, const VideoInfo& footage) {
  static constexpr std::array kChosen{Container::mkv, Container::mp4, Container::avi, Container::nut,
                                      Container::y4m};  // in the order of ContainerChoice, behind automatic
  if (output.container != ContainerChoice::automatic) return kChosen.at(static_cast<std::size_t>(output.container) - 1);
  switch (output.codec) {
    case VideoCodec::h264:
    case VideoCodec::hevc:
    case VideoCodec::av1:
      return Container::mp4;
    case VideoCodec::mjpeg:
      return has_even_times(footage) ? Container::avi : Container::mkv;
    case VideoCodec::raw:
      return Container::nut;
    case VideoCodec::source:
      return container_of(footage);
    default:
      return Container::mkv;
  }
}

Result<void> check_output(const Project& project, const VideoInfo& footage) {
  if (project.output.container == ContainerChoice::y4m && footage.layout == PixelLayout::rgb)
    return fail(project.file.string() + ": export.video.container",
                "y4m has no place for RGB, which the footage is; use nut", ErrorKind::bad_project);
  const Container container = container_of(project.output, footage);
  if (project.output.codec == VideoCodec::source) return of_source(project, check_splice(footage, nullptr));
  const bool has_times = container != Container::avi && container != Container::y4m;
  if (!has_times && !writes_images(project.output.codec) && !has_even_times(footage))
    return fail(
        project.file.string() + ": export.video.container",
        fmt::format("{} has no times, and the footage's frames are not evenly spaced: they would be shown at a "
                    "constant {} Hz; use {}",
                    extension_of(container), short_number_text(double(footage.frame_rate_num) / footage.frame_rate_den),
                    container == Container::avi ? "mkv or mp4" : "nut"),
        ErrorKind::bad_project);
  const cv::Size size = footage.size_px;
  const bool odd = size.width % 2 != 0 || size.height % 2 != 0;
  const bool shares_chroma = footage.layout != PixelLayout::yuv444 && footage.layout != PixelLayout::rgb;
  const VideoCodec codec = project.output.codec;
  if ((codec == VideoCodec::h264 || codec == VideoCodec::hevc) && odd && shares_chroma)
    return fail(project.file.string() + ": export.video.codec",
                fmt::format("{} needs an even width and height, the footage is {}; use ffv1, av1, mjpeg or png",
                            name_of(codec), image_size_text(size)),
                ErrorKind::bad_project);
  return {};
}

std::string labels_without_images(const ExportSettings& output) {
  if (writes_images(output.codec)) return "";
  std::string names;
  for (const std::string& label : output.labels)
    if (const LabelFormat* const format = label_format(label); format != nullptr && format->names_images)
      names.append(names.empty() ? "" : ", ").append(label);
  if (std::ranges::find(output.rig, "nuscenes") != output.rig.end())
    names.append(names.empty() ? "" : ", ").append("nuscenes");
  return names;
}

}  // namespace sigs
