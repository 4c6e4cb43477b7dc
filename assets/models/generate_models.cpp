// SPDX-License-Identifier: MIT
// generate_models FOLDER writes FOLDER/airliner and FOLDER/light-aircraft.
#include <cstdio>

#include "model.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: generate_models FOLDER\n");
    return 64;
  }
  const std::filesystem::path folder = arguments[1];
  const bool good = sigs::models::write_model(sigs::models::airliner(), folder / "airliner") &&
                    sigs::models::write_model(sigs::models::light_aircraft(), folder / "light-aircraft");
  return good ? 0 : 74;
}
