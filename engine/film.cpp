// SPDX-License-Identifier: MIT
#include "film.h"

namespace sigs {

Result<void> show_film(const Project& project, int, const std::function<Result<void>(const FilmFrame&)>&) {
  return fail(project.file.string(), "not yet", ErrorKind::unavailable);
}

}  // namespace sigs
