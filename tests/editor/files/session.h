// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "editor/app/project_session.h"
#include "support/test_data.h"

namespace sigs::editor {

namespace fs = std::filesystem;
using sigs::test::TemporaryFolder;

// An editor without a window, and a user who answers its questions.
struct SessionFixture {
  TemporaryFolder folder;
  Document document;
  Settings settings;
  bool exporting = false;
  double now_s = 0;
  std::uint64_t unsaved_mask = 0;
  std::shared_ptr<std::atomic<int>> files_read = std::make_shared<std::atomic<int>>(0);
  std::vector<std::function<void()>> to_save_mask;  // what goes on once its name is given
  ProjectSession session{
      document,
      settings,
      {folder / "state",
       [count = files_read] { ++*count; },
       [this] { return exporting; },
       {.unsaved = [this] { return unsaved_mask; },
        .save_then = [this](std::function<void()> next) { to_save_mask.push_back(std::move(next)); }}}};

  void edit(const std::string& name) {
    document.apply(ChangeProject{"rename", [name](Project& p) { p.name = name; }, {}});
  }

  fs::path written(const std::string& file, const std::string& name) {
    Project project;
    project.name = name;
    REQUIRE(write_project(project, folder / file, true));
    return folder / file;
  }

  void open(const fs::path& path) {
    session.handle(OpenProject{path});
    wait();
  }

  void wait() {
    for (int i = 0; i < 1000 && !session.loading().empty(); ++i) {
      session.update(now_s);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  // Until what is being read lies in memory, whether it is taken or not.
  void wait_for_disk() {
    for (int i = 0; i < 60; ++i) {
      session.update(now_s);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  // Until so many files were read in all; nothing is taken of them.
  void wait_until_read(int count) const {
    while (*files_read < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  std::string errors() {
    std::string text;
    for (const Request& request : session.take_requests())
      if (const auto* message = std::get_if<ShowMessage>(&request); message != nullptr && message->is_error)
        text += message->text;
    return text;
  }

  void choose_file(const fs::path& path) {
    for (const Request& request : session.take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) {
        wanted->chosen(path);
        return;
      }
    FAIL("no file was asked for");
  }
};

}  // namespace sigs::editor
