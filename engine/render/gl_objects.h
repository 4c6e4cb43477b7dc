// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// OpenGL objects behind C++ types. They belong to the context that is current when they are created.

// The shaders of assets/shaders, compiled and linked.
class Program {
 public:
  //   defines  lines to put before the shaders: "#define NAME\n..."
  // Error unavailable with the driver's message.
  [[nodiscard]] static Result<Program> create(const std::string& defines);

  // Makes the following draw calls and set() calls use this program.
  void use() const;

  // Set a uniform of the program in use. The name must be that of a uniform in the shaders.
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;  // a sampler's texture unit too
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::mat3& value) const;
  void set(const char* name, const glm::mat4& value) const;

 private:
  explicit Program(unsigned int name);
  [[nodiscard]] int location(const char* name) const;

  unsigned int name_ = 0;
  std::map<std::string, int, std::less<>> locations_;
};

// The render target: buffers of colour (RGBA), coverage and depth, all floating point, with several samples for each
// pixel. They are enlarged when a larger piece is begun.
class Target {
 public:
  // Views are drawn in pieces of at most this many pixels on each side, so that the buffers do not grow with the view.
  static constexpr int kLargestPiece_px = 1024;

  // samples_per_pixel: 1 (no multisampling), 2, 4 or 8. Creates no buffers yet; begin() does.
  explicit Target(int samples_per_pixel) : samples_(samples_per_pixel > 1 ? samples_per_pixel : 0) {}

  [[nodiscard]] int samples() const { return samples_; }  // of each pixel; 0: no multisampling

  // Prepares buffers of at least this size and clears them. Error unavailable where the driver cannot draw to them.
  [[nodiscard]] Result<void> begin(const cv::Size& size);

  // Averages the samples and copies them to parts of larger images (CV_32FC4 and CV_32FC1). from: the piece's pixel
  // that is copied to the first one.
  void read(cv::Mat color, cv::Mat coverage, const cv::Point& from = {0, 0}) const;

  // Copies the depths of a target without multisampling (CV_32FC1).
  void read_depth(cv::Mat depth) const;

 private:
  // OpenGL's names of a framebuffer and its attachments; 0: none.
  struct Buffers {
    unsigned int framebuffer = 0;
    unsigned int color = 0;
    unsigned int coverage = 0;
    unsigned int depth = 0;
  };
  [[nodiscard]] static Result<Buffers> make(const cv::Size& size, int samples, bool with_depth,
                                            unsigned int color_format);
  [[nodiscard]] Result<void> grow(const cv::Size& size);
  static void release(const Buffers& buffers);
  void resolve(const cv::Size& size) const;

  int samples_;       // 0: no multisampling
  Buffers drawn_;     // with samples_ samples
  Buffers resolved_;  // 1 sample, no depth; none without multisampling
  cv::Size size_{0, 0};
};

// Restricts drawing to some rectangles of a piece, by the depth buffer: elsewhere it is as near as can be. Belongs to
// the context that is current when it is created.
class DepthMask {
 public:
  // Error unavailable as that of Program::create().
  [[nodiscard]] static Result<DepthMask> create();

  // Changes the depth buffer that is bound and has been cleared, the program, the vertex array, and the scissor, which
  // is put around the rectangles. The depth test has to let equal depths pass.
  void restrict_to(const std::vector<cv::Rect>& rects, const cv::Size& piece);

  // The program that draws depth alone.
  [[nodiscard]] const Program& depth_program() const { return program_; }

 private:
  explicit DepthMask(Program program);

  Program program_;
  unsigned int vertex_array_ = 0;
  unsigned int vertices_ = 0;
};

// Memory of large images, kept from frame to frame: the system clears what it gives out anew, page by page, which takes
// as long as filling the image. A buffer is given out again once no image shares it any more; one that is much larger
// than what is asked for is freed. Belongs to one thread, and so do its images.
class BufferPool {
 public:
  // An image of floats, of any number of channels, whose samples are what they happen to be. The size is not empty.
  [[nodiscard]] cv::Mat image(const cv::Size& size, int type);

 private:
  std::vector<cv::Mat> buffers_;  // CV_32FC1, one row each
};

}  // namespace sigs
