// SPDX-License-Identifier: MIT
#include "render/gl_objects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"
#include "render/shaders.h"

namespace sigs {
namespace {

Result<GLuint> compiled(GLenum stage, const std::string& defines, std::string_view source) {
  const std::size_t after_version = source.find('\n') + 1;  // which GLSL requires first
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

unsigned int renderbuffer(const cv::Size& size, int samples, GLenum format) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.width, size.height);
  return name;
}

void draw_to(std::initializer_list<GLenum> attachments) {
  glDrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.begin());
}

void read_plane(const cv::Point& from, GLenum format, cv::Mat& plane) {
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(plane.step / plane.elemSize()));
  glReadPixels(from.x, from.y, plane.cols, plane.rows, format, GL_FLOAT, plane.data);
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
void Program::set(const char* name, int value) const {
  glUniform1i(location(name), value);
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

Result<Target::Buffers> Target::make(const cv::Size& size, int samples, bool with_depth, unsigned int color_format) {
  Buffers buffers;
  glGenFramebuffers(1, &buffers.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, buffers.framebuffer);
  buffers.color = renderbuffer(size, samples, color_format);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers.color);
  buffers.coverage = renderbuffer(size, samples, color_format == GL_RGBA32F ? GL_R32F : GL_R16F);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, buffers.coverage);
  if (with_depth) {
    buffers.depth = renderbuffer(size, samples, GL_DEPTH_COMPONENT32F);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers.depth);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR)
    return buffers;
  release(buffers);
  return fail("OpenGL", fmt::format("cannot draw to floating-point buffers of {} pixels", image_size_text(size, " x ")),
              ErrorKind::unavailable);
}

void Target::release(const Buffers& buffers) {
  const std::array<GLuint, 3> renderbuffers{buffers.color, buffers.coverage, buffers.depth};
  glDeleteRenderbuffers(static_cast<GLsizei>(renderbuffers.size()), renderbuffers.data());
  glDeleteFramebuffers(1, &buffers.framebuffer);
}

Result<void> Target::grow(const cv::Size& size) {
  release(drawn_);
  release(resolved_);
  drawn_ = resolved_ = {};
  size_ = {0, 0};
  const GLenum formats[] = {GL_RGBA32F, GL_RGBA16F};  // the second: half floats are all that some drivers multisample
  for (const GLenum format : formats) {
    const Result<Buffers> drawn = make(size, samples_, true, format);
    const Result<Buffers> resolved = samples_ > 0 ? make(size, 0, false, format) : Buffers{};
    if (drawn && resolved) {
      drawn_ = *drawn;
      resolved_ = *resolved;
      size_ = size;
      return {};
    }
    if (drawn) release(*drawn);
    if (resolved) release(*resolved);
    if (format == formats[1]) return fail(drawn ? resolved.error() : drawn.error());
  }
  return {};
}

Result<void> Target::begin(const cv::Size& size) {
  ENSURE(size.width <= kLargestPiece_px && size.height <= kLargestPiece_px);
  if (size.width > size_.width || size.height > size_.height) {
    const auto grown = grow({std::max(size.width, size_.width), std::max(size.height, size_.height)});
    if (!grown) return grown;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.framebuffer);
  draw_to({GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
  glViewport(0, 0, size.width, size.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, size.width, size.height);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);  // all at once: what is smaller than the buffers is drawn over
  return {};
}

void Target::resolve(const cv::Size& size) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer);
  for (const GLenum attachment : {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1}) {
    glReadBuffer(attachment);
    if (attachment == GL_COLOR_ATTACHMENT0) draw_to({GL_COLOR_ATTACHMENT0});
    if (attachment == GL_COLOR_ATTACHMENT1) draw_to({GL_NONE, GL_COLOR_ATTACHMENT1});
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
}

void Target::read(cv::Mat color, cv::Mat coverage, const cv::Point& from) const {
  ENSURE(color.type() == CV_32FC4 && coverage.type() == CV_32FC1 && color.size() == coverage.size());
  if (samples_ > 0) resolve({from.x + color.cols, from.y + color.rows});
  glBindFramebuffer(GL_FRAMEBUFFER, samples_ > 0 ? resolved_.framebuffer : drawn_.framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  read_plane(from, GL_RGBA, color);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  read_plane(from, GL_RED, coverage);
}

void Target::read_depth(cv::Mat depth) const {
  ENSURE(samples_ == 0 && depth.type() == CV_32FC1);
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.framebuffer);
  read_plane({0, 0}, GL_DEPTH_COMPONENT, depth);
}

Result<DepthMask> DepthMask::create() {
  Result<Program> program = Program::create("#define DEPTH\n");
  if (!program) return fail(program.error());
  return DepthMask(std::move(*program));
}

DepthMask::DepthMask(Program program) : program_(std::move(program)) {
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &vertices_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(0);
}

void DepthMask::restrict_to(const std::vector<cv::Rect>& rects, const cv::Size& piece) {
  std::vector<glm::vec3> corners;
  for (const cv::Rect& rect : rects) {
    const auto corner = [&](int x, int y) {
      return glm::vec3(2.0 * x / piece.width - 1, 2.0 * y / piece.height - 1, 1);
    };
    const glm::vec3 a = corner(rect.x, rect.y);
    const glm::vec3 b = corner(rect.x + rect.width, rect.y);
    const glm::vec3 c = corner(rect.x + rect.width, rect.y + rect.height);
    const glm::vec3 d = corner(rect.x, rect.y + rect.height);
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  glDepthMask(GL_TRUE);
  glClearDepth(0);
  glClear(GL_DEPTH_BUFFER_BIT);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)), corners.data(),
               GL_STREAM_DRAW);
  program_.use();
  program_.set("clip_from_body", glm::mat4(1));
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthFunc(GL_ALWAYS);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  cv::Rect around;
  for (const cv::Rect& rect : rects) around |= rect;
  glScissor(around.x, around.y, around.width, around.height);
}

cv::Mat BufferPool::image(const cv::Size& size, int type) {
  ENSURE(CV_MAT_DEPTH(type) == CV_32F && !size.empty());
  constexpr std::size_t kMaxTimesTooLarge = 4;  // an intruder that flies away gives its memory back
  const std::size_t floats = static_cast<std::size_t>(size.area()) * CV_MAT_CN(type);
  const auto is_free = [](const cv::Mat& buffer) { return buffer.u->refcount == 1; };
  // The smallest that will do, so that a frame's large images find the large ones.
  auto found = buffers_.end();
  for (auto buffer = buffers_.begin(); buffer != buffers_.end(); ++buffer)
    if (is_free(*buffer) && buffer->total() >= floats && buffer->total() <= kMaxTimesTooLarge * floats &&
        (found == buffers_.end() || buffer->total() < found->total()))
      found = buffer;
  if (found == buffers_.end()) {
    std::erase_if(buffers_, is_free);
    buffers_.emplace_back(1, static_cast<int>(floats + floats / 4), CV_32FC1);  // the next frame's may be larger
    found = buffers_.end() - 1;
  }
  cv::Mat image = found->colRange(0, static_cast<int>(floats)).reshape(CV_MAT_CN(type), size.height);
  // A whole image: of a part, OpenCV's filters would take what lies beyond its edges from the rest of the buffer.
  image.flags &= ~cv::Mat::SUBMATRIX_FLAG;
  image.dataend = image.datalimit = image.data + floats * sizeof(float);
  return image;
}

}  // namespace sigs
