#include "problems/error.h"
#include "problems/fclib.h"
#include "problems/load.h"
#include "problems/residual.h"
#include "tests/problems/files_support.h"

namespace conebench::problems::test {
namespace {

using RoundTrip = Files;

// The same numbers to the last bit: the hash covers them all but metadata.
void expect_same(const Problem& found, const Problem& expected) {
  EXPECT_EQ(content_sha256(found), content_sha256(expected));
  EXPECT_EQ(found.rate_scale(), expected.rate_scale());
  EXPECT_EQ(found.is_primal(), expected.is_primal());
  EXPECT_EQ(found.q(), expected.q());
}

TEST_F(RoundTrip, KeepsEveryFormAndEveryLaw) {
  const std::vector<Problem> problems{sample_primal(coulomb_cones()),
                                      sample_primal(cohesive_cones()),
                                      sample_primal(mixed_cones()),
                                      sample_reduced(coulomb_cones()),
                                      sample_reduced(cohesive_cones()),
                                      sample_reduced(mixed_cones()),
                                      sample_primal({}),
                                      sample_reduced({})};
  for (const Problem& problem : problems) {
    SCOPED_TRACE(problem.rows());
    write_problem_file(at("p.h5"), {problem, {}, {}, {}});
    const ProblemFile found = read_problem_file(at("p.h5"));
    expect_same(found.problem, problem);
    EXPECT_FALSE(found.geometry);
    EXPECT_FALSE(found.solution);
    EXPECT_EQ(found.guess.size(), 0);
  }
}

TEST_F(RoundTrip, KeepsTheMetadata) {
  const Problem problem = sample_primal(coulomb_cones());
  write_problem_file(at("p.h5"), {problem, {}, {}, {}});
  const Problem file = read_problem_file(at("p.h5")).problem;
  const Metadata &found = file.metadata(), &expected = problem.metadata();
  EXPECT_EQ(found.name, expected.name);
  EXPECT_EQ(found.engine, expected.engine);
  EXPECT_EQ(found.scene, expected.scene);
  EXPECT_EQ(found.step, expected.step);
  EXPECT_EQ(found.step_size_s, expected.step_size_s);
  EXPECT_EQ(found.force_unit, expected.force_unit);
  EXPECT_EQ(found.rate_unit, expected.rate_unit);
  EXPECT_EQ(found.origin, expected.origin);
  EXPECT_EQ(found.sampling_weight, expected.sampling_weight);
}

TEST_F(RoundTrip, KeepsGeometryGuessAndSolution) {
  const ProblemFile file = with_extras(sample_primal(cohesive_cones()));
  write_problem_file(at("p.h5"), file);
  const ProblemFile found = read_problem_file(at("p.h5"));
  ASSERT_TRUE(found.geometry && found.solution);
  EXPECT_EQ(found.geometry->points, file.geometry->points);
  EXPECT_EQ(found.geometry->frames, file.geometry->frames);
  EXPECT_EQ(found.geometry->bodies_of_cone, file.geometry->bodies_of_cone);
  EXPECT_EQ(found.geometry->body_positions, file.geometry->body_positions);
  EXPECT_EQ(found.geometry->body_radii, file.geometry->body_radii);
  EXPECT_EQ(found.guess, file.guess);
  EXPECT_EQ(found.solution->r, file.solution->r);
  EXPECT_EQ(found.solution->eta, file.solution->eta);
}

TEST_F(RoundTrip, AddsTheVelocitiesThatASolutionLacks) {
  const Problem problem = sample_primal(cohesive_cones());
  const ProblemFile file = with_extras(problem);
  write_problem_file(at("p.h5"), file);
  const ProblemFile found = read_problem_file(at("p.h5"));
  EXPECT_EQ(found.solution->u, problem.shifted().rate(file.solution->r));
  EXPECT_EQ(found.solution->v, problem.shifted().velocity(file.solution->r));
}

TEST_F(RoundTrip, KeepsTheRateScaleOfAShiftedProblem) {
  const Problem whole = sample_primal(cohesive_cones());
  write_problem_file(at("p.h5"), {whole.shifted(), {}, {}, {}});
  const Problem found = read_problem_file(at("p.h5")).problem;
  EXPECT_TRUE(found.is_standard());
  EXPECT_EQ(found.rate_scale(), whole.rate_scale());
  const Eigen::VectorXd r = Eigen::VectorXd::Ones(whole.rows());
  EXPECT_EQ(evaluate_eta(found, r), evaluate_eta(whole.shifted(), r));
}

TEST_F(RoundTrip, GivesTheSameBytesForTheSameProblem) {
  const ProblemFile file = with_extras(sample_primal(coulomb_cones()));
  write_problem_file(at("a.h5"), file);
  write_problem_file(at("b.h5"), file);
  EXPECT_EQ(bytes_of(at("a.h5")), bytes_of(at("b.h5")));
}

TEST_F(RoundTrip, ThroughFclibKeepsCoulombProblems) {
  for (const Problem& problem : {sample_primal(coulomb_cones()), sample_reduced(coulomb_cones())}) {
    const ProblemFile file = with_extras(problem);
    write_fclib_file(at("f.hdf5"), file);
    EXPECT_EQ(file_format(at("f.hdf5")), FileFormat::kFclib);
    const ProblemFile found = load_problem(at("f.hdf5"));
    expect_same(found.problem, problem);
    EXPECT_EQ(found.solution->r, file.solution->r);
  }
}

TEST_F(RoundTrip, ThroughFclibShiftsTheCohesionAway) {
  for (const Problem& problem :
       {sample_primal(cohesive_cones()), sample_reduced(cohesive_cones())}) {
    write_fclib_file(at("f.hdf5"), {problem, {}, {}, {}});
    expect_same(load_problem(at("f.hdf5")).problem, problem.shifted());
  }
}

TEST_F(RoundTrip, RefusesWhatFclibCannotHold) {
  const Problem mixed = sample_primal(mixed_cones());
  EXPECT_THROW(write_fclib_file(at("f.hdf5"), {mixed, {}, {}, {}}), InputError);
  const Problem associated = sample_primal({Cone::associated(3, 0.5)});
  EXPECT_THROW(write_fclib_file(at("f.hdf5"), {associated, {}, {}, {}}), InputError);
  EXPECT_EQ(files_in(folder_), 0u);
}

TEST_F(RoundTrip, RefusesExtrasOfAnotherSize) {
  ProblemFile file = with_extras(sample_primal(coulomb_cones()));
  file.guess.conservativeResize(4);
  EXPECT_THROW(write_problem_file(at("p.h5"), file), InputError);
  file = with_extras(sample_primal(coulomb_cones()));
  file.geometry->points.conservativeResize(2, 3);
  EXPECT_THROW(write_problem_file(at("p.h5"), file), InputError);
}

TEST_F(RoundTrip, HashIgnoresOrderZerosAndTheSignOfZero) {
  SparseMatrix W(2, 2), untidy(2, 2);
  W.insert(0, 0) = 1.0;
  W.insert(1, 1) = 2.0;
  untidy.reserve(Eigen::Vector2i(3, 3));
  untidy.insert(0, 1) = 0.0;
  untidy.insert(0, 0) = 1.0;
  untidy.insert(1, 1) = 2.0;
  untidy.insert(1, 0) = -0.0;
  const std::vector<Cone> cones{Cone::coulomb(2, 0.5)};
  const Problem a(ReducedData{W, Eigen::Vector2d(0.0, 1.0)}, cones, {});
  const Problem b(ReducedData{untidy, Eigen::Vector2d(-0.0, 1.0)}, cones, sample_metadata("b"));
  EXPECT_EQ(content_sha256(a), content_sha256(b));
  const Problem c(ReducedData{W, Eigen::Vector2d(0.0, 1.0)}, {Cone::coulomb(2, 0.6)}, {});
  EXPECT_NE(content_sha256(a), content_sha256(c));
}

TEST_F(RoundTrip, SolutionFileHoldsNoProblem) {
  const Problem problem = sample_primal(coulomb_cones());
  write_solution_file(at("s.h5"), problem, *with_extras(problem).solution);
  EXPECT_EQ(file_format(at("s.h5")), FileFormat::kUnknown);
  EXPECT_THROW(load_problem(at("s.h5")), InputError);
}

}  // namespace
}  // namespace conebench::problems::test
