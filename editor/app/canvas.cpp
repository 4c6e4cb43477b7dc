// SPDX-License-Identifier: MIT
#include "editor/app/canvas.h"

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

}  // namespace

Canvas::~Canvas() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &color_);
}

void Canvas::make(int width_px, int height_px) {
  if (framebuffer_ == 0) {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &color_);
  }
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_px, height_px);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
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

bool Canvas::draw(ImDrawData& data, int width_px, int height_px) {
  if (width_px <= 0 || height_px <= 0) return false;
  if (width_px != width_px_ || height_px != height_px_) make(width_px, height_px);
  const std::vector<ImVec4> regions = changed_.of(data);
  if (regions.empty()) return false;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_px, height_px);
  for (const ImVec4& region : regions) draw_region(data, region);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return true;
}

}  // namespace sigs::editor
