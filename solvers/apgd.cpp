#include "solvers/apgd.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

#include "solvers/cone_vectors.h"
#include "solvers/delassus_product.h"
#include "solvers/with_dimension.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr double kGrowth = 2.0, kShrinkage = 0.98;  // of L
constexpr double kLeast = 1e-6;                     // L
constexpr int kTrials = 60;                         // of one step
constexpr std::int64_t kLeastSkip = 10;
constexpr double kMost = 0.75;            // share of the cones awake that is worth it
constexpr std::int64_t kStallCheck = 16;  // iterations from one look for a stall to the next
constexpr double kSecondsPerRow = 4e-9;   // of an iteration without its product (work_s)

struct Settings {
  std::int64_t refresh = 1;
  std::int64_t skip = 50;
};

// Vectors hold one part for each cone that is awake, in their order, where not said otherwise.
class Apgd final : public Iteration {
 public:
  Apgd(const Problem& problem, const Settings& settings)
      : problem_(problem),
        settings_(settings),
        product_(problem),
        work_of_all_s_(product_.work_s() + kSecondsPerRow * static_cast<double>(problem.rows())),
        all_(static_cast<std::size_t>(problem.cone_count())),
        mobility_of_all_(mobility_per_row(problem)),
        shift_(Eigen::VectorXd::Zero(problem.cone_count())) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  void start(const Eigen::VectorXd& r) override {
    awake_ = all_;
    mobility_ = mobility_of_all_;
    answer_ = r;
    answer_is_old_ = false;
    project_on_cones(problem_, answer_);
    product_.rate(answer_, u_);
    r_ = y_ = answer_;
    u_y_ = u_;
    next_.resizeLike(r_);
    L_ = 1.0;
    weight_ = 1.0;
    iterations_ = next_choice_ = 0;
  }

