#include "simulation/state/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "simulation/state/state_fields.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/parts.hpp"

namespace polynya::simulation {

// ---- saved and hashed

namespace {

Restraint restraint_of(const Population& population, FloeId id) {
  // This also holds for fast ice that has broken, because one of its pieces may stay fast.
  if (population.is_fast(id)) return Restraint::kFast;
  return population.floes[id].is_under ? Restraint::kUnderHull : Restraint::kFree;
}

/// Returns a member of all contact records, in the order of the records. Such members are saved separately because only
/// one of the two laws of contact uses them, or because they are not hashed.
template <class Member>
std::vector<Member> members(const std::vector<dynamics::PairState>& pairs,
                            Member dynamics::PersistentContact::*member) {
  std::vector<Member> all;
  for (const dynamics::PairState& pair : pairs)
    for (const dynamics::PersistentContact& record : pair.records) all.push_back(record.*member);
  return all;
}

template <class Archive>
void write(Archive& archive, const World& world, const std::vector<dynamics::PairState>& pairs) {
  const Population& population = world.population;
  head_fields(archive, world);
  archive(std::uint64_t{population.floes.size()});
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull) {
    motion_fields(archive, population.bodies, hull);
    hull_fields(archive, world, hull);
  }
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    const Floe& floe = population.floes[id];
    archive(floe, population.is_alive(id), restraint_of(population, id));
    if (!population.is_alive(id)) continue;
    if (floe.parent != kNoFloe) archive(floe.shape.polygon);  // otherwise the shape is the scene's
    motion_fields(archive, population.bodies, population.body_of(id));
  }
  archive(population.tilted, population.submerged, population.accelerating_cusps);
  if (world.setup.has_flooding_decks) archive(population.decks);
  archive(pairs);
  archive(members(pairs, &dynamics::PersistentContact::crushed));
  if (has_restitution(world.setup)) archive(members(pairs, &dynamics::PersistentContact::stored_energy));
}

}  // namespace

std::string save_state(const World& world) {
  const std::vector<dynamics::PairState> pairs = world.population.pairs.pair_states();
  std::vector<double> separation_bound;
  separation_bound.reserve(pairs.size());
  for (const dynamics::PairState& pair : pairs) separation_bound.push_back(pair.separation_bound);
  ByteWriter archive;
  write(archive, world, pairs);
  archive(separation_bound);
  archive(members(pairs, &dynamics::PersistentContact::booked));
  tail_fields(archive, world);
  archive(world.accounts.load_peaks, world.accounts.panels, members(pairs, &dynamics::PersistentContact::load_track));
  return archive.take();
}

std::uint64_t state_hash(const World& world) {
  HashWriter archive;
  write(archive, world, world.population.pairs.touching_states());
  return archive.hash();
}

// ---- loaded

namespace {

/// Largest distance of a body from the origin; a larger one means damage [m].
constexpr double kFarthestPosition = 1e9;
/// Largest speed of a body; pieces of a fracture may exceed kRunawaySpeed for one step by turning [m/s].
constexpr double kFastestBody = 8 * kRunawaySpeed;
constexpr double kMostTurned = 1e9;  ///< largest angle by which a body has turned; a larger one means damage [rad]
constexpr double kOutside = 1e-3;    ///< distance by which rounded vertices may lie outside the ice of the scene [m]

/// Returns the box around all ice of the scene at the start. The body frames of floes are those of the scene, so the
/// vertices of all pieces stay in this box.
geometry::Box ice_box(std::span<const FloeSpec> floes) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  geometry::Box box{{kFar, kFar}, {-kFar, -kFar}};
  for (const FloeSpec& floe : floes) extend(box, bounding_box(floe.polygon_in_world.outer));
  return geometry::grown(box, kOutside);
}

/// Fills an empty world from bytes. It checks only values that the next value or a container depends on: numbers of
/// bodies, shapes and places. validate_world() then checks whether the values form a consistent world.
class StateLoader {
 public:
  StateLoader(World& world, std::string_view bytes)
      : scene_(world.setup.scene),
        floes_at_start_(std::exchange(world.floes_at_start, {})),
        world_(world),
        population_(world.population),
        bytes_(bytes),
        ice_(ice_box(floes_at_start_)) {}

