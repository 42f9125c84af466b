#pragma once

#include <optional>
#include <string_view>

namespace conebench::results {

/// The page's program, bundled from report/web when this was built.
struct PageFiles {
  std::string_view style;
  std::string_view script;  ///< plots, table
  std::string_view view;    ///< the 3D view, which only a page with views carries
};

/// Nothing in a build without the page (CONEBENCH_REPORT_PAGE).
std::optional<PageFiles> page_files();

}  // namespace conebench::results
