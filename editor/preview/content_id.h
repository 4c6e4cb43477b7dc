// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <utility>

#include "project/project.h"

namespace sigs::editor {

// A file as it lies on disk at one moment: where it changes, what was made from it is out of date.
struct FileStamp {
  std::filesystem::path path;  // "": none is named
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed;
  bool exists = false;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};
[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& path);

// All that the images of a project depend on. Two projects with equal names have the same images: the project's own
// name, its place, how its own body is looked for, its export settings and what this program does not know are left
// out.
// A digest (FNV-1a, 128 bits) of the project's text with resolved paths and of its files' stamps: thousands of names
// take no room to speak of, however large the projects are.
struct ContentId {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  [[nodiscard]] bool operator==(const ContentId&) const = default;
};
[[nodiscard]] ContentId content_id_of(const Project& project);

[[nodiscard]] FileStamp footage_stamp_of(const Project& project);

// Gives equal names equal numbers, from 1 on. Only the last few thousand names are remembered.
template <class Name>
class IdTable {
 public:
  [[nodiscard]] std::uint64_t id_of(Name name) {
    for (const auto& [known, number] : book_)
      if (known == name) return number;
    if (book_.size() >= kMax) book_.pop_back();
    book_.emplace_front(std::move(name), ++last_);
    return last_;
  }

 private:
  static constexpr std::size_t kMax = 2048;
  std::deque<std::pair<Name, std::uint64_t>> book_;  // newest first
  std::uint64_t last_ = 0;
};

}  // namespace sigs::editor
