#include "solvers/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "problems/residual.h"
#include "solvers/ssnal.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using problems::SparseMatrix;
using Clock = std::chrono::steady_clock;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Rounding of a sum, as a share of the sum of its terms' sizes: rows have up to tens of terms.
constexpr double kRounding = 4e-15;
// Asymmetry of W above which it is not rounding.
constexpr double kSymmetric = 1e-12;
// Depths at which a strictly feasible velocity is looked for, in units of U.
constexpr double kDepths[] = {0.1, 1e-3, 1e-6};
// A rate this close to its cone, in units of U, is in it: then no proof of the contrary exists.
constexpr double kFeasible = 1e-9;
constexpr double kTolerance = 1e-12;  // of the convex problems, in units of U
constexpr int kSteps = 300;           // of one search for a strictly feasible velocity

Eigen::VectorXd magnitudes(const SparseMatrix& A, const Eigen::VectorXd& x) {
  return A.cwiseAbs() * x.cwiseAbs();
}

// u at r and a bound on the rounding in each of its entries.
void rate_with_rounding(const Problem& problem, const Eigen::VectorXd& r, Eigen::VectorXd& u,
                        Eigen::VectorXd& rounding) {
  if (problem.is_primal()) {
    // Any v will do, so that rounding in v itself does not matter.
    const Eigen::VectorXd v = problem.velocity(r);
    u = problem.H() * v + problem.w();
    rounding = kRounding * (magnitudes(problem.H(), v) + problem.w().cwiseAbs());
  } else {
    u = problem.W() * r + problem.q();
    rounding = kRounding * (magnitudes(problem.W(), r) + problem.q().cwiseAbs());
  }
}

bool in_cone(const Problem& problem, const Eigen::VectorXd& y) {
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const auto part = y.segment(problem.start(i), cone.dim);
    const double radius = (cone.mu - cone.theta) * part(0);
    if (!(part(0) >= 0.0 && problems::tangential_norm(part) <= (1.0 + 1e-15) * radius)) {
      return false;
    }
  }
  return true;
}

bool has_symmetric_delassus(const Problem& problem) {
  return problem.is_primal() || problems::asymmetry(problem.W()) <= kSymmetric;
}

// |H^T y| in the norm of M^-1, rounding added.
double energy(const Problem& problem, const Eigen::VectorXd& y) {
  if (!problem.is_primal()) {
    const double rounding = kRounding * y.cwiseAbs().dot(magnitudes(problem.W(), y));
    return std::sqrt(std::max(0.0, y.dot(problem.W() * y)) + rounding);
  }
  const Eigen::VectorXd b = problem.H().transpose() * y;
  const Eigen::VectorXd rounding =
      kRounding * (SparseMatrix(problem.H().transpose()).cwiseAbs() * y.cwiseAbs());
  // |M^-1| <= M^-1 entry by entry where M is an M-matrix, as the coupled ones of engines are.
  return std::sqrt(std::max(0.0, b.dot(problem.inertia().solve(b)))) +
         std::sqrt(std::max(0.0, rounding.dot(problem.inertia().solve(rounding))));
}

// The data's own velocity, in the norm of M: free motion, and what closes the cones.
double energy_scale(const Problem& problem) {
  const Eigen::VectorXd& offset = problem.is_primal() ? problem.w() : problem.q();
  double sum = problem.is_primal() ? problem.f().dot(problem.inertia().solve(problem.f())) : 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    Eigen::VectorXd closing = -offset.segment(problem.start(i), cone.dim);
    problems::project(cone.mu, closing);
    sum += closing.squaredNorm() / problem.mobility()(i);
  }
  return std::sqrt(sum);
}

// The associated problem with these cones on the rows that `keep` selects, w raised by `offset`.
// U stays the whole problem's.
Problem associated(const Problem& problem, const SparseMatrix& keep, std::vector<Cone> cones,
                   const Eigen::VectorXd& offset) {
  const SparseMatrix spread = keep.transpose();
  if (problem.is_primal()) {
    return Problem({problem.M(), keep * problem.H(), problem.f(), keep * problem.w() + offset},
                   std::move(cones), problem.metadata(), problem.rate_scale());
  }
  return Problem({SparseMatrix(keep * problem.W()) * spread, keep * problem.q() + offset},
                 std::move(cones), problem.metadata(), problem.rate_scale());
}

SparseMatrix identity(int rows) {
  SparseMatrix I(rows, rows);
  I.setIdentity();
  return I;
}

std::unique_ptr<ConvexIteration> pose(const Problem& problem) {
  std::unique_ptr<ConvexIteration> iteration = make_ssnal(problem);
  iteration->pose(Eigen::VectorXd::Zero(problem.cone_count()),
                  Eigen::VectorXd::Zero(problem.rows()));
  return iteration;
}

// u - m e_n in K_mu*.
Problem inner_problem(const Problem& problem, double depth) {
  std::vector<Cone> cones;
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(problem.rows());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    cones.push_back(Cone::associated(cone.dim, cone.mu));
    offset(problem.start(i)) = -depth;
  }
  return associated(problem, identity(problem.rows()), std::move(cones), offset);
}

// The rows that u_n >= (mu - theta) |u_t| speaks of, and their cones.
struct NecessaryRows {
  explicit NecessaryRows(const Problem& problem) {
    std::vector<Eigen::Triplet<double, int>> entries;
    int row = 0;
    for (int i = 0; i < problem.cone_count(); ++i) {
      const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
      const int dim = cone.theta < cone.mu ? cone.dim : 1;
      cones.push_back(Cone::associated(dim, cone.mu - cone.theta));
      for (int k = 0; k < dim; ++k) entries.emplace_back(row++, problem.start(i) + k, 1.0);
    }
    keep.resize(row, problem.rows());
    keep.setFromTriplets(entries.begin(), entries.end());
  }

