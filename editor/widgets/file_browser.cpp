// SPDX-License-Identifier: MIT
#include "editor/widgets/file_browser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <utility>

#include "base/paths.h"
#include "base/text.h"
#include "base/threads.h"
#include "editor/widgets/dialog.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr double kTypingPause_s = 1;  // after it, a new word begins

bool has_extension(const std::string& name, const std::vector<std::string>& extensions) {
  if (extensions.empty()) return true;
  const std::string extension = lower_extension(name);
  return std::ranges::any_of(extensions, [&](const std::string& wanted) { return lower_case(wanted) == extension; });
}

fs::path home() {
  const char* folder = std::getenv("HOME");
  return folder != nullptr && *folder != '\0' ? fs::path(folder) : fs::path("/");
}

// It, or the nearest of those above it that is there.
fs::path nearest_folder(fs::path path) {
  while (!is_folder(path) && path.has_relative_path()) path = path.parent_path();
  return path.empty() ? home() : path;
}

}  // namespace

std::vector<BrowserPlace> usual_places() {
  std::error_code code;
  return {{"Home", home()}, {"Present folder", fs::current_path(code)}, {"Computer", "/"}};
}

void FileBrowser::ask(FileDialogRequest question, std::vector<BrowserPlace> places) {
  question_ = std::move(question);
  places_ = std::move(places);
  open_ = true;
  answer_.reset();
  all_files_ = question_.extensions.empty();
  bottom_ = Bottom::answer;
  name_.clear();
  select_when_read_.clear();
  problem_.clear();
  fs::path start = question_.start;
  if (start.empty()) start = folder_.empty() ? home() : folder_;
  start = fs::absolute(start).lexically_normal();
  if (!start.has_filename() && start.has_relative_path()) start = start.parent_path();
  if (!is_folder(start)) {
    (question_.wanted == FileDialogMode::to_save ? name_ : select_when_read_) = start.filename().string();
    start = start.parent_path();
  }
  focus_name_ = question_.wanted == FileDialogMode::to_save;
  const std::string wanted = select_when_read_;
  enter(nearest_folder(start));
  select_when_read_ = wanted;
}

void FileBrowser::enter(const fs::path& folder) {
  folder_ = folder;
  editing_path_ = false;
  problem_.clear();
  typed_.clear();
  selected_ = -1;
  shown_.clear();
  select_when_read_.clear();
  refresh();
}

void FileBrowser::refresh() {
  reader_.read(folder_);
  reading_ = true;
}

void FileBrowser::go_up() {
  if (!folder_.has_relative_path()) return;
  const std::string from = folder_.filename().string();
  enter(folder_.parent_path());
  select_when_read_ = from;
}

void FileBrowser::take_listing() {
  if (!reading_ || reader_.is_reading()) return;
  reading_ = false;
  const std::vector<std::string> wanted = all_files_ ? std::vector<std::string>() : question_.extensions;
  shown_ = shown_entries(reader_.listing(), wanted, order_);
  if (question_.wanted == FileDialogMode::folder)
    std::erase_if(shown_, [](const FolderEntry& e) { return !e.is_folder; });
  selected_ = -1;
  for (std::size_t i = 0; i < shown_.size(); ++i)
    if (shown_[i].name == select_when_read_) selected_ = static_cast<int>(i);
  scroll_to_selected_ = selected_ >= 0;
}

void FileBrowser::select(int entry) {
  if (shown_.empty()) return;
  selected_ = std::clamp(entry, 0, static_cast<int>(shown_.size()) - 1);
  select_when_read_ = shown_[static_cast<std::size_t>(selected_)].name;
  const FolderEntry& chosen = shown_[static_cast<std::size_t>(selected_)];
  if (question_.wanted == FileDialogMode::to_save && !chosen.is_folder) name_ = chosen.name;
  problem_.clear();
}

void FileBrowser::activate(int entry) {
  if (entry < 0 || entry >= static_cast<int>(shown_.size())) return;
  const FolderEntry chosen = shown_[static_cast<std::size_t>(entry)];
  if (chosen.is_folder)
    enter(folder_ / chosen.name);
  else if (question_.wanted == FileDialogMode::to_save)
    answer_by_name();
  else
    answer_with(folder_ / chosen.name);
}

void FileBrowser::answer_with(const fs::path& path) {
  answer_ = path;
  folder_ = path.parent_path();  // where the next question begins
  open_ = false;
}

