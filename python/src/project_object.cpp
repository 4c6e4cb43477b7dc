// SPDX-License-Identifier: MIT
#include "project_object.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "errors.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/places.h"
#include "project/validate.h"

namespace sigs::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

GivenPose pose_of(const PoseTuple& pose) {
  const auto& [position, attitude, velocity] = pose;
  return {.position_m = {position[0], position[1], position[2]},
          .attitude = {rad_of_deg(attitude[0]), rad_of_deg(attitude[1]), rad_of_deg(attitude[2])},
          .velocity_mps = {velocity[0], velocity[1], velocity[2]}};
}

Error no_such_key(const std::vector<Field>& fields, const std::string& key) {
  std::vector<std::string> keys;
  for (const Field& field : fields) keys.push_back(field.key);
  return {key, "no such field" + suggestion(keys, key), ErrorKind::usage};
}

py::object dict_of(const Field& field) {
  const auto* choice = std::get_if<Choice>(&field.value);
  py::list names;
  if (choice != nullptr)
    for (const std::string_view name : choice->names) names.append(std::string(name));
  return py::dict("key"_a = field.key, "value"_a = json_of(field).dump(), "unit"_a = std::string(field.unit),
                  "help"_a = std::string(field.help), "minimum"_a = field.minimum, "maximum"_a = field.maximum,
                  "choices"_a = py::tuple(names), "is_path"_a = field.is_path);
}

}  // namespace

std::string ProjectObject::value(const std::string& key) const {
  Project copy = project_;
  const std::vector<Field> fields = fields_of(copy);
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.key == current_key(key); });
  if (found == fields.end()) throw Raised(no_such_key(fields, key));
  return json_of(*found).dump();
}

py::list ProjectObject::fields() const {
  Project copy = project_;
  py::list list;
  for (const Field& field : fields_of(copy)) list.append(dict_of(field));
  return list;
}

void ProjectObject::assign(const std::string& key, const std::string& json) {
  Project changed = project_;
  const std::vector<Field> fields = fields_of(changed);
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.key == current_key(key); });
  if (found == fields.end()) throw Raised(no_such_key(fields, key));
  const Json value = value_or_raise(parsed_json(json, key, ErrorKind::usage));
  if (std::string wrong = put_json(value, *found); !wrong.empty())
    throw Raised({key, std::move(wrong), ErrorKind::usage});
  keep_places(project_, changed);
  project_ = std::move(changed);
}

IntruderSettings& ProjectObject::intruder_at(std::size_t index) {
  if (index >= project_.intruders.size()) throw py::index_error("no intruder " + std::to_string(index));
  return project_.intruders[index];
}

py::tuple ProjectObject::waypoints(std::size_t intruder) const {
  if (intruder >= project_.intruders.size()) throw py::index_error("no intruder " + std::to_string(intruder));
  const std::vector<WaypointSettings>& all = project_.intruders[intruder].trajectory.waypoints;
  const auto count = static_cast<py::ssize_t>(all.size());
  py::array_t<double> frames(count);
  py::array_t<double> positions_m({count, py::ssize_t{3}});
  for (py::ssize_t i = 0; i < count; ++i) {
    const WaypointSettings& waypoint = all[static_cast<std::size_t>(i)];
    frames.mutable_at(i) = waypoint.frame.value_or(std::numeric_limits<double>::quiet_NaN());
    for (int axis = 0; axis < 3; ++axis) positions_m.mutable_at(i, axis) = waypoint.position_m[axis];
  }
  return py::make_tuple(frames, positions_m);
}

void ProjectObject::set_waypoints(std::size_t intruder, const std::vector<std::optional<double>>& frames,
                                  const std::vector<std::array<double, 3>>& positions_m) {
  const Project before = project_;
  std::vector<WaypointSettings>& all = intruder_at(intruder).trajectory.waypoints;
  all.resize(positions_m.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].frame = i < frames.size() ? frames[i] : std::nullopt;
    all[i].position_m = {positions_m[i][0], positions_m[i][1], positions_m[i][2]};
  }
  keep_places(before, project_);
}

