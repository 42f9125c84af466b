#include "harness/where.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::harness {
namespace {

using Json = nlohmann::ordered_json;
using problems::InputError;

constexpr const char* kSubject = "--where";

bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_name_part(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

// kFact and kValue are leaves; kNot has one child, everything else two.
struct Where::Node {
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

using Node = Where::Node;
using Kind = Node::Kind;
using Tree = std::unique_ptr<Node>;

Tree branch(Kind kind, Tree left, Tree right = nullptr) {
  auto node = std::make_unique<Node>();
  node->kind = kind;
  node->left = std::move(left);
  node->right = std::move(right);
  return node;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

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
    throw InputError(kSubject, "'" + std::string(text_) + "' is not understood " + rest +
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

  Tree operand() {
    skip_space();
    if (at_ == text_.size()) fail("a fact, a number or a text in quotes");
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

  Tree name() {
    const std::size_t first = at_;
    while (at_ < text_.size() && is_name_part(text_[at_])) ++at_;
    const std::string word(text_.substr(first, at_ - first));
    if (word == "true" || word == "false") return value(word == "true");
    auto node = std::make_unique<Node>();
    node->kind = Kind::kFact;
    node->name = word;
    return node;
  }

  Tree number() {
    double parsed = 0.0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, parsed);
    if (error != std::errc()) fail("a fact, a number or a text in quotes");
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
  std::size_t at_ = 0;
  int depth_ = 0;
};

const Json& evaluate_leaf(const Node& node, const Json& facts) {
  if (node.kind == Kind::kValue) return node.value;
  const auto found = facts.find(node.name);
  if (found != facts.end()) return *found;
  std::vector<std::string> known;
  for (const auto& [key, value] : facts.items()) known.push_back(key);
  throw InputError(kSubject, "'" + node.name + "' is no fact of a problem" +
                                 problems::suggestion(node.name, known));
}

bool compare(Kind kind, const Json& left, const Json& right) {
  if (left.is_null() || right.is_null()) return kind == Kind::kUnequal;
  if (left.is_number() && right.is_number()) {
    const double a = left.get<double>(), b = right.get<double>();
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
  const bool comparable = left.type() == right.type() && (left.is_string() || left.is_boolean());
  if (!comparable || (kind != Kind::kEqual && kind != Kind::kUnequal)) {
    throw InputError(kSubject, left.dump() + " and " + right.dump() +
                                   " do not compare that way, expected two numbers, or == or != "
                                   "between two texts");
  }
  return (left == right) == (kind == Kind::kEqual);
}

bool evaluate(const Node& node, const Json& facts) {
  switch (node.kind) {
    case Kind::kOr:
      return evaluate(*node.left, facts) || evaluate(*node.right, facts);
    case Kind::kAnd:
      return evaluate(*node.left, facts) && evaluate(*node.right, facts);
    case Kind::kNot:
      return !evaluate(*node.left, facts);
    case Kind::kFact:
    case Kind::kValue: {
      const Json& value = evaluate_leaf(node, facts);
      if (value.is_boolean()) return value.get<bool>();
      throw InputError(kSubject,
                       value.dump() + " is neither true nor false, expected a comparison");
    }
    default:
      return compare(node.kind, evaluate_leaf(*node.left, facts),
                     evaluate_leaf(*node.right, facts));
  }
}

}  // namespace

Where::Where(std::string_view expression) : root_(Parser(expression).parse()) {}
Where::~Where() = default;
Where::Where(Where&&) noexcept = default;

bool Where::matches(const Json& facts) const { return evaluate(*root_, facts); }

}  // namespace conebench::harness
