#include "results/latex.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/report_blocks.h"
#include "results/report_sections.h"

namespace conebench::results {
namespace {

constexpr auto kPreamble =
    "\\documentclass{article}\n"
    "\\usepackage[T1]{fontenc}\n\\usepackage[utf8]{inputenc}\n"
    "\\usepackage[a4paper,landscape,margin=2cm]{geometry}\n"
    "\\usepackage{booktabs,longtable,pgfplots,textcomp}\n\\pgfplotsset{compat=1.16}\n"
    "\\definecolor{conebench0}{HTML}{0072B2}\\definecolor{conebench1}{HTML}{D55E00}\n"
    "\\definecolor{conebench2}{HTML}{009E73}\\definecolor{conebench3}{HTML}{CC79A7}\n"
    "\\definecolor{conebench4}{HTML}{E69F00}\\definecolor{conebench5}{HTML}{56B4E9}\n"
    "\\definecolor{conebench6}{HTML}{000000}\\definecolor{conebench7}{HTML}{8C6D00}\n"
    "\\setlength{\\parindent}{0pt}\\setlength{\\parskip}{6pt}\\sloppy\n"
    "\\begin{document}\n";

std::string letter(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '^':
      return "\\textasciicircum{}";
    case '~':
      return "\\textasciitilde{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    case '#':
    case '$':
    case '%':
    case '&':
    case '_':
    case '{':
    case '}':
      return std::string("\\") + c;
    default:
      return std::string(1, c);
  }
}

// A run of text between marks; opens and closes \texttt, \emph and \textbf as they come.
std::string line(std::string_view text) {
  std::string out;
  bool code = false, emphasis = false, strong = false;
  const auto toggle = [&out](bool& open, const char* command) {
    out += open ? "}" : command;
    open = !open;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') {
      toggle(code, "\\texttt{");
    } else if (!code && text.substr(i).starts_with("**")) {
      toggle(strong, "\\textbf{");
      ++i;
    } else if (!code && text[i] == '*') {
      toggle(emphasis, "\\emph{");
    } else {
      out += letter(text[i]);
    }
  }
  for (const bool open : {code, emphasis, strong}) {
    if (open) out += "}";
  }
  return out;
}

std::string table(const TextTable& of_cells) {
  const auto& rows = of_cells.rows();
  std::string text = "{\\footnotesize\\begin{longtable}{@{}l" +
                     std::string(rows.front().size() - 1, 'r') + "@{}}\\toprule\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      text += (c == 0 ? "" : " & ") + line(rows[r][c]);
    text += r == 0 ? " \\\\\\midrule\\endhead\n" : " \\\\\n";
  }
  return text + "\\bottomrule\\end{longtable}}\n";
}

std::string block_text(const Block& block) {
  std::string text = fmt::format("\\subsection*{{{}}}\n", line(block.title));
  for (const TextTable& t : block.tables) text += table(t);
  return text + latex_text(block.text) + "\n";
}

std::string figure(const Plot& plot) {
  return "\\begin{center}\n" + latex_plot(plot) + "\\end{center}\n" + latex_text(plot.reading) +
         "\n\n";
}

std::string list(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string text = "\\begin{itemize}\n";
  for (const std::string& sentence : sentences) text += "\\item " + line(sentence) + "\n";
  return text + "\\end{itemize}\n";
}

std::string section_text(const Section& section) {
  std::string text = fmt::format("\\section*{{{}}}\n", line(section.title));
  if (!section.missing.empty()) text += latex_text(section.missing) + "\n";
  for (const Part& part : section.parts) {
    const Block* block = std::get_if<Block>(&part.content);
    text += block ? block_text(*block) : figure(std::get<Plot>(part.content));
  }
  return text;
}

}  // namespace

std::string latex_text(std::string_view text) {
  std::string out;
  bool in_list = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view here = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool item = here.starts_with("- ");
    if (item != in_list) out += item ? "\\begin{itemize}\n" : "\\end{itemize}\n";
    in_list = item;
    out += (item ? "\\item " + line(here.substr(2)) : line(here)) + (text.empty() ? "" : "\n");
  }
  return in_list ? out + "\n\\end{itemize}" : out;
}

std::string latex_report(const ReportInput& input) {
  const auto groups = group_by_settings(input.records);
  std::string text = std::string(kPreamble) +
                     "\\begin{center}\\Large conebench report\\end{center}\n" +
                     latex_text(summary_text(input.records)) + "\n";
  for (const Group& group : groups) {
    const GroupReport report = report_group(group, groups, input);
    text += fmt::format("\\clearpage\\section*{{Verdict: {}}}\n{}\n{}{}", line(report.title),
                        latex_text(report.verdict.sentence), list(report.verdict.facts),
                        list(report.verdict.limits));
    for (const Section& section : report.sections) text += section_text(section);
  }
  return text + block_text(environment_block(input)) + block_text(limits_block()) +
         "\\end{document}\n";
}

}  // namespace conebench::results
