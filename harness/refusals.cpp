#include "harness/refusals.h"

#include "problems/made_backwards.h"

namespace conebench::harness {
namespace {

using problems::Cone;
using problems::Problem;
using problems::Recipe;
using problems::SparseMatrix;

constexpr int kManyCones = 2334;  // 7002 rows: above every limit of a solver of ours

Problem made(const Recipe& recipe) { return problems::make_backwards(recipe).problem; }

SparseMatrix identity(int size) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return I;
}

// Each dof held to the next one.
SparseMatrix chain(int size) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int k = 0; k < size; ++k) {
    entries.emplace_back(k, k, 3.0);
    if (k == 0) continue;
    entries.emplace_back(k, k - 1, -1.0);
    entries.emplace_back(k - 1, k, -1.0);
  }
  SparseMatrix M(size, size);
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

// Contacts that pull one dof each.
Problem contacts(const SparseMatrix& M) {
  const int rows = static_cast<int>(M.rows());
  return {problems::PrimalData{M, identity(rows), Eigen::VectorXd::Constant(rows, -1.0),
                               Eigen::VectorXd::Zero(rows)},
          std::vector<Cone>(static_cast<std::size_t>(rows / 3), Cone::coulomb(3, 0.5)),
          {}};
}

// A contact that no body feels.
Problem zero_delassus() {
  return {problems::PrimalData{identity(3), SparseMatrix(3, 3), Eigen::Vector3d::Zero(),
                               Eigen::Vector3d(-1.0, 0.5, 0.0)},
          {Cone::coulomb(3, 0.5)},
          {}};
}

// The solver's answer, or nothing where it takes the problem.
std::string reason(const solvers::Solver& solver, const Problem& problem) {
  return solver.refuses(problem).value_or("");
}

std::string variant(const std::string& method, const std::string& parameter) {
  return parameter.empty() ? method : method + "[" + parameter + "]";
}

void ask(const solvers::Method& method, const std::string& parameter,
         const std::vector<ProblemKind>& kinds, std::vector<std::string>& usual,
         std::vector<Refusal>& refusals) {
  const solvers::Solver solver = solvers::make_solver(variant(method.name, parameter));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::string why = reason(solver, kinds[k].problem);
    if (!why.empty() && why != usual[k]) refusals.push_back({kinds[k].name, parameter, why});
    if (parameter.empty()) usual[k] = why;
  }
}

}  // namespace

std::vector<ProblemKind> kinds_of_problems() {
  return {{"cones of d = 1", made({.dims = {1}})},
          {"cones of d = 2", made({.dims = {2}})},
          {"cones of d = 3", made({.dims = {3}})},
          {"cones of d = 6", made({.dims = {6}})},
          {"cones of different d", made({.dims = {3, 2}})},
          {"theta below mu", made({.theta_share = 0.5})},
          {"the reduced form (W, q)", made({.reduced = true})},
          {"an M that couples many dofs", contacts(chain(60))},
          {"W = 0", zero_delassus()},
          {"7002 rows", contacts(identity(3 * kManyCones))},
          {"7002 rows and an M that couples many dofs", contacts(chain(3 * kManyCones))}};
}

std::vector<Refusal> refusals_of(const solvers::Method& method,
                                 const std::vector<ProblemKind>& kinds) {
  std::vector<Refusal> refusals;
  std::vector<std::string> usual(kinds.size());
  ask(method, "", kinds, usual, refusals);
  for (const solvers::Parameter& parameter : method.parameters) {
    for (const std::string& choice : parameter.choices) {
      if (choice == std::get<std::string>(parameter.fallback)) continue;
      ask(method, parameter.name + "=" + choice, kinds, usual, refusals);
    }
  }
  return refusals;
}

}  // namespace conebench::harness
