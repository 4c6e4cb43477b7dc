// SPDX-License-Identifier: MIT
#include "editor/app/window_canvas.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <epoxy/glx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxRegions = 3;
constexpr std::size_t kMaxPanelRegions = 8;
// Drawing so many unchanged pixels costs less than another region does.
constexpr float kSlack_px2 = 64 * 64;

constexpr std::uint64_t kBasis = 0xcbf29ce484222325;
constexpr std::uint64_t kPrime = 0x100000001b3;

// FNV-1a over eight bytes at a time, with a turn that brings the high bits down.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * kPrime;
  return hash ^ (hash >> 32);
}

std::uint64_t mixed(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  while (size > 0) {
    std::uint64_t word = 0;
    const std::size_t taken = std::min(size, sizeof word);
    std::memcpy(&word, bytes, taken);
    hash = mixed(hash, word);
    bytes += taken;
    size -= taken;
  }
  return hash;
}

bool empty(const ImVec4& rect) {
  return rect.z <= rect.x || rect.w <= rect.y;
}

bool overlap(const ImVec4& a, const ImVec4& b) {
  return !empty(common_part(a, b));
}

ImVec4 around(const ImVec4& a, const ImVec4& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}

float area(const ImVec4& rect) {
  return (rect.z - rect.x) * (rect.w - rect.y);
}

float waste(const ImVec4& a, const ImVec4& b) {
  return area(around(a, b)) - area(a) - area(b);
}

// Whole pixels.
ImVec4 grown(const ImVec4& rect) {
  return {std::floor(rect.x), std::floor(rect.y), std::ceil(rect.z), std::ceil(rect.w)};
}

// The two whose union wastes least become one.
void join_cheapest(std::vector<ImVec4>& regions) {
  std::pair<std::size_t, std::size_t> best{0, 1};
  float minimum = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = i + 1; j < regions.size(); ++j)
      if (const float wasted = waste(regions[i], regions[j]); wasted < minimum) {
        minimum = wasted;
        best = {i, j};
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

void make_few(std::vector<ImVec4>& regions) {
  for (;;) {
    while (join_overlapping(regions)) {
    }
    if (regions.size() <= kMaxRegions) return;
    join_cheapest(regions);
  }
}

// To a region near by, where there is one.
void add_region(std::vector<ImVec4>& regions, const ImVec4& rect) {
  if (empty(rect)) return;
  const auto near =
      std::ranges::find_if(regions, [&](const ImVec4& region) { return waste(region, rect) <= kSlack_px2; });
  if (near != regions.end())
    *near = around(*near, rect);
  else
    regions.push_back(rect);
  if (regions.size() > kMaxPanelRegions) join_cheapest(regions);
}

bool touch(const std::vector<ImVec4>& some, const std::vector<ImVec4>& others) {
  return std::ranges::any_of(some, [&](const ImVec4& one) {
    return std::ranges::any_of(others, [&](const ImVec4& other) { return overlap(one, other); });
  });
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

// Mesa's renderers on the processor, as they name themselves.
bool is_drawn_by_processor() {
  const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr && (std::strstr(name, "llvmpipe") != nullptr || std::strstr(name, "softpipe") != nullptr);
}

// Whether the window's back buffer keeps what was drawn while parts of it are copied to the screen: on X11, through
// GLX. A graphics card draws the whole window in no time, and swapping waits for its screen.
bool can_show_parts() {
  if (!is_drawn_by_processor() || glXGetCurrentContext() == nullptr) return false;
  Display* const display = glXGetCurrentDisplay();
  return epoxy_has_glx_extension(display, DefaultScreen(display), "GLX_MESA_copy_sub_buffer");
}

// In the framebuffer's pixels, from below.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

PixelRect pixels_of(const ImVec4& region, const ImDrawData& data) {
  const ImVec2 scale = data.FramebufferScale;
  const double height_px = std::round(data.DisplaySize.y * scale.y);
  return {.x = static_cast<int>(region.x * scale.x),
          .y = static_cast<int>(height_px - region.w * scale.y),
          .width = static_cast<int>((region.z - region.x) * scale.x),
          .height = static_cast<int>((region.w - region.y) * scale.y)};
}

void draw_region(ImDrawData& data, const ImVec4& region) {
  const PixelRect part = pixels_of(region, data);
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.width, part.height);
  glClearColor(0.118F, 0.125F, 0.145F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  const std::vector<ImVec4> clips = clips_of(data);
  set_clips(data, [&](std::size_t number) {
    const ImVec4 clip = common_part(clips[number], region);
    // Upside down would be an error to OpenGL; of no size it is left out.
    return clip.z > clip.x && clip.w > clip.y ? clip : ImVec4(0, 0, 0, 0);
  });
  ImGui_ImplOpenGL3_RenderDrawData(&data);
  set_clips(data, [&](std::size_t number) { return clips[number]; });
}

bool has_refused = false;  // the X server, since show_parts() began

// Copies parts of the back buffer to the screen. False: the server has refused one. Mesa's buffer
// has the size that the window had when Mesa asked for it, and nothing outside of it can be copied; by default an error
// of the server ends the program.
bool show_parts(const ImDrawData& data, std::span<const ImVec4> regions) {
  Display* const display = glXGetCurrentDisplay();
  has_refused = false;
  const auto before = XSetErrorHandler([](Display*, XErrorEvent*) {
    has_refused = true;
    return 0;
  });
  for (const ImVec4& region : regions) {
    const PixelRect part = pixels_of(region, data);
    glXCopySubBufferMESA(display, glXGetCurrentDrawable(), part.x, part.y, part.width, part.height);
  }
  XSync(display, False);
  XSetErrorHandler(before);
  return !has_refused;
}

}  // namespace

ImVec4 common_part(const ImVec4& a, const ImVec4& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}

ChangedRegions::Piece ChangedRegions::piece_of(const ImDrawList& list, const ImDrawCmd& command) {
  Piece piece;
  piece.surface = mixed(kBasis, &command.ClipRect, sizeof command.ClipRect);
  piece.surface = mixed(piece.surface, &command.TextureId, sizeof command.TextureId);
  piece.fingerprint = piece.surface;
  piece.triangles.reserve(command.ElemCount / 3);
  const ImDrawIdx* const indices = list.IdxBuffer.Data + command.IdxOffset;
  const ImDrawVert* const vertices = list.VtxBuffer.Data + command.VtxOffset;
  for (unsigned int i = 0; i + 2 < command.ElemCount; i += 3) {
    const std::array<ImDrawVert, 3> corners{vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]]};
    const auto [left, right] = std::minmax({corners[0].pos.x, corners[1].pos.x, corners[2].pos.x});
    const auto [top, bottom] = std::minmax({corners[0].pos.y, corners[1].pos.y, corners[2].pos.y});
    const std::uint64_t fingerprint = mixed(kBasis, corners.data(), sizeof corners);
    piece.triangles.push_back({fingerprint, common_part({left, top, right, bottom}, command.ClipRect)});
    piece.fingerprint = mixed(piece.fingerprint, fingerprint);
  }
  return piece;
}

