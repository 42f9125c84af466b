#include "solvers/ipm.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/aclm.h"
#include "solvers/linear/general_system.h"
#include "solvers/linear/kkt_system.h"
#include "solvers/linear/normal_system.h"
#include "solvers/nt_scaling.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using State = Iteration::State;

constexpr double kToBoundary = 0.995;                     // share of the way to the cone's boundary
constexpr double kLeastPush = 1e-12, kLargestPush = 1.0;  // into the interior, as shares of U
// Cones of less mobility than this share of the largest start from no larger a reaction.
constexpr double kLeastMobility = 1e-4;
constexpr double kInside = 4e-16;  // least relative distance from the boundary
constexpr int kRefinements = 3;
constexpr double kRegularisation = 1e-12;  // of W, as a share of the mobility
constexpr double kFine = 1e-10;            // a larger one asks for the finer form
constexpr double kRefined = 1e-13;         // relative residual that needs no refinement
constexpr double kRounding = 2e-15;        // of a sum, as a share of the sum of its terms' sizes
constexpr int kShortenings = 8;
constexpr double kShortestStep = 1e-8;

// (I + R C W R^T) y = z, by whichever matrix was chosen; C = I where the system is symmetric.
class System {
 public:
  System(const Problem& problem, IpmForm form, bool symmetric)
      : problem_(problem), identity_(problem), L_(problem), S_(problem), SC_(problem) {
    if (!symmetric) {
      general_ = std::make_unique<GeneralSystem>(problem, GeneralSystem::Form::kAuto, true);
      for (int i = 0; i < identity_.count(); ++i) identity_[i].setIdentity();
      return;
    }
    bool kkt = form == IpmForm::kKkt;
    may_switch_ = form == IpmForm::kAuto && problem.is_primal();
    if (may_switch_) {
      kkt = KktSystem::nonzeros(problem) < NormalSystem::nonzeros(problem);
    }
    if (kkt) {
      kkt_ = std::make_unique<KktSystem>(problem);
    } else {
      normal_ = std::make_unique<NormalSystem>(problem);
    }
  }

  // The quasidefinite form from here on: near the solution the normal equations lose what R, very
  // large on some cones and very small on others, makes cancel in them.
  bool can_be_finer() const { return may_switch_ && normal_ != nullptr; }
  void be_finer(const Problem& problem) {
    normal_.reset();
    kkt_ = std::make_unique<KktSystem>(problem);
  }

  // I + R C W R^T + delta R R^T = L (I + S C W S^T) L^T with S = L^-1 R, L L^T = I + delta R R^T:
  // what is factorised has no weight above 1 / delta.
  bool factorize(const BlockDiagonal& R, const BlockDiagonal& C) {
    for (int i = 0; i < R.count(); ++i) {
      const double delta = kRegularisation / problem_.mobility()(i);
      Eigen::MatrixXd bounded = delta * R[i] * R[i].transpose();
      bounded.diagonal().array() += 1.0;
      L_[i] = bounded.llt().matrixL();
      S_[i] = L_[i].triangularView<Eigen::Lower>().solve(R[i]);
    }
    if (kkt_) return kkt_->factorize(S_);
    if (normal_) return normal_->factorize_root(S_);
    for (int i = 0; i < R.count(); ++i) SC_[i].noalias() = S_[i] * C[i];
    return general_->factorize(identity_, SC_, &S_);
  }

  Eigen::VectorXd solve(Eigen::VectorXd z) const {
    for (int i = 0; i < L_.count(); ++i) {
      auto part = z.segment(problem_.start(i), L_[i].rows());
      L_[i].triangularView<Eigen::Lower>().solveInPlace(part);
    }
    z = kkt_ ? kkt_->solve(z) : normal_ ? normal_->solve_root(z) : general_->solve(z);
    for (int i = 0; i < L_.count(); ++i) {
      auto part = z.segment(problem_.start(i), L_[i].rows());
      L_[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part);
    }
    return z;
  }

 private:
  const Problem& problem_;
  BlockDiagonal identity_, L_, S_, SC_;
  bool may_switch_ = false;
  std::unique_ptr<NormalSystem> normal_;
  std::unique_ptr<KktSystem> kkt_;
  std::unique_ptr<GeneralSystem> general_;
};

class InteriorPoint final : public ConvexIteration {
 public:
  // With `coulomb` the shift is theta |u_t|_eps of the iterate itself, else the one posed.
  InteriorPoint(const Problem& problem, IpmForm form, bool coulomb)
      : problem_(problem),
        coulomb_(coulomb),
        system_(problem, form, !coulomb),
        R_(problem),
        C_(problem),
        scalings_(static_cast<std::size_t>(problem.cone_count())) {}

