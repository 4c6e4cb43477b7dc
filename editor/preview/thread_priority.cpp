// SPDX-License-Identifier: MIT
#include "editor/preview/thread_priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace sigs::editor {

void lower_thread_priority(int niceness) {
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), niceness);
}

}  // namespace sigs::editor
