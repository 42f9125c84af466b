#include "solvers/gs.h"

#include <tuple>

#include "problems/residual.h"
#include "solvers/blocked_rows.h"
#include "solvers/local/exact.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

// The velocity form drifts by rounding; y is recomputed from r this often.
constexpr std::int64_t kSweepsPerRefresh = 50;
// Below this share of max lambda_i |r_i|, the change of a sweep is rounding, not progress.
constexpr double kNoProgress = 1e-16;

struct Settings {
  bool exact = true;
  double omega = 1.0;
  double regularization = 1e-9;
};

// u_i from mass-scaled velocities, in runs of L dofs.
template <int L>
class VelocityCoupling {
 public:
  VelocityCoupling(const Problem& problem, BlockedRows rows)
      : problem_(problem), rows_(std::move(rows)) {}

  void refresh(const Eigen::VectorXd& r) { y_ = rows_.scaled_velocity(problem_, r); }

  Eigen::MatrixXd diagonal_block(int i) const {
    return rows_.diagonal_block(i, problem_.cones()[static_cast<std::size_t>(i)].dim);
  }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    u = problem_.w().segment<D>(at, u.size());
    const double* block = rows_.blocks(i);
    for (const int run : rows_.runs(i)) {
      u.noalias() += Block<D>(block, u.size(), L) * y_.segment<L>(run);
      block += u.size() * L;
    }
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    constexpr int D = Vector::RowsAtCompileTime;
    const double* block = rows_.blocks(i);
    for (const int run : rows_.runs(i)) {
      y_.segment<L>(run).noalias() += Block<D>(block, change.size(), L).transpose() * change;
      block += change.size() * L;
    }
  }

 private:
  template <int D>
  using Block = Eigen::Map<
      const Eigen::Matrix<double, D, L, (D == 1 || L > 1) ? Eigen::RowMajor : Eigen::ColMajor>>;

  const Problem& problem_;
  BlockedRows rows_;
  Eigen::VectorXd y_;
};

// u_i from rows of W.
class DelassusCoupling {
 public:
  explicit DelassusCoupling(const Problem& problem) : problem_(problem), W_(problem) {}

  void refresh(const Eigen::VectorXd& r) { r_ = r; }

  Eigen::MatrixXd diagonal_block(int i) const { return W_.diagonal_block(problem_, i); }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    u = problem_.q().segment<D>(at, u.size());
    const double* block = W_.blocks(i);
    for (const auto& entry : W_.entries(i)) {
      if (D != Eigen::Dynamic && entry.dim == D) {
        u.noalias() += Block<D>(block, D, D) * r_.segment<D>(entry.row, entry.dim);
      } else {
        u.noalias() +=
            Block<Eigen::Dynamic>(block, u.size(), entry.dim) * r_.segment(entry.row, entry.dim);
      }
      block += u.size() * entry.dim;
    }
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    r_.segment<Vector::RowsAtCompileTime>(problem_.start(i), change.size()) += change;
  }

 private:
  template <int D>
  using Block =
      Eigen::Map<const Eigen::Matrix<double, D, D, D == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;

  const Problem& problem_;
  BlockedDelassus W_;
  Eigen::VectorXd r_;
};

// What one cone of dimension D needs between sweeps.
template <int D>
struct LocalData {
  ExactLocal<D> exact;
  typename ExactLocal<D>::Matrix B;
  double slide_rate = 0.0;
};

// Largest over the cones, as rates: how far reactions moved, and how large they are.
struct SweepSize {
  double change = 0.0;    // max lambda_i |dr_i|
  double reaction = 0.0;  // max lambda_i |r_i|
};

template <class Coupling>
class Sweeper {
 public:
  Sweeper(const Problem& problem, const Settings& settings, Coupling coupling)
      : problem_(problem), settings_(settings), coupling_(std::move(coupling)) {
    for (int i = 0; i < problem.cone_count(); ++i) prepare(i);
  }

  void refresh(const Eigen::VectorXd& r) { coupling_.refresh(r); }

