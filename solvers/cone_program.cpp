#include "solvers/cone_program.h"

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpOrigIpoptNLP.hpp>
#include <IpTNLP.hpp>
#include <IpTNLPAdapter.hpp>
#include <algorithm>
#include <exception>
#include <limits>

namespace conebench::solvers {
namespace {

using Ipopt::Index;
using Ipopt::Number;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

// Ipopt takes bounds of 1e19 and more for none.
constexpr double kNoBound = 2e19;
// A cold start is moved this far inside its bounds.
constexpr double kColdPush = 10.0;
// How far inside its bounds a warm start is moved, relative.
constexpr double kWarmPush = 1e-12;

// Row and column of a list of nonzeros; what Ipopt asks for once.
struct Triplets {
  Index *row, *column;
  void put(Index i, Index j) {
    *row++ = i;
    *column++ = j;
  }
  void put_lower(Index i, Index j) { put(std::max(i, j), std::min(i, j)); }
  void put_matrix(const problems::SparseMatrix& matrix) {
    for (Index i = 0; i < matrix.outerSize(); ++i) {
      for (problems::SparseMatrix::InnerIterator it(matrix, i); it; ++it) {
        put(i, static_cast<Index>(it.col()));
      }
    }
  }
};

// y, x_t and 1 / (y + eps) of a cone at x.
struct ConePoint {
  double y, scale;
  Eigen::VectorBlock<const ConstVector> t;

  ConePoint(const ConeProgram::Cone& cone, double eps, const ConstVector& x)
      : y(cone.mu * x(cone.normal)), scale(1.0 / (y + eps)), t(x, cone.tangent, cone.dim) {}
};

// The program in Ipopt's words. Nothing here throws: what the watcher throws waits in `failure`.
class Adapter final : public Ipopt::TNLP {
 public:
  Adapter(const ConeProgram& program, ProgramPoint& point, const Watch& watch)
      : program_(program), point_(point), watch_(watch), latest_(point.x) {}

  std::exception_ptr failure;

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac_g, Index& nnz_h_lag,
                    IndexStyleEnum& index_style) override {
    n = program_.variables();
    m = program_.constraints();
    nnz_jac_g = static_cast<Index>(program_.A.nonZeros());
    nnz_h_lag = static_cast<Index>(program_.Q.nonZeros());
    for (const auto& cone : program_.cones) {
      nnz_jac_g += 1 + cone.dim;
      nnz_h_lag += 1 + 2 * cone.dim;
    }
    index_style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l,
                       Number* g_u) override {
    Vector(x_l, n) = program_.lower.cwiseMax(-kNoBound);
    Vector(x_u, n) = program_.upper.cwiseMin(kNoBound);
    const Index cones = static_cast<Index>(program_.cones.size());
    Vector(g_l, m).head(m - cones) = program_.b;
    Vector(g_u, m).head(m - cones) = program_.b;
    Vector(g_l, m).tail(cones).setZero();
    Vector(g_u, m).tail(cones).setConstant(kNoBound);
    return true;
  }

  bool get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number* z_L, Number* z_U,
                          Index m, bool init_lambda, Number* lambda) override {
    if (init_x) Vector(x, n) = point_.x;
    if (init_z) {
      Vector(z_L, n) = point_.lower_dual;
      Vector(z_U, n) = point_.upper_dual;
    }
    if (init_lambda) Vector(lambda, m) = point_.constraint_dual;
    return true;
  }

  bool eval_f(Index n, const Number* values, bool, Number& objective) override {
    const ConstVector x(values, n);
    objective = program_.c.dot(x);
    for (Index i = 0; i < n; ++i) {
      for (problems::SparseMatrix::InnerIterator it(program_.Q, i); it; ++it) {
        objective += (it.col() == i ? 0.5 : 1.0) * it.value() * x(i) * x(it.col());
      }
    }
    return true;
  }

  bool eval_grad_f(Index n, const Number* values, bool, Number* gradient) override {
    const ConstVector x(values, n);
    Vector g(gradient, n);
    g = program_.c;
    for (Index i = 0; i < n; ++i) {
      for (problems::SparseMatrix::InnerIterator it(program_.Q, i); it; ++it) {
        g(i) += it.value() * x(it.col());
        if (it.col() != i) g(it.col()) += it.value() * x(i);
      }
    }
    return true;
  }

  bool eval_g(Index n, const Number* values, bool, Index m, Number* constraints) override {
    const ConstVector x(values, n);
    Vector g(constraints, m);
    const auto linear = program_.A.rows();
    g.head(linear).noalias() = program_.A * x;
    for (std::size_t k = 0; k < program_.cones.size(); ++k) {
      const ConePoint at(program_.cones[k], program_.eps, x);
      g(linear + static_cast<Index>(k)) = at.y - at.scale * at.t.squaredNorm();
    }
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool, Index, Index, Index* row, Index* column,
                  Number* values) override {
    if (values == nullptr) {
      put_jacobian_pattern({row, column});
    } else {
      put_jacobian(ConstVector(x, n), values);
    }
    return true;
  }