void FileBrowser::answer_by_name() {
  fs::path path = folder_ / name_;
  if (name_.empty() || !path.has_filename()) return;
  if (is_folder(path)) return enter(path.lexically_normal());
  // A dot in a name begins no extension: "flight 2024.06.01".
  if (!has_extension(path.filename().string(), question_.extensions)) path += question_.extensions.front();
  if (!is_folder(path.parent_path())) {
    problem_ = "there is no folder " + path.parent_path().string();
    return;
  }
  std::error_code code;
  if (fs::exists(path, code) && bottom_ != Bottom::overwrite) {
    name_ = path.filename().string();
    bottom_ = Bottom::overwrite;
    return;
  }
  answer_with(path.lexically_normal());
}

void FileBrowser::make_folder() {
  std::error_code code;
  const fs::path path = folder_ / new_folder_;
  if (new_folder_.empty()) return;
  if (!fs::create_directories(path, code)) {
    problem_ = new_folder_ + (code ? ": " + code.message() : " is there already");
    return;
  }
  bottom_ = Bottom::answer;
  enter(path.lexically_normal());
}

void FileBrowser::go_to_text(const std::string& text) {
  editing_path_ = false;
  if (text.empty()) return;
  const bool is_in_home = text == "~" || text.starts_with("~/");  // "~name" is an ordinary name
  fs::path path = is_in_home ? home() / fs::path(text.substr(std::min<std::size_t>(2, text.size()))) : folder_ / text;
  path = path.lexically_normal();
  std::error_code code;
  if (is_folder(path)) {
    enter(path);
  } else if (fs::exists(path, code) && question_.wanted == FileDialogMode::to_open) {
    answer_with(path);
  } else if (question_.wanted == FileDialogMode::to_save && is_folder(path.parent_path())) {
    enter(path.parent_path());
    name_ = path.filename().string();
  } else {
    problem_ = path.string() + " is not there";
  }
}

void FileBrowser::begin_path() {
  editing_path_ = focus_bottom_ = true;
  path_text_ = folder_.string();
}

void FileBrowser::handle_typed() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl || io.KeyAlt || io.InputQueueCharacters.empty()) return;
  const double now_s = ImGui::GetTime();
  if (now_s - typed_at_s_ > kTypingPause_s) typed_.clear();
  typed_at_s_ = now_s;
  for (const ImWchar c : io.InputQueueCharacters)
    if (c >= ' ' && c < 127) typed_ += static_cast<char>(c);
  for (std::size_t i = 0; i < shown_.size() && !typed_.empty(); ++i) {
    if (!lower_case(shown_[i].name).starts_with(lower_case(typed_))) continue;
    select(static_cast<int>(i));
    scroll_to_selected_ = true;
    return;
  }
}

void FileBrowser::handle_keys() {
  if (ImGui::GetIO().KeyCtrl && pressed(Key::l)) begin_path();
  if (editing_path_ || bottom_ != Bottom::answer) return;
  const int before = selected_;
  const int page = 12;
  if (pressed(Key::down, true)) select(selected_ + 1);
  if (pressed(Key::up, true)) select(std::max(0, selected_ - 1));
  if (pressed(Key::page_down, true)) select(selected_ + page);
  if (pressed(Key::page_up, true)) select(selected_ - page);
  if (selected_ != before) scroll_to_selected_ = true;
  if (pressed(Key::f5)) refresh();
  if (ImGui::GetIO().WantTextInput) return;
  if (pressed(Key::home)) select(0), scroll_to_selected_ = true;
  if (pressed(Key::end)) select(static_cast<int>(shown_.size()) - 1), scroll_to_selected_ = true;
  if (pressed(Key::backspace, true)) go_up();
  if (enter_pressed()) activate(selected_);
  handle_typed();
}

