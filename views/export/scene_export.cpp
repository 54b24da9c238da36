#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/shape/angle.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/setup.hpp"
#include "views/export/export.hpp"

namespace polynya::views {
namespace {

using io::JsonMember;
using io::JsonValue;
using JsonKind = JsonValue::Kind;

constexpr std::size_t kLongestFinal = std::size_t{1} << 31;  ///< longest final.geojson that is read [bytes]

JsonValue::Array pair_of(double x, double y) {
  return {{x}, {y}};
}

/// Returns which floes are fast ice: floes that are fast in the scene, and of the pieces of such a floe the largest
/// that still exists.
std::vector<bool> fast_floes(const io::Run& run) {
  std::vector<bool> is_fast(run.floes.size());
  const auto& specs = run.scene.scene.floes;
  for (std::size_t i = 0; i < std::min(specs.size(), is_fast.size()); ++i) is_fast[i] = specs[i].is_fast;
  for (const simulation::Event& event : run.events) {
    const simulation::IceEvent* ice = event.ice();
    if (!ice || !is_fast[static_cast<std::size_t>(ice->floe)]) continue;
    const io::RunFloe* largest = nullptr;
    for (const simulation::FloeId child : ice->children) {
      const io::RunFloe* floe = run.floe(child);
      if (floe && (!largest || floe->birth.area > largest->birth.area)) largest = floe;
    }
    if (largest) is_fast[largest->birth.floe] = true;
  }
  return is_fast;
}

/// Sets the ship over a floe and the distance that it has moved through the water, ahead, since the floe went under.
void add_hull(const io::Run& run, const io::MotionIndex& motions, double time, simulation::FloeState& state) {
  const auto went_under = std::ranges::find_if(run.events, [&](const simulation::Event& event) {
    return event.is<simulation::Submerge>() && event.ice()->floe == state.floe;
  });
  const auto ship = static_cast<std::size_t>(went_under->ship);
  const simulation::WaterSettings& water = run.scene.scene.water;
  const auto speed_ahead = [&](double at) {
    const auto motion = motions.ship_at(ship, at);
    if (!motion) return 0.0;
    const geometry::Vector current =
        water.drift_at(at) + simulation::current_of(water.shear).velocity_at(motion->position - water.drift_path(at));
    return dot(motion->velocity - current, {std::cos(motion->angle), std::sin(motion->angle)});
  };
  state.under_hull_of = run.scene.scene.ships.at(ship).name;
  const auto& specs = run.scene.scene.floes;
  if (const auto id = static_cast<std::size_t>(state.floe); id < specs.size()) state.under_path = specs[id].under_path;
  double from = went_under->time;
  for (const io::Frame& frame : run.frames) {
    if (frame.time <= from || from >= time) continue;
    const double to = std::min(frame.time, time);
    state.under_path += 0.5 * (speed_ahead(from) + speed_ahead(to)) * (to - from);
    from = to;
  }
}

/// Returns the floes at a frame in the form of final.geojson.
std::string floes_text(const io::Run& run, const io::MotionIndex& motions, const std::vector<io::PlacedFloe>& placed,
                       double time) {
  const std::vector<bool> is_fast = fast_floes(run);
  std::vector<simulation::FloeState> states;
  states.reserve(placed.size());
  for (const io::PlacedFloe& floe : placed) {
    const simulation::BirthRecord& birth = *floe.birth;
    simulation::FloeState& state = states.emplace_back();
    state.floe = birth.floe;
    state.parent = birth.parent;
    state.born = birth.time;
    state.generation = birth.generation;
    state.world_from_body = floe.world_from_body;
    if (floe.motion) {
      state.velocity = floe.motion->velocity;
      state.angular_velocity = floe.motion->angular_velocity;
    }
    state.area = birth.area;
    state.mass = birth.mass;
    state.ice = &ice_of(run.scene.scene, birth.own_ice);
    state.is_fast = is_fast[static_cast<std::size_t>(birth.floe)];
    state.polygon_in_body = floe.polygon_in_body.get();
    if (run.is_under(birth.floe, time)) add_hull(run, motions, time, state);
  }
  return io::to_geojson(states, time, run.scene.scene.origin);
}

/// Appends the features of one collection to another.
void add_features(std::string& collection, const std::string& other) {
  const std::size_t end = collection.rfind("]}"), first = other.find('[') + 1;
  const bool is_empty = collection.find_last_not_of(" \n", end - 1) == collection.find('[');
  collection.replace(end, std::string::npos, (is_empty ? "" : ",") + other.substr(first));
}

/// Moves a ship of the resolved scene to its place at the frame.
void place_ship(JsonValue& ship, const io::Motion& motion) {
  const geometry::Vector ahead{std::cos(motion.angle), std::sin(motion.angle)};
  ship.set("position_m", pair_of(motion.position.x, motion.position.y));
  ship.set("heading_deg", std::remainder(geometry::kDegreesPerRadian * motion.angle, 360));
  const JsonValue* propulsion = ship.find("propulsion");
  if (propulsion && propulsion->find("constant_speed_m_per_s")) return;
  ship.set("speed_m_per_s", dot(motion.velocity, ahead));
  ship.set("sway_speed_m_per_s", dot(motion.velocity, perpendicular(ahead)));
  ship.set("yaw_rate_deg_per_s", geometry::kDegreesPerRadian * motion.angular_velocity);
}

/// Shifts a table of a pilot to the new clock. Rows before its zero are removed, and a row that is interpolated at that
/// time is put at 0.
void shift_table(JsonValue& rows, double time) {
  JsonValue::Array later;
  const JsonValue::Array& all = rows.items();
  for (std::size_t i = 0; i < all.size(); ++i) {
    JsonValue row = all[i];
    const double at = row.find("t_s")->number() - time;
    if (at < 0 && i + 1 < all.size()) {
      const JsonValue& next = all[i + 1];
      const double end = next.find("t_s")->number() - time;
      if (end <= 0) continue;
      for (JsonMember& member : row.members()) {
        const JsonValue* other = next.find(member.key);
        if (other && member.value.is(JsonKind::kNumber))
          member.value.data = std::lerp(member.value.number(), other->number(), -at / (end - at));
      }
    }
    row.set("t_s", std::max(0.0, at));
    later.push_back(std::move(row));
  }
  rows.data = std::move(later);
}

/// A pilot that holds the initial heading of the ship continues to hold that heading.
void keep_heading(JsonValue& ship, double heading) {
  JsonValue* pilot = ship.find("steering") ? ship.find("pilot") : nullptr;
  for (const char* kind : {"hold_speed", "hold_heading", "ram"}) {
    JsonValue* settings = pilot ? pilot->find(kind) : nullptr;
    if (settings && !settings->find("heading_deg")) settings->set("heading_deg", heading);
  }
}

/// Notes the state of a ship's pilot and steering that the new scene does not contain.
void note_memory(const JsonValue& ship, std::vector<std::string>& left_out) {
  const JsonValue* name = ship.find("name", JsonKind::kText);
  const auto note = [&](std::string_view what) {
    left_out.push_back(fmt::format("{}: {}", name ? name->text() : "a ship", what));
  };
  const JsonValue* pilot = ship.find("pilot");
  if (pilot && pilot->find("route")) note("its route begins again; take out the waypoints that lie behind");
  if (pilot && pilot->find("manage")) note("it goes to where its pattern begins");
  if (pilot && pilot->find("ram")) note("its ramming begins with a charge");
  if (ship.find("steering")) note("its rudder or thrusters start amidships");
}

/// Sets moving walls to their places at the frame.
void place_walls(JsonValue& scene, const io::Run& run, const io::MotionIndex& motions, double time,
                 std::vector<std::string>& left_out) {
  const std::vector<simulation::Wall>& walls = run.scene.scene.walls;
  const std::size_t first = hull_count(run.scene.scene) - walls.size();
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto motion = motions.ship_at(first + i, time);
    if (!motion) continue;
    const geometry::Vector moved = motion->position - walls[i].position_in_world;
    JsonValue& wall = scene.find("walls")->items().at(i);
    for (const char* key : {"from_m", "to_m"}) {
      const JsonValue::Array& end = wall.find(key)->items();
      wall.set(key, pair_of(end[0].number() + moved.x, end[1].number() + moved.y));
    }
    if (walls[i].pressure) left_out.push_back(walls[i].name + ": it starts to press from rest");
  }
}

void place_ships(JsonValue& scene, const io::Run& run, const io::MotionIndex& motions, double time,
                 std::vector<std::string>& left_out) {
  JsonValue* ships = scene.find("ships");
  for (std::size_t i = 0; ships && i < ships->items().size(); ++i) {
    JsonValue& ship = ships->items()[i];
    keep_heading(ship, geometry::kDegreesPerRadian * run.scene.scene.ships.at(i).heading);
    if (const auto motion = motions.ship_at(i, time)) place_ship(ship, *motion);
    note_memory(ship, left_out);
    JsonValue* pilot = ship.find("pilot");
    JsonValue* table = pilot ? pilot->find("table") : nullptr;
    if (JsonValue* rows = table ? table->find("rows") : nullptr) shift_table(*rows, time);
  }
}

/// Shifts the scene's end and its flows over time to the new clock.
void restart_clock(JsonValue& scene, const simulation::Scene& before, double time) {
  JsonValue* clock = scene.find("time");
  const double left = before.time.until - time;
  if (clock && left >= before.time.step) clock->set("until_s", left);
  JsonValue* water = scene.find("water");
  const auto shift = [&](JsonValue* rows) {
    for (JsonValue& row : rows ? rows->items() : JsonValue::Array{}) row.set("t_s", row.find("t_s")->number() - time);
  };
  shift(water ? water->find("drift_table") : nullptr);
  shift(scene.find("wind") ? scene.find("wind")->find("table") : nullptr);
  if (JsonValue* tide = water ? water->find("tide") : nullptr)
    tide->set("phase_deg",
              std::remainder(tide->find("phase_deg")->number() + 360 * time / before.water.tide->period, 360));
  JsonValue* shear = water ? water->find("shear") : nullptr;
  if (!shear || before.water.shear.rate == 0) return;
  const geometry::Point origin = before.water.shear.origin + before.water.drift_path(time);
  shear->set("origin_m", pair_of(origin.x, origin.y));
}

}  // namespace

