// SPDX-License-Identifier: MIT
#include "driver.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/test_data.h"

namespace sigs::test {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

void rest(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Starts a program in the folder of its log, where what it prints goes.
pid_t started(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
              const fs::path& log) {
  const pid_t child = fork();
  if (child != 0) return child;
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  if (chdir(log.parent_path().c_str()) != 0) _exit(126);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

int status_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Not below zero: a minus would look like an option.
std::string whole(double x) {
  return std::to_string(std::max(0L, std::lround(x)));
}

// Xvfb on a free display; its number is what it writes once it is ready.
pid_t start_screen(const fs::path& home, int width_px, int height_px, std::string& display) {
  const fs::path log = home / "screen.log";
  const fs::path number = home / "display";
  const std::string command = "exec Xvfb -displayfd 3 -screen 0 " + std::to_string(width_px) + "x" +
                              std::to_string(height_px) + "x24 -nolisten tcp 3>" + number.string();
  const pid_t screen = started({"sh", "-c", command}, {}, log);
  for (int i = 0; i < 200; ++i) {
    display = read(number);
    if (!display.empty() && display.back() == '\n') break;
    rest(0.05);
  }
  if (display.empty()) throw std::runtime_error("Xvfb did not start: " + read(log));
  display = std::string(":").append(display, 0, display.size() - 1);
  return screen;
}

}  // namespace

bool can_drive_windows() {
  if (is_installed("Xvfb") && is_installed("xdotool")) return true;
  std::printf("SKIPPED: Xvfb or xdotool is absent\n");
  return false;
}

EditorDriver::EditorDriver(const fs::path& home, int width_px, int height_px)
    : home_(home), probe_(home / "probe.json"), width_px_(width_px), height_px_(height_px) {
  screen_ = start_screen(home, width_px, height_px, display_);
}

EditorDriver::~EditorDriver() {
  kill();
  ::kill(screen_, SIGTERM);
  status_of(screen_);
}

void EditorDriver::start(const std::vector<std::string>& arguments) {
  fs::remove(probe_);
  std::vector<std::string> words{(build_dir() / "sigs-editor").string(), "--probe", probe_.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::map<std::string, std::string> environment{{"DISPLAY", display_},
                                                       {"HOME", home_.string()},
                                                       {"XDG_CONFIG_HOME", (home_ / "config").string()},
                                                       {"XDG_STATE_HOME", (home_ / "state").string()},
                                                       {"LIBGL_ALWAYS_SOFTWARE", "1"}};
  editor_ = started(words, environment, home_ / "editor.log");
  wait_for(
      "the first update", [](const nlohmann::json& now) { return now.contains("frame"); }, 60);
}

void EditorDriver::kill() {
  if (editor_ < 0) return;
  ::kill(editor_, SIGKILL);
  status_of(editor_);
  editor_ = -1;
}

bool EditorDriver::running() {
  if (editor_ < 0) return false;
  int status = 0;
  if (waitpid(editor_, &status, WNOHANG) == 0) return true;
  exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  editor_ = -1;
  return false;
}

int EditorDriver::exit_status() {
  for (int i = 0; i < 400 && running(); ++i) rest(0.05);
  if (editor_ >= 0) throw std::runtime_error("the editor does not end");
  return exit_status_;
}

nlohmann::json EditorDriver::state() const {
  const nlohmann::json json = nlohmann::json::parse(read(probe_), nullptr, false);
  return json.is_object() ? json : nlohmann::json::object();
}

bool EditorDriver::has_place(const std::string& name) const {
  const nlohmann::json now = state();
  return now.contains("places") && now["places"].contains(name);
}

ScreenPlace EditorDriver::place(const std::string& name) {
  wait_for("the place " + name,
           [&](const nlohmann::json& now) { return now.contains("places") && now["places"].contains(name); });
  const nlohmann::json rect = state()["places"][name];
  return {rect[0], rect[1], rect[2], rect[3]};
}

void EditorDriver::wait_for(const std::string& what, const std::function<bool(const nlohmann::json&)>& is_so,
                            double seconds) {
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  while (!is_so(state())) {
    if (!running())
      throw std::runtime_error("the editor ended with " + std::to_string(exit_status_) + " while waiting for " + what +
                               ": " + read(home_ / "editor.log"));
    if (Clock::now() > end) throw std::runtime_error("waited in vain for " + what + "; " + state().dump());
    rest(0.02);
  }
}

void EditorDriver::wait_for_image() {
  settle();
  wait_for(
      "the image", [](const nlohmann::json& now) { return now.value("current", false); }, 60);
  settle();
}

void EditorDriver::settle() {
  rest(0.25);
}

void EditorDriver::xdotool(const std::vector<std::string>& arguments) const {
  std::vector<std::string> words{"xdotool"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int status = status_of(started(words, {{"DISPLAY", display_}}, home_ / "xdotool.log"));
  if (status != 0) throw std::runtime_error("xdotool failed: " + read(home_ / "xdotool.log"));
}

namespace {

// ImGui looks at the mouse once per update: a press and release between two updates would go by unseen.
constexpr double kTurn_s = 0.08;

}  // namespace

std::string EditorDriver::paused(double seconds) const {
  return std::to_string(seconds * pace_);
}

void EditorDriver::wait_one_update() const {
  rest(kTurn_s * pace_);
}

void EditorDriver::move(double x, double y) {
  xdotool({"mousemove", whole(x), whole(y)});
  wait_one_update();
}

void EditorDriver::click(double x, double y, int button) {
  const std::string number = std::to_string(button);
  xdotool({"mousemove", whole(x), whole(y), "sleep", paused(kTurn_s), "mousedown", number, "sleep", paused(kTurn_s),
           "mouseup", number});
  wait_one_update();
}

void EditorDriver::click(const std::string& name, int button) {
  const ScreenPlace there = place(name);
  click(there.center_x(), there.center_y(), button);
}

void EditorDriver::double_click(double x, double y) {
  xdotool({"mousemove", whole(x), whole(y), "sleep", paused(kTurn_s), "mousedown", "1", "sleep", paused(0.05),
           "mouseup", "1",  //
           "sleep", paused(0.05), "mousedown", "1", "sleep", paused(0.05), "mouseup", "1"});
  wait_one_update();
}

void EditorDriver::drag(double x, double y, double to_x, double to_y, int button, const std::string& held_key) {
  const std::string number = std::to_string(button);
  std::vector<std::string> words{"mousemove", whole(x), whole(y), "sleep", paused(kTurn_s)};
  const auto add = [&words](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  if (!held_key.empty()) add({"keydown", held_key});
  add({"mousedown", number, "sleep", paused(kTurn_s)});
  constexpr int kSteps = 8;
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    add({"mousemove", whole(x + share * (to_x - x)), whole(y + share * (to_y - y)), "sleep", paused(0.04)});
  }
  add({"sleep", paused(kTurn_s), "mouseup", number});
  if (!held_key.empty()) add({"keyup", held_key});
  xdotool(words);
  wait_one_update();
}

void EditorDriver::drag(const std::string& name, double by_x, double by_y, int button, const std::string& held_key) {
  const ScreenPlace there = place(name);
  drag(there.center_x(), there.center_y(), there.center_x() + by_x, there.center_y() + by_y, button, held_key);
}

void EditorDriver::hold(double x, double y, int button) {
  xdotool({"mousemove", whole(x), whole(y), "sleep", paused(kTurn_s), "mousedown", std::to_string(button)});
  wait_one_update();
}

void EditorDriver::release(int button) {
  xdotool({"mouseup", std::to_string(button)});
  wait_one_update();
}

void EditorDriver::wheel(double x, double y, int clicks) {
  move(x, y);
  for (int i = 0; i < std::abs(clicks); ++i) {
    xdotool({"click", clicks > 0 ? "4" : "5"});
    wait_one_update();
  }
}

void EditorDriver::key(const std::string& keys) {
  xdotool({"key", "--delay", whole(60 * pace_), keys});
  wait_one_update();
}

void EditorDriver::type(const std::string& text) {
  xdotool({"type", "--delay", whole(30 * pace_), "--", text});
  wait_one_update();
}

void EditorDriver::screenshot(const fs::path& file) const {
  fs::create_directories(file.parent_path());
  const std::string size = std::to_string(width_px_) + "x" + std::to_string(height_px_);
  const int status = status_of(started({"ffmpeg", "-v", "error", "-y", "-f", "x11grab", "-draw_mouse", "0",
                                        "-video_size", size, "-i", display_, "-frames:v", "1", file.string()},
                                       {}, home_ / "screenshot.log"));
  if (status != 0) throw std::runtime_error("no screenshot: " + read(home_ / "screenshot.log"));
}

}  // namespace sigs::test
