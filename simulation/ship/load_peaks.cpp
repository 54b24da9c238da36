#include "simulation/ship/load_peaks.hpp"

#include <algorithm>

#include "elementary/elementary.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// Returns the thickness of the ice at a contact: that of the floe, or of the thinner one of two floes; 0 if two hulls
/// touch [m].
double thickness_at(const Setup& setup, const Population& population, const Contact& c) {
  if (population.is_hull(c.b)) return 0;
  const double of_b = ice_of_body(setup, population, c.b).thickness;
  return population.is_hull(c.a) ? of_b : std::min(of_b, ice_of_body(setup, population, c.a).thickness);
}

/// Returns the event of a contact's ice in this step: a bend, a split, a tilt because the floe resists no more, or none
/// (PeakEnd::kSlip).
PeakEnd fate_of(const Population& population, const StepData& data, const Contact& c) {
  const FloeId floe = population.floe_of(c.b);
  for (const PendingFracture& pending : data.fractures) {
    if (pending.floe == floe && !c.record->was_refused)
      return pending.failure == fracture::Failure::kBend ? PeakEnd::kBend : PeakEnd::kSplit;
  }
  const auto goes_under = [&](const PendingSubmersion& pending) { return pending.floe == floe; };
  return c.gives_way || std::ranges::any_of(data.submersions, goes_under) ? PeakEnd::kTilt : PeakEnd::kSlip;
}

/// Returns the track with an id, or null if there is none or another contact has it in this step.
LoadTrack* track_of(std::vector<LoadTrack>& tracks, std::int64_t id) {
  const auto at = std::ranges::lower_bound(tracks, id, {}, &LoadTrack::id);
  return at != tracks.end() && at->id == id && !at->is_seen ? &*at : nullptr;
}

/// Returns the track of a contact, which is created if it has none. If an overlap divides into several, the first of
/// them continues the track.
LoadTrack& track_at(LoadPeaks& peaks, dynamics::PersistentContact& record) {
  if (record.load_track != 0) {
    if (LoadTrack* known = track_of(peaks.tracks, record.load_track)) return *known;
  }
  record.load_track = ++peaks.tracks_so_far;
  peaks.tracks.push_back({.id = record.load_track, .at_largest = {}, .point_in_hull = {}});
  return peaks.tracks.back();
}

/// Records the peak of a track, or counts it if it is below the least peak or beyond the largest number of peaks.
void record_peak(const Setup& setup, const LoadTrack& track, LoadPeaks& peaks, Journal& journal) {
  if (track.largest < setup.scene.record.least_peak) {
    ++peaks.counts.below;
  } else if (peaks.counts.recorded == kMostPeaks) {
    ++peaks.counts.beyond;
    peaks.counts.largest_beyond = std::max(peaks.counts.largest_beyond, track.largest);
  } else {
    ++peaks.counts.recorded;
    LoadPeak peak{track.time, track.at_largest};
    place_on_waterline(setup, track.point_in_hull, peak.state);
    peak.state.ended_by = track.ending;
    journal.peaks.push_back(peak);
  }
}

/// Returns the fraction of the difference to the contact's force that the gauge covers in a step, by dF/dt = (force −
/// F)/τ [-].
double response_in(const Setup& setup, const Step& step) {
  const double time_constant = setup.scene.record.peak_response;
  return time_constant > 0 ? -elementary::expm1(-step.length / time_constant) : 1;
}

/// Updates a track by the force of a step [N]. Returns true if the gauge shows a new largest value.
bool rises(double force, double response, LoadTrack& track) {
  track.force += response * (force - track.force);
  if (!track.is_rising) {
    track.least = std::min(track.least, track.force);
    track.is_rising = track.force > 2 * track.least;
    if (track.is_rising) track.largest = 0;
  }
  return track.is_rising && track.force > track.largest;
}

}  // namespace

ContactState::Body contact_body(const Population& population, BodyIndex body) {
  return population.is_hull(body) ? ContactState::Body{body, kNoFloe}
                                  : ContactState::Body{-1, population.floe_of(body)};
}

ContactState state_of(const Setup& setup, const Step& step, const Population& population, const Contact& c,
                      const HullSlope* slope) {
  const double dt = step.length;
  ContactState state;
  state.on = contact_body(population, c.a);
  state.by = contact_body(population, c.b);
  state.point_in_world = c.centre_of_pressure() + step.begin.drift;
  state.force = -1 / dt * c.impulse_on_b();
  state.depth = c.depth;
  state.is_crushing = c.total_normal_impulse() > 0 && c.is_at_limit;
  state.width = c.width;
  state.thickness = thickness_at(setup, population, c);
  state.height = slope != nullptr ? slope->height : state.thickness;
  const double area = state.width * state.height;
  if (area > 0) state.pressure = c.total_normal_impulse() / dt / area;
  return state;
}

void place_on_waterline(const Setup& setup, geometry::Point point_in_hull, ContactState& state) {
  const Waterline& waterline = setup.waterlines[static_cast<std::size_t>(state.on.ship)];
  state.arc = arc_at(waterline, point_in_hull);
  state.station = waterline.stem_x - point_in_hull.x;
}

void follow_loads(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                  Books books) {
  LoadPeaks& peaks = books.accounts.load_peaks;
  if (setup.scene.record.contacts == RecordedContacts::kNone) return;
  for (LoadTrack& track : peaks.tracks) track.is_seen = false;
  const double response = response_in(setup, step);
  for (std::size_t i = 0; i < data.slopes.size(); ++i) {
    const Contact& c = data.contacts[i];
    const double force = c.step_share * c.total_normal_impulse() / step.length;
    if (population.is_hull(c.b) || (force == 0 && c.record->load_track == 0)) continue;
    LoadTrack& track = track_at(peaks, *c.record);
    track.is_seen = true;
    if (rises(force, response, track)) {
      // Force that the gauge shows / whole force of the contact in this step.
      const double share = c.step_share * track.force / force;
      track.largest = track.force;
      track.time = step.end.time;
      track.at_largest = state_of(setup, step, population, c, &data.slopes[i]);
      track.at_largest.force = share * track.at_largest.force;
      track.at_largest.pressure *= share;
      track.point_in_hull =
          inverse_transform(dynamics::water_from_body(population.bodies, c.a), c.centre_of_pressure());
      track.ending = PeakEnd::kSlip;
    }
    const PeakEnd fate = fate_of(population, data, c);
    if (fate != PeakEnd::kSlip) track.ending = fate;
    if (track.is_rising && track.force < track.largest / 2) {
      record_peak(setup, track, peaks, books.journal);
      track.is_rising = false;
      track.least = track.force;
    }
  }
  for (const LoadTrack& track : peaks.tracks)
    if (!track.is_seen && track.is_rising && track.largest > 0) record_peak(setup, track, peaks, books.journal);
  std::erase_if(peaks.tracks, [](const LoadTrack& track) { return !track.is_seen; });
}

}  // namespace polynya::simulation
