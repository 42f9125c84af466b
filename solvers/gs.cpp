#include "solvers/gs.h"

#include <fmt/format.h>

#include <limits>

#include "solvers/coloured_sweep.h"
#include "solvers/gs_coupling.h"
#include "solvers/gs_schedule.h"
#include "solvers/gs_sweeper.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using Form = GaussSeidelSettings::Form;

// The velocity form drifts by rounding; its state is recomputed from r this often.
constexpr std::int64_t kSweepsPerRefresh = 50;
// Below this share of max lambda_i |r_i|, the change of a sweep is rounding, not progress.
constexpr double kNoProgress = 1e-16;
// Sweeps that go round in circles move r by more than eta says; an estimate this much lower only
// costs a verification now and then.
constexpr double kChangePerEta = 10.0;
constexpr int kPartialSweepsOfIslands = 9;
constexpr int kMostDenseRows = 6000;  // 300 MB of W

int partial_sweeps(const GaussSeidelSettings& settings) {
  if (settings.partial_sweeps > 0) return static_cast<int>(settings.partial_sweeps);
  return settings.islands ? kPartialSweepsOfIslands : 0;
}

// The local solve, and the reading and writing of what couples it to the others.
double seconds_per_cone(const Problem& problem) {
  const auto couplings = problem.is_primal() ? 2 * problem.H().nonZeros() : problem.W().nonZeros();
  return 50e-9 + 1.5e-9 * static_cast<double>(couplings) / std::max(problem.cone_count(), 1);
}

template <class Coupling>
class GaussSeidel final : public Iteration {
 public:
  GaussSeidel(const Problem& problem, const GaussSeidelSettings& settings, Coupling coupling)
      : problem_(problem),
        rate_scale_(problem.rate_scale()),
        symmetric_(settings.symmetric),
        sweeper_(problem, settings.local, settings.omega, settings.regularization,
                 std::move(coupling)),
        schedule_(problem, partial_sweeps(settings), settings.islands),
        seconds_per_cone_(seconds_per_cone(problem)) {
    if (settings.threads) coloured_.emplace(problem, sweeper_.coupling(), *settings.threads);
  }

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    sweeps_ = 0;
    change_ = std::numeric_limits<double>::infinity();
    schedule_.restart();
    failures_ = {};
  }

  State advance() override {
    if (sweeps_ % kSweepsPerRefresh == 0) refresh();
    ++sweeps_;
    const auto cones = schedule_.next();
    SweepSize size = coloured_ ? coloured_->sweep(sweeper_, r_)
                               : sweeper_.sweep(cones, false, schedule_.changes(), r_);
    work_s_ += (symmetric_ ? 2.0 : 1.0) * seconds_per_cone_ * static_cast<double>(cones.size());
    if (symmetric_) {
      size.add(sweeper_.sweep(cones, true, schedule_.changes(), r_));
    }
    failures_.add(size.failures);
    change_ = std::max(size.change, schedule_.largest_change());
    if (!std::isfinite(change_)) return State::kDiverged;
    const bool still = schedule_.full() && change_ <= kNoProgress * size.reaction;
    return still ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }

  double own_eta() const override {
    return change_ > 0.0 ? change_ / (kChangePerEta * rate_scale_) : 0.0;
  }

  double work_s() const override { return work_s_; }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    if (failures_.unsolvable >= 0) {
      notes.push_back(
          fmt::format("cone {}: its one-cone problem has no solution", failures_.unsolvable));
    }
    if (failures_.stopped > 0) {
      notes.push_back(fmt::format("{} of {} local solves stopped short of a solution",
                                  failures_.stopped, failures_.solved));
    }
    return notes;
  }

 private:
  void refresh() {
    if (coloured_) return coloured_->refresh(sweeper_.coupling(), problem_, r_);
    solvers::refresh(sweeper_.coupling(), problem_, r_);
  }

  const Problem& problem_;
  double rate_scale_;
  bool symmetric_;
  Sweeper<Coupling> sweeper_;
  SweepSchedule schedule_;
  std::optional<ColouredSweep<Coupling>> coloured_;
  LocalFailures failures_;
  Eigen::VectorXd r_;
  std::int64_t sweeps_ = 0;
  double seconds_per_cone_, work_s_ = 0.0;
  double change_ = std::numeric_limits<double>::infinity();
};

LocalKind local_kind(const std::string& name) {
  if (name == "projection") return LocalKind::kProjection;
  if (name == "newton-ac") return LocalKind::kNewtonAc;
  if (name == "newton-fb") return LocalKind::kNewtonFb;
  if (name == "quartic") return LocalKind::kQuartic;
  return LocalKind::kExact;
}