std::size_t ProjectObject::add_intruder() {
  project_.intruders.emplace_back();
  return project_.intruders.size() - 1;
}

void ProjectObject::remove_intruder(std::size_t intruder) {
  static_cast<void>(intruder_at(intruder));
  project_.intruders.erase(project_.intruders.begin() + static_cast<std::ptrdiff_t>(intruder));
}

std::shared_ptr<RenderThread> ProjectObject::renderer() {
  if (renderer_.get() == nullptr || renderer_.get()->is_spent())
    renderer_ = ProcessBound<RenderThread>(std::make_shared<RenderThread>());
  return renderer_.get();
}

RenderThread::Opened ProjectObject::opened() {
  const Project project = project_;  // other threads may change it while this one waits
  return renderer()->open(project);
}

std::shared_ptr<ProjectObject> ProjectObject::camera(std::size_t index) const {
  if (index >= project_.cameras.size()) throw py::index_error("no camera " + std::to_string(index));
  auto seen = std::make_shared<ProjectObject>(seen_by(project_, index));
  seen->whole_ = project_;
  return seen;
}

std::shared_ptr<ProjectObject> ProjectObject::camera_called(const std::string& name) const {
  return camera(value_or_raise(camera_named(project_, name)));
}

std::shared_ptr<ProjectObject> ProjectObject::kept_camera(std::size_t index) {
  if (index >= project_.cameras.size()) throw py::index_error("no camera " + std::to_string(index));
  while (kept_cameras_.size() < project_.cameras.size())
    kept_cameras_.push_back(std::make_shared<ProjectObject>(Project{}));
  kept_cameras_[index]->project_ = seen_by(project_, index);
  return kept_cameras_[index];
}

std::shared_ptr<FrameObject> ProjectObject::render_camera(std::size_t index, int frame,
                                                          const std::vector<std::pair<int, PoseTuple>>& intruders) {
  const std::shared_ptr<ProjectObject> camera = kept_camera(index);  // stays, should another thread close the project
  return camera->render(frame, {}, intruders);
}

RenderThread::Opened ProjectObject::opened_camera(std::size_t index) {
  const std::shared_ptr<ProjectObject> camera = kept_camera(index);
  return camera->opened();
}

void ProjectObject::close() {
  kept_cameras_.clear();
  renderer_.reset();
}

std::shared_ptr<FrameObject> ProjectObject::render(int frame, const std::optional<PoseTuple>& camera,
                                                   const std::vector<std::pair<int, PoseTuple>>& intruders) {
  GivenPoses poses;
  if (camera) poses.camera = pose_of(*camera);
  for (const auto& [index, pose] : intruders) poses.intruders.push_back({index, pose_of(pose)});
  const Project project = project_;
  return std::make_shared<FrameObject>(renderer()->render(project, frame, poses));
}

namespace {

py::list texts_of(const std::vector<Warning>& warnings) {
  py::list list;
  for (const Warning& warning : warnings) list.append(warning.text());
  return list;
}

py::tuple read(const std::filesystem::path& path) {
  ReadProject read = value_or_raise(read_project(path));
  return py::make_tuple(std::make_shared<ProjectObject>(std::move(read.project)), texts_of(read.warnings));
}

std::shared_ptr<ProjectObject> parse(const std::string& text, const std::filesystem::path& path) {
  return std::make_shared<ProjectObject>(value_or_raise(parse_project(text, path)).project);
}

py::list problems_of(const ProjectObject& object) {
  py::list list;
  for (const Problem& problem : validate(object.project()))
    list.append(py::make_tuple(problem.field, problem.what, name_of(problem.kind)));
  return list;
}

py::dict dict_of(const RenderThread::Opened& opened) {
  const VideoInfo& info = opened.footage;
  return py::dict(
      "path"_a = info.path, "width"_a = info.size_px.width, "height"_a = info.size_px.height,
      "times_s"_a = py::array_t<double>(static_cast<py::ssize_t>(opened.times_s.size()), opened.times_s.data()),
      "frame_rate"_a = py::make_tuple(info.frame_rate_num, info.frame_rate_den), "codec"_a = info.codec,
      "layout"_a = name_of(info.layout), "first_frame"_a = opened.first_frame, "last_frame"_a = opened.last_frame,
      "warnings"_a = texts_of(opened.warnings));
}

py::list camera_names(const ProjectObject& object) {
  py::list names;
  for (const RigCamera& camera : object.project().cameras) names.append(camera.name);
  return names;
}

}  // namespace

