// SPDX-License-Identifier: MIT
#include "scene/scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/ensure.h"
#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "mesh/model_files.h"
#include "scene/opened_project.h"
#include "telemetry/track.h"

namespace sigs {

namespace {

constexpr std::array<std::string_view, 4> kColumns{"frame", "roll_deg", "pitch_deg", "yaw_deg"};
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kMaxFrame = 1e9;
constexpr double kMaxAngle_deg = 360;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    cells.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(comma + 1);
  }
  cells.push_back(trimmed(line));
  return cells;
}

bool is_header(std::string_view line) {
  const std::vector<std::string_view> cells = cells_of(line);
  return std::equal(cells.begin(), cells.end(), kColumns.begin(), kColumns.end());
}

Result<AttitudeAtFrame> attitude_in(std::string_view line, const std::string& where) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() != kColumns.size())
    return fail(where, fmt::format("expected 4 numbers between commas, found {}", cells.size()));
  std::array<double, kColumns.size()> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<double> number = finite_number(cells[i]);
    const std::string cell = fmt::format("{}: {}", where, kColumns[i]);
    if (!number) return fail(cell, "is not a number such as -0.25");
    if (i == 0 && std::abs(*number) > kMaxFrame) return fail(cell, "must lie between -1e9 and 1e9");
    if (i > 0 && std::abs(*number) > kMaxAngle_deg) return fail(cell, "must lie between -360 and 360 degrees");
    numbers[i] = *number;
  }
  return AttitudeAtFrame{numbers[0], {rad_of_deg(numbers[1]), rad_of_deg(numbers[2]), rad_of_deg(numbers[3])}};
}

constexpr double kMaxBoxFrame = 1e7;
constexpr double kMaxPixel = 1e6;

// What a line of boxes says, or what is wrong with it.
Result<RealAircraftBox> box_in(std::string_view line, const std::string& where) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() < 6) return fail(where, fmt::format("expected frame,label,x,y,w,h, found {} fields", cells.size()));
  std::array<double, 6> numbers{};
  for (const std::size_t i : {0U, 2U, 3U, 4U, 5U}) {
    const std::optional<double> number = finite_number(cells[i]);
    if (!number || std::abs(*number) > (i == 0 ? kMaxBoxFrame : kMaxPixel))
      return fail(where, fmt::format("field {} is no number in its range", i + 1));
    numbers[i] = *number;
  }
  if (numbers[0] < 0 || numbers[0] != std::floor(numbers[0])) return fail(where, "the frame is no whole number from 0");
  // From the centre of the first pixel at (1, 1) to its edge at (-0.5, -0.5).
  return RealAircraftBox{.frame = static_cast<int>(numbers[0]),
                         .label = std::string(cells[1]),
                         .box = {numbers[2] - 1.5, numbers[3] - 1.5, numbers[4], numbers[5]},
                         .line = std::string(line)};
}

