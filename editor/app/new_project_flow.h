// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "editor/app/project_session.h"
#include "editor/document/document.h"
#include "editor/document/guesses.h"
#include "editor/document/settings.h"
#include "editor/preview/first_project_job.h"
#include "editor/views/new_project/new_project_dialog.h"

namespace sigs::editor {

// The way from the dialog "New project" to a project that is open: asks for unsaved work, makes the project in the
// background, opens it, and goes to a frame in which the intruder is in view. For the window's thread.
class NewProjectFlow {
 public:
  // Document, settings, session and gallery must outlive it.
  //   wake  may be called from any thread: something is to be drawn
  NewProjectFlow(Document& document, Settings& settings, ProjectSession& session, ModelGallery& gallery,
                 std::function<void()> wake);

  // Shows the dialog. video: to begin with; "": none.
  void open(const std::filesystem::path& video);
  [[nodiscard]] bool is_open() const { return dialog_.is_open(); }
  // A file that was dropped onto the window while the dialog is open.
  void take_dropped(const std::filesystem::path& file) { dialog_.take_dropped(file); }
  // Once per update while it is open.
  void draw(const ViewContext& context);

  // Once per update, after that of the session: carries out what was wanted while drawing, opens a project that is
  // made, and shows it once its footage is open.
  void update();

  // Once per update: what is known of the intruder by what is shown.
  void look(const ViewContext& context);

  // Messages since the last call.
  [[nodiscard]] std::vector<Request> take_requests() { return std::exchange(requests_, {}); }
  // What was guessed when the project that is open was made, in this session or earlier, and is unchanged.
  [[nodiscard]] const std::vector<Problem>& guesses() const { return guesses_.left(); }

 private:
  void begin_making(const FirstProjectOptions& options);
  // Opens the project that the job has made, once.
  void take_made();
  // From the project that is made to the one that is shown.
  void follow_made();
  // The project is open: tells what was guessed.
  void begin_project();
  // Its footage is open: goes to the middle, and from there to the intruder unless it is in view. True: there is
  // nothing left to do.
  [[nodiscard]] bool goes_to_intruder();

  Document& document_;
  Settings& settings_;
  ProjectSession& session_;
  NewProjectDialog dialog_;
  FirstProjectJob job_;
  Guesses guesses_;
  std::vector<Request> requests_;
  // First number of the document whose guesses were read.
  std::uint64_t guesses_of_ = 0;
  // Wanted while drawing, done in update().
  NewProjectChoice choice_;
  // Made, and given to the session.
  std::shared_ptr<const FirstProject> made_;
  // The same, until its intruder is shown. Null: nothing is awaited.
  std::shared_ptr<const FirstProject> awaited_;
  // Of the document that holds it; 0: it is not open yet.
  std::uint64_t document_number_ = 0;
  // The frame that was gone to first; none: not yet.
  std::optional<int> first_shown_;
  // Of the intruder; null: not there yet.
  std::shared_ptr<const Survey> survey_;
};

}  // namespace sigs::editor
