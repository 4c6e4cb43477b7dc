// SPDX-License-Identifier: MIT
#include "dataset/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "base/paths.h"
#include "base/staging_folder.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "dataset/entry.h"
#include "dataset/footage_cache.h"
#include "dataset/matched_look.h"
#include "dataset/merge_labels.h"
#include "dataset/video_folder.h"
#include "export/schedule.h"
#include "project/validate.h"
#include "scene/opened_project.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr int kListed = 20;                  // videos that a message names
constexpr std::size_t kMaxListBytes = 2000;  // bytes

int cores() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

// What a run knows of one of its videos.
struct Task {
  VideoFolder folder;
  std::string planned;              // fingerprint
  std::optional<VideoEntry> entry;  // of a complete folder as planned
  std::optional<Error> error;
  ExportExtent extent;  // to be exported
  int done = 0;         // frames of it

  std::string why_not;  // the existing folder is not kept

  std::optional<PlannedVideo> matched;  // the planned video with the look of its clip: `folder` has this one

  [[nodiscard]] bool is_pending() const { return !entry && !error; }
  [[nodiscard]] int frames() const { return extent.frames.last - extent.frames.first + 1; }
  [[nodiscard]] std::string unusable() const {
    if (error) return error->text();
    return why_not.empty() ? "missing" : why_not;
  }
};

class DatasetRun {
 public:
  DatasetRun(const Plan& plan, const DatasetRequest& request, const DatasetControl& control, const fs::path& dataset)
      : plan_(plan),
        request_(request),
        control_(control),
        dataset_(dataset),
        inputs_(control.cancel),
        extents_(control.cancel),
        looks_(plan.clips, request.source.program) {
    for (int i = 0; i < static_cast<int>(plan.videos.size()); ++i)
      if (!request.shard || request.shard->has(i)) tasks_.push_back({.folder = {dataset, &plan.videos[i]}});
  }

  [[nodiscard]] Result<DatasetReport> all();

 private:
  [[nodiscard]] bool is_cancelled() const { return sigs::is_cancelled(control_.cancel); }
  [[nodiscard]] Error interrupted() const;
  void warn(const Warning& warning);
  void inspect(Task& task);
  void find_extent(Task& task);
  [[nodiscard]] std::string program_of(const PlannedVideo& video) const;
  void compare_looks();
  void measure_missing();
  void match(Task& task);
  [[nodiscard]] std::string outdated(const Task& task, const VideoEntry& entry);
  [[nodiscard]] Result<void> check_all_there() const;
  [[nodiscard]] Result<void> export_missing(DatasetReport& report);
  void make(Task& task, VideoExport wanted);
  void make_batch(const Batch& batch, const std::vector<Task*>& tasks, const std::vector<PendingVideo>& videos,
                  int jobs_of_each, FrameRenderer& renderer);
  void advance(Task& task, int done);
  [[nodiscard]] Result<void> write_index(DatasetReport& report);
  void warn_of_unplanned_videos();

  const Plan& plan_;
  const DatasetRequest& request_;
  const DatasetControl& control_;
  fs::path dataset_;
  InputChecksums inputs_;
  ExportExtents extents_;
  std::vector<Task> tasks_;
  ClipLooks looks_;
  std::mutex mutex_;  // of the callbacks and the counts
  int frames_to_do_ = 0;
  int frames_done_ = 0;
};

Error DatasetRun::interrupted() const {
  const auto complete = std::count_if(tasks_.begin(), tasks_.end(), [](const Task& task) { return task.entry; });
  return {"", fmt::format("interrupted; {} of {} videos are complete, resuming goes on", complete, tasks_.size()),
          ErrorKind::interrupted};
}

void DatasetRun::warn(const Warning& warning) {
  const std::lock_guard lock(mutex_);
  if (control_.warn) control_.warn(warning);
}

// Why an existing video is not kept; empty: it is kept.
std::string DatasetRun::outdated(const Task& task, const VideoEntry& entry) {
  if (entry.planned != task.planned) return "was made from other settings, inputs or with another program";
  const Result<std::string> damage = damage_of(task.folder.path(), entry, control_.cancel);
  return damage ? *damage : damage.error().text();
}

