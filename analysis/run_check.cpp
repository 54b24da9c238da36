#include "analysis/run_check.hpp"

#include <cmath>
#include <memory>

#include "analysis/overlap_check.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::analysis {
namespace {

using geometry::Polygon;
using simulation::FloeId;

void see(Worst& worst, double value, double scale, FloeId floe) {
  if (!(std::abs(value) <= std::abs(worst.value))) {
    worst.value = value;
    worst.floe = floe;
  }
  if (!(std::abs(value) <= kAreaTolerance * scale)) ++worst.wrong;
}

void check_shapes(const io::Run& run, RunCheck& check) {
  for (const io::RunFloe& floe : run.floes) {
    ++check.shapes;
    const simulation::BirthRecord& birth = floe.birth;
    const auto polygon = run.shape(birth.floe);
    if (const auto found = geometry::find_defect(*polygon)) {
      check.invalid.push_back({birth.floe, std::string(name_of(found->defect)), found->places});
    }
    const Polygon* const ring[]{polygon.get()};
    const double recorded[]{birth.area};
    see(check.recorded_area, geometry::exact_balance({}, ring, recorded), birth.area, birth.floe);
  }
}

void check_fracture(const io::Run& run, const simulation::Event& event, RunCheck& check) {
  ++check.fractures;
  std::vector<FloeId> children;
  const auto parent = run.shape(event.floe);
  std::vector<std::shared_ptr<const Polygon>> pieces;
  std::vector<const Polygon*> after;
  for (const FloeId child : event.children) {
    if (!run.floe(child)) continue;
    children.push_back(child);
    pieces.push_back(run.shape(child));
    after.push_back(pieces.back().get());
  }
  const double before = run.floe(event.floe)->birth.area;
  const Polygon* const parents[]{parent.get()};
  const double terms[]{event.submerged_area, event.under_ice_area, event.brash_area, -event.rounding_defect};
  see(check.balance, geometry::exact_balance(after, parents, terms), before, event.floe);
  for (std::size_t i = 0; i < children.size(); ++i) {
    for (std::size_t j = i + 1; j < children.size(); ++j) {
      const auto shared = shared_area(*pieces[i], {}, *pieces[j], {});
      if (!shared) ++check.undecided;
      if (shared && *shared > kAreaTolerance * before) ++check.overlapping_siblings;
      if (shared && *shared > check.siblings.area)
        check.siblings = {children[i], children[j], event.time, *shared, 0};
    }
  }
}

}  // namespace

RunCheck check_run(const io::Run& run, std::optional<double> only_at) {
  RunCheck check;
  check_shapes(run, check);
  for (const simulation::Event& event : run.events) {
    if (event.kind != simulation::EventKind::kRejectedCut && event.kind != simulation::EventKind::kSubmerge)
      check_fracture(run, event, check);
  }
  check.has_crushed = run.has_crushed;
  OverlapCheck overlaps(run, check);
  if (only_at) {
    overlaps.measure(*only_at);
  } else {
    for (const io::Frame& frame : run.frames) overlaps.measure(frame.time);
  }
  return check;
}

}  // namespace polynya::analysis
