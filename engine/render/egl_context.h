// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <thread>

#include "base/result.h"

namespace sigs {

// Names the environment variable by which a person chooses what draws: `surfaceless`, EGL's surfaceless platform alone;
// `device`, EGL's devices alone, those that draw in hardware first; `device:N`, the device with that number as EGL
// lists them, from 0. Not set or empty: the surfaceless platform, then the devices.
inline constexpr const char* kEglVariable = "SIGS_EGL";

// An OpenGL core context without window and surface, made through EGL. It belongs to the thread that created it.
class EglContext {
 public:
  // Tries the platforms that kEglVariable asks for, in that order, each with OpenGL 4.5, else 3.3. The context is
  // current on return. Error usage where the variable has another value; error unavailable says what was tried, how
  // each attempt failed and what to install.
  [[nodiscard]] static Result<EglContext> create();

  EglContext(EglContext&& other) noexcept;
  EglContext& operator=(EglContext&& other) noexcept;
  ~EglContext();

  // Makes the context current, as needed where several take turns on one thread. False where the driver refuses.
  [[nodiscard]] bool make_current() const;

  // Mesa's software renderer asks every context of a display which images its unfinished drawing uses, without waiting
  // for the threads that draw there: llvmpipe of Mesa 22.3 crashed so, once in some hundred editors. So one thread at a
  // time draws with it; what it draws is spread over all cores anyway. Other drivers: a lock of nothing.
  [[nodiscard]] std::unique_lock<std::mutex> lock_if_shared() const;
  // The same where the driver is not known yet, or no longer.
  [[nodiscard]] static std::unique_lock<std::mutex> lock_drawing();

  // Platform, renderer and version: "surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"
  [[nodiscard]] const std::string& description() const { return description_; }

 private:
  EglContext(void* display, void* context, std::string description);
  void destroy() noexcept;

  void* display_ = nullptr;
  void* context_ = nullptr;  // null: nothing to destroy
  std::string description_;
  std::thread::id thread_;
};

}  // namespace sigs
