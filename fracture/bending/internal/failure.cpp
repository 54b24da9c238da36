#include "fracture/bending/internal/failure.hpp"

#include "fracture/bending/peak.hpp"

namespace polynya::fracture {
BisectorState bisector_state(const WedgeModes& modes, const Eigen::VectorXd& amplitudes) {
  return {modes.radial_moment * amplitudes, modes.hoop_moment * amplitudes};
}

double peak_moment(const WedgeModes& modes, const Eigen::VectorXd& moments) {
  return find_peak(modes.radii, {moments.data(), modes.radii.size()}).value;
}

double cusp_radius(const WedgeModes& modes, const Eigen::VectorXd& radial) {
  return find_flat_peak(modes.radii, {radial.data(), modes.radii.size()});
}

}  // namespace polynya::fracture
