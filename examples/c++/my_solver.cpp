// my_solver: projected Gauss-Seidel. A sweep does, for each cone i in order,
//
//   u_i = W_i r + q_i,    u_hat_i = u_i + theta_i |u_it| e_n,
//   r_i <- P_Ki(r_i - (omega / lambda_i) u_hat_i),
//
// where P_K is the projection on the cone and lambda_i the largest eigenvalue of W_ii. Replace it
// by something better. harness/plugin_api.h says what the functions get and owe.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/plugin_api.h"

namespace {

constexpr conebench_parameter kParameters[] = {
    CONEBENCH_REAL_PARAMETER("omega", 1.0, 0.05, 1.95, "relaxation of a step [-]")};

double norm(std::span<const double> x) {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum);
}

// The point of { |x_t| <= mu x_n } that is nearest to x, in place.
void project(double mu, std::span<double> x) {
  const double tangential = norm(x.subspan(1));
  if (x[0] >= 0.0 && tangential <= mu * x[0]) return;
  if (mu * tangential <= -x[0]) {
    std::ranges::fill(x, 0.0);
    return;
  }
  x[0] = (x[0] + mu * tangential) / (1.0 + mu * mu);
  for (double& value : x.subspan(1)) value *= mu * x[0] / tangential;
}

class GaussSeidel {
 public:
  GaussSeidel(const conebench_problem& problem, const conebench_host& host, double omega)
      : problem_(problem),
        host_(host),
        W_(*host.delassus(host.context)),
        omega_(omega),
        u_(size(problem.rows)),
        next_(size(problem.rows)) {}

  void sweep(std::span<double> r) {
    for (std::int32_t i = 0; i < problem_.cones; ++i) {
      const std::span<double> u = part(i, u_);
      for (std::size_t k = 0; k < u.size(); ++k) u[k] = rate(size(problem_.start[i]) + k, r);
      step(i, omega_, u, part(i, r));
      std::ranges::copy(part(i, next_), part(i, r).begin());
    }
  }

  // The residual that an answer is judged by.
  double eta(std::span<double> r) {
    double worst = 0.0;
    host_.rate(host_.context, r.data(), u_.data());
    for (std::int32_t i = 0; i < problem_.cones; ++i) {
      worst = std::max(worst, step(i, 1.0, part(i, u_), part(i, r)));
    }
    return problem_.rate_scale > 0.0 ? worst / problem_.rate_scale : worst;
  }

 private:
  static std::size_t size(std::int32_t count) { return static_cast<std::size_t>(count); }

  std::span<double> part(std::int32_t i, std::span<double> all) const {
    return all.subspan(size(problem_.start[i]), size(problem_.dim[i]));
  }

  double rate(std::size_t row, std::span<const double> r) const {
    double u = problem_.q[row];
    for (std::int32_t at = W_.row_start[row]; at < W_.row_start[row + 1]; ++at) {
      u += W_.value[at] * r[size(W_.column[at])];
    }
    return u;
  }

  // Puts where a step takes cone i into next_; returns how far, as a rate: lambda_i |next - r_i|.
  double step(std::int32_t i, double omega, std::span<const double> u, std::span<const double> r) {
    const std::span<double> next = part(i, next_);
    const double lambda = problem_.mobility[i];
    for (std::size_t k = 0; k < u.size(); ++k) next[k] = r[k] - omega / lambda * u[k];
    next[0] -= omega / lambda * problem_.theta[i] * norm(u.subspan(1));
    project(problem_.mu[i], next);
    double square = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) square += (next[k] - r[k]) * (next[k] - r[k]);
    return lambda * std::sqrt(square);
  }

  const conebench_problem& problem_;
  const conebench_host& host_;
  const conebench_matrix& W_;
  double omega_;
  std::vector<double> u_, next_;
};

const char* refuses(const conebench_problem* problem, const conebench_value*) noexcept {
  const double* end = problem->mobility + problem->cones;
  return std::any_of(problem->mobility, end, [](double lambda) { return !(lambda > 0.0); })
             ? "W is zero"
             : nullptr;
}

void solve(const conebench_problem* problem, const conebench_value* values,
           const conebench_stop* stop, const conebench_host* host,
           conebench_result* result) noexcept {
  GaussSeidel method(*problem, *host, values[0].real);
  result->r_size = static_cast<std::size_t>(problem->rows);
  const std::span<double> r(result->r, result->r_size);
  while (host->check(host->context, result->iterations, r.data()) != 0) {
    if (stop->test == CONEBENCH_OWN_TEST && method.eta(r) <= stop->tol) {
      result->status = CONEBENCH_CONVERGED;
      return;
    }
    method.sweep(r);
    ++result->iterations;
  }
}

}  // namespace

const conebench_plugin* conebench_plugin_entry() {
  static constexpr conebench_plugin kPlugin = {
      .struct_size = sizeof(conebench_plugin),
      .abi_version = CONEBENCH_ABI_VERSION,
      .name = "my_solver",
      .summary = "projected Gauss-Seidel",
      .parameters = kParameters,
      .parameter_count = std::size(kParameters),
      .refuses = refuses,
      .solve = solve,
  };
  return &kPlugin;
}
