// SPDX-License-Identifier: MIT
#include "export/export_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "base/stopwatch.h"
#include "base/threads.h"
#include "export/export_files.h"
#include "export/frame_pipeline.h"
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
Result<void> check_substituted(const ExportReport& report, int total, const OpenedProject& opened, double max_percent) {
  if (report.damaged_frames * 100.0 <= max_percent * total) return {};
  std::ostringstream limit;
  limit << max_percent;
  return fail(opened.source.info().path.string(),
              fmt::format("at least {}, more than footage.max_substituted_percent, {}, allows; nothing was written. "
                          "Repair or cut the footage, or raise the limit: footage.max_substituted_percent=100",
                          damaged_text(report, total), limit.str()));
}

Result<void> write_frames(FramePipeline& pipeline, const FrameRange& range, const OpenedProject& opened,
                          double max_percent, ExportFiles& files, const ExportControl& control, ExportReport& report) {
  const int total = range.last - range.first + 1;
  for (int done = 1; done <= total; ++done) {
    if (const Result<void> on = check_interrupt(control.cancel); !on) return on;
    Result<ComposedFrame> frame = pipeline.next();
    if (!frame) {
      const Result<void> before = files.join();
      return fail(before ? frame.error() : before.error());
    }
    count(*frame, report);
    if (const Result<void> valid = check_substituted(report, total, opened, max_percent); !valid) return valid;
    if (const Result<void> step = files.write(std::move(*frame)); !step) return step;
    if (control.progress) control.progress(done, total);
  }
  report.times.decode_s = pipeline.decode_s();
  report.renderer_description = pipeline.renderer_description();
  return {};
}

// Labels that name an image for each frame, where a video is written and no images.
void warn_of_missing_images(const ExportSettings& output, const ExportControl& control, ExportReport& report) {
  if (output.codec == CodecChoice::png) return;
  std::string names;
  for (const std::string& label : output.labels)
    if (label_format(label)->names_images) names.append(names.empty() ? "" : ", ").append(label);
  if (!names.empty())
    say(control, report,
        {"", fmt::format("labels {} name images (frame_000000.png ...) that are not written beside a video; set "
                         "export.video.codec to png, or make them with FFmpeg as docs/label-formats.md says",
                         names)});
}

Result<ExportReport> exported(const ExportRequest& request, const ExportControl& control) {
  const Stopwatch watch;
  const Project& project = request.project;
  Result<OpenedProject> opened = open_project(project, control.cancel);
  if (!opened) return fail(opened.error());
  const VideoInfo& video = opened->source.info();
  const Scene& scene = opened->scene;
  if (const Result<void> output = check_output(project, video); !output) return fail(output.error());
  const Result<FrameRange> range = range_in(scene, request.frames);
  if (!range) return fail(range.error());

  ExportReport report;
  report.visibilities.assign(scene.intruders.size(), {.frames = range->last - range->first + 1});
  for (const Warning& warning : opened->warnings) say(control, report, warning);
  Result<ExportFiles> files = ExportFiles::open(request, video, scene, *range);
  if (!files) return fail(files.error());
  {
    FramePipeline pipeline(scene, opened->source, *range, std::max(1, request.jobs));
    if (const Result<void> step =
            write_frames(pipeline, *range, *opened, project.footage.max_substituted_percent, *files, control, report);
        !step)
      return fail(step.error());
  }
  Result<std::vector<std::filesystem::path>> written = files->commit();
  if (!written) return fail(written.error());
  report.times.encode_s = files->spent_s();
  report.written = std::move(*written);
  report.times.wall_s = watch.elapsed_s();
  warn_of_missing_images(project.output, control, report);
  if (report.damaged_frames > 0)
    say(control, report,
        {video.path.string(),
         damaged_text(report, report.frames) +
             ": the last intact one before each is used instead; labels mark them as substituted"});
  return report;
}

}  // namespace

Result<ExportReport> export_project(const ExportRequest& request, const ExportControl& control) {
  return guarded([&] { return exported(request, control); });
}

}  // namespace sigs
