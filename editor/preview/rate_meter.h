// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>

namespace sigs::editor {

// How fast a long piece of work goes, over the last seconds: neither jumpy nor slow to follow a change.
class RateMeter {
 public:
  // done  pieces that are done altogether; times and numbers only grow
  void note(double now_s, int done);

  // Pieces a second; none before it can be told.
  [[nodiscard]] std::optional<double> rate_hz() const;

  // Seconds until all are done, as seen at the time of the last note.
  [[nodiscard]] std::optional<double> left_s(int total) const;

 private:
  struct Note {
    double time_s = 0;
    int done = 0;
  };
  std::deque<Note> notes_;
};

}  // namespace sigs::editor
