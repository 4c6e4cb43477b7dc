// SPDX-License-Identifier: MIT
#include "editor/widgets/textures.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

constexpr int kTurnsKept = 30;

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
  for (const auto& [data, entry] : entries_) glDeleteTextures(1, &entry.name);
}

ImTextureID Textures::of(const cv::Mat& picture, Filter filter) {
  ENSURE(!picture.empty());
  const auto [place, is_new] = entries_.try_emplace(picture.data);
  Entry& entry = place->second;
  if (is_new) entry = {.picture = picture, .name = uploaded(picture)};
  if (is_new || entry.filter != filter) set_filter(entry.name, filter);
  entry.filter = filter;
  entry.unused_turns = 0;
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(entry.name));
}

void Textures::end_turn() {
  for (auto place = entries_.begin(); place != entries_.end();) {
    if (++place->second.unused_turns <= kTurnsKept) {
      ++place;
      continue;
    }
    glDeleteTextures(1, &place->second.name);
    place = entries_.erase(place);
  }
}

}  // namespace sigs::editor
