// SPDX-License-Identifier: MIT
#include "editor/app/window_canvas.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

using namespace sigs::editor;

namespace {

// ImGui without a window: only its draw data matter.
class Screen {
 public:
  Screen() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    resize(800, 600);
  }
  ~Screen() { ImGui::DestroyContext(); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void resize(float width, float height) { ImGui::GetIO().DisplaySize = {width, height}; }

  std::vector<ImVec4> turn(const std::function<void()>& draw, const std::vector<ImVec2>& first = {}) {
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui::NewFrame();
    draw();
    ImGui::Render();
    return changed_.of(*ImGui::GetDrawData(), first);
  }

 private:
  ChangedRegions changed_;
};

void panel(const char* name, float x, float y, float width, float height, const std::string& text) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoNav);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

bool within(const ImVec4& inner, const ImVec4& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.z <= outer.z && inner.w <= outer.w;
}

// All panels at rest.
void settle(Screen& screen, const std::function<void()>& draw) {
  for (int i = 0; i < 4; ++i) (void)screen.turn(draw);
}

}  // namespace

TEST_CASE("the first update draws the whole window, the next one nothing") {
  Screen screen;
  const auto draw = [] { panel("a", 0, 0, 300, 200, "same"); };
  const std::vector<ImVec4> first = screen.turn(draw);
  REQUIRE(first.size() == 1);
  CHECK(within({0, 0, 800, 600}, first[0]));
  settle(screen, draw);
  CHECK(screen.turn(draw).empty());
}

TEST_CASE("a panel that changes is drawn, its neighbour is not") {
  Screen screen;
  std::string text = "before";
  const auto draw = [&] {
    panel("a", 0, 0, 300, 200, text);
    panel("b", 400, 300, 300, 200, "still");
  };
  settle(screen, draw);
  text = "after!";
  const std::vector<ImVec4> changed = screen.turn(draw);
  REQUIRE(changed.size() == 1);
  CHECK(within({12, 11, 44, 17}, changed[0]));  // where the text stands
  CHECK(within(changed[0], {0, 0, 300, 200}));
}

TEST_CASE("of a panel's images the one that is exchanged is drawn, the others are not") {
  Screen screen;
  int image = 7;
  const auto draw = [&] {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({700, 500});
    ImGui::Begin("images", nullptr, ImGuiWindowFlags_NoDecoration);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(5)), {20, 20}, {120, 120});
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(image)), {300, 200}, {400, 300});
    list.AddText({500, 400}, IM_COL32_WHITE, "after it");
    ImGui::End();
  };
  settle(screen, draw);
  image = 8;
  const std::vector<ImVec4> changed = screen.turn(draw);
  REQUIRE(changed.size() == 1);
  CHECK(within({300, 200, 400, 300}, changed[0]));
  CHECK(within(changed[0], {299, 199, 401, 301}));
}

TEST_CASE("the area that a moving panel uncovers is drawn too") {
  Screen screen;
  float x = 20;
  const auto draw = [&] { panel("a", x, 40, 100, 100, "moves"); };
  settle(screen, draw);
  x = 500;
  const std::vector<ImVec4> changed = screen.turn(draw);
  const auto holds = [&](const ImVec4& rect) {
    return std::any_of(changed.begin(), changed.end(), [&](const ImVec4& region) { return within(rect, region); });
  };
  CHECK(holds({20, 40, 120, 140}));
  CHECK(holds({500, 40, 600, 140}));
}

TEST_CASE("a panel that appears, disappears or changes its stacking order redraws everything") {
  Screen screen;
  bool second = false;
  const auto draw = [&] {
    panel("a", 0, 0, 100, 100, "a");
    if (second) panel("b", 300, 300, 100, 100, "b");
  };
  settle(screen, draw);
  second = true;
  (void)screen.turn(draw);  // ImGui shows a new window one update later
  std::vector<ImVec4> changed = screen.turn(draw);
  settle(screen, draw);
  second = false;
  changed = screen.turn(draw);
  REQUIRE(changed.size() == 1);
  CHECK(within({0, 0, 800, 600}, changed[0]));
}

TEST_CASE("a window of another size is drawn whole") {
  Screen screen;
  const auto draw = [] { panel("a", 0, 0, 100, 100, "a"); };
  settle(screen, draw);
  screen.resize(1000, 700);
  const std::vector<ImVec4> changed = screen.turn(draw);
  REQUIRE(changed.size() == 1);
  CHECK(within({0, 0, 1000, 700}, changed[0]));
}

