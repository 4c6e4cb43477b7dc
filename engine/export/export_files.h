// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"
#include "base/threads.h"
#include "encounter/encounter.h"
#include "export/export_project.h"
#include "frame/compose_frame.h"
#include "labels/labels.h"
#include "scene/scene.h"
#include "truth/annotation.h"
#include "video/video_writer.h"

namespace sigs {

// The encounters of one export: of the camera with each intruder, from the first exported frame to the last. They are
// computed once; each frame takes its share. Memory: some 500 bytes for each frame and intruder.
class ExportedEncounters {
 public:
  // Errors name the project file: bad_project for a volume that there is not, bad_data where a path is not finite.
  [[nodiscard]] static Result<ExportedEncounters> of(const Project& project, const Scene& scene,
                                                     const FrameRange& frames);

  // Sets IntruderTruth::encounter of all intruders of a frame of the range.
  void add_to(FrameTruth& truth) const;

  // Writes what `sigs encounter --json` writes, at the steps of the exported frames, to an empty file. The source is
  // the project's name. Errors cannot_create, write_failed.
  [[nodiscard]] Result<void> write_json(const std::filesystem::path& path) const;

 private:
  std::string source_;
  std::vector<EncounterSummary> encounters_;  // by the intruder's id
  int first_frame_ = 0;
  std::vector<double> times_s_;  // of each frame
};

// The error of one frame of an output.
struct FrameFailure {
  int frame = 0;
  Error error;
};

// A video that is encoded and written on a thread of its own, in parallel to the caller and the other outputs of an
// export. A thread that cannot be started is the failure of the first frame.
class WriterThread {
 public:
  explicit WriterThread(VideoWriter writer);
  ~WriterThread();  // discards queued and unfinished frames

  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  // Passes a frame to the thread; waits while some are queued already. The caller must not change its samples
  // afterwards. False: an earlier frame could not be written, join() says which.
  [[nodiscard]] bool put(Frame frame, int number);

  // A frame whose samples are all 0.
  [[nodiscard]] bool put_blank(double time_s, int number);

  // Waits until all frames passed to it are written; none can be passed after it. The frame that failed, if
  // any.
  [[nodiscard]] std::optional<FrameFailure> join();

  // Completes the file. Call it after join(), where that gave nothing.
  [[nodiscard]] Result<void> finish();

  // Seconds spent writing so far. Call it after join().
  [[nodiscard]] double spent_s() const { return spent_s_; }

 private:
  struct Item {
    Frame frame;
    int number = 0;
    bool is_blank = false;
  };
  void write_all();
  void give_up(Error error);

  VideoWriter writer_;
  BoundedQueue<Item> queue_{2};
  std::atomic<bool> dropped_{false};
  std::optional<FrameFailure> failure_;  // of the thread, until it is joined
  double spent_s_ = 0;                   // likewise
  int at_ = 0;                           // likewise: the frame that is written
  std::thread thread_;
};

// What is exported.
struct ExportedClip {
  const ExportRequest& request;
  const VideoInfo& footage;
  const Scene& scene;
  FrameRange range;
  const SplicePlan* splice = nullptr;  // of the codec source; null: another codec. Frames that it copies have no image
  // While it is true, waiting for the reader of a stream soon ends; null, or outlives the files.
  const std::atomic<bool>* cancel = nullptr;
};

// The files of one export, or its streams, written frame by frame: each video on a thread of its own, the labels on the
// caller's. A frame's labels are written before its image is passed on.
class ExportFiles {
 public:
  [[nodiscard]] static Result<ExportFiles> open(const ExportedClip& clip);

  // Frames in order. An error is that of the first frame that could not be written, which may be an earlier one.
  [[nodiscard]] Result<void> write(ComposedFrame frame);

  // Waits until all frames passed to it are written. Error: that of the first frame that could not be.
  [[nodiscard]] Result<void> join();

  // Completes all of them, then gives them their final names, or leaves that to `later`. Returns those names.
  [[nodiscard]] Result<std::vector<std::filesystem::path>> commit(StagedOutputs* later);

  // Seconds spent encoding and writing, added up over the outputs. Call it after join() or commit().
  [[nodiscard]] double spent_s() const;

 private:
  explicit ExportFiles(StagedOutputs::Existing existing) : outputs_(existing) {}

  struct Labels {
    std::unique_ptr<LabelWriter> writer;
    std::optional<FrameFailure> failure{};
  };
  struct OpenedVideo {
    std::filesystem::path staged;
    std::unique_ptr<WriterThread> writer;
  };
  [[nodiscard]] Result<void> open_all(const ExportedClip& clip);
  [[nodiscard]] Result<void> open_files(const ExportedClip& clip);
  [[nodiscard]] Result<void> open_video_stream(const ExportedClip& clip);
  [[nodiscard]] Result<void> open_label_stream(const ExportedClip& clip);
  [[nodiscard]] Result<OpenedVideo> open_video(const std::filesystem::path& path, const VideoFormat& format,
                                               const SplicePlan* splice = nullptr,
                                               const std::atomic<bool>* cancel = nullptr);
  [[nodiscard]] Result<Labels> open_labels(const std::filesystem::path& path, const LabelFormat& format,
                                           const LabelSequence& sequence);
  [[nodiscard]] Result<void> write_encounters(const std::filesystem::path& path, const ExportedClip& clip);
  [[nodiscard]] bool write_labels(const FrameTruth& truth);
  [[nodiscard]] Result<void> finish();

  CreatedFolders folders_;  // outlives the outputs: a folder can go only once it is empty
  StagedOutputs outputs_;   // outlives the writers: they write into it
  std::unique_ptr<WriterThread> video_;
  std::unique_ptr<WriterThread> masks_;  // nullptr: none are asked for
  std::vector<Labels> labels_;
  std::optional<ExportedEncounters> encounters_;  // none: not asked for
  std::filesystem::path image_folder_;            // where numbered images are written to; empty: a video is
};

// Whether a relative path is one of a pattern of LabelFormat::files.
[[nodiscard]] bool fits(std::string_view path, std::string_view pattern);

// A folder of labels is replaced as a whole. Error cannot_create where it contains a file that the format does not
// write; a missing folder is no error.
[[nodiscard]] Result<void> check_label_folder(const std::filesystem::path& folder, const LabelFormat& format);

}  // namespace sigs
