// SPDX-License-Identifier: MIT
#include "dataset/footage_book.h"

#include <map>

#include "export.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

// An error about a file, with the key of the recipe that names it in front.
tl::unexpected<Error> fail_at(const std::string& where, Error error) {
  return fail(where, error.text(), error.kind);
}

class Book {
 public:
  explicit Book(const Recipe& recipe) : recipe_(recipe) {}

  [[nodiscard]] Result<OpenedBackground> opened(std::size_t i) {
    const FootageSettings& settings = recipe_.backgrounds[i].footage;
    const std::string where = recipe_.file.string() + ": backgrounds[" + std::to_string(i) + "].footage.";
    const Result<FootageShape> shape = shape_of_file(settings.video);
    if (!shape) return fail_at(where + "video", shape.error());
    Result<Camera> lens = read_calibration(settings.calibration, shape->size_px);
    if (!lens) return fail_at(where + "calibration", lens.error());
    const int last = static_cast<int>(shape->times_s.size()) - 1;
    const FrameRange frames{settings.first_frame, settings.last_frame.value_or(last)};
    if (frames.last > last || frames.first > frames.last)
      return fail(where + (frames.last > last ? "last_frame" : "first_frame"),
                  "the footage has frames 0 to " + std::to_string(last));
    return OpenedBackground{*shape, *std::move(lens), frames};
  }

 private:
  Result<FootageShape> shape_of_file(const std::string& path) {
    if (const auto known = shapes_.find(path); known != shapes_.end()) return known->second;
    const Result<FrameSource> source = FrameSource::open(path);
    if (!source) return fail(source.error());
    return shapes_.emplace(path, shape_of(source->info())).first->second;
  }

  const Recipe& recipe_;
  std::map<std::string, FootageShape> shapes_;
};

}  // namespace

Result<std::vector<OpenedBackground>> opened_backgrounds(const Recipe& recipe) {
  Book book(recipe);
  std::vector<OpenedBackground> backgrounds;
  for (std::size_t i = 0; i < recipe.backgrounds.size(); ++i) {
    Result<OpenedBackground> opened = book.opened(i);
    if (!opened) return fail(opened.error());
    backgrounds.push_back(*std::move(opened));
  }
  return backgrounds;
}

}  // namespace sigs