ChangedRegions::Panel ChangedRegions::panel_of(const ImDrawList& list) {
  Panel panel{.list = &list};
  for (const ImDrawCmd& command : list.CmdBuffer) panel.pieces.push_back(piece_of(list, command));
  return panel;
}

void ChangedRegions::add_changes(const Piece& before, const Piece& after, std::vector<ImVec4>& regions) {
  struct Counts {
    int before = 0;
    int after = 0;
  };
  std::unordered_map<std::uint64_t, Counts> counts;
  if (before.surface == after.surface) {
    for (const Triangle& triangle : before.triangles) ++counts[triangle.fingerprint].before;
    for (const Triangle& triangle : after.triangles) ++counts[triangle.fingerprint].after;
  }
  const auto is_kept = [&](const Triangle& triangle) {
    const auto found = counts.find(triangle.fingerprint);
    return found != counts.end() && found->second.before == found->second.after;
  };
  std::vector<std::uint64_t> kept_before;
  std::vector<std::uint64_t> kept_after;
  for (const Triangle& triangle : before.triangles)
    if (is_kept(triangle)) kept_before.push_back(triangle.fingerprint);
  for (const Triangle& triangle : after.triangles)
    if (is_kept(triangle)) kept_after.push_back(triangle.fingerprint);
  const bool is_same_order = kept_before == kept_after;
  for (const Piece* const piece : {&before, &after})
    for (const Triangle& triangle : piece->triangles)
      if (!is_same_order || !is_kept(triangle)) add_region(regions, triangle.bounds);
}

