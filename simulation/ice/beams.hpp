#pragma once

#include <vector>

#include "fracture/beam.hpp"
#include "geometry/contact/crack_path.hpp"

namespace polynya::simulation {

struct Population;
struct Setup;
struct Step;
struct StepData;

/// A section of a floe at right angles to its long axis, where the floe may break.
struct BeamPart {
  fracture::BeamSection section;
  fracture::PlaneMoments before;  ///< moments of the part of the floe before the section
  geometry::CrackPath path;       ///< crack along the section, in the floe's body frame
};

/// A slender floe as a beam. It depends on the shape of the floe alone, so it is computed once per floe and not stored
/// in saved states.
struct BeamShape {
  geometry::Pose frame_from_body;  ///< frame of the beam: origin at the centre of mass, x along the long axis
  /// Moments of the whole floe in the beam's frame.
  fracture::PlaneMoments moments;
  double length = 0;            ///< length of the rectangle with the same area and second moment [m]
  double elastic_share = 1;     ///< bending moment of the elastic beam on the water / that of a rigid one [-]
  std::vector<BeamPart> parts;  ///< sections at equal distances, from end to end
  double least_width = 0;       ///< smallest width of these sections [m]
};

/// Adds to StepData::splits the slender floes with √area < κ l that the forces of solved contacts break across as
/// beams. The forces of all bodies at a floe act together, because bodies on which the floe rests bend it too. At most
/// one break is added for each floe, in the order of the floes.
void find_broken_beams(const Setup& setup, const Step& step, const Population& population, StepData& data);

}  // namespace polynya::simulation
