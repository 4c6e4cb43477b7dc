// SPDX-License-Identifier: MIT
#include "editor/preview/preview_state.h"

#include <fmt/format.h>

#include <utility>

#include "base/threads.h"

namespace sigs::editor {

namespace {

constexpr std::chrono::milliseconds kAfterFailure(100);  // memory may be had again; what is wanted is asked for anew

OpenedFootage opened_or_problem(const FootageId& footage) {
  Result<OpenedFootage> opened = guarded([&]() -> Result<OpenedFootage> { return opened_footage(*footage.project); },
                                         footage.project->footage.video);
  if (opened) return std::move(*opened);
  return {nullptr, std::make_shared<const Footage>(Footage{.problem = opened.error().text()})};
}

void open_in_background(const std::shared_ptr<PreviewState>& preview_state, const FootageId& footage) {
  const auto open = [preview_state, footage] {
    const Result<void> done = guarded([&]() -> Result<void> {
      preview_state->put_opened(footage, opened_or_problem(footage));
      return {};
    });
    static_cast<void>(done);  // where not even that can be said, the footage stays "being opened"
  };
  run_in_background(open);
}

DecodedFrame grey_with_problem(const VideoInfo& video, int frame, std::string problem) {
  return {grey_frame({.size_px = video.size_px, .times_s = video.times_s}, frame), std::move(problem)};
}

DecodedFrame decoded_frame(FrameSource& source, int number) {
  Result<Frame> frame = guarded([&] { return source.read(number); });
  const std::string where = fmt::format("{}: frame {}", source.info().path.string(), number);
  if (frame && frame->damaged)
    return {std::move(*frame), where + " is damaged; another frame of the footage replaces it"};
  if (frame) return {std::move(*frame), ""};
  return grey_with_problem(source.info(), number, frame.error().text());
}

}  // namespace

void run_decoder(const std::shared_ptr<PreviewState>& preview_state) {
  std::unique_ptr<FrameSource> source;
  const auto step = [&]() -> Result<bool> {
    std::optional<DecodeTask> task = preview_state->next_decoding();
    if (!task) return false;
    if (task->adopt) source = std::move(task->source);
    if (task->open) open_in_background(preview_state, *task->open);
    if (task->decode)
      preview_state->put_decoded(*task->decode,
                                 std::make_shared<const DecodedFrame>(decoded_frame(*source, task->decode->frame)));
    return true;
  };
  for (Result<bool> keep_running = true; keep_running.value_or(true); keep_running = guarded(step))
    if (!keep_running) std::this_thread::sleep_for(kAfterFailure);
}

}  // namespace sigs::editor
