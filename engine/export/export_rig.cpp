// SPDX-License-Identifier: MIT
#include "export/export_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "base/staged_outputs.h"
#include "base/threads.h"
#include "export/schedule.h"
#include "labels/label_files.h"
#include "project/project.h"
#include "project/validate.h"
#include "rig/rig_truth.h"
#include "scene/opened_project.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

// A camera before its export.
struct PlannedCamera {
  Project project;
  FrameRange frames;
  Camera camera;
  cv::Size size_px;
  std::vector<RigIntruder> intruders;
};

// The frames of a camera, of those of its scene, that were taken at the time of others of the first camera.
FrameRange frames_at(const Scene& scene, const Scene& first, const FrameRange& of_first) {
  const auto frame_of = [&](int frame) { return frame_at_time(scene.footage, time_of_frame_s(first.footage, frame)); };
  return {std::max(scene.first_frame, static_cast<int>(std::ceil(frame_of(of_first.first) - 0.5))),
          std::min(scene.last_frame, static_cast<int>(std::floor(frame_of(of_first.last) + 0.5)))};
}

Result<PlannedCamera> planned(Project project, std::optional<Scene>& first, const std::optional<FrameRange>& asked_for,
                              SceneFiles& files) {
  const auto failed = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  Result<FootageShape> shape = files.footage_shape(project);
  if (!shape) return fail(footage_error(project, shape.error()));
  Scene scene = bare_scene(project, in_rig_time(*std::move(shape), project));
  if (const Result<void, Problem> timed = set_range(scene, project, files); !timed) return failed(timed.error());
  const Result<Camera, Problem> camera = scene_camera(project, scene.footage, files);
  if (!camera) return failed(camera.error());
  FrameRange frames{scene.first_frame, scene.last_frame};
  if (asked_for && !first) {
    const Result<FrameRange> range = range_in(scene, asked_for);
    if (!range) return fail(range.error());
    frames = *range;
  } else if (asked_for) {
    frames = frames_at(scene, *first, *asked_for);
    if (frames.first > frames.last)
      return fail(fmt::format("frames {}-{}", asked_for->first, asked_for->last),
                  fmt::format("camera \"{}\" has no frame at that time", project.rig_view->name), ErrorKind::usage);
  }
  std::vector<RigIntruder> intruders;
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const Result<std::shared_ptr<const Model>, Problem> model = scene_model(project, i, files);
    if (!model) return failed(model.error());
    intruders.push_back(
        {project.intruders[i].name, project.intruders[i].category, (*model)->mesh.low_m, (*model)->mesh.high_m});
  }
  const cv::Size size_px = scene.footage.size_px;
  if (!first) first = std::move(scene);
  return PlannedCamera{std::move(project), frames, *camera, size_px, std::move(intruders)};
}

Result<std::vector<PlannedCamera>> planned_cameras(const ExportRequest& request, SceneFiles& files) {
  if (const std::vector<Problem> problems = validate(request.project); !problems.empty())
    return fail(error_of(request.project, problems.front()));
  std::vector<PlannedCamera> cameras;
  std::optional<Scene> first;
  for (Project& project : seen_by_each(request.project)) {
    Result<PlannedCamera> camera = planned(std::move(project), first, request.frames, files);
    if (!camera) return fail(camera.error());
    cameras.push_back(*std::move(camera));
  }
  return cameras;
}

RigTruth truth_of(const std::vector<PlannedCamera>& cameras) {
  std::vector<RigCameraGeometry> geometry;
  for (const PlannedCamera& one : cameras) {
    const RigView& view = *one.project.rig_view;
    geometry.push_back({view.name, one.camera, view.mount, view.clock,
                        std::filesystem::path(one.project.footage.video).filename().string(), one.frames});
  }
  return {std::move(geometry), cameras.front().intruders};
}

StagedOutputs::Existing existing_outputs(const ExportRequest& request) {
  return request.overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse;
}

// Exports all cameras, several at a time where they share their footage.
class RigExport {
 public:
  RigExport(const ExportRequest& request, const ExportControl& control, const std::vector<PlannedCamera>& cameras,
            SceneFiles& files, RigTruth& truth, StagedOutputs& outputs)
      : request_(request),
        control_(control),
        cameras_(cameras),
        files_(files),
        truth_(truth),
        outputs_(outputs),
        done_(cameras.size()),
        reports_(cameras.size()) {
    for (const PlannedCamera& camera : cameras) total_ += camera.frames.last - camera.frames.first + 1;
  }

  Result<std::vector<ExportReport>> run() {
    std::vector<PendingVideo> videos;
    for (const PlannedCamera& camera : cameras_) videos.push_back({&camera.project, camera.frames, camera.size_px});
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const Schedule schedule = schedule_of(videos, 0, cores);
    for (const Batch& batch : schedule.batches) {
      if (batch.kind == Batch::Kind::shared) {
        const int jobs = schedule.jobs_of_each(batch, cores);
        make_sharing(batch, videos, control_.cancel,
                     [&](std::size_t camera, FrameSource* footage) { export_one(camera, footage, jobs); });
      } else {
        for (const std::size_t camera : batch.videos)
          if (!error_) export_one(camera, nullptr, request_.jobs);
      }
      if (error_) return fail(*error_);
    }
    return std::move(reports_);
  }

