#include "results/html_text.h"

#include <fmt/format.h>

#include <vector>

#include "results/svg_plot.h"

namespace conebench::results {
namespace {

// Markup that opens and closes with the same mark, longest first.
struct Mark {
  std::string_view mark, element;
};
constexpr Mark kMarks[] = {{"`", "code"}, {"**", "strong"}, {"*", "em"}};

// The element that starts at `at`, with its end; nothing where the mark is never closed.
struct Marked {
  const Mark* mark = nullptr;
  std::size_t end = 0;  // of the text inside
};

Marked marked_at(std::string_view text, std::size_t at) {
  for (const Mark& mark : kMarks) {
    if (!text.substr(at).starts_with(mark.mark)) continue;
    const std::size_t end = text.find(mark.mark, at + mark.mark.size());
    if (end != std::string_view::npos) return {&mark, end};
  }
  return {};
}

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

std::string list(std::string_view items) {
  std::string html = "<ul>\n";
  for (std::string_view item : split(items, "\n")) {
    if (item.starts_with("- ")) item.remove_prefix(2);
    if (!item.empty()) html += "<li>" + html_inline(item) + "</li>\n";
  }
  return html + "</ul>\n";
}

std::string body(const Block& block) {
  std::string html;
  for (const TextTable& table : block.tables) html += html_table(table);
  return html + html_paragraphs(block.text);
}

}  // namespace

std::string html_inline(std::string_view text) {
  std::string html;
  std::size_t plain = 0;  // start of what is not written yet
  for (std::size_t at = 0; at < text.size();) {
    const Marked found = marked_at(text, at);
    if (!found.mark) {
      ++at;
      continue;
    }
    const std::size_t inside = at + found.mark->mark.size();
    const std::string_view content = text.substr(inside, found.end - inside);
    html += escaped(text.substr(plain, at - plain));
    html += fmt::format("<{0}>{1}</{0}>", found.mark->element,
                        found.mark->mark == "`" ? escaped(content) : html_inline(content));
    at = plain = found.end + found.mark->mark.size();
  }
  return html + escaped(text.substr(plain));
}

std::string html_paragraphs(std::string_view text) {
  std::string html;
  if (text.empty()) return html;
  for (const std::string_view part : split(text, "\n\n")) {
    html += part.starts_with("- ") ? list(part) : "<p>" + html_inline(part) + "</p>\n";
  }
  return html;
}

std::string html_table(const TextTable& table) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\" role=\"group\"><table>\n";
  const auto& rows = table.rows();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r < 2) html += r == 0 ? "<thead>" : "<tbody>";
    html += "<tr>";
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const char* element = r == 0 ? "th scope=\"col\"" : c == 0 ? "th scope=\"row\"" : "td";
      html += fmt::format("<{}>{}</{:.2}>", element, html_inline(rows[r][c]), element);
    }
    html += r == 0 ? "</tr></thead>\n" : "</tr>\n";
  }
  return html + (rows.size() > 1 ? "</tbody></table></div>\n" : "</table></div>\n");
}

std::string html_block(const Block& block) {
  if (block.empty()) return {};
  return fmt::format("<h3>{}</h3>\n", html_inline(block.title)) + body(block);
}

std::string html_folded(const Block& block) {
  if (block.empty()) return {};
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", html_inline(block.title),
                     body(block));
}

}  // namespace conebench::results
