// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "cli/tiny_project.h"
#include "support/running_program.h"
#include "support/test_data.h"

namespace sigs::test {

// A command of `sigs` with small inputs.
struct Job {
  std::string name;                 // of the test's messages
  std::string arguments;            // all outputs are given below OUT, a word that stands for the output folder
  std::vector<std::string> inputs;  // those that it reads to their end, by their names in the folder of inputs
  std::string again = "--force";    // option with which a later run replaces what is there, or completes it
  bool draws = false;               // needs OpenGL
};

// Whole contents of files by their paths from a folder.
using Contents = std::map<std::string, std::string>;

// The jobs' inputs, an output folder, and what each job writes when nothing goes wrong.
class Workplace {
 public:
  Workplace();

  [[nodiscard]] const std::vector<Job>& jobs() const { return jobs_; }
  [[nodiscard]] std::filesystem::path input(const std::string& name) const { return tiny_.file(name); }
  [[nodiscard]] std::filesystem::path out() const { return tiny_.file("out"); }
  [[nodiscard]] std::vector<std::string> words(const Job& job, const std::string& more = "") const;

  // Empty again, or made anew.
  void clear_out() const;
  // Every file below the output folder, and staging folders, as "NAME/"; other folders are left out.
  [[nodiscard]] Contents files_out() const;

  // What the job writes, and how long that takes; from a run without faults, made at the first call.
  struct Whole {
    Contents files;
    std::string printed;  // to standard output
    double lasts_s = 0;
  };
  [[nodiscard]] const Whole& whole(const Job& job);

  // Runs the job to its end in an empty output folder.
  [[nodiscard]] Run run(const Job& job, const Conditions& conditions) const;

  // The rule of all faults: an export is there as a whole with status 0, or not at all with an error status and one
  // line that says why. A dataset's finished videos stay.
  void check_all_or_nothing(const Job& job, const Run& run);
  // Under final names there is nothing but what the job writes, each file whole.
  void check_final_names(const Job& job);
  // The next run succeeds, leaves the same bytes as ever, and nothing of the run before.
  void check_next_run(const Job& job);

 private:
  void make_inputs() const;

  TinyProject tiny_;
  std::vector<Job> jobs_;
  std::map<std::string, Whole> wholes_;
};

// The same for all test cases of the program.
[[nodiscard]] Workplace& workplace();

// How often each test tries each of its faults, in place of `usual`: SIGS_TEST_FAULTS of the environment.
[[nodiscard]] int tries(int usual);

// The next random number from 0 to below 1.
[[nodiscard]] double share(std::mt19937& random);

}  // namespace sigs::test