 private:
  void export_one(std::size_t camera, FrameSource* footage, int jobs) {
    ExportRequest request = request_;
    request.project = cameras_[camera].project;
    request.frames = cameras_[camera].frames;
    request.jobs = jobs;
    request.footage = footage;
    request.files = &files_;
    request.see_truth = [&, camera](const FrameTruth& truth) { truth_.add(camera, truth); };
    ExportControl control{.cancel = control_.cancel};
    control.progress = [&, camera](int done, int) {
      const std::lock_guard lock(mutex_);
      done_[camera] = done;
      if (control_.progress) control_.progress(std::accumulate(done_.begin(), done_.end(), 0), total_);
    };
    control.warn = [&](const Warning& warning) {
      const std::lock_guard lock(mutex_);
      if (control_.warn && warned_.insert(warning.text()).second) control_.warn(warning);
    };
    StagedOutputs outputs(existing_outputs(request_));
    request.outputs = &outputs;
    Result<ExportReport> report = export_project(request, control);
    const std::lock_guard lock(mutex_);
    outputs_.take(std::move(outputs));
    if (!report && !error_) error_ = report.error();
    if (report) reports_[camera] = *std::move(report);
  }

  const ExportRequest& request_;
  const ExportControl& control_;
  const std::vector<PlannedCamera>& cameras_;
  SceneFiles& files_;
  RigTruth& truth_;
  StagedOutputs& outputs_;  // of all cameras: they get their names together
  int total_ = 0;
  std::mutex mutex_;  // of what follows
  std::vector<int> done_;
  std::set<std::string> warned_;  // what cameras have in common is said once
  std::vector<ExportReport> reports_;
  std::optional<Error> error_;
};

// A folder with the tables of one kind.
struct TableFolder {
  std::string kind;
  std::filesystem::path staged;
};

// Folders that hold nothing but what an earlier export wrote are replaced.
Result<void> check_table_folder(const std::filesystem::path& folder) {
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const std::string extension = it->path().extension().string();
    if (!it->is_directory(code) && extension != ".json" && extension != ".txt")
      return fail(folder.string(),
                  fmt::format("holds {}, which no export wrote; choose another folder", it->path().filename().string()),
                  ErrorKind::cannot_create);
  }
  return {};
}

Result<void> write_tables(const TableFolder& folder, const RigTruth& truth, const ExportRequest& request) {
  const VideoCodec codec = request.project.output.codec;
  const std::string extension = writes_images(codec) ? image_extension_of(codec) : ".png";
  const Result<TextFiles> files =
      folder.kind == "kitti" ? kitti_tables(truth) : nuscenes_tables(truth, request.project.name, extension);
  if (!files)
    return fail(request.project.file.string() + ": " + files.error().where, files.error().what, files.error().kind);
  for (const auto& [name, text] : *files) {
    if (const Result<void> made = make_inner_folder((folder.staged / name).parent_path()); !made) return made;
    if (const Result<void> written = write_text_file(folder.staged / name, text); !written) return written;
  }
  return {};
}

Result<RigReport> exported_rig(const ExportRequest& request, const ExportControl& control) {
  SceneFiles files;
  const Result<std::vector<PlannedCamera>> cameras = planned_cameras(request, files);
  if (!cameras) return fail(cameras.error());
  CreatedFolders above;  // outlives the outputs: a folder can go only once it is empty
  if (const Result<void> folder = above.make(request.folder); !folder) return fail(folder.error());
  StagedOutputs outputs(existing_outputs(request));
  const std::string base = (request.folder / request.project.name).string();
  const Result<std::filesystem::path> json = outputs.add_file(base + std::string(kRigSuffix));
  if (!json) return fail(json.error());
  const Result<std::filesystem::path> table = outputs.add_file(base + std::string(kRigTableSuffix));
  if (!table) return fail(table.error());
  std::vector<TableFolder> folders;
  for (const std::string& kind : request.project.output.rig) {
    const Result<std::filesystem::path> folder = outputs.add_folder(base + "." + kind, check_table_folder);
    if (!folder) return fail(folder.error());
    folders.push_back({kind, *folder});
  }
  const std::vector<std::filesystem::path> of_rig = outputs.final_paths();
  RigTruth truth = truth_of(*cameras);
  if (std::ranges::count(request.project.output.rig, "kitti") > 0)  // before the work, whether the lenses allow it
    if (const Result<TextFiles> lenses = kitti_tables(truth); !lenses)
      return fail(request.project.file.string() + ": " + lenses.error().where, lenses.error().what,
                  lenses.error().kind);
  Result<std::vector<ExportReport>> reports = RigExport(request, control, *cameras, files, truth, outputs).run();
  if (!reports) return fail(reports.error());
  for (std::size_t i = 0; i < truth.intruders().size(); ++i)
    if (control.warn && truth.views(static_cast<int>(i)).empty())
      control.warn(visible_in_no_camera(request.project, i));
  Result<void> step = write_text_file(*json, truth.json(request.project.name));
  if (step) step = write_text_file(*table, truth.csv());
  for (const TableFolder& folder : folders)
    if (step) step = write_tables(folder, truth, request);
  if (!step) return fail(outputs.with_final_names(step.error()));
  if (step = outputs.commit(); !step) return fail(step.error());
  RigReport report{.cameras = *std::move(reports)};
  for (const ExportReport& camera : report.cameras)
    report.written.insert(report.written.end(), camera.written.begin(), camera.written.end());
  report.written.insert(report.written.end(), of_rig.begin(), of_rig.end());
  return report;
}

}  // namespace

Result<RigReport> export_rig(const ExportRequest& request, const ExportControl& control) {
  return guarded([&] { return exported_rig(request, control); });
}

}  // namespace sigs
