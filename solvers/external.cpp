#include "solvers/external.h"

#include <fmt/format.h>
#include <linux/close_range.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "problems/error.h"
#include "problems/private_folder.h"
#include "problems/problem_file.h"
#include "solvers/forked.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr int kClaims = 0, kDoesNotClaim = 1, kNotStarted = 127;

// Replaces this (child) process by the program; its stderr is ours.
int execute(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  ::execv(arguments[0], arguments.data());
  return kNotStarted;
}

// What the program says of itself, in words where it says nothing good.
struct Answer {
  Status status = Status::kDiverged;
  problems::ForeignAnswer solution{};
  std::string trouble{};
};

Answer read_answer(const ProcessEnd& end, const std::filesystem::path& file, Eigen::Index rows) {
  if (end.timed_out) return {Status::kTimeLimit, {}, describe(end)};
  if (end.exit_code == kNotStarted) {
    return {Status::kDiverged, {}, "exit code 127: it, or what it calls, could not be started"};
  }
  if (end.signal != 0 || (end.exit_code != kClaims && end.exit_code != kDoesNotClaim)) {
    return {Status::kDiverged, {}, describe(end) + ", expected exit code 0 or 1"};
  }
  if (!std::filesystem::exists(file)) {
    return {Status::kDiverged, {}, describe(end) + " without a solution file"};
  }
  try {
    return {end.exit_code == kClaims ? Status::kConverged : Status::kStalled,
            problems::read_foreign_answer(file, rows)};
  } catch (const problems::InputError& error) {
    return {Status::kDiverged, {}, error.what()};
  }
}

// The program and what its variant adds to every call.
struct Program {
  std::string path;
  std::vector<std::string> extra_words;
};

Result iterate(const Program& program, const Problem& problem, const Stop& stop,
               const Eigen::VectorXd& guess, Monitor& monitor) {
  const problems::PrivateFolder folder;
  const auto posed = folder.path() / "problem.h5", solved = folder.path() / "solution.h5";
  problems::write_external_problem(posed, problem, guess);
  monitor.setup_done();
  const double left_s = stop.time_limit_s - monitor.setup_s();
  std::vector<std::string> words{program.path,
                                 posed,
                                 solved,
                                 "--tol",
                                 fmt::format("{}", stop.tol),
                                 "--time-limit",
                                 fmt::format("{}", left_s)};
  words.insert(words.end(), program.extra_words.begin(), program.extra_words.end());
  const ProcessEnd end = run_forked([&] { return execute(std::move(words)); }, left_s);

  Answer answer = read_answer(end, solved, problem.rows());
  // What it claims counts only where its own test decides.
  if (answer.status == Status::kConverged && stop.test == StopTest::kCommon) {
    answer.status = Status::kStalled;
  }
  Result result;
  const bool has_answer = answer.trouble.empty();
  result.r = has_answer ? std::move(answer.solution.r) : guess;
  result.iterations = answer.solution.iterations;
  result.status =
      has_answer ? monitor.conclude(answer.status, result.iterations, result.r) : answer.status;
  if (!has_answer) result.notes.push_back(program.path + ": " + answer.trouble);
  return result;
}

std::vector<std::string> words_of(const std::string& variant,
                                  const std::map<std::string, std::string>& values) {
  std::vector<std::string> words;
  for (const auto& [key, value] : values) {
    problems::require(key != "tol" && key != "time-limit", variant, "'", key,
                      "' is an option of the protocol, expected a parameter of the program");
    words.push_back("--" + key);
    words.push_back(value);
  }
  return words;
}

Solver make_one(const std::string& variant, const Program& program) {
  const Method method{.name = variant,
                      .kind = Kind::kPeer,
                      .summary = "a program of its own",
                      .parameters = {},
                      .make = {}};
  Solver solver = make_checked_solver(
      method, {}, [](const Problem&) { return std::optional<std::string>(); },
      [program](const Problem& problem, const Stop& stop, const Eigen::VectorXd& guess,
                Monitor& monitor) { return iterate(program, problem, stop, guess, monitor); });
  solver.program = program.path;
  return solver;
}

}  // namespace

std::vector<Solver> make_external_solvers(const VariantText& variants) {
  const std::string program = variants.name.substr(kExternalPrefix.size());
  problems::require(
      std::filesystem::is_regular_file(program) && ::access(program.c_str(), X_OK) == 0,
      variants.name, "'", program, "' is no executable file");
  std::vector<Solver> solvers;
  for (const auto& values : variants.combinations()) {
    const std::string name = variant_text(variants.name, values);
    solvers.push_back(make_one(name, {std::filesystem::absolute(program), words_of(name, values)}));
  }
  return solvers;
}

}  // namespace conebench::solvers
