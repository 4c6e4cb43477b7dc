// SPDX-License-Identifier: MIT
#include "editor/widgets/textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs::editor {

namespace {

constexpr long kUpdatesKept = 30;

// Three channels are widened here: drivers that draw in software do it sample by sample.
cv::Mat uploadable(const cv::Mat& image) {
  ENSURE(image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_8UC4);
  if (image.channels() != 3) return image;
  cv::Mat widened;
  cv::cvtColor(image, widened, cv::COLOR_BGR2RGBA);
  return widened;
}

unsigned int uploaded(const cv::Mat& shown) {
  const cv::Mat image = uploadable(shown);
  unsigned int name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (image.channels() == 1) {
    const GLint grey[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, grey);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(image.step1() / static_cast<std::size_t>(image.channels())));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.cols, image.rows, 0, image.channels() == 1 ? GL_RED : GL_RGBA,
               GL_UNSIGNED_BYTE, image.data);
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

void TextureOrder::use(TextureKey key, std::size_t bytes) {
  Use& use = uses_[key];
  bytes_ += bytes - use.bytes;
  use = {.bytes = bytes, .update = update_};
}

std::vector<TextureKey> TextureOrder::end_update(std::size_t max_bytes) {
  std::vector<TextureKey> gone;
  while (!uses_.empty()) {
    const auto oldest =
        std::ranges::min_element(uses_, [](const auto& a, const auto& b) { return a.second.update < b.second.update; });
    const long unused_updates = update_ - oldest->second.update;
    if (unused_updates == 0 || (unused_updates < kUpdatesKept && bytes_ <= max_bytes)) break;
    bytes_ -= oldest->second.bytes;
    gone.push_back(oldest->first);
    uses_.erase(oldest);
  }
  ++update_;
  return gone;
}

Textures::~Textures() {
  for (const auto& [key, entry] : entries_) glDeleteTextures(1, &entry.name);
}

ImTextureID Textures::of(const ShownImage& image, const cv::Rect& part, Filter filter, int divisor) {
  ENSURE(!part.empty());
  const TextureKey key{image.samples(), divisor, {part.x, part.y, part.width, part.height}};
  const auto [place, is_new] = entries_.try_emplace(key);
  Entry& entry = place->second;
  if (is_new) entry = {.image = image, .name = uploaded(image.reduced(part, divisor))};
  if (is_new || entry.filter != filter) set_filter(entry.name, filter);
  entry.filter = filter;
  const auto on_card = 4 * static_cast<std::size_t>(reduced_size(part.size(), divisor).area());
  order_.use(key, on_card + image.bytes());
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(entry.name));
}

void Textures::end_update(std::size_t max_bytes) {
  for (const TextureKey& gone : order_.end_update(max_bytes)) {
    const auto place = entries_.find(gone);
    glDeleteTextures(1, &place->second.name);
    entries_.erase(place);
  }
}

void draw_brighter(ImDrawList& draw, const ImVec2& low, const ImVec2& high, int doublings) {
  if (doublings < 1) return;
  // White times what is there, added to what is there.
  draw.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glBlendFunc(GL_DST_COLOR, GL_ONE); }, nullptr);
  for (int i = 0; i < doublings; ++i) draw.AddRectFilled(low, high, IM_COL32_WHITE);
  draw.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

}  // namespace sigs::editor
