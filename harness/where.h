#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace conebench::harness {

/// A condition on the facts of a problem, as `--where` takes it:
///
///   cones > 1e3 && (engine == "mpm" || mu_max >= 0.5) && !coulomb
///
/// Operators, loosest first: ||, &&, !, then one of == != < <= > >=. Operands: names of facts,
/// numbers, texts in single or double quotes, true, false. Texts compare with == and != only; a
/// fact that a problem lacks (null) is unequal to everything and otherwise fails.
class Where {
 public:
  /// Throws InputError, subject `--where`, that points at the place it does not understand.
  explicit Where(std::string_view expression);
  ~Where();
  Where(Where&&) noexcept;

  /// `facts`: one flat object (problems::to_json of an entry). Throws InputError for a name that
  /// is no fact (with the nearest one that is) and for operands that do not compare.
  bool matches(const nlohmann::ordered_json& facts) const;

  struct Node;

 private:
  std::unique_ptr<Node> root_;
};

}  // namespace conebench::harness
