// SPDX-License-Identifier: MIT
#include "editor/preview/polite.h"

#include <sys/resource.h>
#include <unistd.h>

namespace sigs::editor {

void be_polite(int niceness) {
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), niceness);
}

}  // namespace sigs::editor
