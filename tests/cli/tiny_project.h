// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "support/test_data.h"

namespace sigs::test {

// A complete small project in a folder of its own: a few frames of 64x48, a lens, a cube that crosses the view.
class TinyProject {
 public:
  explicit TinyProject(int frames = 10, cv::Size size_px = {64, 48});

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string project() const { return file("p.json").string(); }
  [[nodiscard]] std::string out() const { return file("out").string(); }

  // Replaces a piece of the project file, which must be there.
  void change(const std::string& from, const std::string& to);

  // How many files lie in the output folder; 0 where it is not there.
  [[nodiscard]] int files_out() const;

 private:
  TemporaryFolder folder_;
};

// Where a folder of labels of the tiny project has the image of a frame: "tiny/img1/000001.png". Empty: of this format
// it is not known, or the format is no folder.
//   frame, first_frame  the footage's numbers of it and of the first frame that is exported
[[nodiscard]] std::filesystem::path image_in_labels(std::string_view format, int frame, int first_frame,
                                                    std::string_view extension = ".png");

}  // namespace sigs::test
