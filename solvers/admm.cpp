#include "solvers/admm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/anderson.h"
#include "solvers/cone_vectors.h"
#include "solvers/linear/normal_system.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// rho is looked at after this many iterations, then each time when there are half as many again.
constexpr std::int64_t kFirstLook = 10;
constexpr double kNextLook = 1.5;
constexpr double kWorthAFactor = 2.0, kLargestChange = 10.0;  // of rho
constexpr double kLeastRho = 1e-3, kLargestRho = 1e4;
constexpr double kSolveWork = 0.1;       // of an iteration, as a share of a factorisation
constexpr double kSecondsPerRow = 3e-8;  // of an iteration without its solve (work_s)

struct Settings {
  double rho = 1.0;
  double relaxation = 1.0;
  int anderson = 5;
};

// All vectors are in units where lambda_i = 1: r times its root, u divided by it.
class Admm final : public Iteration {
 public:
  Admm(const Problem& problem, const Settings& settings)
      : problem_(problem),
        settings_(settings),
        root_(mobility_per_row(problem).cwiseSqrt()),
        q_(problem.q().cwiseQuotient(root_)),
        system_(problem),
        scaling_(problem),
        anderson_(settings.anderson) {}

  void start(const Eigen::VectorXd& r) override {
    rho_ = settings_.rho;
    largest_rho_ = kLargestRho;
    factors_ = 0;
    factor_is_for_rho_ = false;
    in_increments_ = false;
    iterations_ = 0;
    next_look_ = kFirstLook;
    z_ = problem_.rate(r).cwiseQuotient(root_);
    add_de_saxce(problem_, z_);
    zeta_ = r.cwiseProduct(root_) - rho_ * z_;
    split();
    restart();
    gap_ = std::numeric_limits<double>::infinity();
  }

  State advance() override {
    if (!factor_is_for_rho_ && !factorize()) return State::kDiverged;
    solve_linear_part();
    work_s_ +=
        kSolveWork * system_.work_s() + kSecondsPerRow * static_cast<double>(problem_.rows());
    if (!u_hat_.allFinite()) return State::kDiverged;
    next_ = r_ - rho_ * (settings_.relaxation * u_hat_ + (1.0 - settings_.relaxation) * z_);
    const double residual = (next_ - zeta_).norm();
    accelerate(residual);
    z_change_ = -z_;
    split();
    z_change_ += z_;
    gap_ = std::max((u_hat_ - z_).cwiseProduct(root_).lpNorm<Eigen::Infinity>(),
                    rho_ * z_change_.cwiseProduct(root_).lpNorm<Eigen::Infinity>());
    if (++iterations_ >= next_look_) balance();
    return residual <= kNoProgress * zeta_.norm() ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return answer_; }
  double own_eta() const override {
    return problem_.rate_scale() > 0.0 ? gap_ / problem_.rate_scale() : gap_;
  }
  double work_s() const override { return work_s_; }
  std::vector<std::string> notes() const override {
    return {fmt::format("{} factorisations, rho = {:.3g} at last", factors_, rho_)};
  }

 private:
  // r = P_K(zeta), z = (r - zeta) / rho.
  void split() {
    r_ = zeta_;
    project_on_cones(problem_, r_);
    z_ = (r_ - zeta_) / rho_;
    answer_ = r_.cwiseQuotient(root_);
  }

  // After a change of rho nothing of the past is of use.
  void restart() {
    anderson_.restart();
    least_ = std::numeric_limits<double>::infinity();
    carried_ = Eigen::VectorXd::Zero(problem_.rows());
  }

  bool factorize() {
    while (true) {
      for (int i = 0; i < problem_.cone_count(); ++i) {
        scaling_[i].setIdentity();
        scaling_[i] *= std::sqrt(rho_ / problem_.mobility()(i));
      }
      ++factors_;
      factor_is_for_rho_ = system_.factorize_root(scaling_);
      work_s_ += system_.work_s();
      if (factor_is_for_rho_ || rho_ <= kLeastRho) return factor_is_for_rho_;
      largest_rho_ = std::max(rho_ / kLargestChange, kLeastRho);
      change_rho(largest_rho_);
    }
  }

