// SPDX-License-Identifier: MIT
// generate_models FOLDER writes the sample models below FOLDER, each into a folder of its name.
#include <cstdio>

#include "model.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: generate_models FOLDER\n");
    return 64;
  }
  using namespace sigs::models;
  for (const auto model :
       {airliner, light_aircraft, helicopter, helicopter_trainer, helicopter_utility, helicopter_fenestron,
        helicopter_medium, helicopter_military, helicopter_heavy, quadcopter, multirotor_racer, multirotor_hexa,
        multirotor_octo, multirotor_sprayer, bird, balloon, insect})
    if (!write_model(model(), arguments[1])) return 74;
  return 0;
}
