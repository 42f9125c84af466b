#include "solvers/ipopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "problems/residual.h"
#include "solvers/convex.h"
#include "solvers/dimensionless.h"
#include "solvers/ipopt_runs.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using problems::SparseMatrix;
using Entries = std::vector<Eigen::Triplet<double, int>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr int kRunIterations = 300;

// The variables: v, r, then u with p in place of u_n, then s, one entry a cone.
struct Layout {
  int dofs, rows, cones;
  int r() const { return dofs; }
  int u() const { return dofs + rows; }
  int s() const { return dofs + 2 * rows; }
  int size() const { return dofs + 2 * rows + cones; }
};

void append(const SparseMatrix& matrix, double factor, int row, int column, Entries& entries) {
  for (int i = 0; i < matrix.outerSize(); ++i) {
    for (SparseMatrix::InnerIterator it(matrix, i); it; ++it) {
      entries.emplace_back(row + i, column + static_cast<int>(it.col()), factor * it.value());
    }
  }
}

SparseMatrix dynamics(const Problem& problem, const Dimensionless& scaled, const Layout& at) {
  Entries entries;
  for (int i = 0; i < at.cones; ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    if (cone.mu > cone.theta) {
      entries.emplace_back(at.dofs + problem.start(i), at.s() + i, cone.mu - cone.theta);
    }
  }
  for (int k = 0; k < at.rows; ++k) entries.emplace_back(at.dofs + k, at.u() + k, 1.0);
  if (at.dofs > 0) {
    append(scaled.M, 1.0, 0, 0, entries);
    append(SparseMatrix(scaled.H.transpose()), -1.0, 0, at.r(), entries);
    append(scaled.H, -1.0, at.dofs, 0, entries);
  } else {
    append(scaled.W, -1.0, 0, at.r(), entries);
  }
  SparseMatrix A(at.dofs + at.rows, at.size());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

SparseMatrix gap(const Problem& problem, const Layout& at) {
  Entries entries;
  for (int k = 0; k < at.rows; ++k) entries.emplace_back(at.u() + k, at.r() + k, 1.0);
  for (int i = 0; i < at.cones; ++i) {
    const double mu = problem.cones()[static_cast<std::size_t>(i)].mu;
    if (mu > 0.0) entries.emplace_back(at.s() + i, at.r() + problem.start(i), mu);
  }
  SparseMatrix Q(at.size(), at.size());
  Q.setFromTriplets(entries.begin(), entries.end());
  return Q;
}

void constrain(const Cone& cone, int r, int u, int s, ConeProgram& program) {
  program.lower(r) = program.lower(u) = 0.0;
  const int tangents = cone.dim - 1;
  if (tangents > 0 && cone.mu > 0.0) {
    program.lower(s) = 0.0;
    program.cones.push_back({r, r + 1, tangents, cone.mu});
    program.cones.push_back({s, u + 1, tangents, 1.0});
    return;
  }
  program.lower(s) = program.upper(s) = 0.0;
  program.lower.segment(r + 1, tangents).setZero();
  program.upper.segment(r + 1, tangents).setZero();
}

ConeProgram pose(const Problem& problem, const Dimensionless& scaled, const Layout& at) {
  ConeProgram program{.Q = gap(problem, at),
                      .c = Eigen::VectorXd::Zero(at.size()),
                      .A = dynamics(problem, scaled, at),
                      .b = Eigen::VectorXd(at.dofs + at.rows),
                      .lower = Eigen::VectorXd::Constant(at.size(), -kInfinity),
                      .upper = Eigen::VectorXd::Constant(at.size(), kInfinity),
                      .eps = kIpoptEps};
  program.b.head(at.dofs) = scaled.f;
  program.b.tail(at.rows) = at.dofs > 0 ? scaled.w : scaled.q;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int start = problem.start(i);
    constrain(problem.cones()[static_cast<std::size_t>(i)], at.r() + start, at.u() + start,
              at.s() + i, program);
  }
  return program;
}

class OneShot {
 public:
  OneShot(const Problem& problem, const Stop& stop, Monitor& monitor)
      : problem_(problem),
        stop_(stop),
        monitor_(monitor),
        scaled_(problem),
        at_{problem.is_primal() ? problem.dofs() : 0, problem.rows(), problem.cone_count()},
        program_(pose(problem, scaled_, at_)) {}

