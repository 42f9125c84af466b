#include "dem/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "problems/error.h"
#include "tests/engine/own_folder.h"

namespace conebench::test {
namespace {

using dem::Motion;
using dem::Pose;
using dem::Table;
using dem::Twist;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kForever = std::numeric_limits<double>::infinity();

Quaterniond rotation(const Vector3d& turn) {
  return Quaterniond(AngleAxisd(turn.norm(), turn.stableNormalized()));
}

void expect_near(const Vector3d& found, const Vector3d& expected, double tolerance) {
  EXPECT_LE((found - expected).norm(), tolerance)
      << "found " << found.transpose() << ", expected " << expected.transpose();
}

Table two_poses(const Vector3d& point, const Pose& first, const Pose& second) {
  return {.file = {}, .point_m = point, .t_s = {1.0, 2.0}, .poses = {first, second}};
}

TEST(Motion, TurnsAQuarterAboutAnAxisOffTheOrigin) {
  const Motion drum{"drum", dem::Turn{{1, 0, 0}, Vector3d::UnitZ(), 2.0, 0.5, kForever}};
  const double quarter_s = 0.5 + kPi / 4.0;
  expect_near(drum.displacement(quarter_s) * Vector3d(2, 0, 7), {1, 1, 7}, 1e-15);
  expect_near(drum.displacement(quarter_s) * Vector3d(1, 0, 0), {1, 0, 0}, 1e-15);
  EXPECT_EQ(drum.displacement(0.5) * Vector3d(2, 3, 7), Vector3d(2, 3, 7));

  // A chord of sqrt(2) and a turn of pi/2 in the quarter.
  const Twist twist = mean_twist(drum, 0.5, kPi / 4.0, {2, 0, 7});
  expect_near(twist.velocity_m_s * (kPi / 4.0), {-1, 1, 0}, 1e-15);
  expect_near(twist.rate_rad_s, {0, 0, 2}, 1e-15);
}

TEST(Motion, ShakesBackToItsPlaceAfterAPeriod) {
  const Motion shaker{"shaker", dem::Shake{{0, 0, 1e-3}, 50.0, 0.25, kForever}};
  expect_near(shaker.displacement(0.25 + 0.005).position, {0, 0, 1e-3}, 1e-17);
  expect_near(shaker.displacement(0.25 + 0.015).position, {0, 0, -1e-3}, 1e-17);
  // After a thousand periods too: rounding of 50 t by 1e-14 periods moves it by 1e-16 m.
  expect_near(shaker.displacement(0.25 + 1000 * 0.02).position, {0, 0, 0}, 1e-16);
  EXPECT_EQ(shaker.displacement(0.1).position, Vector3d(0, 0, 0));
}

TEST(Motion, SlidesUntilItStopsAlsoInsideAStep) {
  const Motion door{"door", dem::Slide{{0, 2, 0}, 1.0, 1.5}};
  expect_near(door.displacement(1.25).position, {0, 0.5, 0}, 1e-16);
  expect_near(door.displacement(1e6).position, {0, 1, 0}, 1e-16);
  expect_near(mean_twist(door, 1.4, 0.4, {5, 6, 7}).velocity_m_s, {0, 0.5, 0}, 1e-15);
  expect_near(mean_twist(door, 0.8, 0.4, {5, 6, 7}).velocity_m_s, {0, 1.0, 0}, 1e-15);
  EXPECT_EQ(mean_twist(door, 1.5, 0.1, {5, 6, 7}).velocity_m_s, Vector3d(0, 0, 0));
}

TEST(Motion, StaysWhereItIsWhenItEnds) {
  const Motion stopped[] = {
      {"turn", dem::Turn{{1, 2, 3}, Vector3d(1, 2, 2) / 3.0, 3.0, 0.0, 0.7}},
      {"shake", dem::Shake{{1, 2, 3}, 3.3, 0.0, 0.7}},
      {"table", two_poses({1, 2, 3}, {}, {{1, 1, 0}, rotation({0.3, 0.2, 0.1})})}};
  for (const Motion& motion : stopped) {
    const Pose end = motion.displacement(2.0);
    EXPECT_GT((end * Vector3d(3, 1, 4) - Vector3d(3, 1, 4)).norm(), 0.1) << motion.name;
    EXPECT_EQ(motion.displacement(9.0) * Vector3d(3, 1, 4), end * Vector3d(3, 1, 4));
    const Twist rest = mean_twist(motion, 2.0, 1e-3, {3, 1, 4});
    EXPECT_EQ(rest.velocity_m_s, Vector3d(0, 0, 0)) << motion.name;
    EXPECT_EQ(rest.rate_rad_s, Vector3d(0, 0, 0)) << motion.name;
  }
}

TEST(Motion, JoinsTheLinesOfATable) {
  const Motion motion{"table", two_poses({1, 0, 0}, {{0, 0, 1}, rotation({0, 0, 0})},
                                         {{0, 4, 1}, rotation({0, 0, kPi / 2})})};
  // A quarter of the way: 22.5 degrees about the point, which is then at (1, 1, 1).
  expect_near(motion.displacement(1.25) * Vector3d(2, 0, 0),
              {1 + std::cos(kPi / 8), 1 + std::sin(kPi / 8), 1}, 1e-15);
  expect_near(motion.displacement(0.0) * Vector3d(2, 0, 0), {2, 0, 1}, 1e-15);
  expect_near(motion.displacement(3.0) * Vector3d(2, 0, 0), {1, 5, 1}, 1e-15);
  // Into the end: from y = 2 to y = 4 in the first half of the step, then at rest.
  expect_near(mean_twist(motion, 1.5, 1.0, {1, 2, 1}).velocity_m_s, {0, 2, 0}, 1e-15);
}

TEST(Motion, IsAVelocityFieldAboutItsPoint) {
  const Twist twist{{1, 0, 0}, {0, 0, 2}, {0, 3, 0}};
  EXPECT_EQ(twist.at({0, 3, 0}), Vector3d(1, 0, 0));
  EXPECT_EQ(twist.at({1, 3, 0}), Vector3d(1, 2, 0));
}

// Steps x += h v, q = exp(h rate) q from t = 0 to the end.
Pose steps(const Motion& motion, double end_s, int count, const Vector3d& rest) {
  const double h = end_s / count;
  Pose place{motion.displacement(0.0) * rest, motion.displacement(0.0).orientation};
  for (int k = 0; k < count; ++k) {
    const Twist twist = mean_twist(motion, k * h, h, place.position);
    EXPECT_EQ(twist.at(place.position), twist.velocity_m_s);
    place.position += h * twist.velocity_m_s;
    place.orientation = rotation(h * twist.rate_rad_s) * place.orientation;
  }
  return place;
}

TEST(Motion, StepsOfItsMeanTwistEndAtItsPlace) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  Table table{.file = {}, .point_m = vector(), .t_s = {}, .poses = {}};
  Vector3d turn = vector();
  for (int k = 0; k < 20; ++k) {
    table.t_s.push_back(0.05 + 0.11 * k);
    table.poses.push_back({vector(), rotation(turn)});
    turn += 2.5 * vector().normalized();
  }
  const Motion motions[] = {{"slide", dem::Slide{vector(), 0.111, 1.777}},
                            {"turn", dem::Turn{vector(), vector().normalized(), 40.0, 0.1, 1.9}},
                            {"shake", dem::Shake{vector(), 3.7, 0.123, 1.871}},
                            {"table", table}};
  for (const Motion& motion : motions) {
    for (const int count : {37, 1000}) {
      const Vector3d rest = vector();
      const Pose end = steps(motion, 2.0, count, rest);
      const Pose expected = motion.displacement(2.0);
      EXPECT_LE((end.position - expected * rest).norm(), 1e-12) << motion.name << ' ' << count;
      EXPECT_LE(end.orientation.angularDistance(expected.orientation), 1e-12) << motion.name;
    }
  }
}

class MotionTable : public OwnFolder {
 protected:
  MotionTable() { std::filesystem::create_directories(folder_); }

