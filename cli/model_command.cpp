// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/resources.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "first_project/first_model.h"
#include "model_import/import_model.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kModelFooter =
    "Examples:\n"
    "  sigs model list\n"
    "  sigs model import a320.ac --length 37.57\n"
    "  sigs model import drone.glb --forward -z --up +y --out models/drone/drone.obj\n"
    "\n"
    "sigs model import --help has the options.";

constexpr const char* kImportFooter =
    "Examples:\n"
    "  sigs model import a320.ac --length 37.57\n"
    "  sigs model import drone.glb --forward -z --up +y --out models/drone/drone.obj";

// Where FlightGear's aircraft of other traffic lie: Debian's package flightgear-data-ai, or $FG_ROOT.
std::vector<fs::path> flightgear_folders() {
  std::vector<fs::path> folders;
  if (const char* const root = std::getenv("FG_ROOT"); root != nullptr)
    folders.push_back(fs::path(root) / "AI/Aircraft");
  folders.emplace_back("/usr/share/games/flightgear/AI/Aircraft");
  return folders;
}

// Files with this ending at most two folders down, by path.
std::vector<fs::path> files_below(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it.depth() > 1) it.disable_recursion_pending();
    if (it->is_regular_file(code) && lower_case(it->path().extension().string()) == ending) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void print_models(const char* from, const std::vector<fs::path>& files) {
  if (files.empty()) return;
  std::printf("%s\n", from);
  for (const fs::path& file : files)
    std::printf("  %-28s %-11s %s\n", file.stem().c_str(), category_of_model(file).c_str(), file.c_str());
}

Result<void> run_list() {
  const Result<fs::path> samples = resource_file("assets/models");
  if (!samples) return fail(samples.error());
  print_models("with SIGS, ready for projects", files_below(*samples, ".obj"));
  bool has_flightgear = false;
  for (const fs::path& folder : flightgear_folders()) {
    const std::vector<fs::path> files = files_below(folder, ".ac");
    print_models("of FlightGear, for sigs model import", files);
    has_flightgear |= !files.empty();
  }
  if (!has_flightgear)
    std::fputs("none of FlightGear; on Debian the package flightgear-data-ai has a hundred types\n", stderr);
  return std::fflush(stdout) == 0 ? Result<void>() : fail("stdout", "could not be written", ErrorKind::write_failed);
}

struct ImportOptions {
  ModelImport request;
  fs::path out;  // empty: NAME/NAME.obj
  bool keeps_rotors = false;
  bool force = false;
};

Result<void> run_import(ImportOptions options) {
  options.request.turns_rotors = !options.keeps_rotors;
  const std::string stem = options.request.file.stem().string();
  const fs::path out = options.out.empty() ? fs::path(stem) / (stem + ".obj") : options.out;
  if (out.extension() != ".obj") return fail("--out " + out.string(), "must end in .obj", ErrorKind::usage);
  const Result<ImportedModel> model = import_model(options.request, out.stem().string());
  if (!model && (model.error().where == "forward" || model.error().where == "up"))
    return fail("--" + model.error().where, model.error().what, ErrorKind::usage);
  if (!model) return fail(model.error());
  for (const Warning& warning : model->warnings) print_warning(warning);
  CreatedFolders folders;
  if (!out.parent_path().empty())
    if (const Result<void> made = folders.make(out.parent_path()); !made) return made;
  OutputFiles files(options.force);
  for (const ImportedFile& file : model->files)
    if (const Result<void> written = files.write(out.parent_path() / file.name, file.bytes); !written) return written;
  for (const std::string& note : model->notes) std::fprintf(stderr, "%s\n", note.c_str());
  if (const Result<void> done = files.commit(); !done) return done;
  std::fprintf(stderr, "%zu triangles; %.2f m long, %.2f m across, %.2f m high\n", model->triangles, model->size_m.x,
               model->size_m.y, model->size_m.z);
  print_written(files.final_paths());
  return {};
}

Command add_import(CLI::App& model) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* const command =
      model.add_subcommand("import", "make an OBJ of a model in another format: nose +x, up +z, metres");
  command
      ->add_option("FILE", options->request.file,
                   "glTF, Collada, FBX, 3DS, AC3D, or what else the library assimp reads")
      ->required();
  command->add_option("--out", options->out, "the OBJ; MTL and images lie beside it; NAME/NAME.obj unless given");
  command->add_option("--forward", options->request.forward,
                      "axis of the file that points out of the nose: +x -x +y -y +z -z; else by its shape");
  command->add_option("--up", options->request.up, "axis of the file that points up; else by its shape");
  command->add_option("--length", options->request.length_m, "metres from nose to tail; else by the file's unit")
      ->check(CLI::Range(0.01, 1e6))
      ->type_name("M");
  command->add_flag("--keep-rotors", options->keeps_rotors, "rotors stay as they are built; else parts named so turn");
  command->add_flag("--force", options->force, "replace files that are there");
  command->footer(kImportFooter);
  return [options] { return run_import(*options); };
}

Command add_list(CLI::App& model) {
  model.add_subcommand("list", "list the models that are installed: those of SIGS, and FlightGear's")
      ->footer("Examples:\n  sigs model list");
  return [] { return run_list(); };
}

}  // namespace

Command add_model_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("model", "list models of aircraft, and import others");
  command->footer(kModelFooter);
  return add_below(*command, {add_import, add_list});
}

}  // namespace sigs::cli
