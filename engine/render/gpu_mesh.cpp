// SPDX-License-Identifier: MIT
#include "render/gpu_mesh.h"

#include <epoxy/gl.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <glm/glm.hpp>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "base/transfer.h"

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

// A material in the form in which the shaders get it with each vertex, so that one call draws many materials.
struct VertexMaterial {
  glm::vec4 color;  // linear diffuse; opacity, 1 where solid
  glm::vec4 gloss;  // specular; shininess within 1..200
};

glm::vec3 linear_color(const glm::vec3& display) {
  return {linear_of_display(display.x), linear_of_display(display.y), linear_of_display(display.z)};
}

VertexMaterial vertex_material_of(const Material& material) {
  const float opacity = material.opacity >= kSolidOpacity ? 1.0F : std::max(material.opacity, 0.0F);
  return {{linear_color(material.diffuse), opacity}, {material.specular, std::clamp(material.shininess, 1.0F, 200.0F)}};
}

// The same mesh where each vertex belongs to triangles of one material only: vertices that materials share are
// duplicated.
Mesh split_by_material(const Mesh& mesh) {
  constexpr int kNone = -1;
  Mesh split = mesh;
  std::vector<int> owner(mesh.vertices.size(), kNone);
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> doubles;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      std::uint32_t& index = split.indices[i];
      if (owner[index] == kNone) owner[index] = part.material;
      if (owner[index] == part.material) continue;
      const auto [known, is_first] =
          doubles.try_emplace({index, part.material}, static_cast<std::uint32_t>(split.vertices.size()));
      if (is_first) split.vertices.push_back(mesh.vertices[index]);
      index = known->second;
    }
  return split;
}

// One for each vertex of a mesh from split_by_material().
std::vector<VertexMaterial> vertex_materials(const Mesh& split) {
  std::vector<VertexMaterial> of_materials;
  for (const Material& material : split.materials) of_materials.push_back(vertex_material_of(material));
  std::vector<VertexMaterial> per_vertex(split.vertices.size(), VertexMaterial{});
  for (const MeshPart& part : split.parts)
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
      per_vertex[split.indices[i]] = of_materials[part.material];
  return per_vertex;
}

// Colour times opacity, in linear light, so that filtering does not mix in the colour of transparent texels.
cv::Mat premultiplied(const cv::Mat& rgba) {
  std::array<float, 256> linear{};
  for (int i = 0; i < 256; ++i) linear[i] = linear_of_display(static_cast<float>(i) / 255.0F);
  cv::Mat result = rgba.clone();
  result.forEach<cv::Vec4b>([&](cv::Vec4b& texel, const int*) {
    if (texel[3] == 255) return;
    const float opacity = static_cast<float>(texel[3]) / 255.0F;
    for (int i = 0; i < 3; ++i)
      texel[i] = cv::saturate_cast<uchar>(255.0F * display_of_linear(linear[texel[i]] * opacity));
  });
  return result;
}

cv::Mat fitting(const cv::Mat& texture) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (texture.cols <= largest && texture.rows <= largest) return texture;
  cv::Mat smaller;
  cv::resize(texture, smaller, {std::min(texture.cols, largest), std::min(texture.rows, largest)}, 0, 0,
             cv::INTER_AREA);
  return smaller;
}

GLuint uploaded(const cv::Mat& texture, const Mipmaps& mipmaps) {
  ENSURE(texture.type() == CV_8UC4);
  const GLuint name = mipmaps.uploaded(premultiplied(fitting(texture)));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  return name;
}

// Sets an attribute of `count` floats at an offset in Holder, the type of the elements in the current buffer.
template <class Holder>
void set_attribute(GLuint index, GLint count, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, sizeof(Holder), reinterpret_cast<const void*>(offset));
}

template <class T>
std::int64_t upload(GLenum target, GLuint buffer, const std::vector<T>& data, GLenum usage) {
  const std::size_t size = data.size() * sizeof(T);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(size), data.data(), usage);
  return static_cast<std::int64_t>(size);
}

