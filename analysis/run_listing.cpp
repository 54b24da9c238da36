#include "analysis/run_listing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::analysis {

std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes) {
  std::vector<SizeClass> classes;
  if (floes.empty()) return classes;
  const auto edge = [](int number) {  // limits …, 1, 2, 5, 10, 20, 50, …
    static constexpr double kSteps[] = {1, 2, 5};
    const int decade = static_cast<int>(std::floor(number / 3.0));
    return kSteps[number - 3 * decade] * std::pow(10.0, decade);
  };
  int number = 3 * static_cast<int>(std::floor(std::log10(floes.front().size))) - 1;
  while (edge(number + 1) <= floes.front().size) ++number;
  for (std::size_t i = 0; i < floes.size(); ++number) {
    SizeClass one{.from = edge(number), .below = edge(number + 1), .from_on = floes.size() - i};
    for (; i < floes.size() && floes[i].size < one.below; ++i, ++one.count) one.area += floes[i].area;
    classes.push_back(one);
  }
  return classes;
}

namespace {

using io::counted;
using io::id_or_none;
using io::JsonValue;
using io::JsonWriter;
using simulation::FloeId;

/// Describes an event in one line: its kind, position and rule.
std::string described(const io::Run& run, const simulation::Event& event) {
  const std::string_view ship = io::hull_name(run.scene.scene, event.ship);
  const bool is_by_floe = event.ice() && event.ice()->by_floe != simulation::kNoFloe;
  const std::string by = is_by_floe     ? fmt::format(" by floe {}", event.ice()->by_floe)
                         : ship.empty() ? ""
                                        : fmt::format(" {} {}", event.ice() ? "by" : "of", ship);
  return fmt::format("{:.6g} s  {}{} at ({:.3f}, {:.3f}): {}", event.time, name_of(event), by, event.point_in_world.x,
                     event.point_in_world.y, io::words_of(event, run.scene.scene));
}

/// Returns a line of events.ndjson without its line break.
std::string json_of(const io::Run& run, const simulation::Event& event) {
  const io::RunFloe* floe = event.ice() ? run.floe(event.ice()->floe) : nullptr;
  std::string line;
  io::append_event(line, event, run.scene.scene, floe ? floe->birth.parent : simulation::kNoFloe);
  line.pop_back();
  return line;
}

/// Sorts events by time. Events at the same time keep their order in events.ndjson.
std::vector<simulation::Event> in_order(std::vector<simulation::Event> events) {
  std::ranges::stable_sort(events, {}, &simulation::Event::time);
  return events;
}

/// A floe that exists at some time.
struct FloeRow {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  double perimeter = 0;  ///< [m]
  std::size_t vertices = 0;
  std::size_t holes = 0;
  std::optional<double> speed;  ///< [m/s]; none if it existed only between two frames
  std::string_view validity;    ///< "yes" or the name of the fault
};

std::vector<FloeRow> floe_rows(const io::Run& run, double time) {
  const io::MotionIndex motions(run);
  std::vector<FloeRow> rows;
  for (const io::RunFloe& floe : run.floes) {
    const simulation::BirthRecord& birth = floe.birth;
    if (!run.is_alive(birth.floe, time)) continue;
    const auto polygon = run.shape(birth.floe);
    const auto found = find_defect(*polygon);
    FloeRow& row = rows.emplace_back(FloeRow{.birth = birth,
                                             .ice = ice_of(run.scene.scene, birth.own_ice),
                                             .perimeter = perimeter(*polygon),
                                             .vertices = vertex_count(*polygon),
                                             .holes = polygon->holes.size(),
                                             .speed = {},
                                             .validity = found ? name_of(found->defect) : "yes"});
    if (const auto motion = motions.floe_at(birth.floe, time)) row.speed = length(motion->velocity);
  }
  return rows;
}

struct SizeDistribution {
  std::size_t count = 0;
  std::size_t without_size = 0;  ///< number of floes left out because their recorded area is not a positive number
  double area = 0;               ///< total area [m²]
  double least = 0, median = 0, largest = 0;  ///< [m]
  std::vector<SizeClass> classes;
};

SizeDistribution size_distribution(const io::Run& run, double time) {
  std::vector<SizedFloe> floes;
  SizeDistribution sizes;
  for (const io::RunFloe& floe : run.floes) {
    if (!run.is_alive(floe.birth.floe, time)) continue;
    const double area = floe.birth.area;
    if (std::isnormal(area) && area > 0)
      floes.push_back({std::sqrt(area), area});
    else
      ++sizes.without_size;
  }
  std::ranges::sort(floes, {}, &SizedFloe::area);
  sizes.count = floes.size();
  if (floes.empty()) return sizes;
  for (const SizedFloe& floe : floes) sizes.area += floe.area;
  sizes.least = floes.front().size;
  sizes.median = floes[floes.size() / 2].size;
  sizes.largest = floes.back().size;
  sizes.classes = size_classes(floes);
  return sizes;
}

/// Returns a force with a unit, "-1.89 MN".
std::string with_unit(double newtons) {
  const double size = std::abs(newtons);
  return size >= 1e6   ? fmt::format("{:.4g} MN", newtons / 1e6)
         : size >= 1e3 ? fmt::format("{:.4g} kN", newtons / 1e3)
                       : fmt::format("{:.4g} N", newtons);
}

std::string with_time(const io::Peak& peak) {
  if (peak.value == 0) return "0 N";
  return fmt::format("{} at {:.6g} s", with_unit(peak.value), peak.time);
}

/// Says how a peak in that column is measured.
std::string measure_of(const io::ForceColumn& column, const simulation::Scene& scene) {
  if (column.curve == "paper") return "j/τ_c of the paper";
  return column.over == io::Over::kMean ? fmt::format("mean over {:.6g} s", recording_interval(scene))
                                        : "single step; depends on the step";
}

/// Returns a line with the largest peak of the force of one contact with ice.
std::string contact_peak_line(const io::ShipPeaks& peaks, const simulation::Scene& scene) {
  if (peaks.of_contact.value == 0) return "";
  const double response = scene.record.peak_response;
  return fmt::format(
      "ice peak    {}: {} (largest of one contact, {})\n", peaks.ship, with_time(peaks.of_contact),
      response > 0 ? fmt::format("by a gauge of {:g} s", response) : "in a single step; depends on the step");
}

/// Returns the largest loads on each ship and structure (docs/theory/forces.md): first by ice, then by other ships and
/// structures, last the numbers of the paper.
std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const std::vector<const io::ForceColumn*> columns = io::peak_columns(scene);
  for (const io::ShipPeaks& peaks : summary.peaks) {
    bool is_free = true;
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const bool is_by_ice = columns[i]->plot == "Surge force of the ice";
      if (!is_by_ice && columns[i]->plot != "Surge force of ships") continue;
      const io::Peak& surge = peaks.of_column[i];
      const io::Peak& sway = peaks.of_column[i + 1];
      if (surge.value == 0 && sway.value == 0) continue;
      if (columns[i]->name == "surge_max_N") text += contact_peak_line(peaks, scene);
      is_free = false;
      text += fmt::format("{:<12}{}: surge {}, sway {} (largest {})\n", is_by_ice ? "ice force" : "ship force",
                          peaks.ship, with_time(surge), with_time(sway), measure_of(*columns[i], scene));
    }
    if (is_free) text += fmt::format("ice force   {}: none\n", peaks.ship);
  }
  return text;
}

