// SPDX-License-Identifier: MIT
#include "export.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "export_files.h"
#include "frame.h"
#include "outlook.h"
#include "pipeline.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

namespace {

struct DecodedFrame {
  int number = 0;
  Frame picture;
};

bool any_in_view(const Scene& scene, int frame) {
  const OutlookPoints points(scene);
  for (int i = 0; i < static_cast<int>(scene.intruders.size()); ++i)
    if (points.at(i, frame).sighting != Sighting::out_of_view) return true;
  return false;
}

// Decoding, composing and writing side by side. Frames come out in order; the first error in order of frames wins.
class Pipeline {
 public:
  Pipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs)
      : scene_(scene), source_(source), range_(range), decoded_(2), finished_(range.first, 2 * jobs + 2) {
    threads_.emplace_back([this] { decode(); });
    for (int i = 0; i < jobs; ++i) threads_.emplace_back([this] { compose(); });
  }

  ~Pipeline() {
    decoded_.close();
    finished_.close();
    for (std::thread& thread : threads_) thread.join();
  }

  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  [[nodiscard]] Result<ComposedFrame> next() { return *finished_.take(); }
  [[nodiscard]] double decode_s() const { return decode_s_; }
  [[nodiscard]] std::string drawn_with() {
    const std::lock_guard lock(mutex_);
    return drawn_with_;
  }

 private:
  void decode() {
    for (int number = range_.first; number <= range_.last; ++number) {
      const Stopwatch watch;
      Result<Frame> frame = source_.read(number);
      decode_s_ = decode_s_ + watch.elapsed_s();
      if (!frame) {
        finished_.put(number, fail(frame.error()));
        break;
      }
      if (!decoded_.put({number, std::move(*frame)})) break;
    }
    decoded_.close();
  }

  void compose() {
    Bench bench;
    // Where the first frame needs OpenGL it is made while that is decoded. If it fails, the frame tells why.
    if (any_in_view(scene_, range_.first)) static_cast<void>(bench.renderer());
    while (std::optional<DecodedFrame> decoded = decoded_.take()) {
      Result<ComposedFrame> composed = compose_frame(scene_, decoded->number, std::move(decoded->picture), bench);
      if (composed && composed->work.pixels_drawn > 0) remember(bench.renderer_description());
      if (!finished_.put(decoded->number, std::move(composed))) break;
    }
  }

  void remember(std::string description) {
    const std::lock_guard lock(mutex_);
    if (!description.empty()) drawn_with_ = std::move(description);
  }

  const Scene& scene_;
  FrameSource& source_;
  FrameRange range_;
  BoundedQueue<DecodedFrame> decoded_;
  InOrder<Result<ComposedFrame>> finished_;
  std::atomic<double> decode_s_{0};
  std::mutex mutex_;
  std::string drawn_with_;
  std::vector<std::thread> threads_;
};

Result<FrameRange> range_of(const ExportRequest& request, const Scene& scene) {
  const FrameRange range = request.frames.value_or(FrameRange{scene.first_frame, scene.last_frame});
  const std::string held =
      "the project has frames " + std::to_string(scene.first_frame) + " to " + std::to_string(scene.last_frame);
  if (range.first > range.last || range.first < scene.first_frame || range.last > scene.last_frame)
    return fail("--frames " + std::to_string(range.first) + "-" + std::to_string(range.last), held, ErrorKind::usage);
  return range;
}

void say(const ExportControl& control, ExportReport& report, const Warning& warning) {
  report.warnings.push_back(warning);
  if (control.warn) control.warn(warning);
}

bool cancelled(const ExportControl& control) {
  return control.cancel != nullptr && control.cancel->load();
}

void count(const ComposedFrame& frame, ExportReport& report) {
  ++report.frames;
  report.damaged_frames += frame.picture.damaged ? 1 : 0;
  report.times.draw_s += frame.times.draw_s;
  report.times.composite_s += frame.times.composite_s;
}

Result<void> write_frames(Pipeline& pipeline, const FrameRange& range, ExportFiles& files, const ExportControl& control,
                          ExportReport& report) {
  const int total = range.last - range.first + 1;
  for (int done = 1; done <= total; ++done) {
    if (cancelled(control)) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
    Result<ComposedFrame> frame = pipeline.next();
    if (!frame) {
      const Result<void> before = files.settle();
      return fail(before ? frame.error() : before.error());
    }
    count(*frame, report);
    if (const Result<void> step = files.write(std::move(*frame)); !step) return step;
    if (control.progress) control.progress(done, total);
  }
  report.times.decode_s = pipeline.decode_s();
  report.drawn_with = pipeline.drawn_with();
  return {};
}

}  // namespace

std::vector<Warning> warnings_of(const VideoInfo& video) {
  std::vector<Warning> warnings = video.warnings;
  if (!video.conversion.empty()) warnings.push_back({video.path.string(), "is converted: " + video.conversion});
  return warnings;
}

FootageShape shape_of(const VideoInfo& video) {
  return {.size_px = video.size_px,
          .times_s = video.times_s,
          .frame_interval_s = double(video.frame_rate_den) / video.frame_rate_num};
}

Result<ExportReport> export_project(const ExportRequest& request, const ExportControl& control) {
  const Stopwatch watch;
  const Project& project = request.project;
  if (const std::vector<Problem> problems = validate(project); !problems.empty())
    return fail(error_of(project, problems.front()));
  Result<FrameSource> source = FrameSource::open(resolved(project, project.footage.video));
  if (!source) return fail(project.file.string() + ": footage.video", source.error().text(), source.error().kind);
  const VideoInfo& video = source->info();
  const Result<Scene> scene = open_scene(project, shape_of(video));
  if (!scene) return fail(scene.error());
  if (const Result<void> output = check_output(project, video); !output) return fail(output.error());
  const Result<FrameRange> range = range_of(request, *scene);
  if (!range) return fail(range.error());

  ExportReport report;
  for (const Warning& warning : warnings_of(video)) say(control, report, warning);
  for (const Warning& warning : scene->warnings) say(control, report, warning);
  Result<ExportFiles> files = ExportFiles::open(request, video, *scene, *range);
  if (!files) return fail(files.error());
  {
    Pipeline pipeline(*scene, *source, *range, std::max(1, request.jobs));
    if (const Result<void> step = write_frames(pipeline, *range, *files, control, report); !step)
      return fail(step.error());
  }
  Result<std::vector<std::filesystem::path>> written = files->keep();
  if (!written) return fail(written.error());
  report.times.encode_s = files->spent_s();
  report.written = std::move(*written);
  report.times.wall_s = watch.elapsed_s();
  if (report.damaged_frames > 0)
    say(control, report,
        {video.path.string(), std::to_string(report.damaged_frames) + " of " + std::to_string(report.frames) +
                                  " frames are damaged; " + "what could be decoded of them is used"});
  return report;
}

}  // namespace sigs
