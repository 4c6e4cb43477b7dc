// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "editor/preview/rate_meter.h"
#include "export/export_project.h"

namespace sigs::editor {

enum class ExportPhase { none, running, done, cancelled, failed };

// An export as it stands.
struct ExportState {
  ExportPhase phase = ExportPhase::none;
  bool is_stopping = false;  // running, and asked to stop
  int done = 0;              // frames
  int total = 0;             // 0: not known yet
  std::optional<double> rate_hz;
  std::optional<double> left_s;
  std::vector<Warning> warnings;
  ExportReport report;  // of phase done
  Error error;          // of phase failed
  ExportRequest request;

  [[nodiscard]] bool is_running() const { return phase == ExportPhase::running; }
};

// Exports in the background, one at a time, at low priority: the window and its images come first.
class ExportJob {
 public:
  // wake  called from the export's thread after each frame and at the end
  explicit ExportJob(std::function<void()> wake);
  ~ExportJob();  // stops it; nothing unfinished stays behind
  ExportJob(const ExportJob&) = delete;
  ExportJob& operator=(const ExportJob&) = delete;

  // False, and nothing happens, while one is running. Where no thread can be had it has failed at once, and says so.
  bool start(ExportRequest request);
  void cancel();
  [[nodiscard]] bool is_running() const;
  [[nodiscard]] ExportState state() const;
  // Ends the look at the last one: the phase is none again. Not while one is running.
  void dismiss();

 private:
  void run();
  [[nodiscard]] Result<ExportReport> exported();
  void finish(Result<ExportReport> report);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  ExportState state_;
  RateMeter rate_;
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

}  // namespace sigs::editor
