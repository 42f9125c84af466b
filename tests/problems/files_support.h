#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "problems/problem_file.h"

namespace conebench::problems::test {

/// A folder of its own for each test, removed at the end.
class Files : public ::testing::Test {
 protected:
  Files() {
    std::string name = (std::filesystem::temp_directory_path() / "conebench-files-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Files() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path at(const std::string& name) const { return folder_ / name; }

  std::filesystem::path folder_;
};

inline Eigen::VectorXd random_vector(Eigen::Index size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); });
}

inline SparseMatrix random_matrix(Eigen::Index rows, Eigen::Index cols, double fill,
                                  std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(rows, cols);
  for (double& x : dense.reshaped()) {
    if (uniform(random) < fill) x = normal(random);
  }
  return dense.sparseView();
}

inline Eigen::Index rows_of(const std::vector<Cone>& cones) {
  Eigen::Index rows = 0;
  for (const Cone& cone : cones) rows += cone.dim;
  return rows;
}

inline Metadata sample_metadata(const std::string& name) {
  Metadata metadata;
  metadata.name = name;
  metadata.engine = "dem";
  metadata.scene = "colonne-s\u00e8che";
  metadata.step = 420;
  metadata.step_size_s = 1e-3;
  metadata.origin = "a test";
  metadata.sampling_weight = 2.5;
  return metadata;
}

/// 12 dofs in blocks of three, M block diagonal.
inline Problem sample_primal(std::vector<Cone> cones, unsigned seed = 1) {
  constexpr Eigen::Index kDofs = 12;
  std::mt19937 random(seed);
  const Eigen::Index rows = rows_of(cones);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(kDofs, kDofs);
  for (Eigen::Index block = 0; block < kDofs; block += 3) {
    const Eigen::Matrix3d root = random_matrix(3, 3, 1.0, random);
    M.block<3, 3>(block, block) = root * root.transpose() + Eigen::Matrix3d::Identity();
  }
  return {PrimalData{M.sparseView(), random_matrix(rows, kDofs, 0.5, random),
                     random_vector(kDofs, random), random_vector(rows, random)},
          std::move(cones), sample_metadata("sample-primal")};
}

inline Problem sample_reduced(std::vector<Cone> cones, unsigned seed = 2) {
  std::mt19937 random(seed);
  const Eigen::Index rows = rows_of(cones);
  const SparseMatrix root = random_matrix(rows, rows, 0.5, random);
  return {
      ReducedData{SparseMatrix(root * SparseMatrix(root.transpose())), random_vector(rows, random)},
      std::move(cones), sample_metadata("sample-reduced")};
}

inline std::vector<Cone> coulomb_cones() {
  return {Cone::coulomb(3, 0.5), Cone::coulomb(3, 0.0), Cone::coulomb(3, 0.8)};
}

inline std::vector<Cone> cohesive_cones() {
  return {Cone::coulomb(3, 0.5, 0.25), Cone::coulomb(3, 0.3), Cone::coulomb(3, 0.8, 1.5)};
}

inline std::vector<Cone> mixed_cones() {
  return {Cone::coulomb(1, 0.0), {3, 0.5, 0.1, 0.2}, Cone::associated(6, 0.4), {2, 0.3, 0.0, 0.3}};
}

/// Everything that a file can hold beside the problem.
inline ProblemFile with_extras(Problem problem) {
  std::mt19937 random(3);
  const Eigen::Index cones = problem.cone_count(), rows = problem.rows();
  Geometry geometry;
  geometry.points = Geometry::Table::Random(cones, 3);
  geometry.frames = Geometry::Table::Random(cones, 9);
  geometry.bodies_of_cone = Geometry::Pairs::Zero(cones, 2);
  geometry.bodies_of_cone(0, 1) = -1;
  geometry.body_positions = Geometry::Table::Random(2, 3);
  geometry.body_radii = Eigen::VectorXd::Constant(2, 0.5);
  Solution solution;
  solution.r = random_vector(rows, random);
  solution.eta = 0.125;
  ProblemFile file{std::move(problem), geometry, random_vector(rows, random), solution};
  return file;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

inline std::size_t files_in(const std::filesystem::path& folder) {
  const auto begin = std::filesystem::directory_iterator(folder);
  return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
}

}  // namespace conebench::problems::test
