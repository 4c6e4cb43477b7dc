// SPDX-License-Identifier: MIT
// bench_encounter [PAIRS]: intervals of loss of well clear against brute force. Prints counts and times, and fails at
// the first disagreement.
#include <cstdio>
#include <cstdlib>

#include "encounter/brute_force.h"

int main(int argc, char** argv) {
  const sigs::test::BruteForce compared = sigs::test::brute_force(argc > 1 ? std::atoi(argv[1]) : 10000);
  std::printf("%d pairs, %d losses, %d of them shorter than 20 ms; %lld instants compared\n", compared.pairs,
              compared.losses, compared.brief_losses, compared.instants);
  std::printf("%.3f ms a pair for the search\n", 1e3 * compared.search_s / compared.pairs);
  if (compared.disagreement.empty()) return 0;
  std::printf("they disagree: %s\n", compared.disagreement.c_str());
  return 1;
}
