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

/// The force of one contact of a hull with ice, followed from step to step until the contact ends.
struct LoadTrack {
  std::int64_t id = 0;      ///< number of the track, which the record of the contact stores
  bool is_rising = true;    ///< true if the force has risen to more than twice its smallest value since the last peak
  double force = 0;         ///< force that the gauge of RecordSettings::peak_response shows [N]
  double least = 0;         ///< smallest value of it since the last peak [N]
  double largest = 0;       ///< largest value of it while it is rising [N]
  double time = 0;          ///< time of the largest value [s]
  ContactState at_largest;  ///< state of the contact at that time, without its place on the waterline
  geometry::Point point_in_hull;    ///< point of the hull on which the force then acted [m]
  PeakEnd ending = PeakEnd::kSlip;  ///< event of the ice since then, which ends the peak
  bool is_seen = false;             ///< true if the contact exists in the present step
};

/// The tracks of all contacts of hulls with ice, and the numbers of their peaks.
struct LoadPeaks {
  std::vector<LoadTrack> tracks;  ///< tracks in the order of their ids
  /// Number of tracks since the start of the run; the last id.
  std::int64_t tracks_so_far = 0;
  PeakCounts counts;
};

/// Returns the hull or floe of a body, in the form of records.
ContactState::Body contact_body(const Population& population, dynamics::BodyIndex body);

/// Returns the state of a contact in the step in which it was found, in the form of records, without its place on the
/// waterline. `slope` is the hull's slope at the contact; null between floes.
ContactState state_of(const Setup& setup, const Step& step, const Population& population,
                      const dynamics::Contact& contact, const HullSlope* slope);

/// Sets the place on the hull's waterline at which the force acts. `point_in_hull` is that point in the hull's frame
/// [m].
void place_on_waterline(const Setup& setup, geometry::Point point_in_hull, ContactState& state);

/// Updates the tracks by the forces of the step, and records the peaks that have ended. Must be called before the hulls
/// move, because contacts are in the positions at which they were found.
void follow_loads(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                  Books books);

}  // namespace polynya::simulation
