// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "mesh/mesh.h"
#include "support/test_data.h"

namespace sigs::test {

// Writes a file, with the folders that it needs, and returns its path.
inline std::filesystem::path written(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

// The mesh of an OBJ text in the given axes, or the error.
inline Result<Mesh> mesh_of(const std::string& text, const ModelAxes& axes = {}) {
  const TemporaryFolder folder;
  return read_obj(written(folder / "model.obj", text), axes);
}

// A box of 4 x 2 x 1 units along x, y, z with its lower corner at the origin, wound counter-clockwise from
// outside.
inline std::string box_obj() {
  return "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
}

}  // namespace sigs::test
