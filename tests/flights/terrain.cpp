// SPDX-License-Identifier: MIT
#include "flights/terrain.h"

#include <array>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "flights/mosaic.h"
#include "flights/random.h"

namespace sigs::flights {

namespace {

constexpr double kSide_m = 1024;

// A field: one of jittered points in a lattice of lattice x lattice boxes that repeats, nearest to the place.
struct Field {
  std::uint32_t id = 0;
  float to_border = 0;  // in boxes: half the difference of the distances to the two nearest points
};

Field field_at(float u, float v, int lattice, std::uint32_t seed) {
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  float nearest = 1e9F, next = 1e9F;
  Field field;
  for (int a = i - 1; a <= i + 1; ++a)
    for (int b = j - 1; b <= j + 1; ++b) {
      const std::uint32_t id = mixed((a + lattice) % lattice, (b + lattice) % lattice, seed);
      const float du = static_cast<float>(a) + 0.1F + 0.8F * static_cast<float>(id & 0xffff) / 65535 - u;
      const float dv = static_cast<float>(b) + 0.1F + 0.8F * static_cast<float>(id >> 16) / 65535 - v;
      const float apart = std::max(std::abs(du), std::abs(dv)) + 0.3F * (std::abs(du) + std::abs(dv));
      if (apart < nearest) {
        next = nearest;
        nearest = apart;
        field.id = id;
      } else {
        next = std::min(next, apart);
      }
    }
  field.to_border = 0.5F * (next - nearest);
  return field;
}

// Blue, green, red.
cv::Vec3f crop_color(std::uint32_t id) {
  static const std::array<cv::Vec3f, 8> kCrops{{{52, 98, 84},
                                                {60, 118, 104},
                                                {96, 158, 172},
                                                {44, 84, 70},
                                                {78, 104, 128},
                                                {66, 132, 112},
                                                {106, 138, 160},
                                                {58, 92, 96}}};
  const double shade = 0.85 + 0.3 * random_share(int(id & 0xff), 3, id);
  return kCrops[mixed(id + 5) % kCrops.size()] * static_cast<float>(shade);
}

// Furrows and growth on a field: a factor about 1.
float furrows(std::uint32_t id, float x_m, float y_m) {
  const double turn = 2 * std::numbers::pi * random_share(int(id & 0xffff), 1, id);
  const float across_m = static_cast<float>(std::cos(turn)) * x_m + static_cast<float>(std::sin(turn)) * y_m;
  const float width_m = 3 + 5 * static_cast<float>(random_share(int(id & 0xffff), 2, id));
  const float wave = std::sin(across_m * (6.2832F / width_m));
  return 1 + 0.06F * wave + (wave > 0.97F ? 0.10F : 0.0F);
}

void paint_fields(cv::Mat& ground, double cell_m, std::uint32_t seed) {
  constexpr int kLattice = 8;
  const int size = ground.rows;
  const cv::Mat rough = tiled_noise(size, 32, 7, 0.72, seed + 10), warp = tiled_noise(size, 8, 3, 0.5, seed + 30);
  const cv::Mat woods = tiled_noise(size, 4, 6, 0.6, seed + 50);
  cv::parallel_for_({0, size}, [&](const cv::Range& rows) {
    for (int i = rows.start; i < rows.end; ++i)
      for (int j = 0; j < size; ++j) {
        const float x_m = static_cast<float>((i + 0.5) * cell_m), y_m = static_cast<float>((j + 0.5) * cell_m);
        const float per_m = static_cast<float>(kLattice / kSide_m), offset = 0.08F * warp.at<float>(i, j);
        const Field field = field_at(x_m * per_m + offset, y_m * per_m - offset, kLattice, seed);
        const float noise = rough.at<float>(i, j);
        cv::Vec3f color = crop_color(field.id) * (furrows(field.id, x_m, y_m) * (1 + 0.22F * noise));
        if (field.to_border < 0.018F) color = cv::Vec3f(120, 140, 150) * (1 + 0.15F * noise);
        if (woods.at<float>(i, j) > 0.62F) color = cv::Vec3f(34, 56, 44) * (1 + 0.55F * noise);
        ground.at<cv::Vec4b>(i, j) = {cv::saturate_cast<uchar>(color[0]), cv::saturate_cast<uchar>(color[1]),
                                      cv::saturate_cast<uchar>(color[2]), 0};
      }
  });
}

// Draws something wherever it comes back over the mosaic's edge. at_px: column, row.
void on_all_sides(const cv::Mat& ground, cv::Point2d at_px, double reach_px,
                  const std::function<void(cv::Point2d)>& draw) {
  const double size = ground.rows;
  for (const double dx : {-size, 0.0, size})
    for (const double dy : {-size, 0.0, size}) {
      const cv::Point2d there = at_px + cv::Point2d(dx, dy);
      const bool seen =
          there.x > -reach_px && there.y > -reach_px && there.x < size + reach_px && there.y < size + reach_px;
      if (seen) draw(there);
    }
}

cv::Point fixed(cv::Point2d p) {
  return {cvRound(p.x * (1 << kDrawingShift)), cvRound(p.y * (1 << kDrawingShift))};
}

void draw_disc(cv::Mat& ground, cv::Point2d at_px, double radius_px, const cv::Scalar& color) {
  on_all_sides(ground, at_px, 2 * radius_px + 2, [&](cv::Point2d p) {
    cv::circle(ground, fixed(p), cvRound(radius_px * (1 << kDrawingShift)), color, cv::FILLED, cv::LINE_AA,
               kDrawingShift);
  });
}

void draw_tree(cv::Mat& ground, cv::Point2d at_px, double radius_px, double shade) {
  draw_disc(ground, at_px + cv::Point2d(0.7, 0.5) * radius_px, radius_px, cv::Scalar(28, 38, 34));
  draw_disc(ground, at_px, radius_px, cv::Scalar(36, 74, 56) * shade);
  draw_disc(ground, at_px - cv::Point2d(0.25, 0.2) * radius_px, 0.55 * radius_px, cv::Scalar(52, 104, 82) * shade);
}

void draw_tree_rows(cv::Mat& ground, double cell_m, std::uint32_t seed) {
  for (int row = 0; row < 34; ++row) {
    const cv::Point2d start_m(kSide_m * random_share(row, 1, seed), kSide_m * random_share(row, 2, seed));
    const double turn = 2 * std::numbers::pi * random_share(row, 3, seed);
    const int trees = 4 + static_cast<int>(16 * random_share(row, 4, seed));
    for (int k = 0; k < trees; ++k) {
      const double along_m = 9 * k + 3 * random_share(row, 10 + k, seed);
      const cv::Point2d at_m = start_m + along_m * cv::Point2d(std::cos(turn), std::sin(turn));
      draw_tree(ground, at_m / cell_m, (2.4 + 2 * random_share(row, 50 + k, seed)) / cell_m,
                0.75 + 0.5 * random_share(row, 90 + k, seed));
    }
  }
}

void draw_houses(cv::Mat& ground, double cell_m, std::uint32_t seed) {
  static const std::array<cv::Scalar, 3> kRoofs{cv::Scalar(70, 84, 150), cv::Scalar(150, 152, 156),
                                                cv::Scalar(215, 218, 220)};
  for (int k = 0; k < 60; ++k) {
    const cv::Point2d village_m(kSide_m * random_share(k % 4, 1, seed), kSide_m * random_share(k % 4, 2, seed));
    const cv::Point2d at_m = village_m + cv::Point2d(160 * random_share(k, 3, seed), 160 * random_share(k, 4, seed));
    const float turn_deg = static_cast<float>(180 * random_share(k, 5, seed));
    const cv::Size2f size_px(static_cast<float>((9 + 8 * random_share(k, 6, seed)) / cell_m),
                             static_cast<float>(8 / cell_m));
    on_all_sides(ground, at_m / cell_m, 30 / cell_m, [&](cv::Point2d p) {
      const auto block = [&](cv::Point2d middle, const cv::Scalar& color) {
        std::array<cv::Point2f, 4> corners;
        cv::RotatedRect(middle, size_px, turn_deg).points(corners.data());
        std::vector<cv::Point> polygon;
        for (const cv::Point2f& corner : corners) polygon.push_back(fixed(corner));
        cv::fillConvexPoly(ground, polygon, color, cv::LINE_AA, kDrawingShift);
      };
      block(p + cv::Point2d(3, 2) / cell_m, cv::Scalar(30, 34, 34));
      block(p, kRoofs[static_cast<std::size_t>(k) % kRoofs.size()]);
    });
  }
}

// A road through points(t), t in 0..1, in metres east and north; comes back where it began on the torus.
void draw_road(cv::Mat& ground, double cell_m, double width_m, const std::function<cv::Point2d(double)>& point_m) {
  constexpr int kPieces = 256;
  const auto piece = [&](int k, double wide_m, cv::Point2d shift_m, const cv::Scalar& color) {
    const cv::Point2d a = (point_m(double(k) / kPieces) + shift_m) / cell_m;
    const cv::Point2d b = (point_m(double(k + 1) / kPieces) + shift_m) / cell_m;
    on_all_sides(ground, a, 60 / cell_m, [&](cv::Point2d p) {
      cv::line(ground, fixed(p), fixed(p + b - a), color, std::max(1, cvRound(wide_m / cell_m)), cv::LINE_AA,
               kDrawingShift);
    });
  };
  for (int k = 0; k < kPieces; ++k) piece(k, width_m + 4, {}, cv::Scalar(92, 128, 132));
  for (int k = 0; k < kPieces; ++k) piece(k, width_m, {}, cv::Scalar(112, 110, 108));
  for (int k = 0; k < kPieces; k += 4) {
    piece(k, 0.6, {}, cv::Scalar(215, 215, 215));
    piece(k + 1, 0.6, {}, cv::Scalar(215, 215, 215));
  }
}

void draw_edge_lines(cv::Mat& ground, double cell_m, double width_m) {
  for (const double side : {-1.0, 1.0})
    on_all_sides(ground, {side * 0.44 * width_m / cell_m, 0.0}, 20 / cell_m, [&](cv::Point2d p) {
      cv::line(ground, fixed({p.x, 0.0}), fixed({p.x, double(ground.rows)}), cv::Scalar(205, 205, 205),
               std::max(1, cvRound(0.5 / cell_m)), cv::LINE_AA, kDrawingShift);
    });
}

// Asphalt is not one grey: patches and tyre tracks.
void wear_down(cv::Mat& ground, std::uint32_t seed) {
  const cv::Mat noise = tiled_noise(ground.rows, ground.rows / 16, 5, 0.8, seed);
  for (int i = 0; i < ground.rows; ++i)
    for (int j = 0; j < ground.cols; ++j) {
      cv::Vec4b& color = ground.at<cv::Vec4b>(i, j);
      const double factor = 1 + 0.05 * noise.at<float>(i, j);
      for (int k = 0; k < 3; ++k) color[k] = cv::saturate_cast<uchar>(color[k] * factor);
    }
}

void draw_roads(cv::Mat& ground, double cell_m, Roads roads) {
  const double tau = 2 * std::numbers::pi;
  draw_road(ground, cell_m, 7, [&](double t) {
    return cv::Point2d(kSide_m * t, 330 + 90 * std::sin(tau * t) + 30 * std::sin(3 * tau * t));
  });
  if (roads == Roads::winding)
    draw_road(ground, cell_m, 6, [&](double t) { return cv::Point2d(700 + 60 * std::sin(tau * t + 1), kSide_m * t); });
  if (roads == Roads::straight_below) {
    draw_road(ground, cell_m, 13, [&](double t) { return cv::Point2d(0, kSide_m * t); });
    draw_edge_lines(ground, cell_m, 13);
  }
}

cv::Mat ground_image(int detail, Roads roads, std::uint32_t seed) {
  const double cell_m = kSide_m / detail;
  cv::Mat ground(detail, detail, CV_8UC4);
  paint_fields(ground, cell_m, seed);
  draw_tree_rows(ground, cell_m, seed + 100);
  draw_houses(ground, cell_m, seed + 200);
  draw_roads(ground, cell_m, roads);
  wear_down(ground, seed + 300);
  return ground;
}

cv::Mat patch_image(std::uint32_t seed) {
  constexpr int kSize = 512, kLattice = 32;
  const cv::Mat hills = tiled_noise(kSize, 8, 5, 0.6, seed);
  cv::Mat patches(kSize, kSize, CV_8UC4);
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j) {
      const float per_cell = float(kLattice) / kSize;
      const std::uint32_t id = field_at(float(i) * per_cell, float(j) * per_cell, kLattice, seed).id;
      const double light = 128 * (1 + 0.16 * hills.at<float>(i, j)) * (0.8 + 0.4 * random_share(1, 2, id));
      const double warm = 1 + 0.16 * (random_share(3, 4, id) - 0.5);
      patches.at<cv::Vec4b>(i, j) = {cv::saturate_cast<uchar>(light / warm), cv::saturate_cast<uchar>(light),
                                     cv::saturate_cast<uchar>(light * warm), 0};
    }
  return patches;
}

cv::Mat cloud_image(std::uint32_t seed) {
  constexpr int kSize = 1024;
  const cv::Mat heaps = tiled_noise(kSize, 8, 7, 0.58, seed), shade = tiled_noise(kSize, 16, 5, 0.6, seed + 20);
  cv::Mat clouds(kSize, kSize, CV_8UC4);
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j) {
      const double cover = std::clamp((heaps.at<float>(i, j) - 0.12) / 0.5, 0.0, 1.0);
      const uchar shine = cv::saturate_cast<uchar>(226 + 22 * shade.at<float>(i, j) - 20 * cover);
      clouds.at<cv::Vec4b>(i, j) = {shine, shine, shine, cv::saturate_cast<uchar>(235 * cover)};
    }
  return clouds;
}

}  // namespace

Terrain terrain(int detail, Roads roads, std::uint32_t seed) {
  return {.ground = Mosaic(ground_image(detail, roads, seed), kSide_m / detail),
          .patches = Mosaic(patch_image(seed + 1000), 24),
          .clouds = Mosaic(cloud_image(seed + 2000), 10)};
}

}  // namespace sigs::flights
