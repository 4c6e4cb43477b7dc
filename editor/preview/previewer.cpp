// SPDX-License-Identifier: MIT
#include "editor/preview/previewer.h"

#include <thread>
#include <utility>

#include "editor/preview/preview_decoder.h"
#include "editor/preview/preview_renderer.h"
#include "editor/preview/preview_state.h"

namespace sigs::editor {

struct Previewer::State {
  State(PreviewLimits limits, std::function<void()> wake)
      : preview_state(std::make_shared<PreviewState>(limits, std::move(wake))),
        decoding([shared = preview_state] { run_decoder(shared); }) {
    try {
      renderer = std::thread([shared = preview_state] { PreviewRenderer(*shared).run(); });
    } catch (...) {
      end();
      throw;
    }
  }
  ~State() { end(); }

  void end() {
    preview_state->stop();
    for (std::thread* const thread : {&decoding, &renderer})
      if (thread->joinable()) thread->join();
  }

  std::shared_ptr<PreviewState> preview_state;  // footage that is still being opened holds on to it
  std::thread decoding;
  std::thread renderer;
};

Previewer::Previewer(PreviewLimits limits, std::function<void()> wake)
    : state_(std::make_unique<State>(limits, std::move(wake))) {}

Previewer::~Previewer() = default;

void Previewer::want(const PreviewRequest& wanted) {
  state_->preview_state->want(wanted);
}

PreviewOutput Previewer::shown() const {
  return state_->preview_state->shown();
}

void Previewer::set_texture_bytes(std::size_t bytes) {
  state_->preview_state->set_texture_bytes(bytes);
}

void Previewer::set_prefetch_paused(bool paused) {
  state_->preview_state->set_prefetch_paused(paused);
}

}  // namespace sigs::editor
