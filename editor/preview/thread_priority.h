// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::editor {

// How far a thread steps back behind the window's own (man 2 setpriority).
inline constexpr int kPreviewNiceness = 5;
inline constexpr int kBackgroundNiceness = 10;

// The calling thread steps back. Linux keeps niceness by thread, and threads inherit it from the one that makes them:
// those of the codecs and of the OpenGL driver follow. Where it is refused, the thread keeps its priority.
void lower_thread_priority(int niceness);

}  // namespace sigs::editor
