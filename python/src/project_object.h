// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "frame_object.h"
#include "process_bound.h"
#include "project/project.h"
#include "render_thread.h"

namespace sigs::python {

// A pose from Python: position_m, attitude_deg (roll, pitch, yaw), velocity_mps.
using PoseTuple = std::tuple<std::array<double, 3>, std::array<double, 3>, std::array<double, 3>>;

// A project and, once something of it was asked for, its renderer. Used with the GIL; the renderer is made again in a
// forked process.
class ProjectObject {
 public:
  explicit ProjectObject(Project project) : project_(std::move(project)) {}

  [[nodiscard]] const Project& project() const { return project_; }
  // What its file holds: of a camera's project the whole rig, with what was changed through the camera.
  [[nodiscard]] Project whole() const { return whole_ ? put_back(*whole_, project_) : project_; }

  // The project as one camera of a rig sees it, on its own from then on; raises usage where there is no such camera.
  [[nodiscard]] std::shared_ptr<ProjectObject> camera(std::size_t index) const;
  [[nodiscard]] std::shared_ptr<ProjectObject> camera_called(const std::string& name) const;

  // Composes a camera's frame of the rig as it is; decoder and OpenGL of each camera are kept from call to call.
  [[nodiscard]] std::shared_ptr<FrameObject> render_camera(std::size_t index, int frame,
                                                           const std::vector<std::pair<int, PoseTuple>>& intruders);
  [[nodiscard]] RenderThread::Opened opened_camera(std::size_t index);

  [[nodiscard]] std::string value(const std::string& key) const;  // JSON; raises usage for a key that there is not
  [[nodiscard]] pybind11::list fields() const;
  void assign(const std::string& key, const std::string& json);  // raises usage, as for a value of the wrong type

  // Times in frames (NaN: none) and positions [n, 3] in metres of an intruder's waypoints.
  [[nodiscard]] pybind11::tuple waypoints(std::size_t intruder) const;
  void set_waypoints(std::size_t intruder, const std::vector<std::optional<double>>& frames,
                     const std::vector<std::array<double, 3>>& positions_m);
  std::size_t add_intruder();  // returns its index
  void remove_intruder(std::size_t intruder);

  [[nodiscard]] RenderThread::Opened opened();
  [[nodiscard]] std::shared_ptr<FrameObject> render(int frame, const std::optional<PoseTuple>& camera,
                                                    const std::vector<std::pair<int, PoseTuple>>& intruders);
  void close();  // frees decoders and OpenGL; the next call makes them anew

 private:
  [[nodiscard]] std::shared_ptr<RenderThread> renderer();
  [[nodiscard]] IntruderSettings& intruder_at(std::size_t index);
  [[nodiscard]] std::shared_ptr<ProjectObject> kept_camera(
      std::size_t index);  // with the rig's settings of this moment

  Project project_;
  std::optional<Project> whole_;  // of a camera's project: the rig from which it was taken
  ProcessBound<RenderThread> renderer_;
  std::vector<std::shared_ptr<ProjectObject>> kept_cameras_;  // of render_camera()
};

// Adds the class Project to the module.
void add_project_class(pybind11::module_& module);

}  // namespace sigs::python
