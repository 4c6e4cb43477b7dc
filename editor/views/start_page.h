// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/recovery.h"
#include "editor/preview/thumbnails.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What is there before a project is.
struct StartPageContent {
  const std::vector<AbandonedProject>& abandoned;
  std::filesystem::path loading;  // a project file that is being read; "": none
};

// What the person wants with an abandoned project; everything else goes through the context's edits.
struct StartPageChoice {
  std::optional<AbandonedProject> recover;
  std::optional<AbandonedProject> discard;
};

struct SampleProject {
  std::filesystem::path file;
  std::string name;
  std::string text;  // the first sentence of its README
};

// The projects NAME/NAME.json below a folder, by name; other files of that name (recipes of datasets) are none. Empty
// where the folder is not there.
[[nodiscard]] std::vector<SampleProject> samples_in(const std::filesystem::path& folder);

// The page that is shown while no project is open: sample projects, recent ones, and what a crash left behind.
class StartPage {
 public:
  // samples  a folder whose folders hold a project and a README.md each; one that is not there: none
  // wake     called from another thread when an image is ready
  StartPage(const std::filesystem::path& samples, std::function<void()> wake);

  [[nodiscard]] StartPageChoice draw(const ViewContext& context, const StartPageContent& content);

 private:
  struct Recent {
    std::filesystem::path file;
    bool is_there = false;
  };
  void look_for(const std::vector<std::filesystem::path>& recent);
  void draw_head(const ViewContext& context, const StartPageContent& content);
  void draw_samples(const ViewContext& context, float width);
  void draw_card(const ViewContext& context, const SampleProject& sample, float width, float height);
  void draw_recent(const ViewContext& context, float width);
  void draw_abandoned(const ViewContext& context, const StartPageContent& content, StartPageChoice& choice);

  std::vector<SampleProject> samples_;
  std::vector<Recent> recent_;  // with the look at the disk from when the list last changed
  ProjectThumbnails images_;
};

// The text's first sentence below its headings, up to a semicolon or colon, without line breaks.
[[nodiscard]] std::string first_sentence(const std::string& markdown);

}  // namespace sigs::editor
