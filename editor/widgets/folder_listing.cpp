// SPDX-License-Identifier: MIT
#include "editor/widgets/file_browser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <ctime>
#include <memory>
#include <utility>

#include "base/paths.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

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

bool has_extension(const std::string& name, const std::vector<std::string>& extensions) {
  if (extensions.empty()) return true;
  const std::string extension = lower_extension(name);
  return std::ranges::any_of(extensions, [&](const std::string& wanted) { return lower_case(wanted) == extension; });
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
