// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>
#include <utility>

#include "render/renderer.h"
#include "render/scenes.h"
#include "support/test_data.h"

namespace sigs {

using namespace test;

namespace {

Mesh glass_box() {
  Mesh mesh = box({1, 2, 0.5F}, paint({0.8F, 0.6F, 0.4F}));
  mesh.materials.push_back(paint({0.2F, 0.9F, 0.4F}, 0.4F));
  add_quad(mesh, {-1.5F, -1, 1}, {0, 2, 0}, {0, 0, -2}, 1);
  add_quad(mesh, {-2, -1, 1}, {0, 2, 0.3F}, {0, 0.2F, -2}, 1);
  return measured(std::move(mesh));
}

Pose<frame::Camera, frame::Body> turned_pose() {
  return {rotation_of({0.3, -0.2, 2.5}), {12, 0.4, -0.3}};
}

Layer image(Renderer& by, const Mesh& mesh) {
  return by.draw(mesh, turned_pose(), {.p_in_camera = {-20, 40, -30}}, view_of({160, 120}, 300)).value();
}

bool same(const Layer& a, const Layer& b) {
  return a.rect == b.rect && same_bytes(a.color, b.color) && same_bytes(a.coverage, b.coverage);
}

}  // namespace

TEST_CASE("the description names platform, driver and version") {
  const std::string text = renderer().description();
  CAPTURE(text);
  CHECK((text.starts_with("surfaceless, ") || text.starts_with("EGL device ")));
  CHECK(text.find("OpenGL ") != std::string::npos);
}

TEST_CASE("the same call gives the same bytes, from another renderer too") {
  const Mesh mesh = glass_box();
  const Layer first = image(renderer(), mesh);
  CHECK(is_valid(first));
  CHECK(cv::countNonZero(first.coverage) > 1000);
  CHECK(same(first, image(renderer(), mesh)));
  Renderer other = Renderer::create().value();
  CHECK(same(first, image(other, mesh)));
  CHECK(same(first, image(renderer(), mesh)));  // the two take turns on this thread
}

TEST_CASE("earlier calls do not affect the result") {
  const Mesh mesh = glass_box();
  const Layer first = image(renderer(), mesh);
  static_cast<void>(drawn(box({3, 3, 3}, paint({1, 1, 1}, 0.5F)), at({5, 0, 0}), Light{}, view_of({700, 300}, 400)));
  CHECK(same(first, image(renderer(), mesh)));
}

TEST_CASE("two renderers on two threads render at the same time") {
  const Mesh mesh = glass_box();
  const Layer expected = image(renderer(), mesh);
  std::array<int, 2> good{0, 0};
  const auto work = [&](int& count) {
    Renderer own = Renderer::create().value();
    for (int i = 0; i < 20; ++i)
      if (same(expected, image(own, mesh))) ++count;
  };
  std::thread one(work, std::ref(good[0]));
  std::thread two(work, std::ref(good[1]));
  one.join();
  two.join();
  CHECK(good[0] == 20);
  CHECK(good[1] == 20);
  CHECK(same(expected, image(renderer(), mesh)));
}

TEST_CASE("a renderer can be moved within its thread") {
  const Mesh mesh = glass_box();
  const Layer expected = image(renderer(), mesh);
  Renderer first = Renderer::create().value();
  Renderer second = std::move(first);
  CHECK(same(expected, image(second, mesh)));
  second = Renderer::create().value();
  CHECK(same(expected, image(second, mesh)));
}

TEST_CASE("another mesh at the same address is uploaded again") {
  Mesh mesh = box({1, 1, 1}, paint({1, 0, 0}));
  const auto seen = [&] { return renderer().draw(mesh, at({10, 0, 0}), ambient_only(), view_of({9, 9}, 100)).value(); };
  const auto middle = [&] { return seen().color.at<cv::Vec4f>(4, 4); };
  CHECK(middle() == cv::Vec4f(1, 0, 0, 1));
  mesh.materials[0].diffuse = {0, 0, 1};
  CHECK(middle() == cv::Vec4f(0, 0, 1, 1));
  mesh.materials[0].texture = cv::Mat(2, 2, CV_8UC4, cv::Scalar(255, 255, 0, 255));
  CHECK(middle() == cv::Vec4f(0, 0, 0, 1));
  mesh.materials[0].texture = cv::Scalar(255, 255, 255, 255);  // the same pixels in memory
  CHECK(middle() == cv::Vec4f(0, 0, 1, 1));
  for (Vertex& vertex : mesh.vertices) vertex.position_m.y += 3;  // the same vertices in memory, another place
  mesh = measured(std::move(mesh));
  CHECK(cv::countNonZero(seen().coverage) == 0);
}

TEST_CASE("a view of no size is an empty layer and one too large is an error") {
  const Mesh mesh = glass_box();
  CHECK(drawn(mesh, at({10, 0, 0}), Light{}, view_of({0, 0}, 100)).empty());
  const int too_large = renderer().max_size_px() + 1;
  const Result<Layer> layer = renderer().draw(mesh, at({10, 0, 0}), Light{}, view_of({too_large, 1}, 100));
  REQUIRE_FALSE(layer);
  CHECK(layer.error().text().find(std::to_string(too_large)) != std::string::npos);
  CHECK(drawn(mesh, at({10, 0, 0}), Light{}, view_of({renderer().max_size_px(), 1}, 100)).rect.width ==
        renderer().max_size_px());
}

TEST_CASE("a mesh without triangles draws nothing") {
  const Layer layer = drawn(Mesh{}, at({10, 0, 0}), Light{}, view_of({5, 4}, 100));
  CHECK(layer.rect == cv::Rect(0, 0, 5, 4));
  CHECK(cv::countNonZero(layer.coverage) == 0);
}

TEST_CASE("real aircraft are rendered correctly from every side") {
  if (!has_real_data()) return;
  Renderer by = Renderer::create().value();
  for (const char* file : {"boeing737-300/boeing737-300.obj", "cessna172p-hires/cessna172p-hires.obj",
                           "glider-centrair101/glider-centrair101.obj", "helicopter-dauphin/helicopter-dauphin.obj"}) {
    CAPTURE(file);
    const Mesh mesh = read_obj(real_data() / "models" / file, {.forward = "-x", .up = "+y"}).value();
    for (int i = 0; i < 6; ++i) {
      const Pose<frame::Camera, frame::Body> pose{rotation_of({0.2 * i, 0.3 * i - 0.7, 1.1 * i}), {60, 1, 2}};
      const Light light{.p_in_camera = {-500, 300, -900}};
      const Layer layer = by.draw(mesh, pose, light, view_of({200, 160}, 300)).value();
      CHECK(is_valid(layer));
      CHECK(cv::countNonZero(layer.coverage) > 100);
    }
  }
}

// Pixels of the first that differ from the second, within the wanted cells.
static int different_pixels(const Layer& a, const Layer& b, const ViewCells& cells) {
  int count = 0;
  for (int y = 0; y < a.rect.height; ++y)
    for (int x = 0; x < a.rect.width; ++x) {
      if (cells.wanted.at<uchar>(y / cells.step, x / cells.step) == 0) continue;
      const bool same = a.color.at<cv::Vec4f>(y, x) == b.color.at<cv::Vec4f>(y, x) &&
                        a.coverage.at<float>(y, x) == b.coverage.at<float>(y, x);
      count += same ? 0 : 1;
    }
  return count;
}

TEST_CASE("cells of a view are drawn as in the whole view, over pieces and at its borders") {
  const Mesh mesh = glass_box();
  const VirtualCamera view = view_of({1301, 1100}, 3000);
  for (const Light& light : {Light{.p_in_camera = {-20, 40, -30}},
                             Light{.kind = Light::Kind::sun, .to_sun = {-1, 0.5, -1}, .sky_color = glm::dvec3(0.3)}}) {
    const Layer whole = renderer().draw(mesh, turned_pose(), light, view).value();
    for (const int step : {3, 4}) {
      ViewCells cells{.wanted = cv::Mat::zeros((1100 + step - 1) / step, (1301 + step - 1) / step, CV_8UC1),
                      .step = step};
      for (int j = 0; j < cells.wanted.rows; ++j)
        for (int i = 0; i < cells.wanted.cols; ++i)
          if ((i * 7 + j * 3) % 11 == 0 || (i / 40 + j / 30) % 3 == 0 || i + 1 == cells.wanted.cols)
            cells.wanted.at<uchar>(j, i) = 255;
      const std::int64_t before = renderer().counts().pixels_drawn;
      const Layer some = renderer().draw_cells(mesh, turned_pose(), light, view, cells).value();
      CHECK(renderer().counts().pixels_drawn > before);
      CHECK(different_pixels(some, whole, cells) == 0);
    }
  }
}

TEST_CASE("no wanted cell draws nothing") {
  const Mesh mesh = glass_box();
  const VirtualCamera view = view_of({300, 200}, 400);
  const std::int64_t before = renderer().counts().pixels_drawn;
  CHECK(renderer().draw_cells(mesh, turned_pose(), Light{}, view, {cv::Mat::zeros(67, 100, CV_8UC1), 3}));
  CHECK(renderer().counts().pixels_drawn == before);
}

TEST_CASE("a coarse drawing shows what the fine one shows, and marks the pixels where it changes at once") {
  const Mesh mesh = glass_box();
  const VirtualCamera view = view_of({601, 400}, 1200);
  const Light light{.p_in_camera = {-20, 40, -30}};
  const int step = 4;
  Renderer single = Renderer::create(1).value();
  const Layer fine = single.draw(mesh, turned_pose(), light, view).value();
  const CoarseDrawing coarse = single.draw_coarsely(mesh, turned_pose(), light, view, step).value();
  REQUIRE(coarse.layer.rect.size() == cv::Size(151, 100));
  int even = 0;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 150; ++i) {
      // Where no edge is near, all fine pixels of the cell are covered alike; so is the coarse one.
      if (coarse.at_edges.at<uchar>(j, i) != 0) continue;
      const cv::Mat cell = fine.coverage(cv::Rect(i * step, j * step, step, step));
      const auto [low, high] = std::pair(*std::min_element(cell.begin<float>(), cell.end<float>()),
                                         *std::max_element(cell.begin<float>(), cell.end<float>()));
      CHECK(low == high);
      CHECK(low == coarse.layer.coverage.at<float>(j, i));
      ++even;
    }
  CHECK(even > 10'000);
  CHECK(cv::countNonZero(coarse.at_edges) > 300);
}

}  // namespace sigs
