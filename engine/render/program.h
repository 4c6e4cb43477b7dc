// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>

#include "base/result.h"

namespace sigs {

// The shaders of assets/shaders, compiled in the current context, which owns them.
class Program {
 public:
  //   defines  lines to go before the shaders: "#define NAME\n..."
  // Error unavailable with the driver's own words.
  [[nodiscard]] static Result<Program> create(const std::string& defines);

  void use() const;

  // Names must be those of the shaders' uniforms.
  void set(const char* name, float value) const;
  void set(const char* name, bool value) const;
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::mat3& value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  explicit Program(unsigned int name);
  [[nodiscard]] int location(const char* name) const;

  unsigned int name_ = 0;
  std::map<std::string, int, std::less<>> locations_;
};

}  // namespace sigs
