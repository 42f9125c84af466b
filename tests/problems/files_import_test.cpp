// Files that other programs made: those in the shared folder, and each trap by itself.

#include <map>

#include "problems/error.h"
#include "problems/load.h"
#include "problems/residual.h"
#include "tests/problems/files_edit.h"
#include "tests/problems/files_support.h"

namespace conebench::problems::test {
namespace {

namespace fs = std::filesystem;

const fs::path kShared = CONEBENCH_SHARED_DATA;

class Import : public Files {
 protected:
  // A local FCLIB file for W = [[2, 1], [1, 3]] whose matrix a test then stores its own way.
  fs::path local_file() {
    const fs::path path = at("local.hdf5");
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    for (const char* group : {"/fclib_local", "/fclib_local/W", "/fclib_local/vectors"}) {
      H5Gclose(H5Gcreate2(file, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    }
    H5Fclose(file);
    Edit edit(path);
    edit.put("/fclib_local/spacedim", std::vector<int>{2});
    edit.put("/fclib_local/vectors/q", std::vector<double>{-1.0, 0.5});
    edit.put("/fclib_local/vectors/mu", std::vector<double>{0.4});
    edit.put("/fclib_local/W/m", std::vector<int>{2});
    edit.put("/fclib_local/W/n", std::vector<int>{2});
    edit.put("/fclib_local/W/nzmax", std::vector<int>{99});
    return path;
  }

  static void store(Edit& edit, int nz, const std::vector<int>& p, const std::vector<int>& i,
                    const std::vector<double>& x) {
    edit.put("/fclib_local/W/nz", std::vector<int>{nz});
    edit.put("/fclib_local/W/p", p);
    edit.put("/fclib_local/W/i", i);
    edit.put("/fclib_local/W/x", x);
  }

  static Eigen::MatrixXd W_of(const fs::path& path) {
    return Eigen::MatrixXd(load_problem(path).problem.W());
  }
};

const Eigen::Matrix2d kW{{2.0, 1.04}, {1.0, 3.0}};

TEST_F(Import, ReadsUnsortedRows) {
  const fs::path path = local_file();
  {
    Edit edit(path);
    store(edit, -2, {0, 2, 4}, {1, 0, 1, 0}, {1.04, 2.0, 3.0, 1.0});
  }
  EXPECT_EQ(W_of(path), kW);
}

TEST_F(Import, ReadsColumns) {
  const fs::path path = local_file();
  {
    Edit edit(path);
    store(edit, -1, {0, 2, 4}, {0, 1, 0, 1}, {2.0, 1.0, 1.04, 3.0});
  }
  EXPECT_EQ(W_of(path), kW);
}

TEST_F(Import, ReadsTripletsWithRowsInIAndArraysLongerThanNz) {
  const fs::path path = local_file();
  {
    Edit edit(path);
    // Entry (1, 1) comes in two parts; what follows the first five is no entry.
    store(edit, 5, {0, 1, 0, 1, 1, 9}, {0, 0, 1, 1, 1, 9}, {2.0, 1.04, 1.0, 1.0, 2.0, 77.0});
  }
  EXPECT_EQ(W_of(path), kW);
}

TEST_F(Import, TakesASolutionOfZerosForNone) {
  const fs::path path = local_file();
  {
    Edit edit(path);
    store(edit, -1, {0, 2, 4}, {0, 1, 0, 1}, {2.0, 1.0, 1.04, 3.0});
    edit.put_group("/solution");
    edit.put("/solution/r", std::vector<double>{0.0, 0.0});
  }
  EXPECT_FALSE(load_problem(path).solution);
  {
    Edit edit(path);
    edit.put("/solution/r", std::vector<double>{0.5, 0.0});
  }
  const ProblemFile file = load_problem(path);
  ASSERT_TRUE(file.solution);
  EXPECT_EQ(file.solution->eta, evaluate_eta(file.problem, file.solution->r));
}

TEST_F(Import, NamesTheGroupOfBilateralConstraints) {
  for (const std::string group : {"V", "R"}) {
    const fs::path path = local_file();
    {
      Edit edit(path);
      store(edit, -1, {0, 2, 4}, {0, 1, 0, 1}, {2.0, 1.0, 1.04, 3.0});
      edit.put_group("/fclib_local/" + group);
    }
    try {
      load_problem(path);
      ADD_FAILURE() << "was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/fclib_local/" + group), std::string::npos);
    }
  }
}

TEST_F(Import, ReadsDenseTextColumnByColumn) {
  write_bytes(at("w.dat"), "2\n1\n0\n2\n2\n2\t2\n2 1 1.04 3\n-1 0.5\n0.4\n");
  EXPECT_EQ(W_of(at("w.dat")), kW);
}

TEST_F(Import, DropsTheRoundingOfDenseText) {
  write_bytes(at("w.dat"), "2\n1\n0\n2\n2\n2\t2\n2 1e-17 -3e-16 3\n-1 0.5\n0.4\n");
  EXPECT_EQ(load_problem(at("w.dat")).problem.W().nonZeros(), 2);
}

TEST_F(Import, ReadsBlocksColumnByColumn) {
  write_bytes(at("w.dat"),
              "2\n1\n1\n2\n2\n1\n1\n1\n2\n2\n2\n1\n0 1\n0\n0\n2 1 1.04 3\n-1 0.5\n0.4\n");
  EXPECT_EQ(W_of(at("w.dat")), kW);
}

TEST_F(Import, ReadsSparseTextInEveryKind) {
  const std::string head = "2\n1\n2\n2\n2\n", tail = "-1 0.5\n0.4\n";
  const std::string title = "CSparse Version 3.1.4, Oct 10, 2014.  Copyright (c)\n";
  write_bytes(at("t.dat"), head + "1\n" + title +
                               "triplet: 2-by-2, nzmax: 8 nnz: 4\n    0 0 : 2\n    0 1 : 1.04\n"
                               "    1 0 : 1\n    1 1 : 3\n" +
                               tail);
  EXPECT_EQ(W_of(at("t.dat")), kW);
  const std::string lines =
      "2-by-2, nzmax: 8 nnz: 4, 1-norm: 4.04\n    col 0 : locations 0 to 1\n      0 : 2\n"
      "      1 : 1\n    col 1 : locations 2 to 3\n      0 : 1.04\n      1 : 3\n";
  write_bytes(at("c.dat"), head + "2\n" + title + lines + tail);
  EXPECT_EQ(W_of(at("c.dat")), kW);
  write_bytes(at("r.dat"), head + "3\n" + title + lines + tail);
  EXPECT_EQ(W_of(at("r.dat")), kW.transpose());
}

TEST_F(Import, ReadsAGlobalTextProblem) {
  // M = diag(2, 4, 5), H (3 x 2, column by column), q, b, mu.
  write_bytes(at("g.dat"),
              "2\n1\n0\n3\n3\n3 3\n2 0 0 0 4 0 0 0 5\n0\n3\n2\n3 2\n1 2 3 4 5 6\n"
              "7 8 9\n-1 0.5\n0.4\n");
  const Problem problem = load_problem(at("g.dat")).problem;
  ASSERT_TRUE(problem.is_primal());
  EXPECT_EQ(Eigen::MatrixXd(problem.H()), (Eigen::MatrixXd{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}));
  EXPECT_EQ(problem.f(), Eigen::Vector3d(7.0, 8.0, 9.0));
  EXPECT_EQ(problem.w(), Eigen::Vector2d(-1.0, 0.5));
  EXPECT_EQ(Eigen::MatrixXd(problem.M()).diagonal(), Eigen::Vector3d(2.0, 4.0, 5.0));
}

TEST_F(Import, FindsProblemsByContentAndCountsTheRest) {
  write_problem_file(at("no-extension"), {sample_primal(coulomb_cones()), {}, {}, {}});
  write_bytes(at("fake.h5"), "plain text");
  write_bytes(at(".hidden"), "plain text");
  write_bytes(at("w.txt"), "2\n1\n0\n2\n2\n2\t2\n2 1 1.04 3\n-1 0.5\n0.4\n");
  const FoundProblems found = find_problems({folder_, at("w.txt")});
  EXPECT_EQ(found.files, (std::vector<fs::path>{at("no-extension"), at("w.txt")}));
  EXPECT_EQ(found.skipped, 1);
  EXPECT_THROW(find_problems({at("fake.h5")}), InputError);
  EXPECT_THROW(find_problems({at("nothing")}), InputError);
}

TEST_F(Import, ReadsEveryFileOfTheSharedData) {
  if (!fs::exists(kShared)) GTEST_SKIP() << kShared << " is not there";
  const FoundProblems found = find_problems({kShared});
  EXPECT_GE(found.files.size(), 36u);
  for (const fs::path& path : found.files) {
    SCOPED_TRACE(path);
    const ProblemFile file = load_problem(path);
    EXPECT_GT(file.problem.cone_count(), 0);
    EXPECT_GT(file.problem.rate_scale(), 0.0);
  }
}

TEST_F(Import, TwinsInTwoFormatsHashAlike) {
  const fs::path folder = kShared / "fclib";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const std::map<std::string, std::string> twins{
      {"Confeti-ex13-Fc3D-SBM.dat", "Confeti-ex13-Fc3D-SBM.hdf5"},
      {"KaplasTower-i1061-4.hdf5.dat", "KaplasTower-i1061-4.hdf5"},
      {"NESpheres_10_1.dat", "NESpheres_10_1.hdf5"},
      {"OneObject-i1028-138.hdf5.dat", "OneObject-i1028-138.hdf5"},
      {"RockPile_tob1.dat", "RockPile_tob1.hdf5"},
      {"Rover1039.dat", "Rover1039.hdf5"}};
  for (const auto& [text, hdf5] : twins) {
    EXPECT_EQ(content_sha256(load_problem(folder / text).problem),
              content_sha256(load_problem(folder / "from-dat" / hdf5).problem))
        << text;
  }
}

}  // namespace
}  // namespace conebench::problems::test
