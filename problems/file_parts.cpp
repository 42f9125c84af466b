#include "problems/file_parts.h"

#include "problems/error.h"
#include "problems/residual.h"

namespace conebench::problems {

Problem make_problem(const std::string& subject, const std::function<Problem()>& make) {
  try {
    return make();
  } catch (const InputError& error) {
    std::string detail = error.what();
    const std::string prefix = error.subject() + ": ";
    if (detail.starts_with(prefix)) detail.erase(0, prefix.size());
    throw InputError(subject, detail);
  }
}

std::optional<double> read_rate_scale(const hdf5::Reader& reader) {
  if (!reader.has_attribute("/", "rate_scale")) return {};
  const double value = reader.number("/", "rate_scale");
  if (value < 0.0) reader.fail("/", "has a negative rate_scale, expected >= 0");
  return value;
}

void write_rate_scale(hdf5::Writer& writer, const Problem& problem) {
  if (problem.rate_scale_is_of_data()) return;
  writer.attribute("/", "rate_scale", problem.rate_scale());
}

void write_solution(hdf5::Writer& writer, const Problem& problem, const Solution& solution) {
  require(solution.r.size() == problem.rows(), problem.name(), "the solution has ",
          solution.r.size(), " entries, expected ", problem.rows());
  const Problem standard = problem.shifted();
  writer.group("/solution");
  writer.array("/solution/r", solution.r);
  writer.array("/solution/u", solution.u.size() > 0 ? solution.u : standard.rate(solution.r));
  if (problem.is_primal()) {
    writer.array("/solution/v", solution.v.size() > 0 ? solution.v : standard.velocity(solution.r));
  }
  writer.attribute("/solution", "shifted", std::int64_t{1});
  writer.attribute("/solution", "eta", solution.eta);
}

std::optional<Solution> read_solution(const hdf5::Reader& reader, const Problem& problem) {
  if (!reader.has("/solution/r")) return {};
  Solution solution;
  solution.r = reader.vector("/solution/r", problem.rows());
  // Foreign files hold zeros where there is no solution; ours says what it means.
  const bool foreign = !reader.has_attribute("/solution", "shifted");
  if (foreign && solution.r.isZero(0.0)) return {};
  if (!foreign && reader.whole_number("/solution", "shifted") == 0) {
    solution.r += problem.tip_shift();
  }
  if (reader.has("/solution/u")) solution.u = reader.vector("/solution/u", problem.rows());
  if (problem.is_primal() && reader.has("/solution/v")) {
    solution.v = reader.vector("/solution/v", problem.dofs());
  }
  solution.eta = reader.has_attribute("/solution", "eta")
                     ? reader.number("/solution", "eta")
                     : evaluate_eta(problem.shifted(), solution.r);
  return solution;
}

std::span<const int> begins(const SparseMatrix& matrix) {
  return {matrix.outerIndexPtr(), static_cast<std::size_t>(matrix.outerSize()) + 1};
}

std::span<const int> inner_indices(const SparseMatrix& matrix) {
  return {matrix.innerIndexPtr(), static_cast<std::size_t>(matrix.nonZeros())};
}

std::span<const double> values(const SparseMatrix& matrix) {
  return {matrix.valuePtr(), static_cast<std::size_t>(matrix.nonZeros())};
}

}  // namespace conebench::problems
