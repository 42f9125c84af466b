#pragma once

#include <string>
#include <string_view>

#include "results/plot.h"
#include "results/report.h"

namespace conebench::results {

/// The report as one LaTeX file with every table and plot (pgfplots, booktabs; any of pdflatex,
/// lualatex, xelatex). Each plot is a tikzpicture of its own, to be lifted into a paper.
std::string latex_report(const ReportInput& input);

/// The words of a Block as LaTeX: `x` is \texttt, *x* is \emph, **x** is \textbf; lists are
/// itemize.
std::string latex_text(std::string_view text);

/// A tikzpicture.
std::string latex_plot(const Plot& plot);

}  // namespace conebench::results
