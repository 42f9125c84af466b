#include "solvers/ppa_inner.h"

#include <cmath>
#include <numeric>

#include "solvers/gs.h"
#include "solvers/gs_coupling.h"
#include "solvers/gs_sweeper.h"
#include "solvers/newton/proximal_equation.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

class NewtonInner final : public ProximalInner {
 public:
  NewtonInner(const Problem& problem, const NewtonSettings& settings)
      : equation_(problem, settings), lengths_(settings.line_search) {}

  void pose(const Eigen::VectorXd& centre, double alpha) override {
    lengths_.restart();
    equation_.start(centre, alpha);
  }
  bool advance() override { return equation_.step(lengths_).has_value(); }
  const Eigen::VectorXd& r() const override { return equation_.r(); }
  const Eigen::VectorXd& u() const override { return equation_.u(); }
  double step_work_s() const override { return equation_.step_work_s(); }

 private:
  ProximalEquation equation_;
  StepLength lengths_;
};

/// A coupling (gs_coupling.h) of the problem with W + alpha lambda and q - alpha lambda c.
template <class Coupling>
class ProximalCoupling {
 public:
  ProximalCoupling(const Problem& problem, Coupling coupling)
      : problem_(problem), coupling_(std::move(coupling)) {}

  void pose(const Eigen::VectorXd& centre, double alpha) {
    centre_ = centre;
    alpha_ = alpha;
  }

  void clear() {
    coupling_.clear();
    away_ = -centre_;
  }

  Eigen::MatrixXd diagonal_block(int i) const {
    Eigen::MatrixXd block = coupling_.diagonal_block(i);
    block.diagonal().array() += alpha_ * problem_.mobility()(i);
    return block;
  }

  double normal_rate(int i, int at, int dim) const {
    return coupling_.normal_rate(i, at, dim) + alpha_ * problem_.mobility()(i) * away_(at);
  }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    coupling_.rate(i, at, u);
    u += alpha_ * problem_.mobility()(i) * away_.segment<Vector::RowsAtCompileTime>(at, u.size());
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    coupling_.moved(i, change);
    away_.segment<Vector::RowsAtCompileTime>(problem_.start(i), change.size()) += change;
  }

 private:
  const Problem& problem_;
  Coupling coupling_;
  Eigen::VectorXd centre_, away_;  // c, r - c
  double alpha_ = 0.0;
};

template <class Coupling>
class GaussSeidelInner final : public ProximalInner {
 public:
  GaussSeidelInner(const Problem& problem, Coupling coupling)
      : problem_(problem),
        sweeper_(problem, kSettings.local, kSettings.omega, kSettings.regularization,
                 ProximalCoupling<Coupling>(problem, std::move(coupling))),
        order_(static_cast<std::size_t>(problem.cone_count())) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  void pose(const Eigen::VectorXd& centre, double alpha) override {
    sweeper_.coupling().pose(centre, alpha);
    if (alpha != alpha_) sweeper_.prepare();
    alpha_ = alpha;
    r_ = centre;
  }

  bool advance() override {
    refresh(sweeper_.coupling(), problem_, r_);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      if (!std::isfinite(sweeper_.sweep(order_, false, {}, r_).change)) return false;
    }
    u_ = problem_.rate(r_);
    return true;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  const Eigen::VectorXd& u() const override { return u_; }
  double step_work_s() const override {
    return (kSweeps + 1) * gauss_seidel_sweep_work_s(problem_);
  }

 private:
  static constexpr GaussSeidelSettings kSettings{};
  static constexpr int kSweeps = 10;

  const Problem& problem_;
  Sweeper<ProximalCoupling<Coupling>> sweeper_;
  std::vector<int> order_;
  double alpha_ = 0.0;
  Eigen::VectorXd r_, u_;
};

}  // namespace

std::unique_ptr<ProximalInner> make_proximal_newton_inner(const Problem& problem,
                                                          NewtonSettings::Function function) {
  return std::make_unique<NewtonInner>(problem, NewtonSettings{.function = function});
}

std::unique_ptr<ProximalInner> make_proximal_gauss_seidel(const Problem& problem) {
  return with_coupling(problem, has_velocity_form(problem),
                       [&]<class Coupling>(Coupling coupling) -> std::unique_ptr<ProximalInner> {
                         return std::make_unique<GaussSeidelInner<Coupling>>(problem,
                                                                             std::move(coupling));
                       });
}

}  // namespace conebench::solvers
