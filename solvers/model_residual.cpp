#include "solvers/model_residual.h"

#include "problems/residual.h"
#include "solvers/ccp.h"
#include "solvers/pyramid.h"
#include "solvers/pyramid_law.h"
#include "solvers/variant_text.h"

namespace conebench::solvers {
namespace {

int faces_of(const VariantText& variant) {
  for (const auto& item : variant.items) {
    if (item.key == "faces") return std::stoi(item.values.front());
  }
  return static_cast<int>(std::get<std::int64_t>(pyramid_model().parameters.front().fallback));
}

}  // namespace

std::optional<double> model_residual(std::string_view variant, const problems::Problem& standard,
                                     const Eigen::VectorXd& r) {
  const VariantText text = parse_file_variant(variant);
  if (text.name == "ccp" || text.name == "siconos:soclcp") {
    return problems::evaluate_eta(associated_problem(standard), r);
  }
  if (text.name != "pyramid" || PyramidLaw::refuses(standard)) return std::nullopt;
  return PyramidLaw(faces_of(text)).eta(standard, r);
}

}  // namespace conebench::solvers