std::string under_hull_lines(const simulation::Counts& counts, const simulation::IceLedger& areas) {
  if (counts.went_under == 0) return "";
  return fmt::format("under hull  {} went under, {} of them tilted floes; {} came up, {} stayed under the ice\n",
                     counted(counts.went_under, "piece"), counts.tilted_under, counts.came_up, counts.stayed_under) +
         fmt::format("            {:.6f} m2 are there at the end, {:.6f} m2 stayed under the ice\n", areas.under_hulls,
                     areas.under_ice);
}

/// Returns "ticks of 0.05 s, the shortest step 0.0125 s".
std::string steps_of(const simulation::Counts& counts, double tick) {
  std::string ticks = fmt::format("ticks of {:g} s", tick);
  if (counts.most_parts <= 1) return ticks;
  return fmt::format("{}, the shortest step {:g} s", ticks, io::shortest_step(counts, tick));
}

}  // namespace

std::string to_geojson(const ShapeView& view) {
  const simulation::BirthRecord& birth = view.birth;
  return io::json_object([&](JsonWriter& json) {
    json.key("type").value("Feature");
    if (view.time_in_world) io::write_place(json, {.origin = view.origin, .shifted_crs = {}, .shift = {}, .wrong = {}});
    json.key("properties").open('{').key("floe_id").value(birth.floe);
    json.key("parent_id").value(id_or_none(birth.parent));
    json.key("born_s").value(birth.time).key("generation").value(birth.generation);
    json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass);
    io::append_ice(json, view.ice);
    json.key("frame").value(view.time_in_world ? "world" : "body");
    if (view.time_in_world) json.key("t_s").value(*view.time_in_world);
    json.close('}').key("geometry").polygon(view.polygon);
  });
}

