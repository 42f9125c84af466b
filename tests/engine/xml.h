#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::test {

/// An element of a file in XML, as far as our files go: no entities but those that stand for one
/// character, no comments, no namespaces.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< of all that stands between the tags, without the children's
  std::vector<XmlElement> children;

  /// The attribute, or "" without it.
  std::string attribute(const std::string& key) const;
  /// All elements of that name inside, at any depth, in the order of the file.
  std::vector<const XmlElement*> all(std::string_view wanted) const;
  /// The first of them whose `key` is `value`. Throws std::runtime_error when there is none.
  const XmlElement& find(std::string_view wanted, const std::string& key,
                         const std::string& value) const;
};

/// The numbers of a text, between blanks and commas. Throws std::runtime_error at anything else.
std::vector<double> numbers_in(std::string text);

/// The root of a file. Throws std::runtime_error naming the place where it is not well-formed: tags
/// that do not match, attributes without quotes or twice, a bare < or &, more than one root.
XmlElement parse_xml(std::string_view text);

}  // namespace conebench::test
