// SPDX-License-Identifier: MIT
#include "editor/app/window.h"

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's declarations.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "editor/app/window_canvas.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// What arrives between two updates.
struct WindowInput {
  std::vector<std::filesystem::path> dropped;
  KeyQueue keys;
  ButtonQueue buttons;
  std::optional<glm::dvec2> mouse;  // by the events so far: X11 itself tells where it is by now
  int released_keys = 0;
  bool needs_all = false;  // everything is to be drawn anew
};

namespace {

WindowInput& incoming_of(GLFWwindow* window) {
  return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  double text_px = 0;  // of the fonts that are loaded
  WindowInput incoming;
  std::unique_ptr<Canvas> canvas = std::make_unique<Canvas>();  // goes before OpenGL does
  double all_drawn_s = 0;                                       // when no panel waited
  bool full_screen = false;
  int x = 0, y = 0, width = 0, height = 0;  // before it filled the screen
};

namespace {

Error glfw_error(const std::string& what) {
  const char* text = nullptr;
  glfwGetError(&text);
  return {"window", what + (text != nullptr ? ": " + std::string(text) : std::string()), ErrorKind::unavailable};
}

KeyKind kind_of(int key, int modifiers) {
  if (key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER) return KeyKind::modifier;
  const bool is_chord = (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0;
  return key >= GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT && !is_chord ? KeyKind::sign : KeyKind::action;
}

void note_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  if (action == GLFW_REPEAT) return;  // ImGui repeats on its own
  incoming_of(window).keys.push({.key = key,
                                 .scancode = scancode,
                                 .down = action == GLFW_PRESS,
                                 .modifiers = modifiers,
                                 .kind = kind_of(key, modifiers)});
}

void hand_on_keys(GLFWwindow* window) {
  WindowInput& incoming = incoming_of(window);
  for (const KeyEvent& event : incoming.keys.take_for_update(ImGui::GetIO().WantTextInput)) {
    if (event.character == 0 && !event.down && event.kind != KeyKind::modifier) ++incoming.released_keys;
    if (event.character != 0)
      ImGui_ImplGlfw_CharCallback(window, event.character);
    else
      ImGui_ImplGlfw_KeyCallback(window, event.key, event.scancode, event.down ? GLFW_PRESS : GLFW_RELEASE,
                                 event.modifiers);
  }
}

#if IMGUI_VERSION_NUM < 18700
void note_button(GLFWwindow* window, int button, int action, int) {
  ButtonEvent event{.button = button, .down = action == GLFW_PRESS};
  if (const std::optional<glm::dvec2>& at = incoming_of(window).mouse)
    event.x = at->x, event.y = at->y;
  else
    glfwGetCursorPos(window, &event.x, &event.y);
  incoming_of(window).buttons.push(event);
}

void note_mouse(GLFWwindow* window, double x, double y) {
  incoming_of(window).mouse = glm::dvec2(x, y);
}

// After the back end has put the buttons as they are at this moment.
void hand_on_buttons(GLFWwindow* window) {
  const Buttons buttons = incoming_of(window).buttons.take_for_update();
  ImGuiIO& io = ImGui::GetIO();
  for (std::size_t i = 0; i < buttons.down.size(); ++i) io.MouseDown[i] = buttons.down[i];
  if (buttons.at) io.MousePos = {static_cast<float>(buttons.at->x), static_cast<float>(buttons.at->y)};
}
#else
// Keeps the order of events itself.
void hand_on_buttons(GLFWwindow*) {}
#endif

double screen_scale(GLFWwindow* window) {
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  return std::clamp(static_cast<double>(std::max(x, y)), 0.5, 4.0);
}

// No larger than the screen has room for.
std::pair<int, int> fitting_size(const Settings& settings) {
  int x = 0, y = 0, width = 0, height = 0;
  if (GLFWmonitor* screen = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(screen, &x, &y, &width, &height);
  if (width <= 0 || height <= 0) return {settings.window_width_px, settings.window_height_px};
  return {std::min(settings.window_width_px, width), std::min(settings.window_height_px, height)};
}

void start_imgui(GLFWwindow* window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // what is to be remembered is in our own settings
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  ImGui::GetIO().ConfigInputTextCursorBlink = false;
  ImGui::GetIO().ConfigDragClickToInputText = true;  // on a number, a click types and a drag drags
  ImGui::GetIO().MouseDoubleClickTime = 0.4F;        // as desktops have it
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330");
}

}  // namespace

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<Window>> Window::open(const Settings& settings) {
  if (glfwInit() != GLFW_TRUE) return fail(glfw_error("no display can be opened"));
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_MAXIMIZED, settings.maximised ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "sigs-editor");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "sigs-editor");
  const auto [width, height] = fitting_size(settings);
  GLFWwindow* window = glfwCreateWindow(width, height, "SIGS", nullptr, nullptr);
  if (window == nullptr) {
    Error error = glfw_error("no window with OpenGL 3.3 can be opened");
    error.what += "; install libgl1 and libgl1-mesa-dri (Debian, Ubuntu), or a GPU's driver";
    glfwTerminate();
    return fail(error);
  }
  auto state = std::make_unique<State>();
  state->window = window;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window, 800, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window, &state->incoming);
  glfwSetDropCallback(window, [](GLFWwindow* to, int count, const char** paths) {
    incoming_of(to).dropped.insert(incoming_of(to).dropped.end(), paths, paths + count);
  });
  // Another window lay over this one, or it was hidden: what it showed is gone.
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* hidden) { incoming_of(hidden).needs_all = true; });
  start_imgui(window);
  glfwSetKeyCallback(window, note_key);
  glfwSetCharCallback(window,
                      [](GLFWwindow* to, unsigned character) { incoming_of(to).keys.push({.character = character}); });
