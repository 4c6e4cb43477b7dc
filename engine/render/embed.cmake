# Writes a C++ header that holds the shaders as text, so that the program needs no files at run time.
# cmake -DOUTPUT=header -DSHADERS=folder -P embed.cmake
file(READ "${SHADERS}/intruder.vert" vertex)
file(READ "${SHADERS}/intruder.frag" fragment)
file(WRITE "${OUTPUT}" "// SPDX-License-Identifier: MIT
#pragma once

namespace sigs::shaders {

inline constexpr char kIntruderVert[] = R\"glsl(${vertex})glsl\";

inline constexpr char kIntruderFrag[] = R\"glsl(${fragment})glsl\";

}  // namespace sigs::shaders
")