  // u_hat at r, z: from q and the whole of r_hat, or from u(r) and what r_hat adds to r.
  void solve_linear_part() {
    u_hat_ = z_;
    add_de_saxce(problem_, u_hat_);
    shift_ = u_hat_ - z_;
    if (in_increments_) {
      rate_ = problem_.rate(answer_).cwiseQuotient(root_);
      b_ = rho_ * (z_ - shift_ - rate_);
    } else {
      b_ = r_ + rho_ * (z_ - shift_ - q_);
    }
    if (problem_.is_primal()) {
      u_hat_ = system_.solve_root_rate(b_).cwiseQuotient(root_) / std::sqrt(rho_);
    } else {
      x_ = system_.solve_root(b_ + carried_);
      u_hat_ = problem_.apply_delassus(x_.cwiseQuotient(root_)).cwiseQuotient(root_);
      carried_ += b_ - x_ - rho_ * u_hat_;
    }
    u_hat_ += (in_increments_ ? rate_ : q_) + shift_;
  }

  void accelerate(double residual) {
    if (residual > least_) {
      anderson_.restart();
      zeta_.swap(next_);
    } else {
      zeta_ = anderson_.next(zeta_, next_);
    }
    least_ = residual;
  }

  void balance() {
    next_look_ = static_cast<std::int64_t>(kNextLook * static_cast<double>(iterations_)) + 1;
    // A gap of this size is rounding, which rho multiplies unless increments alone are solved for.
    if ((u_hat_ - z_).norm() <= kTooSmallToMeasure * std::max(1.0, rho_) * r_.norm()) {
      if (!in_increments_) restart();
      in_increments_ = true;
      return;
    }
    const double ratio = std::sqrt((u_hat_ - z_).norm() / (rho_ * z_change_.norm()));
    if (!(ratio > kWorthAFactor || ratio < 1.0 / kWorthAFactor)) return;
    change_rho(rho_ * std::clamp(ratio, 1.0 / kLargestChange, kLargestChange));
  }

  void change_rho(double rho) {
    rho_ = std::clamp(rho, kLeastRho, largest_rho_);
    zeta_ = r_ - rho_ * z_;
    factor_is_for_rho_ = false;
    restart();
  }

  const Problem& problem_;
  Settings settings_;
  Eigen::VectorXd root_;  // sqrt(lambda_i) on each row of cone i
  Eigen::VectorXd q_;
  NormalSystem system_;
  BlockDiagonal scaling_;  // sqrt(rho / lambda_i) I
  Anderson anderson_;
  double rho_ = 1.0, largest_rho_ = kLargestRho;
  bool factor_is_for_rho_ = false, in_increments_ = false;
  int factors_ = 0;
  std::int64_t iterations_ = 0, next_look_ = kFirstLook;
  Eigen::VectorXd zeta_, next_, r_, z_, z_change_, u_hat_;
  Eigen::VectorXd x_;        // reduced form only
  Eigen::VectorXd shift_;    // t e_n
  Eigen::VectorXd rate_;     // u(r), of increments only
  Eigen::VectorXd b_;        // right-hand side for x
  Eigen::VectorXd carried_;  // of the equation for x, what the reduced form's factor left
  Eigen::VectorXd answer_;   // r in its own unit
  double work_s_ = 0.0;
  double least_ = 0.0;  // residual of zeta since Anderson restarted
  double gap_ = 0.0;    // largest entry of u_hat - z and rho times the change of z, as rates
};

Solver make(const Method& method, const Values& values) {
  const Settings settings{std::get<double>(values.at("rho")),
                          std::get<double>(values.at("relaxation")),
                          static_cast<int>(std::get<std::int64_t>(values.at("anderson")))};
  return make_iterative_solver(
      method, values, refuse_zero_delassus,
      [settings](const Problem& problem) { return std::make_unique<Admm>(problem, settings); });
}

}  // namespace

std::unique_ptr<Iteration> make_admm(const Problem& problem) {
  return std::make_unique<Admm>(problem, Settings{});
}

Method admm() {
  Method method{
      .name = "admm",
      .kind = Kind::kMethod,
      .summary = "alternating direction method of multipliers, factor kept, rho adapted",
      .source =
          "Boyd, Parikh, Chu, Peleato, Eckstein, Found. Trends Mach. Learn. 3(1) (2011); on "
          "contact: Tasora, Mangoni, Benatti, Garziera, Int. J. Numer. Meth. Engng 122(16) (2021); "
          "Carpentier, Le Lidec, Montaut, arXiv:2405.17020 (none checked)",
      .parameters = {{.name = "rho",
                      .fallback = 1.0,
                      .low = kLeastRho,
                      .high = kLargestRho,
                      .doc = "the first penalty, in units of 1 / lambda_i [-]"},
                     {.name = "relaxation",
                      .fallback = 1.0,
                      .low = 0.5,
                      .high = 1.95,
                      .doc = "of u_hat against z; 1 is none [-]"},
                     {.name = "anderson",
                      .fallback = std::int64_t{5},
                      .low = 0,
                      .high = 100,
                      .doc = "depth of Anderson acceleration; 0 is none"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
