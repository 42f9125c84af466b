#include "solvers/pyramid.h"

#include <fmt/format.h>

#include <cmath>

#include "problems/error.h"
#include "solvers/gs.h"
#include "solvers/gs_coupling.h"
#include "solvers/lemke.h"
#include "solvers/method.h"
#include "solvers/pyramid_law.h"
#include "solvers/pyramid_lcp.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr Eigen::Index kMostVariables = 4000;
constexpr int kSweepsPerTest = 10;
// Below this share of max lambda_i |r_i|, the change of a sweep is rounding, not progress.
constexpr double kNoProgress = 1e-16;

std::optional<Status> limit(const Stop& stop, const Monitor& monitor, std::int64_t iterations) {
  if (iterations >= stop.max_iterations) return Status::kIterationLimit;
  if (monitor.elapsed_s() >= stop.time_limit_s) return Status::kTimeLimit;
  return std::nullopt;
}

Result solve_by_pivots(const PyramidLaw& law, const Problem& problem, const Stop& stop,
                       Monitor& monitor) {
  const PyramidLcp lcp(problem, law);
  Lemke lemke(lcp.M, lcp.q);
  monitor.setup_done();
  Result result;
  const LemkeEnd end = lemke.solve([&](std::int64_t pivots) {
    const auto reached = limit(stop, monitor, pivots);
    result.status = reached.value_or(Status::kStalled);
    return !reached;
  });
  result.iterations = lemke.pivots();
  result.r = lcp.reaction(lemke.z());
  if (end == LemkeEnd::kRay) {
    result.status = Status::kStalled;
    result.notes.push_back("Lemke's method ended on a ray: it found no solution of the pyramids");
  }
  if (end != LemkeEnd::kSolved) return result;
  const double eta = law.eta(problem, result.r);
  result.status = eta <= stop.tol ? Status::kConverged : Status::kStalled;
  if (eta > stop.tol) {
    result.notes.push_back(
        fmt::format("rounding in {} pivots left an own eta of {:.1e}", result.iterations, eta));
  }
  return result;
}

template <class Coupling>
class Sweeps {
 public:
  Sweeps(const PyramidLaw& law, const Problem& problem, Coupling coupling)
      : law_(law), problem_(problem), coupling_(std::move(coupling)) {}

  Result run(const Stop& stop, Eigen::VectorXd guess, Monitor& monitor) {
    Result result;
    result.r = std::move(guess);
    std::optional<Status> end;  // why the sweeps end
    while (true) {
      if (!end) end = limit(stop, monitor, result.iterations);
      const bool tested = end || result.iterations % kSweepsPerTest == 0;
      if (tested && law_.eta(problem_, result.r) <= stop.tol) end = Status::kConverged;
      if (end) break;
      if (tested) refresh(coupling_, problem_, result.r);
      end = sweep(result.r);
      ++result.iterations;
    }
    result.status = *end;
    return result;
  }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  // One pass over the cones; why there is no use in another.
  std::optional<Status> sweep(Eigen::VectorXd& r) {
    double change = 0.0, reaction = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i);
      const double lambda = problem_.mobility()(i);
      auto part = r.segment(at, cone(i).dim);
      Eigen::VectorXd u(cone(i).dim);
      coupling_.rate(i, at, u);
      law_.shift_rate(cone(i).theta, u);
      Eigen::VectorXd next = part - u / lambda;
      law_.project(cone(i).mu, next);
      const Eigen::VectorXd moved = next - part;
      if (!moved.allFinite()) return Status::kDiverged;
      coupling_.moved(i, moved);
      part = next;
      change = std::max(change, lambda * moved.norm());
      reaction = std::max(reaction, lambda * next.norm());
    }
    return change <= kNoProgress * reaction ? std::optional(Status::kStalled) : std::nullopt;
  }

  const PyramidLaw& law_;
  const Problem& problem_;
  Coupling coupling_;
};

Result solve_by_sweeps(const PyramidLaw& law, const Problem& problem, const Stop& stop,
                       Eigen::VectorXd guess, Monitor& monitor) {
  return with_coupling(problem, has_velocity_form(problem), [&]<class Coupling>(Coupling coupling) {
    Sweeps<Coupling> sweeps(law, problem, std::move(coupling));
    monitor.setup_done();
    return sweeps.run(stop, std::move(guess), monitor);
  });
}

std::optional<std::string> refuse_size(const PyramidLaw& law, const Problem& problem) {
  const Eigen::Index size = PyramidLcp::size(problem, law);
  if (size <= kMostVariables) return std::nullopt;
  return fmt::format("method=lemke needs {} variables, expected at most {}", size, kMostVariables);
}

Solver make(const Method& method, const Values& values) {
  const auto faces = static_cast<int>(std::get<std::int64_t>(values.at("faces")));
  problems::require(faces % 2 == 0, "pyramid", "faces is ", faces, ", expected an even number");
  const PyramidLaw law(faces);
  const bool pivots = std::get<std::string>(values.at("method")) == "lemke";
  const auto refuses = [law, pivots](const Problem& problem) -> std::optional<std::string> {
    if (auto why = PyramidLaw::refuses(problem)) return why;
    if (auto why = refuse_zero_delassus(problem)) return why;
    return pivots ? refuse_size(law, problem) : gauss_seidel_refuses(problem, {});
  };
  // Only the answer is shown to the monitor, which looks for solutions of the problem as posed.
  const auto iterate = [law, pivots](const Problem& problem, const Stop& stop,
                                     Eigen::VectorXd guess, Monitor& monitor) {
    Result result = pivots ? solve_by_pivots(law, problem, stop, monitor)
                           : solve_by_sweeps(law, problem, stop, std::move(guess), monitor);
    result.status = monitor.conclude(result.status, result.iterations, result.r);
    return result;
  };
  return make_checked_solver(method, values, refuses, iterate);
}

}  // namespace

Method pyramid_model() {
  Method method{.name = "pyramid",
                .kind = Kind::kModel,
                .summary = "model: pyramids for friction cones, a linear complementarity problem",
                .source =
                    "Anitescu, Potra, Nonlinear Dyn. 14 (1997) 231-247; Stewart, Trinkle, Int. J. "
                    "Numer. Meth. Eng. 39 (1996) 2673-2691; Lemke: Cottle, Pang, Stone, The Linear "
                    "Complementarity Problem (1992) (none checked); theta < mu: ours",
                .parameters = {{.name = "faces",
                                .fallback = std::int64_t{8},
                                .low = 4,
                                .high = 256,
                                .doc = "faces of the pyramid of a cone of d = 3, even [-]"},
                               {.name = "method",
                                .fallback = std::string("lemke"),
                                .choices = {"lemke", "pgs"},
                                .doc = "complementary pivots, or projected Gauss-Seidel"}},
                .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
