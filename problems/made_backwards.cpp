#include "problems/made_backwards.h"

#include <cmath>
#include <numbers>
#include <random>

#include "problems/error.h"

namespace conebench::problems {
namespace {

constexpr int kBodyDofs = 6;

// std distributions differ between libraries; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
  }
  Eigen::VectorXd normals(Eigen::Index n) {
    Eigen::VectorXd x(n);
    for (double& value : x) value = normal();
    return x;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

class Triplets {
 public:
  void add(int row, int column, double value) { entries_.emplace_back(row, column, value); }
  void add(int row, int first_column, const Eigen::VectorXd& values) {
    for (int k = 0; k < values.size(); ++k) add(row, first_column + k, values(k));
  }
  SparseMatrix matrix(int rows, int columns) const {
    SparseMatrix A(rows, columns);
    A.setFromTriplets(entries_.begin(), entries_.end());
    return A;
  }

 private:
  std::vector<Eigen::Triplet<double, int>> entries_;
};

const char* name_of(Family family) {
  switch (family) {
    case Family::kGeneric:
      return "generic";
    case Family::kRankDeficient:
      return "rank-deficient";
    case Family::kSingularBlock:
      return "singular-block";
    case Family::kSeveral:
      return "several-solutions";
    case Family::kInfeasible:
      return "infeasible";
  }
  return "unknown";
}

void check(const Recipe& recipe) {
  constexpr const char* kSubject = "made-backwards recipe";
  require(recipe.cones >= 1, kSubject, "cones = ", recipe.cones, ", expected >= 1");
  require(!recipe.dims.empty(), kSubject, "dims is empty, expected one or more");
  for (const int dim : recipe.dims) {
    require(dim >= 1, kSubject, "dims holds ", dim, ", expected >= 1");
    require(recipe.family != Family::kSeveral || dim >= 2, kSubject,
            "dims holds 1, expected >= 2: one component leaves no second solution");
  }
  require(recipe.mu_low >= 0.0 && recipe.mu_low <= recipe.mu_high && std::isfinite(recipe.mu_high),
          kSubject, "mu from ", recipe.mu_low, " to ", recipe.mu_high,
          ", expected 0 <= low <= high");
  require(recipe.family != Family::kInfeasible || recipe.cones >= 2, kSubject,
          "infeasible with 1 cone, expected >= 2");
  require(recipe.theta_share >= 0.0 && recipe.theta_share <= 1.0, kSubject,
          "theta_share = ", recipe.theta_share, ", expected 0 to 1");
  require(recipe.family != Family::kSeveral || (recipe.mu_low > 0.0 && recipe.theta_share == 1.0),
          kSubject, "several solutions need mu_low > 0 and theta_share = 1");
  require(recipe.cohesive_share >= 0.0 && recipe.cohesive_share <= 1.0, kSubject,
          "cohesive_share = ", recipe.cohesive_share, ", expected 0 to 1");
  require(recipe.mass_ratio >= 1.0, kSubject, "mass_ratio = ", recipe.mass_ratio,
          ", expected >= 1");
}

std::vector<Cone> draw_cones(const Recipe& recipe, Random& random) {
  std::vector<Cone> cones;
  for (int i = 0; i < recipe.cones; ++i) {
    const int dim = recipe.dims[static_cast<std::size_t>(i) % recipe.dims.size()];
    const double mu = random.uniform(recipe.mu_low, recipe.mu_high);
    const bool cohesive = random.uniform(0.0, 1.0) < recipe.cohesive_share;
    cones.push_back({dim, mu, cohesive ? random.uniform(0.1, 2.0) : 0.0, recipe.theta_share * mu});
  }
  return cones;
}

int rows_of(const std::vector<Cone>& cones) {
  int rows = 0;
  for (const Cone& cone : cones) rows += cone.dim;
  return rows;
}

int body_count(const Recipe& recipe, int rows) {
  if (recipe.family == Family::kRankDeficient) {
    const int bodies = std::max(1, rows / (2 * kBodyDofs));
    require(rows > bodies * kBodyDofs, "made-backwards recipe", "rank-deficient with ", rows,
            " rows, expected more than ", bodies * kBodyDofs);
    return bodies;
  }
  return std::max(2, (3 * rows + 2 * kBodyDofs - 1) / (2 * kBodyDofs));
}

SparseMatrix draw_mass(const Recipe& recipe, int bodies, Random& random) {
  Triplets M;
  for (int body = 0; body < bodies; ++body) {
    const double mass = std::pow(recipe.mass_ratio, random.uniform(0.0, 1.0));
    Eigen::MatrixXd A(kBodyDofs, kBodyDofs);
    for (double& x : A.reshaped()) x = random.normal();
    const Eigen::MatrixXd block =
        mass * (Eigen::MatrixXd::Identity(kBodyDofs, kBodyDofs) + A * A.transpose() / kBodyDofs);
    for (int row = 0; row < kBodyDofs; ++row) {
      M.add(kBodyDofs * body + row, kBodyDofs * body, 0.5 * (block + block.transpose()).row(row));
    }
  }
  return M.matrix(kBodyDofs * bodies, kBodyDofs * bodies);
}

// Rows of cone i on two random bodies; kInfeasible: cones 2k and 2k + 1 oppose each other.
SparseMatrix draw_jacobian(const Recipe& recipe, const std::vector<Cone>& cones, int bodies,
                           Random& random) {
  Triplets H;
  int row = 0;
  Eigen::VectorXd facing;
  int facing_body = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const bool second = recipe.family == Family::kInfeasible && i % 2 == 1;
    const int body = second ? facing_body : random.below(bodies);
    const int other = bodies > 1 ? (body + 1 + random.below(bodies - 1)) % bodies : -1;
    for (int k = 0; k < cones[i].dim; ++k, ++row) {
      const bool removed =
          recipe.family == Family::kSingularBlock && i % 3 == 0 && k > 0 && k + 1 == cones[i].dim;
      const Eigen::VectorXd near = random.normals(kBodyDofs), far = random.normals(kBodyDofs);
      if (removed) continue;
      if (recipe.family == Family::kInfeasible && k == 0) {
        H.add(row, kBodyDofs * body, second ? Eigen::VectorXd(-facing) : near);
        facing = near;
        facing_body = body;
        continue;
      }
      H.add(row, kBodyDofs * body, near);
      if (other >= 0) H.add(row, kBodyDofs * other, far);
    }
  }
  return H.matrix(row, kBodyDofs * bodies);
}

// One complementary pair (u, r') in the state that is the turn of cone i.
void draw_pair(const Cone& cone, int i, Random& random, Eigen::Ref<Eigen::VectorXd> u,
               Eigen::Ref<Eigen::VectorXd> r) {
  enum { kOpen, kStick, kSlide, kTip };
  int state = i % 4;
  if (state == kSlide && (cone.dim == 1 || cone.mu == 0.0)) state = kStick;
  const int tangents = cone.dim - 1;
  u.setZero();
  r.setZero();
  if (state == kOpen) {
    u.tail(tangents) = random.normals(tangents);
    u(0) = (cone.mu - cone.theta) * u.tail(tangents).norm() + random.uniform(0.1, 1.0);
  } else if (state == kStick) {
    r(0) = random.uniform(0.5, 2.0);
    const Eigen::VectorXd direction = random.normals(tangents);
    const double share = random.uniform(0.0, 0.9);
    if (tangents > 0) r.tail(tangents) = share * cone.mu * r(0) * direction / direction.norm();
  } else if (state == kSlide) {
    u.tail(tangents) = random.normals(tangents);
    const double speed = u.tail(tangents).norm();
    u(0) = (cone.mu - cone.theta) * speed;
    r(0) = random.uniform(0.5, 2.0);
    r.tail(tangents) = -cone.mu * r(0) / speed * u.tail(tangents);
  }
}

// One cone a body, M = I: q_n > 0 opens it, yet a strong coupling W_nt > W_nn / mu wedges a slide.
PrimalData wedged(const std::vector<Cone>& cones, Eigen::VectorXd& sliding) {
  Triplets M, H;
  const int rows = rows_of(cones);
  Eigen::VectorXd w(rows);
  w.setZero();
  int row = 0;
  for (const Cone& cone : cones) {
    const double coupling = 2.0 / cone.mu;  // W_nn = 1, W_nt = coupling, W_tt = coupling^2 + 1
    for (int k = 0; k < cone.dim; ++k) {
      M.add(row + k, row + k, 1.0);
      H.add(row + k, row + k, 1.0);
    }
    H.add(row + 1, row, coupling);
    // Sliding along +t: r_t = -mu r_n, and 0 = u_n = r_n - coupling mu r_n + q_n = q_n - r_n.
    const double rn = 0.5;
    sliding(row) = rn;
    sliding(row + 1) = -cone.mu * rn;
    w(row) = rn;
    w(row + 1) = 1.0 - rn * (coupling - cone.mu * (coupling * coupling + 1.0));  // u_t = 1
    row += cone.dim;
  }
  return {M.matrix(rows, rows), H.matrix(rows, rows), Eigen::VectorXd::Zero(rows), w};
}

// Random M, H, v and complementary (u, r'); f and w follow.
PrimalData around_solution(const Recipe& recipe, const std::vector<Cone>& cones, Random& random,
                           Eigen::VectorXd& r) {
  const int rows = rows_of(cones), bodies = body_count(recipe, rows);
  PrimalData data;
  data.M = draw_mass(recipe, bodies, random);
  data.H = draw_jacobian(recipe, cones, bodies, random);
  Eigen::VectorXd u(rows);
  r.resize(rows);
  int row = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    draw_pair(cones[i], static_cast<int>(i), random, u.segment(row, cones[i].dim),
              r.segment(row, cones[i].dim));
    row += cones[i].dim;
  }
  const Eigen::VectorXd v = random.normals(data.M.rows());
  data.f = data.M * v - data.H.transpose() * r;
  data.w = u - data.H * v;
  return data;
}

