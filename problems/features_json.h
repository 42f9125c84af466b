#pragma once

#include <nlohmann/json_fwd.hpp>

#include "problems/problem.h"

namespace conebench::problems {

/// The features as one flat object, so that every value has one name: counts and ratios under the
/// names of Features, ranges as `mu_min`, `mu_max` and so on, `dim_min`, `dim_max`, and
/// `cones_of_dim` as a list of [dim, count].
nlohmann::ordered_json features_to_json(const Features& features);

/// The inverse. Throws nlohmann::json::exception when a key is missing or has another type.
Features features_from_json(const nlohmann::ordered_json& json);

}  // namespace conebench::problems
