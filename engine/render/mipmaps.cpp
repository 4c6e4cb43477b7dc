// SPDX-License-Identifier: MIT
#include "render/mipmaps.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

#include "base/ensure.h"

namespace sigs {

namespace {

// A triangle around the whole viewport.
constexpr const char* kVertexShader = R"glsl(#version 330 core
void main() {
  gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 2.0 * float(gl_VertexID & 2) - 1.0, 0.0, 1.0);
}
)glsl";

// Bilinear, in linear light: of even sizes the mean of four texels.
constexpr const char* kFragmentShader = R"glsl(#version 330 core
uniform sampler2D image;
uniform vec2 ratio;  // of the sizes of the larger to the smaller level
layout(location = 0) out vec4 color;

void main() {
  vec2 at = gl_FragCoord.xy * ratio - 0.5;
  vec2 share = fract(at);
  ivec2 low = ivec2(floor(at));
  ivec2 last = textureSize(image, 0) - 1;
  ivec2 high = min(low + 1, last);
  low = max(low, ivec2(0));
  vec4 a = texelFetch(image, low, 0);
  vec4 b = texelFetch(image, ivec2(high.x, low.y), 0);
  vec4 c = texelFetch(image, ivec2(low.x, high.y), 0);
  vec4 d = texelFetch(image, high, 0);
  vec4 top = a + share.x * (b - a);
  vec4 bottom = c + share.x * (d - c);
  color = top + share.y * (bottom - top);
}
)glsl";

GLuint compiled_stage(GLenum stage, const char* source) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  return shader;
}

// 0 where the driver refuses it.
GLuint linked_program() {
  const GLuint vertex = compiled_stage(GL_VERTEX_SHADER, kVertexShader);
  const GLuint fragment = compiled_stage(GL_FRAGMENT_SHADER, kFragmentShader);
  const GLuint program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint is_good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &is_good);
  if (is_good == GL_TRUE) return program;
  glDeleteProgram(program);
  return 0;
}

float ratio_of(int above, int below) {
  return static_cast<float>(above) / static_cast<float>(below);
}

cv::Size half_of(const cv::Size& size) {
  return {std::max(size.width / 2, 1), std::max(size.height / 2, 1)};
}

}  // namespace

Mipmaps::Mipmaps() {
  if (epoxy_gl_version() < 42 && !epoxy_has_gl_extension("GL_ARB_texture_storage")) return;
  program_ = linked_program();
  if (program_ == 0) return;
  glGenFramebuffers(1, &framebuffer_);
  glGenVertexArrays(1, &vertex_array_);
}

Mipmaps::~Mipmaps() {
  if (program_ == 0) return;
  glDeleteProgram(program_);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteVertexArrays(1, &vertex_array_);
}

unsigned int Mipmaps::uploaded(const cv::Mat& texels) const {
  ENSURE(texels.type() == CV_8UC4 && texels.isContinuous());
  GLuint name = 0;
  glGenTextures(1, &name);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (program_ == 0) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, texels.cols, texels.rows, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 texels.data);
    glGenerateMipmap(GL_TEXTURE_2D);
    return name;
  }
  const int levels = std::bit_width(static_cast<unsigned>(std::max(texels.cols, texels.rows)));
  glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, texels.cols, texels.rows);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texels.cols, texels.rows, GL_RGBA, GL_UNSIGNED_BYTE, texels.data);
  halve(name, texels.size(), levels);
  return name;
}

// Each level from the one above it, which alone is visible to the shader meanwhile.
void Mipmaps::halve(unsigned int texture, const cv::Size& size, int levels) const {
  for (const GLenum state : {GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE, GL_MULTISAMPLE}) glDisable(state);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glBindVertexArray(vertex_array_);
  glUseProgram(program_);
  glUniform1i(glGetUniformLocation(program_, "image"), 0);
  cv::Size above = size;
  for (int level = 1; level < levels; ++level) {
    const cv::Size below = half_of(above);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level - 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, level);
    glViewport(0, 0, below.width, below.height);
    glUniform2f(glGetUniformLocation(program_, "ratio"), ratio_of(above.width, below.width),
                ratio_of(above.height, below.height));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    above = below;
  }
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace sigs
