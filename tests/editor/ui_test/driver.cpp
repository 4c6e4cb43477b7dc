// SPDX-License-Identifier: MIT
#include "driver.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/test_data.h"

namespace sigs::test {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLook_s = 0.004;  // between two readings of the editor's probe

void rest(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Starts a program in the folder of its log, where what it prints goes.
pid_t started(const std::vector<std::string>& words, const Environment& environment, const fs::path& log) {
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

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
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

// Xvfb on a free display; its number is what it writes once it is ready. A key that is held does not repeat: on a busy
// machine every key is held long.
pid_t start_screen(const fs::path& home, int width_px, int height_px, std::string& display) {
  const fs::path log = home / "screen.log";
  const fs::path number = home / "display";
  const std::string command = "exec Xvfb -r -displayfd 3 -screen 0 " + std::to_string(width_px) + "x" +
                              std::to_string(height_px) + "x24 -nolisten tcp 3>" + number.string();
  const pid_t screen = started({"sh", "-c", command}, {}, log);
  const Clock::time_point end = after(kPatience_s);
  while (!display.ends_with('\n')) {
    if (has_ended(screen) || Clock::now() > end) throw std::runtime_error("Xvfb did not start: " + read(log));
    rest(kLook_s);
    display = read(number);
  }
  display = std::string(":").append(display, 0, display.size() - 1);
  return screen;
}

}  // namespace

bool shows(const nlohmann::json& state, const std::string& place) {
  return state.contains("places") && state["places"].contains(place);
}

bool can_drive_windows() {
  if (is_installed("Xvfb") && is_installed("xdotool")) return true;
  say_skipped("Xvfb or xdotool is absent");
  return false;
}

namespace {

// A key without meaning to the editor. Earlier events have arrived when this one has.
constexpr const char* kMeaningless = "Pause";

constexpr double kDoubleClick_s = 0.4;  // between its clicks at most: editor/app/window.cpp

bool is_down(const nlohmann::json& state, int button) {
  constexpr std::array kBits{0U, 2U, 1U};  // left, middle, right: X counts 1 2 3, the editor 0 2 1
  return (state.value("buttons", 0U) >> kBits.at(static_cast<std::size_t>(button - 1)) & 1U) != 0;
}

// In which no key comes twice: GLFW takes two presses in one millisecond for one, and on a busy display any number of
// them arrive in one.
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  std::set<int> keys;
  for (const char c : text) {
    const auto sign = static_cast<unsigned char>(c);
    const bool may_shift = std::isupper(sign) != 0 || (std::ispunct(sign) != 0 && c != '/' && c != '.' && c != '-');
    if (pieces.empty() || may_shift || !keys.insert(std::tolower(sign)).second) {
      pieces.emplace_back();
      keys = {std::tolower(sign)};
    }
    pieces.back() += c;
  }
  return pieces;
}

}  // namespace

EditorDriver::EditorDriver(const fs::path& home, int width_px, int height_px)
    : home_(home), probe_(home / "probe.json"), width_px_(width_px), height_px_(height_px) {
  screen_ = start_screen(home, width_px, height_px, display_);
}

EditorDriver::~EditorDriver() {
  kill();
  ::kill(screen_, SIGTERM);
  status_of(screen_);
}

void EditorDriver::start(const std::vector<std::string>& arguments, const Environment& environment) {
  fs::remove(probe_);
  const char* const other = std::getenv("SIGS_TEST_EDITOR");
  std::vector<std::string> words{other != nullptr ? other : (build_dir() / "sigs-editor").string(), "--probe",
                                 probe_.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Environment all{{"DISPLAY", display_},
                  {"HOME", home_.string()},
                  {"XDG_CONFIG_HOME", (home_ / "config").string()},
                  {"XDG_STATE_HOME", (home_ / "state").string()},
                  {"LIBGL_ALWAYS_SOFTWARE", "1"}};
  all.insert(environment.begin(), environment.end());
  editor_ = started(words, all, home_ / "editor.log");
  released_keys_ = 0;
  wait_for("the first update", [](const nlohmann::json& now) { return now.contains("frame"); });
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
  const Clock::time_point end = after(kPatience_s);
  while (running() && Clock::now() < end) rest(kLook_s);
  if (editor_ >= 0) throw std::runtime_error("the editor does not end");
  return exit_status_;
}

std::shared_ptr<const nlohmann::json> EditorDriver::look() const {
  std::string text = read(probe_);
  if (state_ && text == read_) return state_;
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  state_ = std::make_shared<nlohmann::json>(json.is_object() ? std::move(json) : nlohmann::json::object());
  read_ = std::move(text);
  return state_;
}

nlohmann::json EditorDriver::state() const {
  return *look();
}

bool EditorDriver::has_place(const std::string& name) const {
  return shows(*look(), name);
}

ScreenPlace EditorDriver::place(const std::string& name) {
  nlohmann::json rect;
  wait_for("the place " + name, [&](const nlohmann::json& now) {
    if (!shows(now, name) || !now.value("at_rest", false)) return false;
    rect = now["places"][name];
    return true;
  });
  return {rect[0], rect[1], rect[2], rect[3]};
}

void EditorDriver::wait_for(const std::string& what, const std::function<bool(const nlohmann::json&)>& is_so) {
  const Clock::time_point end = after(kPatience_s);
  while (!is_so(*look())) {
    if (!running())
      throw std::runtime_error("the editor ended with " + std::to_string(exit_status_) + " while waiting for " + what +
                               ": " + read(home_ / "editor.log"));
    if (Clock::now() > end) throw std::runtime_error("waited in vain for " + what + "; " + state().dump());
    rest(kLook_s);
  }
}

void EditorDriver::wait_for_image() {
  wait_for("the image",
           [](const nlohmann::json& now) { return now.value("current", false) && now.value("at_rest", false); });
}

void EditorDriver::settle() {
  key(kMeaningless);
}

void EditorDriver::wait_until_seen(const std::string& what, const std::function<bool(const nlohmann::json&)>& is_so) {
  const Clock::time_point end = after(kPatience_s);
  while (!is_so(*look()) && running()) {
    if (Clock::now() > end) throw std::runtime_error("the editor does not see " + what + "; " + state().dump());
    rest(kLook_s);
  }
}

void EditorDriver::wait_until_at_rest() {
  wait_until_seen("all keys, and come to rest", [&](const nlohmann::json& now) {
    return now.value("released_keys", 0) >= released_keys_ && (hurried_ || now.value("at_rest", false));
  });
}

void EditorDriver::xdotool(const std::vector<std::string>& arguments) const {
  std::vector<std::string> words{"xdotool"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int status = status_of(started(words, {{"DISPLAY", display_}}, home_ / "xdotool.log"));
  if (status != 0) throw std::runtime_error("xdotool failed: " + read(home_ / "xdotool.log"));
}

void EditorDriver::point_at(double x, double y) {
  const long there_x = std::clamp(std::lround(x), 0L, width_px_ - 1L);
  const long there_y = std::clamp(std::lround(y), 0L, height_px_ - 1L);
  xdotool({"mousemove", std::to_string(there_x), std::to_string(there_y)});
  wait_until_seen("the mouse", [&](const nlohmann::json& now) {
    return now.contains("mouse") && now["mouse"][0] == there_x && now["mouse"][1] == there_y;
  });
}

void EditorDriver::press(int button) {
  xdotool({"mousedown", std::to_string(button)});
  wait_until_seen("the press", [&](const nlohmann::json& now) { return is_down(now, button); });
}

void EditorDriver::lift(int button) {
  xdotool({"mouseup", std::to_string(button)});
  wait_until_seen("the release", [&](const nlohmann::json& now) { return !is_down(now, button); });
}

void EditorDriver::move(double x, double y) {
  point_at(x, y);
  wait_until_at_rest();
}

void EditorDriver::click(double x, double y, int button) {
  point_at(x, y);
  press(button);
  lift(button);
  wait_until_at_rest();
}

void EditorDriver::click(const std::string& name, int button) {
  const ScreenPlace there = place(name);
  click(there.center_x(), there.center_y(), button);
}

bool EditorDriver::double_click(double x, double y) {
  move(x, y);
  const Clock::time_point start = Clock::now();
  xdotool({"mousedown", "1", "mouseup", "1", "mousedown", "1", "mouseup", "1"});
  settle();  // all four have come
  return Clock::now() - start < std::chrono::duration<double>(kDoubleClick_s);
}

void EditorDriver::drag(double x, double y, double to_x, double to_y, int button, const std::string& held_key) {
  move(x, y);
  if (!held_key.empty()) xdotool({"keydown", held_key});
  press(button);
  constexpr int kSteps = 8;
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    point_at(x + share * (to_x - x), y + share * (to_y - y));
  }
  lift(button);
  if (!held_key.empty()) {
    xdotool({"keyup", held_key});
    settle();
  }
  wait_until_at_rest();
}

void EditorDriver::drag(const std::string& name, double by_x, double by_y, int button, const std::string& held_key) {
  const ScreenPlace there = place(name);
  drag(there.center_x(), there.center_y(), there.center_x() + by_x, there.center_y() + by_y, button, held_key);
}

void EditorDriver::drag_at_once(double x, double y, double to_x, double to_y) {
  const auto text = [](double number) { return std::to_string(std::lround(number)); };
  move(x, y);
  ::kill(editor_, SIGSTOP);
  xdotool({"mousedown", "1", "mousemove", text(x + (to_x - x) / 2), text(y + (to_y - y) / 2), "mousemove", text(to_x),
           text(to_y), "mouseup", "1"});
  ::kill(editor_, SIGCONT);
  wait_until_at_rest();
}

void EditorDriver::hold(double x, double y, int button) {
  move(x, y);
  press(button);
  wait_until_at_rest();
}

void EditorDriver::release(int button) {
  lift(button);
  wait_until_at_rest();
}

void EditorDriver::wheel(double x, double y, int clicks) {
  move(x, y);
  xdotool({"click", "--repeat", std::to_string(std::abs(clicks)), "--delay", "0", clicks > 0 ? "4" : "5"});
  settle();  // a key comes after what the wheel did
}

void EditorDriver::key(const std::string& keys) {
  xdotool({"key", "--delay", "0", keys});
  ++released_keys_;
  wait_until_at_rest();
}

void EditorDriver::type(const std::string& text) {
  for (const std::string& piece : pieces_of(text)) {
    xdotool({"type", "--delay", "0", "--", piece});
    released_keys_ += static_cast<int>(piece.size());
    wait_until_at_rest();
  }
}

void EditorDriver::kill_after_key(const std::string& keys, double delay_s) {
  const pid_t sender =
      started({"xdotool", "key", "--delay", "0", keys}, {{"DISPLAY", display_}}, home_ / "xdotool.log");
  rest(delay_s);
  kill();
  status_of(sender);
}

void EditorDriver::resize(int width_px, int height_px) {
  xdotool({"search", "--onlyvisible", "--class", ".", "windowsize", "--sync", std::to_string(width_px),
           std::to_string(height_px)});
  settle();
}

void EditorDriver::resize_through(const std::vector<std::pair<int, int>>& sizes_px) {
  std::vector<std::string> command{"search", "--onlyvisible", "--class", "."};
  for (const auto& [width_px, height_px] : sizes_px)
    command.insert(command.end(), {"windowsize", std::to_string(width_px), std::to_string(height_px)});
  xdotool(command);
}

void EditorDriver::hide_and_show() {
  xdotool({"search", "--onlyvisible", "--class", ".", "windowunmap", "windowmap"});
  settle();
}

void EditorDriver::screenshot(const fs::path& file, bool with_mouse) const {
  fs::create_directories(file.parent_path());
  const std::string size = std::to_string(width_px_) + "x" + std::to_string(height_px_);
  const int status =
      status_of(started({"ffmpeg", "-v", "error", "-y", "-f", "x11grab", "-draw_mouse", with_mouse ? "1" : "0",
                         "-video_size", size, "-i", display_, "-frames:v", "1", file.string()},
                        {}, home_ / "screenshot.log"));
  if (status != 0) throw std::runtime_error("no screenshot: " + read(home_ / "screenshot.log"));
}

}  // namespace sigs::test
