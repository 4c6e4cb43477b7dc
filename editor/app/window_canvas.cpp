// SPDX-License-Identifier: MIT
#include "editor/app/window_canvas.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxRegions = 3;

constexpr std::uint64_t kPrime = 0x100000001b3;

// FNV-1a over eight bytes at a time, with a turn that brings the high bits down.
std::uint64_t mixed(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::size_t i = 0;
  for (; i + sizeof(std::uint64_t) <= size; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, sizeof word);
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32;
  }
  for (; i < size; ++i) hash = (hash ^ bytes[i]) * kPrime;
  return hash;
}

bool empty(const ImVec4& rect) {
  return rect.z <= rect.x || rect.w <= rect.y;
}

bool overlap(const ImVec4& a, const ImVec4& b) {
  return !empty(common_part(a, b));
}

ImVec4 around(const ImVec4& a, const ImVec4& b) {
  if (empty(a)) return b;
  if (empty(b)) return a;
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}

float area(const ImVec4& rect) {
  return (rect.z - rect.x) * (rect.w - rect.y);
}

// Whole pixels.
ImVec4 grown(const ImVec4& rect) {
  return {std::floor(rect.x), std::floor(rect.y), std::ceil(rect.z), std::ceil(rect.w)};
}

// The two whose union wastes least become one.
void join_cheapest(std::vector<ImVec4>& regions) {
  std::pair<std::size_t, std::size_t> best{0, 1};
  float minimum = INFINITY;
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = i + 1; j < regions.size(); ++j) {
      const float waste = area(around(regions[i], regions[j])) - area(regions[i]) - area(regions[j]);
      if (waste < minimum) {
        minimum = waste;
        best = {i, j};
      }
    }
  regions[best.first] = around(regions[best.first], regions[best.second]);
  regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(best.second));
}

bool join_overlapping(std::vector<ImVec4>& regions) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = i + 1; j < regions.size(); ++j)
      if (overlap(regions[i], regions[j])) {
        regions[i] = around(regions[i], regions[j]);
        regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(j));
        return true;
      }
  return false;
}

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

ImVec4 common_part(const ImVec4& a, const ImVec4& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}

ChangedRegions::Piece ChangedRegions::piece_of(const ImDrawList& list, const ImDrawCmd& command) {
  if (command.ElemCount == 0) return {};
  const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
  const auto [low, high] = std::minmax_element(indices, indices + command.ElemCount);
  const ImDrawVert* first = list.VtxBuffer.Data + command.VtxOffset + *low;
  const ImDrawVert* end = list.VtxBuffer.Data + command.VtxOffset + *high + 1;
  ImVec4 bounds{first->pos.x, first->pos.y, first->pos.x, first->pos.y};
  for (const ImDrawVert* vertex = first; vertex != end; ++vertex) {
    bounds.x = std::min(bounds.x, vertex->pos.x);
    bounds.y = std::min(bounds.y, vertex->pos.y);
    bounds.z = std::max(bounds.z, vertex->pos.x);
    bounds.w = std::max(bounds.w, vertex->pos.y);
  }
  std::uint64_t fingerprint = 0xcbf29ce484222325;
  fingerprint = mixed(fingerprint, &command.ClipRect, sizeof command.ClipRect);
  fingerprint = mixed(fingerprint, &command.TextureId, sizeof command.TextureId);
  // Counted from the lowest, so that what is drawn before it changes nothing.
  for (unsigned int i = 0; i < command.ElemCount; ++i) fingerprint = (fingerprint ^ (indices[i] - *low)) * kPrime;
  fingerprint = mixed(fingerprint, first, static_cast<std::size_t>(end - first) * sizeof(ImDrawVert));
  return {fingerprint, common_part(bounds, command.ClipRect)};
}

ChangedRegions::Panel ChangedRegions::panel_of(const ImDrawList& list) {
  Panel panel{.list = &list};
  for (const ImDrawCmd& command : list.CmdBuffer) panel.pieces.push_back(piece_of(list, command));
  return panel;
}

ImVec4 ChangedRegions::changed(const Panel& before, const Panel& after) {
  const bool same_count = before.pieces.size() == after.pieces.size();
  ImVec4 region{0, 0, 0, 0};
  for (std::size_t i = 0; i < after.pieces.size(); ++i) {
    const bool same = same_count && before.pieces[i].fingerprint == after.pieces[i].fingerprint;
    if (!same) region = around(region, after.pieces[i].bounds);
  }
  for (std::size_t i = 0; i < before.pieces.size(); ++i) {
    const bool same = same_count && before.pieces[i].fingerprint == after.pieces[i].fingerprint;
    if (!same) region = around(region, before.pieces[i].bounds);
  }
  return empty(region) ? region : grown(region);
}

bool ChangedRegions::lies_at(const Panel& panel, const ImVec2& place) {
  return std::any_of(panel.pieces.begin(), panel.pieces.end(), [&](const Piece& piece) {
    return place.x >= piece.bounds.x && place.x < piece.bounds.z && place.y >= piece.bounds.y &&
           place.y < piece.bounds.w;
  });
}

std::vector<ImVec4> ChangedRegions::changes(std::vector<Panel>& panels, const std::optional<ImVec2>& first) {
  std::vector<ImVec4> regions;
  std::vector<std::pair<std::size_t, ImVec4>> others;  // by the panel's index
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const ImVec4 region = changed(panels_[i], panels[i]);
    if (empty(region)) continue;
    if (!first || lies_at(panels[i], *first))
      regions.push_back(region);
    else
      others.emplace_back(i, region);
  }
  const std::size_t first_ones = regions.size();
  for (const auto& [i, region] : others) {
    const bool touches = std::any_of(regions.begin(), regions.begin() + static_cast<std::ptrdiff_t>(first_ones),
                                     [&r = region](const ImVec4& other) { return overlap(other, r); });
    if (touches)
      regions.push_back(region);
    else
      panels[i] = std::move(panels_[i]);
  }
  return regions;
}

std::vector<ImVec4> ChangedRegions::of(const ImDrawData& data, const std::optional<ImVec2>& first) {
  const ImVec4 whole{0, 0, data.DisplaySize.x, data.DisplaySize.y};
  std::vector<Panel> panels;
  for (int i = 0; i < data.CmdListsCount; ++i) panels.push_back(panel_of(*data.CmdLists[i]));
  const bool same_panels = size_.x == data.DisplaySize.x && size_.y == data.DisplaySize.y && !panels_.empty() &&
                           std::equal(panels.begin(), panels.end(), panels_.begin(), panels_.end(),
                                      [](const Panel& a, const Panel& b) { return a.list == b.list; });
  std::vector<ImVec4> regions;
  if (!same_panels) {
    regions.push_back(whole);
  } else {
    regions = changes(panels, first);
    for (ImVec4& region : regions) region = common_part(region, whole);
    std::erase_if(regions, empty);
  }
  while (join_overlapping(regions)) {
  }
  while (regions.size() > kMaxRegions) {
    join_cheapest(regions);
    while (join_overlapping(regions)) {
    }
  }
  panels_ = std::move(panels);
  size_ = data.DisplaySize;
  return regions;
}

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

bool Canvas::draw(ImDrawData& data, int width_px, int height_px, const std::optional<ImVec2>& first) {
  if (width_px <= 0 || height_px <= 0) return false;
  if (width_px != width_px_ || height_px != height_px_) make(width_px, height_px);
  const std::vector<ImVec4> regions = changed_.of(data, first);
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
