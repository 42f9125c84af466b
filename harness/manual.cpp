#include "harness/manual.h"

#include <fmt/format.h>

#include <sstream>

#include "harness/command_line.h"
#include "harness/host.h"
#include "harness/option_kinds.h"

namespace conebench::harness {
namespace {

// Text, none of it read as a request, with the characters of the keyboard.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      case '.':
        out += out.empty() || out.back() == '\n' ? "\\&." : ".";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

// Text whose line ends count.
std::string kept_lines(const std::string& text) {
  std::string out = ".nf\n";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    out += line.empty() ? ".sp\n" : roff(line) + "\n";
  }
  return out + ".fi\n";
}

std::string option_entry(const CLI::Option& option) {
  const CLI::Formatter formatter;
  std::string name;
  for (const std::string& spelling : spellings(option)) {
    name += (name.empty() ? "" : ", ") + bold(spelling);
  }
  if (name.empty()) name = italic(option.get_name(true, false));
  return fmt::format(".TP\n{}{}\n{}\n", name, roff(formatter.make_option_opts(&option)),
                     roff(option.get_description()));
}

std::string usage(const CLI::App& verb, const std::string& name) {
  std::string line = CLI::Formatter().make_usage(&verb, name);
  line = line.substr(line.find(name) + name.size());
  line = line.substr(0, line.find('\n'));
  return bold(name) + roff(line) + "\n";
}

// A verb and those below it.
std::string verb_section(const CLI::App& verb, const std::string& path) {
  std::string text = fmt::format(".SS \"{}\"\n{}.PP\n{}\n", roff(path),
                                 usage(verb, "conebench " + path), roff(verb.get_description()));
  for (const CLI::Option* option : options_of(verb)) text += option_entry(*option);
  if (!verb.get_footer().empty()) text += ".PP\n" + roff(verb.get_footer()) + "\n";
  for (const CLI::App* below : verbs_of(verb)) {
    text += verb_section(*below, path + " " + below->get_name());
  }
  return text;
}

std::string examples() {
  std::string text = ".SH EXAMPLES\n";
  for (const Example& example : program_examples()) {
    text += fmt::format(".TP\n{}\n{}\n", bold(example.command), roff(example.what));
  }
  return text;
}

std::string exit_status() {
  std::string text = ".SH \"EXIT STATUS\"\n";
  for (const ExitCode& exit : program_exit_codes()) {
    text += fmt::format(".TP\n{}\n{}\n", bold(std::to_string(exit.code)), roff(exit.meaning));
  }
  return text;
}

}  // namespace

std::string man_page(const CLI::App& program) {
  std::string text = fmt::format(
      ".TH CONEBENCH 1 \"\" \"conebench {}\" \"User Commands\"\n"
      ".SH NAME\nconebench \\- {}\n.SH SYNOPSIS\n{}.SH DESCRIPTION\n{}",
      roff(version()), "compare solvers on the contact problems of granular simulations",
      usage(program, "conebench"), kept_lines(program.get_description()));
  text += ".PP\nData goes to standard output, everything else to standard error.\n";
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(program)) text += option_entry(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* verb : verbs_of(program)) text += verb_section(*verb, verb->get_name());
  return text + examples() + exit_status();
}

}  // namespace conebench::harness
