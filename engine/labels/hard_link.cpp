// SPDX-License-Identifier: MIT
#include "labels/hard_link.h"

#include <string>
#include <system_error>

namespace sigs {

namespace fs = std::filesystem;

Result<void> link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::create_hard_link(from, to, code);
  if (!code) return {};
  // Another file system, one without hard links, or too many names for one file: what speaks against a copy as well
  // says so itself.
  fs::copy_file(from, to, fs::copy_options::none, code);
  if (code)
    return fail(to.string(), "could not be made of " + from.string() + ": " + code.message(), ErrorKind::write_failed);
  return {};
}

}  // namespace sigs
