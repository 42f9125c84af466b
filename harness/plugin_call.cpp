#include "harness/plugin_call.h"

#include <fmt/format.h>

#include <algorithm>

#include "problems/sparse.h"

namespace conebench::harness {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using solvers::Status;

conebench_matrix view_of(const SparseMatrix& matrix) {
  return {sizeof(conebench_matrix),
          static_cast<std::int32_t>(matrix.rows()),
          static_cast<std::int32_t>(matrix.cols()),
          matrix.outerIndexPtr(),
          matrix.innerIndexPtr(),
          matrix.valuePtr()};
}

// The problem as a library sees it: views of the problem, and what it keeps in another shape.
class PosedProblem {
 public:
  explicit PosedProblem(const Problem& problem) {
    for (int i = 0; i < problem.cone_count(); ++i) {
      const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
      start_.push_back(problem.start(i));
      dim_.push_back(cone.dim);
      mu_.push_back(cone.mu);
      theta_.push_back(cone.theta);
    }
    start_.push_back(problem.rows());
    fill(problem);
  }
  PosedProblem(const PosedProblem&) = delete;
  PosedProblem& operator=(const PosedProblem&) = delete;

  const conebench_problem& get() const { return posed_; }

 private:
  void fill(const Problem& problem) {
    posed_.struct_size = sizeof posed_;
    posed_.name = problem.name().c_str();
    posed_.force_unit = problem.metadata().force_unit.c_str();
    posed_.rate_unit = problem.metadata().rate_unit.c_str();
    posed_.cones = problem.cone_count();
    posed_.rows = problem.rows();
    posed_.start = start_.data();
    posed_.dim = dim_.data();
    posed_.mu = mu_.data();
    posed_.theta = theta_.data();
    posed_.mobility = problem.mobility().data();
    posed_.rate_scale = problem.rate_scale();
    posed_.q = problem.q().data();
    if (problem.is_primal()) {
      M_ = view_of(problem.M());
      H_ = view_of(problem.H());
      posed_.dofs = problem.dofs();
      posed_.M = &M_;
      posed_.H = &H_;
      posed_.f = problem.f().data();
      posed_.w = problem.w().data();
    } else {
      W_ = view_of(problem.W());
      posed_.W = &W_;
    }
  }