// What a video is made with besides its project and files. The look of its clip follows from the clip's key, so that
// nothing need be measured to know whether a video is as planned.
std::string DatasetRun::program_of(const PlannedVideo& video) const {
  std::string program = request_.source.program;
  if (video.rig) program += "\ncamera " + video.project.rig_view->name;
  if (!video.clip) return program;
  program += "\nmatched to " + *looks_.key_of(*video.clip);
  for (const std::string& key : video.stated) program += "\nbut for " + key;
  return program;
}

void DatasetRun::inspect(Task& task) {
  if (is_cancelled()) return;
  remove_abandoned_staging(task.folder.path());  // of temporary files that a killed run was writing
  const PlannedVideo& video = *task.folder.video;
  if (video.clip && !looks_.key_of(*video.clip)) {
    task.error = looks_.key_of(*video.clip).error();
    return;
  }
  Result<std::string> planned = fingerprint_of(video.rig ? *video.rig : video.project, program_of(video), inputs_);
  if (!planned) {
    task.error = planned.error();
    return;
  }
  task.planned = std::move(*planned);
  if (request_.resume || request_.merge_only) {
    Result<VideoEntry> entry = read_entry(task.folder.path() / kEntryName);
    const std::string why = entry ? outdated(task, *entry) : std::string();
    task.why_not = why;
    if (entry && why.empty()) task.entry = std::move(*entry);
    if (entry && !why.empty() && !is_cancelled() && !request_.merge_only) warn({video.name, "is made anew: " + why});
  }
  if (task.is_pending() && !request_.merge_only) find_extent(task);
}

void DatasetRun::find_extent(Task& task) {
  const Result<ExportExtent> extent = extents_.of(task.folder.video->project);
  if (extent)
    task.extent = *extent;
  else
    task.error = extent.error();
}

// Videos that are there have the looks of their clips. A clip has one look, which another processor might have rounded
// otherwise.
void DatasetRun::compare_looks() {
  for (Task& task : tasks_) {
    const std::optional<std::size_t>& clip = task.folder.video->clip;
    if (!task.entry || !clip || (task.entry->look && looks_.take(*clip, *task.entry->look))) continue;
    task.entry.reset();
    task.why_not = "its footage was measured otherwise than for other videos";
    if (request_.merge_only) continue;
    warn({task.folder.video->name, "is made anew: " + task.why_not});
    find_extent(task);
  }
}

void DatasetRun::measure_missing() {
  std::set<std::size_t> clips;
  for (const Task& task : tasks_)
    if (task.is_pending() && task.folder.video->clip) clips.insert(*task.folder.video->clip);
  looks_.measure(clips, {.measuring = control_.measuring,
                         .warn = [&](const Warning& warning) { warn(warning); },
                         .cancel = control_.cancel});
}

// Puts the look of a video's clip into its project.
void DatasetRun::match(Task& task) {
  const std::optional<std::size_t>& clip = task.folder.video->clip;
  const Result<MeasuredLook>* const look = clip && !task.error ? looks_.of(*clip) : nullptr;
  if (look == nullptr) return;  // nothing is made of it
  if (!*look) {
    task.error = look->error();
    return;
  }
  task.matched = *task.folder.video;
  task.matched->look = **look;
  put_look(**look, task.matched->stated, task.matched->project);
  task.folder.video = &*task.matched;
}

