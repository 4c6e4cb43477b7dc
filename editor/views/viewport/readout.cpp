// SPDX-License-Identifier: MIT
#include "editor/views/viewport/viewport_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace sigs::editor {

namespace {

struct Part {
  std::string text;
  const char* widest = "";  // holds its place while numbers change
  int rank = 0;             // those of the highest rank go first where there is no room
  ImU32 color = color::kQuiet;
  std::optional<cv::Vec3b> swatch_bgr;
};

double mebibytes(std::size_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

void add_pixel(std::vector<Part>& parts, const ViewContext& context, const ViewportReadout& readout) {
  const PatchedImage image = watched_image(context, readout.of_footage);
  if (!readout.pixel || !cv::Rect({0, 0}, image.size()).contains(*readout.pixel)) return;
  const cv::Point at = *readout.pixel;
  parts.push_back({fmt::format("x {:4}  y {:4}", at.x, at.y), "x 00000  y 00000", 0, color::kText});
  parts.push_back({pixel_text(image, at), "000 000 000", 0, color::kText, image.bgr_at(at)});
  if (readout.of_footage) return parts.push_back({"footage", "covered 100.0%", 1});
  const cv::Mat& mask = context.shown.image->mask;
  const bool masked = mask.type() == CV_8UC1 && cv::Rect({0, 0}, mask.size()).contains(at);
  const double covered = masked ? mask.at<uchar>(at) / 2.55 : 0;
  parts.push_back(
      {fmt::format("covered {:5.1f}%", covered), "covered 100.0%", 1, covered > 0 ? color::kAccent : color::kQuiet});
}

void add_image(std::vector<Part>& parts, const ViewContext& context, const ViewportReadout& readout) {
  if (!context.shown.image || !context.shown.image_is_current)
    parts.push_back({"updating...", "updating...", 2, color::kAccent});
  if (!context.shown.image) return;
  const MemoryUse& memory = context.shown.memory;
  parts.push_back({fmt::format("memory {:.0f} of {:.0f} MiB", mebibytes(memory.sum()), mebibytes(memory.limit)),
                   "memory 0000 of 0000 MiB", 5});
  const PreviewImage& image = *context.shown.image;
  parts.push_back({fmt::format("{:.0f}%", readout.zoom * 100), "0000%", 0, color::kText});
  parts.push_back({image_size_text(image.bgr.size(), " x "), "0000 x 0000", 3});
  parts.push_back({fmt::format("{:.1f} ms", context.shown.compose_ms), "0000.0 ms", 4});
}

float swatch_side() {
  return font(Font::mono)->FontSize * 0.8F;
}

float width_of(const Part& part) {
  const ImFont& mono = *font(Font::mono);
  const auto of = [&](const char* text) { return mono.CalcTextSizeA(mono.FontSize, 1e6F, 0, text).x; };
  return std::max(of(part.text.c_str()), of(part.widest)) + (part.swatch_bgr ? swatch_side() + scaled(6) : 0);
}

float width_of(const std::vector<Part>& parts) {
  float width = 0;
  for (const Part& part : parts) width += width_of(part) + scaled(16);
  return width;
}

void drop_lowest_priority(std::vector<Part>& left, std::vector<Part>& right) {
  const auto rank_of = [](const std::vector<Part>& parts) {
    int rank = -1;
    for (const Part& part : parts) rank = std::max(rank, part.rank);
    return rank;
  };
  std::vector<Part>& from = rank_of(right) >= rank_of(left) ? right : left;
  const int rank = rank_of(from);
  const auto last = std::find_if(from.rbegin(), from.rend(), [&](const Part& part) { return part.rank == rank; });
  from.erase(std::next(last).base());
}

void draw_part(ImDrawList& draw, const Part& part, ImVec2 at) {
  if (part.swatch_bgr) {
    const cv::Vec3b& bgr = *part.swatch_bgr;
    const float side = swatch_side();
    const float y = at.y + (font(Font::mono)->FontSize - side) / 2;
    draw.AddRectFilled({at.x, y}, {at.x + side, y + side}, IM_COL32(bgr[2], bgr[1], bgr[0], 255), scaled(2));
    draw.AddRect({at.x, y}, {at.x + side, y + side}, color::kFaint, scaled(2));
    at.x += side + scaled(6);
  }
  draw.AddText(font(Font::mono), font(Font::mono)->FontSize, at, part.color, part.text.c_str());
}

constexpr std::size_t kMaxProblemLines = 4;

float padding() {
  return scaled(8);
}

float icon_side() {
  return ImGui::GetFontSize();
}

}  // namespace

PatchedImage watched_image(const ViewContext& context, bool of_footage) {
  if (of_footage) return {.ground = context.shown.footage ? *context.shown.footage : ShownImage()};
  return context.shown.image ? context.shown.image->bgr : PatchedImage();
}

float readout_height() {
  return std::ceil(font(Font::mono)->FontSize + scaled(9));
}

void draw_readout(const ViewContext& context, const ViewportReadout& readout) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, readout_height());
  std::vector<Part> left;
  std::vector<Part> right;
  add_pixel(left, context, readout);
  add_image(right, context, readout);
  const float margin = scaled(10);
  while (!(left.empty() && right.empty()) && width_of(left) + width_of(right) + 2 * margin > size.x)
    drop_lowest_priority(left, right);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(low, {low.x + size.x, low.y + size.y}, color::kPanel);
  const float y = std::round(low.y + (size.y - font(Font::mono)->FontSize) / 2);
  float x = low.x + margin;
  for (const Part& part : left) {
    draw_part(draw, part, {std::round(x), y});
    x += width_of(part) + scaled(16);
  }
  x = low.x + size.x - margin - width_of(right) + scaled(16);
  for (const Part& part : right) {
    draw_part(draw, part, {std::round(x), y});
    x += width_of(part) + scaled(16);
  }
  ImGui::Dummy(size);
}

