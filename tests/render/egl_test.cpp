// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "render/egl_context.h"
#include "render/renderer.h"
#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

// Sets the variable for the life of this object.
struct Chosen {
  explicit Chosen(const char* text) { setenv(kEglVariable, text, 1); }
  ~Chosen() { unsetenv(kEglVariable); }
  Chosen(const Chosen&) = delete;
  Chosen& operator=(const Chosen&) = delete;
};

// What the driver calls itself: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5".
std::string driver_of(const Renderer& renderer) {
  return renderer.description().substr(renderer.description().find(", ") + 2);
}

Layer drawn_by(Renderer& renderer) {
  static const Mesh mesh = box({1, 2, 0.5F}, paint({0.8F, 0.6F, 0.4F}, 0.7F));
  const Pose<frame::Camera, frame::Body> turned{rotation_of({0.3, -0.2, 2.5}), {12, 0.4, -0.3}};
  const Layer layer = renderer.draw(mesh, turned, {.p_in_camera = {-20, 40, -30}}, view_of({160, 120}, 300)).value();
  renderer.forget(mesh);
  return layer;
}

Result<Renderer> renderer_by(const char* text) {
  const Chosen chosen(text);
  return Renderer::create();
}

}  // namespace

TEST_CASE("a layer has the same bytes by EGL's surfaceless platform and by its devices, where the driver is the same") {
  Result<Renderer> surfaceless = renderer_by("surfaceless");
  Result<Renderer> device = renderer_by("device");
  if (!surfaceless || !device) {
    MESSAGE("SKIPPED: this machine has not both platforms");
    return;
  }
  CHECK(surfaceless->description().starts_with("surfaceless, "));
  CHECK(device->description().starts_with("EGL device "));
  const Layer by_surfaceless = drawn_by(*surfaceless);
  const Layer by_device = drawn_by(*device);
  CHECK(is_valid(by_device));
  CHECK(cv::countNonZero(by_device.coverage) > 1000);
  if (driver_of(*surfaceless) == driver_of(*device)) {
    CHECK(same_bytes(by_surfaceless.color, by_device.color));
    CHECK(same_bytes(by_surfaceless.coverage, by_device.coverage));
  }
  CHECK(same_bytes(by_surfaceless.color, drawn_by(*surfaceless).color));  // contexts of both take turns
}

TEST_CASE("a device is chosen by its number, and one that is not there is an error that says so") {
  const Result<Renderer> first = renderer_by("device:0");
  if (first) CHECK(first->description().starts_with("EGL device 0, "));
  const Result<Renderer> none = renderer_by("device:63");
  REQUIRE_FALSE(none);
  CHECK(none.error().kind == ErrorKind::unavailable);
  CHECK(none.error().what.find(kEglVariable) != std::string::npos);
}

TEST_CASE("another value of the variable is an error that lists the good ones") {
  for (const char* const text : {"gpu", "device:", "device:x", "device:-1", "device:1 ", "surfaceless "}) {
    CAPTURE(text);
    const Result<Renderer> made = renderer_by(text);
    REQUIRE_FALSE(made);
    CHECK(made.error().kind == ErrorKind::usage);
    CHECK(made.error().where == kEglVariable);
    CHECK(made.error().what.find("device:N") != std::string::npos);
  }
}

}  // namespace sigs
