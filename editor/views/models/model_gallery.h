// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/thumbnails.h"
#include "editor/views/context.h"
#include "editor/views/new_project/new_project_form.h"

namespace sigs::editor {

// The models that an intruder can have, as images: the samples, and at the end an OBJ file of the user. The dialogs
// "New project" and "Change model" show the same one. For the window's thread.
class ModelGallery {
 public:
  //   samples  folder of the sample models; it need not be there
  //   wake     called from another thread when an image is ready
  ModelGallery(const std::filesystem::path& samples, std::function<void()> wake);

  [[nodiscard]] const std::vector<SampleModel>& samples() const { return samples_; }

  // What was pressed in an update. sample: index; none: the tile of the user's own file.
  struct Pressed {
    std::optional<std::size_t> sample;
    bool twice = false;  // a double click: this one and go on
  };
  // Once per update, over the width that is left, in rows of tiles.
  //   place   what the names of the tiles begin with in the UI probe: "new project/aircraft"
  //   chosen  the sample that is marked; none: the tile of the user's own file is
  //   own     the user's own file, shown in the last tile; "": none yet
  [[nodiscard]] std::optional<Pressed> draw(const ViewContext& context, const std::string& place,
                                            std::optional<std::size_t> chosen, const std::filesystem::path& own);

 private:
  // True where the tile was pressed.
  [[nodiscard]] bool draw_tile(const ViewContext& context, const std::string& name, const std::filesystem::path& file,
                               bool is_chosen, float width);

  std::vector<SampleModel> samples_;
  Thumbnails images_;
};

}  // namespace sigs::editor
