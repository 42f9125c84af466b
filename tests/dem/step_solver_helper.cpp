#include "tests/dem/step_solver_helper.h"

#include <Eigen/Dense>
#include <algorithm>

namespace conebench::test {
namespace {

constexpr int kMostSweeps = 100'000;

// One contact's reaction in place; returns the largest change as a velocity.
double relax(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, int start,
             const problems::Cone& cone, Eigen::VectorXd& r) {
  const double u_n = W.row(start).dot(r) + q[start];
  const double normal = std::max(0.0, r[start] - u_n / W(start, start));
  double change = W(start, start) * std::abs(normal - r[start]);
  r[start] = normal;
  if (cone.dim == 1) return change;
  const double mobility = std::max(W(start + 1, start + 1), W(start + 2, start + 2));
  const Eigen::Vector2d before(r[start + 1], r[start + 2]);
  Eigen::Vector2d t;
  for (int k = 0; k < 2; ++k) {
    t[k] = before[k] - (W.row(start + 1 + k).dot(r) + q[start + 1 + k]) / mobility;
  }
  if (const double size = t.norm(); size > cone.mu * normal) t *= cone.mu * normal / size;
  r[start + 1] = t[0];
  r[start + 2] = t[1];
  return std::max(change, mobility * (t - before).norm());
}

}  // namespace

engine::StepSolver small_solver(double tol) {
  return [tol](const problems::Problem& standard, const Eigen::VectorXd& guess) {
    const Eigen::MatrixXd W(standard.delassus());
    const Eigen::VectorXd& q = standard.q();
    engine::StepAnswer answer;
    answer.r = guess;
    const double allowed = tol * std::max(q.cwiseAbs().maxCoeff(), 1e-300);
    while (answer.iterations < kMostSweeps && !answer.converged) {
      double change = 0.0;
      for (int i = 0; i < standard.cone_count(); ++i) {
        const auto& cone = standard.cones()[static_cast<std::size_t>(i)];
        change = std::max(change, relax(W, q, standard.start(i), cone, answer.r));
      }
      ++answer.iterations;
      answer.converged = change <= allowed;
    }
    answer.status = answer.converged ? "converged" : "iteration_limit";
    return answer;
  };
}

dem::Scene small_scene(const dem::PairLaw& law) {
  dem::Scene scene;
  scene.name = "small";
  scene.step_s = 1e-3;
  scene.duration_s = 1.0;
  scene.skin_m = 5e-3;
  scene.materials = {{"grain", 2500.0}};
  scene.default_pair = law;
  return scene;
}

void add_floor(dem::Scene& scene) {
  dem::Plane floor;
  floor.material = "grain";
  scene.planes.push_back(floor);
}

dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m, double radius_m) {
  dem::Body body;
  body.position_m = position_m;
  body.radius_m = radius_m;
  body.material = "grain";
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

}  // namespace conebench::test
