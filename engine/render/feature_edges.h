// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// How the pixels of a drawn view follow from body axes, and what was drawn there.
struct DrawnDepth {
  glm::dmat4 clip_from_body{
      1};                     // OpenGL's clip coordinates of the whole view; row 0 of the view is row 0 of the window
  glm::dvec3 eye_m{0, 0, 0};  // body axes
  bool from_outside = false;  // whether the eye is outside the body and all of the body in front of it
  cv::Mat depth;              // CV_32FC1 of the view's size, as OpenGL has it: 0 near, 1 far or nothing there
};

// The edges of a mesh at which its image may change within less than a pixel: outlines, rims, creases, and borders
// between materials. Between them a mesh is smooth, so that a coarse image of it misses nothing.
class FeatureEdges {
 public:
  explicit FeatureEdges(const Mesh& mesh);

  // The pixels of a view that such an edge touches, and all those beside them: CV_8UC1 of the view's size, 255 or 0.
  // Edges that cannot be seen are left out: on the far side of a watertight surface, and behind what is drawn.
  [[nodiscard]] cv::Mat pixels_touched(const DrawnDepth& view) const;

 private:
  struct Edge {
    std::array<glm::vec3, 2> ends_m;   // body axes
    std::array<glm::vec3, 2> normals;  // of the triangles beside it, of any length
    bool is_feature = false;           // wherever it is seen from; others only where they are the outline
    bool is_of_closed = false;         // of a watertight surface, with normals that point outward
  };
  [[nodiscard]] static bool is_shown(const Edge& edge, const DrawnDepth& view);

  std::vector<Edge> edges_;
};

}  // namespace sigs
