// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <thread>

#include "base/threads.h"
#include "editor/app/app.h"

namespace {

constexpr double kTurn_s = 1.0 / 60;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
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
  while (!app.done()) {
    const bool something_happened = (*window)->wait(app.wait_timeout_s());
    // No more updates than a screen shows: what draws in software would take the cores from the images.
    if (const double early_s = last_update_s + kTurn_s - now_s(); early_s > 0)
      std::this_thread::sleep_for(std::chrono::duration<double>(early_s));
    last_update_s = now_s();
    app.update(last_update_s, something_happened);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Puts simulated aircraft into real UAV footage: the visual editor.", "sigs-editor");
  program.set_version_flag("--version", std::string("sigs-editor ") + SIGS_VERSION);
  std::string project;
  std::string probe;
  program.add_option("project", project, "project file to open; none: the start page")->option_text("PROJECT");
  program
      .add_option("--probe", probe, "write what the window shows and where into this file, for driving it from outside")
      ->option_text("FILE");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(sigs::ErrorKind::usage);
  }
  const sigs::Result<int> status = sigs::guarded([&]() -> sigs::Result<int> { return run(project, probe); });
  if (status) return *status;
  std::fprintf(stderr, "error: %s\n", status.error().text().c_str());
  return static_cast<int>(status.error().kind);
}
