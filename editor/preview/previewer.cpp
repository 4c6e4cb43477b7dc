// SPDX-License-Identifier: MIT
#include "editor/preview/previewer.h"

#include <thread>
#include <utility>

#include "editor/preview/board.h"
#include "editor/preview/composing.h"
#include "editor/preview/decoding.h"

namespace sigs::editor {

struct Previewer::State {
  State(PreviewLimits limits, std::function<void()> wake)
      : board(std::make_shared<Board>(limits, std::move(wake))), decoding([shared = board] { decode_for(shared); }) {
    try {
      composing = std::thread([shared = board] { Composing(*shared).run(); });
    } catch (...) {
      end();
      throw;
    }
  }
  ~State() { end(); }

  void end() {
    board->stop();
    for (std::thread* const thread : {&decoding, &composing})
      if (thread->joinable()) thread->join();
  }

  std::shared_ptr<Board> board;  // footage that is still being opened holds on to it
  std::thread decoding;
  std::thread composing;
};

Previewer::Previewer(PreviewLimits limits, std::function<void()> wake)
    : state_(std::make_unique<State>(limits, std::move(wake))) {}

Previewer::~Previewer() = default;

void Previewer::want(const Wanted& wanted) {
  state_->board->want(wanted);
}

Shown Previewer::shown() const {
  return state_->board->shown();
}

void Previewer::set_texture_bytes(std::size_t bytes) {
  state_->board->set_texture_bytes(bytes);
}

void Previewer::set_modest(bool modest) {
  state_->board->set_modest(modest);
}

}  // namespace sigs::editor
