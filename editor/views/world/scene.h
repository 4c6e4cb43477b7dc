// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/geometry/coarse_mesh.h"
#include "editor/geometry/image_view.h"
#include "editor/geometry/orbit_camera.h"
#include "editor/views/context.h"
#include "editor/views/world/model.h"

namespace sigs::editor {

// Draws things of the world where the screen shows them, in one update. Points are in the world frame in metres, widths
// in pixels where the text is 15 px high. Labels that would cover another one or stick out are left out, so the
// important ones come first.
class WorldCanvas {
 public:
  WorldCanvas(ImDrawList& list, const OrbitCamera& eye, const ScreenRect& rect) : list_(list), eye_(eye), rect_(rect) {}

  [[nodiscard]] ImDrawList& list() { return list_; }
  [[nodiscard]] const OrbitCamera& eye() const { return eye_; }
  [[nodiscard]] const ScreenRect& rect() const { return rect_; }
  // Where the screen shows a point. Nothing for what is behind the eye or not within the rect, with some margin.
  [[nodiscard]] std::optional<glm::dvec2> in_sight(const glm::dvec3& p_in_world, double margin_px = 0) const;

  // What of a line lies within the rect.
  [[nodiscard]] std::optional<std::array<glm::dvec2, 2>> within_rect(const glm::dvec3& a_m,
                                                                     const glm::dvec3& b_m) const;

  // What passes behind the eye is cut off; the same with the two below.
  void line(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width = 1);
  void dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width = 1);
  void polyline(std::span<const glm::dvec3> points_m, ImU32 color, double width = 1);

  enum class Side { right, centre };
  // Beside or around a place of the screen; false: there was no room, and nothing is drawn.
  bool label(const glm::dvec2& at, const std::string& text, ImU32 color, Side side = Side::right,
             Font font = Font::small);
  // Beside a place of the screen, that far from it, on whichever side there is room.
  bool label_beside(const glm::dvec2& at, double gap_px, const std::string& text, ImU32 color);
  // No label may cover this.
  void keep_free(const ScreenRect& area) { labels_.keep_free(area); }

 private:
  // With its upper left corner there.
  bool put(const glm::dvec2& low, const std::string& text, ImU32 color, Font font);

  ImDrawList& list_;
  const OrbitCamera& eye_;
  ScreenRect rect_;
  LabelPlacer labels_{2};
};

// What the world view draws from in one update.
struct WorldContext {
  const ViewContext& context;
  const WorldModel& model;
  const WorldMoment& moment;
  const RigBorders* borders = nullptr;  // of the cameras of a rig; null: there is one camera
};

// Camera path, camera and its field of view (of a rig those of all cameras, with their names), trajectories with what
// is flagged on them, closest approaches. `hovered` is highlighted as if it were selected.
void draw_camera(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
void draw_trajectories(WorldCanvas& canvas, const WorldContext& world);
void draw_waypoints(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
void draw_closest_approaches(WorldCanvas& canvas, const WorldContext& world);

// A line from a place of the air to the ground below (or above) it, with a mark where it stands.
void draw_drop_line(WorldCanvas& canvas, const glm::dvec3& from_m, ImU32 color);

// How far the field of view is drawn.
[[nodiscard]] double view_depth_m(const WorldModel& model);

// The ground ruled in metres; level with it, one line with its metres.
void draw_ground(WorldCanvas& canvas);
// How far its lines are from the world's origin, at the edges, in the axis' colour; after what has a better claim to
// room.
void draw_ground_labels(WorldCanvas& canvas);
// The world's axes in the lower left corner.
void draw_axes(WorldCanvas& canvas);

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

// Where the light is drawn: the point light at its position, the sun far away in its direction at the playhead
// (straight up while no scene is open).
[[nodiscard]] glm::dvec3 shown_light_m(const WorldContext& world);

// A sun where the light stands, or at the edge an arrow to it where it stands elsewhere.
void draw_light(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
// Where the sun or the arrow is on the screen.
[[nodiscard]] glm::dvec2 light_mark(const WorldCanvas& canvas, const glm::dvec3& light_m);

// The volumes of well clear around the camera at the playhead, as upright cylinders of radius DMOD (or HMD, if larger)
// and of ZTHR above and below: those of export.encounter, else small-uas. Red while an intruder has lost it, which
// modified tau may cause outside of the cylinder.
void draw_volumes(WorldCanvas& canvas, const WorldContext& world);

}  // namespace sigs::editor
