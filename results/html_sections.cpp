#include "results/html_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/hardness.h"
#include "results/html_data.h"
#include "results/html_text.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

constexpr std::size_t kRowsWithoutScript = 40;

// The plots of one id that start at `first`.
std::vector<const Plot*> variants_from(std::span<const Part> parts, std::size_t first) {
  std::vector<const Plot*> variants;
  for (std::size_t i = first; i < parts.size(); ++i) {
    const Plot* plot = std::get_if<Plot>(&parts[i].content);
    if (!plot || (!variants.empty() && plot->id != variants.front()->id)) break;
    variants.push_back(plot);
  }
  return variants;
}

std::string figure(std::span<const Plot* const> variants, const std::string& prefix) {
  const Plot& first = *variants.front();
  std::string html = fmt::format(
      "<figure class=\"plot\" id=\"{0}plot-{1}\" data-plot=\"{1}\">\n<figcaption><h3>{2}</h3>\n"
      "<p class=\"reading\">{3}</p></figcaption>\n<div class=\"drawings\">\n",
      prefix, first.id, html_inline(first.title), html_inline(first.reading));
  for (const Plot* plot : variants) html += svg(*plot, SvgUse::kPage);
  return html + "</div></figure>\n";
}

std::string items(const std::vector<std::string>& sentences) {
  std::string html;
  for (const std::string& sentence : sentences) html += "<li>" + html_inline(sentence) + "</li>\n";
  return html;
}

std::string cell(double time_s, const std::optional<Status>& status) {
  if (std::isfinite(time_s)) return format_time(time_s);
  return status ? fmt::format("*{}*", to_string(*status)) : "not run";
}

}  // namespace

std::string html_verdict(const Verdict& verdict, const std::string& prefix) {
  std::string html = fmt::format(
      "<section id=\"{}verdict\" class=\"verdict\">\n<h2>Verdict</h2>\n"
      "<p class=\"lead\">{}</p>\n",
      prefix, html_inline(verdict.sentence));
  if (!verdict.facts.empty()) html += "<ul class=\"facts\">\n" + items(verdict.facts) + "</ul>\n";
  if (!verdict.limits.empty()) {
    html += "<div class=\"limits\"><h3>Limits of this verdict</h3>\n<ul>\n" +
            items(verdict.limits) + "</ul></div>\n";
  }
  return html + "</section>\n";
}

std::string html_section(const Section& section, const std::string& prefix) {
  std::string html = fmt::format("<section id=\"{}{}\">\n<h2>{}</h2>\n", prefix, section.id,
                                 html_inline(section.title));
  if (!section.missing.empty()) {
    html += "<div class=\"missing\">" + html_paragraphs(section.missing) + "</div>\n";
  }
  for (std::size_t i = 0; i < section.parts.size();) {
    const Part& part = section.parts[i];
    if (const Block* block = std::get_if<Block>(&part.content)) {
      html += part.folded ? html_folded(*block) : html_block(*block);
      ++i;
    } else {
      const auto variants = variants_from(section.parts, i);
      html += figure(variants, prefix);
      i += variants.size();
    }
  }
  return html + "</section>\n";
}

std::string html_problems(const TimeTable& table, const std::string& prefix) {
  std::vector<std::string> header = {"problem", "cones"};
  for (const std::string& solver : table.solvers) header.push_back(tick(solver));
  TextTable hardest(header);
  const auto order = hardest_first(table);
  const std::size_t shown = std::min(order.size(), kRowsWithoutScript);
  for (std::size_t i = 0; i < shown; ++i) {
    const TimeTable::Row& row = table.rows[order[i]];
    std::vector<std::string> cells = {row.problem.name, fmt::format("{}", row.problem.cones)};
    for (std::size_t s = 0; s < row.time_s.size(); ++s) {
      cells.push_back(cell(row.time_s[s], row.status[s]));
    }
    hardest.add(std::move(cells));
  }
  return fmt::format(
      "<section id=\"{}problems\">\n<h2>Problem by problem</h2>\n"
      "<p class=\"reading\">Solver time to a verified eta ≤ {:.0e}, set-up included, residuals "
      "excluded; in place of a failure stands how it ended.</p>\n"
      "<div class=\"problems\">\n<p>The {} hardest of {} problems; all are in results.csv and, "
      "with "
      "scripts, here.</p>\n{}</div>\n</section>\n",
      prefix, table.tol, shown, table.rows.size(), html_table(hardest));
}

nlohmann::json plots_json(std::span<const Section> sections) {
  nlohmann::json plots = nlohmann::json::array();
  for (const Section& section : sections) {
    for (std::size_t i = 0; i < section.parts.size();) {
      const auto variants = variants_from(section.parts, i);
      if (!variants.empty()) plots.push_back(to_json(variants));
      i += std::max<std::size_t>(1, variants.size());
    }
  }
  return plots;
}

}  // namespace conebench::results
