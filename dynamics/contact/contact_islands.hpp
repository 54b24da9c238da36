#pragma once

#include <cstdint>
#include <vector>

#include "dynamics/contact/contact.hpp"

namespace polynya::dynamics {

/// A range of contacts in the order of the islands.
struct ContactRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Contacts [first, first + count) of the order: contacts of bodies that touch each other, directly or through others.
/// An island of 192 contacts or more has two halves that share no moving body, and then the contacts between them. In
/// other islands the first half contains all contacts.
struct Island {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t halves[2] = {0, 0};  ///< contacts in each half

  ContactRange all() const { return {first, first + count}; }
  ContactRange first_half() const { return {first, first + halves[0]}; }
  ContactRange second_half() const { return {first + halves[0], first + halves[0] + halves[1]}; }
  ContactRange between() const { return {first + halves[0] + halves[1], first + count}; }
  bool is_divided() const { return halves[0] < count; }
};

/// The contacts of one step, grouped into islands. A body with prescribed motion does not connect islands.
class ContactIslands {
 public:
  /// Finds the islands, in the order of their first contact. Contacts keep their order within each part of an island.
  void find(const Bodies& bodies, const std::vector<Contact>& contacts);

  const std::vector<Island>& islands() const { return islands_; }
  const std::vector<std::uint32_t>& order() const { return order_; }  ///< contacts, island by island
  /// The bodies that touch others, each once; place_of_a and place_of_b give the places of contact i's bodies in this
  /// list.
  const std::vector<BodyIndex>& bodies_touched() const { return touched_; }
  std::int32_t place_of_a(std::size_t contact) const { return places_[2 * contact]; }
  std::int32_t place_of_b(std::size_t contact) const { return places_[2 * contact + 1]; }

 private:
  std::int32_t place_of(BodyIndex body);
  std::int32_t root_of(std::int32_t place);
  void divide(const Bodies& bodies, const std::vector<Contact>& contacts, Island& island);

  std::vector<BodyIndex> touched_;
  std::vector<std::int32_t> places_;         // two for each contact
  std::vector<std::int32_t> place_of_body_;  // −1 between the calls
  std::vector<std::int32_t> parent_;         // union-find over the touched
  std::vector<std::int32_t> island_of_;      // by root of union-find
  std::vector<std::int32_t> island_of_contact_;
  std::vector<std::uint32_t> order_;
  std::vector<Island> islands_;
  std::vector<double> coordinates_;  // coordinates of an island's contacts, sorted up to their median
};

}  // namespace polynya::dynamics
