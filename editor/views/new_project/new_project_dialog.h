// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "editor/preview/jobs.h"
#include "editor/views/context.h"
#include "editor/views/models/change_model.h"
#include "editor/views/new_project/new_project_form.h"

namespace sigs::editor {

// What the person wants of the dialog in one update.
struct NewProjectChoice {
  bool empty = false;                         // a project without footage, to be filled by hand
  std::optional<FirstProjectOptions> create;  // a project of this video
  bool cancel = false;                        // what is being made is not wanted any more
};

// The dialog "New project": video, lens, aircraft and the project file to be written; then the progress. It decides
// nothing: who owns it makes the project, and closes it when that is there.
class NewProjectDialog {
 public:
  //   gallery  models to choose from; must outlive it
  //   wake     called from another thread when something is known of a video
  NewProjectDialog(ModelGallery& gallery, std::function<void()> wake);

  // Shows the dialog in the next update, with empty rows.
  //   video      to begin with; "": none
  //   elsewhere  where a project goes whose video lies where nothing can be written
  void open(const std::filesystem::path& video, std::filesystem::path elsewhere);
  void close() { open_ = false; }
  [[nodiscard]] bool is_open() const { return open_; }

  // What was wanted is being made: how it ends is told, however soon that is.
  void tell_end() { tells_end_ = true; }

  // A file that was dropped onto the window while it is open.
  void take_dropped(const std::filesystem::path& file);

  // Once per update while it is open.
  //   making  the project is being made, or that has ended with an error
  [[nodiscard]] NewProjectChoice draw(const ViewContext& context, const FirstProjectState& making);

 private:
  // Each draws a row of the form.
  void draw_video(const ViewContext& context);
  void draw_video_facts(const ViewContext& context);
  void draw_lens(const ViewContext& context);
  void draw_field_of_view(const ViewContext& context);
  void draw_calibration(const ViewContext& context);
  void draw_model(const ViewContext& context);
  void draw_look(const ViewContext& context);
  void draw_file(const ViewContext& context);
  // What is wrong with a row, below it; false: nothing is.
  bool draw_problem(const ViewContext& context, FormRow row) const;
  void draw_rows(const ViewContext& context, const FirstProjectState& making);
  void draw_buttons(const ViewContext& context, NewProjectChoice& choice);
  void draw_progress(const ViewContext& context, const FirstProjectState& state, NewProjectChoice& choice);
  // A line of text with a button that asks for a file; whether the text was changed.
  [[nodiscard]] bool draw_path(const ViewContext& context, const char* name, std::string& text, AskForFile wanted);
  // The form was changed: what was said of it counts no more.
  void changed();
  void choose(LensChoice lens);
  // The person wants the project: where the form is right, and what would be replaced was agreed to.
  void try_to_create(NewProjectChoice& choice);
  // Asks for the facts of the video that is in the form.
  void look_at_video();

  ModelGallery& gallery_;
  std::filesystem::path elsewhere_;
  NewProjectForm form_;
  BackgroundJob<std::filesystem::path, VideoFacts> facts_;
  std::optional<FormProblem> problem_;
  std::string note_;  // what went wrong outside of the form's rows; "": nothing
  // The file that the person was asked about whether it may be replaced; "": none.
  std::filesystem::path asked_about_;
  bool open_ = false;
  bool closed_ = false;
  bool focus_video_ = false;  // the first row gets the keyboard in this update
  bool tells_end_ = false;    // how the making ends has to be told
};

}  // namespace sigs::editor
