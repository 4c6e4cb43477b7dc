// SPDX-License-Identifier: MIT
#include "frame/synthetic_scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "scene/opened_project.h"
#include "video/video_writer.h"

namespace sigs::test {

namespace {

// One face of a block, cut into steps x steps squares.
void write_face(std::ofstream& out, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int steps,
                std::vector<glm::dvec3>& vertices) {
  const std::size_t first = vertices.size() + 1;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec3 p = corner + u * (double(i) / steps) + v * (double(j) / steps);
      vertices.push_back(p);
      out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
  const auto row = static_cast<std::size_t>(steps) + 1;
  for (std::size_t j = 0; j + 1 < row; ++j)
    for (std::size_t i = 0; i + 1 < row; ++i) {
      const std::size_t a = first + j * row + i;
      out << "f " << a << ' ' << a + 1 << ' ' << a + row + 1 << ' ' << a + row << '\n';
    }
}

void write_block(std::ofstream& out, const Block& block, int steps, std::vector<glm::dvec3>& vertices) {
  const glm::dvec3 size = block.high_m - block.low_m;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 u(0);
    glm::dvec3 v(0);
    glm::dvec3 depth(0);
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    depth[axis] = size[axis];
    write_face(out, block.low_m, v, u, steps, vertices);
    write_face(out, block.low_m + depth, u, v, steps, vertices);
  }
}

std::uint32_t grain(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t h = x * 0x9E3779B1U ^ y * 0x85EBCA77U ^ z * 0xC2B2AE3DU;
  h ^= h >> 15;
  h *= 0x2C1B3C6DU;
  return h ^ (h >> 13);
}

cv::Mat grainy_plane(cv::Size size, int number, int plane) {
  cv::Mat out(size, CV_8UC1);
  const int middle = plane == 0 ? 130 : 118 + 10 * plane;
  const int swing = plane == 0 ? 70 : 25;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double wave = std::sin(0.05 * (x + 3 * number) + plane) * std::cos(0.07 * (y - number));
      const auto noise = static_cast<int>(grain(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                                static_cast<std::uint32_t>(3 * number + plane)) %
                                          17);
      out.at<uchar>(y, x) = cv::saturate_cast<uchar>(middle + swing * wave + noise - 8);
    }
  return out;
}

cv::Size chroma_size_of(cv::Size size, PixelLayout layout) {
  if (layout == PixelLayout::yuv420) return {(size.width + 1) / 2, (size.height + 1) / 2};
  if (layout == PixelLayout::yuv422) return {(size.width + 1) / 2, size.height};
  return size;
}

}  // namespace

std::vector<glm::dvec3> write_obj(const std::filesystem::path& path, const std::vector<Block>& blocks, int steps) {
  std::ofstream out(path);
  out.precision(17);
  std::ofstream materials(std::filesystem::path(path).replace_extension(".mtl"));
  out << "mtllib " << path.stem().string() << ".mtl\n";
  std::vector<glm::dvec3> vertices;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const glm::dvec3& kd = blocks[i].color;
    materials << "newmtl paint" << i << "\nKd " << kd.x << ' ' << kd.y << ' ' << kd.z << "\nKs 0 0 0\n";
    out << "usemtl paint" << i << '\n';
    write_block(out, blocks[i], steps, vertices);
  }
  return vertices;
}

void write_sphere_obj(const std::filesystem::path& path, double radius_m) {
  constexpr int kRings = 24;
  constexpr int kSpokes = 48;
  std::ofstream out(path);
  out.precision(17);
  for (int ring = 0; ring <= kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double theta = std::numbers::pi * ring / kRings;
      const double phi = 2 * std::numbers::pi * spoke / kSpokes;
      out << "v " << radius_m * std::sin(theta) * std::cos(phi) << ' ' << radius_m * std::sin(theta) * std::sin(phi)
          << ' ' << radius_m * std::cos(theta) << '\n';
    }
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const int a = ring * kSpokes + spoke + 1;
      const int b = ring * kSpokes + (spoke + 1) % kSpokes + 1;
      if (ring > 0) out << "f " << a << ' ' << a + kSpokes << ' ' << b << '\n';
      if (ring + 1 < kRings) out << "f " << b << ' ' << a + kSpokes << ' ' << b + kSpokes << '\n';
    }
}

std::vector<Block> aircraft() {
  return {{{-6, -0.75, -0.75}, {6, 0.75, 0.75}, {0.9, 0.9, 0.9}},
          {{-1, 0.75, -0.125}, {1.5, 7, 0.125}, {0.8, 0.2, 0.2}},
          {{-1, -5, -0.125}, {1.5, -0.75, 0.125}, {0.2, 0.2, 0.8}},
          {{-6, -0.125, -3}, {-4, 0.125, -0.75}, {0.2, 0.8, 0.2}},
          {{0.5, -0.5, 0.75}, {2, 0.25, 1.5}, {0.6, 0.6, 0.1}}};
}

