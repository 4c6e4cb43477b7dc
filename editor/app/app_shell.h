// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "editor/app/project_session.h"
#include "editor/preview/export_job.h"
#include "editor/views/context.h"
#include "editor/views/dialogs.h"
#include "editor/views/export_view.h"
#include "editor/views/relink_dialog.h"
#include "editor/views/start_page.h"
#include "editor/views/toasts.h"
#include "editor/widgets/file_browser.h"

namespace sigs::editor {

// All that concerns files and the program itself, drawn: menu bar, start page, dialogs, messages, export. The file desk
// decides, this shows and asks.
class AppShell {
 public:
  struct Setup {
    std::filesystem::path samples;  // folder of sample projects
    std::filesystem::path recovery_folder;
    std::string version;
    std::vector<HelpLine> help;
    std::function<void()> wake;  // from any thread: something is to be drawn
    ProjectSession::UnsavedMask mask;
  };
  // Document and settings must outlive it.
  AppShell(Document& document, Settings& settings, Setup setup);

  // Before everything else of an update is drawn; the bar takes its room at the window's upper edge.
  void draw_menu(const ViewContext& context);
  // Instead of the panels while has_project() is false; fills the present ImGui window.
  void draw_start_page(const ViewContext& context);
  // After everything else, outside of every ImGui window.
  void draw_over_all(const ViewContext& context);

  // After drawing. False: the request is another's.
  bool handle(const Request& request);
  void handle_dropped(const std::filesystem::path& path, Edits& edits) { session_.handle_dropped(path, edits); }
  // Once per update, when the document has taken its edits: it may become another one here.
  void update(double now_s);

  [[nodiscard]] std::optional<RecoveredMask> take_recovered_mask() { return session_.take_recovered_mask(); }
  [[nodiscard]] bool has_project() const { return session_.has_project(); }
  [[nodiscard]] bool is_exporting() const { return export_.is_running(); }
  [[nodiscard]] bool is_done() const { return session_.is_done(); }
  // Whether something on the screen changes without an event: draw some ten times a second.
  [[nodiscard]] bool needs_redraw() const;

 private:
  void ask_for_files();
  void handle_own_requests();
  void report_export();
  void draw_dialog(const ViewContext& context);

  Document& document_;
  Settings& settings_;
  Setup setup_;
  ExportJob export_;
  ProjectSession session_;
  StartPage start_page_;
  Toasts toasts_;
  FileBrowser browser_;
  std::deque<AskForFile> files_wanted_;
  std::function<void(const std::filesystem::path&)> chosen_;  // for what the browser asks
  ExportView export_view_;
  RelinkDialog relink_;
  SettingsDialog settings_dialog_;
  bool shows_settings_ = false;
  bool shows_help_ = false;
  bool shows_about_ = false;
  std::vector<std::function<void()>> answered_;  // while drawing; done in update()
  std::filesystem::path project_file_;           // of the last update
  bool was_exporting_ = false;
  double now_s_ = 0;
};

}  // namespace sigs::editor
