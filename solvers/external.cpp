#include "solvers/external.h"

#include <fmt/format.h>
#include <linux/close_range.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "problems/error.h"
#include "problems/problem_file.h"
#include "solvers/forked.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr int kClaims = 0, kDoesNotClaim = 1, kNotStarted = 127;

// A folder that nobody else may read, for as long as this lives.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "conebench-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw problems::OutputError(name, std::strerror(errno));
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

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
  Eigen::VectorXd r;
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
            problems::read_solution_r(file, rows)};
  } catch (const problems::InputError& error) {
    return {Status::kDiverged, {}, error.what()};
  }
}

Result iterate(const std::string& program, const Problem& problem, const Stop& stop,
               const Eigen::VectorXd& guess, Monitor& monitor) {
  const PrivateFolder folder;
  const auto posed = folder.path() / "problem.h5", solved = folder.path() / "solution.h5";
  problems::write_external_problem(posed, problem, guess);
  monitor.setup_done();
  const double left_s = stop.time_limit_s - monitor.setup_s();
  const ProcessEnd end = run_forked(
      [&] {
        return execute({program, posed, solved, "--tol", fmt::format("{}", stop.tol),
                        "--time-limit", fmt::format("{}", left_s)});
      },
      left_s);

  Answer answer = read_answer(end, solved, problem.rows());
  // What it claims counts only where its own test decides.
  if (answer.status == Status::kConverged && stop.test == StopTest::kCommon) {
    answer.status = Status::kStalled;
  }
  Result result;
  const bool has_answer = answer.trouble.empty();
  result.r = has_answer ? std::move(answer.r) : guess;
  result.status = has_answer ? monitor.conclude(answer.status, 0, result.r) : answer.status;
  if (!has_answer) result.notes.push_back(program + ": " + answer.trouble);
  return result;
}

}  // namespace

Solver make_external_solver(const std::string& variant) {
  const std::string program = variant.substr(kExternalPrefix.size());
  problems::require(
      std::filesystem::is_regular_file(program) && ::access(program.c_str(), X_OK) == 0, variant,
      "'", program, "' is no executable file");
  const std::string path = std::filesystem::absolute(program).string();
  const Method method{.name = variant,
                      .kind = Kind::kPeer,
                      .summary = "a program of its own",
                      .parameters = {},
                      .make = {}};
  return make_checked_solver(
      method, {}, [](const Problem&) { return std::optional<std::string>(); },
      [path](const Problem& problem, const Stop& stop, const Eigen::VectorXd& guess,
             Monitor& monitor) { return iterate(path, problem, stop, guess, monitor); });
}

}  // namespace conebench::solvers
