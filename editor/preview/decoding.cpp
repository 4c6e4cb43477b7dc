// SPDX-License-Identifier: MIT
#include "editor/preview/decoding.h"

#include <exception>
#include <thread>
#include <utility>

namespace sigs::editor {

namespace {

void open_aside(const std::shared_ptr<Board>& board, const FootageId& footage) {
  std::thread([board, footage] {
    OpenedFootage opened;
    try {
      opened = opened_footage(footage.path);
    } catch (const std::exception& e) {
      opened = {nullptr, std::make_shared<const Footage>(Footage{.problem = footage.path.string() + ": " + e.what()})};
    }
    board->put_opened(footage, std::move(opened));
  }).detach();
}

Decoded grey_because(const VideoInfo& video, int frame, std::string problem) {
  return {grey_frame({.size_px = video.size_px, .times_s = video.times_s}, frame), std::move(problem)};
}

Decoded decoded_frame(FrameSource& source, int number) {
  try {
    Result<Frame> frame = source.read(number);
    if (frame) return {std::move(*frame), ""};
    return grey_because(source.info(), number, frame.error().text());
  } catch (const std::exception& e) {
    return grey_because(source.info(), number, e.what());
  }
}

}  // namespace

void decode_for(const std::shared_ptr<Board>& board) {
  std::unique_ptr<FrameSource> source;
  while (std::optional<DecodingTask> task = board->next_decoding()) {
    if (task->adopt) source = std::move(task->source);
    if (task->open) open_aside(board, *task->open);
    if (task->decode)
      board->put_decoded(*task->decode, std::make_shared<const Decoded>(decoded_frame(*source, task->decode->frame)));
  }
}

}  // namespace sigs::editor