  Result solve(Eigen::VectorXd guess) {
    result_.r = std::move(guess);
    monitor_.setup_done();
    if (verified()) {
      result_.status = Status::kConverged;
    } else if (monitor_.check(0, result_.r) == Verdict::kStop) {
      result_.status = monitor_.status();
    } else {
      result_.status = run();
    }
    return std::move(result_);
  }

 private:
  Status run() {
    ProgramPoint point{start(result_.r)};
    IpoptRuns runs(kRunIterations);
    runs.aim_at(stop_.tol);
    while (!runs.over()) {
      if (run_once(runs, point) == IpoptEnd::kStopped) return monitor_.status();
      if (verified()) return Status::kConverged;
    }
    return monitor_.conclude(Status::kStalled, result_.iterations, result_.r);
  }

  IpoptEnd run_once(IpoptRuns& runs, ProgramPoint& point) {
    bool started = false;
    const IpoptEnd end = runs.run(program_, point, [&](const Eigen::VectorXd& x) {
      if (!std::exchange(started, true)) return true;  // where the last run ended
      read_reactions(x);
      return monitor_.check(++result_.iterations, result_.r) == Verdict::kGoOn;
    });
    if (end != IpoptEnd::kStopped) read_reactions(point.x);
    note(point.x);
    return end;
  }

  bool verified() const {
    return stop_.test == StopTest::kOwn && problems::evaluate_eta(problem_, result_.r) <= stop_.tol;
  }

  Eigen::VectorXd start(const Eigen::VectorXd& r) const {
    Eigen::VectorXd x(at_.size());
    if (at_.dofs > 0) x.head(at_.dofs) = problem_.velocity(r).cwiseQuotient(scaled_.velocity);
    x.segment(at_.r(), at_.rows) = r.cwiseQuotient(scaled_.force);
    x.segment(at_.u(), at_.rows) = problem_.rate(r).cwiseQuotient(scaled_.rate);
    for (int i = 0; i < at_.cones; ++i) {
      const Cone& cone = problem_.cones()[static_cast<std::size_t>(i)];
      const int u = at_.u() + problem_.start(i);
      const double s = x.segment(u + 1, cone.dim - 1).norm();
      x(at_.s() + i) = s;
      x(u) -= (cone.mu - cone.theta) * s;
    }
    return x;
  }

  void read_reactions(const Eigen::VectorXd& x) {
    result_.r = x.segment(at_.r(), at_.rows).cwiseProduct(scaled_.force);
    project_on_cones(problem_, result_.r);
  }

  // The gap per cone, in units of U^2 / max lambda.
  void note(const Eigen::VectorXd& x) {
    const double unit = Dimensionless::kRateScale * Dimensionless::kRateScale;
    const double gap = x.dot(program_.Q * x) / (unit * std::max(at_.cones, 1));
    result_.notes = {fmt::format("De Saxce gap {:.1e} a cone, eps {:.0e} U", gap,
                                 kIpoptEps / Dimensionless::kRateScale)};
  }

  const Problem& problem_;
  Stop stop_;
  Monitor& monitor_;
  Dimensionless scaled_;
  Layout at_;
  ConeProgram program_;
  Result result_;
};

}  // namespace

Method ipopt() {
  Method method{.name = "ipopt",
                .kind = Kind::kMethod,
                .summary = "Ipopt on the De Saxce gap: the whole problem as one smooth program",
                .source =
                    "Ipopt: Waechter, Biegler, Math. Program. 106(1) (2006) 25-57; cones: "
                    "Vanderbei, Yurttan (1998) (neither checked)",
                .parameters = {},
                .make = {}};
  method.make = [method](const Values& values) {
    auto run = [](const Problem& problem, const Stop& stop, Eigen::VectorXd guess,
                  Monitor& monitor) {
      return OneShot(problem, stop, monitor).solve(std::move(guess));
    };
    return make_checked_solver(method, values, refuse_zero_delassus, run);
  };
  return method;
}

}  // namespace conebench::solvers
