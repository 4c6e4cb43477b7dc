// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "editor/preview/board.h"

namespace sigs::editor {

// The decoding thread's work, until the board says stop: opens footage, decodes what is wanted and what lies ahead.
// Opening goes on by itself, so that other footage can be wanted meanwhile, and may outlive this call: it cannot be
// broken off.
void decode_for(const std::shared_ptr<Board>& board);

}  // namespace sigs::editor
