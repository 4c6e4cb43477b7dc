// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/background_job.h"
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

// Another model for an intruder of a project.
struct ModelChoice {
  Project project;
  int intruder = 0;
  std::filesystem::path model;  // OBJ
};

// What the choice amounts to, with the model's files copied beside the project (model_copied_into()).
struct ChosenModel {
  std::filesystem::path file;  // of the copy; the model itself where the project was never saved
  ModelSettings settings;      // `file` is not set
  std::string category;
  std::vector<std::string> guesses;  // of a user's model: its axes and its unit, in words
  std::vector<Warning> warnings;
};

// Reads and copies the model; a user's axes and unit are judged as `sigs init` does. Errors: those of read_obj() and of
// model_copied_into(); nothing is copied then.
[[nodiscard]] Result<ChosenModel> chosen_model(const ModelChoice& choice, const JobControl& control);

// Puts it into the project. The category follows the model, unless it was chosen by hand.
void use_model(Project& project, int intruder, const ChosenModel& chosen);

// The dialog "Change model": the gallery of "New project"; what is chosen is copied beside the project in the
// background, and used in one undo step.
class ChangeModelDialog {
 public:
  //   gallery  must outlive it
  //   wake     called from another thread when a model is copied
  ChangeModelDialog(ModelGallery& gallery, std::function<void()> wake);

  // Shows the dialog in the next update.
  void open(const Project& project, int intruder);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once per update while it is open.
  void draw(const ViewContext& context);

 private:
  void draw_choice(const ViewContext& context);
  void start(const ViewContext& context);
  void take_result(const ViewContext& context);

  ModelGallery& gallery_;
  BackgroundJob<ModelChoice, ChosenModel> job_;
  bool open_ = false;
  bool closed_ = false;
  bool is_awaited_ = false;  // the job's result is to be used
  int intruder_ = 0;
  std::optional<std::size_t> chosen_;
  std::filesystem::path own_;
  std::string problem_;
};

}  // namespace sigs::editor
