// SPDX-License-Identifier: MIT
// Streams read by programs that not every machine has: GStreamer, Python with numpy.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "cli/program.h"
#include "cli/tiny_project.h"
#include "docs/markdown.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

std::string quoted_program() {
  return "'" + (build_dir() / "sigs").string() + "'";
}

// Bash, since pipefail and process substitution are its own.
Run run_in(const TinyProject& tiny, const std::string& script) {
  write_file(tiny.file("script.sh"), "cd '" + tiny.file("").string() + "'\nSIGS=" + quoted_program() + "\n" + script);
  return run_command("timeout 300 bash '" + tiny.file("script.sh").string() + "'");
}

bool can_run(const std::string& test) {
  if (std::system((test + " >/dev/null 2>&1").c_str()) == 0) return true;
  say_skipped("cannot be run here: " + test);
  return false;
}

}  // namespace

TEST_CASE("GStreamer reads Y4M from a pipe") {
  if (!can_run("gst-inspect-1.0 --exists y4mdec")) return;
  const TinyProject tiny;
  const Run run = run_in(tiny, R"(set -eo pipefail
$SIGS export p.json --out file --container y4m >/dev/null 2>&1
$SIGS export p.json --out - --container y4m 2>/dev/null | gst-launch-1.0 -q fdsrc ! y4mdec ! filesink location=frames.raw)");
  CHECK_MESSAGE(run.status == 0, run.err);
  // The file without its first line and the line before each image.
  std::string file = text_of(tiny.file("file/tiny.y4m"));
  std::string images;
  for (std::size_t at = file.find('\n') + 1; at < file.size(); at += 6 + 64 * 48 * 3 / 2)
    images += file.substr(at + 6, 64 * 48 * 3 / 2);
  CHECK(images.size() == 10 * 64 * 48 * 3 / 2);
  CHECK(text_of(tiny.file("frames.raw")) == images);
}

TEST_CASE("the tracker in the documentation reads every frame and its label") {
  if (!can_run("{ python3 -c 'import numpy' || /usr/bin/python3 -c 'import numpy'; }")) return;
  const TinyProject tiny;
  std::string code;
  std::istringstream page_lines(page("streams.md"));
  for (std::string line; std::getline(page_lines, line);)
    if (!code.empty() || line.starts_with("    import json, os")) {
      if (!line.starts_with("    ")) break;
      code += line.substr(4) + "\n";
    }
  REQUIRE(has(code, "json.loads"));
  write_file(tiny.file("tracker.py"), code);
  const Run run = run_in(tiny,
                         "PATH=$(dirname $SIGS):$PATH; for p in python3 /usr/bin/python3; do $p -c 'import numpy' "
                         "2>/dev/null && exec $p tracker.py p.json 2>err.txt; done");
  CHECK_MESSAGE(run.status == 0, text_of(tiny.file("err.txt")));
  CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 10);
  CHECK(has(run.out, "'pixels'"));
}
