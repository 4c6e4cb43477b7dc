// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "editor/preview/preview_state.h"

namespace sigs::editor {

// The decoding thread's work, until the preview state says stop: opens footage, decodes what is wanted and what lies
// ahead. Opening goes on by itself, so that other footage can be wanted meanwhile, and may outlive this call: it cannot
// be broken off.
void run_decoder(const std::shared_ptr<PreviewState>& preview_state);

}  // namespace sigs::editor