std::optional<fs::path> FileBrowser::draw(UiProbe& ui_probe) {
  if (!open_) return std::nullopt;
  ui_probe_ = &ui_probe;
  bool closed = false;
  const std::string title = question_.title + "###file browser";
  if (!begin_dialog(title.c_str(), 900, 600, closed)) return std::nullopt;
  take_listing();
  handle_keys();
  draw_path_bar();
  ImGui::Dummy({0, scaled(2)});
  const float bottom = 2 * scaled(28) + 3 * ImGui::GetStyle().ItemSpacing.y + ImGui::GetTextLineHeight();
  const float height = std::max(scaled(80), ImGui::GetContentRegionAvail().y - bottom);
  const float places = ImGui::GetContentRegionAvail().x > scaled(560) ? scaled(170) : 0;
  if (places > 0) {
    draw_places(places, height);
    ImGui::SameLine();
  }
  draw_list(height);
  draw_bottom();
  if (closed && bottom_ != Bottom::answer)
    bottom_ = Bottom::answer;
  else if (closed)
    open_ = false;
  end_dialog(open_);
  return std::exchange(answer_, std::nullopt);
}

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// The digits from a place on, without leading zeros; moves the place behind them.
std::string number_at(const std::string& text, std::size_t& place) {
  while (place < text.size() && text[place] == '0') ++place;
  const std::size_t begin = place;
  while (place < text.size() && is_digit(text[place])) ++place;
  return text.substr(begin, place - begin);
}

template <class Value>
int sign_of(const Value& a, const Value& b) {
  return a < b ? -1 : (b < a ? 1 : 0);
}

int compared(const FolderEntry& a, const FolderEntry& b, SortBy by) {
  if (by == SortBy::changed) return sign_of(a.changed, b.changed);
  if (by == SortBy::size) return sign_of(a.bytes, b.bytes);
  return natural_order(a.name, b.name);
}

}  // namespace

FolderListing listing_of(const fs::path& folder) {
  FolderListing listing{.folder = folder};
  std::error_code code;
  fs::directory_iterator it(folder, code);
  for (const fs::directory_iterator end; !code && it != end; it.increment(code)) {
    std::error_code unknown;  // a dangling link, a file that goes away meanwhile: listed without size and time
    FolderEntry entry{.name = it->path().filename().string(), .is_folder = it->is_directory(unknown)};
    if (!entry.is_folder) entry.bytes = it->file_size(unknown);
    if (unknown) entry.bytes = 0;
    entry.changed = it->last_write_time(unknown);
    if (unknown) entry.changed = {};
    listing.entries.push_back(std::move(entry));
  }
  if (code) listing.problem = code.message();
  return listing;
}

int natural_order(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string x = number_at(a, i);
      const std::string y = number_at(b, j);
      if (x.size() != y.size()) return sign_of(x.size(), y.size());
      if (x != y) return sign_of(x, y);
      continue;
    }
    if (const int order = sign_of(lower(a[i]), lower(b[j])); order != 0) return order;
    ++i;
    ++j;
  }
  if (const int order = sign_of(a.size() - i, b.size() - j); order != 0) return order;
  return sign_of(a, b);
}

std::vector<FolderEntry> shown_entries(const FolderListing& listing, const std::vector<std::string>& extensions,
                                       ListingOrder order) {
  std::vector<FolderEntry> shown;
  for (const FolderEntry& entry : listing.entries)
    if (!entry.name.starts_with(".") && (entry.is_folder || has_extension(entry.name, extensions)))
      shown.push_back(entry);
  std::ranges::sort(shown, [order](const FolderEntry& a, const FolderEntry& b) {
    if (a.is_folder != b.is_folder) return a.is_folder;
    const int by_key = compared(a, b, order.by) * (order.descending ? -1 : 1);
    return by_key != 0 ? by_key < 0 : natural_order(a.name, b.name) < 0;
  });
  return shown;
}

std::string size_text(std::uintmax_t bytes) {
  static constexpr std::array kUnits{"B", "KB", "MB", "GB", "TB", "PB", "EB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000;
  return fmt::format("{:.{}f} {}", size, unit == 0 || size >= 99.5 ? 0 : 1, kUnits[unit]);
}

std::string time_text(fs::file_time_type time) {
  if (time == fs::file_time_type()) return "";
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(std::chrono::file_clock::to_sys(time)));
  std::tm local{};
  localtime_r(&seconds, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
  return text.data();
}

void FolderReader::read(const fs::path& folder) {
  const auto promise = std::make_shared<std::promise<FolderListing>>();
  coming_ = promise->get_future();
  run_in_background([promise, folder] {
    Result<FolderListing> listing = guarded([&]() -> Result<FolderListing> { return listing_of(folder); });
    promise->set_value(listing ? std::move(*listing)
                               : FolderListing{.folder = folder, .problem = listing.error().text()});
  });
  coming_.wait_for(std::chrono::milliseconds(40));
}

bool FolderReader::is_reading() {
  if (!coming_.valid()) return false;
  if (coming_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
  listing_ = coming_.get();
  return false;
}

}  // namespace sigs::editor
