#pragma once

#include <cstdint>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::simulation {

struct Step;
struct HullSlope;
struct Population;
struct Setup;
struct Books;
struct StepData;

/// The force of one contact of a hull with ice, followed from step to step until it parts.
struct LoadTrack {
  std::int64_t id = 0;              ///< that the contact's record has
  bool is_rising = true;            ///< it has come to more than twice its least since the last peak
  double force = 0;                 ///< the contact's, through the record's response [N]
  double least = 0;                 ///< of it since the last peak [N]
  double largest = 0;               ///< while it is rising [N]
  double time = 0;                  ///< of the largest [s]
  ContactState at_largest;          ///< but for its place on the waterline
  geometry::Point point_in_hull;    ///< where the largest acted [m]
  PeakEnd ending = PeakEnd::kSlip;  ///< what has happened to its ice since
  bool is_seen = false;             ///< in the present step
};

/// The peaks of all hulls' contacts with ice.
struct LoadPeaks {
  std::vector<LoadTrack> tracks;  ///< by id
  std::int64_t tracks_so_far = 0;
  PeakCounts counts;
};

/// A hull or a floe, as records have it.
ContactState::Body contact_body(const Population& population, dynamics::BodyIndex body);

/// What a contact is, as records have it, but for its place on the waterline. In the step it is found in.
ContactState state_of(const Setup& setup, const Step& step, const Population& population,
                      const dynamics::Contact& contact, const HullSlope* slope);

/// Enters where its force acts on the hull's waterline, by that point in the hull's frame.
void place_on_waterline(const Setup& setup, geometry::Point point_in_hull, ContactState& state);

/// Enters the forces of the step, and records the peaks that have ended in it. While the hulls are where they were
/// when its contacts were found.
void follow_loads(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                  Books books);

}  // namespace polynya::simulation
