// SPDX-License-Identifier: MIT
#include "editor/document/content_id.h"

#include <bit>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "camera/camera.h"
#include "project/json.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

std::string whole_path(const Project& project, const std::string& path) {
  if (path.empty()) return {};
  std::error_code code;
  const fs::path resolved_path = resolved(project, path);
  const fs::path absolute = fs::absolute(resolved_path, code);
  return (code ? resolved_path : absolute).lexically_normal().string();
}

// FNV-1a with 128 bits; its constants are those of RFC 9923.
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
    add(text.size());
  }
  void add(std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) add_byte(static_cast<unsigned char>(number >> (8 * byte)));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const ContentId& id) {
    add(id.high);
    add(id.low);
  }
  [[nodiscard]] ContentId id() const {
    return {static_cast<std::uint64_t>(sum_ >> 64), static_cast<std::uint64_t>(sum_)};
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr Wide kPrime = (Wide(1) << 88) + 0x13B;

  void add_byte(unsigned char byte) { sum_ = (sum_ ^ byte) * kPrime; }

  Wide sum_ = (Wide(0x6C62272E07BB0142) << 64) + 0x62B821756295C58D;
};

void add(Digest& digest, const FileStamp& stamp) {
  digest.add(stamp.path.native());
  digest.add(stamp.bytes);
  digest.add(static_cast<std::uint64_t>(stamp.changed.time_since_epoch().count()));
  digest.add(std::uint64_t(stamp.exists ? 1 : 0));
}

// Added by value: the JSON text of thousands of waypoints takes tens of milliseconds. The binding names every member,
// so that one that is added to the settings is not forgotten here.
void add(Digest& digest, const std::vector<WaypointSettings>& waypoints) {
  digest.add(std::uint64_t(waypoints.size()));
  for (const auto& [frame, position_m, heading_deg, place, unknown_json] : waypoints) {
    static_cast<void>(place);  // position_m follows it
    static_cast<void>(unknown_json);
    digest.add(std::uint64_t(frame ? 1 : 0));
    digest.add(frame.value_or(0));
    digest.add(std::uint64_t(heading_deg ? 1 : 0));
    digest.add(heading_deg.value_or(0));
    for (int axis = 0; axis < 3; ++axis) digest.add(position_m[axis]);
  }
}

// Calls for each path that names a file to read, but those of models.
template <class ProjectOrConst, class Call>
void for_each_input(ProjectOrConst& project, const Call& call) {
  const auto call_for = [&call](auto& footage) {
    call(footage.video);
    call(footage.timestamps);
    call(footage.calibration);
    call(footage.own_body_mask);
    call(footage.occluder_mask);
    call(footage.real_aircraft);
  };
  call_for(project.footage);
  for (auto& camera : project.cameras) call_for(camera.footage);
  if (project.rig_view) {
    call(project.rig_view->reference.video);
    call(project.rig_view->reference.timestamps);
  }
  call(project.camera.attitude_file);
  call(project.camera.track.file);
}

// Of the first camera of a rig: by it waypoints have their times. Its own camera's mount and clock are in the text.
void add_reference(Digest& digest, const RigView& view) {
  digest.add(std::uint64_t(view.camera == 0 ? 1 : 0));
  const FootageSettings& first = view.reference;
  digest.add(first.frame_rate_hz.value_or(0));
  digest.add(std::uint64_t(first.first_frame));
  digest.add(std::uint64_t(first.last_frame.value_or(-1)));
  const MountSettings& mount = view.reference_mount;
  for (int axis = 0; axis < 3; ++axis) digest.add(mount.position_m[axis]);
  for (const double angle_deg : {mount.roll_deg, mount.pitch_deg, mount.yaw_deg}) digest.add(angle_deg);
}

}  // namespace

ContentId id_of(const FileStamp& stamp) {
  Digest digest;
  add(digest, stamp);
  return digest.id();
}

ContentId content_id_of(const Project& project) {
  Project kept = project;
  Digest digest;
  kept.file.clear();
  kept.name.clear();
  kept.own_body = {};  // only the mask that came of it counts
  kept.output = {};
  kept.unknown_json.clear();
  for_each_input(kept, [&](std::string& path) {
    path = whole_path(project, path);
    digest.add(path);
  });
  for (IntruderSettings& intruder : kept.intruders) {
    intruder.model.file = whole_path(project, intruder.model.file);
    digest.add(intruder.model.file);
    intruder.unknown_json.clear();
    // The text below has other bytes in place of what is no UTF-8.
    digest.add(intruder.name + '\n' + intruder.category);
    add(digest, intruder.trajectory.waypoints);
    intruder.trajectory.waypoints.clear();
  }
  if (kept.rig_view) add_reference(digest, *kept.rig_view);
  digest.add(text_of(kept));
  return digest.id();
}

ContentId input_files_id_of(const Project& project, ModelStamps& models) {
  Digest digest;
  // Of one camera of a rig (rig.yaml#cam1) the file.
  for_each_input(project, [&](const std::string& path) {
    add(digest, stamp_of(calibration_name(whole_path(project, path)).file));
  });
  add(digest, footage_stamp_of(project));
  for (const IntruderSettings& intruder : project.intruders)
    for (const FileStamp& stamp : models.of(whole_path(project, intruder.model.file))) add(digest, stamp);
  return digest.id();
}

ContentId combined_id(const ContentId& content, const ContentId& input_files) {
  Digest digest;
  digest.add(content);
  digest.add(input_files);
  return digest.id();
}

}  // namespace sigs::editor