GaussSeidelSettings settings_from(const Values& values) {
  const std::string& form = std::get<std::string>(values.at("form"));
  return {.local = local_kind(std::get<std::string>(values.at("local"))),
          .form = form == "velocity"   ? Form::kVelocity
                  : form == "delassus" ? Form::kDelassus
                                       : Form::kAuto,
          .omega = std::get<double>(values.at("omega")),
          .regularization = std::get<double>(values.at("regularization")),
          .symmetric = std::get<std::string>(values.at("sweep")) == "symmetric",
          .partial_sweeps = std::get<std::int64_t>(values.at("skip")),
          .islands = std::get<bool>(values.at("islands"))};
}

Solver make(const Method& method, const Values& values) {
  const GaussSeidelSettings settings = settings_from(values);
  auto refuses = [settings](const Problem& problem) {
    return gauss_seidel_refuses(problem, settings);
  };
  auto iteration = [settings](const Problem& problem) {
    return make_gauss_seidel(problem, settings);
  };
  return make_iterative_solver(method, values, refuses, iteration);
}

std::vector<Parameter> parameters() {
  return {{.name = "local",
           .fallback = std::string("exact"),
           .choices = {"exact", "projection", "newton-ac", "newton-fb", "quartic"},
           .doc = "how one cone is solved: to rounding, by one projected step, by a semismooth "
                  "Newton, or by enumeration (d = 3)"},
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
           .doc = "share of lambda_i added to singular W_ii (all locals but projection) [-]"},
          {.name = "sweep",
           .fallback = std::string("forward"),
           .choices = {"forward", "symmetric"},
           .doc = "one pass over the cones, or a forward and a backward one"},
          {.name = "skip",
           .fallback = std::int64_t{0},
           .low = 0,
           .high = 1000,
           .doc = "sweeps between two full ones that leave out the cones at rest [-]"},
          {.name = "islands",
           .fallback = false,
           .doc = "9 (or skip) of 10 sweeps leave out connected components that are ahead"}};
}

}  // namespace

std::optional<std::string> gauss_seidel_refuses(const Problem& problem,
                                                const GaussSeidelSettings& settings) {
  if (settings.form == Form::kVelocity && !has_velocity_form(problem)) {
    return "form=velocity needs M and H with M block diagonal";
  }
  if (problem.is_primal() && !has_velocity_form(problem) && problem.rows() > kMostDenseRows) {
    return fmt::format("M couples many dofs, so that W is dense: {} rows, expected at most {}",
                       problem.rows(), kMostDenseRows);
  }
  if (settings.local != LocalKind::kQuartic) return std::nullopt;
  for (const Cone& cone : problem.cones()) {
    if (cone.dim != 1 && cone.dim != 3) {
      return fmt::format("local=quartic takes cones of d = 1 and 3, found d = {}", cone.dim);
    }
    if (cone.theta != cone.mu) return "local=quartic needs theta = mu";
  }
  return std::nullopt;
}

std::unique_ptr<Iteration> make_gauss_seidel(const Problem& problem,
                                             const GaussSeidelSettings& settings) {
  const bool velocity = settings.form != Form::kDelassus && has_velocity_form(problem);
  return with_coupling(
      problem, velocity, [&]<class Coupling>(Coupling coupling) -> std::unique_ptr<Iteration> {
        return std::make_unique<GaussSeidel<Coupling>>(problem, settings, std::move(coupling));
      });
}

double gauss_seidel_sweep_work_s(const Problem& problem) {
  return seconds_per_cone(problem) * problem.cone_count();
}

std::size_t gauss_seidel_sweep_bytes(const Problem& problem) {
  constexpr GaussSeidelSettings kSettings;
  BlockedRows rows(problem);
  return with_products(rows, [&]<class Products>() {
    VelocityCoupling<Products> coupling(problem, std::move(rows));
    const std::size_t coupling_bytes = coupling.bytes();
    const Sweeper sweeper(problem, kSettings.local, kSettings.omega, kSettings.regularization,
                          std::move(coupling));
    return coupling_bytes + sweeper.bytes();
  });
}

Method gauss_seidel() {
  Method method{
      .name = "gs",
      .kind = Kind::kMethod,
      .summary = "Gauss-Seidel, one cone at a time",
      .source =
          "Jourdan, Alart, Jean, CMAME 155 (1998) 31-47 (not checked); local step: our derivation",
      .parameters = parameters(),
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