Result<void> DatasetRun::check_all_there() const {
  std::map<std::string, std::string> names_of_reason;
  int missing = 0;
  for (const Task& task : tasks_) {
    if (task.entry || ++missing > kListed) continue;
    std::string& names = names_of_reason[task.unusable()];
    names += (names.empty() ? "" : ", ") + task.folder.video->name;
  }
  missing += static_cast<int>(plan_.unopened.size());
  if (missing == 0) return {};
  std::string list;
  for (const auto& [reason, names] : names_of_reason)
    list += fmt::format("{}{}: {}", list.empty() ? "" : "; ", names, reason);
  for (const VideoFailure& unopened : plan_.unopened) {
    if (list.size() > kMaxListBytes) break;
    list += fmt::format("{}{}: {}", list.empty() ? "" : "; ", unopened.video, unopened.error.text());
  }
  return fail(dataset_.string(),
              fmt::format("of {} videos {} cannot go into the index; resuming makes them: {}{}",
                          tasks_.size() + plan_.unopened.size(), missing, list, missing > kListed ? "; ..." : ""));
}

void DatasetRun::advance(Task& task, int done) {
  const std::lock_guard lock(mutex_);
  frames_done_ += done - task.done;
  task.done = done;
  if (control_.progress && frames_to_do_ > 0) control_.progress(frames_done_, frames_to_do_);
}

void DatasetRun::make(Task& task, VideoExport wanted) {
  if (is_cancelled()) return;
  wanted.planned = task.planned;
  wanted.progress = [&](int done, int) { advance(task, done); };
  wanted.warn = [&](const Warning& warning) { warn(warning); };
  wanted.cancel = control_.cancel;
  Result<VideoEntry> made = guarded([&] { return make_video(task.folder, wanted); });
  if (!made) {
    task.error = with_final_names(made.error(), dataset_);
    if (!is_cancelled()) advance(task, task.frames());
    return;
  }
  const std::lock_guard lock(mutex_);
  task.entry = std::move(*made);
  if (control_.finished) control_.finished(task.folder.video->name);
}

void DatasetRun::make_batch(const Batch& batch, const std::vector<Task*>& tasks,
                            const std::vector<PendingVideo>& videos, int jobs_of_each, FrameRenderer& renderer) {
  if (batch.kind == Batch::Kind::shared) {
    make_sharing(batch, videos, control_.cancel, [&](std::size_t video, FrameSource* footage) {
      make(*tasks[video], {.jobs = jobs_of_each, .footage = footage});
    });
    return;
  }
  for (const std::size_t video : batch.videos)
    make(*tasks[video], {.jobs = jobs_of_each, .renderer = batch.kind == Batch::Kind::images ? &renderer : nullptr});
}

Result<void> DatasetRun::export_missing(DatasetReport& report) {
  std::vector<Task*> pending;
  std::vector<PendingVideo> videos;
  for (Task& task : tasks_) {
    if (!task.is_pending()) continue;
    pending.push_back(&task);
    videos.push_back({&task.folder.video->project, task.extent.frames, task.extent.footage_px});
    frames_to_do_ += task.frames();
  }
  if (pending.empty()) return {};
  if (const Result<void> step = remove_index(dataset_); !step) return step;
  const Schedule schedule = schedule_of(videos, request_.jobs, cores());
  std::atomic<std::size_t> next{0};
  parallel_for(schedule.batches_at_a_time, schedule.batches_at_a_time, [&](int) {
    FrameRenderer renderer;
    for (std::size_t i = next++; i < schedule.batches.size() && !is_cancelled(); i = next++)
      make_batch(schedule.batches[i], pending, videos, schedule.jobs_of_each(schedule.batches[i], cores()), renderer);
  });
  for (const Task* const task : pending) {
    if (!task->entry) continue;
    ++report.exported;
    report.frames += task->entry->frames;
    report.written.push_back(task->folder.path());
  }
  return {};
}

// Videos of an older recipe.
void DatasetRun::warn_of_unplanned_videos() {
  std::set<std::string> planned;
  for (const Task& task : tasks_) planned.insert(task.folder.video->name);
  const Result<std::vector<fs::path>> there = folder_contents(dataset_);
  if (!there) return;
  for (const fs::path& path : *there) {
    std::error_code code;
    if (!planned.contains(path.filename().string()) && fs::exists(path / kEntryName, code))
      warn({path.string(), "is a video that is not in the recipe; the index leaves it out"});
  }
}