std::string floe_table(const io::Run& run, double time) {
  std::string text =
      fmt::format("{:>7} {:>7} {:>10} {:>14} {:>12} {:>8} {:>5} {:>12} {:>11} {:>9} {}\n", "floe", "parent", "born_s",
                  "area_m2", "perimeter_m", "vertices", "holes", "mass_kg", "thickness_m", "m_per_s", "valid");
  for (const FloeRow& row : floe_rows(run, time)) {
    const simulation::BirthRecord& birth = row.birth;
    text += fmt::format("{:>7} {:>7} {:>10.6g} {:>14.6f} {:>12.4f} {:>8} {:>5} {:>12.6g} {:>11.6g} {:>9} {}\n",
                        birth.floe, birth.parent == simulation::kNoFloe ? "-" : std::to_string(birth.parent),
                        birth.time, birth.area, row.perimeter, row.vertices, row.holes, birth.mass, row.ice.thickness,
                        row.speed ? fmt::format("{:.5f}", *row.speed) : "-", row.validity);
  }
  return text;
}

std::string floes_json(const io::Run& run, double time) {
  return io::json_object([&](JsonWriter& json) {
    json.key("t_s").value(time).key("floes").object_lines(floe_rows(run, time), [&](const FloeRow& row) {
      json.key("floe_id").value(row.birth.floe).key("parent_id").value(id_or_none(row.birth.parent));
      json.key("born_s").value(row.birth.time).key("area_m2").value(row.birth.area);
      json.key("perimeter_m").value(row.perimeter).key("vertices").value(row.vertices);
      json.key("holes").value(row.holes).key("mass_kg").value(row.birth.mass);
      io::append_ice(json, row.ice);
      json.key("speed_m_per_s").value(row.speed).key("valid").value(row.validity);
    });
  });
}

std::string lineage_tree(const io::Run& run, FloeId floe) {
  std::string text;
  const std::vector<FloeId> ids = run.lineage(floe);
  for (const FloeId id : ids) {
    const io::RunFloe& at = *run.floe(id);
    text += fmt::format("floe {}  {:.6f} m2{}\n", id, at.birth.area,
                        at.birth.parent == simulation::kNoFloe ? "  as in the scene" : "");
    if (id == floe) {
      text += at.death_event ? fmt::format("ended at {}\n", described(run, run.events[*at.death_event]))
                             : "lives to the end\n";
      continue;
    }
    if (!at.death_event) continue;
    const simulation::Event& event = run.events[*at.death_event];
    text += fmt::format("|  {}\n", described(run, event));
    for (const FloeId child : event.ice()->children) {
      if (std::ranges::find(ids, child) == ids.end() && run.floe(child))
        text += fmt::format("|--floe {}  {:.6f} m2\n", child, run.floe(child)->birth.area);
    }
  }
  return text;
}