  bool eval_h(Index n, const Number* x, bool, Number objective, Index m, const Number* lambda, bool,
              Index, Index* row, Index* column, Number* values) override {
    if (values == nullptr) {
      put_hessian_pattern({row, column});
    } else {
      put_hessian(ConstVector(x, n), objective, ConstVector(lambda, m), values);
    }
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override {
    try {
      read_iterate(data, quantities);
      return watch_(latest_);
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number* z_L,
                         const Number* z_U, Index m, const Number*, const Number* lambda, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    point_.x = ConstVector(x, n);
    point_.lower_dual = ConstVector(z_L, n);
    point_.upper_dual = ConstVector(z_U, n);
    point_.constraint_dual = ConstVector(lambda, m);
  }

 private:
  // In the restoration phase the current point is of another program; `latest_` stays.
  void read_iterate(const Ipopt::IpoptData* data, Ipopt::IpoptCalculatedQuantities* quantities) {
    if (data == nullptr || quantities == nullptr) return;
    auto* program = dynamic_cast<Ipopt::OrigIpoptNLP*>(GetRawPtr(quantities->GetIpoptNLP()));
    if (program == nullptr) return;
    auto* adapter = dynamic_cast<Ipopt::TNLPAdapter*>(GetRawPtr(program->nlp()));
    if (adapter != nullptr) adapter->ResortX(*data->curr()->x(), latest_.data());
  }

  void put_jacobian_pattern(Triplets out) const {
    out.put_matrix(program_.A);
    Index i = static_cast<Index>(program_.A.rows());
    for (const auto& cone : program_.cones) {
      out.put(i, cone.normal);
      for (Index k = 0; k < cone.dim; ++k) out.put(i, cone.tangent + k);
      ++i;
    }
  }

  void put_jacobian(const ConstVector& x, Number* values) const {
    values = put_values(program_.A, 1.0, values);
    for (const auto& cone : program_.cones) {
      const ConePoint at(cone, program_.eps, x);
      *values++ = cone.mu * (1.0 + at.scale * at.scale * at.t.squaredNorm());
      Vector(values, cone.dim) = -2.0 * at.scale * at.t;
      values += cone.dim;
    }
  }

  void put_hessian_pattern(Triplets out) const {
    out.put_matrix(program_.Q);
    for (const auto& cone : program_.cones) {
      out.put(cone.normal, cone.normal);
      for (Index k = 0; k < cone.dim; ++k) {
        out.put(cone.tangent + k, cone.tangent + k);
        out.put_lower(cone.tangent + k, cone.normal);
      }
    }
  }

  void put_hessian(const ConstVector& x, double objective, const ConstVector& lambda,
                   Number* values) const {
    values = put_values(program_.Q, objective, values);
    auto i = program_.A.rows();
    for (const auto& cone : program_.cones) {
      const ConePoint at(cone, program_.eps, x);
      const double factor = -2.0 * lambda(i++) * at.scale, slope = cone.mu * at.scale;
      *values++ = factor * slope * slope * at.t.squaredNorm();
      for (Index k = 0; k < cone.dim; ++k) {
        *values++ = factor;
        *values++ = -factor * slope * at.t(k);
      }
    }
  }

  static Number* put_values(const problems::SparseMatrix& matrix, double factor, Number* values) {
    for (Eigen::Index i = 0; i < matrix.outerSize(); ++i) {
      for (problems::SparseMatrix::InnerIterator it(matrix, i); it; ++it) {
        *values++ = factor * it.value();
      }
    }
    return values;
  }

  const ConeProgram& program_;
  ProgramPoint& point_;
  const Watch& watch_;
  Eigen::VectorXd latest_;
};

void set_options(const IpoptRun& run, bool warm, Ipopt::OptionsList& options) {
  options.SetStringValue("sb", "yes");
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("linear_solver", "mumps");
  options.SetStringValue("nlp_scaling_method", "none");
  options.SetNumericValue("tol", run.tol);
  options.SetNumericValue("dual_inf_tol", run.tol);
  options.SetNumericValue("constr_viol_tol", run.tol);
  options.SetNumericValue("compl_inf_tol", run.tol);
  options.SetIntegerValue("acceptable_iter", 0);
  options.SetNumericValue("bound_relax_factor", 0.0);
  options.SetIntegerValue("max_iter", run.max_iterations);
  options.SetNumericValue("mu_init", run.barrier);
  options.SetNumericValue("bound_push", kColdPush);
  options.SetNumericValue("slack_bound_push", kColdPush);
  if (!warm) return;
  options.SetStringValue("warm_start_init_point", "yes");
  for (const char* push :
       {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push",
        "warm_start_slack_bound_frac", "warm_start_mult_bound_push"}) {
    options.SetNumericValue(push, kWarmPush);
  }
}

IpoptEnd end_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
    case Ipopt::Feasible_Point_Found:
      return IpoptEnd::kSolved;
    case Ipopt::User_Requested_Stop:
      return IpoptEnd::kStopped;
    default:
      return IpoptEnd::kFailed;
  }
}

}  // namespace

IpoptEnd run_ipopt(const ConeProgram& program, const IpoptRun& run, ProgramPoint& point,
                   const Watch& watch) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(run, point.constraint_dual.size() > 0, *application->Options());
  // An empty name: no ipopt.opt of the working directory is read.
  if (application->Initialize(std::string()) != Ipopt::Solve_Succeeded) return IpoptEnd::kFailed;
  const Ipopt::SmartPtr<Adapter> adapter = new Adapter(program, point, watch);
  const auto status = application->OptimizeTNLP(GetRawPtr(adapter));
  if (adapter->failure) std::rethrow_exception(adapter->failure);
  return end_of(status);
}

}  // namespace conebench::solvers
