// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// As long as one of these lives, SIGHUP, SIGINT and SIGTERM wait, whichever thread they come to; afterwards they act as
// they would have. For the short moment in which several files get their final names. May be nested, also by several
// threads.
class SignalBlocker {
 public:
  SignalBlocker();
  ~SignalBlocker();
  SignalBlocker(const SignalBlocker&) = delete;
  SignalBlocker& operator=(const SignalBlocker&) = delete;
};

}  // namespace sigs