std::vector<ImVec4> ChangedRegions::changed(const Panel& before, const Panel& after) {
  const bool same_count = before.pieces.size() == after.pieces.size();
  const Piece none;
  std::vector<ImVec4> regions;
  for (std::size_t i = 0; i < std::max(before.pieces.size(), after.pieces.size()); ++i) {
    if (same_count && before.pieces[i].fingerprint == after.pieces[i].fingerprint) continue;
    if (same_count) {
      add_changes(before.pieces[i], after.pieces[i], regions);
      continue;
    }
    if (i < before.pieces.size()) add_changes(before.pieces[i], none, regions);
    if (i < after.pieces.size()) add_changes(none, after.pieces[i], regions);
  }
  for (ImVec4& region : regions) region = grown(region);
  return regions;
}

bool ChangedRegions::lies_at(const Panel& panel, std::span<const ImVec2> places) {
  const auto has_place = [&](const Triangle& triangle) {
    const ImVec4& bounds = triangle.bounds;
    return std::ranges::any_of(places, [&](const ImVec2& place) {
      return place.x >= bounds.x && place.x < bounds.z && place.y >= bounds.y && place.y < bounds.w;
    });
  };
  return std::ranges::any_of(panel.pieces,
                             [&](const Piece& piece) { return std::ranges::any_of(piece.triangles, has_place); });
}

std::vector<ImVec4> ChangedRegions::changes(std::vector<Panel>& panels, std::span<const ImVec2> first) {
  std::vector<ImVec4> regions;
  std::vector<std::pair<std::size_t, std::vector<ImVec4>>> others;  // by the panel's index
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::vector<ImVec4> places = changed(panels_[i], panels[i]);
    if (places.empty()) continue;
    if (first.empty() || lies_at(panels[i], first))
      regions.insert(regions.end(), places.begin(), places.end());
    else
      others.emplace_back(i, places);
  }
  make_few(regions);
  // What is drawn shows the new state of a panel, which then has to be drawn wherever it changed; that may touch
  // others.
  const auto is_touched = [&](const auto& other) { return touch(other.second, regions); };
  for (auto one = std::ranges::find_if(others, is_touched); one != others.end();
       one = std::ranges::find_if(others, is_touched)) {
    regions.insert(regions.end(), one->second.begin(), one->second.end());
    make_few(regions);
    others.erase(one);
  }
  for (const auto& [i, places] : others) panels[i] = std::move(panels_[i]);
  return regions;
}

std::vector<ImVec4> ChangedRegions::of(const ImDrawData& data, std::span<const ImVec2> first) {
  const ImVec4 whole{0, 0, data.DisplaySize.x, data.DisplaySize.y};
  std::vector<Panel> panels;
  for (int i = 0; i < data.CmdListsCount; ++i) panels.push_back(panel_of(*data.CmdLists[i]));
  const bool same_panels = size_.x == data.DisplaySize.x && size_.y == data.DisplaySize.y && !panels_.empty() &&
                           std::equal(panels.begin(), panels.end(), panels_.begin(), panels_.end(),
                                      [](const Panel& a, const Panel& b) { return a.list == b.list; });
  std::vector<ImVec4> regions{whole};
  if (same_panels) {
    regions = changes(panels, first);
    for (ImVec4& region : regions) region = common_part(region, whole);
    std::erase_if(regions, empty);
  }
  panels_ = std::move(panels);
  size_ = data.DisplaySize;
  return regions;
}

bool Canvas::draw(ImDrawData& data, std::span<const ImVec2> first) {
  const auto width_px = static_cast<int>(std::lround(data.DisplaySize.x * data.FramebufferScale.x));
  const auto height_px = static_cast<int>(std::lround(data.DisplaySize.y * data.FramebufferScale.y));
  if (width_px <= 0 || height_px <= 0) return false;
  if (!shows_parts_) shows_parts_ = can_show_parts();
  if (width_px != width_px_ || height_px != height_px_) {
    forget();
    // Mesa asks for the window's size, and makes a buffer of it, after buffers were swapped and not before.
    if (*shows_parts_) glXSwapBuffers(glXGetCurrentDisplay(), glXGetCurrentDrawable());
  }
  width_px_ = width_px;
  height_px_ = height_px;
  const std::vector<ImVec4> regions = changed_.of(data, *shows_parts_ ? first : std::span<const ImVec2>());
  if (regions.empty()) return false;
  glViewport(0, 0, width_px, height_px);
  if (!*shows_parts_) {
    draw_region(data, {0, 0, data.DisplaySize.x, data.DisplaySize.y});
    return true;
  }
  for (const ImVec4& region : regions) draw_region(data, region);
  if (!show_parts(data, regions)) width_px_ = height_px_ = 0;  // the next call has another size
  return false;
}

}  // namespace sigs::editor
