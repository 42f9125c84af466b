// Parts of problems: known ones, and what must be the same in part and whole.

#include "problems/part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/private_folder.h"
#include "problems/residual.h"

namespace conebench::problems {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Metadata named(const std::string& name) {
  Metadata metadata;
  metadata.name = name;
  return metadata;
}

SparseMatrix diagonal(const Eigen::VectorXd& entries) {
  return Eigen::MatrixXd(entries.asDiagonal()).sparseView();
}

// Three bodies of one dof each, in a row between walls: cones 0, 1, 2, 3 act on dof 0, dofs 0 and
// 1, dofs 1 and 2, dof 2.
Problem row_of_bodies() {
  Eigen::MatrixXd H(4, 3);
  H << 1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1;
  std::vector<Cone> cones(4, Cone{1, 0.0, 0.0, 0.0});
  cones[1].kappa = 0.25;
  return {PrimalData{diagonal(Eigen::Vector3d(1, 2, 4)), H.sparseView(),
                     Eigen::Vector3d(-1, -2, -3), Eigen::Vector4d(0.1, 0.2, 0.3, 0.4)},
          cones, named("row")};
}

std::vector<int> every_third(const Problem& problem, int first) {
  std::vector<int> cones;
  for (int i = first; i < problem.cone_count(); i += 3) cones.push_back(i);
  return cones;
}

Eigen::MatrixXd block(const Eigen::MatrixXd& A, const std::vector<int>& rows) {
  return A(rows, rows);
}

TEST(Part, HasTheRowsOfItsConesAndTheDofsTheyTouch) {
  const Problem whole = row_of_bodies();
  const Problem part = part_of(whole, std::vector{0, 1}, named("part"));
  EXPECT_EQ(part.name(), "part");
  EXPECT_EQ(part.cone_count(), 2);
  EXPECT_EQ(part.dofs(), 2);
  Eigen::MatrixXd H(2, 2);
  H << 1, 0, -1, 1;
  EXPECT_EQ(Eigen::MatrixXd(part.H()), H);
  EXPECT_EQ(Eigen::MatrixXd(part.M()), Eigen::MatrixXd(diagonal(Eigen::Vector2d(1, 2))));
  EXPECT_EQ(part.f(), Eigen::Vector2d(-1, -2));
  EXPECT_EQ(part.w(), Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(part.cones()[0].kappa, 0.0);
  EXPECT_EQ(part.cones()[1].kappa, 0.25);
  EXPECT_EQ(part.rate_scale(), whole.rate_scale());
}

// One dof of a component of M moves with the others of it, touched or not.
TEST(Part, KeepsWholeComponentsOfM) {
  const int dofs = 2 * Inertia::kLargestBlock;
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(dofs + 1, dofs + 1) * 3.0;
  for (int k = 1; k < dofs; ++k) M(k, k - 1) = M(k - 1, k) = -1.0;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, dofs + 1);
  H(0, 0) = H(1, dofs) = 1.0;
  const Problem whole(PrimalData{M.sparseView(), H.sparseView(), Eigen::VectorXd::Ones(dofs + 1),
                                 Eigen::VectorXd::Zero(2)},
                      {{1, 0.0, 0.0, 0.0}, {1, 0.0, 0.0, 0.0}}, named("chain"));
  const Problem chain = part_of(whole, std::vector{0}, named("chain"));
  EXPECT_EQ(chain.dofs(), dofs);
  EXPECT_NEAR(chain.delassus().coeff(0, 0), whole.delassus().coeff(0, 0), 1e-15);
  EXPECT_EQ(part_of(whole, std::vector{1}, named("alone")).dofs(), 1);
}

TEST(Part, MovesAsTheWholeDoesUnderTheSameReactions) {
  for (const bool reduced : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Problem whole = make_backwards({.family = Family::kRankDeficient,
                                            .cones = 25,
                                            .dims = {1, 2, 3, 6},
                                            .theta_share = 0.5,
                                            .cohesive_share = 0.3,
                                            .reduced = reduced,
                                            .seed = seed})
                                .problem;
      const std::vector<int> cones = every_third(whole, static_cast<int>(seed % 3));
      const std::vector<int> rows = rows_of(whole, cones);
      const Problem part = part_of(whole, cones, whole.metadata());
      const Eigen::MatrixXd W = block(whole.delassus(), rows);
      EXPECT_LE((Eigen::MatrixXd(part.delassus()) - W).norm(), 1e-14 * W.norm());
      EXPECT_LE((part.q() - whole.q()(rows)).norm(), 1e-14 * whole.q().norm());
      EXPECT_EQ(part.rate_scale(), whole.rate_scale());
      for (std::size_t k = 0; k < cones.size(); ++k) {
        const Cone &law = part.cones()[k],
                   &same = whole.cones()[static_cast<std::size_t>(cones[k])];
        EXPECT_EQ(std::tuple(law.dim, law.mu, law.kappa, law.theta),
                  std::tuple(same.dim, same.mu, same.kappa, same.theta));
      }
    }
  }
}

