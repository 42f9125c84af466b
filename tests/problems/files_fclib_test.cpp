// What FCLIB's own library reads in our files. Built where libfclib is installed.

extern "C" {
#include <fclib.h>
}

#include <cstdlib>

#include "problems/fclib.h"
#include "tests/problems/files_support.h"

namespace conebench::problems::test {
namespace {

using WithFclib = Files;

std::vector<Cone> cones_of_dim(int dim) {
  return {Cone::coulomb(dim, 0.5), Cone::coulomb(dim, 0.0), Cone::coulomb(dim, 0.8)};
}

Eigen::MatrixXd dense(const fclib_matrix& matrix) {
  EXPECT_EQ(matrix.nz, -1);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.m, matrix.n);
  for (int column = 0; column < matrix.n; ++column) {
    for (int k = matrix.p[column]; k < matrix.p[column + 1]; ++k) {
      result(matrix.i[k], column) += matrix.x[k];
    }
  }
  return result;
}

Eigen::VectorXd vector(const double* values, Eigen::Index size) {
  return Eigen::Map<const Eigen::VectorXd>(values, size);
}

void expect_global(const std::filesystem::path& path, const Problem& expected) {
  fclib_global* found = fclib_read_global(path.c_str());
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->spacedim, expected.cones().front().dim);
  EXPECT_EQ(dense(*found->M), Eigen::MatrixXd(expected.M()));
  EXPECT_EQ(dense(*found->H), Eigen::MatrixXd(expected.H().transpose()));
  EXPECT_EQ(vector(found->f, expected.dofs()), expected.f());
  EXPECT_EQ(vector(found->w, expected.rows()), expected.w());
  EXPECT_EQ(found->mu[2], 0.8);
  EXPECT_EQ(found->G, nullptr);
  EXPECT_STREQ(found->info->title, expected.name().c_str());
  fclib_delete_global(found);
  std::free(found);  // the library frees what it points to
}

void expect_local(const std::filesystem::path& path, const Problem& expected) {
  fclib_local* found = fclib_read_local(path.c_str());
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->spacedim, expected.cones().front().dim);
  EXPECT_EQ(dense(*found->W), Eigen::MatrixXd(expected.W()));
  EXPECT_EQ(vector(found->q, expected.rows()), expected.q());
  EXPECT_EQ(found->mu[2], 0.8);
  EXPECT_EQ(found->V, nullptr);
  fclib_delete_local(found);
  std::free(found);
}

TEST_F(WithFclib, ReadsOurFilesAndOurExports) {
  for (const int dim : {2, 3, 6}) {
    const Problem primal = sample_primal(cones_of_dim(dim));
    write_problem_file(at("p.h5"), {primal, {}, {}, {}});
    write_fclib_file(at("p.hdf5"), {primal, {}, {}, {}});
    expect_global(at("p.h5"), primal);
    expect_global(at("p.hdf5"), primal);
    const Problem reduced = sample_reduced(cones_of_dim(dim));
    write_problem_file(at("r.h5"), {reduced, {}, {}, {}});
    write_fclib_file(at("r.hdf5"), {reduced, {}, {}, {}});
    expect_local(at("r.h5"), reduced);
    expect_local(at("r.hdf5"), reduced);
  }
}

TEST_F(WithFclib, ReadsTheShiftedProblemOfACohesiveOne) {
  const Problem problem = sample_primal(cohesive_cones());
  write_problem_file(at("p.h5"), {problem, {}, {}, {}});
  expect_global(at("p.h5"), problem.shifted());
}

TEST_F(WithFclib, ReadsAWThatIsNotSymmetric) {
  SparseMatrix W(6, 6);
  W.setIdentity();
  W.insert(0, 4) = 0.01;
  const Problem problem(ReducedData{W, Eigen::VectorXd::Ones(6)},
                        {Cone::coulomb(2, 0.5), Cone::coulomb(2, 0.5), Cone::coulomb(2, 0.8)}, {});
  write_problem_file(at("p.h5"), {problem, {}, {}, {}});
  expect_local(at("p.h5"), problem);
}

TEST_F(WithFclib, ReadsOurSolution) {
  const ProblemFile file = with_extras(sample_primal(coulomb_cones()));
  write_problem_file(at("p.h5"), file);
  fclib_solution* found = fclib_read_solution(at("p.h5").c_str());
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(vector(found->r, file.problem.rows()), file.solution->r);
  EXPECT_EQ(vector(found->u, file.problem.rows()), file.problem.rate(file.solution->r));
  EXPECT_EQ(vector(found->v, file.problem.dofs()), file.problem.velocity(file.solution->r));
  fclib_delete_solutions(found, 1);
}

TEST_F(WithFclib, FilesOfFclibAreReadByUs) {
  // M = I, H = e_1 in triplets, with nzmax larger than what is used.
  double M_values[] = {1.0, 1.0}, H_values[] = {1.0, 0.0, 0.0}, mu[] = {0.5}, f[] = {-1.0, 0.25};
  double w[] = {0.0, 0.125};
  int diagonal[] = {0, 1}, first[] = {0, 0, 0};
  fclib_matrix M{2, 2, 2, diagonal, diagonal, M_values, 2, nullptr};
  fclib_matrix H{3, 2, 2, first, first, H_values, 1, nullptr};
  char title[] = "by hand", empty[] = "";
  fclib_info info{title, empty, empty};
  fclib_global global{&M, &H, nullptr, mu, f, nullptr, w, 2, &info};
  ASSERT_EQ(fclib_write_global(&global, at("g.hdf5").c_str()), 1);
  const Problem problem = read_fclib(at("g.hdf5")).problem;
  EXPECT_EQ(problem.q(), Eigen::Vector2d(-1.0, 0.125));
  EXPECT_EQ(problem.metadata().scene, "by hand");
}

}  // namespace
}  // namespace conebench::problems::test
