#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/repair.hpp"
#include "io/text/cut_report.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::app {

/// Cuts every floe by all cuts in order. A polygon that is not valid is refused, or repaired where a rule is
/// given; a floe that a cut does not meet stays whole; a floe that geometry fails to cut stays as it was
/// before that cut.
io::CutReport cut_floes(const std::vector<io::FloeEntry>& entries, std::vector<io::CutOp> ops,
                        std::optional<geometry::FillRule> repair_rule);

}  // namespace polynya::app
