#include "harness/condition.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::harness {
namespace {

using Json = nlohmann::ordered_json;
using problems::InputError;

bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_name_part(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

// kFact and kValue are leaves; kNot has one child, everything else two.
struct Condition::Node {
  enum class Kind {
    kOr,
    kAnd,
    kNot,
    kEqual,
    kUnequal,
    kLess,
    kAtMost,
    kMore,
    kAtLeast,
    kFact,
    kValue
  };

  Kind kind = Kind::kValue;
  std::string name;  // of a fact
  Json value;
  std::unique_ptr<Node> left, right;
};

namespace {

using Node = Condition::Node;
using Kind = Node::Kind;
using Tree = std::unique_ptr<Node>;

Tree branch(Kind kind, Tree left, Tree right = nullptr) {
  auto node = std::make_unique<Node>();
  node->kind = kind;
  node->left = std::move(left);
  node->right = std::move(right);
  return node;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

class Parser {
 public:
  Parser(std::string_view text, const Condition::Terms& terms) : text_(text), terms_(terms) {}

  Tree parse() {
    Tree tree = disjunction();
    skip_space();
    if (at_ < text_.size()) fail("an operator or the end");
    return tree;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    const std::string rest =
        at_ < text_.size() ? "at '" + std::string(text_.substr(at_)) + "'" : "at its end";
    throw InputError(terms_.option, "'" + std::string(text_) + "' is not understood " + rest +
                                        ", expected " + expected);
  }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  bool take(std::string_view token) {
    skip_space();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  // Depth is bounded, so that a hostile expression cannot exhaust the stack.
  Tree disjunction() {
    if (++depth_ > kDeepest) fail("fewer nested parentheses");
    Tree tree = conjunction();
    while (take("||")) tree = branch(Kind::kOr, std::move(tree), conjunction());
    --depth_;
    return tree;
  }

  Tree conjunction() {
    Tree tree = negation();
    while (take("&&")) tree = branch(Kind::kAnd, std::move(tree), negation());
    return tree;
  }

  Tree negation() {
    int count = 0;
    while (take_not()) ++count;
    Tree tree = comparison();
    return count % 2 == 0 ? std::move(tree) : branch(Kind::kNot, std::move(tree));
  }

  bool take_not() {
    skip_space();
    return !text_.substr(at_).starts_with("!=") && take("!");
  }

  Tree comparison() {
    if (take("(")) {
      Tree tree = disjunction();
      if (!take(")")) fail("')'");
      return tree;
    }
    Tree left = operand();
    static constexpr std::pair<std::string_view, Kind> kOperators[] = {
        {"==", Kind::kEqual},   {"!=", Kind::kUnequal}, {"<=", Kind::kAtMost},
        {">=", Kind::kAtLeast}, {"<", Kind::kLess},     {">", Kind::kMore}};
    for (const auto& [token, kind] : kOperators) {
      if (take(token)) return branch(kind, std::move(left), operand());
    }
    return left;
  }

  std::string an_operand() const { return "a " + terms_.noun + ", a number or a text in quotes"; }

  Tree operand() {
    skip_space();
    if (at_ == text_.size()) fail(an_operand());
    const char first = text_[at_];
    if (first == '"' || first == '\'') return quoted(first);
    if (is_name_start(first)) return name();
    return number();
  }

  Tree quoted(char quote) {
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("a closing quote");
    Tree node = value(std::string(text_.substr(at_ + 1, end - at_ - 1)));
    at_ = end + 1;
    return node;
  }

  std::string word() {
    const std::size_t first = at_;
    while (at_ < text_.size() && is_name_part(text_[at_])) ++at_;
    return std::string(text_.substr(first, at_ - first));
  }

  Tree name() {
    const std::size_t first = at_;
    std::string name = word();
    if (name == "true" || name == "false") return value(name == "true");
    if (take("(")) {
      skip_space();
      name += "(" + word() + ")";
      if (!take(")")) fail("')'");
    }
    const bool known = terms_.names.empty() || std::ranges::count(terms_.names, name) > 0;
    if (!known) {
      at_ = first;
      fail("a " + terms_.noun + problems::suggestion(name, terms_.names) +
           "; known: " + joined(terms_.names));
    }
    auto node = std::make_unique<Node>();
    node->kind = Kind::kFact;
    node->name = name;
    return node;
  }

  Tree number() {
    double parsed = 0.0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, parsed);
    if (error != std::errc()) fail(an_operand());
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value(parsed);
  }

  static Tree value(Json json) {
    auto node = std::make_unique<Node>();
    node->value = std::move(json);
    return node;
  }

  static constexpr int kDeepest = 100;

  std::string_view text_;
  const Condition::Terms& terms_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

class Evaluation {
 public:
  Evaluation(const Condition::Terms& terms, const Json& facts) : terms_(terms), facts_(facts) {}

  bool operator()(const Node& node) const {
    switch (node.kind) {
      case Kind::kOr:
        return (*this)(*node.left) || (*this)(*node.right);
      case Kind::kAnd:
        return (*this)(*node.left) && (*this)(*node.right);
      case Kind::kNot:
        return !(*this)(*node.left);
      case Kind::kFact:
      case Kind::kValue: {
        const Json& value = leaf(node);
        if (value.is_boolean()) return value.get<bool>();
        throw InputError(terms_.option,
                         value.dump() + " is neither true nor false, expected a comparison");
      }
      default:
        return compare(node.kind, leaf(*node.left), leaf(*node.right));
    }
  }

 private:
  const Json& leaf(const Node& node) const {
    if (node.kind == Kind::kValue) return node.value;
    const auto found = facts_.find(node.name);
    if (found != facts_.end()) return *found;
    std::vector<std::string> known;
    for (const auto& [key, value] : facts_.items()) known.push_back(key);
    throw InputError(terms_.option, "'" + node.name + "' is no " + terms_.noun +
                                        problems::suggestion(node.name, known));
  }

  bool compare(Kind kind, const Json& left, const Json& right) const {
    if (left.is_null() || right.is_null()) return kind == Kind::kUnequal;
    if (left.is_number() && right.is_number()) {
      return compare_numbers(kind, left.get<double>(), right.get<double>());
    }
    const bool comparable = left.type() == right.type() && (left.is_string() || left.is_boolean());
    if (!comparable || (kind != Kind::kEqual && kind != Kind::kUnequal)) {
      throw InputError(terms_.option, left.dump() + " and " + right.dump() +
                                          " do not compare that way, expected two numbers, or == "
                                          "or != between two texts");
    }
    return (left == right) == (kind == Kind::kEqual);
  }

  static bool compare_numbers(Kind kind, double a, double b) {
    switch (kind) {
      case Kind::kEqual:
        return a == b;
      case Kind::kUnequal:
        return a != b;
      case Kind::kLess:
        return a < b;
      case Kind::kAtMost:
        return a <= b;
      case Kind::kMore:
        return a > b;
      default:
        return a >= b;
    }
  }

  const Condition::Terms& terms_;
  const Json& facts_;
};

}  // namespace

Condition::Condition(std::string_view expression, Terms terms)
    : terms_(std::move(terms)), root_(Parser(expression, terms_).parse()) {}
Condition::~Condition() = default;
Condition::Condition(Condition&&) noexcept = default;

bool Condition::matches(const Json& facts) const { return Evaluation(terms_, facts)(*root_); }

}  // namespace conebench::harness
