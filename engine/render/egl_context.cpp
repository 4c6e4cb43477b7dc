// SPDX-License-Identifier: MIT
#include "render/egl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/threads.h"

namespace sigs {

namespace {

std::string how_to_get_opengl() {
  return "install libegl1, libegl-mesa0 and libgl1-mesa-dri (Debian, Ubuntu), or a GPU's driver";
}

// Checks that one of the libraries can be loaded and has the functions. It stays loaded: libepoxy opens the same.
Result<void> check_library(std::initializer_list<const char*> names, std::initializer_list<const char*> functions) {
  std::string why;
  for (const char* const name : names) {
    void* const library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    const char* missing = nullptr;
    for (const char* const function : functions)
      if (library != nullptr && missing == nullptr && dlsym(library, function) == nullptr) missing = function;
    if (library != nullptr && missing == nullptr) return {};
    const char* const said = library == nullptr ? dlerror() : nullptr;
    why += (why.empty() ? "" : "; ") + (missing != nullptr ? fmt::format("{} has no {}", name, missing)
                                                           : std::string(said != nullptr ? said : name));
  }
  return fail("OpenGL", fmt::format("cannot be loaded ({}); {}", why, how_to_get_opengl()), ErrorKind::unavailable);
}

// Checks that the libraries of EGL and OpenGL can be loaded and have the functions that are called. libepoxy looks for
// them at the first call and ends the program where it does not find them, so this comes before. Error unavailable.
Result<void> check_egl_library() {
  Result<void> egl = check_library(
      {"libEGL.so.1"}, {"eglQueryString", "eglGetProcAddress", "eglGetError", "eglInitialize", "eglBindAPI",
                        "eglQueryAPI", "eglChooseConfig", "eglCreateContext", "eglDestroyContext", "eglMakeCurrent",
                        "eglGetCurrentContext", "eglGetCurrentDisplay", "eglQueryContext"});
  if (!egl) return egl;
  return check_library({"libOpenGL.so.0", "libGL.so.1"}, {"glGetString", "glGetIntegerv", "glGetError"});
}

// A display of EGL, and the name of the way to it.
struct Platform {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
};

bool has_client_extension(const char* name) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

std::optional<Platform> surfaceless_platform() {
  if (!has_client_extension("EGL_EXT_platform_base") || !has_client_extension("EGL_MESA_platform_surfaceless"))
    return std::nullopt;
  return Platform{"surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)};
}

std::vector<EGLDeviceEXT> listed_devices() {
  const bool can_list =
      has_client_extension("EGL_EXT_device_enumeration") || has_client_extension("EGL_EXT_device_base");
  if (!can_list || !has_client_extension("EGL_EXT_platform_device")) return {};
  std::array<EGLDeviceEXT, 64> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return {};
  return std::vector<EGLDeviceEXT>(devices.begin(), devices.begin() + count);  // braces would list two pointers
}

// Draws on the processor. Only Mesa lists such a device, as the last one.
bool is_software(EGLDeviceEXT device) {
  const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
}

// number: as EGL lists them; none: all, hardware before software.
std::vector<Platform> device_platforms(std::optional<std::size_t> number) {
  const std::vector<EGLDeviceEXT> devices = listed_devices();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (!number || *number == i) order.push_back(i);
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return !is_software(devices[i]); });
  std::vector<Platform> platforms;
  for (const std::size_t i : order)
    platforms.push_back(
        {fmt::format("EGL device {}", i), eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
  return platforms;
}

std::string hexadecimal(EGLint code) {
  return fmt::format("0x{:04X}", static_cast<unsigned>(code));
}

EGLConfig config_of(EGLDisplay display) {
  if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context") ||
      epoxy_has_egl_extension(display, "EGL_MESA_configless_context"))
    return nullptr;
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, wanted.data(), &config, 1, &count);
  return count > 0 ? config : nullptr;
}

EGLContext context_of(EGLDisplay display, EGLint major, EGLint minor) {
  const std::array<EGLint, 7> attributes{
      EGL_CONTEXT_MAJOR_VERSION,           major,   EGL_CONTEXT_MINOR_VERSION, minor, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return eglCreateContext(display, config_of(display), EGL_NO_CONTEXT, attributes.data());
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

std::string description_of(const Platform& platform) {
  const int version = epoxy_gl_version();
  return fmt::format("{}, {}, OpenGL {}.{}", platform.name, text_of(GL_RENDERER), version / 10, version % 10);
}

// Mesa's driver and its compiler crash where memory cannot be had, and the library that chooses a driver ends the
// program while it is loaded. They and the first textures take some 400 MiB of addresses.
Result<void> check_memory() {
  constexpr std::size_t kDriverMemory_bytes = std::size_t{512} << 20;
  if (has_free_memory(kDriverMemory_bytes)) return {};
  return fail("OpenGL", "out of memory: 512 MiB more must be free for it", ErrorKind::unavailable);
}

// Mesa's software renderer starts a thread for each core, 32 at most, and waits endlessly for those that it could not
// start. So that many, and two for its caches, are tried before it does.
Result<void> check_threads() {
  const unsigned count = std::min(std::thread::hardware_concurrency(), 32U) + 2;
  std::vector<std::thread> threads;
  threads.reserve(count);
  std::mutex gate;
  Result<void> all;
  {
    const std::lock_guard closed(gate);  // none ends before all are there
    while (all && threads.size() < count) {
      Result<std::thread> thread = started_thread([&gate] { const std::lock_guard pass(gate); });
      if (thread)
        threads.push_back(std::move(*thread));
      else
        all = fail(std::move(thread.error()));
    }
  }
  for (std::thread& thread : threads) thread.join();
  return all;
}

// OpenGL 4.5, else 3.3.
Result<EGLContext> new_context(EGLDisplay display) {
  static std::mutex one_at_a_time;  // so that the memory and threads just tried are still available to the driver
  const std::lock_guard lock(one_at_a_time);
  if (const Result<void> threads = check_threads(); !threads) return fail(threads.error());
  const EGLContext context = context_of(display, 4, 5);
  return context != EGL_NO_CONTEXT ? context : context_of(display, 3, 3);
}

// The context, current, or why there is none.
Result<EGLContext> opened(const Platform& platform) {
  const auto failed = [&](const char* step) {
    return fail(platform.name, step + (" (" + hexadecimal(eglGetError()) + ")"));
  };
  if (platform.display == EGL_NO_DISPLAY) return failed("no display");
  EGLint major = 0;
  EGLint minor = 0;
  if (!eglInitialize(platform.display, &major, &minor)) return failed("cannot be initialised");
  if (!eglBindAPI(EGL_OPENGL_API)) return failed("has no OpenGL");
  if (!epoxy_has_egl_extension(platform.display, "EGL_KHR_surfaceless_context")) return failed("needs a surface");
  const Result<EGLContext> context = new_context(platform.display);
  if (!context) return context;
  if (*context == EGL_NO_CONTEXT) return failed("has no OpenGL 3.3 core");
  if (eglMakeCurrent(platform.display, EGL_NO_SURFACE, EGL_NO_SURFACE, *context)) return context;
  eglDestroyContext(platform.display, *context);
  return failed("cannot make its context current");
}

// What the variable asks for.
struct Choice {
  bool surfaceless = true;
  bool devices = true;
  std::optional<std::size_t> device;  // none: all
};

Result<Choice> choice() {
  const char* const set = std::getenv(kEglVariable);
  const std::string_view text = set == nullptr ? "" : set;
  if (text.empty()) return Choice{};
  if (text == "surfaceless") return Choice{.devices = false};
  if (text == "device") return Choice{.surfaceless = false};
  constexpr std::string_view kNumbered = "device:";
  std::size_t number = 0;
  if (text.starts_with(kNumbered)) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + kNumbered.size(), end, number);
    if (error == std::errc() && stop == end) return Choice{.surfaceless = false, .device = number};
  }
  return fail(kEglVariable, fmt::format("expected surfaceless, device or device:N, found '{}'", text),
              ErrorKind::usage);
}

std::vector<Platform> platforms(const Choice& wanted) {
  std::vector<Platform> all;
  if (wanted.surfaceless)
    if (const auto platform = surfaceless_platform()) all.push_back(*platform);
  if (wanted.devices)
    for (Platform& platform : device_platforms(wanted.device)) all.push_back(std::move(platform));
  return all;
}

}  // namespace

