// SPDX-License-Identifier: MIT
#include "editor/preview/decoding.h"

#include <chrono>
#include <thread>
#include <utility>

#include "base/guarded.h"
#include "base/thread.h"

namespace sigs::editor {

namespace {

constexpr std::chrono::milliseconds kAfterFailure(100);  // memory may be had again; what is wanted is asked for anew

OpenedFootage opened_or_why_not(const std::filesystem::path& path) {
  Result<OpenedFootage> opened =
      guarded([&]() -> Result<OpenedFootage> { return opened_footage(path); }, path.string());
  if (opened) return std::move(*opened);
  return {nullptr, std::make_shared<const Footage>(Footage{.problem = opened.error().text()})};
}

void open_aside(const std::shared_ptr<Board>& board, const FootageId& footage) {
  const auto open = [board, footage] {
    const Result<void> done = guarded([&]() -> Result<void> {
      board->put_opened(footage, opened_or_why_not(footage.path));
      return {};
    });
    static_cast<void>(done);  // where not even that can be said, the footage stays "being opened"
  };
  if (Result<std::thread> thread = started_thread(open))
    thread->detach();
  else
    open();  // what is wanted meanwhile waits
}

Decoded grey_because(const VideoInfo& video, int frame, std::string problem) {
  return {grey_frame({.size_px = video.size_px, .times_s = video.times_s}, frame), std::move(problem)};
}

Decoded decoded_frame(FrameSource& source, int number) {
  Result<Frame> frame = guarded([&] { return source.read(number); });
  const std::string where = source.info().path.string() + ": frame " + std::to_string(number);
  if (frame && frame->damaged)
    return {std::move(*frame), where + " is damaged; another frame of the footage stands in for it"};
  if (frame) return {std::move(*frame), ""};
  return grey_because(source.info(), number, frame.error().text());
}

}  // namespace

void decode_for(const std::shared_ptr<Board>& board) {
  std::unique_ptr<FrameSource> source;
  const auto step = [&]() -> Result<bool> {
    std::optional<DecodingTask> task = board->next_decoding();
    if (!task) return false;
    if (task->adopt) source = std::move(task->source);
    if (task->open) open_aside(board, *task->open);
    if (task->decode)
      board->put_decoded(*task->decode, std::make_shared<const Decoded>(decoded_frame(*source, task->decode->frame)));
    return true;
  };
  for (Result<bool> goes_on = true; goes_on.value_or(true); goes_on = guarded(step))
    if (!goes_on) std::this_thread::sleep_for(kAfterFailure);
}

}  // namespace sigs::editor
