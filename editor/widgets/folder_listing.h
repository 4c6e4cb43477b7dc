// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sigs::editor {

struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed;
};

struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;  // in no order; hidden ones too
  std::string problem;               // not empty: why it cannot be read
};
[[nodiscard]] FolderListing listing_of(const std::filesystem::path& folder);

enum class SortBy { name, changed, size };

struct ListingOrder {
  SortBy by = SortBy::name;
  bool descending = false;

  [[nodiscard]] bool operator==(const ListingOrder&) const = default;
};

// What a file browser shows: folders first, names as people order them ("clip 9" before "clip 10"), hidden ones left
// out.
//   extensions  ".json", in any case; empty: all files
[[nodiscard]] std::vector<FolderEntry> shown_entries(const FolderListing& listing,
                                                     const std::vector<std::string>& extensions, ListingOrder order);

// -1, 0, 1; digits count as numbers, letters in any case as equal.
[[nodiscard]] int natural_order(const std::string& a, const std::string& b);

// "812 B", "1.4 MB".
[[nodiscard]] std::string size_text(std::uintmax_t bytes);
// "2024-05-17 09:30", local time.
[[nodiscard]] std::string time_text(std::filesystem::file_time_type time);

// Reads a folder on a thread of its own; a disk that does not answer holds nobody up.
class FolderReader {
 public:
  // Waits a moment, so that a quick disk's folder is there at once.
  void read(const std::filesystem::path& folder);
  [[nodiscard]] bool is_reading();
  // The newest that was read.
  [[nodiscard]] const FolderListing& listing() const { return listing_; }

 private:
  struct Pending;
  std::shared_ptr<Pending> pending_;
  FolderListing listing_;
};

}  // namespace sigs::editor
