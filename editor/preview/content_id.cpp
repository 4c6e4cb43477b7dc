// SPDX-License-Identifier: MIT
#include "editor/preview/content_id.h"

#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "project/json.h"

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

// FNV-1a with 128 bits (RFC 9923): no two names of a session meet by chance, and nobody gains by making them.
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
    add(text.size());
  }
  void add(std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) add_byte(static_cast<unsigned char>(number >> (8 * byte)));
  }
  [[nodiscard]] ContentId name() const {
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
  digest.add(stamp.exists ? 1 : 0);
}

}  // namespace

FileStamp stamp_of(const fs::path& path) {
  FileStamp stamp{.path = path};
  if (path.empty()) return stamp;
  std::error_code code;
  stamp.bytes = fs::file_size(path, code);
  if (code) stamp.bytes = 0;
  stamp.changed = fs::last_write_time(path, code);
  stamp.exists = !code;
  if (code) stamp.changed = {};
  return stamp;
}

ContentId content_id_of(const Project& project) {
  Project kept = project;
  Digest digest;
  kept.file.clear();
  kept.name.clear();
  kept.own_body = {};  // only the mask that came of it counts
  kept.output = {};
  kept.unknown_json.clear();
  std::vector<std::string*> paths{&kept.footage.video, &kept.footage.calibration, &kept.footage.own_body_mask,
                                  &kept.camera.attitude_file};
  for (IntruderSettings& intruder : kept.intruders) {
    intruder.unknown_json.clear();
    for (WaypointSettings& waypoint : intruder.trajectory.waypoints) waypoint.unknown_json.clear();
    paths.push_back(&intruder.model.file);
  }
  for (std::string* path : paths) {
    *path = whole_path(project, *path);
    add(digest, stamp_of(*path));
  }
  // The text has other bytes in place of what is no UTF-8; paths count above.
  for (const IntruderSettings& intruder : kept.intruders) digest.add(intruder.name + '\n' + intruder.category);
  digest.add(text_of(kept));
  return digest.name();
}

FileStamp footage_stamp_of(const Project& project) {
  return stamp_of(whole_path(project, project.footage.video));
}

}  // namespace sigs::editor
