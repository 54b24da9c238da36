#pragma once

#include <string>

#include "io/text/cut_report.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::app {

/// What `polynya cut` reports on stderr.

/// A line for each polygon that was rejected or repaired and each part of a line that separates nothing, as
/// "floes.geojson:3: feature 1, polygon 0: …"; past the hundredth they are only counted.
void report_floes(const std::string& name, const io::CutReport& report);
void report_totals(const io::CutReport& report);
/// What of the text is not in the pieces.
void report_losses(const std::string& name, const io::FloeText& floes, io::FloeFormat format);

}  // namespace polynya::app