// An open contact of a dry problem does nothing: without it the rest of the solution stands.
TEST(Part, WithoutItsOpenConesASolvedProblemIsSolved) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const MadeProblem made = make_backwards({.cones = 40, .dims = {2, 3}, .seed = seed});
    const Eigen::VectorXd& r = made.solutions.front();
    std::vector<int> closed;
    for (int i = 0; i < made.problem.cone_count(); ++i) {
      const int dim = made.problem.cones()[static_cast<std::size_t>(i)].dim;
      if (!r.segment(made.problem.start(i), dim).isZero(0.0)) closed.push_back(i);
    }
    ASSERT_LT(std::ssize(closed), made.problem.cone_count());
    const Problem part = part_of(made.problem, closed, named("closed"));
    EXPECT_LE(evaluate_eta(part, r(rows_of(made.problem, closed))),
              evaluate_eta(made.problem, r) + 1e-14);
  }
}

TEST(Part, OfAnIslandIsTheIsland) {
  const Problem whole = make_backwards({.cones = 30, .dims = {3}, .seed = 4}).problem;
  for (const Island& island : whole.islands()) {
    const Problem part = part_of(whole, island.cones, island.problem.metadata());
    EXPECT_EQ(content_sha256(part), content_sha256(island.problem));
  }
}

ProblemFile file_of_row() {
  ProblemFile file{row_of_bodies(), Geometry{}, Eigen::Vector4d(1, 2, 3, 4), Solution{}};
  file.geometry->points.resize(4, 3);
  for (int i = 0; i < 4; ++i) file.geometry->points.row(i).setConstant(i);
  file.geometry->bodies_of_cone.resize(4, 2);
  file.geometry->bodies_of_cone << -1, 0, 0, 1, 1, 2, 2, -1;
  file.geometry->body_positions = Eigen::Matrix3d::Identity();
  file.geometry->body_radii = Eigen::VectorXd{{0.1, 0.2, 0.3}};
  file.geometry->state = {0, 1, 2, -1};
  file.geometry->volume_fraction = Eigen::Vector4d(0.4, 0.5, 0.6, 0.7);
  file.solution->r = Eigen::Vector4d(5, 6, 7, 8);
  return file;
}

TEST(Part, OfAFileHasTheGeometryGuessAndAnswerOfItsCones) {
  const ProblemFile part = part_of(file_of_row(), std::vector{2, 3}, named("end"));
  EXPECT_EQ(part.guess, Eigen::Vector2d(3, 4));
  ASSERT_TRUE(part.geometry && part.solution);
  EXPECT_EQ(part.geometry->points.col(0), Eigen::Vector2d(2, 3));
  EXPECT_EQ(part.geometry->points.cols(), 3);
  Geometry::Pairs bodies(2, 2);
  bodies << 0, 1, 1, -1;
  EXPECT_EQ(part.geometry->bodies_of_cone, bodies);
  EXPECT_EQ(part.geometry->body_positions, Eigen::Matrix3d::Identity().bottomRows(2));
  EXPECT_EQ(part.geometry->body_radii, Eigen::Vector2d(0.2, 0.3));
  EXPECT_THAT(part.geometry->state, ElementsAre(2, -1));
  EXPECT_EQ(part.geometry->volume_fraction, Eigen::Vector2d(0.6, 0.7));
  EXPECT_EQ(part.solution->r, Eigen::Vector2d(7, 8));
  EXPECT_EQ(part.solution->eta, evaluate_eta(part.problem.shifted(), part.solution->r));
}

TEST(Part, IsReadAsItWasWritten) {
  const PrivateFolder folder;
  const std::filesystem::path path = folder.path() / "part.h5";
  for (const std::vector<int>& cones : {std::vector{0, 1, 3}, std::vector{1}}) {
    const ProblemFile part = part_of(file_of_row(), cones, named("some"));
    write_problem_file(path, part);
    const ProblemFile read = read_problem_file(path);
    EXPECT_EQ(content_sha256(read.problem), content_sha256(part.problem));
    EXPECT_EQ(read.problem.rate_scale(), row_of_bodies().rate_scale());
    EXPECT_EQ(read.guess, part.guess);
    EXPECT_EQ(read.geometry->bodies_of_cone, part.geometry->bodies_of_cone);
    EXPECT_EQ(read.solution->eta, part.solution->eta);
  }
}

TEST(Part, NamesConesThatAreNotThere) {
  const auto error = [](const std::vector<int>& cones) -> std::string {
    try {
      part_of(row_of_bodies(), cones, named("part"));
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_THAT(error({4}), HasSubstr("row: cone 4"));
  EXPECT_THAT(error({-1}), HasSubstr("row: cone -1"));
  EXPECT_THAT(error({1, 1}), HasSubstr("expected increasing numbers from 0 to 3"));
  EXPECT_THAT(error({2, 1}), HasSubstr("cone 1 after cone 2"));
}

}  // namespace
}  // namespace conebench::problems
