// SPDX-License-Identifier: MIT
#include "ego_motion/window_bias.h"

#include <algorithm>
#include <cmath>

namespace sigs {

namespace {

constexpr int kNode_px = 80;       // between places at which the gradient is found; between them it is linear
constexpr float kNear_px = 60;     // neighbours at this distance have a quarter of the weight
constexpr int kRounds = 2;         // the second with weights by how far features agree
constexpr float kAgree_px = 0.2F;  // with the displacement of their neighbours
constexpr float kPrior_px2 = 100;  // spread of the places from which on the gradient is believed

// Displacements around one place as d + A x, x from the place in units of kNear_px.
struct LocalFit {
  cv::Vec3f dx{0, 0, 0};  // (d, A11, A12)
  cv::Vec3f dy{0, 0, 0};
};

LocalFit refined(const LocalFit& fit, cv::Point2f place, std::span<const cv::Point2f> from,
                 std::span<const cv::Point2f> to, bool first) {
  cv::Matx33f normal =
      cv::Matx33f::diag({1e-6F, kPrior_px2 / (kNear_px * kNear_px), kPrior_px2 / (kNear_px * kNear_px)});
  cv::Vec3f right_x{0, 0, 0};
  cv::Vec3f right_y{0, 0, 0};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Vec3f at{1, (from[i].x - place.x) / kNear_px, (from[i].y - place.y) / kNear_px};
    const float far = at[1] * at[1] + at[2] * at[2];
    if (far > 4) continue;
    const cv::Point2f moved = to[i] - from[i];
    float weight = 1 / ((1 + far) * (1 + far));
    if (!first) {
      const float x = (moved.x - fit.dx.dot(at)) / kAgree_px;
      const float y = (moved.y - fit.dy.dot(at)) / kAgree_px;
      weight /= (1 + x * x + y * y) * (1 + x * x + y * y);
    }
    normal += weight * at * at.t();
    right_x += weight * moved.x * at;
    right_y += weight * moved.y * at;
  }
  const cv::Matx33f inverse = normal.inv(cv::DECOMP_CHOLESKY);
  return {inverse * right_x, inverse * right_y};
}

}  // namespace

WindowResponse window_response(const cv::Mat& derivatives, cv::Point2f middle, int half) {
  const int column = cvRound(middle.x);
  const int row = cvRound(middle.y);
  float xx = 0, xy = 0, yy = 0;
  WindowResponse sums = WindowResponse::zeros();
  for (int y = row - half; y <= row + half; ++y) {
    const auto* line = derivatives.ptr<cv::Vec2s>(y);
    const float v = static_cast<float>(y) - middle.y;
    for (int x = column - half; x <= column + half; ++x) {
      const float u = static_cast<float>(x) - middle.x;
      const auto gx = static_cast<float>(line[x][0]);
      const auto gy = static_cast<float>(line[x][1]);
      const float a = gx * gx, b = gx * gy, c = gy * gy;
      xx += a;
      xy += b;
      yy += c;
      sums(0, 0) += a * u;
      sums(0, 1) += a * v;
      sums(0, 2) += b * u;
      sums(0, 3) += b * v;
      sums(1, 2) += c * u;
      sums(1, 3) += c * v;
    }
  }
  sums(1, 0) = sums(0, 2);
  sums(1, 1) = sums(0, 3);
  const float determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-4F * (xx + yy) * (xx + yy))) return WindowResponse::zeros();
  return cv::Matx22f(yy, -xy, -xy, xx) * (1 / determinant) * sums;
}

std::vector<cv::Vec4f> displacement_gradients(std::span<const cv::Point2f> from, std::span<const cv::Point2f> to,
                                              cv::Size size_px) {
  const int columns = (size_px.width + kNode_px - 1) / kNode_px;
  const int rows = (size_px.height + kNode_px - 1) / kNode_px;
  std::vector<cv::Vec4f> nodes;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const cv::Point2f place((static_cast<float>(column) + 0.5F) * static_cast<float>(kNode_px),
                              (static_cast<float>(row) + 0.5F) * static_cast<float>(kNode_px));
      LocalFit fit;
      for (int round = 0; round < kRounds; ++round) fit = refined(fit, place, from, to, round == 0);
      nodes.push_back(cv::Vec4f(fit.dx[1], fit.dx[2], fit.dy[1], fit.dy[2]) / kNear_px);
    }
  std::vector<cv::Vec4f> gradients;
  for (const cv::Point2f& p : from) {
    const float x = std::clamp(p.x / static_cast<float>(kNode_px) - 0.5F, 0.0F, static_cast<float>(columns - 1));
    const float y = std::clamp(p.y / static_cast<float>(kNode_px) - 0.5F, 0.0F, static_cast<float>(rows - 1));
    const int column = std::min(static_cast<int>(x), std::max(0, columns - 2));
    const int row = std::min(static_cast<int>(y), std::max(0, rows - 2));
    const float u = x - static_cast<float>(column);
    const float v = y - static_cast<float>(row);
    const auto node = [&](int i, int j) {
      return nodes[static_cast<std::size_t>(std::min(row + j, rows - 1) * columns + std::min(column + i, columns - 1))];
    };
    gradients.push_back((1 - v) * ((1 - u) * node(0, 0) + u * node(1, 0)) +
                        v * ((1 - u) * node(0, 1) + u * node(1, 1)));
  }
  return gradients;
}

}  // namespace sigs