  std::vector<std::int32_t> start_, dim_;
  std::vector<double> mu_, theta_;
  conebench_matrix M_{}, H_{}, W_{};
  conebench_problem posed_{};
};

std::vector<conebench_value> posed(const PluginLibrary& library, const solvers::Values& values) {
  std::vector<conebench_value> all;
  for (const solvers::Parameter& parameter : library.parameters()) {
    conebench_value& value = all.emplace_back();
    value.struct_size = sizeof value;
    const solvers::Value& given = values.at(parameter.name);
    if (const auto* flag = std::get_if<bool>(&given)) value.boolean = *flag ? 1 : 0;
    if (const auto* whole = std::get_if<std::int64_t>(&given)) value.integer = *whole;
    if (const auto* real = std::get_if<double>(&given)) value.real = *real;
    if (const auto* text = std::get_if<std::string>(&given)) value.text = text->c_str();
  }
  return all;
}

// What the program does for a solver: the functions of a conebench_host and what they work on.
struct Services {
  const Problem& problem;
  solvers::Monitor& monitor;
  Eigen::VectorXd r;  // the answer, in the library's hands
  bool checked = false, stopped = false;
  std::vector<std::string> notes{};
  SparseMatrix W{};
  conebench_matrix W_view{};
};

Services& services(void* context) { return *static_cast<Services*>(context); }

std::int32_t check(void* context, std::int64_t iteration, const double* r) {
  Services& host = services(context);
  if (!host.checked) host.monitor.setup_done();
  host.checked = true;
  const Eigen::Map<const Eigen::VectorXd> elsewhere(r, host.r.size());
  const solvers::Verdict verdict = r == host.r.data()
                                       ? host.monitor.check(iteration, host.r)
                                       : host.monitor.check(iteration, Eigen::VectorXd(elsewhere));
  host.stopped = verdict == solvers::Verdict::kStop;
  return host.stopped ? 0 : 1;
}

void rate(void* context, const double* r, double* u) {
  const Problem& problem = services(context).problem;
  Eigen::Map<Eigen::VectorXd>(u, problem.rows()) =
      problem.rate(Eigen::Map<const Eigen::VectorXd>(r, problem.rows()));
}

const conebench_matrix* delassus(void* context) {
  Services& host = services(context);
  if (host.W_view.struct_size == 0) {
    host.W = problems::canonical(host.problem.delassus());
    host.W_view = view_of(host.W);
  }
  return &host.W_view;
}

void note(void* context, const char* text) { services(context).notes.emplace_back(text); }

Status status_of(const PluginLibrary& library, const conebench_result& result,
                 const Services& host) {
  switch (result.status) {
    case CONEBENCH_STOPPED:
      return host.monitor.status();
    case CONEBENCH_CONVERGED:
      return Status::kConverged;
    case CONEBENCH_ITERATION_LIMIT:
      return Status::kIterationLimit;
    case CONEBENCH_TIME_LIMIT:
      return Status::kTimeLimit;
    case CONEBENCH_STALLED:
      return Status::kStalled;
    case CONEBENCH_DIVERGED:
      return Status::kDiverged;
    case CONEBENCH_INFEASIBLE:
      return Status::kInfeasible;
    case CONEBENCH_UNSUPPORTED:
      return Status::kUnsupported;
    default:
      throw BadAbi(library.path(),
                   fmt::format("answers with status {}, expected 0 to 7", result.status));
  }
}

solvers::Result translated(const PluginLibrary& library, const conebench_result& answer,
                           const Eigen::VectorXd& certificate, Services& host) {
  solvers::Result result;
  result.status = status_of(library, answer, host);
  result.iterations = answer.iterations;
  if (result.status == Status::kInfeasible) result.certificate = certificate;
  const auto rows = static_cast<std::size_t>(host.r.size());
  const bool refuses =
      result.status == Status::kInfeasible || result.status == Status::kUnsupported;
  if (answer.r_size != rows && !refuses) {
    host.notes.push_back(
        fmt::format("it says that its r has {} entries, expected {}", answer.r_size, rows));
  }
  if (answer.r_size == rows) {
    const bool seen = answer.status == CONEBENCH_STOPPED && host.stopped;
    if (!seen && !refuses) {
      result.status = host.monitor.conclude(result.status, result.iterations, host.r);
    }
    result.r = std::move(host.r);
  }
  result.notes = std::move(host.notes);
  return result;
}

}  // namespace

std::optional<std::string> ask_plugin(const PluginLibrary& library, const solvers::Values& values,
                                      const Problem& standard) {
  if (library.plugin().refuses == nullptr) return std::nullopt;
  const PosedProblem problem(standard);
  const char* why = library.plugin().refuses(&problem.get(), posed(library, values).data());
  if (why == nullptr) return std::nullopt;
  return std::string(why);
}

solvers::Result call_plugin(const PluginLibrary& library, const solvers::Values& values,
                            const Problem& standard, const solvers::Stop& stop,
                            const Eigen::VectorXd& guess, solvers::Monitor& monitor) {
  const PosedProblem problem(standard);
  const conebench_stop posed_stop{
      sizeof(conebench_stop), stop.tol, stop.max_iterations, stop.time_limit_s,
      stop.test == solvers::StopTest::kOwn ? CONEBENCH_OWN_TEST : CONEBENCH_COMMON_TEST};
  Services mine{.problem = standard, .monitor = monitor, .r = guess};
  const conebench_host host{sizeof(conebench_host), &mine, check, rate, delassus, note};
  Eigen::VectorXd certificate = Eigen::VectorXd::Zero(standard.rows());
  conebench_result answer{};
  answer.struct_size = sizeof answer;
  answer.r = mine.r.data();
  answer.certificate = certificate.data();
  library.plugin().solve(&problem.get(), posed(library, values).data(), &posed_stop, &host,
                         &answer);
  return translated(library, answer, certificate, mine);
}

}  // namespace conebench::harness
