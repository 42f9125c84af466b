#include "harness/solver_reference.h"

#include <fmt/format.h>

#include <sstream>

#include "harness/parameter_text.h"
#include "harness/refusals.h"

namespace conebench::harness {
namespace {

using solvers::Method;
using solvers::Parameter;

constexpr std::string_view kHead =
    "# Solvers\n\n"
    "Written by `conebench solver reference`; a test compares this file with what it writes. The\n"
    "same, one solver at a time: `conebench solver list`, `conebench solver show NAME`. A variant\n"
    "is a name and values, `gs[local=projection,omega=0.8]`; lists make grids, "
    "`gs[omega=0.8,1.0]`.\n"
    "Equations, costs, stopping tests and limits are in the headers of `solvers/`.\n\n"
    "A *method* solves the problem as posed, a *model* an approximation of it (ranked in a table "
    "of\n"
    "its own), a *peer* is another program. Solvers of yours, `plugin:FILE` and `exec:PROGRAM`:\n"
    "[`add-a-solver.md`](add-a-solver.md).\n\n";

// As a cell of a table, which a bar would end.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string anchor(const std::string& name) {
  std::string link;
  for (const char c : name) {
    if (c != ':') link += c;
  }
  return link;
}

std::string overview(std::span<const Method> methods) {
  std::string text = "| solver | kind | what it is |\n|---|---|---|\n";
  for (const Method& m : methods) {
    text += fmt::format("| [`{}`](#{}) | {} | {} |\n", m.name, anchor(m.name),
                        solvers::to_string(m.kind), cell(m.summary));
  }
  return text;
}

std::string parameters_of(const Method& method) {
  if (method.parameters.empty()) return "No parameters.\n";
  std::string text = "Parameters\n\n";
  for (const Parameter& p : method.parameters) {
    text += fmt::format("- `{}`, {} ({}), default `{}`: {}\n", p.name, type_text(p), range_text(p),
                        value_text(p.fallback), p.doc);
  }
  return text;
}

std::string refusals_text(const Method& method, const std::vector<ProblemKind>& kinds) {
  const std::vector<Refusal> refusals = refusals_of(method, kinds);
  if (refusals.empty()) return "Refuses nothing of the above.\n";
  std::string text = "Refuses\n\n";
  for (const Refusal& r : refusals) {
    text +=
        fmt::format("- {}{}: \"{}\"\n", r.parameter.empty() ? "" : "with `" + r.parameter + "`, ",
                    r.kind, r.reason);
  }
  return text;
}

// Words in lines of at most 100 characters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 100;
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line + "\n";
}

// A summary that begins with the kind says it once.
std::string described(const Method& method) {
  const std::string kind(solvers::to_string(method.kind));
  const bool said = method.summary.starts_with(kind + ": ");
  return fmt::format("A {}: {}.", kind,
                     said ? method.summary.substr(kind.size() + 2) : method.summary);
}

std::string section(const Method& method, const std::vector<ProblemKind>& kinds) {
  std::string text = fmt::format("\n## `{}`\n\n{}", method.name, wrapped(described(method)));
  if (!method.source.empty()) text += "\n" + wrapped("Source: " + method.source + ".");
  return text + "\n" + parameters_of(method) + "\n" + refusals_text(method, kinds);
}

std::string kinds_asked(const std::vector<ProblemKind>& kinds) {
  std::string text =
      "Each was asked, with its defaults and with every other choice of its texts, whether it "
      "takes";
  for (const ProblemKind& kind : kinds) {
    text += (&kind == &kinds.front() ? " " : "; ") + kind.name;
  }
  return "\n" + wrapped(text + ". What it refuses is said in its own words.");
}

}  // namespace

std::string solver_reference(std::span<const Method> methods) {
  const std::vector<ProblemKind> kinds = kinds_of_problems();
  std::string text = std::string(kHead) + overview(methods) + kinds_asked(kinds);
  for (const Method& method : methods) text += section(method, kinds);
  return text;
}

}  // namespace conebench::harness
