// SPDX-License-Identifier: MIT
#include "editor/app/window_canvas.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <vector>

namespace sigs::editor {

namespace {

std::vector<ImVec4> clips_of(const ImDrawData& data) {
  std::vector<ImVec4> clips;
  for (int i = 0; i < data.CmdListsCount; ++i)
    for (const ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) clips.push_back(command.ClipRect);
  return clips;
}

template <class Clip>
void set_clips(ImDrawData& data, Clip clip) {
  std::size_t number = 0;
  for (int i = 0; i < data.CmdListsCount; ++i)
    for (ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) command.ClipRect = clip(number++);
}

ImVec4 upside_down(const ImVec4& rect, float height) {
  return {rect.x, height - rect.w, rect.z, height - rect.y};
}

void turn_upside_down(ImDrawData& data) {
  const float height = data.DisplaySize.y;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (ImDrawVert& vertex : data.CmdLists[i]->VtxBuffer) vertex.pos.y = height - vertex.pos.y;
    for (ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) command.ClipRect = upside_down(command.ClipRect, height);
  }
}

}  // namespace

Canvas::~Canvas() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &color_);
}

void Canvas::make(int width_px, int height_px) {
  if (framebuffer_ == 0) {
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &color_);
  }
  // The order of samples that windows have; a renderbuffer cannot ask for one.
  glBindTexture(GL_TEXTURE_2D, color_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_px, height_px, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
  width_px_ = width_px;
  height_px_ = height_px;
  changed_.forget();
}

void Canvas::draw_region(ImDrawData& data, const ImVec4& region) const {
  const ImVec2 scale = data.FramebufferScale;
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<int>(region.x * scale.x), static_cast<int>(static_cast<float>(height_px_) - region.w * scale.y),
            static_cast<int>((region.z - region.x) * scale.x), static_cast<int>((region.w - region.y) * scale.y));
  glClearColor(0.118F, 0.125F, 0.145F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  const std::vector<ImVec4> clips = clips_of(data);
  set_clips(data, [&](std::size_t number) {
    const ImVec4 part = common_part(clips[number], region);
    // Upside down would be an error to OpenGL; of no size it is left out.
    return part.z > part.x && part.w > part.y ? part : ImVec4(0, 0, 0, 0);
  });
  ImGui_ImplOpenGL3_RenderDrawData(&data);
  set_clips(data, [&](std::size_t number) { return clips[number]; });
}

bool Canvas::draw(ImDrawData& data, int width_px, int height_px, const std::optional<ImVec2>& first) {
  if (width_px <= 0 || height_px <= 0) return false;
  if (width_px != width_px_ || height_px != height_px_) make(width_px, height_px);
  const std::vector<ImVec4> regions = changed_.of(data, first);
  if (regions.empty()) return false;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_px, height_px);
  turn_upside_down(data);
  for (const ImVec4& region : regions) draw_region(data, upside_down(region, data.DisplaySize.y));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width_px, height_px, 0, height_px, width_px, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return true;
}

}  // namespace sigs::editor
