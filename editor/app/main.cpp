// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "base/threads.h"
#include "editor/app/app.h"
#include "editor/app/command_line.h"

namespace {

constexpr double kTurn_s = 1.0 / 75;
constexpr double kSlowTurn_s = 1.0 / 33;

// From one update to the next. A few more updates than most screens show, as an image that just misses one waits for
// the next; and where OpenGL draws in software, a third of the time while a clip is played, so that decoding has the
// rest, else most of it: a hand that drags sees the difference.
double turn_s(double update_took_s, bool plays) {
  return std::clamp((plays ? 3 : 1.2) * update_took_s, kTurn_s, kSlowTurn_s);
}

int run(const std::string& project, const std::string& probe) {
  using namespace sigs::editor;
  Settings settings = read_settings(settings_file());
  const sigs::Result<std::unique_ptr<Window>> window = Window::open(settings);
  if (!window) {
    std::fprintf(stderr, "error: %s\n", window.error().text().c_str());
    return static_cast<int>(window.error().kind);
  }
  App app(**window, std::move(settings), ProbeWriter(probe));
  if (!project.empty()) app.open(project);
  double last_update_s = 0;
  double took_s = 0;
  while (!app.done()) {
    const bool something_happened = (*window)->wait(app.wait_timeout_s());
    if (const double early_s = last_update_s + turn_s(took_s, app.plays()) - steady_now_s(); early_s > 0)
      std::this_thread::sleep_for(std::chrono::duration<double>(early_s));
    last_update_s = steady_now_s();
    app.update(last_update_s, something_happened);
    took_s = steady_now_s() - last_update_s;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  sigs::editor::EditorOptions options;
  const std::unique_ptr<CLI::App> program = sigs::editor::make_command_line(options);
  try {
    program->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program->exit(error) == 0 ? 0 : static_cast<int>(sigs::ErrorKind::usage);
  }
  sigs::tune_allocator();
  sigs::end_plainly_without_memory();
  const sigs::Result<int> status =
      sigs::guarded([&]() -> sigs::Result<int> { return run(options.project, options.probe); });
  if (status) return *status;
  std::fprintf(stderr, "error: %s\n", status.error().text().c_str());
  return static_cast<int>(status.error().kind);
}
