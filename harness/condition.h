#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::harness {

/// A condition on named facts, as `--where` and `--gate` take it:
///
///   cones > 1e3 && (engine == "mpm" || mu_max >= 0.5) && !coulomb
///   sgm(time) < 1.05 && failures <= 0
///
/// Operators, loosest first: ||, &&, !, then one of == != < <= > >=. Operands: names of facts,
/// which may end in a name in parentheses, numbers, texts in single or double quotes, true, false.
/// Texts compare with == and != only; a fact that is missing (null) is unequal to everything and
/// otherwise fails.
class Condition {
 public:
  /// What messages say, and what a name may be.
  struct Terms {
    std::string option;                ///< the subject of every InputError
    std::string noun;                  ///< what a name stands for
    std::vector<std::string> names{};  ///< the known ones; empty: those of the facts
  };

  /// Throws InputError that points at the place it does not understand.
  Condition(std::string_view expression, Terms terms);
  ~Condition();
  Condition(Condition&&) noexcept;

  /// `facts`: one flat object. Throws InputError for a name that is not in it (with the nearest one
  /// that is) and for operands that do not compare.
  bool matches(const nlohmann::ordered_json& facts) const;

  struct Node;

 private:
  Terms terms_;
  std::unique_ptr<Node> root_;
};

}  // namespace conebench::harness
