#include "simulation/world/components.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "dynamics/chunks.hpp"
#include "simulation/world/levels.hpp"

namespace polynya::simulation {
namespace {

using dynamics::kNoLevel;
using geometry::Point;
using geometry::Vector;

/// Times the way by a body's speed: it may be pushed meanwhile. Less, bodies meet others that take other steps, and
/// blocks end; more, steps are shorter.
constexpr double kAhead = 1.5;
/// Beside that [m].
constexpr double kSlack = 0.01;
/// The longest way ahead in a block [m]: farther, what a ship may touch by its end is much ice.
constexpr double kMostAhead = 4;
/// Below the margin of the contact search's boxes: what may go farther is not among its pairs with all that it may
/// touch [m].
constexpr double kAheadInPairs = 1.5;
/// Times the mass of most floes awake: of one that is not moved by them.
constexpr double kHeavy = 1000;
/// Times that of another: such a one needs not go by the tick with it.
constexpr double kHeavier = 100;
/// By how much a contact may change the speed of one of its bodies in a step that is longer than the other's [m/s]. The
/// other's steps do not see what else holds it, so ice crushes by about that speed: 1 mm in 100 s.
constexpr double kPressedSpeed = 1e-5;
/// By how much contacts of shorter steps may before its step is cut short [m/s]: it is struck.
constexpr double kStruckSpeed = 0.1;
/// And so that it goes by no more than this share of a floe's way in a step.
constexpr double kStruckWay = 0.5;
/// How many bodies in a row that may touch go by the tick from one that has to, before the next ones have steps of two
/// ticks, four and so on: what strikes the first is held by the others' mass in the same tick. Fewer, loads fall.
constexpr int kHops = 6;
/// A body of more is taken by its bounding circle.
constexpr std::size_t kFewCorners = 64;
/// Of the awake bodies, that have to take longer steps.
constexpr double kLeastShare = 0.25;
/// Ticks after which it is tried again, where too few would.
constexpr std::int64_t kWait = 16;
/// Bodies, and pairs, for one thread at a time.
constexpr std::size_t kPerChunk = 512;

/// A bound of the speed at which any two points of two bodies that touch part or close [m/s].
double relative_speed(const Components::Node& a, const Components::Node& b) {
  return length(a.velocity - b.velocity) + a.turning + b.turning;
}

/// Whether two bodies are farther from each other than a way, by the normals of their edges and the line of their
/// centres [m]: exactly for convex ones, else for what their corners span.
class Apart {
 public:
  Apart(std::span<const Point> a, std::span<const Point> b, double way) : a_(a), b_(b), way_(way) {}

  bool are() const { return is_axis_of_edges(a_, b_) || is_axis_of_edges(b_, a_); }

 private:
  static double farthest(std::span<const Point> points, Vector axis) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Point p : points) most = std::max(most, axis.x * p.x + axis.y * p.y);
    return most;
  }
  bool is_axis_of_edges(std::span<const Point> of, std::span<const Point> other) const {
    if (of.size() > kMostEdges) return false;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Vector edge = of[i + 1 == of.size() ? 0 : i + 1] - of[i];
      const Vector outward{edge.y, -edge.x};  // outlines go round to port
      const double from = outward.x * of[i].x + outward.y * of[i].y;
      if (outward.x * other[0].x + outward.y * other[0].y <= from) continue;
      if (-farthest(other, -outward) - farthest(of, outward) > way_ * length(outward)) return true;
    }
    return false;
  }

  /// Of the body whose normals are tried. More: two of many edges cost their product; fewer: large floes that are apart
  /// count as near.
  static constexpr std::size_t kMostEdges = 64;
  std::span<const Point> a_;
  std::span<const Point> b_;
  double way_;
};

class Assignment {
 public:
  Assignment(const Setup& setup, const Clock& clock, std::int64_t ticks, int threads, Population& population,
             Components& components)
      : setup_(setup),
        population_(population),
        bodies_(population.bodies),
        components_(components),
        nodes_(components.nodes),
        ticks_(ticks),
        threads_(threads),
        tick_(clock.tick),
        least_(parts_of_tick(setup, clock, population) > 1 ? 1 : 2) {}

  std::int64_t sort();