  std::vector<Cone> cones;
  SparseMatrix keep;
};

// Iterates on an associated problem until its rate is inside the cones by `enough`.
Eigen::VectorXd settle(const Problem& problem, double enough, Clock::time_point deadline) {
  const std::unique_ptr<ConvexIteration> iteration = pose(problem);
  for (int step = 0; step < kSteps && Clock::now() < deadline; ++step) {
    if (interior_margin(problem, iteration->r()) >= enough) break;
    if (iteration->advance(kTolerance) != Iteration::State::kRunning) break;
  }
  return iteration->r();
}

Clock::time_point after(double seconds) {
  constexpr double kYear = 3e7;  // what a duration holds is finite
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::min(seconds, kYear)));
}

Certificate existing(Eigen::VectorXd r, double margin, std::string text) {
  return {Existence::kExists, std::move(r), {}, margin, std::move(text)};
}

std::optional<Certificate> exists_before(const Problem& problem, Clock::time_point deadline) {
  for (const double depth : kDepths) {
    const Problem inner = inner_problem(problem, depth * problem.rate_scale());
    Eigen::VectorXd r = settle(inner, -0.5 * depth, deadline);
    const double margin = interior_margin(problem, r);
    if (margin <= 0.0) continue;
    return existing(
        std::move(r), margin,
        fmt::format("a velocity keeps every rate inside its dual cone by {:.3g} U: a solution "
                    "exists",
                    margin));
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Existence existence) {
  switch (existence) {
    case Existence::kExists:
      return "exists";
    case Existence::kNone:
      return "none";
    case Existence::kUnknown:
      return "unknown";
  }
  return "unknown";
}

double interior_margin(const Problem& problem, const Eigen::VectorXd& r) {
  // The reduced form knows the rate of any velocity only where W is H M^-1 H^T.
  if (!has_symmetric_delassus(problem)) return -kInfinity;
  Eigen::VectorXd u, rounding;
  rate_with_rounding(problem, r, u, rounding);
  double least = kInfinity;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const auto part = u.segment(problem.start(i), cone.dim);
    const auto error = rounding.segment(problem.start(i), cone.dim);
    const double slack = part(0) - cone.mu * problems::tangential_norm(part) - error(0) -
                         cone.mu * problems::tangential_norm(error);
    if (std::isnan(slack)) return -kInfinity;
    least = std::min(least, slack);
  }
  return problem.rate_scale() > 0.0 ? least / problem.rate_scale() : least;
}

double infeasibility_margin(const Problem& problem, const Eigen::VectorXd& y) {
  if (y.size() != problem.rows() || !y.allFinite() || !in_cone(problem, y)) return 0.0;
  if (!has_symmetric_delassus(problem)) return 0.0;
  const Eigen::VectorXd& offset = problem.is_primal() ? problem.w() : problem.q();
  const double closing = -offset.dot(y) - kRounding * offset.cwiseAbs().dot(y.cwiseAbs());
  if (!(closing > 0.0)) return 0.0;
  const double product = energy(problem, y) * energy_scale(problem);
  return product > 0.0 ? closing / product : kInfinity;
}

bool proves_infeasible(const Problem& problem, const Eigen::VectorXd& y) {
  return infeasibility_margin(problem, y) >= kProof;
}

struct InfeasibilitySearch::Parts {
  explicit Parts(const Problem& given)
      : problem(given),
        rows(given),
        spread(rows.keep.transpose()),
        necessary(
            associated(given, rows.keep, rows.cones, Eigen::VectorXd::Zero(rows.keep.rows()))),
        iteration(pose(necessary)) {}

  const Problem& problem;
  NecessaryRows rows;
  SparseMatrix spread;
  Problem necessary;
  std::unique_ptr<ConvexIteration> iteration;
  Eigen::VectorXd proof;
};

InfeasibilitySearch::InfeasibilitySearch(const Problem& problem)
    : parts_(std::make_unique<Parts>(problem)) {}
InfeasibilitySearch::~InfeasibilitySearch() = default;

Iteration::State InfeasibilitySearch::advance() {
  const Eigen::VectorXd& r = parts_->iteration->r();
  const Eigen::VectorXd y = parts_->spread * r;
  if (proves_infeasible(parts_->problem, y)) {
    parts_->proof = y / y.norm();
    return Iteration::State::kInfeasible;
  }
  if (interior_margin(parts_->necessary, r) >= -kFeasible) return Iteration::State::kStalled;
  return parts_->iteration->advance(kTolerance);
}

const Eigen::VectorXd& InfeasibilitySearch::proof() const { return parts_->proof; }
double InfeasibilitySearch::step_work_s() const { return parts_->iteration->step_work_s(); }

Certificate certify(const Problem& problem, double time_limit_s) {
  const Clock::time_point deadline = after(time_limit_s);
  const Problem standard = problem.shifted();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.rows());
  if (problems::evaluate_eta(standard, none) == 0.0) return existing(none, 0.0, "r = 0 solves it");
  if (auto found = exists_before(standard, after(0.5 * time_limit_s))) return *std::move(found);
  InfeasibilitySearch search(standard);
  Iteration::State state = Iteration::State::kRunning;
  while (state == Iteration::State::kRunning && Clock::now() < deadline) state = search.advance();
  if (state == Iteration::State::kInfeasible) {
    const double margin = infeasibility_margin(standard, search.proof());
    return {Existence::kNone,
            {},
            search.proof(),
            margin,
            fmt::format("no solution has velocities below {:.3g} times those of the data", margin)};
  }
  return {Existence::kUnknown,
          {},
          {},
          0.0,
          "neither a strictly feasible velocity nor a proof of infeasibility was found"};
}

}  // namespace conebench::solvers
