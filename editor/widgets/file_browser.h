// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// A file or folder in a folder. What cannot be asked for (a link that leads nowhere) has neither size nor time.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  // 0 for folders.
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed;
};

// What a folder holds.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;  // in no order, hidden ones too
  std::string problem;               // not empty: why it cannot be read, or not to its end
};
// Asks the file system, which may take long; never fails otherwise than by `problem`.
[[nodiscard]] FolderListing listing_of(const std::filesystem::path& folder);

enum class SortBy { name, changed, size };

struct ListingOrder {
  SortBy by = SortBy::name;
  bool descending = false;

  [[nodiscard]] bool operator==(const ListingOrder&) const = default;
};

// What a file browser shows: folders first, entries of equal rank by name as people order them ("clip 9" before "clip
// 10"), hidden ones left out.
//   extensions  ".json", in any case; empty: all files. Folders are not filtered
[[nodiscard]] std::vector<FolderEntry> shown_entries(const FolderListing& listing,
                                                     const std::vector<std::string>& extensions, ListingOrder order);

// -1, 0, 1; runs of digits count as numbers, letters in any case as equal. 0 only for equal texts.
[[nodiscard]] int natural_order(const std::string& a, const std::string& b);

// "812 B", "1.4 MB": decimal units.
[[nodiscard]] std::string size_text(std::uintmax_t bytes);
// "2024-05-17 09:30", local time; "" for the default value.
[[nodiscard]] std::string time_text(std::filesystem::file_time_type time);

// Reads a folder on a thread of its own; a disk that does not answer holds nobody up. For the window's thread.
class FolderReader {
 public:
  // Begins to read; what is being read for an earlier call is dropped. Waits up to 40 ms, so that the listing of a
  // quick disk is there at once.
  void read(const std::filesystem::path& folder);
  // Also takes over a listing that has arrived: ask it before listing().
  [[nodiscard]] bool is_reading();
  // The newest that was read; empty before that.
  [[nodiscard]] const FolderListing& listing() const { return listing_; }

 private:
  std::future<FolderListing> coming_;  // from the thread, which may outlive the reader
  FolderListing listing_;
};

// What the answer is: a file that is there, a file that need not be there, or a folder.
enum class FileDialogMode { to_open, to_save, folder };

// A question to the person.
struct FileDialogRequest {
  std::string title;
  // With their dots: ".json"; empty: all files. The first is added to a name that is typed without one.
  std::vector<std::string> extensions;
  FileDialogMode wanted = FileDialogMode::to_open;
  // Where to begin: a folder, or a file whose name is proposed (to_save) or selected. "": where the last question
  // ended. What is not there is replaced by the nearest folder above it.
  std::filesystem::path start;
};

// A folder that is offered at the left.
struct BrowserPlace {
  std::string name;
  std::filesystem::path folder;
};

// The person's home, the current folder of the program and the root.
[[nodiscard]] std::vector<BrowserPlace> usual_places();

// Asks for a file or a folder in a dialog of our own. Folders are read when they are entered, on another thread, so
// that a disk that does not answer does not stop the window. For the window's thread, within an ImGui update.
class FileBrowser {
 public:
  // Opens the dialog; a question that is open is replaced. `places` are offered at the left.
  void ask(FileDialogRequest question, std::vector<BrowserPlace> places);
  // Without an answer.
  void close() { open_ = false; }
  [[nodiscard]] bool is_open() const { return open_; }

  // Once per update while it is open. The answer, absolute, in the update in which it is given; none in all others, and
  // when the dialog was closed without one. A file to save is only overwritten after a question.
  [[nodiscard]] std::optional<std::filesystem::path> draw(UiProbe& ui_probe);

  // Where the person was last; the next question without a start begins there.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  void set_folder(std::filesystem::path folder) { folder_ = std::move(folder); }

 private:
  // What the lower edge shows: the answer, "replace it?", or the name of a folder to be made.
  enum class Bottom { answer, overwrite, new_folder };

  // Each of these changes what is shown; the listing follows in a later update.
  void enter(const std::filesystem::path& folder);
  void go_up();
  void refresh();
  // Shows a listing that has arrived.
  void take_listing();
  // Entries are indices into shown_; others are clamped, or do nothing.
  void select(int entry);
  // As a double click: enters a folder, answers with a file.
  void activate(int entry);
  // Closes the dialog with this answer.
  void answer_with(const std::filesystem::path& path);
  // With name_, in the present folder: asks before a file is replaced, enters what is a folder.
  void answer_by_name();
  void make_folder();
  // What was typed as a path: absolute, from the present folder, or from "~".
  void go_to_text(const std::string& text);
  void begin_path();  // to be typed
  void handle_keys();
  // Letters select the entry whose name begins with them.
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
  // Valid while draw() runs.
  UiProbe* ui_probe_ = nullptr;
  std::vector<BrowserPlace> places_;
  bool open_ = false;
  std::optional<std::filesystem::path> answer_;  // given in this update, to be returned by draw()

  // The folder that is shown, while reading_ still without its entries.
  std::filesystem::path folder_;
  FolderReader reader_;
  bool reading_ = false;
  std::vector<FolderEntry> shown_;
  ListingOrder order_;
  bool all_files_ = false;  // the filter by extension is switched off
  // Index into shown_; -1: none.
  int selected_ = -1;
  bool scroll_to_selected_ = false;
  // Name of the entry to be selected once the listing is there; "": none.
  std::string select_when_read_;

  // Of the file to save, as typed.
  std::string name_;
  bool focus_name_ = false;
  std::string problem_;  // why the last try to answer or to make a folder failed; "": it did not

  // The bar of folders is a text field at the moment, with this text.
  bool editing_path_ = false;
  std::string path_text_;
  Bottom bottom_ = Bottom::answer;
  std::string new_folder_;
  bool focus_bottom_ = false;
  // Letters to find an entry by, and when the last of them came (ImGui's time); after a pause of a second they begin
  // anew.
  std::string typed_;
  double typed_at_s_ = 0;
};

}  // namespace sigs::editor