  std::string load() {
    load_accounts();
    std::uint64_t floes = 0;
    bytes_(floes);
    bytes_.require(floes >= floes_at_start_.size() && floes <= bytes_.left(), "a number of floes that cannot be");
    for (BodyIndex hull = 0; hull < population_.hull_count && bytes_.is_well(); ++hull) load_hull(hull);
    for (std::uint64_t id = 0; id < floes && bytes_.is_well(); ++id) load_floe(static_cast<FloeId>(id));
    if (bytes_.is_well()) load_ice_at_hulls();
    if (bytes_.is_well()) load_pairs();
    tail_fields(bytes_, world_);
    load_peaks();
    load_panels();
    bytes_.require(bytes_.is_at_end(), "more bytes than it should have");
    if (bytes_.is_well()) population_.pairs.restore(population_.bodies, pairs_);
    if (bytes_.is_well()) {
      if (auto defect = validate_world(world_)) bytes_.fail(*std::move(defect));
    }
    return bytes_.failure();
  }

 private:
  void load_accounts() {
    head_fields(bytes_, world_);
    bytes_.require(world_.accounts.loads.size() == hull_count(scene_), "loads of other ships");
    for (const Event& contact : world_.accounts.hull_contacts) {
      const int other = std::get<HullContact>(contact.what).other;
      bytes_.require(contact.ship >= 0 && contact.ship < other && other < population_.hull_count,
                     "a contact of no two ships");
    }
  }

  /// Loads the motion of a body that has been added, and adds it to the contact search unless it is under a hull.
  void load_motion(BodyIndex i, bool is_under = false) {
    dynamics::Bodies& bodies = population_.bodies;
    motion_fields(bytes_, bodies, i);
    const auto is_within = [](double x, double y, double most) { return std::max(std::abs(x), std::abs(y)) <= most; };
    bodies.rotation[i] = geometry::Rotation::by(bodies.angle[i]);
    bytes_.require(is_within(bodies.position[i].x, bodies.position[i].y, kFarthestPosition), "a body beyond the world");
    bytes_.require(is_within(bodies.velocity[i].x, bodies.velocity[i].y, kFastestBody), "a body faster than any");
    bytes_.require(std::abs(bodies.angular_velocity[i]) * bodies.bounding_radius[i] <= kFastestBody,
                   "a body that spins faster than any");
    bytes_.require(is_within(bodies.angle[i], 0, kMostTurned), "a body that has turned farther than any");
    bytes_.require(is_within(bodies.angle_rest[i], 0, 1e-9 * kMostTurned), "a turn that rounding cannot leave");
    bytes_.require(bodies.travel[i] >= 0, "a negative travel");
    bytes_.require(bodies.is_awake[i] <= 1, "a truth value that is neither");
    bytes_.require(!is_under || bodies.is_awake[i] == 0, "ice under a hull that is awake");
    if (!bytes_.is_well()) return;
    population_.pairs.add(bodies, i);
    if (is_under) population_.pairs.remove(i);
    if (bodies.is_awake[i] == 0) return;
    population_.awake.push_back(i);
    add_drag(i, population_);
  }

  void load_hull(BodyIndex hull) {
    add_body(population_.bodies, new_body_of(scene_, hull));
    load_motion(hull);
    bytes_.require(population_.bodies.is_awake[hull] != 0, "a ship asleep");
    hull_fields(bytes_, world_, hull);
  }

  /// Checks the parent of a floe and its restraint against those of the scene or of the parent.
  void check_origin(FloeId id, const Floe& floe, bool is_alive, Restraint restraint) {
    const bool is_of_scene = id < static_cast<FloeId>(floes_at_start_.size());
    bytes_.require(floe.parent >= kNoFloe && floe.parent < id, "a floe older than its parent");
    bytes_.require((floe.parent == kNoFloe) == is_of_scene, "a floe without a parent");
    if (!bytes_.is_well()) return;
    bytes_.require(restraint <= Restraint::kFast, "a restraint that there is not");
    bytes_.require(is_alive || restraint != Restraint::kUnderHull, "a broken floe under a hull");
    const bool is_fast = restraint == Restraint::kFast;
    const bool can_be_fast = is_of_scene ? floes_at_start_[id].is_fast : population_.is_fast(floe.parent);
    bytes_.require(!is_fast || can_be_fast, "a fast floe of a free one");
    bytes_.require(is_fast || !is_of_scene || !can_be_fast, "a free floe where the scene has a fast one");
  }

