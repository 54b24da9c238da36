#include "analysis/run_check.hpp"

#include <algorithm>
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

void check_shape(const io::Run& run, const simulation::BirthRecord& birth, RunCheck& check) {
  ++check.shapes;
  const auto polygon = run.shape(birth.floe);
  if (const auto found = geometry::find_defect(*polygon))
    check.invalid.push_back({birth.floe, std::string(name_of(found->defect)), found->places});
  const Polygon* const ring[]{polygon.get()};
  const double recorded[]{birth.area};
  see(check.recorded_area, geometry::exact_balance({}, ring, recorded), birth.area, birth.floe);
}

void check_fracture(const io::Run& run, const simulation::Event& event, RunCheck& check) {
  const simulation::IceEvent& ice = *event.ice();
  const auto* stays = std::get_if<simulation::StayUnder>(&event.what);
  const double under_ice = stays ? stays->under_ice_area : 0;
  ++check.fractures;
  std::vector<FloeId> children;
  const auto parent = run.shape(ice.floe);
  std::vector<std::shared_ptr<const Polygon>> pieces;
  std::vector<const Polygon*> after;
  for (const FloeId child : ice.children) {
    if (!run.floe(child)) continue;
    children.push_back(child);
    pieces.push_back(run.shape(child));
    after.push_back(pieces.back().get());
  }
  const double before = run.floe(ice.floe)->birth.area;
  const Polygon* const parents[]{parent.get()};
  const double terms[]{ice.submerged_area, under_ice, ice.brash_area, -ice.rounding_defect};
  see(check.balance, geometry::exact_balance(after, parents, terms), before, ice.floe);
  for (std::size_t i = 0; i < children.size(); ++i) {
    for (std::size_t j = i + 1; j < children.size(); ++j) {
      const auto shared = shared_area(*pieces[i], {}, *pieces[j], {});
      if (!shared) ++check.undecided;
      if (shared && *shared > kAreaTolerance * before) ++check.overlapping_siblings;
      if (shared && *shared > check.siblings.area) check.siblings = {children[i], children[j], event.time, *shared, 0};
    }
  }
}

}  // namespace

RunCheck check_run(const io::Run& run, std::optional<double> only_at, const std::function<void(double)>& on_part) {
  RunCheck check;
  check.has_crushed = run.has_crushed;
  const std::size_t instants = only_at ? 1 : run.frames.size();
  // An instant takes about as long as an eighth of the shapes: most pairs have not moved.
  const double all = static_cast<double>(run.floes.size()) * (1 + static_cast<double>(instants) / 8) +
                     static_cast<double>(run.events.size());
  double done = 0;
  const auto advance = [&](double work) {
    done += work;
    if (on_part && all > 0) on_part(std::min(1.0, done / all));
  };
  for (const io::RunFloe& floe : run.floes) {
    check_shape(run, floe.birth, check);
    advance(1);
  }
  for (const simulation::Event& event : run.events) {
    if (event.ends_floe()) check_fracture(run, event, check);
    advance(1);
  }
  OverlapCheck overlaps(run, check);
  for (std::size_t i = 0; i < instants; ++i) {
    overlaps.measure(only_at ? *only_at : run.frames[i].time);
    advance(static_cast<double>(run.floes.size()) / 8);
  }
  return check;
}

}  // namespace polynya::analysis