std::string lineage_json(const io::Run& run, FloeId floe) {
  return io::json_object([&](JsonWriter& json) {
    json.key("floe_id").value(floe).key("lineage").object_lines(run.lineage(floe), [&](FloeId id) {
      const io::RunFloe& at = *run.floe(id);
      json.key("floe_id").value(id).key("born_s").value(at.birth.time).key("area_m2").value(at.birth.area);
      json.key("broken_by").json(at.death_event ? json_of(run, run.events[*at.death_event]) : "null");
    });
  });
}

std::string event_list(const io::Run& run) {
  std::string text;
  for (const simulation::Event& event : in_order(run.events)) {
    text += described(run, event);
    if (event.ice()) text += fmt::format("  (floe {})", event.ice()->floe);
    text += '\n';
  }
  return text.empty() ? "no events\n" : text;
}

std::string events_json(const io::Run& run) {
  return io::json_object([&](JsonWriter& json) {
    json.key("events").open('[');
    for (const simulation::Event& event : in_order(run.events)) {
      json.start_line();
      json.json(json_of(run, event));
    }
    json.close(']');
  });
}

std::string size_table(const io::Run& run, double time) {
  const SizeDistribution sizes = size_distribution(run, time);
  std::string text = fmt::format("{}, {:.6f} m2 at {:.6g} s; size is the root of the area\n",
                                 counted(sizes.count, "floe"), sizes.area, time);
  if (sizes.without_size > 0)
    text +=
        fmt::format("left out: {} whose recorded area is not a positive number\n", counted(sizes.without_size, "floe"));
  if (sizes.count == 0) return text;
  text +=
      fmt::format("size_m: least {:.6g}, median {:.6g}, largest {:.6g}\n", sizes.least, sizes.median, sizes.largest);
  text += fmt::format("{:>10} {:>10} {:>8} {:>16} {:>8} {:>10}\n", "from_m", "below_m", "floes", "area_m2", "area_%",
                      "from_on");
  for (const SizeClass& one : sizes.classes)
    text += fmt::format("{:>10g} {:>10g} {:>8} {:>16.6f} {:>8.3f} {:>10}\n", one.from, one.below, one.count, one.area,
                        100 * one.area / sizes.area, one.from_on);
  return text;
}

std::string sizes_json(const io::Run& run, double time) {
  const SizeDistribution sizes = size_distribution(run, time);
  return io::json_object([&](JsonWriter& json) {
    json.key("t_s").value(time).key("floes").value(sizes.count).key("left_out").value(sizes.without_size);
    json.key("area_m2").value(sizes.area).key("least_m").value(sizes.least).key("median_m").value(sizes.median);
    json.key("largest_m").value(sizes.largest);
    json.key("classes").object_lines(sizes.classes, [&](const SizeClass& one) {
      json.key("from_m").value(one.from).key("below_m").value(one.below).key("floes").value(one.count);
      json.key("area_m2").value(one.area).key("from_on").value(one.from_on);
    });
  });
}