 private:
  using Node = Components::Node;
  double time() const { return static_cast<double>(ticks_) * tick_; }
  /// Ice that moves what it meets and is not moved by it goes by the tick, and joins nothing.
  bool is_heavy(BodyIndex i) const { return is_held(bodies_, i) || bodies_.mass[i] >= heavy_; }
  bool is_fixed(BodyIndex i) const {
    const std::int32_t place = components_.node_of[i];
    return place >= 0 ? nodes_[place].is_fixed : population_.is_hull(i) || is_heavy(i);
  }
  void find_heavy();
  void clear();
  Node new_node(BodyIndex i) const;
  void place_corners(Node& node);
  std::int32_t node(BodyIndex i);
  void add_nodes_of_awake();
  std::span<const Point> corners(const Node& node) const;
  bool may_touch(std::int32_t a, std::int32_t b, double speed) const;
  void shorten(std::int32_t i, double way, double speed);
  /// Two bodies that may touch in the block.
  struct Meeting {
    std::int32_t a = 0, b = 0;  ///< nodes
    double speed = 0;           ///< [m/s]
    double longest = 0;         ///< of Touch
  };
  std::optional<Meeting> meeting_of(std::int32_t a, std::int32_t b, const dynamics::Pair* pair) const;
  void enter(const Meeting& meeting);
  void see(BodyIndex a, BodyIndex b, const dynamics::Pair* pair);
  void see_pairs();
  int level_of(double time) const;
  void find_partners();
  void follow_partners();
  void find_along();
  std::size_t enter(BodyIndex i);
  std::int64_t ticks_within_reach() const;
  void see_farther(BodyIndex i);

  const Setup& setup_;
  Population& population_;
  dynamics::Bodies& bodies_;
  Components& components_;
  std::vector<Node>& nodes_;
  std::int64_t ticks_;
  int threads_;
  double tick_;
  int least_;           ///< level above 0: one tick is a longer step only where a tick has parts
  double heavy_ = 0;    ///< [kg]
  double fastest_ = 0;  ///< of any body's rim [m/s]
  struct SeenPairs {
    std::vector<Meeting> meetings;
    std::vector<const dynamics::Pair*> others;  ///< of a body that has no node yet
  };
  std::vector<SeenPairs> seen_;  ///< by chunks of the pairs
};

/// How many ticks may pass before any body comes too far.
std::int64_t Assignment::ticks_within_reach() const {
  const double most = kMostAhead / (kAhead * fastest_ * tick_);
  return most < static_cast<double>(ticks_) ? static_cast<std::int64_t>(most) : ticks_;
}

void Assignment::find_heavy() {
  std::vector<double> masses;
  for (const BodyIndex i : population_.awake)
    if (!population_.is_hull(i)) masses.push_back(bodies_.mass[i]);
  heavy_ = std::numeric_limits<double>::infinity();
  if (masses.empty()) return;
  const auto middle = masses.begin() + static_cast<std::ptrdiff_t>(masses.size() / 2);
  std::ranges::nth_element(masses, middle);
  heavy_ = kHeavy * *middle;
}

void Assignment::clear() {
  for (const Node& node : nodes_) components_.node_of[node.body] = -1;
  components_.node_of.resize(static_cast<std::size_t>(bodies_.size()), -1);
  nodes_.clear();
  components_.touching.clear();
  population_.moving_along.clear();
  for (auto& list : components_.of_level) list.clear();
}

/// Without the places of its corners.
Components::Node Assignment::new_node(BodyIndex i) const {
  Node node;
  node.body = i;
  node.is_fixed = population_.is_hull(i) || is_heavy(i);
  node.velocity = bodies_.velocity[i];
  node.angular_velocity = bodies_.angular_velocity[i];
  node.turning = std::abs(node.angular_velocity) * bodies_.bounding_radius[i];
  node.longest = time();
  const std::size_t corners = bodies_.boundary[i]->edges.vertices.size();
  if (population_.is_hull(i) || corners <= kFewCorners) node.count = corners;
  return node;
}

void Assignment::place_corners(Node& node) {
  const BodyIndex i = node.body;
  if (node.count == 0) {
    node.box = geometry::grown({bodies_.position[i], bodies_.position[i]}, bodies_.bounding_radius[i]);
    return;
  }
  const geometry::Pose pose = water_from_body(bodies_, i);
  const auto& vertices = bodies_.boundary[i]->edges.vertices;
  node.box = {transform(pose, vertices.front()), transform(pose, vertices.front())};
  for (std::size_t k = 0; k < node.count; ++k) {
    const Point corner = components_.corners[node.first + k] = transform(pose, vertices[k]);
    extend(node.box, corner);
  }
}

std::int32_t Assignment::node(BodyIndex i) {
  std::int32_t& place = components_.node_of[i];
  if (place >= 0) return place;
  place = static_cast<std::int32_t>(nodes_.size());
  Node& node = nodes_.emplace_back(new_node(i));
  node.first = components_.corners.size();
  components_.corners.resize(node.first + node.count);
  place_corners(node);
  return place;
}

