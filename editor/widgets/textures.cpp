// SPDX-License-Identifier: MIT
#include "editor/widgets/textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

cv::Size reduced_size(const cv::Mat& picture, int divisor) {
  return {std::max(1, picture.cols / divisor), std::max(1, picture.rows / divisor)};
}

std::size_t bytes_on_card(const cv::Mat& picture, int divisor) {
  return 4 * static_cast<std::size_t>(reduced_size(picture, divisor).area());
}

// Three channels are widened here: drivers that draw in software do it sample by sample.
cv::Mat uploadable(const cv::Mat& picture) {
  ENSURE(picture.type() == CV_8UC1 || picture.type() == CV_8UC3 || picture.type() == CV_8UC4);
  if (picture.channels() != 3) return picture;
  cv::Mat widened;
  cv::cvtColor(picture, widened, cv::COLOR_BGR2RGBA);
  return widened;
}

unsigned int uploaded(const cv::Mat& shown) {
  const cv::Mat picture = uploadable(shown);
  unsigned int name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (picture.channels() == 1) {
    const GLint grey[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, grey);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH,
                static_cast<GLint>(picture.step1() / static_cast<std::size_t>(picture.channels())));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.cols, picture.rows, 0, picture.channels() == 1 ? GL_RED : GL_RGBA,
               GL_UNSIGNED_BYTE, picture.data);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  return name;
}

void set_filter(unsigned int name, Filter filter) {
  const GLint how = filter == Filter::nearest ? GL_NEAREST : GL_LINEAR;
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, how);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, how);
}

}  // namespace

Textures::~Textures() {
  for (const auto& [key, entry] : entries_) glDeleteTextures(1, &entry.name);
}

ImTextureID Textures::of(const cv::Mat& picture, Filter filter, int divisor) {
  ENSURE(!picture.empty());
  const TextureKey key{picture.data, divisor};
  const auto [place, is_new] = entries_.try_emplace(key);
  Entry& entry = place->second;
  if (is_new) entry = {.picture = picture, .name = uploaded(reduced_copy(picture, divisor))};
  if (is_new || entry.filter != filter) set_filter(entry.name, filter);
  entry.filter = filter;
  order_.use(key, bytes_on_card(picture, divisor) + picture.total() * picture.elemSize());
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(entry.name));
}

void Textures::end_turn(std::size_t most_bytes) {
  for (const TextureKey& gone : order_.end_turn(most_bytes)) {
    const auto place = entries_.find(gone);
    glDeleteTextures(1, &place->second.name);
    entries_.erase(place);
  }
}

cv::Mat reduced_copy(const cv::Mat& picture, int divisor) {
  if (divisor < 2) return picture;
  cv::Mat reduced;
  cv::resize(picture, reduced, reduced_size(picture, divisor), 0, 0, cv::INTER_AREA);
  return reduced;
}

}  // namespace sigs::editor