#if IMGUI_VERSION_NUM < 18700
  glfwSetMouseButtonCallback(window, note_button);
  glfwSetCursorPosCallback(window, note_mouse);
#endif
  return std::unique_ptr<Window>(new Window(std::move(state)));
}

Window::~Window() {
  state_->canvas.reset();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(state_->window);
  glfwTerminate();
}

bool Window::wait(double timeout_s) {
  if (has_input_left()) timeout_s = 0;
  const double start_s = glfwGetTime();
  if (timeout_s > 0)
    glfwWaitEventsTimeout(timeout_s);
  else
    glfwPollEvents();
  return has_input_left() || glfwGetTime() - start_s < timeout_s;
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::begin(const Settings& settings) {
  const double text_px = std::round(settings.font_px * screen_scale(state_->window));
  if (text_px != state_->text_px) {
    load_fonts(text_px);
    apply_theme();
    // Made anew, with the fonts, by the next NewFrame.
    ImGui_ImplOpenGL3_DestroyDeviceObjects();
    state_->canvas->forget();
    state_->text_px = text_px;
  }
  hand_on_keys(state_->window);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  hand_on_buttons(state_->window);
  ImGui::NewFrame();
}

// While a mouse button is held, the panel that it works on and the image come first: the others follow at a rate at
// which numbers can still be read. With OpenGL in software all of them together would leave a drag a dozen updates a
// second.
std::vector<ImVec2> Window::places_drawn_first(State& state, const ImVec2& image_at) {
  constexpr double kOthersInterval_s = 0.15;
  const double now_s = glfwGetTime();
  if (ImGui::IsAnyMouseDown() && now_s - state.all_drawn_s < kOthersInterval_s)
    return {ImGui::GetIO().MousePos, image_at};
  state.all_drawn_s = now_s;
  return {};
}

void Window::end(const ImVec2& image_at) {
  ImGui::Render();
  if (std::exchange(state_->incoming.needs_all, false)) state_->canvas->forget();
  if (state_->canvas->draw(*ImGui::GetDrawData(), places_drawn_first(*state_, image_at)))
    glfwSwapBuffers(state_->window);
}

int Window::released_keys() const {
  return state_->incoming.released_keys;
}

bool Window::has_input_left() const {
  return !state_->incoming.keys.empty() || !state_->incoming.buttons.empty();
}

bool Window::wants_to_close() const {
  return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::refuse_to_close() {
  glfwSetWindowShouldClose(state_->window, GLFW_FALSE);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(state_->window, title.c_str());
}

bool Window::has_dropped() const {
  return !state_->incoming.dropped.empty();
}

std::vector<std::filesystem::path> Window::take_dropped() {
  return std::exchange(state_->incoming.dropped, {});
}

void Window::remember_in(Settings& settings) const {
  settings.maximised = glfwGetWindowAttrib(state_->window, GLFW_MAXIMIZED) == GLFW_TRUE;
  if (settings.maximised || state_->full_screen) return;
  const double scale = screen_scale(state_->window);
  int width = 0;
  int height = 0;
  glfwGetWindowSize(state_->window, &width, &height);
  settings.window_width_px = static_cast<int>(width / scale);
  settings.window_height_px = static_cast<int>(height / scale);
}

void Window::toggle_full_screen() {
  State& s = *state_;
  s.full_screen = !s.full_screen;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!s.full_screen || monitor == nullptr)
    return glfwSetWindowMonitor(s.window, nullptr, s.x, s.y, std::max(s.width, 800), std::max(s.height, 480),
                                GLFW_DONT_CARE);
  glfwGetWindowPos(s.window, &s.x, &s.y);
  glfwGetWindowSize(s.window, &s.width, &s.height);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void ButtonQueue::push(const ButtonEvent& event) {
  if (event.button >= 0 && static_cast<std::size_t>(event.button) < down_.size()) events_.push_back(event);
}

Buttons ButtonQueue::take_for_update() {
  Buttons buttons;
  std::array<bool, 5> changed{};
  for (; !events_.empty(); events_.pop_front()) {
    const ButtonEvent& event = events_.front();
    const auto button = static_cast<std::size_t>(event.button);
    if (changed[button]) break;
    const Buttons::Place at{event.x, event.y};
    if (!event.down && at_ && at != *at_) {
      if (!buttons.at) buttons.at = at_ = at;
      break;
    }
    changed[button] = true;
    down_[button] = event.down;
    buttons.at = at_ = at;
  }
  buttons.down = down_;
  return buttons;
}

std::vector<KeyEvent> KeyQueue::take_for_update(bool types_text) {
  std::vector<KeyEvent> taken;
  std::set<int> changed;
  bool is_pressed = false;  // a key went down, with the modifiers as they were
  bool acts = false;        // and it may change what is done with text
  for (; !events_.empty(); events_.pop_front()) {
    const KeyEvent& event = events_.front();
    const bool is_character = event.character != 0;
    const bool waits = is_character                      ? acts
                       : event.kind == KeyKind::modifier ? is_pressed || changed.contains(event.key)
                                                         : changed.contains(event.key);
    if (waits) break;
    const bool is_reported_twice = types_text && event.kind == KeyKind::sign;
    if (!is_character && !is_reported_twice) {
      changed.insert(event.key);
      is_pressed = is_pressed || (event.down && event.kind != KeyKind::modifier);
      acts = acts || (event.down && event.kind == KeyKind::action);
    }
    taken.push_back(event);
  }
  return taken;
}

}  // namespace sigs::editor
