#include <algorithm>
#include <cmath>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

void find_circle_manifolds(const Covered& a, const Covered& b, const Pose& a_from_b,
                           const std::vector<NearPair>& circle_pairs,
                           std::vector<ContactManifold>& manifolds) {
  for (const NearPair pair : circle_pairs) {
    const ContactCircle& ca = a.cover.circles[pair.a];
    const ContactCircle& cb = b.cover.circles[pair.b];
    const Vector line = transform(a_from_b, cb.centre) - ca.centre;
    const double centres = length(line);
    const double depth = ca.radius + cb.radius - centres;
    if (depth <= 0 || centres == 0) continue;
    ContactManifold manifold;
    manifold.normal = line / centres;
    manifold.depth = depth;
    // Half the lens's chord: c² = r_a² − x², with x the chord's distance from a's centre.
    const double x = (centres * centres + ca.radius * ca.radius - cb.radius * cb.radius) / (2 * centres);
    const double half_chord = std::sqrt(std::max(0.0, ca.radius * ca.radius - x * x));
    const Point middle = ca.centre + (ca.radius - 0.5 * depth) * manifold.normal;
    manifold.width = 2 * half_chord;
    manifold.area = 2.0 / 3.0 * depth * manifold.width;  // of a thin lens
    manifold.ends[0] = middle - half_chord * perpendicular(manifold.normal);
    manifold.ends[1] = middle + half_chord * perpendicular(manifold.normal);
    manifold.tip_of_a = middle;
    manifold.tip_of_b = ca.centre + (centres - cb.radius) * manifold.normal;
    manifold.tip_edge_of_b = b.cover.pieces[pair.b].first_edge;
    manifolds.push_back(manifold);
  }
}

}  // namespace polynya::geometry