  // One pass over all cones.
  SweepSize sweep(Eigen::VectorXd& r) {
    SweepSize size;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      with_dimension(i, [&]<int D>() { update<D>(i, r, size); });
    }
    return size;
  }

  int first_unsolvable() const { return unsolvable_; }

 private:
  template <class Function>
  auto with_dimension(int i, const Function& function) {
    switch (problem_.cones()[static_cast<std::size_t>(i)].dim) {
      case 1:
        return function.template operator()<1>();
      case 2:
        return function.template operator()<2>();
      case 3:
        return function.template operator()<3>();
      case 6:
        return function.template operator()<6>();
      default:
        return function.template operator()<Eigen::Dynamic>();
    }
  }

  void prepare(int i) {
    if (!settings_.exact) return;
    const Eigen::MatrixXd W = coupling_.diagonal_block(i);
    const double lambda = problem_.mobility()(i);
    const Cone& cone = problem_.cones()[static_cast<std::size_t>(i)];
    with_dimension(i, [&]<int D>() {
      auto& locals = std::get<std::vector<LocalData<D>>>(locals_);
      slot_.push_back(locals.size());
      LocalData<D>& local = locals.emplace_back();
      local.B = 0.5 * (W + W.transpose());
      local.exact.set(local.B, lambda, cone.mu, cone.theta);
      if (local.exact.least_eigenvalue() < settings_.regularization * lambda) {
        local.B.diagonal().array() += settings_.regularization * lambda;
        local.exact.set(local.B, lambda, cone.mu, cone.theta);
      }
    });
  }

  template <int D>
  void update(int i, Eigen::VectorXd& r, SweepSize& size) {
    using Vector = Eigen::Matrix<double, D, 1>;
    const Cone& cone = problem_.cones()[static_cast<std::size_t>(i)];
    const int at = problem_.start(i);
    const double lambda = problem_.mobility()(i);
    auto ri = r.template segment<D>(at, cone.dim);
    Vector u(cone.dim), next = ri;
    coupling_.rate(i, at, u);
    if (settings_.exact) {
      LocalData<D>& local =
          std::get<std::vector<LocalData<D>>>(locals_)[slot_[static_cast<std::size_t>(i)]];
      u.noalias() -= local.B * next;
      if (local.exact.solve(u, next, local.slide_rate) == LocalCase::kNoSolution) {
        if (unsolvable_ < 0) unsolvable_ = i;
        return;
      }
    } else {
      problems::add_de_saxce(cone.theta, u);
      next -= u / lambda;
      problems::project(cone.mu, next);
    }
    if (settings_.omega != 1.0) {
      next = (1.0 - settings_.omega) * Vector(ri) + settings_.omega * next;
      problems::project(cone.mu, next);
    }
    const Vector change = next - ri;
    size.reaction = std::max(size.reaction, lambda * next.norm());
    const double moved = lambda * change.norm();
    if (moved == 0.0) return;
    size.change = std::max(size.change, moved);
    ri = next;
    coupling_.moved(i, change);
  }

  const Problem& problem_;
  Settings settings_;
  Coupling coupling_;
  std::tuple<std::vector<LocalData<1>>, std::vector<LocalData<2>>, std::vector<LocalData<3>>,
             std::vector<LocalData<6>>, std::vector<LocalData<Eigen::Dynamic>>>
      locals_;
  std::vector<std::size_t> slot_;  // of cone i in the list of its dimension
  int unsolvable_ = -1;
};

template <class Coupling>
Result iterate(const Problem& problem, const Settings& settings, Coupling coupling,
               const Stop& stop, Eigen::VectorXd r, Monitor& monitor) {
  Sweeper<Coupling> sweeper(problem, settings, std::move(coupling));
  sweeper.refresh(r);
  monitor.setup_done();

  Result result;
  std::int64_t next_own_look = 0;
  while (true) {
    if (monitor.check(result.iterations, r) == Verdict::kStop) {
      result.status = monitor.status();
      break;
    }
    if (result.iterations % kSweepsPerRefresh == 0) sweeper.refresh(r);
    const auto [change, size] = sweeper.sweep(r);
    ++result.iterations;
    if (stop.test == StopTest::kOwn && change <= stop.tol * problem.rate_scale() &&
        result.iterations >= next_own_look) {
      if (problems::evaluate_eta(problem, r) <= stop.tol) {
        result.status = Status::kConverged;
        break;
      }
      next_own_look = result.iterations + 1 + result.iterations / 10;
    }
    if (change <= kNoProgress * size) {
      const bool solved =
          stop.test == StopTest::kOwn && problems::evaluate_eta(problem, r) <= stop.tol;
      result.status =
          monitor.conclude(solved ? Status::kConverged : Status::kStalled, result.iterations, r);
      break;
    }
  }
  if (sweeper.first_unsolvable() >= 0) {
    result.notes.push_back("cone " + std::to_string(sweeper.first_unsolvable()) +
                           ": its one-cone problem has no solution");
  }
  result.r = std::move(r);
  return result;
}

