// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/widgets/folder_listing.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

enum class FileDialogMode { to_open, to_save, folder };

struct FileDialogRequest {
  std::string title;
  std::vector<std::string> extensions;  // ".json"; empty: all files
  FileDialogMode wanted = FileDialogMode::to_open;
  std::filesystem::path start;  // a folder, or a file: its name is proposed; "": where the last question ended
};

// A folder that is offered at the left.
struct BrowserPlace {
  std::string name;
  std::filesystem::path folder;
};

// Home, the present folder and the root.
[[nodiscard]] std::vector<BrowserPlace> usual_places();

// Asks for a file or a folder. Folders are read when they are entered, beside the window's thread.
class FileBrowser {
 public:
  void ask(FileDialogRequest question, std::vector<BrowserPlace> places);
  void close() { open_ = false; }
  [[nodiscard]] bool is_open() const { return open_; }

  // Once per update while it is open. The answer, absolute, in the update in which it is given. A file to save is only
  // overwritten after a question.
  [[nodiscard]] std::optional<std::filesystem::path> draw(UiProbe& ui_probe);

  // Where the person was last.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  void set_folder(std::filesystem::path folder) { folder_ = std::move(folder); }

 private:
  enum class Bottom { answer, overwrite, new_folder };

  void enter(const std::filesystem::path& folder);
  void go_up();
  void refresh();
  void take_listing();
  void select(int entry);
  void activate(int entry);
  void answer_with(const std::filesystem::path& path);
  void answer_by_name();
  void make_folder();
  void go_to_text(const std::string& text);
  void handle_keys();
  void handle_typed();

  void draw_path_bar();
  void draw_breadcrumbs();
  void draw_places(float width, float height);
  void draw_list(float height);
  void draw_row(int entry, bool with_size, bool with_time);
  void handle_sorting();
  void draw_bottom();
  void draw_answer();
  void draw_filter(float width);
  void draw_overwrite();
  void draw_new_folder();

  FileDialogRequest question_;
  UiProbe* ui_probe_ = nullptr;  // while drawing
  std::vector<BrowserPlace> places_;
  bool open_ = false;
  std::optional<std::filesystem::path> answer_;

  std::filesystem::path folder_;
  FolderReader reader_;
  bool reading_ = false;
  std::vector<FolderEntry> shown_;
  ListingOrder order_;
  bool all_files_ = false;
  int selected_ = -1;
  bool scroll_to_selected_ = false;
  std::string select_when_read_;  // a name

  std::string name_;  // of the file to save
  bool focus_name_ = false;
  std::string problem_;  // of the last try to answer or to make a folder

  bool editing_path_ = false;
  std::string path_text_;
  Bottom bottom_ = Bottom::answer;
  std::string new_folder_;
  bool focus_bottom_ = false;
  std::string typed_;  // to find an entry by
  double typed_at_s_ = 0;
};

}  // namespace sigs::editor
