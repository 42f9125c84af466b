// newton-ac and newton-fb: parameters and registration.

#include "solvers/newton/newton.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using Form = GeneralSystem::Form;
using Function = NewtonSettings::Function;

LineSearch line_search(const std::string& name) {
  if (name == "none") return LineSearch::kNone;
  if (name == "armijo") return LineSearch::kArmijo;
  if (name == "goldstein-price") return LineSearch::kGoldsteinPrice;
  return LineSearch::kNonMonotone;
}

Form form(const std::string& name) {
  if (name == "reduced") return Form::kReduced;
  return name == "full" ? Form::kFull : Form::kAuto;
}

std::vector<Parameter> common_parameters() {
  return {{.name = "form",
           .fallback = std::string("auto"),
           .choices = {"auto", "reduced", "full"},
           .doc = "factorise A + B W (reduced), or the system in (M, H) that spares W (full)"},
          {.name = "line_search",
           .fallback = std::string("non-monotone"),
           .choices = {"none", "armijo", "goldstein-price", "non-monotone"},
           .doc = "how the step length is chosen"},
          {.name = "regularisation",
           .fallback = NewtonSettings{}.regularisation,
           .low = 0.0,
           .high = 100.0,
           .doc = "first weight of the proximal term, as a share of lambda_i [-]"},
          {.name = "warmup",
           .fallback = NewtonSettings{}.warmup,
           .low = 0,
           .high = 1e6,
           .doc = "sweeps of gs before the first step"}};
}

NewtonSettings common_settings(Function function, const Values& values) {
  return {.function = function,
          .line_search = line_search(std::get<std::string>(values.at("line_search"))),
          .form = form(std::get<std::string>(values.at("form"))),
          .regularisation = std::get<double>(values.at("regularisation")),
          .warmup = std::get<std::int64_t>(values.at("warmup"))};
}

Solver make(const Method& method, const Values& values, const NewtonSettings& settings) {
  auto refuses = [needs_primal = settings.form == Form::kFull](
                     const Problem& problem) -> std::optional<std::string> {
    if (needs_primal && !problem.is_primal()) return "form=full needs M and H";
    return refuse_zero_delassus(problem);
  };
  auto iteration = [settings](const Problem& problem) { return make_newton(problem, settings); };
  return make_iterative_solver(method, values, refuses, iteration);
}

}  // namespace

Method alart_curnier_newton() {
  Method method{.name = "newton-ac",
                .kind = Kind::kMethod,
                .summary = "semismooth Newton on Alart and Curnier's function, proximal term",
                .source =
                    "Acary, Bremond, Huber, RR-9118 (2017), NSN-AC, and PPA-NSN for the proximal "
                    "term (not checked)",
                .parameters = common_parameters(),
                .make = {}};
  method.parameters.push_back({.name = "rho",
                               .fallback = NewtonSettings{}.rho,
                               .low = 1e-6,
                               .high = 1e6,
                               .doc = "step of the function, in units of 1 / lambda_i [-]"});
  method.parameters.push_back({.name = "variant",
                               .fallback = std::string("alart-curnier"),
                               .choices = {"alart-curnier", "jean-moreau"},
                               .doc = "friction disk from r_n - rho u_n, or from r_n alone"});
  method.make = [method](const Values& values) {
    const bool moreau = std::get<std::string>(values.at("variant")) == "jean-moreau";
    NewtonSettings settings =
        common_settings(moreau ? Function::kJeanMoreau : Function::kAlartCurnier, values);
    settings.rho = std::get<double>(values.at("rho"));
    return make(method, values, settings);
  };
  return method;
}

Method fischer_burmeister_newton() {
  Method method{
      .name = "newton-fb",
      .kind = Kind::kMethod,
      .summary = "semismooth Newton on Fischer and Burmeister's function, proximal term",
      .source =
          "Fukushima, Luo, Tseng, SIAM J. Optim. 12(2) (2002); Daviet, Bertails-Descoubes, "
          "Boissieux, ACM Trans. Graph. 30(6) (2011) (neither checked)",
      .parameters = common_parameters(),
      .make = {}};
  method.make = [method](const Values& values) {
    return make(method, values, common_settings(Function::kFischerBurmeister, values));
  };
  return method;
}

}  // namespace conebench::solvers
