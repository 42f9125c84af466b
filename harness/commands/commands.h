#pragma once

#include <CLI/CLI.hpp>

namespace conebench::harness {

/// Each function adds one verb to the program. Its callback does the work after parsing and may
/// set `exit_code`; errors are thrown (problems::InputError: 2, problems::OutputError: 3) and
/// turned into one line on stderr by main(). Data goes to stdout, everything else to stderr.
void add_problem(CLI::App& app,
                 int& exit_code);               // list|show|verify|import|export|index|stats|shrink
void add_scene(CLI::App& app, int& exit_code);  // list|show
void add_simulate(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_solver(CLI::App& app, int& exit_code);  // list|show|reference|check|new
void add_solve(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_advise(CLI::App& app, int& exit_code);
void add_study(CLI::App& app, int& exit_code);
void add_demo(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);

}  // namespace conebench::harness