  void load_floe(FloeId id) {
    Floe floe;
    bool is_alive = false;
    Restraint restraint = Restraint::kFree;
    bytes_(floe, is_alive, restraint);
    check_origin(id, floe, is_alive, restraint);
    if (!bytes_.is_well()) return;
    const FloeSpec* spec = floe.parent == kNoFloe ? &floes_at_start_[id] : nullptr;
    floe.own_ice = spec ? spec->own_ice : population_.floes[floe.parent].own_ice;
    floe.is_under = restraint == Restraint::kUnderHull;
    if (is_alive) floe.shape = spec ? geometry::Shape{spec->polygon_in_world} : load_shape();
    if (!bytes_.is_well()) return;
    const fracture::Ice& ice = ice_of(scene_, floe.own_ice);
    const bool is_fast = restraint == Restraint::kFast;
    dynamics::NewBody body;
    if (is_alive) {
      body = new_body_of(floe.shape.polygon, geometry::measure(floe.shape.polygon), ice, is_fast);
    } else {  // a floe that broke keeps its index
      body.mass = body.moment = 1;
      body.is_prescribed = is_fast;
      body.thickness = ice.thickness;
      body.boundary = std::make_shared<geometry::Boundary>();
    }
    const BodyIndex index = add_body(population_.bodies, body);
    const bool is_under = floe.is_under;
    population_.floes.push_back(std::move(floe));
    if (is_alive) return load_motion(index, is_under);
    population_.bodies.is_alive[index] = 0;
    population_.bodies.boundary[index].reset();
  }

  geometry::Shape load_shape() {
    geometry::Shape shape;
    bytes_(shape.polygon);
    const auto is_in_ice = [&](geometry::Point p) { return overlaps(ice_, {p, p}); };
    bool is_within = shape.polygon.outer.size() >= 3 && std::ranges::all_of(shape.polygon.outer, is_in_ice);
    for (const geometry::Ring& hole : shape.polygon.holes)
      is_within = is_within && hole.size() >= 3 && std::ranges::all_of(hole, is_in_ice);
    bytes_.require(is_within, "a floe outside the scene's ice");
    if (!bytes_.is_well()) return shape;
    if (const auto defect = find_defect(shape.polygon))
      bytes_.fail(fmt::format("a floe that is {}", name_of(defect->defect)));
    shape.known_valid = true;
    bytes_.require(can_be_floe(geometry::measure(shape.polygon)), "a floe too small to be one");
    return shape;
  }

  bool can_take_ice(int ship) const {
    return ship >= 0 && ship < population_.hull_count &&
           world_.setup.underwater[static_cast<std::size_t>(ship)].can_take_ice;
  }

  bool is_in_contact_world(BodyIndex body) const {
    return population_.is_hull(body) || population_.is_floating(population_.floe_of(body));
  }

  void load_ice_at_hulls() {
    bytes_(population_.tilted, population_.submerged);
    const auto is_floe = [&](FloeId floe) {
      return floe >= 0 && floe < population_.floe_count() && population_.is_alive(floe);
    };
    for (const TiltedFloe& tilted : population_.tilted)
      bytes_.require(can_take_ice(tilted.ship) && is_floe(tilted.floe), "a tilted floe that there is not");
    for (SubmergedPiece& submerged : population_.submerged) {
      bytes_.require(can_take_ice(submerged.ship) && is_floe(submerged.floe), "ice under a hull that there is not");
      if (!bytes_.is_well()) return;
      submerged.area = population_.floes[submerged.floe].area;
    }
    load_accelerating_cusps();
    if (world_.setup.has_flooding_decks) load_decks();
  }

  void load_accelerating_cusps() {
    bytes_(population_.accelerating_cusps);
    for (const AcceleratingCusp& cusp : population_.accelerating_cusps)
      bytes_.require(can_take_ice(cusp.ship), "a cusp before a hull that there is not");
  }

  void load_decks() {
    bytes_(population_.decks);
    for (const PressedDeck& pressed : population_.decks)
      bytes_.require(can_take_ice(pressed.ship), "a deck under a hull that there is not");
  }

