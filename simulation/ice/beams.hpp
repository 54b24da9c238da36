#pragma once

#include <vector>

#include "fracture/beam.hpp"
#include "geometry/contact/crack_path.hpp"

namespace polynya::simulation {

struct Population;
struct Setup;
struct Step;
struct StepData;

/// A section of a floe at right angles to its long axis.
struct BeamPart {
  fracture::BeamSection section;
  fracture::PlaneMoments before;  ///< of the floe up to the section
  geometry::CrackPath path;       ///< along the section, in the floe's frame
};

/// A slender floe as a beam. Of its shape alone, and in no state.
struct BeamShape {
  geometry::Pose frame_from_body;  ///< origin at the centre of mass, x along its length
  fracture::PlaneMoments moments;
  double length = 0;            ///< of the rectangle of its moments [m]
  double elastic_share = 1;     ///< of the rigid beam's moment on the water
  std::vector<BeamPart> parts;  ///< from end to end
  double least_width = 0;       ///< of those [m]
};

/// Enters among the splits the floes below κ l that the forces of solved contacts break across as beams, by floe. By
/// all bodies that press a floe together: those that it lies on bear as well.
void find_broken_beams(const Setup& setup, const Step& step, const Population& population, StepData& data);

}  // namespace polynya::simulation
