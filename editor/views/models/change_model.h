// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/views/context.h"
#include "editor/views/models/model_gallery.h"

namespace sigs::editor {

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
