// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT

#include <doctest/doctest.h>

#include "support/test_data.h"

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int status = context.run();
  return status == 0 && sigs::test::skipped_tests() > 0 ? sigs::test::kSkipped : status;
}
