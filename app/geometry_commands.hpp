#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "geometry/cut/repair.hpp"
#include "io/text/cut_ops.hpp"

namespace polynya::app {

/// The subcommands that look at and work on shapes. As in commands.hpp.

struct CutOptions {
  std::string floes;                            ///< a file, or "-" for stdin; so are the other files
  std::string disc, crack, line, polygon, ops;  ///< the one that is given; the others empty
  io::Keep keep = io::Keep::kOutside;
  double sagitta = 0;  ///< [m]; 0: by the radius
  std::string out;     ///< empty: none, or stdout where the ledger goes to a file
  std::string ledger;  ///< empty: stdout, unless the pieces go there
  std::optional<geometry::FillRule> repair;
};
int cut(const CutOptions& options);

enum class ShapeFormat { kWkt, kGeojson, kSvg };

struct InspectOptions {
  std::string run;
  std::optional<double> at;          ///< [s]; the end of the run if not given
  std::optional<std::int64_t> floe;  ///< its shape
  ShapeFormat format = ShapeFormat::kWkt;
  std::optional<std::int64_t> lineage;  ///< the fractures that led to it
  bool check = false;
  bool fsd = false;
  bool json = false;  ///< the report as JSON; a floe's shape has its own formats
};
int inspect(const InspectOptions& options);

}  // namespace polynya::app