TEST_CASE("regions are few and never overlap, and hold every panel that changed") {
  Screen screen;
  int turn = 0;
  const auto draw = [&] {
    for (int i = 0; i < 9; ++i) {
      const int phase = (turn * (i + 3)) / 7;
      panel(std::to_string(i).c_str(), static_cast<float>(20 + 250 * (i % 3)), static_cast<float>(20 + 190 * (i / 3)),
            150, 120, std::to_string(phase));
    }
  };
  settle(screen, draw);
  for (turn = 1; turn < 40; ++turn) {
    const std::vector<ImVec4> changed = screen.turn(draw);
    CHECK(changed.size() <= 3);
    for (std::size_t i = 0; i < changed.size(); ++i)
      for (std::size_t j = i + 1; j < changed.size(); ++j) {
        const ImVec4 both = common_part(changed[i], changed[j]);
        CHECK((both.z <= both.x || both.w <= both.y));
      }
    for (int i = 0; i < 9; ++i) {
      if ((turn * (i + 3)) / 7 == ((turn - 1) * (i + 3)) / 7) continue;
      // Amid the last digit, which always changes; the first one stands 8 px inside its panel, each is 7 px wide.
      const std::size_t digits = std::to_string((turn * (i + 3)) / 7).size();
      const auto x = static_cast<float>(31 + 250 * (i % 3)) + 7.0F * static_cast<float>(digits - 1);
      const auto y = static_cast<float>(33 + 190 * (i / 3));
      const ImVec4 text{x, y, x + 1, y + 1};
      CHECK(std::any_of(changed.begin(), changed.end(), [&](const ImVec4& region) { return within(text, region); }));
    }
  }
}

TEST_CASE("the intersection of disjoint rectangles is empty") {
  const ImVec4 none = common_part({0, 0, 10, 10}, {20, 0, 30, 10});
  CHECK(none.z <= none.x);
  const ImVec4 some = common_part({0, 0, 10, 10}, {5, -5, 30, 7});
  CHECK(some.x == 5);
  CHECK(some.y == 0);
  CHECK(some.z == 10);
  CHECK(some.w == 7);
}

TEST_CASE("where places come first, the panels elsewhere wait, and are drawn with all that they missed") {
  Screen screen;
  std::string near = "0";
  std::string far = "0";
  std::string image = "0";
  const auto draw = [&] {
    panel("near", 0, 0, 300, 200, near);
    panel("far", 400, 300, 300, 200, far);
    panel("image", 400, 0, 300, 200, image);
  };
  settle(screen, draw);
  const ImVec2 place{100, 100};
  for (const char* const text : {"1", "22", "333"}) {
    near = far = text;
    const std::vector<ImVec4> regions = screen.turn(draw, {place});
    REQUIRE(regions.size() == 1);
    CHECK(within(regions[0], {0, 0, 300, 200}));
  }
  near = far = image = "4444";
  const std::vector<ImVec4> both = screen.turn(draw, {place, {500, 100}});
  REQUIRE(both.size() == 2);
  CHECK(within(both[0], {0, 0, 300, 200}));
  CHECK(within(both[1], {400, 0, 700, 200}));
  const std::vector<ImVec4> missed = screen.turn(draw);
  REQUIRE(missed.size() == 1);
  CHECK(within(missed[0], {400, 300, 700, 500}));
  CHECK(screen.turn(draw).empty());
}

TEST_CASE("a panel that touches what is drawn does not wait") {
  Screen screen;
  std::string text = "0";
  const auto draw = [&] {
    panel("near", 0, 0, 300, 200, text);
    panel("over it", 0, 0, 200, 100, text);  // as a tooltip
  };
  settle(screen, draw);
  text = "1";
  const std::vector<ImVec4> regions = screen.turn(draw, {{250, 150}});  // in the lower panel alone
  REQUIRE(regions.size() == 1);
  CHECK(within(regions[0], {0, 0, 200, 100}));  // where both have their text
  CHECK(screen.turn(draw).empty());             // nothing was left out
}

