#include "problems/features_json.h"

#include <nlohmann/json.hpp>

namespace conebench::problems {
namespace {

using Json = nlohmann::ordered_json;
using Range = std::pair<double, double>;

void put_range(Json& json, const std::string& name, const Range& range) {
  json[name + "_min"] = range.first;
  json[name + "_max"] = range.second;
}

Range get_range(const Json& json, const std::string& name) {
  return {json.at(name + "_min").get<double>(), json.at(name + "_max").get<double>()};
}

}  // namespace

Json features_to_json(const Features& f) {
  Json json;
  json["cones"] = f.cones;
  json["rows"] = f.rows;
  json["dofs"] = f.dofs;
  json["primal"] = f.primal;
  json["dim_min"] = f.cones_of_dim.empty() ? 0 : f.cones_of_dim.front().first;
  json["dim_max"] = f.cones_of_dim.empty() ? 0 : f.cones_of_dim.back().first;
  json["cones_of_dim"] = f.cones_of_dim;
  put_range(json, "mu", f.mu);
  put_range(json, "kappa", f.kappa);
  put_range(json, "theta", f.theta);
  put_range(json, "mobility", f.mobility);
  json["cohesive_share"] = f.cohesive_share;
  json["coulomb"] = f.coulomb;
  json["nonzeros_M"] = f.nonzeros_M;
  json["nonzeros_H"] = f.nonzeros_H;
  json["nonzeros_W"] = f.nonzeros_W;
  json["asymmetry"] = f.asymmetry;
  json["block_diagonal_mass"] = f.block_diagonal_mass;
  json["islands"] = f.islands;
  json["largest_island"] = f.largest_island;
  json["rows_per_dof"] = f.rows_per_dof;
  json["rate_scale"] = f.rate_scale;
  return json;
}

Features features_from_json(const Json& json) {
  Features f;
  json.at("cones").get_to(f.cones);
  json.at("rows").get_to(f.rows);
  json.at("dofs").get_to(f.dofs);
  json.at("primal").get_to(f.primal);
  json.at("cones_of_dim").get_to(f.cones_of_dim);
  f.mu = get_range(json, "mu");
  f.kappa = get_range(json, "kappa");
  f.theta = get_range(json, "theta");
  f.mobility = get_range(json, "mobility");
  json.at("cohesive_share").get_to(f.cohesive_share);
  json.at("coulomb").get_to(f.coulomb);
  json.at("nonzeros_M").get_to(f.nonzeros_M);
  json.at("nonzeros_H").get_to(f.nonzeros_H);
  json.at("nonzeros_W").get_to(f.nonzeros_W);
  json.at("asymmetry").get_to(f.asymmetry);
  json.at("block_diagonal_mass").get_to(f.block_diagonal_mass);
  json.at("islands").get_to(f.islands);
  json.at("largest_island").get_to(f.largest_island);
  json.at("rows_per_dof").get_to(f.rows_per_dof);
  json.at("rate_scale").get_to(f.rate_scale);
  return f;
}

}  // namespace conebench::problems
