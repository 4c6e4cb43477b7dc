// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"
#include "scene/visibility.h"
#include "video/image_sequence.h"

namespace sigs {

// From a clip to a project that opens, checks and exports: `sigs init`, and the editor's "New project".
//
// What is not given is taken from the footage where the file tells it (field of view, flight log), else guessed, and
// every guess is listed. The camera is a calibration beside the project; one intruder flies in view during most of the
// frames used, 20 to 60 px wide at its closest. It looks as the footage's camera shows things: light, blur, noise, haze
// and compression are those that `sigs appearance` finds in it. Without a log the camera turns as the images show it.

struct FirstProjectOptions {
  std::filesystem::path video;
  SequenceTiming timing;                     // of images, which do not state it
  std::filesystem::path calibration;         // empty: none is given
  std::optional<double> horizontal_fov_deg;  // of the footage, 1 to 359; not together with a calibration
  std::filesystem::path model;  // OBJ; empty: the sample light aircraft; samples are copied beside the project
  std::filesystem::path
      out;           // the project file; empty: NAME/NAME.json in the current folder, of images NAME-project/NAME.json
  std::string name;  // empty: the project file's or else the video's name without extension, of images their folder's
  bool overwrite = false;  // whether files of these names are replaced
  bool plain = false;      // appearance and motion stay at the defaults; else they are those of the footage
};

struct FirstProjectControl {
  // done of total, and what is done next: "reading the video"; called on the calling thread. May be empty.
  std::function<void(int done, int total, const std::string& step)> progress;
  const std::atomic<bool>* cancel = nullptr;  // set to true: ends soon with the error `interrupted`; may be null
};

// One thing that was decided for the user.
struct FirstProjectNote {
  std::string field;          // of the project: "footage.calibration", "intruders[0].model.forward"
  std::string text;           // what and why; one line
  bool is_guess = false;      // false: the file states it, or it was measured
  std::string remedy = {};    // what changes it on the command line: "--fov states it"; empty: the setting alone
  bool is_not_shown = false;  // of a guess on the look of the footage: it does not show this, the default stands
};

// "text; remedy", for the terminal.
[[nodiscard]] std::string told_on_terminal(const FirstProjectNote& note);

// The name of a file without its extension and without dots at its beginning; "project" where nothing is left.
[[nodiscard]] std::string stem_of(const std::filesystem::path& file);

// The file with the notes beside a project file: NAME.notes.txt.
[[nodiscard]] std::filesystem::path notes_file_of(const std::filesystem::path& project_file);

// A setting that was guessed when a project was made, and its value then.
struct FirstProjectGuess {
  std::string field;  // of one setting or of a group: "intruders[0].trajectory"
  std::string text;
  std::string value = {};  // setting_text() (project/json.h)
};

// The guesses of a project that make_first_project() made, from NAME.notes.txt beside its file, in their order. A note
// without a value (files of earlier versions) is left out. Empty where there is no such file.
[[nodiscard]] std::vector<FirstProjectGuess> guesses_beside(const std::filesystem::path& project_file);

// Whether a setting was guessed when the project was made, and has the value still that was guessed.
[[nodiscard]] bool is_still_guessed(const Project& project, const std::string& field);

// A file that is made beside the project file: a text, or a copy of another file.
struct FirstProjectFile {
  std::filesystem::path path;  // absolute
  std::string content;
  std::filesystem::path copy_of;  // empty: `content` is written
};

struct FirstProject {
  Project project;                      // `file` is the absolute path that it has or will have
  std::vector<FirstProjectNote> notes;  // in the order of the project's fields
  std::vector<FirstProjectFile> files;  // calibration, model, text of the notes
  Visibility visibility;                // of the intruder, estimated as `sigs check` does
  std::vector<Warning> warnings;        // of the files that were read
};

// The text of notes_file_of() for a project, as guesses_beside() reads it.
[[nodiscard]] std::string notes_text(const FirstProject& first);

// Plans the project; nothing is written. Reads the video's index and its log, at most 7 frames of a plain project, else
// all up to 90 s.
// Errors: usage (options that contradict each other), cannot_read, bad_data (a calibration for another shape of
// images, which names both; a model without a size), interrupted.
[[nodiscard]] Result<FirstProject> planned_first_project(const FirstProjectOptions& options,
                                                         const FirstProjectControl& control = {});

// Writes the project file and its other files, all of them or none, making folders where there are none. Paths in the
// project are relative to its folder, so it can move together with the video. Files of the sample model that are there
// already with the same content are left alone. Errors: cannot_create (a file is there already and options.overwrite
// is false), write_failed.
[[nodiscard]] Result<void> write_first_project(const FirstProject& planned, bool overwrite);

// All of these files or none, making folders where there are none. Copies that are there already with the same content
// are left alone. Errors as above.
[[nodiscard]] Result<void> write_files(const std::vector<FirstProjectFile>& files, bool overwrite);

// Both, one after the other.
[[nodiscard]] Result<FirstProject> make_first_project(const FirstProjectOptions& options,
                                                      const FirstProjectControl& control = {});

}  // namespace sigs