namespace {

// A coloured rectangle of a panel, in whole pixels.
struct Tile {
  cv::Rect rect;
  unsigned int color = 0;
};

using Tiles = std::vector<std::vector<Tile>>;  // by panel

cv::Mat painted(const Tiles& panels, const std::vector<cv::Rect>& places) {
  cv::Mat image = cv::Mat::zeros(600, 800, CV_32SC1);
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (const Tile& tile : panels[i]) image(tile.rect & places[i]).setTo(static_cast<int>(tile.color));
  return image;
}

Tile random_tile(cv::RNG& random, const cv::Rect& place) {
  const int width = random.uniform(1, 60);
  const int height = random.uniform(1, 60);
  const cv::Point at{place.x + random.uniform(0, place.width - width),
                     place.y + random.uniform(0, place.height - height)};
  return {{at.x, at.y, width, height}, IM_COL32_BLACK | static_cast<unsigned int>(random.uniform(1, 1 << 24))};
}

// One to three tiles move, change their colour, come, go, or change places in the order of drawing.
void change_tiles(cv::RNG& random, const cv::Rect& place, std::vector<Tile>& tiles) {
  for (int count = random.uniform(1, 4); count > 0; --count) {
    const auto one = static_cast<std::size_t>(random.uniform(0, static_cast<int>(tiles.size())));
    const auto other = static_cast<std::size_t>(random.uniform(0, static_cast<int>(tiles.size())));
    switch (random.uniform(0, 5)) {
      case 0:
        tiles[one] = random_tile(random, place);
        break;
      case 1:
        tiles[one].color ^= 0x5A;
        break;
      case 2:
        tiles.push_back(random_tile(random, place));
        break;
      case 3:
        tiles.size() > 5 ? void(tiles.erase(tiles.begin() + static_cast<std::ptrdiff_t>(one))) : void();
        break;
      default:
        std::swap(tiles[one], tiles[other]);
        break;
    }
  }
}

}  // namespace

TEST_CASE("an image in which only the regions are painted anew equals one that is painted as a whole") {
  Screen screen;
  cv::RNG random(3);
  // The third lies over both others, as a tooltip does.
  const std::vector<cv::Rect> places{{0, 0, 390, 590}, {400, 0, 390, 590}, {300, 200, 200, 150}};
  Tiles panels(places.size());
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (int k = 0; k < 40; ++k) panels[i].push_back(random_tile(random, places[i]));
  const auto draw = [&] {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      ImGui::SetNextWindowPos({static_cast<float>(places[i].x), static_cast<float>(places[i].y)});
      ImGui::SetNextWindowSize({static_cast<float>(places[i].width), static_cast<float>(places[i].height)});
      ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
      ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);  // panels are clipped to what it encloses
      ImGui::Begin(std::to_string(i).c_str(), nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav |
                       ImGuiWindowFlags_NoBringToFrontOnFocus);
      ImDrawList& list = *ImGui::GetWindowDrawList();
      for (const Tile& tile : panels[i])
        list.AddRectFilled({static_cast<float>(tile.rect.x), static_cast<float>(tile.rect.y)},
                           {static_cast<float>(tile.rect.br().x), static_cast<float>(tile.rect.br().y)}, tile.color);
      ImGui::End();
      ImGui::PopStyleVar(2);
    }
  };
  settle(screen, draw);
  cv::Mat kept = painted(panels, places);
  double painted_px = 0;
  constexpr int kTurns = 600;
  for (int turn = 0; turn < kTurns; ++turn) {
    // Ever so often as after a drag that leaves its panel alone, then as in one, where the others wait.
    const std::vector<ImVec2> first = turn % 4 == 3 ? std::vector<ImVec2>() : std::vector<ImVec2>{{200, 100}};
    for (std::size_t i = 0; i < panels.size(); ++i)
      if (random.uniform(0, 2) == 0) change_tiles(random, places[i], panels[i]);
    const cv::Mat whole = painted(panels, places);
    for (const ImVec4& region : screen.turn(draw, first)) {
      const cv::Rect rect(cv::Point(static_cast<int>(region.x), static_cast<int>(region.y)),
                          cv::Point(static_cast<int>(region.z), static_cast<int>(region.w)));
      whole(rect).copyTo(kept(rect));
      painted_px += rect.area();
    }
    if (first.empty()) CHECK(cv::norm(whole, kept, cv::NORM_INF) == 0);
  }
  MESSAGE("on average ", painted_px / kTurns, " of 480000 pixels");
  CHECK(painted_px / kTurns < 240'000);  // so that a region that is always the whole window fails
}
