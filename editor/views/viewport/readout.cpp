// SPDX-License-Identifier: MIT
#include "editor/views/viewport/readout.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

struct Part {
  std::string text;
  const char* widest = "";  // holds its place while numbers change
  int rank = 0;             // those of the highest rank go first where there is no room
  ImU32 color = color::kQuiet;
  std::optional<cv::Vec3b> swatch_bgr;
};

std::string formatted(const char* format, double a, double b = 0) {
  char text[64];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

double mebibytes(std::size_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

const cv::Mat* image_of(const ViewContext& context, const ViewportReadout& readout) {
  if (readout.of_footage) return context.shown.footage.get();
  return context.shown.image ? &context.shown.image->bgr : nullptr;
}

void add_pixel(std::vector<Part>& parts, const ViewContext& context, const ViewportReadout& readout) {
  const cv::Mat* image = image_of(context, readout);
  if (!readout.pixel || image == nullptr || !cv::Rect({0, 0}, image->size()).contains(*readout.pixel)) return;
  const cv::Point at = *readout.pixel;
  parts.push_back(
      {"x " + formatted("%4.0f", at.x) + "  y " + formatted("%4.0f", at.y), "x 00000  y 00000", 0, color::kText});
  parts.push_back({pixel_text(*image, at), "000 000 000", 0, color::kText,
                   image->type() == CV_8UC3 ? std::optional(image->at<cv::Vec3b>(at)) : std::nullopt});
  if (readout.of_footage) {
    parts.push_back({"footage", "covered 100.0%", 1});
    return;
  }
  const cv::Mat& mask = context.shown.image->mask;
  const bool masked = mask.type() == CV_8UC1 && cv::Rect({0, 0}, mask.size()).contains(at);
  const double covered = masked ? mask.at<uchar>(at) / 2.55 : 0;
  parts.push_back(
      {formatted("covered %5.1f%%", covered), "covered 100.0%", 1, covered > 0 ? color::kAccent : color::kQuiet});
}

void add_image(std::vector<Part>& parts, const ViewContext& context, const ViewportReadout& readout) {
  if (!context.shown.image || !context.shown.image_is_current)
    parts.push_back({"updating...", "updating...", 2, color::kAccent});
  if (!context.shown.image) return;
  const MemoryUse& memory = context.shown.memory;
  parts.push_back({formatted("memory %.0f of %.0f MiB", mebibytes(memory.sum()), mebibytes(memory.limit)),
                   "memory 0000 of 0000 MiB", 5});
  const PreviewImage& image = *context.shown.image;
  parts.push_back({formatted("%.0f%%", readout.zoom * 100), "0000%", 0, color::kText});
  parts.push_back({formatted("%.0f x %.0f", image.bgr.cols, image.bgr.rows), "0000 x 0000", 3});
  parts.push_back({formatted("%.1f ms", context.shown.compose_ms), "0000.0 ms", 4});
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

}  // namespace

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

}  // namespace sigs::editor