  std::filesystem::path write(const std::string& text) const {
    const auto path = folder_ / "motion.csv";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // What reading the text throws.
  std::string error_of(const std::string& text) const {
    const auto path = write(text);
    try {
      dem::read_table(path, Vector3d::Zero(), "bodies[2].motion.file");
    } catch (const problems::InputError& error) {
      EXPECT_EQ(error.subject(), "bodies[2].motion.file");
      const std::string start = "bodies[2].motion.file: " + path.string() + ": ",
                        what = error.what();
      EXPECT_TRUE(what.starts_with(start)) << what;
      return what.substr(std::min(start.size(), what.size()));
    }
    return "no error";
  }
};

TEST_F(MotionTable, IsReadWithAndWithoutTurns) {
  const Table places =
      dem::read_table(write("t_s,x_m,y_m,z_m\n0,0,0,0\n\n 0.5 , 1e-3,-2,3\n"), {1, 2, 3}, "key");
  EXPECT_EQ(places.t_s, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(places.poses[1].position, Vector3d(1e-3, -2, 3));
  EXPECT_EQ(places.poses[1].orientation.coeffs(), Quaterniond::Identity().coeffs());
  EXPECT_EQ(places.point_m, Vector3d(1, 2, 3));

  // As spreadsheets write it: byte order mark, CR LF, no line end at the end.
  const Table turns = dem::read_table(
      write("\xEF\xBB\xBFt_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\r\n0,0,0,0,0,0,6\r\n1,0,0,0,0,0,9"),
      {0, 0, 0}, "key");
  EXPECT_LE(turns.poses[0].orientation.angularDistance(rotation({0, 0, 6})), 1e-15);
  EXPECT_LE(turns.poses[1].orientation.angularDistance(rotation({0, 0, 9})), 1e-15);
  // A turn of 3 rad on the way that the numbers say, not the 3.28 rad the other way.
  const Motion motion{"table", turns};
  EXPECT_LE(motion.displacement(0.5).orientation.angularDistance(rotation({0, 0, 7.5})), 1e-15);
}

TEST_F(MotionTable, NamesFileLineAndColumnOfWhatIsWrong) {
  const std::string names = "t_s,x_m,y_m,z_m\n", turns = "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\n";
  EXPECT_EQ(error_of(names + "0,0,0,0\n1,0,up,0\n"),
            "line 3: column y_m: found 'up', expected a finite number");
  EXPECT_EQ(error_of(names + "0,0,0,0\n1,0,0.5m,0\n"),
            "line 3: column y_m: found '0.5m', expected a finite number");
  EXPECT_EQ(error_of(names + "0,0,0,\n1,0,0,0\n"),
            "line 2: column z_m: found '', expected a finite number");
  EXPECT_EQ(error_of(names + "nan,0,0,0\n1,0,0,0\n"),
            "line 2: column t_s: found 'nan', expected a finite number");
  EXPECT_EQ(error_of(names + "0,0,0,0\n1,0,0,1e999\n"),
            "line 3: column z_m: found '1e999', expected a finite number");
  EXPECT_EQ(error_of(names + "0,0,0,0\n\n1,0,0"), "line 4: found 3 columns, expected 4");
  EXPECT_EQ(error_of(names + "0,0,0,0,0\n1,0,0,0\n"), "line 2: found 5 columns, expected 4");
  EXPECT_EQ(error_of(turns + "0,0,0,0\n"), "line 2: found 4 columns, expected 7");
  EXPECT_EQ(error_of(names + "0,0,0,0\n1,0,0,0\n1,0,0,0\n"),
            "line 4: column t_s: found 1 after 1, expected increasing times");
  EXPECT_EQ(error_of(names + "0,0,0,0\n-1,0,0,0\n"),
            "line 3: column t_s: found -1 after 0, expected increasing times");
  EXPECT_THAT(error_of(turns + "0,0,0,0,0,0,0\n1,0,0,0,0,0,6.28\n"),
              testing::StartsWith("line 3: columns rx_rad to rz_rad: a change of 6.28 rad from the "
                                  "line before, expected less than pi"));
}

TEST_F(MotionTable, NamesAFileThatIsNoTable) {
  EXPECT_EQ(error_of("0,0,0,0\n1,0,0,0\n"),
            "line 1: found the columns '0,0,0,0', expected t_s,x_m,y_m,z_m or "
            "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad");
  EXPECT_THAT(error_of("t_s,x_m,y_m,z_mm\n"), testing::HasSubstr("found the columns"));
  EXPECT_THAT(error_of("t_s,x_m,y_m,z_m,rx_rad\n"), testing::HasSubstr("found the columns"));
  EXPECT_EQ(error_of("\n\n"), "is empty, expected a first line with the names of the columns");
  EXPECT_EQ(error_of("t_s,x_m,y_m,z_m\n0,0,0,0\n"), "has 1 lines of numbers, expected at least 2");
  const auto read = [](const std::filesystem::path& path) {
    dem::read_table(path, Vector3d::Zero(), "key");
  };
  EXPECT_THROW(read(folder_ / "none.csv"), problems::InputError);
  EXPECT_THROW(read(folder_), problems::InputError);
}

}  // namespace
}  // namespace conebench::test
