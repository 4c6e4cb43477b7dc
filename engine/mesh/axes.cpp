// SPDX-License-Identifier: MIT
#include "mesh/axes.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sigs {
namespace {

std::optional<glm::dvec3> direction_of(std::string_view text) {
  constexpr std::string_view kLetters = "xyz";
  if (text.size() != 2 || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::size_t axis = kLetters.find(text[1]);
  if (axis == std::string_view::npos) return std::nullopt;
  glm::dvec3 direction{0, 0, 0};
  direction[static_cast<int>(axis)] = text[0] == '+' ? 1 : -1;
  return direction;
}

tl::unexpected<Error> fail_axis(const char* setting, const std::string& text) {
  return fail(setting, "expected one of +x -x +y -y +z -z, found \"" + text + "\"", ErrorKind::bad_project);
}

}  // namespace

Result<glm::dmat3> body_from_model(const ModelAxes& axes) {
  const auto forward = direction_of(axes.forward);
  if (!forward) return fail_axis("forward", axes.forward);
  const auto up = direction_of(axes.up);
  if (!up) return fail_axis("up", axes.up);
  if (glm::dot(*forward, *up) != 0)
    return fail("up", "lies along forward (" + axes.forward + ")", ErrorKind::bad_project);
  if (!std::isfinite(axes.scale) || axes.scale <= 0)
    return fail("scale", "must be a positive number", ErrorKind::bad_project);
  if (!std::isfinite(axes.length_m) || axes.length_m < 0)
    return fail("length_m", "must be a positive number, or 0 to use scale", ErrorKind::bad_project);

  const glm::dvec3 down = -*up;
  const glm::dvec3 right = glm::cross(down, *forward);
  return glm::transpose(glm::dmat3(*forward, right, down));
}

}  // namespace sigs