void Assignment::add_nodes_of_awake() {
  const std::vector<BodyIndex>& awake = population_.awake;
  nodes_.resize(awake.size());
  dynamics::for_chunks(awake.size(), kPerChunk, threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      components_.node_of[awake[k]] = static_cast<std::int32_t>(k);
      nodes_[k] = new_node(awake[k]);
    }
  });
  std::size_t corners = 0;
  for (Node& node : nodes_) node.first = std::exchange(corners, corners + node.count);
  components_.corners.resize(corners);
  dynamics::for_chunks(awake.size(), kPerChunk, threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) place_corners(nodes_[k]);
  });
}

std::span<const Point> Assignment::corners(const Node& node) const {
  return {components_.corners.data() + node.first, node.count};
}

bool Assignment::may_touch(std::int32_t a, std::int32_t b, double speed) const {
  const double way = kAhead * speed * time() + kSlack;
  if (!overlaps(grown(nodes_[a].box, way), nodes_[b].box)) return false;
  if (nodes_[a].count == 0 || nodes_[b].count == 0) return true;
  return !Apart(corners(nodes_[a]), corners(nodes_[b]), way).are();
}

void Assignment::shorten(std::int32_t i, double way, double speed) {
  double& longest = nodes_[i].longest;
  if (speed * longest > way) longest = way / speed;
}

/// What a pair's contacts pressed with in their last step [N].
double force_of(std::span<const dynamics::PersistentContact> records) {
  double force = 0;
  for (const dynamics::PersistentContact& record : records) {
    const double time = record.last_substep;
    if (time > 0) force += (record.last_impulse[0] + record.last_impulse[1]) / time;
  }
  return force;
}

/// Of two bodies, and what the contact search keeps of them where they are a pair.
std::optional<Assignment::Meeting> Assignment::meeting_of(std::int32_t a, std::int32_t b,
                                                          const dynamics::Pair* pair) const {
  const double speed = relative_speed(nodes_[a], nodes_[b]);
  if (!may_touch(a, b, speed)) return std::nullopt;
  const double force = pair != nullptr ? force_of(pair->records()) : 0;
  const double mass = std::min(bodies_.mass[nodes_[a].body], bodies_.mass[nodes_[b].body]);
  return Meeting{a, b, speed, force > 0 ? kPressedSpeed * mass / force : time()};
}

void Assignment::enter(const Meeting& meeting) {
  const BodyIndex a = nodes_[meeting.a].body, b = nodes_[meeting.b].body;
  const auto goes_by_tick_beside = [&](BodyIndex other, BodyIndex i) {
    return population_.is_hull(other) ||
           (is_heavy(other) && !is_held(bodies_, other) && bodies_.mass[other] < kHeavier * bodies_.mass[i]);
  };
  if (goes_by_tick_beside(a, b)) return shorten(meeting.b, 0, 1);
  if (goes_by_tick_beside(b, a)) return shorten(meeting.a, 0, 1);
  const double way = most_way_of_floes(setup_.scene.contact, std::min(bodies_.thickness[a], bodies_.thickness[b]));
  for (const std::int32_t i : {meeting.a, meeting.b})
    if (!nodes_[i].is_fixed) shorten(i, way, meeting.speed);
  if (is_fixed(a) || is_fixed(b) || bodies_.is_awake[a] == 0 || bodies_.is_awake[b] == 0) return;
  components_.touching.push_back({meeting.a, meeting.b, meeting.longest});
}

void Assignment::see(BodyIndex a, BodyIndex b, const dynamics::Pair* pair) {
  if (is_fixed(a) && is_fixed(b)) return;
  const std::int32_t of_a = node(a);
  const std::int32_t of_b = node(b);
  if (const auto meeting = meeting_of(of_a, of_b, pair)) enter(*meeting);
}

/// Those between bodies awake side by side; what they come to is entered chunk by chunk, the same by any number of
/// threads.
void Assignment::see_pairs() {
  const std::span<const dynamics::Pair> pairs = population_.pairs.pairs();
  seen_.resize(dynamics::chunk_count(pairs.size(), kPerChunk));
  dynamics::for_chunks(pairs.size(), kPerChunk, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    SeenPairs& seen = seen_[chunk];
    for (const dynamics::Pair& pair : pairs.subspan(begin, end - begin)) {
      if (pair.is_dropped || (is_fixed(pair.a) && is_fixed(pair.b))) continue;
      const std::int32_t a = components_.node_of[pair.a], b = components_.node_of[pair.b];
      if (a < 0 || b < 0)
        seen.others.push_back(&pair);
      else if (const auto meeting = meeting_of(a, b, &pair))
        seen.meetings.push_back(*meeting);
    }
  });
  for (const SeenPairs& seen : seen_) {
    for (const Meeting& meeting : seen.meetings) enter(meeting);
    for (const dynamics::Pair* pair : seen.others) see(pair->a, pair->b, pair);
  }
}