  void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) override {
    posed_ = shift;
    const Eigen::VectorXd u = problem_.rate(r);
    const Eigen::VectorXd t = coulomb_ ? de_saxce_shift(problem_, u) : posed_;
    const double violation = convex_error(problem_, t, r, u);
    const double push = std::clamp(10.0 * violation, kLeastPush, kLargestPush) * scale();
    r_ = x_ = Eigen::VectorXd::Zero(problem_.rows());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      const double lambda = problem_.mobility()(i), mu = cone(i).mu;
      Eigen::VectorXd z = r.segment(at, dim) - u.segment(at, dim) / lambda;
      z(0) -= t(i) / lambda;
      Eigen::VectorXd projected = z;
      problems::project(mu, projected);
      r_.segment(at, dim) = projected;
      x_.segment(at, dim) = lambda * (projected - z);
      // As far from the boundary in either cone, whatever mu.
      const double size = std::max(lambda, kLeastMobility * problem_.mobility().maxCoeff());
      r_(at) += push / size * std::max(1.0, 1.0 / std::max(mu, 0.1));
      x_(at) += push * std::max(1.0, mu);
    }
    u_ = problem_.rate(r_);
    update();
  }

  State advance(double) override {
    if (problem_.cone_count() == 0) return State::kStalled;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      NtScaling& scaling = scalings_[static_cast<std::size_t>(i)];
      scaling.set(cone(i).mu, r_.segment(at, dim), x_.segment(at, dim));
      scaling.write_R(R_[i]);
    }
    const Eigen::VectorXd residual = residual_above_rounding();
    if (!residual.allFinite()) return State::kDiverged;
    if (!affine_direction(residual)) return State::kStalled;
    const double affine = step_length(1.0);
    const double sigma = std::pow(1.0 - affine, 3);
    direction((1.0 - sigma) * residual, sigma * nu_, affine * affine);
    double step = kToBoundary * step_length(1.0 / kToBoundary);
    if (!dr_.allFinite() || !dx_.allFinite()) return State::kDiverged;
    step = coulomb_ ? shorten(step, 1.0 - sigma, residual.norm()) : std::min(step, 1.0);
    if (step < kShortestStep) return State::kStalled;
    r_ += step * dr_;
    x_ += step * dx_;
    keep_inside();
    u_ = problem_.rate(r_);
    update();
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  const Eigen::VectorXd& u() const override { return u_; }
  double error() const override { return error_; }
  double eta() const { return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_); }
  double smoothing() const { return smoothing_; }
  double gap() const { return nu_; }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }
  double scale() const { return problem_.rate_scale() > 0.0 ? problem_.rate_scale() : 1.0; }

  // Gap, shift and its derivative at the current iterate.
  void update() {
    nu_ = r_.dot(x_) / std::max(problem_.cone_count(), 1);
    smoothing_ = 0.0;
    if (coulomb_) posed_.resize(problem_.cone_count());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      C_[i].setIdentity();
      if (!coulomb_) continue;
      const int at = problem_.start(i), tangents = cone(i).dim - 1;
      const double root = std::sqrt(std::max(nu_, 0.0) * problem_.mobility()(i));
      const double eps = root * std::min(1.0, root / scale());
      smoothing_ = std::max(smoothing_, eps);
      const auto ut = u_.segment(at + 1, tangents);
      const double length = std::hypot(ut.norm(), eps);
      posed_(i) = cone(i).theta * length;
      if (length > 0.0) {
        C_[i].row(0).tail(tangents) = (cone(i).theta / length * ut).transpose();
      }
    }
    error_ = convex_error(problem_, posed_, r_, u_);
  }

  // e, its entries of the size of the rounding in u taken as zero: where x is smaller than that
  // they would swamp the direction.
  Eigen::VectorXd residual_above_rounding() const {
    const Eigen::VectorXd terms =
        problem_.is_primal()
            ? Eigen::VectorXd(problem_.H().cwiseAbs() * problem_.velocity(r_).cwiseAbs() +
                              problem_.w().cwiseAbs())
            : Eigen::VectorXd(problem_.W().cwiseAbs() * r_.cwiseAbs() + problem_.q().cwiseAbs());
    Eigen::VectorXd e = u_ + shift_normals() - x_;
    for (Eigen::Index row = 0; row < e.size(); ++row) {
      if (std::abs(e(row)) <= kRounding * terms(row)) e(row) = 0.0;
    }
    return e;
  }

  Eigen::VectorXd shift_normals() const {
    Eigen::VectorXd t = Eigen::VectorXd::Zero(problem_.rows());
    for (int i = 0; i < problem_.cone_count(); ++i) t(problem_.start(i)) = posed_(i);
    return t;
  }

  // False where the system has no factor in doubles.
  bool affine_direction(const Eigen::VectorXd& residual) {
    const bool factorised = system_.factorize(R_, C_);
    if (factorised && direction(residual, 0.0, 0.0) <= kFine) return true;
    if (!system_.can_be_finer()) return factorised;
    system_.be_finer(problem_);
    if (!system_.factorize(R_, C_)) return false;
    direction(residual, 0.0, 0.0);
    return true;
  }

  // dr~ + dx~ = lambda \ (target - lambda o lambda - correction * last dx~ o last dr~) with
  // dx = C W dr + e gives (I + R C W R^T) dr~ = that - R e, refined against W itself.
  // Returns the relative residual that is left.
  double direction(const Eigen::VectorXd& residual, double target, double correction) {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(problem_.rows());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const NtScaling& scaling = scalings_[static_cast<std::size_t>(i)];
      const Eigen::Index at = problem_.start(i), size = scaling.size();
      Eigen::VectorXd c = -jordan_product(scaling.lambda(), scaling.lambda());
      c(0) += target;
      if (correction > 0.0) {
        c -=
            correction * jordan_product(scaled_dx_.segment(at, size), scaled_dr_.segment(at, size));
      }
      z.segment(at, size) = jordan_divide(scaling.lambda(), c);
    }
    const Eigen::VectorXd rhs = z - R_ * residual;
    auto move = [&](const Eigen::VectorXd& scaled) {
      scaled_dr_ = scaled;
      dr_ = R_.transpose_times(scaled);
      du_ = problem_.apply_delassus(dr_);
      dx_ = C_ * du_;
      return Eigen::VectorXd(rhs - scaled - R_ * dx_);
    };
    Eigen::VectorXd left = move(system_.solve(rhs));
    for (int k = 0; k < kRefinements && left.norm() > kRefined * rhs.norm(); ++k) {
      const Eigen::VectorXd before = scaled_dr_;
      const Eigen::VectorXd left_then = move(before + system_.solve(left));
      if (!(left_then.norm() < left.norm())) {
        move(before);
        break;
      }
      left = left_then;
    }
    dx_ += residual;
    scaled_dx_ = z - scaled_dr_;
    return left.norm() / std::max(rhs.norm(), std::numeric_limits<double>::min());
  }

  // The longest step that keeps r and x in their cones.
  double step_length(double longest) const {
    double step = longest;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const NtScaling& scaling = scalings_[static_cast<std::size_t>(i)];
      const Eigen::Index at = problem_.start(i), size = scaling.size();
      step = longest_step(scaling.lambda(), scaled_dr_.segment(at, size), step);
      step = longest_step(scaling.lambda(), scaled_dx_.segment(at, size), step);
    }
    return step;
  }

  // Rounding may put an iterate on the boundary of its cone, where the scaling does not exist.
  void keep_inside() {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const double mu = cone(i).mu;
      auto r = r_.segment(problem_.start(i), cone(i).dim);
      auto x = x_.segment(problem_.start(i), cone(i).dim);
      if (mu == 0.0) {
        r.tail(cone(i).dim - 1).setZero();
        continue;
      }
      r(0) = std::max(r(0), problems::tangential_norm(r) / mu * (1.0 + kInside));
      x(0) = std::max(x(0), mu * problems::tangential_norm(x) * (1.0 + kInside));
    }
  }

  // The residual of the nonlinear x = u + theta |u_t|_eps e_n must fall, or stay below the gap.
  double shorten(double step, double share, double before) const {
    step = std::min(step, 1.0);
    const double rounding = 1e-15 * std::max(u_.norm(), scale());
    for (int trial = 0; trial < kShortenings; ++trial) {
      double square = 0.0;
      for (int i = 0; i < problem_.cone_count(); ++i) {
        const int at = problem_.start(i), dim = cone(i).dim;
        const Eigen::VectorXd u = u_.segment(at, dim) + step * du_.segment(at, dim);
        const double root = std::sqrt(std::max(nu_, 0.0) * problem_.mobility()(i));
        const double eps = root * std::min(1.0, root / scale());
        Eigen::VectorXd e = u - x_.segment(at, dim) - step * dx_.segment(at, dim);
        e(0) += cone(i).theta * std::hypot(u.tail(dim - 1).norm(), eps);
        square += e.squaredNorm();
      }
      const double allowed = (1.0 - 0.1 * share * step) * before + rounding;
      if (std::sqrt(square) <= std::max(allowed, 0.1 * std::sqrt(nu_gap()))) return step;
      step *= 0.5;
    }
    return step;
  }

  // The gap as the square of a rate.
  double nu_gap() const { return std::max(nu_, 0.0) * problem_.mobility().maxCoeff(); }

  const Problem& problem_;
  bool coulomb_;
  System system_;
  BlockDiagonal R_, C_;
  std::vector<NtScaling> scalings_;
  Eigen::VectorXd posed_;                  // t
  Eigen::VectorXd r_, x_, u_;              // x -> u + t e_n
  Eigen::VectorXd dr_, dx_, du_;           // of the last direction; du = W dr
  Eigen::VectorXd scaled_dr_, scaled_dx_;  // dr~, dx~
  double nu_ = 0.0;                        // r.x / cones
  double smoothing_ = 0.0;                 // largest eps
  double error_ = 0.0;
};

