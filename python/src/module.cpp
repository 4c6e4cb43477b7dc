// SPDX-License-Identifier: MIT
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "errors.h"
#include "export/export_project.h"
#include "frame_iterator.h"
#include "frame_object.h"
#include "job_thread.h"
#include "project_object.h"
#include "video_object.h"

namespace sigs::python {

namespace {

namespace py = pybind11;
using namespace py::literals;

py::dict dict_of(const ExportReport& report) {
  py::list warnings;
  for (const Warning& warning : report.warnings) warnings.append(warning.text());
  return py::dict("written"_a = report.written, "frames"_a = report.frames, "damaged_frames"_a = report.damaged_frames,
                  "warnings"_a = warnings, "seconds"_a = report.times.wall_s,
                  "renderer"_a = report.renderer_description);
}

// Calls progress(done, total) where there was progress since the last call.
class ProgressReport {
 public:
  explicit ProgressReport(py::object progress) : progress_(std::move(progress)) {}

  void put(int done, int total) {
    total_ = total;
    done_ = done;
  }

  void report() {
    const int done = done_;
    if (progress_.is_none() || std::exchange(reported_, done) == done) return;
    progress_(done, total_.load());
  }

 private:
  py::object progress_;
  std::atomic<int> total_{0};
  std::atomic<int> done_{0};
  int reported_ = 0;
};

// Of all cameras of a rig as one.
ExportReport summed(RigReport rig, double wall_s) {
  ExportReport sum{.written = std::move(rig.written)};
  for (ExportReport& camera : rig.cameras) {
    sum.frames += camera.frames;
    sum.damaged_frames += camera.damaged_frames;
    sum.warnings.insert(sum.warnings.end(), camera.warnings.begin(), camera.warnings.end());
    if (sum.renderer_description.empty()) sum.renderer_description = camera.renderer_description;
  }
  sum.times.wall_s = wall_s;
  return sum;
}

Result<ExportReport> exported(const ExportRequest& request, const ExportControl& control) {
  if (request.project.cameras.empty()) return export_project(request, control);
  const auto start = std::chrono::steady_clock::now();
  Result<RigReport> rig = export_rig(request, control);
  if (!rig) return fail(rig.error());
  return summed(*std::move(rig), std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

py::dict export_to(const ProjectObject& object, const std::filesystem::path& folder,
                   const std::optional<std::pair<int, int>>& frames, int jobs, bool overwrite,
                   const py::object& progress) {
  ExportRequest request{.project = object.project(), .folder = folder, .jobs = jobs, .overwrite = overwrite};
  if (frames) request.frames = FrameRange{frames->first, frames->second};
  ProgressReport reported(progress);
  JobThread thread;
  const ExportReport report = thread.wait_for(
      [&](const std::atomic<bool>* cancel) {
        return exported(request,
                        {.progress = [&](int done, int total) { reported.put(done, total); }, .cancel = cancel});
      },
      [&] { reported.report(); });
  return dict_of(report);
}

// Mesa's software renderer would keep threads that a forked process lacks but waits for; without them each thread that
// composes renders by itself, to the same bytes. Its messages on displays that there are not would go to stderr. Both
// can be set otherwise before the import.
void prepare_opengl() {
  setenv("LP_NUM_THREADS", "0", 0);
  setenv("EGL_LOG_LEVEL", "fatal", 0);
}

}  // namespace

PYBIND11_MODULE(_sigs, module) {
  module.doc() = "The engine of SIGS. Use the package sigs, which wraps it.";
  module.attr("__version__") = SIGS_VERSION;
  prepare_opengl();
  translate_errors();
  add_frame_class(module);
  add_project_class(module);
  add_iterator_class(module);
  add_video_class(module);
  module.def("export_to", &export_to, py::arg("project"), py::arg("folder"), py::arg("frames"), py::arg("jobs"),
             py::arg("overwrite"), py::arg("progress"), "Exports a project; the report as a dict.");
}

}  // namespace sigs::python
