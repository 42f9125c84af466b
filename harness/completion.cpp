#include "harness/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/option_kinds.h"

namespace conebench::harness {
namespace {

// In the table a value is a list of words to offer; @... are lists of their own, + is "any number".
constexpr std::string_view kScript = R"script(
_conebench_words() {  # LIST BEGINNING
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$2")
}

_conebench_files() {  # BEGINNING PREFIX ARGUMENTS_OF_COMPGEN...
  local file beginning=$1 prefix=$2
  compopt -o filenames 2>/dev/null
  while IFS= read -r file; do
    COMPREPLY+=("$prefix$file")
  done < <(compgen "${@:3}" -- "$beginning")
}

_conebench_offer() {  # VALUE BEGINNING
  local token
  local -a tokens
  read -ra tokens <<<"$1"
  for token in "${tokens[@]}"; do
    case $token in
      @solver)
        case $2 in
          plugin:* | exec:*) _conebench_files "${2#*:}" "${2%%:*}:" -f ;;
          *) _conebench_words "$_conebench_solvers plugin: exec:" "$2" ;;
        esac
        ;;
      @scene)
        _conebench_words "$_conebench_scenes" "$2"
        _conebench_files "$2" '' -f -X '!*.toml'
        _conebench_files "$2" '' -d
        ;;
      @file) _conebench_files "$2" '' -f ;;
      @folder) _conebench_files "$2" '' -d ;;
      + | -) ;;
      *) _conebench_words "$token" "$2" ;;
    esac
  done
}

# Reads the words before the one in question: which verb, which option's value, which argument.
_conebench_read() {
  local word
  for word in "$@"; do
    if [[ $word == -* ]]; then
      value=${values[${word%%=*}]-}
      [[ $word == *=* && $value != *' +' ]] && value=''
    elif [[ -n $value ]]; then
      [[ $value == *' +' ]] || value=''
    elif [[ " $verbs " == *" $word "* ]]; then
      verb+="${verb:+ }$word"
      _conebench_verb "$verb"
    else
      ((given += 1))
    fi
  done
}

_conebench() {
  local line=${COMP_LINE:0:COMP_POINT}
  local -a words=() arguments=()
  local -A values=()
  local verb='' verbs='' options='' value='' given=0
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=('')
  local current=${words[-1]}
  COMPREPLY=()
  _conebench_verb ''
  _conebench_read "${words[@]:1:${#words[@]}-2}"
  if [[ $current == --*=* ]]; then
    _conebench_offer "${values[${current%%=*}]-}" "${current#*=}"
    COMPREPLY=("${COMPREPLY[@]/#/${current%%=*}=}")
  elif [[ $current == -* ]]; then
    _conebench_words "$options" "$current"
  elif [[ -n $value ]]; then
    _conebench_offer "$value" "$current"
  elif [[ -n $verbs ]]; then
    _conebench_words "$verbs" "$current"
  elif ((${#arguments[@]} > 0)); then
    local last=$((${#arguments[@]} - 1))
    ((given > last)) && [[ ${arguments[last]} == *' +' ]] && given=$last
    _conebench_offer "${arguments[given]-}" "$current"
  fi
  # bash puts a reply in the place of what follows the last colon or equals sign.
  local sign head='' part
  for sign in : =; do
    if [[ ${COMP_WORDBREAKS-} == *"$sign"* && $current == *"$sign"* ]]; then
      part=${current%"${current##*"$sign"}"}
      ((${#part} > ${#head})) && head=$part
    fi
  done
  COMPREPLY=("${COMPREPLY[@]#"$head"}")
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}

complete -F _conebench conebench
)script";

std::string value_text(const CLI::Option& option) {
  const ValueKind kind = value_kind(option);
  std::vector<std::string> tokens = kind.words;
  if (kind.solver) tokens.emplace_back("@solver");
  if (kind.scene) tokens.emplace_back("@scene");
  if (kind.file) tokens.emplace_back("@file");
  if (kind.folder) tokens.emplace_back("@folder");
  if (tokens.empty()) tokens.emplace_back("-");
  if (kind.many) tokens.emplace_back("+");
  return fmt::format("{}", fmt::join(tokens, " "));
}

// One case of the table, and those of the verbs below.
std::string cases(const CLI::App& verb, const std::string& path) {
  std::vector<std::string> verbs, options, values, arguments;
  for (const CLI::App* below : verbs_of(verb)) verbs.push_back(below->get_name());
  for (const CLI::Option* option : options_of(verb)) {
    const std::vector<std::string> names = spellings(*option);
    options.insert(options.end(), names.begin(), names.end());
    if (!takes_value(*option)) continue;
    const std::string value = value_text(*option);
    if (names.empty()) arguments.push_back("'" + value + "'");
    for (const std::string& name : names) values.push_back(fmt::format("[{}]='{}'", name, value));
  }
  std::string text = fmt::format(
      "    '{}')\n      verbs='{}'\n      options='{}'\n      values=({})\n      arguments=({})\n"
      "      ;;\n",
      path, fmt::join(verbs, " "), fmt::join(options, " "), fmt::join(values, " "),
      fmt::join(arguments, " "));
  for (const CLI::App* below : verbs_of(verb)) {
    text += cases(*below, path + (path.empty() ? "" : " ") + below->get_name());
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& program, const CompletionNames& names) {
  return fmt::format(
      "# bash completion for conebench, as `conebench completion` prints it\n\n"
      "_conebench_solvers='{}'\n_conebench_scenes='{}'\n\n"
      "# Sets verbs, options, values and arguments to those of one verb.\n"
      "_conebench_verb() {{\n  case $1 in\n{}  esac\n}}\n{}",
      fmt::join(names.solvers, " "), fmt::join(names.scenes, " "), cases(program, ""), kScript);
}

}  // namespace conebench::harness