/// What comes farther in the block than the contact search has pairs of.
void Assignment::see_farther(BodyIndex i) {
  const double way = kAhead * rim_speed_of(bodies_, i) * time();
  if (way <= kAheadInPairs) return;
  const double most = way + kAhead * fastest_ * time() + kSlack;
  population_.pairs.for_bodies_near(grown(nodes_[node(i)].box, most), [&](BodyIndex other) {
    if (other != i) see(std::min(i, other), std::max(i, other), nullptr);
  });
}

int Assignment::level_of(double time) const {
  const double ticks = time / tick_ * (1 + 1e-9);
  if (ticks >= static_cast<double>(ticks_)) return level_of_block(setup_);
  const int level = std::min(setup_.levels + 1, static_cast<int>(std::bit_width(static_cast<unsigned>(ticks))));
  return level < least_ ? 0 : level;
}

void Assignment::find_partners() {
  auto& first = components_.first_partner;
  first.assign(nodes_.size() + 1, 0);
  for (const auto& touch : components_.touching) {
    ++first[touch.a];
    ++first[touch.b];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  components_.partners.resize(2 * components_.touching.size());
  for (std::int32_t i = 0; i < std::ssize(components_.touching); ++i) {
    const auto& touch = components_.touching[i];
    components_.partners[--first[touch.a]] = {touch.b, i};
    components_.partners[--first[touch.b]] = {touch.a, i};
  }
}

/// No body takes steps of more than twice those of another that it may touch: what pushes the one reaches the other
/// when it has shorter steps already.
void Assignment::follow_partners() {
  find_partners();
  std::vector<std::vector<std::int32_t>> of_rank(static_cast<std::size_t>(kHops + level_of_block(setup_)));
  for (std::int32_t i = 0; i < std::ssize(nodes_); ++i) {
    nodes_[i].rank = nodes_[i].level == 0 ? 0 : kHops + nodes_[i].level - least_;
    of_rank[nodes_[i].rank].push_back(i);
  }
  const auto level_at = [this](int rank) { return rank < kHops ? 0 : rank - kHops + least_; };
  for (int rank = 0; rank < std::ssize(of_rank); ++rank) {
    for (std::size_t k = 0; k < of_rank[rank].size(); ++k) {
      const std::int32_t i = of_rank[rank][k];
      if (nodes_[i].rank != rank) continue;
      for (std::int32_t p = components_.first_partner[i]; p < components_.first_partner[i + 1]; ++p) {
        const auto [other, touch] = components_.partners[p];
        const int apart = level_of(components_.touching[touch].longest);
        const int most = level_at(rank) < apart ? rank + 1 : rank;
        if (nodes_[other].rank <= most) continue;
        nodes_[other].rank = most;
        of_rank[most].push_back(other);
      }
    }
  }
  for (Node& node : nodes_) node.level = level_at(node.rank);
  for (Node& node : nodes_) {
    if (node.level == 0) continue;
    if (ticks_of_level(node.level) >= ticks_) node.level = level_of_block(setup_);
    node.longest = node.level == level_of_block(setup_) ? time() : tick_ * ticks_of_level(node.level);
  }
}

/// What takes longer steps than another that it may touch has to be where that one is.
void Assignment::find_along() {
  for (const auto& [a, b, longest] : components_.touching) {
    if (nodes_[a].level > nodes_[b].level) nodes_[a].is_along = true;
    if (nodes_[b].level > nodes_[a].level) nodes_[b].is_along = true;
  }
}

/// Gives it its level. Returns whether it takes steps of several ticks.
std::size_t Assignment::enter(BodyIndex i) {
  const Node& node = nodes_[components_.node_of[i]];
  const bool is_of_partners = !population_.is_hull(i) && is_heavy(i);
  bodies_.level[i] = is_of_partners ? kNoLevel : static_cast<std::uint8_t>(node.level);
  components_.of_level[static_cast<std::size_t>(node.level)].push_back(i);
  if (node.is_along) population_.moving_along.push_back(i);
  return node.level > 0 ? 1 : 0;
}

std::int64_t Assignment::sort() {
  for (const BodyIndex i : population_.awake) fastest_ = std::max(fastest_, rim_speed_of(bodies_, i));
  ticks_ = std::min(ticks_, ticks_within_reach());
  if (ticks_ < 2) return 1;
  population_.pairs.update(bodies_, population_.awake, kAhead * static_cast<double>(ticks_) * tick_, threads_);
  clear();
  find_heavy();
  add_nodes_of_awake();
  see_pairs();
  for (const BodyIndex i : population_.awake) see_farther(i);
  for (Node& node : nodes_) node.level = node.is_fixed ? 0 : level_of(node.longest);
  follow_partners();
  find_along();
  std::size_t coarse = 0;
  for (const BodyIndex i : population_.awake) coarse += enter(i);
  population_.pairs.note_levels(bodies_);
  const bool is_worth_it = static_cast<double>(coarse) >= kLeastShare * static_cast<double>(population_.awake.size());
  return coarse > 0 && is_worth_it ? ticks_ : 1;
}

/// To the next tick that is common to all, by what is recorded and by when floes are put to rest.
std::int64_t ticks_to_common(const Setup& setup, const Clock& clock) {
  const auto left = [&](std::int64_t every) { return every - clock.steps % every; };
  return std::min(left(setup.steps_per_rest), left(setup.steps_per_frame));
}

}  // namespace