io::Result<ContinuedScene> continued_scene(const io::Run& run, double time) {
  if (run.frames.empty()) return io::fail(run.folder.string() + ": it has no frames");
  ContinuedScene continued;
  continued.time = run.start_time();
  for (const io::Frame& frame : run.frames)
    if (frame.time <= time) continued.time = frame.time;
  const io::MotionIndex motions(run);
  // At the end of the run, final.geojson is exact to the last bit, while frames have tolerances.
  std::string floes;
  if (continued.time == run.end_time()) {
    auto final_floes = io::read_text_file(run.folder / io::run_file::kFinalGeojson, kLongestFinal);
    std::string begin = R"({"type":"FeatureCollection","t_s":)";
    io::append_number(begin, continued.time);
    if (final_floes && final_floes->starts_with(begin + ",")) floes = std::move(*final_floes);
  }
  if (floes.empty()) floes = floes_text(run, motions, floes_at(run, motions, continued.time), continued.time);
  if (const auto under = floes_under_hulls_at(run, motions, continued.time); !under.empty())
    add_features(floes, floes_text(run, motions, under, continued.time));
  JsonValue scene = io::parse_json(run.scene.resolved_text).root;
  const std::string name = fmt::format("{}-from-{:g}s", run.scene.scene.name.substr(0, 80), continued.time);
  scene.set("name", name);
  restart_clock(scene, run.scene.scene, continued.time);
  place_ships(scene, run, motions, continued.time, continued.left_out);
  place_walls(scene, run, motions, continued.time, continued.left_out);
  JsonValue entry{JsonValue::Object{}};
  entry.set("file", std::string("floes.geojson"));
  scene.set("floes", JsonValue::Array{std::move(entry)});
  continued.files = {{"scene.json", to_json_text(scene)}, {"floes.geojson", std::move(floes)}};
  return continued;
}

}  // namespace polynya::views