// Iterations that lowered neither the gap nor eta by this factor, in a row, are a trap.
constexpr double kProgress = 0.9;
constexpr int kPatience = 8;

class CoulombInteriorPoint final : public Iteration {
 public:
  explicit CoulombInteriorPoint(const Problem& problem)
      : problem_(problem), direct_(problem, IpmForm::kAuto, true) {}

  void start(const Eigen::VectorXd& r) override {
    fixed_point_.reset();
    best_ = r;
    const Eigen::VectorXd u = problem_.rate(r);
    eta_ = convex_error(problem_, de_saxce_shift(problem_, u), r, u);
    direct_.pose({}, r);
    least_gap_ = std::numeric_limits<double>::infinity();
    patience_ = kPatience;
    keep_best(direct_.eta(), direct_.r());
  }

  State advance() override {
    if (fixed_point_) {
      const State state = fixed_point_->advance();
      keep_best(fixed_point_->own_eta(), fixed_point_->r());
      return state;
    }
    const double eta = eta_;
    const State state = direct_.advance(0.0);
    if (state == State::kRunning) {
      keep_best(direct_.eta(), direct_.r());
      if (eta_ <= kProgress * eta || direct_.gap() <= kProgress * least_gap_) {
        patience_ = kPatience;
      } else {
        --patience_;
      }
      least_gap_ = std::min(least_gap_, direct_.gap());
      if (patience_ > 0) return state;
    }
    if (problem_.cone_count() == 0) return state;
    fixed_point_ = make_aclm(problem_, make_interior_point(problem_, IpmForm::kAuto), {});
    fixed_point_->start(best_);
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return best_; }
  double own_eta() const override { return eta_; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes{fmt::format("last smoothing eps = {:.2g}", direct_.smoothing())};
    if (fixed_point_) notes.push_back("went on as aclm-ipm from its best iterate");
    return notes;
  }

