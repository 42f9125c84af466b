#include "harness/judge.h"

#include <fmt/format.h>

#include <cmath>

#include "problems/residual.h"
#include "solvers/certificate.h"
#include "solvers/model_residual.h"

namespace conebench::harness {
namespace {

using results::Status;

Status translated(solvers::Status status) {
  switch (status) {
    case solvers::Status::kConverged:
      return Status::kConverged;
    case solvers::Status::kIterationLimit:
      return Status::kIterationLimit;
    case solvers::Status::kTimeLimit:
      return Status::kTimeLimit;
    case solvers::Status::kStalled:
      return Status::kStalled;
    case solvers::Status::kDiverged:
      return Status::kDiverged;
    case solvers::Status::kInfeasible:
      return Status::kInfeasible;
    case solvers::Status::kUnsupported:
      return Status::kUnsupported;
  }
  return Status::kBadOutput;
}

bool may_be_empty(Status status) {
  return status == Status::kUnsupported || status == Status::kInfeasible;
}

void check_certificate(const problems::Problem& standard, const Eigen::VectorXd& y,
                       results::Record& record) {
  if (solvers::proves_infeasible(standard, y)) return;
  record.status = Status::kRefuted;
  record.error =
      y.size() == 0 ? "the solver says that there is no solution, without a certificate"
                    : fmt::format(
                          "the certificate does not prove that there is no solution: its margin is "
                          "{:.3g}, a proof takes {:.0e}",
                          solvers::infeasibility_margin(standard, y), solvers::kProof);
}

void judge_model(const problems::Problem& standard, const Eigen::VectorXd& r,
                 results::Record& record) {
  if (const auto eta = solvers::model_residual(record.solver, standard, r)) record.model_eta = *eta;
}

// A model of which we do not know the law is taken at its word.
bool solves_its_model(const results::Record& record) {
  if (record.kind != "model") return false;
  return !std::isfinite(record.model_eta) || record.model_eta <= record.settings.tol;
}

}  // namespace

void judge(const problems::Problem& standard, const solvers::Result& result,
           results::Record& record) {
  record.status = translated(result.status);
  record.claimed = solvers::to_string(result.status);
  record.iterations = result.iterations;
  record.setup_s = result.setup_s;
  record.solve_s = result.solve_s;
  record.notes = result.notes;
  const bool answers = result.r.size() > 0 || standard.rows() == 0 || !may_be_empty(record.status);
  if (record.status == Status::kInfeasible && record.kind != "model") {
    check_certificate(standard, result.certificate, record);
  }
  if (!answers) return;
  if (result.r.size() != standard.rows()) {
    record.status = Status::kBadOutput;
    record.error =
        fmt::format("r has {} entries, the problem {} rows", result.r.size(), standard.rows());
    return;
  }

  const problems::Residual residual = problems::evaluate_residual(standard, result.r);
  if (!residual.finite) {
    record.status = Status::kNotFinite;
    record.error = "the answer, or its residual, holds a NaN or an infinity";
    return;
  }
  record.eta = residual.eta.max;
  record.fclib_residual = residual.fclib;
  record.siconos_residual = residual.siconos;
  record.attainable_eta = residual.attainable_eta;
  if (record.kind == "model") judge_model(standard, result.r, record);
  const bool claims = record.status == Status::kConverged;
  if (claims && !record.solved() && !solves_its_model(record)) record.status = Status::kRefuted;
}

}  // namespace conebench::harness