std::unique_lock<std::mutex> EglContext::lock_drawing() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

std::unique_lock<std::mutex> EglContext::lock_if_shared() const {
  if (description_.find("llvmpipe") == std::string::npos) return {};
  return lock_drawing();
}

Result<EglContext> EglContext::create() {
  const Result<Choice> wanted = choice();
  if (!wanted) return fail(wanted.error());
  if (const Result<void> memory = check_memory(); !memory) return fail(memory.error());
  if (const Result<void> library = check_egl_library(); !library) return fail(library.error());
  std::string tried;
  for (const Platform& platform : platforms(*wanted)) {
    const Result<EGLContext> context = opened(platform);
    if (context) return EglContext(platform.display, *context, description_of(platform));
    tried += (tried.empty() ? "" : "; ") + context.error().text();
  }
  if (tried.empty())
    tried = std::getenv(kEglVariable) == nullptr ? "EGL offers neither the surfaceless platform nor devices"
                                                 : fmt::format("EGL offers nothing that {} asks for", kEglVariable);
  return fail("OpenGL", fmt::format("cannot be had without a display: {}; {}", tried, how_to_get_opengl()),
              ErrorKind::unavailable);
}

EglContext::EglContext(void* display, void* context, std::string description)
    : display_(display), context_(context), description_(std::move(description)), thread_(std::this_thread::get_id()) {}

EglContext::EglContext(EglContext&& other) noexcept
    : display_(other.display_),
      context_(std::exchange(other.context_, nullptr)),
      description_(std::move(other.description_)),
      thread_(other.thread_) {}

EglContext& EglContext::operator=(EglContext&& other) noexcept {
  if (this == &other) return *this;
  destroy();
  display_ = other.display_;
  context_ = std::exchange(other.context_, nullptr);
  description_ = std::move(other.description_);
  thread_ = other.thread_;
  return *this;
}

EglContext::~EglContext() {
  destroy();
}

bool EglContext::make_current() const {
  ENSURE(thread_ == std::this_thread::get_id());
  if (eglGetCurrentContext() == context_) return true;
  return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

// The display stays initialised: other contexts of the process may live on it.
void EglContext::destroy() noexcept {
  if (context_ == nullptr) return;
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  context_ = nullptr;
}

}  // namespace sigs
