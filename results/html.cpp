#include "results/html.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <nlohmann/json.hpp>

#include "results/html_data.h"
#include "results/html_sections.h"
#include "results/html_text.h"
#include "results/report_blocks.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

using nlohmann::json;

// What a Content-Security-Policy names an inline script or style by.
std::string source_hash(std::string_view text) {
  std::array<unsigned char, 32> digest{};
  EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  std::array<unsigned char, 45> letters{};
  EVP_EncodeBlock(letters.data(), digest.data(), static_cast<int>(digest.size()));
  return fmt::format("'sha256-{}'", reinterpret_cast<const char*>(letters.data()));
}

std::string head(const PageFiles& files, bool with_view) {
  std::string scripts = source_hash(files.script);
  if (with_view) scripts += " " + source_hash(files.view);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; "
      "style-src {}; img-src data:; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>conebench report</title>\n<style>{}</style>\n</head>\n",
      scripts, source_hash(files.style), files.style);
}

struct Link {
  std::string id, title;
};

// Those of the sections of the first group; the script points them to the group that is shown.
std::string navigation(const GroupReport& first, bool has_problems) {
  std::vector<Link> links = {{"verdict", "Verdict"}};
  for (const Section& section : first.sections) links.push_back({section.id, section.title});
  if (has_problems) links.push_back({"problems", "Problem by problem"});
  std::string html = "<nav aria-label=\"Sections\"><ol>\n";
  for (const Link& link : links) {
    html += fmt::format("<li><a href=\"#g0-{0}\" data-section=\"{0}\">{1}</a></li>\n", link.id,
                        html_inline(link.title));
  }
  return html +
         "<li><a href=\"#views\">A problem in space</a></li>\n"
         "<li><a href=\"#environment\">Environment</a></li>\n"
         "<li><a href=\"#limits\">Known limits</a></li>\n</ol></nav>\n";
}

std::string top(const ReportInput& input, std::span<const GroupReport> reports) {
  std::string html = fmt::format(
      "<header class=\"top\">\n<div><h1>conebench report</h1>\n<p>{}</p></div>\n"
      "<div class=\"controls\">",
      html_inline(summary_text(input.records)));
  if (reports.size() > 1) {
    html += "<label class=\"scripted\">Rules <select id=\"group\">";
    for (std::size_t g = 0; g < reports.size(); ++g) {
      html += fmt::format("<option value=\"{}\">{}</option>", g, escaped(reports[g].title));
    }
    html += "</select></label>";
  }
  return html +
         "<button type=\"button\" id=\"theme\" class=\"scripted\">Dark</button></div>\n"
         "</header>\n";
}

std::string views_section(const ReportInput& input) {
  std::string html = "<section id=\"views\">\n<h2>A problem in space</h2>\n";
  if (input.views.empty()) {
    return html + "<div class=\"missing\"><p>" + escaped(input.no_views) +
           "</p></div>\n</section>\n";
  }
  html +=
      "<p class=\"reading\">The hardest problems of the campaign whose files are at hand, "
      "solved anew for this page. Colours and numbers are of the answer that is chosen, as "
      "eta judges it.</p>\n<div class=\"views\"><noscript><p>The view in space needs "
      "scripts. It holds:</p><ul>\n";
  for (const ProblemView& view : input.views) {
    html += fmt::format("<li>{}: {} cones</li>\n", escaped(view.name), view.cohesive.size());
  }
  html += "</ul></noscript></div>\n";
  if (!input.no_views.empty()) html += "<p class=\"reading\">" + escaped(input.no_views) + "</p>\n";
  return html + "</section>\n";
}

std::string section_of(const char* id, Block block) {
  std::string html =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", id, html_inline(block.title));
  return html + html_paragraphs(block.text) + "</section>\n";
}

// What is shown, and what the script reads, of all groups.
struct Body {
  std::string main;
  json data = {{"groups", json::array()}, {"views", json::array()}};

  void add(std::size_t index, const Group& group, const GroupReport& report, bool alone) {
    const std::string prefix = fmt::format("g{}-", index);
    main += fmt::format("<article class=\"group\" id=\"g{}\">\n", index);
    if (!alone) main += fmt::format("<p class=\"rules\">{}</p>\n", escaped(report.title));
    main += html_verdict(report.verdict, prefix);
    for (const Section& section : report.sections) main += html_section(section, prefix);
    json of_group = {{"title", report.title}, {"plots", plots_json(report.sections)}};
    if (!group.methods.empty()) {
      const TimeTable table = make_time_table(group.methods, group.settings.tol);
      main += html_problems(table, prefix);
      of_group["problems"] = problems_json(table, group.methods);
    }
    data["groups"].push_back(std::move(of_group));
    main += "</article>\n";
  }
};

std::string scripts(const PageFiles& files, const json& data, bool with_view) {
  const auto replace = json::error_handler_t::replace;
  std::string html = fmt::format("<script type=\"text/plain\" id=\"data\">{}</script>\n",
                                 packed(data.dump(-1, ' ', false, replace)));
  html += fmt::format("<script>{}</script>\n", files.script);
  return with_view ? html + fmt::format("<script>{}</script>\n", files.view) : html;
}

}  // namespace

std::string html_report(const ReportInput& input, const PageFiles& files) {
  const auto groups = group_by_settings(input.records);
  std::vector<GroupReport> reports;
  for (const Group& group : groups) reports.push_back(report_group(group, groups, input));
  Body body;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    body.add(g, groups[g], reports[g], groups.size() == 1);
  }
  for (const ProblemView& view : input.views) body.data["views"].push_back(to_json(view));

  const bool with_view = !input.views.empty();
  return head(files, with_view) + "<body>\n" + top(input, reports) + "<div class=\"layout\">\n" +
         navigation(reports.front(), !groups.front().methods.empty()) + "<main>\n" + body.main +
         views_section(input) + section_of("environment", environment_block(input)) +
         section_of("limits", limits_block()) + "</main>\n</div>\n" +
         scripts(files, body.data, with_view) + "</body>\n</html>\n";
}

}  // namespace conebench::results