std::vector<std::string> problems_of(const ViewContext& context, const PreviewImage* image) {
  std::vector<std::string> problems;
  const auto add = [&](const std::string& problem) {
    std::string shown = shortened(problem, 400);
    if (!shown.empty() && std::ranges::find(problems, shown) == problems.end()) problems.push_back(std::move(shown));
  };
  if (context.shown.scene) {
    const OpenedScene& scene = *context.shown.scene;
    const bool no_footage = scene.footage && !scene.footage->problem.empty();
    if (no_footage) add("Grey replaces the footage: " + scene.footage->problem);
    for (const Problem& problem : scene.draft.problems)
      if (!(no_footage && problem.field == "footage.video")) add(problem.field + ": " + problem.what);
  }
  // What the scene is known to lack is not said again of each image.
  if (image != nullptr && problems.empty()) add(image->problem);
  return problems;
}

void ProblemBanner::lay_out(const ScreenRect& rect) {
  lines_.clear();
  const float margin = scaled(8);
  const float maximum_width = std::min(static_cast<float>(rect.size().x) - 2 * margin, scaled(640));
  const float indent = 2 * padding() + icon_side();
  const float room = std::max(scaled(60), maximum_width - indent - padding());
  std::vector<std::string> texts{count_text(std::ssize(problems_), "problem")};
  if (!folded_) {
    texts.assign(problems_.begin(),
                 problems_.begin() + static_cast<long>(std::min(kMaxProblemLines, problems_.size())));
    if (problems_.size() > kMaxProblemLines)
      texts.push_back(
          fmt::format("and {} more, at their fields in the inspector", problems_.size() - kMaxProblemLines));
  }
  glm::dvec2 size(0, 2 * padding() - scaled(3));
  for (const std::string& text : texts) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
    lines_.push_back({text, extent.y + scaled(3)});
    size = {std::max(size.x, static_cast<double>(extent.x + indent + padding())), size.y + lines_.back().height};
  }
  plate_.low = rect.low + static_cast<double>(margin);
  plate_.high = glm::min(plate_.low + glm::ceil(size), rect.high - 1.0);
}

void ProblemBanner::handle_mouse(const ScreenRect& rect, std::vector<std::string> problems) {
  if (problems != problems_) folded_ = false;
  problems_ = std::move(problems);
  hovered_ = false;
  if (problems_.empty()) return;
  lay_out(rect);
  if (plate_.size().x < 1 || plate_.size().y < 1) return;
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(im(plate_.low));
  if (ImGui::InvisibleButton("problems", im(plate_.size()))) folded_ = !folded_;
  hovered_ = ImGui::IsItemHovered();
  tooltip_for_item(folded_ ? "Click to unfold" : "Click to fold up");
  ImGui::SetCursorScreenPos(cursor);
}

void ProblemBanner::draw(ImDrawList& draw) const {
  if (problems_.empty() || lines_.empty()) return;
  draw.PushClipRect(im(plate_.low), im(plate_.high), true);
  draw.AddRectFilled(im(plate_.low), im(plate_.high), hovered_ ? IM_COL32(46, 44, 40, 240) : IM_COL32(30, 29, 27, 225),
                     scaled(4));
  draw.AddRectFilled(im(plate_.low), im({plate_.low.x + scaled(3), plate_.high.y}), color::kPartly, scaled(4),
                     ImDrawFlags_RoundCornersLeft);
  const auto left = static_cast<float>(plate_.low.x) + padding();
  const float text_x = left + icon_side() + padding();
  float y = static_cast<float>(plate_.low.y) + padding();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (i < kMaxProblemLines)
      draw_icon(draw, Icon::warning, {left + icon_side() / 2, y + icon_side() / 2}, icon_side(), color::kPartly);
    const float room = static_cast<float>(plate_.high.x) - text_x - padding() + 1;
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {text_x, y},
                 i < kMaxProblemLines ? color::kText : color::kQuiet, lines_[i].text.c_str(), nullptr, room);
    y += lines_[i].height;
  }
  draw.PopClipRect();
}

}  // namespace sigs::editor