  State advance() override {
    const bool fresh = iterations_ % settings_.refresh == 0;
    if (settings_.skip > 1 && iterations_ >= next_choice_ && product_.has_parts()) {
      choose_awake(fresh);
      next_choice_ = iterations_ + std::clamp(iterations_ / 8, std::min(kLeastSkip, settings_.skip),
                                              settings_.skip);
    }
    ++iterations_;
    if (!step_from_y(fresh)) return State::kDiverged;
    const bool no_progress = fresh && iterations_ % kStallCheck == 0 && without_progress();
    const double beta = next_beta();
    y_ = next_ + beta * (next_ - r_);
    u_y_ = (1.0 + beta) * u_next_ - beta * u_;
    r_.swap(next_);
    u_.swap(u_next_);
    L_ = std::max(kShrinkage * L_, kLeast);
    answer_is_old_ = true;
    return no_progress && !somebody_wakes() ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override {
    if (answer_is_old_) write_parts(awake_, r_, answer_);
    answer_is_old_ = false;
    return answer_;
  }

  // Of the cones that are awake; the others were right when they were looked at last.
  double own_eta() const override {
    double worst = 0.0;
    for_each_awake([&]<int D>(int i, int at, const Cone& cone) {
      const double lambda = problem_.mobility()(i);
      const Eigen::Matrix<double, D, 1> r = r_.segment<D>(at, cone.dim);
      Eigen::Matrix<double, D, 1> u_hat = u_.segment<D>(at, cone.dim);
      problems::add_de_saxce(cone.theta, u_hat);
      Eigen::Matrix<double, D, 1> projected = r - u_hat / lambda;
      problems::project(cone.mu, projected);
      const double error = lambda * (r - projected).norm();
      worst = std::isnan(error) ? error : std::max(error, worst);
    });
    return problem_.rate_scale() > 0.0 ? worst / problem_.rate_scale() : worst;
  }
  double work_s() const override { return work_s_; }

 private:
  // Who has a reaction, or would have one after a step from y; everybody where those are most. What
  // the others' rates are is not known until the next time.
  void choose_awake(bool fresh) {
    bring_up_to_date();
    if (fresh) refresh_shift();
    std::vector<int> chosen;
    for_each_awake([&]<int D>(int i, int at, const Cone& cone) {
      const Eigen::Matrix<double, D, 1> next = step<D>(i, at, cone);
      if (!next.isZero(0.0) || !r_.segment<D>(at, cone.dim).isZero(0.0) ||
          !y_.segment<D>(at, cone.dim).isZero(0.0)) {
        chosen.push_back(i);
      }
    });
    if (static_cast<double>(chosen.size()) > kMost * static_cast<double>(all_.size())) return;
    for (Eigen::VectorXd* x : {&r_, &u_, &y_, &u_y_}) *x = parts_of(chosen, *x);
    mobility_ = parts_of(chosen, mobility_of_all_);
    next_.resizeLike(r_);
    awake_ = std::move(chosen);
    answer_.setZero();
    answer_is_old_ = true;
  }

  bool somebody_wakes() {
    if (awake_.size() == all_.size()) return false;
    const std::vector<int> before = awake_;
    choose_awake(true);
    return !std::ranges::includes(before, awake_);
  }

  // Wakes everybody. Who slept gets the rate at r for that at y too.
  void bring_up_to_date() {
    if (awake_.size() == all_.size()) return;
    std::vector<int> asleep;
    std::ranges::set_difference(all_, awake_, std::back_inserter(asleep));
    Eigen::VectorXd u(problem_.rows() - r_.size());
    product_.rate(awake_, r_, asleep, u);
    work_s_ += product_.work_s();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(u.size());
    merge(asleep, none, r_);
    merge(asleep, none, y_);
    merge(asleep, u, u_y_);
    merge(asleep, u, u_);
    awake_ = all_;
    mobility_ = mobility_of_all_;
    next_.resizeLike(r_);
  }

  // The parts of all cones from those of the awake, x, and of those asleep.
  void merge(std::span<const int> asleep, const Eigen::VectorXd& theirs, Eigen::VectorXd& x) const {
    Eigen::VectorXd whole(problem_.rows());
    write_parts(awake_, x, whole);
    write_parts(asleep, theirs, whole);
    x.swap(whole);
  }

  void write_parts(std::span<const int> cones, const Eigen::VectorXd& parts,
                   Eigen::VectorXd& whole) const {
    for_each(cones, [&]<int D>(int i, int at, const Cone& cone) {
      whole.segment<D>(problem_.start(i), cone.dim) = parts.segment<D>(at, cone.dim);
    });
  }

  Eigen::VectorXd parts_of(std::span<const int> cones, const Eigen::VectorXd& whole) const {
    Eigen::VectorXd parts(whole.size());
    Eigen::Index size = 0;
    for (const int i : cones) {
      const int dim = cone_of(i).dim;
      parts.segment(size, dim) = whole.segment(problem_.start(i), dim);
      size += dim;
    }
    parts.conservativeResize(size);
    return parts;
  }

  void refresh_shift() {
    for_each_awake([&]<int D>(int i, int at, const Cone& cone) { refresh_shift<D>(i, at, cone); });
  }

  template <int D>
  void refresh_shift(int i, int at, const Cone& cone) {
    shift_(i) = cone.theta * problems::tangential_norm(u_y_.segment<D>(at, cone.dim));
  }

  // r+ = P_K(y - u_hat / (L lambda)) and u there, with L as large as the step asks for. False where
  // it is not finite.
  bool step_from_y(bool fresh) {
    for (int trial = 0; trial < kTrials; ++trial) {
      for_each_awake([&]<int D>(int i, int at, const Cone& cone) {
        if (fresh && trial == 0) refresh_shift<D>(i, at, cone);
        next_.segment<D>(at, cone.dim) = step<D>(i, at, cone);
      });
      rate(next_, u_next_);
      const double square = (next_ - y_).cwiseAbs2().dot(mobility_);
      if (!std::isfinite(square)) return false;
      const double curvature = (next_ - y_).dot(u_next_ - u_y_);
      if (!(curvature > L_ * square) || too_small_to_measure()) return std::isfinite(curvature);
      L_ *= kGrowth;
    }
    return true;
  }

  template <int D>
  Eigen::Matrix<double, D, 1> step(int i, int at, const Cone& cone) const {
    const double length = 1.0 / (L_ * problem_.mobility()(i));
    Eigen::Matrix<double, D, 1> part(cone.dim);
    for (int k = 0; k < part.size(); ++k) part(k) = y_(at + k) - length * u_y_(at + k);
    part(0) -= length * shift_(i);
    problems::project(cone.mu, part);
    return part;
  }

  void rate(const Eigen::VectorXd& r, Eigen::VectorXd& u) {
    if (awake_.size() == all_.size()) {
      product_.rate(r, u);
    } else {
      u.resize(r.size());
      product_.rate(awake_, r, awake_, u);
    }
    work_s_ += work_of_all_s_ * static_cast<double>(r.size()) /
               static_cast<double>(mobility_of_all_.size());
  }

  bool too_small_to_measure() const {
    return size_of(next_ - y_) <= kTooSmallToMeasure * size_of(next_);
  }

  bool without_progress() const {
    return std::max(size_of(next_ - r_), size_of(next_ - y_)) <= kNoProgress * size_of(r_);
  }

  // max_i lambda_i |x_i| [rate_unit].
  template <class Vector>
  double size_of(const Eigen::MatrixBase<Vector>& x) const {
    double largest = 0.0;
    for_each_awake([&]<int D>(int i, int at, const Cone& cone) {
      largest =
          std::max(largest, problem_.mobility()(i) * x.template segment<D>(at, cone.dim).norm());
    });
    return largest;
  }

  // beta of weight_ = w: w (1 - w) / (w^2 + w+), where w+^2 = (1 - w+) w^2.
  double next_beta() {
    if ((next_ - y_).cwiseProduct(mobility_).dot(next_ - r_) < 0.0) {
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

  template <class Function>
  void for_each_awake(const Function& function) const {
    for_each(awake_, function);
  }

  // function.operator()<D>(i, first row of its part, cone).
  template <class Function>
  void for_each(std::span<const int> cones, const Function& function) const {
    int at = 0;
    for (const int i : cones) {
      const Cone& cone = cone_of(i);
      with_dimension(cone.dim, [&]<int D>() { function.template operator()<D>(i, at, cone); });
      at += cone.dim;
    }
  }

  const Problem& problem_;
  Settings settings_;
  DelassusProduct product_;
  double work_of_all_s_, work_s_ = 0.0;
  std::vector<int> all_, awake_;     // cones
  Eigen::VectorXd mobility_of_all_;  // lambda_i on each row of cone i
  Eigen::VectorXd mobility_;         // likewise
  Eigen::VectorXd shift_;            // of all: theta_i |u_it| at y, of now or of the last time
  mutable Eigen::VectorXd answer_;   // of all: r, where somebody asked for it since it moved
  mutable bool answer_is_old_ = false;
  Eigen::VectorXd r_, u_, y_, u_y_;  // u at r, at y
  Eigen::VectorXd next_, u_next_;    // r+, u at it
  double L_ = 1.0, weight_ = 1.0;
  std::int64_t iterations_ = 0, next_choice_ = 0;
};

Solver make(const Method& method, const Values& values) {
  const Settings settings{std::get<std::int64_t>(values.at("refresh")),
                          std::get<std::int64_t>(values.at("skip"))};
  return make_iterative_solver(
      method, values, refuse_zero_delassus,
      [settings](const Problem& problem) { return std::make_unique<Apgd>(problem, settings); });
}

}  // namespace

std::unique_ptr<Iteration> make_apgd(const Problem& problem) {
  return std::make_unique<Apgd>(problem, Settings{});
}

Method apgd() {
  Method method{
      .name = "apgd",
      .kind = Kind::kMethod,
      .summary = "accelerated projected gradient, restarted, De Saxce term refreshed",
      .source =
          "Mazhar, Heyn, Negrut, Tasora, ACM Trans. Graph. 34(3) (2015), Algorithm 1; restart: "
          "O'Donoghue, Candes, Found. Comput. Math. 15 (2015) (neither checked)",
      .parameters =
          {{.name = "refresh",
            .fallback = std::int64_t{1},
            .low = 1,
            .high = 10000,
            .doc = "iterations between two refreshes of the De Saxce term [-]"},
           {.name = "skip",
            .fallback = std::int64_t{50},
            .low = 1,
            .high = 10000,
            .doc = "iterations at most that cones without a reaction are left out; 1: none"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