 private:
  void keep_best(double eta, const Eigen::VectorXd& r) {
    if (!(eta < eta_)) return;
    eta_ = eta;
    best_ = r;
  }

  const Problem& problem_;
  InteriorPoint direct_;
  std::unique_ptr<Iteration> fixed_point_;  // once the direct method is trapped
  Eigen::VectorXd best_;
  double eta_ = 0.0, least_gap_ = 0.0;
  int patience_ = kPatience;
};

IpmForm form_of(const Values& values) {
  const std::string form = std::get<std::string>(values.at("form"));
  return form == "kkt" ? IpmForm::kKkt : form == "normal" ? IpmForm::kNormal : IpmForm::kAuto;
}

std::vector<Parameter> form_parameter() {
  return {{.name = "form",
           .fallback = std::string("auto"),
           .choices = {"auto", "normal", "kkt"},
           .doc = "linear system: normal equations, quasidefinite, or the sparser of the two"}};
}

}  // namespace

std::unique_ptr<ConvexIteration> make_interior_point(const Problem& problem, IpmForm form) {
  return std::make_unique<InteriorPoint>(problem, form, false);
}

std::unique_ptr<Iteration> make_ipm(const Problem& problem) {
  return std::make_unique<CoulombInteriorPoint>(problem);
}

Method interior_point() {
  Method method{.name = "ipm",
                .kind = Kind::kMethod,
                .summary = "primal-dual interior point, the De Saxce term as an unknown",
                .parameters = {},
                .make = {}};
  method.make = [method](const Values& values) {
    return make_iterative_solver(
        method, values, [](const Problem&) { return std::nullopt; }, make_ipm);
  };
  return method;
}

Method aclm_interior_point() {
  return make_aclm_method(
      "aclm-ipm", "fixed point on the De Saxce term; inner primal-dual interior point",
      form_parameter(),
      [](const Values& values) -> MakeConvex {
        return [form = form_of(values)](const Problem& problem) {
          return make_interior_point(problem, form);
        };
      },
      [](const Values& values) -> Refuses {
        return [form = form_of(values)](const Problem& problem) -> std::optional<std::string> {
          if (form != IpmForm::kKkt || problem.is_primal()) return std::nullopt;
          return "form=kkt needs M and H";
        };
      });
}

}  // namespace conebench::solvers