std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const auto add = [&text]<class... Values>(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
  };
  const auto& counts = summary.counts;
  const auto& areas = summary.areas;
  add("simulated   {:.6g} s in {:.3g} s, {:.3g} x real time; {}\n", summary.sim_time, summary.wall_time,
      summary.real_time_factor(), steps_of(counts, scene.time.step));
  add("fractures   {} broken by bending, {}, {}\n", counted(counts.bends, "cusp"), counted(counts.splits, "split"),
      counted(counts.rejected_cuts, "rejected cut"));
  if (counts.ground > 0)
    add("ground      {} that contacts did not part, to brash\n", counted(counts.ground, "overlap"));
  text += under_hull_lines(counts, areas);
  add("floes       {} -> {}\n", counts.floes_initial, counts.floes_final);
  const double submerged = areas.submerged + areas.under_hulls + areas.under_ice;
  add("ice         {:.6f} m2 = {:.6f} floes + {:.6f} submerged + {:.6f} brash (imbalance {:.1e}, rounding {:.1e} m2)\n",
      areas.initial, areas.floes, submerged, areas.brash, areas.imbalance(), areas.rounding);
  const auto& masses = summary.masses;
  add("            {:.6g} t = {:.6g} floes + {:.6g} submerged + {:.6g} brash (imbalance {:.1e} t)\n",
      1e-3 * masses.initial, 1e-3 * masses.floes, 1e-3 * (masses.submerged + masses.under_hulls + masses.under_ice),
      1e-3 * masses.brash, 1e-3 * masses.imbalance());
  const simulation::EnergyFlows& energy = summary.audit.sums.energy;
  const simulation::BoundaryFlows& boundaries = summary.audit.sums.boundaries;
  const simulation::MooringFlows& moorings = summary.audit.sums.moorings;
  add("energy      {:.4g} kJ in: {:.4g} drag, {:.4g} friction, {:.4g} crushing, {:.4g} collisions, {:.4g} in "
      "motion (imbalance {:.1e} of it)\n",
      (energy.thrust + energy.current + boundaries.wind + boundaries.walls + moorings.ground + moorings.initial +
       summary.audit.sums.initial_energy) /
          1e3,
      energy.drag / 1e3, energy.friction / 1e3, energy.crushing / 1e3, energy.restitution / 1e3,
      summary.audit.kinetic_energy / 1e3, summary.audit.energy_imbalance / std::max(summary.audit.turnover, 1e-300));
  if (has_moorings(scene))
    add("moorings    {:.4g} kJ stored: {:.4g} at the start, {:.4g} taken up, {:.4g} given back, {:.4g} lost by "
        "breaking; "
        "{:.4g} damped\n",
        summary.audit.stored_energy / 1e3, moorings.initial / 1e3, moorings.taken_up / 1e3, moorings.given_back / 1e3,
        moorings.breaking / 1e3, moorings.damping / 1e3);
  return text + force_lines(summary, scene);
}

namespace {

constexpr std::array kAccounts{"ledger", "energy", "moorings", "momentum"};  ///< members of summary.json
constexpr std::array kVerdicts{"ledger_closed", "audit_closed"};

std::string account_line(const std::string& key, const JsonValue& value) {
  if (value.is(JsonValue::Kind::kNumber)) return fmt::format("  {:<24} {:>16.9g}\n", key, value.number());
  if (!value.is(JsonValue::Kind::kArray)) return "";
  std::string numbers;
  for (const JsonValue& item : value.items())
    if (item.is(JsonValue::Kind::kNumber)) numbers += fmt::format(" {:>16.9g}", item.number());
  return fmt::format("  {:<24}{}\n", key, numbers);
}

void append_value(JsonWriter& json, const JsonValue& value) {
  if (value.is(JsonValue::Kind::kNumber)) {
    json.value(value.number());
  } else if (value.is(JsonValue::Kind::kArray)) {
    json.open('[');
    for (const JsonValue& item : value.items()) append_value(json, item);
    json.close(']');
  } else {
    json.null();
  }
}

}  // namespace

std::string account_table(const io::Run& run) {
  std::string text;
  for (const char* name : kAccounts) {
    const JsonValue* account = run.summary.find(name, JsonValue::Kind::kObject);
    if (!account) continue;
    text += fmt::format("{}\n", name);
    for (const io::JsonMember& member : account->members()) text += account_line(member.key, member.value);
  }
  for (const char* name : kVerdicts)
    if (const JsonValue* verdict = run.summary.find(name, JsonValue::Kind::kBoolean))
      text += fmt::format("{:<26} {:>16}\n", name, verdict->boolean() ? "yes" : "NO");
  return text.empty() ? "no accounts: the run has none before its end\n" : text;
}

std::string accounts_json(const io::Run& run) {
  return io::json_object([&](JsonWriter& json) {
    for (const char* name : kAccounts) {
      const JsonValue* account = run.summary.find(name, JsonValue::Kind::kObject);
      if (!account) continue;
      json.key(name).open('{');
      for (const io::JsonMember& member : account->members()) append_value(json.key(member.key), member.value);
      json.close('}');
    }
    for (const char* name : kVerdicts)
      if (const JsonValue* verdict = run.summary.find(name, JsonValue::Kind::kBoolean))
        json.key(name).value(verdict->boolean());
  });
}

}  // namespace polynya::analysis
