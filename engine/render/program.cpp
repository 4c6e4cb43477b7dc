// SPDX-License-Identifier: MIT
#include "render/program.h"

#include <epoxy/gl.h>

#include <array>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "base/ensure.h"
#include "render/shaders.h"

namespace sigs {
namespace {

Result<GLuint> compiled(GLenum stage, const std::string& defines, std::string_view source) {
  const std::size_t after_version = source.find('\n') + 1;  // which GLSL wants first
  const std::string text =
      std::string(source.substr(0, after_version)) + defines + std::string(source.substr(after_version));
  const char* start = text.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &start, nullptr);
  glCompileShader(shader);
  GLint is_good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
  if (is_good == GL_TRUE) return shader;
  std::array<char, 2000> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail("OpenGL", std::string("the driver refuses a shader: ") + log.data(), ErrorKind::unavailable);
}

std::map<std::string, int, std::less<>> locations_of(GLuint program) {
  std::map<std::string, int, std::less<>> locations;
  GLint count = 0;
  glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  for (GLint i = 0; i < count; ++i) {
    std::array<char, 100> name{};
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(program, static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), nullptr, &size, &type,
                       name.data());
    locations[name.data()] = glGetUniformLocation(program, name.data());
  }
  return locations;
}

}  // namespace

Result<Program> Program::create(const std::string& defines) {
  const Result<GLuint> vertex = compiled(GL_VERTEX_SHADER, defines, shaders::kIntruderVert);
  if (!vertex) return fail(vertex.error());
  const Result<GLuint> fragment = compiled(GL_FRAGMENT_SHADER, defines, shaders::kIntruderFrag);
  if (!fragment) return fail(fragment.error());
  const GLuint program = glCreateProgram();
  glAttachShader(program, *vertex);
  glAttachShader(program, *fragment);
  glLinkProgram(program);
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint is_good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &is_good);
  if (is_good == GL_TRUE) return Program(program);
  std::array<char, 2000> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail("OpenGL", std::string("the driver cannot link the shaders: ") + log.data(), ErrorKind::unavailable);
}

Program::Program(unsigned int name) : name_(name), locations_(locations_of(name)) {}

void Program::use() const {
  glUseProgram(name_);
}

int Program::location(const char* name) const {
  const auto found = locations_.find(std::string_view(name));
  ENSURE(found != locations_.end());
  return found->second;
}

void Program::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}
void Program::set(const char* name, bool value) const {
  glUniform1i(location(name), value ? 1 : 0);
}
void Program::set(const char* name, const glm::vec3& value) const {
  glUniform3fv(location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat3& value) const {
  glUniformMatrix3fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace sigs
