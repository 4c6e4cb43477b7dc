// SPDX-License-Identifier: MIT
#include "base/resources.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

#include "base/paths.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// A build folder lies at most this deep below the root of the source tree; share/sigs two above a program.
constexpr int kMaxParents = 8;

// The file that this code was loaded from. The main program has no name in the dynamic linker's list, and what dladdr
// then says is argv[0], which may be relative to another folder.
fs::path own_code_file() {
  Dl_info info{};
  link_map* map = nullptr;
  const auto address = reinterpret_cast<const void*>(&own_code_file);
  const bool is_library = dladdr1(address, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0 &&
                          map != nullptr && map->l_name != nullptr && map->l_name[0] != '\0';
  if (is_library) return canonical_path(map->l_name);
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  return code && info.dli_fname != nullptr ? canonical_path(info.dli_fname) : program;
}

}  // namespace

Result<fs::path> resource_folder_for(const fs::path& code_file) {
  fs::path folder = code_file.parent_path();
  for (int i = 0; i < kMaxParents && !folder.empty(); ++i) {
    const fs::path installed = folder / "share" / "sigs";
    if (is_folder(installed / "assets" / "models")) return installed;
    if (is_folder(folder / "assets" / "models") && is_folder(folder / "projects")) return folder;
    if (folder == folder.parent_path()) break;
    folder = folder.parent_path();
  }
  return fail("assets",
              "the program's own data, share/sigs/assets/models, is not in any folder above " + code_file.string() +
                  "; install SIGS as a whole, or keep its bin and share folders together",
              ErrorKind::cannot_read);
}

Result<fs::path> resource_folder() {
  return resource_folder_for(own_code_file());
}

Result<fs::path> resource_file(const fs::path& path_in_resources) {
  const Result<fs::path> folder = resource_folder();
  if (!folder) return fail(folder.error());
  fs::path file = *folder / path_in_resources;
  std::error_code code;
  if (fs::exists(file, code)) return file;
  return fail(file.string(), "is part of SIGS, but is not there; install SIGS again", ErrorKind::cannot_read);
}

}  // namespace sigs
