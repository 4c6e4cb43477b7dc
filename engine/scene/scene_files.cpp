// SPDX-License-Identifier: MIT
#include "scene/scene_files.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "scene/measuring_points.h"
#include "scene/own_body_mask.h"
#include "scene/placeholders.h"

namespace sigs {

namespace {

// How many things of a kind are kept that no scene holds any more. A size that is dragged makes a model at every step.
constexpr std::size_t kKeptOfAKind = 8;

// What tells one state of a file from another without reading it.
struct Stamp {
  std::uintmax_t size = std::numeric_limits<std::uintmax_t>::max();  // such: there is none
  std::filesystem::file_time_type changed{};

  [[nodiscard]] bool operator==(const Stamp&) const = default;
};

Stamp stamp_of(const std::filesystem::path& file) {
  std::error_code code;
  Stamp stamp;
  stamp.size = std::filesystem::file_size(file, code);
  stamp.changed = std::filesystem::last_write_time(file, code);
  return stamp;
}

bool is_held(const std::shared_ptr<const Model>& model) {
  return model.use_count() > 1;
}
bool is_held(const Camera&) {
  return false;
}
bool is_held(const cv::Mat&) {
  return false;
}
bool is_held(const std::vector<AttitudeAtFrame>&) {
  return false;
}

// Things by key, each with the state of its file when it was read; the longest unused ones are let go of.
template <class Key, class T>
class FileCache {
 public:
  template <class Read>
  Result<T> take(const Key& key, const Stamp& stamp, const Read& read) {
    ++clock_;
    if (const auto known = things_.find(key); known != things_.end() && known->second.stamp == stamp) {
      known->second.used = clock_;
      return known->second.thing;
    }
    Result<T> thing = read();
    things_.erase(key);
    // What could not be opened may be opened at the next try: permissions leave no trace in the stamp.
    if (thing || thing.error().kind != ErrorKind::cannot_read) things_.emplace(key, Entry{stamp, thing, clock_});
    let_go();
    return thing;
  }

 private:
  struct Entry {
    Stamp stamp;
    Result<T> thing;
    std::uint64_t used = 0;
  };

  void let_go() {
    std::map<std::uint64_t, Key> idle;  // longest unused first
    for (const auto& [key, entry] : things_)
      if (entry.used != clock_ && !(entry.thing && is_held(*entry.thing))) idle.emplace(entry.used, key);
    while (idle.size() > kKeptOfAKind) {
      things_.erase(idle.begin()->second);
      idle.erase(idle.begin());
    }
  }

  std::map<Key, Entry> things_;
  std::uint64_t clock_ = 0;
};

// Numbers by their bits: NaN too then has its place.
using ModelKey = std::tuple<std::string, std::string, std::string, std::uint64_t, std::uint64_t, bool>;
using ImageKey = std::tuple<std::string, int, int>;
using CameraKey = std::tuple<std::string, int, int, std::optional<LensModel>>;

std::string name_of(const std::filesystem::path& file) {
  return file.lexically_normal().string();
}

ModelKey key_of(const std::filesystem::path& file, const ModelAxes& axes) {
  return {name_of(file),
          axes.forward,
          axes.up,
          std::bit_cast<std::uint64_t>(axes.scale),
          std::bit_cast<std::uint64_t>(axes.length_m),
          axes.anchor_at_bounds};
}

ImageKey key_of(const std::filesystem::path& file, cv::Size size_px) {
  return {name_of(file), size_px.width, size_px.height};
}

Result<std::shared_ptr<const Model>> read_model(const std::filesystem::path& file, const ModelAxes& axes) {
  Result<Mesh> mesh = read_obj(file, axes);
  if (!mesh) return fail(mesh.error());
  return std::make_shared<const Model>(model_of(*std::move(mesh)));
}

}  // namespace

struct SceneFiles::Caches {
  FileCache<ModelKey, std::shared_ptr<const Model>> models;
  FileCache<CameraKey, Camera> cameras;
  FileCache<ImageKey, cv::Mat> masks;
  FileCache<std::string, std::vector<AttitudeAtFrame>> attitudes;
  FileCache<std::uint64_t, std::shared_ptr<const Model>> crosses;
};

SceneFiles::SceneFiles() : caches_(std::make_unique<Caches>()) {}
SceneFiles::SceneFiles(SceneFiles&&) noexcept = default;
SceneFiles& SceneFiles::operator=(SceneFiles&&) noexcept = default;
SceneFiles::~SceneFiles() = default;

Result<std::shared_ptr<const Model>> SceneFiles::model(const std::filesystem::path& file, const ModelAxes& axes) {
  return caches_->models.take(key_of(file, axes), stamp_of(file), [&] { return read_model(file, axes); });
}

Result<Camera> SceneFiles::camera(const std::filesystem::path& calibration, cv::Size footage_size_px,
                                  std::optional<LensModel> model) {
  const CameraKey key{name_of(calibration), footage_size_px.width, footage_size_px.height, model};
  return caches_->cameras.take(key, stamp_of(calibration),
                               [&] { return read_calibration(calibration, footage_size_px, model); });
}

Result<std::vector<AttitudeAtFrame>> SceneFiles::attitudes(const std::filesystem::path& file) {
  return caches_->attitudes.take(name_of(file), stamp_of(file), [&] { return read_attitude_file(file); });
}

Result<cv::Mat> SceneFiles::own_body_mask(const std::filesystem::path& file, cv::Size footage_size_px) {
  return caches_->masks.take(key_of(file, footage_size_px), stamp_of(file),
                             [&] { return read_own_body_mask(file, footage_size_px); });
}

std::shared_ptr<const Model> SceneFiles::cross(double length_m) {
  const auto make = [&]() -> Result<std::shared_ptr<const Model>> {
    return std::make_shared<const Model>(model_of(cross_mesh(length_m)));
  };
  return *caches_->crosses.take(std::bit_cast<std::uint64_t>(length_m), Stamp{}, make);
}

}  // namespace sigs