void write_calibration(const std::filesystem::path& path, const cv::Matx33d& matrix,
                       const std::vector<double>& coefficients, cv::Size size_px, bool is_fisheye) {
  cv::FileStorage file(path.string(), cv::FileStorage::WRITE);
  file << "image_width" << size_px.width << "image_height" << size_px.height;
  if (is_fisheye) file << "fisheye_model" << 1;
  file << "camera_matrix" << cv::Mat(matrix);
  file << "distortion_coefficients" << cv::Mat(coefficients, true);
}

ColorInfo stated_color() {
  return {.matrix = ColorMatrix::bt601, .matrix_stated = true, .range_stated = true};
}

Frame grainy_frame(cv::Size size_px, int number, PixelLayout layout, const ColorInfo& color) {
  Frame frame{.layout = layout, .color = color, .time_s = number / 25.0};
  frame.planes[0] = grainy_plane(size_px, number, 0);
  for (int plane = 1; plane < frame.plane_count(); ++plane)
    frame.planes[static_cast<std::size_t>(plane)] = grainy_plane(chroma_size_of(size_px, layout), number, plane);
  return frame;
}

Frame even_frame(cv::Size size_px, uchar luma, PixelLayout layout) {
  Frame frame{.layout = layout};
  frame.planes[0] = cv::Mat(size_px, CV_8UC1, cv::Scalar(luma));
  for (int plane = 1; plane < frame.plane_count(); ++plane)
    frame.planes[static_cast<std::size_t>(plane)] = cv::Mat(chroma_size_of(size_px, layout), CV_8UC1, cv::Scalar(128));
  return frame;
}

void write_footage(const std::filesystem::path& path, cv::Size size_px, int frames, PixelLayout layout,
                   const ColorInfo& color) {
  Result<VideoWriter> writer =
      VideoWriter::open(path, {.codec = VideoCodec::ffv1, .size_px = size_px, .layout = layout, .color = color});
  if (!writer) FAIL(writer.error().text());
  for (int n = 0; n < frames; ++n) {
    const Result<void> written = writer->write(grainy_frame(size_px, n, layout, color), n);
    if (!written) FAIL(written.error().text());
  }
  REQUIRE(writer->finish().has_value());
}

Scenario::Scenario(cv::Size size_px, int frames) : footage_{.size_px = size_px} {
  for (int n = 0; n < frames; ++n) footage_.times_s.push_back(n / 25.0);
  std::ofstream(path("footage.mkv")) << "stands in for footage";
  write_calibration(path("pinhole.xml"),
                    {kFocal_px, 0, (size_px.width - 1) / 2.0, 0, kFocal_px, (size_px.height - 1) / 2.0, 0, 0, 1},
                    {0, 0, 0, 0, 0}, size_px);
  project.file = path("project.json");
  project.name = "lot";
  project.footage.video = "footage.mkv";
  project.footage.calibration = "pinhole.xml";
  project.compositing.blur_px_per_m = 0;
  project.appearance.psf_sigma_px = 0;
}

IntruderSettings& Scenario::add(const std::string& model_file, const glm::dvec3& p_in_world) {
  IntruderSettings intruder;
  intruder.name = "intruder " + std::to_string(project.intruders.size());
  intruder.model = {.file = model_file, .forward = "+x", .up = "-z"};
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = p_in_world}};
  project.intruders.push_back(intruder);
  return project.intruders.back();
}

Scene Scenario::opened() const {
  Result<Scene> scene = open_scene(project, footage_);
  if (!scene) FAIL(scene.error().text());
  return std::move(*scene);
}

ComposedFrame composed(const Scene& scene, int frame, const Frame& background) {
  ComposeContext context;
  Result<ComposedFrame> result = compose_frame(scene, frame, background, context);
  if (!result) FAIL(result.error().text());
  return std::move(*result);
}

ComposedFrame composed(const Scenario& scenario) {
  return composed(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1));
}

void add_aircraft(Scenario& scenario, const glm::dvec3& position_m) {
  write_obj(scenario.path("aircraft.obj"), aircraft(), 2);
  scenario.add("aircraft.obj", position_m);
}

cv::Rect box_of(const cv::Mat& mask) {
  return mask.empty() ? cv::Rect() : cv::boundingRect(mask);
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols) * a.elemSize()) != 0) return false;
  return true;
}

bool same_planes(const Frame& a, const Frame& b) {
  if (a.layout != b.layout) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.plane_count()); ++i)
    if (!same_bytes(a.planes[i], b.planes[i])) return false;
  return true;
}

}  // namespace sigs::test
