#include "problems/excess_work.h"

#include "problems/error.h"

namespace conebench::problems {

double excess_work(const Problem& standard, const Eigen::VectorXd& r) {
  require(standard.is_standard(), standard.name(),
          "kappa > 0, expected the standard problem: Problem::shifted()");
  require(r.size() == standard.rows(), standard.name(), "r has ", r.size(), " entries, expected ",
          standard.rows());
  const Eigen::VectorXd u = standard.rate(r);
  double work = r.dot(u);
  for (int i = 0; i < standard.cone_count(); ++i) {
    const Cone& cone = standard.cones()[static_cast<std::size_t>(i)];
    work +=
        r(standard.start(i)) * cone.theta * tangential_norm(u.segment(standard.start(i), cone.dim));
  }
  return work;
}

}  // namespace conebench::problems
