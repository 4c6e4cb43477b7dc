// SPDX-License-Identifier: MIT
#include "evaluation/results_text.h"

#include "evaluation/report_numbers.h"

namespace sigs {

std::string csv_text(const Results& results) {
  std::string text = "frame,x,y,width,height,score,track\n";
  for (const auto& [frame, boxes] : results.frames)
    for (const ReportedBox& reported : boxes) {
      text += std::to_string(frame);
      // The file counts pixels: x is the first column covered.
      for (const double number :
           {reported.box.x + 0.5, reported.box.y + 0.5, reported.box.width, reported.box.height, reported.score})
        text.append(",").append(exact_text(number));
      text.append(",").append(std::to_string(reported.track)).append("\n");
    }
  return text;
}

}  // namespace sigs
