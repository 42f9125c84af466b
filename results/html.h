#pragma once

#include <string>

#include "results/page_files.h"
#include "results/report.h"

namespace conebench::results {

/// The report as one HTML file that needs nothing else: no network (its Content-Security-Policy
/// forbids everything but its own script and style, by their hashes), no server (file:// will do)
/// and no script to be read. Words, tables and plots as SVG are in it as they stand; the script
/// replaces the plots by ones that answer to mouse and keys, and adds the table of all problems and
/// the 3D view, from data that lie packed at its end.
std::string html_report(const ReportInput& input, const PageFiles& files);

}  // namespace conebench::results
