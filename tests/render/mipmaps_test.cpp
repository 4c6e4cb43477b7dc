// SPDX-License-Identifier: MIT
// The smaller levels of textures, read back from the driver, against their definition and against the driver's own.

#include "render/gpu_mesh.h"

#include <doctest/doctest.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/transfer.h"
#include "render/egl_context.h"

using namespace sigs;

namespace {

cv::Mat level_of(unsigned int texture, int level, const cv::Size& size) {
  cv::Mat texels(size, CV_8UC4);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glGetTexImage(GL_TEXTURE_2D, level, GL_RGBA, GL_UNSIGNED_BYTE, texels.data);
  return texels;
}

// By the driver alone.
unsigned int generated_by_driver(const cv::Mat& texels) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, texels.cols, texels.rows, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data);
  glGenerateMipmap(GL_TEXTURE_2D);
  return name;
}

// A channel of a level of even sides: the mean of four texels, of colours in linear light.
double mean_code(const cv::Mat& above, int x, int y, int channel) {
  double sum = 0;
  for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
    const float code = static_cast<float>(above.at<cv::Vec4b>(2 * y + j, 2 * x + i)[channel]) / 255.0F;
    sum += static_cast<double>(channel == 3 ? code : linear_of_display(code)) / 4;
  }
  return 255.0 * (channel == 3 ? sum : static_cast<double>(display_of_linear(static_cast<float>(sum))));
}

cv::Mat noise(const cv::Size& size) {
  cv::Mat texels(size, CV_8UC4);
  cv::RNG random(5);
  random.fill(texels, cv::RNG::UNIFORM, 0, 256);
  return texels;
}

}  // namespace

TEST_CASE("a texture's smaller levels are means in linear light, those that the driver makes") {
  const Result<EglContext> context = EglContext::create();
  REQUIRE(context.has_value());
  const Mipmaps mipmaps;
  for (const cv::Size size : {cv::Size(64, 32), cv::Size(96, 20), cv::Size(13, 7), cv::Size(1, 6), cv::Size(1, 1)}) {
    CAPTURE(size);
    const cv::Mat texels = noise(size);
    const unsigned int texture = mipmaps.uploaded(texels);
    const unsigned int truth = generated_by_driver(texels);
    cv::Mat above = texels;
    CHECK(cv::norm(level_of(texture, 0, size), texels, cv::NORM_INF) == 0);
    for (int level = 1; std::max(above.cols, above.rows) > 1; ++level) {
      const cv::Size below(std::max(above.cols / 2, 1), std::max(above.rows / 2, 1));
      const cv::Mat found = level_of(texture, level, below);
      // The same arithmetic, in another order: a value half way between two codes may fall to either side.
      CHECK(cv::norm(found, level_of(truth, level, below), cv::NORM_INF) <= 1);
      if (above.cols % 2 == 0 && above.rows % 2 == 0)
        for (int y = 0; y < below.height; ++y)
          for (int x = 0; x < below.width; ++x)
            for (int c = 0; c < 4; ++c)  // a code for rounding and for the driver's approximation of sRGB's curve
              CHECK(std::abs(found.at<cv::Vec4b>(y, x)[c] - mean_code(above, x, y, c)) <= 1.0);
      above = found;
    }
    CHECK(glGetError() == GL_NO_ERROR);
  }
}
