// SPDX-License-Identifier: MIT
#include "evaluation/report.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/staged_outputs.h"
#include "evaluation/gnuplot.h"
#include "evaluation/report_files.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> kFiles{"summary.csv", "frames.csv", "encounters.csv", "evaluation.json",
                                                 "report.html"};
constexpr std::array<std::string_view, 8> kPlotNames{"center_error", "x_error",       "y_error",
                                                     "precision",    "success",       "normalized_precision",
                                                     "first_range",  "detection_rate"};

// Files that are there are replaced.
class ReportFolder {
 public:
  explicit ReportFolder(fs::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] Result<void> put(const std::string& name, const std::string& text) {
    const Result<void> written = write_text(folder_ / name, text, true);
    if (written) report_.files.push_back(folder_ / name);
    return written;
  }

  // An image that cannot be drawn is a warning; where gnuplot is not there, one is enough. "": none.
  [[nodiscard]] Result<std::string> draw(const Plot& plot, PlotFormat kind) {
    if (!has_gnuplot_) return std::string();
    const std::string name = plot.name + (kind == PlotFormat::svg ? ".svg" : ".png");
    Result<std::string> image = gnuplot_output(gnuplot_program(plot, kind));
    if (!image) {
      has_gnuplot_ = image.error().kind != ErrorKind::unavailable;
      report_.warnings.push_back({has_gnuplot_ ? name : "plots", image.error().text()});
      return std::string();
    }
    if (const Result<void> written = put(name, *image); !written) return fail(written.error());
    return image;
  }

  [[nodiscard]] Result<std::vector<ReportPlot>> render_all(const std::vector<Plot>& plots) {
    std::vector<ReportPlot> images;
    for (const Plot& plot : plots) {
      Result<std::string> svg = draw(plot, PlotFormat::svg);
      if (!svg) return fail(svg.error());
      if (const Result<std::string> png = draw(plot, PlotFormat::png); !png) return fail(png.error());
      if (!svg->empty()) images.push_back({plot.name, plot.title, std::move(*svg)});
    }
    return images;
  }

  [[nodiscard]] WrittenReport written() { return std::move(report_); }

 private:
  fs::path folder_;
  WrittenReport report_;
  bool has_gnuplot_ = true;
};

template <class Report>
Result<WrittenReport> write_all(const fs::path& folder, const Report& report, const std::string& details_name,
                                const std::string& details) {
  ReportFolder out(folder);
  Result<void> step = out.put("summary.csv", summary_csv(report));
  if (step) step = out.put(details_name, details);
  if (step) step = out.put("evaluation.json", evaluation_json(report));
  if (!step) return fail(step.error());
  const Result<std::vector<ReportPlot>> images = out.render_all(plots_of(report));
  if (!images) return fail(images.error());
  if (step = out.put("report.html", report_html(report, *images)); !step) return fail(step.error());
  return out.written();
}

}  // namespace

Result<WrittenReport> write_report(const fs::path& folder, const TrackReport& report) {
  return write_all(folder, report, "frames.csv", frames_csv(report));
}

Result<WrittenReport> write_report(const fs::path& folder, const DetectionReport& report) {
  return write_all(folder, report, "encounters.csv", encounters_csv(report));
}

bool is_report_file(const std::string& name) {
  if (std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end()) return true;
  return (name.ends_with(".svg") || name.ends_with(".png")) &&
         std::find(kPlotNames.begin(), kPlotNames.end(), name.substr(0, name.size() - 4)) != kPlotNames.end();
}

}  // namespace sigs
