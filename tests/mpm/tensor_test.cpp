#include "mpm/tensor.h"

#include <gtest/gtest.h>

#include <random>

namespace conebench::test {
namespace {

using mpm::Sym;
using mpm::Vec;

template <int D>
using Tensor = Eigen::Matrix<double, D, D>;

// Numbers in [-1, 1), the same in every run.
class Random {
 public:
  double number() { return number_(random_); }
  template <int D>
  Tensor<D> matrix() {
    Tensor<D> a;
    for (int k = 0; k < D * D; ++k) a(k / D, k % D) = number();
    return a;
  }
  template <int D>
  Tensor<D> symmetric() {
    const Tensor<D> a = matrix<D>();
    return a + a.transpose();
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

template <class Dimension>
class TensorOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TensorOf, Dimensions);

TYPED_TEST(TensorOf, ProductIsTwiceThatOfTheCoordinates) {
  constexpr int D = TypeParam::value;
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Tensor<D> a = random.symmetric<D>(), b = random.symmetric<D>();
    const double product = a.cwiseProduct(b).sum();
    EXPECT_NEAR(2.0 * mpm::to_sym<D>(a).dot(mpm::to_sym<D>(b)), product, 1e-14);
  }
}

TYPED_TEST(TensorOf, CoordinatesGiveTheTensorBack) {
  constexpr int D = TypeParam::value;
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Tensor<D> a = random.symmetric<D>();
    EXPECT_LT((mpm::to_tensor<D>(mpm::to_sym<D>(a)) - a).norm(), 1e-15 * 4.0);
  }
}

TYPED_TEST(TensorOf, FirstCoordinateIsThePressureAndTheOthersTheDeviator) {
  constexpr int D = TypeParam::value;
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Tensor<D> a = random.symmetric<D>();
    const Sym<D> s = mpm::to_sym<D>(a);
    const double p = a.trace() / D;
    const Tensor<D> deviator = a - p * Tensor<D>::Identity();
    EXPECT_NEAR(mpm::pressure(D, s[0]), p, 1e-15);
    EXPECT_NEAR(std::sqrt(2.0) * s.tail(mpm::kEntries<D> - 1).norm(), deviator.norm(), 1e-14);
  }
}

TYPED_TEST(TensorOf, StrainBlocksSumToTwiceTheStrainRate) {
  constexpr int D = TypeParam::value;
  Random random;
  for (int k = 0; k < 1000; ++k) {
    // A velocity with gradient v g^T, as one node gives it.
    const Vec<D> v = random.matrix<D>().col(0), g = random.matrix<D>().col(0);
    const Tensor<D> gradient = v * g.transpose();
    const Tensor<D> strain = 0.5 * (gradient + gradient.transpose());
    EXPECT_LT((mpm::strain_block<D>(g) * v - 2.0 * mpm::to_sym<D>(strain)).norm(), 1e-15 * 4.0);
  }
}

// mu p + c - sqrt(J2) from the tensor, and how deep its coordinates are in the cone: the same.
TYPED_TEST(TensorOf, DruckerPragerIsTheShiftedCone) {
  constexpr int D = TypeParam::value;
  Random random;
  int inside = 0;
  for (int k = 0; k < 1000; ++k) {
    const Tensor<D> a = random.symmetric<D>();
    const double mu = 1.01 + random.number(), c = k % 3 == 0 ? 0.0 : 1.0 + random.number();
    const double p = a.trace() / D;
    const double J2 = 0.5 * (a - p * Tensor<D>::Identity()).squaredNorm();
    const double by_tensor = mu * p + c - std::sqrt(J2);
    const Sym<D> s = mpm::to_sym<D>(a);
    const double by_cone = mpm::cone_friction(D, mu) * (s[0] + mpm::cone_tip(D, mu, c)) -
                           s.tail(mpm::kEntries<D> - 1).norm();
    EXPECT_NEAR(by_cone, by_tensor, 1e-14) << "mu " << mu << ", c " << c;
    inside += by_tensor >= 0.0;
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 900);
}

TYPED_TEST(TensorOf, TipOfTheConeIsATensionOfCOverMu) {
  constexpr int D = TypeParam::value;
  EXPECT_NEAR(mpm::pressure(D, mpm::cone_tip(D, 0.3, 60.0)), 200.0, 1e-13 * 200.0);
  EXPECT_EQ(mpm::cone_tip(D, 0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace conebench::test