std::int64_t begin_block(const Setup& setup, Clock& clock, std::int64_t most, int threads, Population& population,
                         Components& components) {
  if (setup.levels == 0 || clock.steps < clock.next_levels) return 1;
  if (clock.changing) return 1;  // the water frame's velocity changes with the tick, for all bodies at once
  const std::int64_t ticks = std::min({most, longest_block(setup), ticks_to_common(setup, clock)});
  if (ticks < 2) return 1;
  const std::int64_t block = Assignment(setup, clock, ticks, threads, population, components).sort();
  if (block == 1) {
    clock.next_levels = clock.steps + kWait;
    end_block(population);
  }
  return block;
}

void end_block(Population& population) {
  population.level = Population::kAllDue;
  population.moving_along.clear();
}

void begin_longer(const Population& population, int level, Components& components) {
  const dynamics::Bodies& bodies = population.bodies;
  for (const BodyIndex i : population.moving_along) {
    if (bodies.level[i] != level) continue;
    Components::Node& node = components.nodes[components.node_of[i]];
    node.velocity = bodies.velocity[i];
    node.angular_velocity = bodies.angular_velocity[i];
  }
}

std::vector<BodyIndex> find_struck(const Setup& setup, const Population& population, const Components& components) {
  const dynamics::Bodies& bodies = population.bodies;
  std::vector<BodyIndex> struck;
  for (const BodyIndex i : population.moving_along) {
    const Components::Node& node = components.nodes[components.node_of[i]];
    const double speed = length(bodies.velocity[i] - node.velocity) +
                         std::abs(bodies.angular_velocity[i] - node.angular_velocity) * bodies.bounding_radius[i];
    const double way = kStruckWay * most_way_of_floes(setup.scene.contact, bodies.thickness[i]);
    if (speed > kStruckSpeed || speed * node.longest > way) struck.push_back(i);
  }
  return struck;
}

void move_along(BodyIndex i, Population& population, Components& components) {
  Components::Node& node = components.nodes[components.node_of[i]];
  node.is_along = true;
  node.velocity = population.bodies.velocity[i];
  node.angular_velocity = population.bodies.angular_velocity[i];
  insert_into(population.moving_along, i);
}

void take_out_of_level(BodyIndex i, Population& population, Components& components) {
  Components::Node& node = components.nodes[components.node_of[i]];
  erase_from(components.of_level[population.bodies.level[i]], i);
  erase_from(population.moving_along, i);
  insert_into(components.of_level[0], i);
  population.bodies.level[i] = 0;
  population.pairs.note_level(population.bodies, i);
  node.level = 0;
  node.is_along = false;
}

void drop_unforeseen(const dynamics::Bodies& bodies, const Components& components,
                     std::vector<dynamics::Contact>& contacts, std::vector<BodyIndex>& met) {
  std::erase_if(contacts, [&](const dynamics::Contact& c) {
    const auto a = bodies.level[c.a];
    const auto b = bodies.level[c.b];
    if (a == b || a == kNoLevel || b == kNoLevel) return false;
    const BodyIndex longer = a > b ? c.a : c.b;
    if (moves_along(components, longer)) return false;
    met.push_back(longer);
    return true;
  });
}

}  // namespace polynya::simulation