// Opposed cones 2k and 2k + 1 get u_n = x - 1 and -x - 1: never both >= 0.
void close_in(const std::vector<Cone>& cones, Eigen::VectorXd& w) {
  int row = 0;
  for (std::size_t i = 0; i < cones.size() / 2 * 2; ++i) {
    w(row) = -1.0;
    row += cones[i].dim;
  }
}

Eigen::VectorXd tips(const std::vector<Cone>& cones) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(rows_of(cones));
  int row = 0;
  for (const Cone& cone : cones) {
    shift(row) = cone.kappa;
    row += cone.dim;
  }
  return shift;
}

Metadata metadata_of(const Recipe& recipe) {
  Metadata metadata;
  metadata.engine = "made-backwards";
  metadata.scene = name_of(recipe.family);
  metadata.name = metadata.scene + "_d";
  for (const int dim : recipe.dims) metadata.name += std::to_string(dim);
  if (recipe.cohesive_share > 0.0) metadata.name += "_cohesive";
  if (recipe.theta_share < 1.0) metadata.name += "_dilating";
  if (recipe.reduced) metadata.name += "_reduced";
  metadata.name += "_n" + std::to_string(recipe.cones) + "_s" + std::to_string(recipe.seed);
  return metadata;
}

}  // namespace

MadeProblem make_backwards(const Recipe& recipe) {
  check(recipe);
  Random random(recipe.seed);
  std::vector<Cone> cones = draw_cones(recipe, random);
  std::vector<Eigen::VectorXd> solutions;
  PrimalData data;
  if (recipe.family == Family::kSeveral) {
    solutions.assign(2, Eigen::VectorXd::Zero(rows_of(cones)));
    data = wedged(cones, solutions[1]);
  } else {
    Eigen::VectorXd r;
    data = around_solution(recipe, cones, random, r);
    if (recipe.family == Family::kInfeasible) {
      close_in(cones, data.w);
    } else {
      solutions.push_back(std::move(r));
    }
  }
  // The data so far are those of the standard problem: f' = f - H^T kappa e_n.
  data.f += data.H.transpose() * tips(cones);
  Problem problem(std::move(data), cones, metadata_of(recipe));
  if (!recipe.reduced) return {std::move(problem), std::move(solutions)};
  return {Problem(ReducedData{problem.delassus(), problem.q()}, cones, problem.metadata()),
          std::move(solutions)};
}

}  // namespace conebench::problems