Result<void> DatasetRun::write_index(DatasetReport& report) {
  warn_of_unplanned_videos();
  std::vector<FinishedVideo> videos;
  for (const Task& task : tasks_) videos.push_back({task.folder.video, *task.entry});
  Result<DatasetIndex> index = make_index(plan_, request_.source, dataset_, videos, control_.cancel);
  if (!index) return fail(index.error());
  report.written.insert(report.written.end(), index->written.begin(), index->written.end());
  report.checksum = index->checksum;
  return {};
}

Result<DatasetReport> DatasetRun::all() {
  const Stopwatch watch;
  DatasetReport report;
  std::set<std::size_t> clips;
  for (const Task& task : tasks_)
    if (task.folder.video->clip) clips.insert(*task.folder.video->clip);
  looks_.find_keys(clips, inputs_);
  if (is_cancelled()) return fail(interrupted());
  parallel_for(static_cast<int>(tasks_.size()), std::min(cores(), 8), [&](int i) { inspect(tasks_[i]); });
  compare_looks();
  if (!request_.merge_only) measure_missing();
  if (is_cancelled()) return fail(interrupted());
  for (Task& task : tasks_) match(task);
  if (request_.merge_only)
    if (const Result<void> there = check_all_there(); !there) return fail(there.error());
  report.kept = static_cast<int>(std::count_if(tasks_.begin(), tasks_.end(), [](const Task& t) { return t.entry; }));
  for (Task& task : tasks_)
    if (task.entry)
      if (const Result<void> step = update_metadata(task.folder, *task.entry); !step) task.error = step.error();
  if (const Result<void> step = export_missing(report); !step) return fail(step.error());
  for (const Task& task : tasks_)
    if (task.error) report.failures.push_back({task.folder.video->name, *task.error});
  report.failures.insert(report.failures.end(), plan_.unopened.begin(), plan_.unopened.end());
  Result<void> step = clear_staging_folder(dataset_, request_.shard.has_value());
  if (is_cancelled()) return fail(interrupted());
  const bool is_whole = request_.index && !request_.shard && report.failures.empty();
  if (step && is_whole) step = write_index(report);
  if (!step && is_cancelled()) return fail(interrupted());
  if (!step) return fail(with_final_names(step.error(), dataset_));
  report.seconds = watch.elapsed_s();
  return report;
}

Result<fs::path> made_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  fs::path there = code ? folder : fs::canonical(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  if (!fs::is_directory(there, code))
    return fail(folder.string(), "is a file; a folder is to be written into", ErrorKind::cannot_create);
  return there;
}

Result<DatasetReport> made_in(const fs::path& dataset, const Plan& plan, const DatasetRequest& request,
                              const DatasetControl& control) {
  if (const Result<void> free =
          check_folder_is_free(plan, dataset, request.shard, request.resume || request.merge_only);
      !free)
    return fail(free.error());
  const Result<DatasetLock> dataset_lock = DatasetLock::acquire(dataset, request.shard.value_or(Shard{}));
  if (!dataset_lock) return fail(dataset_lock.error());
  Result<DatasetReport> report = guarded([&] { return DatasetRun(plan, request, control, dataset).all(); });
  if (!report) static_cast<void>(clear_staging_folder(dataset, request.shard.has_value()));
  return report;
}

}  // namespace

Result<DatasetReport> make_dataset(const Plan& plan, const DatasetRequest& request, const DatasetControl& control) {
  if (const Result<void> names = check_folder_names(plan); !names) return fail(names.error());
  if (const Result<void> labels = check_labels_agree(plan); !labels) return fail(labels.error());
  std::error_code code;
  const bool was_there = fs::exists(request.folder, code);
  if (request.merge_only && !was_there)
    return fail(request.folder.string(), "no such folder; merging makes the index of videos that are there",
                ErrorKind::cannot_read);
  const Result<fs::path> dataset = made_folder(request.folder);
  if (!dataset) return fail(dataset.error());
  Result<DatasetReport> report = made_in(*dataset, plan, request, control);
  if (!was_there) fs::remove(*dataset, code);  // where it is still empty
  return report;
}

}  // namespace sigs
