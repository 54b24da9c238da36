#include "fracture/bending/internal/failure.hpp"

#include "fracture/bending/peak.hpp"

namespace polynya::fracture {

BisectorState bisector_state(const WedgeModes& modes, const Eigen::VectorXd& amplitudes) {
  return {modes.radial_moment * amplitudes, modes.hoop_moment * amplitudes};
}

double peak_radial(const WedgeModes& modes, const BisectorState& state) {
  return find_peak(modes.radii, {state.radial.data(), modes.radii.size()}).value;
}

double peak_hoop(const WedgeModes& modes, const BisectorState& state) {
  return find_peak(modes.hoop_radii, {state.hoop.data(), modes.hoop_radii.size()}).value;
}

double cusp_radius(const WedgeModes& modes, const BisectorState& state) {
  return find_flat_peak(modes.radii, {state.radial.data(), modes.radii.size()});
}

}  // namespace polynya::fracture
