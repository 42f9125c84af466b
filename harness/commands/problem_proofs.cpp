#include "harness/commands/problem_proofs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "harness/interrupt.h"
#include "harness/pool.h"
#include "harness/worker.h"
#include "problems/load.h"
#include "problems/spectrum.h"
#include "results/text.h"
#include "solvers/certificate.h"

namespace conebench::harness {
namespace {

Json find_existence(const std::string& file, double time_limit_s) {
  const solvers::Certificate found =
      solvers::certify(problems::load_problem(file).problem, time_limit_s);
  return {{"existence", solvers::to_string(found.verdict)},
          {"existence_margin", found.margin},
          {"existence_text", found.text}};
}

Json find_rank(const std::string& file, double) {
  const problems::SpectrumAnswer answer = problems::spectrum(problems::load_problem(file).problem);
  if (!answer.spectrum) return {{"rank_missing", answer.reason}};
  return {{"rank", answer.spectrum->rank},
          {"null_space", answer.spectrum->null_space},
          {"condition", answer.spectrum->condition}};
}

// What is found out of each problem beside its features, and by whom. Each in a process of its own:
// memory and time are only known afterwards.
struct Finding {
  Json (*find)(const std::string& file, double time_limit_s);
  const char* missing;  // key of the reason why there is nothing
  const char* time;     // key of the time of the whole process
};
constexpr std::array kFindings{Finding{find_existence, "existence_text", "existence_s"},
                               Finding{find_rank, "rank_missing", "rank_s"}};

Json nothing_found(const Json& facts) {
  return {{"path", facts.at("path")}, {"content_sha256", facts.at("content_sha256")},
          {"existence", "unknown"},   {"existence_margin", nullptr},
          {"existence_text", ""},     {"rank", nullptr},
          {"null_space", nullptr},    {"condition", nullptr},
          {"rank_missing", ""}};
}

void add_finding(const Finding& finding, const ChildOutcome& outcome, Json& proof) {
  Json found = Json::parse(outcome.output, nullptr, false);
  if (found.is_discarded()) {
    found = {{finding.missing, "ended without an answer: " + describe_end(outcome)}};
  }
  proof.update(found);
  proof[finding.time] = outcome.wall_s;
}

// One line of a table whose first column is as wide as `width`.
void print_proof_row(std::size_t width, const std::array<std::string, 7>& cells) {
  fmt::print("{:<{}}  {:<8}  {:>6}  {:>10}  {:>9}  {:>8}  {}\n", cells[0], width, cells[1],
             cells[2], cells[3], cells[4], cells[5], cells[6]);
  std::fflush(stdout);
}

void print_proof(std::size_t width, const Json& proof) {
  const bool ranked = proof["rank"].is_number();
  const double time_s = proof["existence_s"].get<double>() + proof["rank_s"].get<double>();
  const std::string no_rank = text_of(proof["rank_missing"]);
  print_proof_row(
      width, {text_of(proof["path"]), text_of(proof["existence"]),
              ranked ? text_of(proof["rank"]) : "-", ranked ? text_of(proof["null_space"]) : "-",
              ranked ? fmt::format("{:.2e}", proof["condition"].get<double>()) : "-",
              results::format_time(time_s),
              text_of(proof["existence_text"]) + (ranked ? "" : "; no rank: " + no_rank)});
}

}  // namespace

Json prove_all(const std::vector<Json>& entries, double time_limit_s, bool quiet, int& exit_code) {
  std::size_t width = 0;
  for (const Json& entry : entries) width = std::max(width, text_of(entry.at("path")).size());
  if (!quiet) {
    print_proof_row(width,
                    {"problem", "solution", "rank", "null space", "condition", "time", "because"});
  }
  Json proofs = Json::array();
  const auto make = [&](std::size_t i) -> Job {
    const auto find = kFindings[i % kFindings.size()].find;
    const std::string file = text_of(entries[i / kFindings.size()].at("path"));
    return {.work = [=] { return dumped(find(file, time_limit_s), -1); },
            .limits = {.wall_s = default_hard_limit_s(time_limit_s)}};
  };
  const auto done = [&](std::size_t i, const ChildOutcome& outcome) {
    const std::size_t which = i % kFindings.size();
    if (which == 0) proofs.push_back(nothing_found(entries[i / kFindings.size()]));
    add_finding(kFindings[which], outcome, proofs.back());
    if (which + 1 == kFindings.size() && !quiet) print_proof(width, proofs.back());
  };
  if (!run_pool(kFindings.size() * entries.size(), 1, {.make = make, .done = done, .tick = {}})) {
    exit_code = kInterruptedExit;
  }
  return proofs;
}

}  // namespace conebench::harness
