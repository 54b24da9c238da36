#include "io/text/cut.hpp"

#include <string>

#include "python/module/simulation.hpp"

namespace polynya::python {
namespace {

std::optional<geometry::FillRule> rule_of(const std::string& repair) {
  if (repair.empty()) return {};
  if (repair == "even-odd") return geometry::FillRule::kEvenOdd;
  if (repair == "non-zero") return geometry::FillRule::kNonZero;
  throw py::value_error("cut: repair is " + repair + ", allowed: None, even-odd, non-zero");
}

/// Cuts floes given as GeoJSON. `ops` are the cuts in the format of `polynya cut --ops`. Returns the pieces as GeoJSON
/// and the ledger as JSON.
py::tuple cut(const std::string& floes, const std::string& ops, const std::string& repair) {
  const std::optional<geometry::FillRule> rule = rule_of(repair);
  std::string pieces, ledger, reason;
  {
    const py::gil_scoped_release release;
    const auto text = io::read_floe_text(floes);
    auto cuts = io::read_cut_ops(ops, {io::Keep::kBoth, 0});
    if (!text) {
      reason = text.error();
    } else if (!cuts) {
      reason = cuts.error().words;
    } else {
      const io::CutReport report = io::cut_floes(text->entries, *std::move(cuts), rule);
      pieces = io::to_floe_text(report, io::FloeFormat::kGeojson);
      ledger = io::to_ledger_json(report);
    }
  }
  if (!reason.empty()) throw py::value_error("cut: " + reason);
  return py::make_tuple(pieces, ledger);
}

}  // namespace

void bind_cut(py::module_& module) {
  module.def("cut_geojson", &cut, py::arg("floes"), py::arg("ops"), py::arg("repair") = "",
             "cut_geojson(floes, ops, repair='')\n\n"
             "The pieces as GeoJSON and the ledger as JSON, of floes as GeoJSON and cuts as `polynya cut "
             "--ops`\nreads them (docs/cut.md). polynya.cut takes numpy rings and shapes.");
}

}  // namespace polynya::python