Result iterate_velocity(const Problem& problem, const Settings& settings, const Stop& stop,
                        Eigen::VectorXd guess, Monitor& monitor) {
  BlockedRows rows(problem);
  auto run = [&]<int L>() {
    return iterate(problem, settings, VelocityCoupling<L>(problem, std::move(rows)), stop,
                   std::move(guess), monitor);
  };
  switch (rows.run_length()) {
    case 6:
      return run.template operator()<6>();
    case 3:
      return run.template operator()<3>();
    case 2:
      return run.template operator()<2>();
    default:
      return run.template operator()<1>();
  }
}

bool has_velocity_form(const Problem& problem) {
  return problem.is_primal() && problem.inertia().block_diagonal();
}

Solver make(const Method& method, const Values& values) {
  const Settings settings{std::get<std::string>(values.at("local")) == "exact",
                          std::get<double>(values.at("omega")),
                          std::get<double>(values.at("regularization"))};
  const std::string form = std::get<std::string>(values.at("form"));
  auto refuses = [form](const Problem& problem) -> std::optional<std::string> {
    if (form != "velocity" || has_velocity_form(problem)) return std::nullopt;
    return "form=velocity needs M and H with M block diagonal";
  };
  auto run = [settings, form](const Problem& problem, const Stop& stop, Eigen::VectorXd guess,
                              Monitor& monitor) {
    if (form != "delassus" && has_velocity_form(problem)) {
      return iterate_velocity(problem, settings, stop, std::move(guess), monitor);
    }
    return iterate(problem, settings, DelassusCoupling(problem), stop, std::move(guess), monitor);
  };
  return make_checked_solver(method, values, refuses, run);
}

std::size_t local_bytes(int dim) {
  switch (dim) {
    case 1:
      return sizeof(LocalData<1>);
    case 2:
      return sizeof(LocalData<2>);
    case 3:
      return sizeof(LocalData<3>);
    case 6:
      return sizeof(LocalData<6>);
    default:
      return sizeof(LocalData<Eigen::Dynamic>) +
             sizeof(double) * static_cast<std::size_t>(2 * dim * dim);
  }
}

}  // namespace

std::size_t gauss_seidel_sweep_bytes(const Problem& problem) {
  const BlockedRows rows(problem);
  std::size_t bytes = rows.bytes();
  for (const Cone& cone : problem.cones()) {
    bytes += local_bytes(cone.dim) + sizeof(Cone) + sizeof(std::size_t) + sizeof(double) +
             2 * sizeof(double) * static_cast<std::size_t>(cone.dim);
  }
  return bytes + sizeof(double) * static_cast<std::size_t>(rows.scaled_dofs());
}

Method gauss_seidel() {
  Method method{
      .name = "gs",
      .kind = Kind::kMethod,
      .summary = "Gauss-Seidel, one cone at a time",
      .parameters =
          {{.name = "local",
            .fallback = std::string("exact"),
            .choices = {"exact", "projection"},
            .doc = "how one cone is solved: to rounding, or by one projected step"},
           {.name = "form",
            .fallback = std::string("auto"),
            .choices = {"auto", "velocity", "delassus"},
            .doc = "what is kept up to date: velocities (M block diagonal) or rows of W times r"},
           {.name = "omega",
            .fallback = 1.0,
            .low = 0.05,
            .high = 1.95,
            .doc = "relaxation of each cone's update [-]"},
           {.name = "regularization",
            .fallback = 1e-9,
            .low = 0.0,
            .high = 1.0,
            .doc = "share of lambda_i added to singular W_ii (local=exact) [-]"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
