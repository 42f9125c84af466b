#include "solvers/apgd.h"

#include <algorithm>
#include <cmath>

#include "solvers/cone_vectors.h"
#include "solvers/convex.h"
#include "solvers/delassus_product.h"
#include "solvers/local/one_cone.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr double kGrowth = 2.0, kShrinkage = 0.98;  // of L
constexpr double kLeast = 1e-6;                     // L
constexpr int kTrials = 60;                         // of one step
constexpr std::int64_t kStallCheck = 16;  // iterations from one look for a stall to the next
constexpr double kSecondsPerRow = 4e-9;   // of an iteration without its product (work_s)

class Apgd final : public Iteration {
 public:
  Apgd(const Problem& problem, std::int64_t refresh)
      : problem_(problem),
        refresh_(refresh),
        product_(problem),
        work_of_trial_s_(product_.work_s() + kSecondsPerRow * static_cast<double>(problem.rows())),
        mobility_(mobility_per_row(problem)),
        shift_(Eigen::VectorXd::Zero(problem.cone_count())) {}

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    project_on_cones(problem_, r_);
    product_.rate(r_, u_);
    y_ = r_;
    u_y_ = u_;
    next_.resizeLike(r_);
    L_ = 1.0;
    weight_ = 1.0;
    iterations_ = 0;
  }

  State advance() override {
    const bool fresh = iterations_++ % refresh_ == 0;
    if (fresh) refresh_shift();
    if (!step_from_y()) return State::kDiverged;
    way_ = next_ - r_;
    const bool stalled = fresh && iterations_ % kStallCheck == 0 && without_progress();
    const double beta = next_beta();
    y_ = next_ + beta * way_;
    u_y_ = (1.0 + beta) * u_next_ - beta * u_;
    r_.swap(next_);
    u_.swap(u_next_);
    L_ = std::max(kShrinkage * L_, kLeast);
    return stalled ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  double own_eta() const override {
    return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_);
  }
  double work_s() const override { return work_s_; }

 private:
  void refresh_shift() {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const Cone& cone = cone_of(i);
      with_dimension(cone.dim, [&]<int D>() {
        const auto u = u_y_.segment<D>(problem_.start(i), cone.dim);
        shift_(i) = cone.theta * problems::tangential_norm(u);
      });
    }
  }

  // r+ = P_K(y - u_hat / (L lambda)) and u there, with L as large as the step asks for. False where
  // it is not finite.
  bool step_from_y() {
    for (int trial = 0; trial < kTrials; ++trial) {
      project_step();
      product_.rate(next_, u_next_);
      work_s_ += work_of_trial_s_;
      step_ = next_ - y_;
      const double square = step_.cwiseAbs2().dot(mobility_);
      if (!std::isfinite(square)) return false;
      const double curvature = step_.dot(u_next_ - u_y_);
      if (!(curvature > L_ * square) || too_small_to_measure()) return std::isfinite(curvature);
      L_ *= kGrowth;
    }
    return true;
  }

  void project_step() {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const Cone& cone = cone_of(i);
      const double length = 1.0 / (L_ * problem_.mobility()(i));
      with_dimension(cone.dim, [&]<int D>() {
        const int at = problem_.start(i);
        Eigen::Matrix<double, D, 1> part =
            y_.segment<D>(at, cone.dim) - length * u_y_.segment<D>(at, cone.dim);
        part(0) -= length * shift_(i);
        problems::project(cone.mu, part);
        next_.segment<D>(at, cone.dim) = part;
      });
    }
  }

  bool too_small_to_measure() const {
    return size_as_rate(problem_, step_) <= kTooSmallToMeasure * size_as_rate(problem_, next_);
  }

  bool without_progress() const {
    return std::max(size_as_rate(problem_, way_), size_as_rate(problem_, step_)) <=
           kNoProgress * size_as_rate(problem_, r_);
  }

  // beta of weight_ = w: w (1 - w) / (w^2 + w+), where w+^2 = (1 - w+) w^2.
  double next_beta() {
    if (step_.cwiseProduct(mobility_).dot(way_) < 0.0) {
      weight_ = 1.0;
      return 0.0;
    }
    const double square = weight_ * weight_;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    const double beta = weight_ * (1.0 - weight_) / (square + next);
    weight_ = next;
    return beta;
  }

  const Cone& cone_of(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  const Problem& problem_;
  std::int64_t refresh_;
  DelassusProduct product_;
  double work_of_trial_s_, work_s_ = 0.0;
  Eigen::VectorXd mobility_;         // lambda_i on each row of cone i
  Eigen::VectorXd shift_;            // theta_i |u_it| at y, of now or of the last time
  Eigen::VectorXd r_, u_, y_, u_y_;  // u at r, at y
  Eigen::VectorXd next_, u_next_;    // r+, u at it
  Eigen::VectorXd way_, step_;       // r+ - r, r+ - y
  double L_ = 1.0, weight_ = 1.0;
  std::int64_t iterations_ = 0;
};

Solver make(const Method& method, const Values& values) {
  const std::int64_t refresh = std::get<std::int64_t>(values.at("refresh"));
  return make_iterative_solver(
      method, values, refuse_zero_delassus,
      [refresh](const Problem& problem) { return std::make_unique<Apgd>(problem, refresh); });
}

}  // namespace

std::unique_ptr<Iteration> make_apgd(const Problem& problem) {
  return std::make_unique<Apgd>(problem, 1);
}

Method apgd() {
  Method method{
      .name = "apgd",
      .kind = Kind::kMethod,
      .summary = "accelerated projected gradient, restarted, De Saxce term refreshed",
      .source =
          "Mazhar, Heyn, Negrut, Tasora, ACM Trans. Graph. 34(3) (2015), Algorithm 1; restart: "
          "O'Donoghue, Candes, Found. Comput. Math. 15 (2015) (neither checked)",
      .parameters = {{.name = "refresh",
                      .fallback = std::int64_t{1},
                      .low = 1,
                      .high = 10000,
                      .doc = "iterations between two refreshes of the De Saxce term [-]"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