cv::Mat gray_of(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat gray;
  cv::cvtColor(image, gray, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

// Number of entries of each kind that are kept though no scene uses them. Dragging a size makes a model at every step.
constexpr std::size_t kMaxUnused = 8;

// Whether a value is held outside the cache, which shared ownership shows.
template <class T>
bool is_used(const T&) {
  return false;
}
template <class T>
bool is_used(const std::shared_ptr<const T>& shared) {
  return shared.use_count() > 1;
}

}  // namespace

// Values by key, each with the state of its file, or of its files, when it was read. Those unused for longest are
// dropped.
template <class Key, class T, class Stamp = FileStamp>
class FileCache {
 public:
  template <class Read>
  Result<T> take(const Key& key, const Stamp& stamp, const Read& read) {
    ++clock_;
    if (const auto known = entries_.find(key); known != entries_.end() && known->second.stamp == stamp) {
      known->second.last_used = clock_;
      return known->second.value;
    }
    Result<T> value = read();
    entries_.erase(key);
    // A file that cannot be read is tried again each time: a change of permissions does not show in the stamp.
    if (value || value.error().kind != ErrorKind::cannot_read) entries_.emplace(key, Entry{stamp, value, clock_});
    drop_unused();
    return value;
  }

 private:
  struct Entry {
    Stamp stamp;
    Result<T> value;
    std::uint64_t last_used = 0;
  };

  void drop_unused() {
    std::map<std::uint64_t, Key> unused;  // unused for longest first
    for (const auto& [key, entry] : entries_)
      if (entry.last_used != clock_ && !(entry.value && is_used(*entry.value))) unused.emplace(entry.last_used, key);
    while (unused.size() > kMaxUnused) {
      entries_.erase(unused.begin()->second);
      unused.erase(unused.begin());
    }
  }

  std::map<Key, Entry> entries_;
  std::uint64_t clock_ = 0;
};

namespace {

// Numbers by their bits, so that NaN has a place in the order too.
using ModelKey = std::tuple<std::string, std::string, std::string, std::uint64_t, std::uint64_t, bool, std::string,
                            std::optional<HeatLevels>>;
using ImageKey = std::tuple<std::string, int, int>;
using CameraKey = std::tuple<std::string, std::array<int, 6>, std::optional<LensModel>>;

std::string name_of(const std::filesystem::path& file) {
  return file.lexically_normal().string();
}

// All that is said of them, to the last bit.
std::string key_of(const ModelSurfaces& surfaces) {
  std::string key = fmt::format("{:a}", surfaces.gloss);
  for (const StatedRotor& rotor : surfaces.rotors) {
    key += fmt::format(";{}/{} {}", rotor.part.size(), rotor.part, rotor.blade_count);
    for (const double number :
         {rotor.rpm.value_or(std::numeric_limits<double>::infinity()), rotor.chord_m, rotor.phase_rad, rotor.coning_rad,
          rotor.radius_m, rotor.axis.x, rotor.axis.y, rotor.axis.z, rotor.hub_m.x, rotor.hub_m.y, rotor.hub_m.z})
      key += fmt::format(" {:a}", number);
  }
  return key;
}

ModelKey key_of(const std::filesystem::path& file, const ModelAxes& axes, const ModelSurfaces& surfaces,
                const std::optional<HeatLevels>& heat) {
  return {name_of(file),
          axes.forward,
          axes.up,
          std::bit_cast<std::uint64_t>(axes.scale),
          std::bit_cast<std::uint64_t>(axes.length_m),
          axes.anchor_at_bounds,
          key_of(surfaces),
          heat};
}

ImageKey key_of(const std::filesystem::path& file, cv::Size size_px) {
  return {name_of(file), size_px.width, size_px.height};
}

Result<std::shared_ptr<const Model>> read_model(const std::filesystem::path& file, const ModelAxes& axes,
                                                const ModelSurfaces& surfaces, const std::optional<HeatLevels>& heat) {
  Result<Mesh> mesh = read_obj(file, axes, surfaces);
  if (!mesh) return fail(mesh.error());
  if (heat) heat_surfaces(*mesh, *heat);
  return std::make_shared<const Model>(model_of(*std::move(mesh)));
}

}  // namespace

Result<std::vector<AttitudeAtFrame>> read_attitude_file(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  std::string_view rest = *text;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  if (!is_header(next_line(rest)))
    return fail(path.string() + ": line 1", "expected the header frame,roll_deg,pitch_deg,yaw_deg");
  std::vector<AttitudeAtFrame> attitudes;
  for (int line_number = 2; !rest.empty(); ++line_number) {
    const std::string_view line = next_line(rest);
    if (trimmed(line).empty()) continue;
    const std::string where = fmt::format("{}: line {}", path.string(), line_number);
    const Result<AttitudeAtFrame> attitude = attitude_in(line, where);
    if (!attitude) return fail(attitude.error());
    if (!attitudes.empty() && attitude->frame <= attitudes.back().frame)
      return fail(where + ": frame", "is not after the frame of the line before; frames must rise");
    attitudes.push_back(*attitude);
  }
  if (attitudes.empty()) return fail(path.string(), "has no line below its header; expected one for each frame");
  return attitudes;
}

Result<RealAircraftFile> read_real_aircraft(const std::filesystem::path& csv) {
  const Result<std::string> text = read_text(csv);
  if (!text) return fail(text.error());
  std::string_view rest = *text;
  RealAircraftFile file{.header = std::string(trimmed(next_line(rest))), .boxes = {}};
  for (int line_number = 2; !rest.empty(); ++line_number) {
    const std::string_view line = trimmed(next_line(rest));
    if (line.empty()) continue;
    Result<RealAircraftBox> box = box_in(line, fmt::format("{}: line {}", csv.string(), line_number));
    if (!box) return fail(box.error());
    file.boxes.push_back(*std::move(box));
  }
  return file;
}

RealAircraftBox real_aircraft_box(int frame, std::string label, const Box& box) {
  std::string line = fmt::format("{},{},{},{},{},{}", frame, label, fixed_text(box.x + 1.5, 4),
                                 fixed_text(box.y + 1.5, 4), fixed_text(box.width, 4), fixed_text(box.height, 4));
  Result<RealAircraftBox> read = box_in(line, line);
  ENSURE(read && read->label == label);
  return *std::move(read);
}

Result<BoxesByFrame> read_boxes_by_frame(const std::filesystem::path& csv) {
  const Result<RealAircraftFile> file = read_real_aircraft(csv);
  if (!file) return fail(file.error());
  BoxesByFrame boxes;
  for (const auto& [frame, label, box, line] : file->boxes)
    if (box.width > 0 && box.height > 0) boxes[frame].push_back(box);
  const bool says_none = file->boxes.empty() && file->header == kRealAircraftHeader;
  if (boxes.empty() && !says_none) return fail(csv.string(), "has no box");
  return boxes;
}

Result<cv::Mat> read_own_body_mask(const std::filesystem::path& path, cv::Size footage_size_px) {
  if (const Result<void> file = check_input_file(path, "image"); !file) return fail(file.error());
  const auto check_size = [&](cv::Size size_px) -> Result<void> {
    if (size_px == footage_size_px) return {};
    return fail(path.string(), fmt::format("is {}, the footage is {}; they must agree", image_size_text(size_px),
                                           image_size_text(footage_size_px)));
  };
  const std::optional<cv::Size> stated_px = image_size_px(path);  // before anything is decoded
  if (const Result<void> fits = check_size(stated_px.value_or(footage_size_px)); !fits) return fail(fits.error());
  const Result<cv::Mat> read = read_image_file(path, cv::IMREAD_UNCHANGED);
  if (!read) return fail(read.error());
  const cv::Mat& image = *read;
  if (const Result<void> fits = check_size(image.size()); !fits) return fail(fits.error());
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    return fail(path.string(), "has neither 8 nor 16 bits a sample");
  cv::Mat mask;
  gray_of(image).convertTo(mask, CV_32F, image.depth() == CV_8U ? 1.0 / 255.0 : 1.0 / 65535.0);
  return mask;
}

struct SceneFiles::Caches {
  std::mutex mutex;  // of all of them
  ModelStamps model_stamps;
  FileCache<ModelKey, std::shared_ptr<const Model>, std::vector<FileStamp>> models;
  FileCache<CameraKey, Camera> cameras;
  FileCache<ImageKey, cv::Mat> masks;
  FileCache<FootageKey, FootageShape> footage;
  FileCache<std::string, std::vector<AttitudeAtFrame>> attitudes;
  FileCache<std::string, BoxesByFrame> boxes;
  FileCache<std::string, std::shared_ptr<const Track>> tracks;
  FileCache<std::uint64_t, std::shared_ptr<const Model>> crosses;
};

SceneFiles::SceneFiles() : caches_(std::make_unique<Caches>()) {}
SceneFiles::SceneFiles(SceneFiles&&) noexcept = default;
SceneFiles& SceneFiles::operator=(SceneFiles&&) noexcept = default;
SceneFiles::~SceneFiles() = default;

Result<std::shared_ptr<const Model>> SceneFiles::model(const std::filesystem::path& file, const ModelAxes& axes,
                                                       const ModelSurfaces& surfaces,
                                                       const std::optional<HeatLevels>& heat) {
  const std::lock_guard lock(caches_->mutex);
  return caches_->models.take(key_of(file, axes, surfaces, heat), caches_->model_stamps.of(name_of(file)),
                              [&] { return read_model(file, axes, surfaces, heat); });
}

Result<Camera> SceneFiles::camera(const std::filesystem::path& calibration, const FootageShape& footage,
                                  std::optional<LensModel> model) {
  const cv::Size size = footage.size_px;
  const ImagePart part = footage.part.value_or(ImagePart{size, {0, 0}});
  const std::array<int, 6> pixels{size.width,           size.height,      part.whole_px.width,
                                  part.whole_px.height, part.corner_px.x, part.corner_px.y};
  const CameraKey key{name_of(calibration), pixels, model};
  const std::lock_guard lock(caches_->mutex);
  return caches_->cameras.take(key, stamp_of(name_of(calibration_name(calibration).file)),
                               [&] { return read_calibration(calibration, size, model, footage.part); });
}

Result<FootageShape> SceneFiles::footage_shape(const Project& project) {
  const auto read = [&]() -> Result<FootageShape> {
    const Result<FrameSource> source = open_footage(project);
    if (!source) return fail(source.error());
    return shape_of(source->info());
  };
  const std::lock_guard lock(caches_->mutex);
  return caches_->footage.take(footage_key(project), footage_stamp_of(project), read);
}

Result<std::vector<AttitudeAtFrame>> SceneFiles::attitudes(const std::filesystem::path& file) {
  const std::lock_guard lock(caches_->mutex);
  return caches_->attitudes.take(name_of(file), stamp_of(name_of(file)), [&] { return read_attitude_file(file); });
}

Result<BoxesByFrame> SceneFiles::boxes(const std::filesystem::path& csv) {
  const std::lock_guard lock(caches_->mutex);
  return caches_->boxes.take(name_of(csv), stamp_of(name_of(csv)), [&] { return read_boxes_by_frame(csv); });
}

Result<std::shared_ptr<const Track>> SceneFiles::track(const std::filesystem::path& file) {
  const auto read = [&]() -> Result<std::shared_ptr<const Track>> {
    Result<Track> track = read_track(file);
    if (!track) return fail(track.error());
    return std::make_shared<const Track>(*std::move(track));
  };
  const std::lock_guard lock(caches_->mutex);
  return caches_->tracks.take(name_of(file), stamp_of(name_of(file)), read);
}

Result<cv::Mat> SceneFiles::own_body_mask(const std::filesystem::path& file, cv::Size footage_size_px) {
  const std::lock_guard lock(caches_->mutex);
  return caches_->masks.take(key_of(file, footage_size_px), stamp_of(name_of(file)),
                             [&] { return read_own_body_mask(file, footage_size_px); });
}

std::shared_ptr<const Model> SceneFiles::cross(double length_m) {
  const auto make = [&]() -> Result<std::shared_ptr<const Model>> {
    return std::make_shared<const Model>(model_of(cross_mesh(length_m)));
  };
  const std::lock_guard lock(caches_->mutex);
  return *caches_->crosses.take(std::bit_cast<std::uint64_t>(length_m), FileStamp{}, make);
}

}  // namespace sigs
