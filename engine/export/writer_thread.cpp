// SPDX-License-Identifier: MIT
#include "export/writer_thread.h"

#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "base/threads.h"

namespace sigs {

WriterThread::WriterThread(VideoWriter writer) : writer_(std::move(writer)) {
  Result<std::thread> thread = started_thread([this] { write_all(); }, [this](const Error& error) { give_up(error); });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(thread.error());
}

WriterThread::~WriterThread() {
  dropped_ = true;
  static_cast<void>(join());
}

bool WriterThread::put(Frame frame, int number) {
  return queue_.put({.frame = std::move(frame), .number = number});
}

bool WriterThread::put_blank(double time_s, int number) {
  return queue_.put({.frame = {.time_s = time_s}, .number = number, .is_blank = true});
}

std::optional<FrameFailure> WriterThread::join() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  return failure_;
}

Result<void> WriterThread::finish() {
  ENSURE(!thread_.joinable() && !failure_);
  const Stopwatch watch;
  Result<void> finished = writer_.finish();
  spent_s_ += watch.elapsed_s();
  return finished;
}

void WriterThread::give_up(const Error& error) {
  failure_ = {at_, error};
  queue_.close();
}

void WriterThread::write_all() {
  writer_.warm_up();  // while the first frame is being made
  while (const std::optional<Item> item = queue_.take()) {
    if (dropped_) return;
    at_ = item->number;
    const Stopwatch watch;
    const Result<void> written = item->is_blank ? writer_.write_blank(item->frame.time_s, item->number)
                                                : writer_.write(item->frame, item->number);
    spent_s_ += watch.elapsed_s();
    if (written) continue;
    return give_up(written.error());
  }
}

}  // namespace sigs