void add_project_class(py::module_& module) {
  py::class_<ProjectObject, std::shared_ptr<ProjectObject>>(module, "Project", "A project; sigs.Project wraps it.")
      .def_static("read", &read, py::arg("path"), "Reads a project file: the project, and a list of warnings.")
      .def_static("parse", &parse, py::arg("text"), py::arg("path"),
                  "The project of a file's text; relative paths start in the folder of `path`.")
      .def(
          "text", [](const ProjectObject& object) { return text_of(object.whole()); }, "The project as JSON text.")
      .def(
          "path", [](const ProjectObject& object) { return object.project().file; }, "Where it was read from.")
      .def(
          "write",
          [](const ProjectObject& object, const std::filesystem::path& path, bool overwrite) {
            value_or_raise(write_project(object.whole(), path, overwrite));
          },
          py::arg("path"), py::arg("overwrite"), "Writes the project file.")
      .def("value", &ProjectObject::value, py::arg("key"), "A field's value as JSON text.")
      .def("fields", &ProjectObject::fields, "All fields, each as a dict.")
      .def("assign", &ProjectObject::assign, py::arg("key"), py::arg("json"), "Sets a field to a JSON text.")
      .def("problems", &problems_of, "What validation finds: tuples (field, what, kind).")
      .def("intruder_count", [](const ProjectObject& object) { return object.project().intruders.size(); })
      .def("waypoints", &ProjectObject::waypoints, py::arg("intruder"), "Arrays: frames [n], positions_m [n, 3].")
      .def("set_waypoints", &ProjectObject::set_waypoints, py::arg("intruder"), py::arg("frames"),
           py::arg("positions_m"))
      .def("add_intruder", &ProjectObject::add_intruder, "Appends an intruder; returns its index.")
      .def("remove_intruder", &ProjectObject::remove_intruder, py::arg("intruder"))
      .def("camera_names", &camera_names, "Of several cameras; empty where the project has one.")
      .def("camera_name",
           [](const ProjectObject& object) {
             const std::optional<RigView>& view = object.project().rig_view;
             return view ? std::optional(view->name) : std::nullopt;
           })
      .def("camera", &ProjectObject::camera, py::arg("index"), "The project as one of several cameras sees it.")
      .def("camera", &ProjectObject::camera_called, py::arg("name"))
      .def(
          "opened", [](ProjectObject& object) { return dict_of(object.opened()); },
          "Opens all files; the footage's properties as a dict.")
      .def(
          "opened_camera",
          [](ProjectObject& object, std::size_t index) { return dict_of(object.opened_camera(index)); },
          py::arg("index"), "The same of one of several cameras.")
      .def("render_camera", &ProjectObject::render_camera, py::arg("index"), py::arg("frame"), py::arg("intruders"),
           "Composes one frame of one of several cameras, with given poses.")
      .def("render", &ProjectObject::render, py::arg("frame"), py::arg("camera"), py::arg("intruders"),
           "Composes one frame, with given poses.")
      .def("close", &ProjectObject::close, "Frees decoder and OpenGL context.");
}

}  // namespace sigs::python
