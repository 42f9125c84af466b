// Writes a report's page of made-up records, for the tests of the page in a browser.
//
//   make_page OUT.html PROBLEMS SOLVERS [--space]
//
// With --space also models, warm starts, costs of steps and problems in space.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string_view>

#include "../results/make_record.h"
#include "problems/made_backwards.h"
#include "results/html.h"
#include "results/output.h"

namespace conebench::results {
namespace {

constexpr int kProblemsOfScene = 10;
constexpr double kLimit_s = 10.0;

struct Wanted {
  int problems = 20, solvers = 6;
  bool space = false;
};

// A curve that falls from 1 to eta, with as many looks as a slow solver takes.
std::vector<CurvePoint> falling_curve(double time_s, double eta, int looks) {
  std::vector<CurvePoint> curve;
  for (int k = 0; k <= looks; ++k) {
    const double share = static_cast<double>(k) / looks;
    curve.push_back({.time_s = share * time_s, .iteration = k, .eta = std::pow(eta, share)});
  }
  return curve;
}

std::vector<Record> cold_records(const Wanted& wanted) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Record> records;
  for (int p = 0; p < wanted.problems; ++p) {
    const int cones = static_cast<int>(std::exp2(4 + 7 * std::abs(std::sin(p * 0.37))));
    const double hardness = normal(random);
    for (int s = 0; s < wanted.solvers; ++s) {
      const double time_s = 1e-5 * cones * std::exp(0.4 * s + hardness + 0.5 * normal(random));
      const bool fails = time_s > kLimit_s || normal(random) > 1.8 - 0.1 * s - 0.4 * hardness;
      const double eta = fails ? 1e-8 * std::exp(8.0 + 3.0 * normal(random)) : 3e-9;
      Record record = make_record(fmt::format("scene-{:03}_{:06}", p / kProblemsOfScene, p),
                                  fmt::format("solver-{:02}[omega=1.{}]", s, s % 10),
                                  std::max(eta, 3e-9), time_s);
      record.problem.family = fmt::format("dem/scene-{:03}", p / kProblemsOfScene);
      record.problem.cones = cones;
      record.iterations = 40;
      record.curve = falling_curve(time_s, record.eta, 40);
      if (fails && p % 7 == 0) {
        record.status = Status::kKilledTime;
        record.eta = Record::kUnknown;
        record.curve.clear();
      }
      records.push_back(std::move(record));
    }
  }
  return records;
}

// The same as steps of sequences, twice as fast.
std::vector<Record> warm_records(std::vector<Record> records) {
  for (Record& record : records) {
    record.settings.mode = "sequence";
    record.sequence = {
        .name = record.problem.family, .id = record.problem.family, .index = 1, .length = 2};
    record.solve_s /= 2.0;
    for (CurvePoint& point : record.curve) point.time_s /= 2.0;
  }
  return records;
}

std::vector<Record> model_records(const std::vector<Record>& records) {
  std::vector<Record> models;
  for (const Record& record : records) {
    if (!record.solver.starts_with("solver-00")) continue;
    models.push_back(record);
    models.back().solver = "ccp";
    models.back().kind = "model";
    models.back().eta = 1e-3 * (1.0 + record.problem.cones % 17);
    models.back().model_eta = 1e-9;
  }
  return models;
}

// A pile in which cone i is the contact of ball i with ball i + 1, or with the ground.
ProblemView pile_view(const std::string& name, int cones, std::uint64_t seed) {
  auto [problem, solutions] =
      problems::make_backwards({.cones = cones, .cohesive_share = 0.3, .seed = seed});
  problems::Geometry geometry;
  geometry.points.resize(cones, 3);
  geometry.frames.setZero(cones, 9);
  geometry.bodies_of_cone.resize(cones, 2);
  geometry.body_positions.resize(cones, 3);
  geometry.body_radii.setConstant(cones, 0.5);
  for (int i = 0; i < cones; ++i) {
    geometry.body_positions.row(i) << i % 6, (i / 6) % 6, i / 36;
    geometry.points.row(i) = geometry.body_positions.row(i);
    geometry.points(i, 0) += 0.5;
    geometry.frames.row(i).head(3) << 1, 0, 0;
    geometry.bodies_of_cone.row(i) << i, (i % 6 == 5 || i + 1 == cones ? -1 : i + 1);
  }
  const problems::ProblemFile file{problem, geometry, {}, {}};
  const Eigen::VectorXd exact = solutions.front();
  ProblemView view =
      view_of(file, {{"solver-00[omega=1.0]", exact}, {"solver-01[omega=1.1]", 0.999 * exact}});
  view.name = name;
  view.family = "dem/scene-000";
  return view;
}

ReportInput input_of(const Wanted& wanted, std::vector<Record>& records) {
  records = cold_records(wanted);
  ReportInput input{.records = records, .command = "conebench run -p made-up -o R"};
  input.no_views = "No problem file is at hand.";
  if (!wanted.space) return input;
  const auto warm = warm_records(records);
  const auto models = model_records(records);
  records.insert(records.end(), models.begin(), models.end());
  records.insert(records.end(), warm.begin(), warm.end());
  input.records = records;
  input.scene_costs = {{.family = "dem/scene-000",
                        .steps = 100,
                        .solve_s = 1.0,
                        .other_s = 0.4,
                        .solver = "solver-00"},
                       {.family = "dem/scene-001",
                        .steps = 100,
                        .solve_s = 1.0,
                        .other_s = 4.0,
                        .solver = "solver-00"}};
  input.views = {pile_view("scene-000_000003", 90, 1), pile_view("scene-000_000004", 24, 2)};
  input.no_views.clear();
  return input;
}

int make_page(const std::string& path, const Wanted& wanted) {
  const auto files = page_files();
  if (!files) {
    std::cerr << "this build has no page\n";
    return 77;
  }
  std::vector<Record> records;
  const ReportInput input = input_of(wanted, records);
  write_text_file(path, html_report(input, *files));
  return 0;
}

}  // namespace
}  // namespace conebench::results

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: make_page OUT.html PROBLEMS SOLVERS [--space]\n";
    return 2;
  }
  const bool space = argc > 4 && std::string_view(argv[4]) == "--space";
  return conebench::results::make_page(
      argv[1], {.problems = std::atoi(argv[2]), .solvers = std::atoi(argv[3]), .space = space});
}
