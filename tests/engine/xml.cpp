#include "tests/engine/xml.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace conebench::test {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : left_(text), size_(text.size()) {}

  XmlElement file() {
    skip_blanks();
    if (take("<?xml")) {
      const std::size_t end = left_.find("?>");
      require(end != std::string_view::npos, "a declaration has no end");
      left_.remove_prefix(end + 2);
      skip_blanks();
    }
    XmlElement root = element();
    skip_blanks();
    require(left_.empty(), "something stands after the root");
    return root;
  }

 private:
  void require(bool ok, const std::string& what) const {
    if (!ok) throw std::runtime_error("at " + std::to_string(size_ - left_.size()) + ": " + what);
  }

  bool take(std::string_view token) {
    if (!left_.starts_with(token)) return false;
    left_.remove_prefix(token.size());
    return true;
  }

  void skip_blanks() {
    while (!left_.empty() && std::isspace(static_cast<unsigned char>(left_[0]))) {
      left_.remove_prefix(1);
    }
  }

  std::string_view until(std::string_view ends) {
    const std::size_t end = std::min(left_.find_first_of(ends), left_.size());
    const std::string_view taken = left_.substr(0, end);
    left_.remove_prefix(end);
    return taken;
  }

  std::string name() {
    const std::string_view taken = until(" \t\n\r=/><\"&");
    require(!taken.empty(), "expected a name");
    return std::string(taken);
  }

  std::string characters(std::string_view ends) {
    std::string out(until(ends));
    while (take("&")) {
      if (take("lt;"))
        out += '<';
      else if (take("gt;"))
        out += '>';
      else if (take("amp;"))
        out += '&';
      else if (take("quot;"))
        out += '"';
      else
        require(false, "a bare &");
      out += until(ends);
    }
    return out;
  }

  XmlElement element() {
    require(take("<"), "expected a tag");
    XmlElement out;
    out.name = name();
    for (skip_blanks(); !left_.empty() && left_[0] != '>' && left_[0] != '/'; skip_blanks()) {
      const std::string key = name();
      require(take("=\""), "expected =\" after " + key);
      require(out.attributes.emplace(key, characters("\"<&")).second, key + " stands twice");
      require(take("\""), "the value of " + key + " has no end");
    }
    if (take("/>")) return out;
    require(take(">"), "expected the end of the tag " + out.name);
    while (!left_.starts_with("</")) {
      out.text += characters("<&");
      require(!left_.empty(), out.name + " has no end");
      if (!left_.starts_with("</")) out.children.push_back(element());
    }
    require(take("</" + out.name + ">"), "expected the end of " + out.name);
    return out;
  }

  std::string_view left_;
  std::size_t size_;
};

}  // namespace

std::string XmlElement::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view wanted) const {
  std::vector<const XmlElement*> out;
  for (const XmlElement& child : children) {
    if (child.name == wanted) out.push_back(&child);
    for (const XmlElement* inner : child.all(wanted)) out.push_back(inner);
  }
  return out;
}

const XmlElement& XmlElement::find(std::string_view wanted, const std::string& key,
                                   const std::string& value) const {
  for (const XmlElement* element : all(wanted)) {
    if (element->attribute(key) == value) return *element;
  }
  throw std::runtime_error("no " + std::string(wanted) + " with " + key + " = " + value);
}

std::vector<double> numbers_in(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  std::vector<double> out;
  for (double x = 0.0; in >> x;) out.push_back(x);
  if (!in.eof()) throw std::runtime_error("not a number in: " + text.substr(0, 40));
  return out;
}

XmlElement parse_xml(std::string_view text) { return Parser(text).file(); }

}  // namespace conebench::test
