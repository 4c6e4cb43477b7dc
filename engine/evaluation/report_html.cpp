// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string_view>

#include "base/text.h"
#include "evaluation/report_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// System colours follow the reader's light or dark scheme; the plots have a white background of their own.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; }
body { margin: 0; background: Canvas; color: CanvasText; font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.5rem; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .4rem; text-align: right; white-space: nowrap; border-bottom: 1px solid color-mix(in srgb, CanvasText 20%, Canvas); }
th:first-child, td:first-child { text-align: left; }
th small { display: block; font-weight: normal; }
td.best { font-weight: bold; }
figure { margin: 1rem 0; padding: .5rem; background: #ffffff; border-radius: .4rem; }
svg { display: block; width: 100%; height: auto; }
footer { margin-top: 2rem; font-size: .85rem; }
)";

std::string html(const std::string& text) {
  return escaped_text(line_text(text), "'");
}

std::string element(const std::string& name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>", name, html(text));
}

std::string table_html(const std::vector<TableColumn>& columns) {
  std::string text = "<div class=\"table\"><table>\n<thead><tr>";
  for (const TableColumn& column : columns)
    text += fmt::format("<th scope=\"col\">{}<small>{}</small></th>", html(column.title), html(column.unit));
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    text += "<tr>";
    for (const TableColumn& column : columns)
      text += (column.is_best[row] ? "<td class=\"best\">" : "<td>") + html(column.cells[row] + mark_of(column, row)) +
              "</td>";
    text += "</tr>\n";
  }
  text += "</tbody>\n</table></div>\n";
  for (const std::string& note : notes_on(columns)) text += element("p", note) + "\n";
  return text;
}

// An SVG image as part of the page.
std::string inlined(const ReportPlot& image) {
  return "<figure>\n" + image.svg + "</figure>\n";
}

std::string list_of(const std::vector<std::string>& lines) {
  std::string text = "<ul>\n";
  for (const std::string& line : lines) text += element("li", line) + "\n";
  return text + "</ul>\n";
}

std::string plots_html(const std::vector<ReportPlot>& images) {
  std::string text = element("h2", "Plots") + "\n";
  for (const ReportPlot& image : images) text += inlined(image);
  return text;
}

std::string page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "{}\n<style>{}</style>\n</head>\n<body>\n<main>\n{}\n{}"
      "<footer>Written by SIGS. Its page docs/evaluation.md defines every figure.</footer>\n"
      "</main>\n</body>\n</html>\n",
      element("title", title), kStyle, element("h1", title), body);
}

std::string clip_text(const TrackReport& report) {
  const FootageTruth& footage = report.footage;
  const bool has_rate = footage.frame_rate_num > 0;
  return fmt::format("{}, {} pixels, frames {} to {}{}. Followed: {}, from frame {}.", footage.video,
                     image_size_text(footage.size_px, " x "), footage.first_frame, footage.last_frame,
                     has_rate ? fmt::format(", {} frames/s", fixed_text(rate_hz(footage), 2)) : "", report.target,
                     report.policy.from_frame);
}

}  // namespace

std::string report_html(const TrackReport& report, const std::vector<ReportPlot>& images) {
  std::string body = element("p", clip_text(report)) + "\n" + table_html(table_of(report));
  if (!report.remarks.empty()) body += element("h2", "Remarks") + "\n" + list_of(report.remarks);
  body += plots_html(images);
  if (!images.empty())
    body += element("p",
                    "In the plots over frames a line stops where nothing is reported; where the ground is grey, "
                    "nothing is scored.") +
            "\n";
  return page("Trackers on " + report.clip,
              body + element("h2", "What is counted") + "\n" + list_of(policies_of(report)));
}

std::string report_html(const DetectionReport& report, const std::vector<ReportPlot>& images) {
  const std::string clips = count_text(std::ssize(report.clips), "film");
  std::string body = table_html(table_of(report));
  for (const std::string& remark : report.remarks) body += element("p", remark + ".") + "\n";
  for (const std::string& reason : uncounted_in(report)) body += element("p", reason + ".") + "\n";
  if (const std::vector<TableColumn> encounters = encounters_of(report); !encounters.front().cells.empty())
    body += element("h2", "Encounters") + "\n" + table_html(encounters);
  return page("Detectors on " + clips, body + plots_html(images) + element("h2", "What is counted") + "\n" +
                                           list_of(policies_of(report)) + element("h2", "Videos") + "\n" +
                                           list_of(report.clips));
}

std::string report_html(const TrackSetReport& report, const std::vector<ReportPlot>& images) {
  const std::string clips = count_text(std::ssize(report.clips), "clip");
  std::vector<std::string> names;
  for (const TrackSetClip& clip : report.clips) names.push_back(clip.name + ": " + clip.target);
  std::string body = table_html(table_of(report)) + "<pre>" + escaped_text(intervals_text(report)) + "</pre>\n" +
                     element("h2", "By what the intruder looks like") + "\n" + table_html(slices_of(report));
  if (!report.remarks.empty()) body += element("h2", "Remarks") + "\n" + list_of(report.remarks);
  return page("Trackers on " + clips, body + plots_html(images) + element("h2", "What is counted") + "\n" +
                                          list_of(policies_of(report)) + element("h2", "Clips") + "\n" +
                                          list_of(names));
}

}  // namespace sigs
