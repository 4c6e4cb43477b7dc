// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "editor/geometry/coarse_mesh.h"
#include "editor/views/world/scene.h"

namespace sigs::editor {

// The models' shapes with few faces, made once for each model that is flown.
class BodyShapes {
 public:
  [[nodiscard]] const CoarseMesh& of(const std::shared_ptr<const Model>& model);
  // Forgets models that are not among these.
  void keep_only(const std::vector<WorldBody>& bodies);

 private:
  std::map<std::shared_ptr<const Model>, CoarseMesh> shapes_;
};

// Aircraft at the playhead, far to near, flat shaded in their colours; drawn larger than they are where they would be
// too small to be visible. With drop line and distance to the camera.
void draw_bodies(WorldCanvas& canvas, const WorldContext& world, BodyShapes& shapes, const Selection& hovered);

// Where the light is drawn: the point light at its position, the sun far away in its direction at the playhead (straight
// up while no scene is open).
[[nodiscard]] glm::dvec3 shown_light_m(const WorldContext& world);

// A sun where the light stands, or at the edge an arrow to it where it stands elsewhere.
void draw_light(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
// Where the sun or the arrow is on the screen.
[[nodiscard]] glm::dvec2 light_mark(const WorldCanvas& canvas, const glm::dvec3& light_m);

}  // namespace sigs::editor
