#include "harness/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "harness/commands/commands.h"
#include "harness/host.h"
#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::harness {
namespace {

constexpr int kUsage = 2, kInfrastructure = 3;

constexpr Example kExamples[] = {
    {"conebench demo", "all of it in less than three minutes"},
    {"conebench solve FILE -s gs", "one problem, one solver, verified"},
    {"conebench run -p DIR -s gs spg -o R", "every solver on every problem in DIR"},
    {"conebench report R", "who is fastest, and who fails where"},
};

constexpr ExitCode kExitCodes[] = {
    {0, "ok"},
    {1, "not converged, or a gate failed"},
    {kUsage, "wrong use or bad input"},
    {kInfrastructure, "output failed"},
    {4, "a claim of success was refuted (--strict)"},
    {130, "interrupted; a campaign resumes"},
};

std::string& stored_line() {
  static std::string line;
  return line;
}

std::string shell_quoted(const std::string& word) {
  constexpr auto kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

int complain(const std::string& message, int code) {
  fmt::print(stderr, "conebench: {}\n", message.substr(0, message.find('\n')));
  return code;
}

// CLI11 would call it an unexpected argument; a newcomer is better served by the nearest verb.
void check_verbs(const CLI::App& program, const std::vector<std::string>& arguments) {
  problems::require(!arguments.empty(), "usage",
                    "a command is expected; `conebench --help` lists them");
  const CLI::App* level = &program;
  for (const std::string& argument : arguments) {
    const auto verbs = level->get_subcommands([](const CLI::App*) { return true; });
    if (verbs.empty() || argument.starts_with('-')) return;
    std::vector<std::string> names;
    const CLI::App* next = nullptr;
    for (const CLI::App* verb : verbs) {
      names.push_back(verb->get_name());
      if (verb->get_name() == argument) next = verb;
    }
    if (next == nullptr) {
      throw problems::InputError(
          argument, fmt::format("no such command{}; known: {}",
                                problems::suggestion(argument, names), fmt::join(names, ", ")));
    }
    level = next;
  }
}

std::string unexpected_argument(const CLI::App& program) {
  const auto extras = program.remaining(true);
  const std::string word = extras.empty() ? "" : extras.front();
  const CLI::App* level = &program;
  while (!level->get_subcommands().empty()) level = level->get_subcommands().front();
  std::vector<std::string> known;
  for (const CLI::Option* option : level->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return fmt::format("{}: not expected here{}; `{} --help` lists what is", word,
                     problems::suggestion(word, known), level->get_name());
}

void add_verbs(CLI::App& program, int& exit_code) {
  add_demo(program, exit_code);
  add_scene(program, exit_code);
  add_simulate(program, exit_code);
  add_export(program, exit_code);
  add_problem(program, exit_code);
  add_solver(program, exit_code);
  add_solve(program, exit_code);
  add_plan(program, exit_code);
  add_run(program, exit_code);
  add_status(program, exit_code);
  add_merge(program, exit_code);
  add_report(program, exit_code);
  add_compare(program, exit_code);
  add_advise(program, exit_code);
  add_doctor(program, exit_code);
  add_manual(program, exit_code);
  add_completion(program, exit_code);
}

std::string footer() {
  std::string text = "Start here:\n";
  for (const Example& example : kExamples) {
    text += fmt::format("  {:<37} {}\n", example.command, example.what);
  }
  text += "\nEach command has its own --help. Data goes to stdout, everything else to stderr.\n";
  text += "Exit codes:\n";
  for (const ExitCode& exit : kExitCodes) {
    text += fmt::format("  {:<4} {}\n", exit.code, exit.meaning);
  }
  text.pop_back();
  return text;
}

void describe(CLI::App& program) {
  program.name("conebench");
  program.require_subcommand(1);
  program.set_version_flag("--version", "conebench " + version());
  program.footer(footer());
}

int parse_and_run(CLI::App& program, std::vector<std::string> arguments, const int& exit_code) {
  try {
    check_verbs(program, arguments);
    std::reverse(arguments.begin(), arguments.end());
    program.parse(arguments);
    return exit_code;
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ExtrasError&) {
    return complain(unexpected_argument(program), kUsage);
  } catch (const CLI::ParseError& error) {
    return complain(error.what(), kUsage);
  } catch (const problems::InputError& error) {
    return complain(error.what(), kUsage);
  } catch (const std::exception& error) {
    return complain(error.what(), kInfrastructure);
  }
}

}  // namespace

void set_command_line(const std::vector<std::string>& arguments) {
  std::string line = "conebench";
  for (const std::string& argument : arguments) line += " " + shell_quoted(argument);
  stored_line() = line;
}

std::span<const Example> program_examples() { return kExamples; }
std::span<const ExitCode> program_exit_codes() { return kExitCodes; }

const std::string& command_line() { return stored_line(); }

int run_program(const std::vector<std::string>& arguments) {
  set_command_line(arguments);
  CLI::App program(
      "Compares solvers on the contact problems with friction and cohesion that granular\n"
      "simulations pose at every time step, and tells which solver to use.");
  int exit_code = 0;
  add_verbs(program, exit_code);
  describe(program);  // last: verbs would inherit the footer
  const int code = parse_and_run(program, arguments, exit_code);
  if (std::fflush(stdout) != 0) return complain("stdout: cannot write", kInfrastructure);
  return code;
}

}  // namespace conebench::harness
