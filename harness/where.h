#pragma once

#include "harness/condition.h"

namespace conebench::harness {

/// A condition on the facts of a problem (problems::to_json of an entry). Errors have the subject
/// `--where`.
class Where : public Condition {
 public:
  explicit Where(std::string_view expression)
      : Condition(expression, {.option = "--where", .noun = "fact of a problem"}) {}
};

}  // namespace conebench::harness
