#include "dynamics/contact/contact_islands.hpp"

#include <algorithm>
#include <span>

namespace polynya::dynamics {
namespace {

/// Smallest number of contacts of an island that is solved in halves. Smaller: handing the halves to threads takes as
/// long as solving them. Larger: more islands are solved by one thread. The number changes the order of the sweeps, and
/// with it results within the solver's tolerance.
constexpr std::uint32_t kLeastDivided = 192;

}  // namespace

inline std::int32_t ContactIslands::place_of(BodyIndex body) {
  std::int32_t& place = place_of_body_[body];
  if (place < 0) {
    place = static_cast<std::int32_t>(touched_.size());
    touched_.push_back(body);
    parent_.push_back(place);
  }
  return place;
}

inline std::int32_t ContactIslands::root_of(std::int32_t place) {
  while (parent_[place] != place) place = parent_[place] = parent_[parent_[place]];
  return place;
}

/// Divides an island by a line across its longer side, with the same number of contacts on both sides.
void ContactIslands::divide(const Bodies& bodies, const std::vector<Contact>& contacts, Island& island) {
  const std::span own = std::span(order_).subspan(island.first, island.count);
  geometry::Box box{contacts[own[0]].ends[0], contacts[own[0]].ends[0]};
  for (const std::uint32_t i : own) extend(box, contacts[i].ends[0]);
  const bool is_along_x = box.high.x - box.low.x > box.high.y - box.low.y;
  const auto coordinate = [&](geometry::Point p) { return is_along_x ? p.x : p.y; };
  coordinates_.clear();
  for (const std::uint32_t i : own) coordinates_.push_back(coordinate(contacts[i].ends[0]));
  const auto median = coordinates_.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
  std::ranges::nth_element(coordinates_, median);
  const auto side = [&](BodyIndex i, BodyIndex other) {
    const BodyIndex moved = bodies.inverse_mass[i] != 0 ? i : other;
    return coordinate(bodies.position[moved]) < *median ? 0 : 1;
  };
  const auto is_on = [&](int which) {
    return [&, which](std::uint32_t i) {
      const Contact& c = contacts[i];
      return side(c.a, c.b) == which && side(c.b, c.a) == which;
    };
  };
  const auto second = std::stable_partition(own.begin(), own.end(), is_on(0));
  const auto between = std::stable_partition(second, own.end(), is_on(1));
  island.halves[0] = static_cast<std::uint32_t>(second - own.begin());
  island.halves[1] = static_cast<std::uint32_t>(between - second);
}

void ContactIslands::find(const Bodies& bodies, const std::vector<Contact>& contacts) {
  touched_.clear();
  parent_.clear();
  islands_.clear();
  place_of_body_.resize(static_cast<std::size_t>(bodies.size()), -1);
  places_.resize(2 * contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    const std::int32_t a = places_[2 * i] = place_of(c.a);
    const std::int32_t b = places_[2 * i + 1] = place_of(c.b);
    if (bodies.inverse_mass[c.a] == 0 || bodies.inverse_mass[c.b] == 0) continue;
    const std::int32_t root_a = root_of(a);
    const std::int32_t root_b = root_of(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }
  island_of_.assign(touched_.size(), -1);
  island_of_contact_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const bool is_a_free = bodies.inverse_mass[contacts[i].a] != 0;
    std::int32_t& island = island_of_[root_of(places_[2 * i + (is_a_free ? 0 : 1)])];
    if (island < 0) {
      island = static_cast<std::int32_t>(islands_.size());
      islands_.push_back({});
    }
    island_of_contact_[i] = island;
    ++islands_[island].count;
  }
  std::uint32_t first = 0;
  for (Island& island : islands_) {
    island.first = first;
    first += island.count;
    island.count = 0;  // counted again while filling
  }
  order_.resize(contacts.size());
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    Island& island = islands_[island_of_contact_[i]];
    order_[island.first + island.count++] = i;
  }
  for (Island& island : islands_) {
    island.halves[0] = island.count;
    if (island.count >= kLeastDivided) divide(bodies, contacts, island);
  }
  for (const BodyIndex body : touched_) place_of_body_[body] = -1;
}

}  // namespace polynya::dynamics
