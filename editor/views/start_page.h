// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/recovery.h"
#include "editor/geometry/image_view.h"
#include "editor/preview/thumbnails.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What the person wants with an abandoned project, in the update in which it is chosen; everything else goes through
// the context's edits.
struct StartPageChoice {
  std::optional<AbandonedProject> recover;
  std::optional<AbandonedProject> discard;
};

// A project that comes with the program.
struct SampleProject {
  std::filesystem::path file;
  std::string name;
  std::string text;  // the first sentence of the README beside it; "": it has none
};

// The projects NAME/NAME.json below a folder, by name; other files of that name (recipes of datasets) are none. Empty
// where the folder is not there.
[[nodiscard]] std::vector<SampleProject> samples_in(const std::filesystem::path& folder);

// The page that is shown while no project is open: sample projects, recent ones, and what a crash left behind.
class StartPage {
 public:
  // Reads the samples, once.
  //   samples  a folder whose folders hold a project and a README.md each; one that is not there: none
  //   wake     called from another thread when an image is ready
  StartPage(const std::filesystem::path& samples, std::function<void()> wake);

  // Once per update, into the current ImGui window.
  //   loading  a project file that is being read; "": none
  [[nodiscard]] StartPageChoice draw(const ViewContext& context, const std::vector<AbandonedProject>& abandoned,
                                     const std::filesystem::path& loading);

  // While it is not shown: images that are not made yet wait until it is, as they do while a project is being read.
  void rest() { images_.rest(true); }

 private:
  // A project of Settings::recent.
  struct Recent {
    std::filesystem::path file;
    bool is_there = false;
  };
  // Looks which recent projects are there, when the list has changed.
  void look_for(const std::vector<std::filesystem::path>& recent);
  void draw_head(const ViewContext& context, const std::filesystem::path& loading);
  void draw_samples(const ViewContext& context, float width);
  void draw_card(const ViewContext& context, const SampleProject& sample, float width, float height);
  void draw_recent(const ViewContext& context, float width);
  void draw_abandoned(const ViewContext& context, const std::vector<AbandonedProject>& abandoned,
                      StartPageChoice& choice);

  std::vector<SampleProject> samples_;
  // As the disk was when the list last changed.
  std::vector<Recent> recent_;
  Thumbnails images_;
};

// What a project needs before there is anything to see, in the order in which it is usually chosen: a card over the
// image, until all of it is there or the person puts the card away. Then where the horizon lies, at the image's
// lower edge, so that its line can be dragged.
class FirstSteps {
 public:
  // In the middle of `room`, in the current ImGui window.
  void draw(const ViewContext& context, const ScreenRect& room);

 private:
  std::uint64_t begun_ = 0;     // the document that had not all of it
  std::uint64_t shown_ = 0;     // the document whose horizon was shown
  std::uint64_t put_away_ = 0;  // the document for which it is not wanted
};

}  // namespace sigs::editor
