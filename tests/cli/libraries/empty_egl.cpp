// SPDX-License-Identifier: MIT
// A libEGL.so.1 that has none of its functions.
extern "C" int nothing_of_egl() {
  return 0;
}
