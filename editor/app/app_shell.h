// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/app/project_session.h"
#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/background_job.h"
#include "editor/preview/jobs.h"
#include "editor/views/context.h"
#include "editor/views/dialogs.h"
#include "editor/views/export_view.h"
#include "editor/views/models/change_model.h"
#include "editor/views/new_project/new_project_dialog.h"
#include "editor/views/start_page.h"
#include "editor/widgets/file_browser.h"

namespace sigs::editor {

// The way from the dialog "New project" to a project that is open: asks for unsaved work, makes the project in the
// background, opens it, and goes to a frame in which the intruder is in view. For the window's thread.
class NewProjectFlow {
 public:
  // Document, settings, session and gallery must outlive it.
  //   wake  may be called from any thread: something is to be drawn
  NewProjectFlow(Document& document, Settings& settings, ProjectSession& session, ModelGallery& gallery,
                 std::function<void()> wake);

  void open(const std::filesystem::path& video);  // Shows the dialog. video: to begin with; "": none.
  [[nodiscard]] bool is_open() const { return dialog_.is_open(); }
  // A file that was dropped onto the window while the dialog is open.
  void take_dropped(const std::filesystem::path& file) { dialog_.take_dropped(file); }
  // Once per update while it is open.
  void draw(const ViewContext& context) { choice_ = dialog_.draw(context, job_.state()); }

  // Once per update, after that of the session: carries out what was wanted while drawing, opens a project that is
  // made, and shows it once its footage is open.
  void update();

  // Once per update: what is known of the intruder by what is shown.
  void look(const ViewContext& context) {
    survey_ = context.shown.surveys.empty() ? nullptr : context.shown.surveys.front();
  }

  // Messages since the last call.
  [[nodiscard]] std::vector<Request> take_requests() { return std::exchange(requests_, {}); }
  // What was guessed when the project that is open was made, in this session or earlier, and is unchanged.
  [[nodiscard]] const std::vector<Problem>& guesses() const { return guesses_.left(); }

 private:
  void take_made();      // opens the project that the job has made, once
  void follow_made();    // from the project that is made to the one that is shown
  void begin_project();  // the project is open: tells what was guessed
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
  std::uint64_t guesses_of_ = 0;                 // first number of the document whose guesses were read
  NewProjectChoice choice_;                      // wanted while drawing, done in update()
  std::shared_ptr<const FirstProject> made_;     // made, and given to the session
  std::shared_ptr<const FirstProject> awaited_;  // the same, until its intruder is shown
  std::uint64_t document_number_ = 0;            // of the document that holds it; 0: it is not open yet
  std::optional<int> first_shown_;               // the frame that was gone to first; none: not yet
  std::shared_ptr<const Survey> survey_;         // of the intruder; null: not there yet
};

// Draws everything that concerns files and the program itself: menu bar, start page, dialogs, messages, export. The
// ProjectSession decides; this class shows its questions and passes the answers on.
class AppShell {
 public:
  struct Setup {
    std::filesystem::path samples;          // folder of the sample projects; it need not be there
    std::filesystem::path models;           // folder of the sample models; likewise
    std::filesystem::path recovery_folder;  // where unsaved work is kept for the case of a crash
    std::string version;                    // of the program, for the About dialog
    std::vector<HelpLine> help;             // lines of the help page
    std::function<void()> wake;             // may be called from any thread: something is to be drawn
    ProjectSession::UnsavedMask mask;
  };
  // Document and settings must outlive it. All calls come from the window's thread.
  AppShell(Document& document, Settings& settings, Setup setup);

  // Draws the menu bar at the upper edge of the window; to be called first in an update.
  void draw_menu(const ViewContext& context);
  // Fills the current ImGui window with the start page; to be called in place of the panels while has_project() is
  // false.
  void draw_start_page(const ViewContext& context);
  // Draws the one dialog that is to be answered first, and messages above everything else; to be called last, outside
  // of every ImGui window.
  void draw_over_all(const ViewContext& context);

  // Handles a request that a view queued while it was drawn. False: the request concerns somebody else, and nothing
  // happened.
  bool handle(const Request& request);
  // Opens a file that was dropped onto the window, or puts it into the project or the dialog "New project". A video
  // that is dropped onto the start page begins that dialog.
  void handle_dropped(const std::filesystem::path& path, Edits& edits);
  // To be called once per update, after the document has applied its edits: carries out the answers given while
  // drawing. May replace the document by another one, whose revisions then begin at another first_number().
  void update(double now_s);

  // The unsaved mask of a project that was recovered; given once, none afterwards.
  [[nodiscard]] std::optional<RecoveredMask> take_recovered_mask() { return session_.take_recovered_mask(); }
  // What was guessed of the project that is open when it was made.
  [[nodiscard]] const std::vector<Problem>& guesses() const { return new_project_.guesses(); }
  [[nodiscard]] bool has_project() const { return session_.has_project(); }
  [[nodiscard]] bool is_exporting() const { return export_.is_running(); }
  // The program is to end.
  [[nodiscard]] bool is_done() const { return session_.is_done(); }
  // Whether something on the screen changes without an event, so that it has to be drawn ten times a second.
  [[nodiscard]] bool needs_redraw() const;

 private:
  // Opens the file browser for the next file that is wanted, once it is closed.
  void ask_for_files();
  void report_export();  // a message, where an export has ended while its window was closed
  void draw_dialog(const ViewContext& context);

  Document& document_;
  Settings& settings_;
  Setup setup_;
  ExportJob export_;
  ProjectSession session_;
  ModelGallery gallery_;
  NewProjectFlow new_project_;
  ChangeModelDialog change_model_;
  StartPage start_page_;
  Toasts toasts_;
  FileBrowser browser_;
  std::deque<AskForFile> files_wanted_;                       // waiting for the file browser, oldest first
  std::function<void(const std::filesystem::path&)> chosen_;  // for what the browser asks at the moment
  ExportView export_view_;
  RelinkDialog relink_;
  SettingsDialog settings_dialog_;
  bool shows_settings_ = false;
  bool shows_help_ = false;
  bool shows_about_ = false;
  // What was answered while drawing; done in update(), when the document may change.
  std::vector<std::function<void()>> answered_;
  std::filesystem::path project_file_;  // of the document in the last update
  bool was_exporting_ = false;
  double now_s_ = 0;
};

}  // namespace sigs::editor