// FNV-1a (Fowler, Noll, Vo), word by word.
class Fingerprint {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3ULL; }
  void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
  void add(const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

void add_texture(Fingerprint& print, const cv::Mat& texture) {
  constexpr int kLooksASide = 16;
  print.add(std::uint64_t{texture.total()});
  for (int y = 0; y < texture.rows; y += texture.rows / kLooksASide + 1)
    for (int x = 0; x < texture.cols; x += texture.cols / kLooksASide + 1)
      for (const uchar value : texture.at<cv::Vec4b>(y, x).val) print.add(std::uint64_t{value});
}

std::uint64_t fingerprint_of(const Mesh& mesh) {
  constexpr std::size_t kLooks = 4096;
  Fingerprint print;
  print.add(std::uint64_t{mesh.vertices.size()});
  for (std::size_t i = 0; i < mesh.vertices.size(); i += mesh.vertices.size() / kLooks + 1) {
    print.add(mesh.vertices[i].position_m);
    print.add(mesh.vertices[i].normal);
    print.add(glm::vec3(mesh.vertices[i].uv, 0));
  }
  print.add(std::uint64_t{mesh.indices.size()});
  for (std::size_t i = 0; i < mesh.indices.size(); i += mesh.indices.size() / kLooks + 1)
    print.add(std::uint64_t{mesh.indices[i]});
  for (const MeshPart& part : mesh.parts) {
    print.add(static_cast<std::uint64_t>(part.material));
    print.add(std::uint64_t{part.index_count});
  }
  for (const Material& material : mesh.materials) {
    print.add(material.diffuse);
    print.add(material.specular);
    print.add(material.shininess);
    print.add(material.opacity);
    print.add(std::uint64_t{material.rotor.has_value()});
    add_texture(print, material.texture);
  }
  return print.value();
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

void leave_out(CullFace side) {
  if (side == CullFace::none) return glDisable(GL_CULL_FACE);
  glEnable(GL_CULL_FACE);
  glCullFace(side == CullFace::back ? GL_BACK : GL_FRONT);
}

GpuMesh::GpuMesh(const Mesh& mesh) : fingerprint_(fingerprint_of(mesh)), texture_of_material_(texture_numbers(mesh)) {
  const Mesh split = split_by_material(mesh);
  const std::vector<Surface> surfaces = surfaces_of(split);
  const DrawList solid = solid_list(split, surfaces, texture_of_material_);
  solid_ = solid.runs;
  transparent_triangles_ = sigs::transparent_triangles(split, surfaces);

  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &vertex_buffer_);
  glGenBuffers(1, &material_buffer_);
  glGenBuffers(1, &solid_indices_);
  glGenBuffers(1, &sorted_indices_);
  glBindVertexArray(vertex_array_);
  bytes_uploaded_ += upload(GL_ARRAY_BUFFER, vertex_buffer_, split.vertices, GL_STATIC_DRAW);
  set_attribute<Vertex>(0, 3, offsetof(Vertex, position_m));
  set_attribute<Vertex>(1, 3, offsetof(Vertex, normal));
  set_attribute<Vertex>(2, 2, offsetof(Vertex, uv));
  bytes_uploaded_ += upload(GL_ARRAY_BUFFER, material_buffer_, vertex_materials(split), GL_STATIC_DRAW);
  set_attribute<VertexMaterial>(3, 4, offsetof(VertexMaterial, color));
  set_attribute<VertexMaterial>(4, 4, offsetof(VertexMaterial, gloss));
  bytes_uploaded_ += upload(GL_ELEMENT_ARRAY_BUFFER, solid_indices_, solid.indices, GL_STATIC_DRAW);
  upload_textures(mesh);
}

void GpuMesh::upload_textures(const Mesh& mesh) {
  const bool has_textures = std::any_of(texture_of_material_.begin(), texture_of_material_.end(),
                                        [](int texture) { return texture != kNoTexture; });
  if (!has_textures) return;
  const Mipmaps mipmaps;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const cv::Mat& texture = mesh.materials[i].texture;
    if (texture_of_material_[i] != static_cast<int>(textures_.size())) continue;  // has none, or it is there
    textures_.push_back(uploaded(texture, mipmaps));
    bytes_uploaded_ += static_cast<std::int64_t>(texture.total() * texture.elemSize());
  }
}

bool GpuMesh::is_copy_of(const Mesh& mesh) const {
  return fingerprint_ == fingerprint_of(mesh);
}

void GpuMesh::release() {
  const std::array<GLuint, 4> buffers{vertex_buffer_, material_buffer_, solid_indices_, sorted_indices_};
  glDeleteBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
}

DrawList GpuMesh::sorted_for(const glm::dvec3& eye_m) const {
  return sorted_list(transparent_triangles_, texture_of_material_, eye_m);
}

const std::vector<Run>& GpuMesh::bind_solid() const {
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, solid_indices_);
  return solid_;
}

void GpuMesh::bind_sorted(const DrawList& list) const {
  glBindVertexArray(vertex_array_);
  upload(GL_ELEMENT_ARRAY_BUFFER, sorted_indices_, list.indices, GL_STREAM_DRAW);
}

void GpuMesh::draw(const Run& run) const {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(run.first * sizeof(std::uint32_t)));
}

void GpuMesh::bind_texture(int texture) const {
  if (texture == kNoTexture) return;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, textures_[texture]);
}

GpuMesh& uploaded_mesh(std::map<const Mesh*, GpuMesh>& meshes, const Mesh& mesh) {
  const auto known = meshes.find(&mesh);
  if (known != meshes.end() && known->second.is_copy_of(mesh)) return known->second;
  if (known != meshes.end()) {
    known->second.release();
    meshes.erase(known);
  }
  return meshes.emplace(&mesh, GpuMesh(mesh)).first->second;
}

}  // namespace sigs
