// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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
  // In no order, hidden ones too.
  std::vector<FolderEntry> entries;
  // Not empty: why it cannot be read, or not to its end.
  std::string problem;
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
  struct Pending;
  std::shared_ptr<Pending> pending_;
  FolderListing listing_;
};

}  // namespace sigs::editor