  /// Loads a member of all contact records, in the order of the records. `of_another_number` is the reason of failure
  /// if the number of values differs.
  template <class Member>
  void load_members(std::vector<dynamics::PairState>& pairs, Member dynamics::PersistentContact::*member,
                    const char* of_another_number) {
    std::vector<Member> loaded;
    bytes_(loaded);
    std::size_t next = 0;
    for (dynamics::PairState& pair : pairs) {
      for (dynamics::PersistentContact& record : pair.records) {
        if (next < loaded.size()) record.*member = loaded[next];
        ++next;
      }
    }
    bytes_.require(next == loaded.size(), of_another_number);
  }

  void load_pairs() {
    std::vector<dynamics::PairState> pairs;
    std::vector<double> separation_bound;
    bytes_(pairs);
    load_members(pairs, &dynamics::PersistentContact::crushed, "another number of crushed overlaps than of contacts");
    if (has_restitution(world_.setup))
      load_members(pairs, &dynamics::PersistentContact::stored_energy,
                   "another number of stored energies than of contacts");
    bytes_(separation_bound);
    load_members(pairs, &dynamics::PersistentContact::booked, "another number of booked overlaps than of contacts");
    bytes_.require(pairs.size() == separation_bound.size(), "another number of separation bounds than of pairs");
    const dynamics::Bodies& bodies = population_.bodies;
    for (std::size_t i = 0; i < pairs.size() && bytes_.is_well(); ++i) {
      dynamics::PairState& pair = pairs[i];
      const bool is_there = pair.a >= 0 && pair.a < pair.b && pair.b < bodies.size();
      bytes_.require(is_there && is_in_contact_world(pair.a) && is_in_contact_world(pair.b), "a pair of no two bodies");
      if (!bytes_.is_well()) return;
      bytes_.require(bodies.is_awake[pair.a] || bodies.is_awake[pair.b], "a pair of two asleep");
      bytes_.require(
          !are_prescribed(bodies, pair.a, pair.b) || (population_.is_hull(pair.a) && !population_.is_hull(pair.b)),
          "a pair of two of prescribed motion");
      bytes_.require(!is_grounded(bodies.kind[pair.a]) || !is_grounded(bodies.kind[pair.b]), "a pair of two walls");
      const bool is_next = i == 0 || std::pair(pairs[i - 1].a, pairs[i - 1].b) < std::pair(pair.a, pair.b);
      bytes_.require(is_next, "pairs out of their order");
      pair.separation_bound = separation_bound[i];
    }
    pairs_ = std::move(pairs);
  }

  void load_peaks() {
    bytes_(world_.accounts.load_peaks);
    for (const LoadTrack& track : world_.accounts.load_peaks.tracks) {
      const ContactState& s = track.at_largest;
      const bool has_bodies = s.on.ship >= 0 && s.on.ship < population_.hull_count && s.by.floe >= 0 &&
                              s.by.floe < population_.floe_count();
      bytes_.require(has_bodies || track.largest == 0, "a load of no hull and floe");
      bytes_.require(track.ending <= PeakEnd::kTilt && track.ending != PeakEnd::kNone, "an end that there is not");
    }
  }

  /// Loads the panels, and the numbers of the tracks that the records of contacts refer to.
  void load_panels() {
    std::vector<HullPanels> panels;
    bytes_(panels);
    const std::vector<HullPanels>& of_scene = world_.accounts.panels;
    bytes_.require(std::ranges::equal(panels, of_scene, {}, &HullPanels::size, &HullPanels::size), "other panels");
    if (bytes_.is_well()) world_.accounts.panels = std::move(panels);
    load_members(pairs_, &dynamics::PersistentContact::load_track, "another number of loads than of contacts");
  }

  const Scene& scene_;
  std::vector<FloeSpec> floes_at_start_;  ///< floes of the scene
  World& world_;
  Population& population_;
  ByteReader bytes_;
  /// Pairs, which are added to the contact search when all else is loaded.
  std::vector<dynamics::PairState> pairs_;
  geometry::Box ice_;
};

}  // namespace

std::string load_state(World& empty, std::string_view bytes) {
  return StateLoader(empty, bytes).load();
}

}  // namespace polynya::simulation
