#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::bench {

/// A plate, and the cusps that are cut off it one after the other.
struct March {
  geometry::Ring plate;
  std::vector<geometry::Ring> cusps;
};

/// 500 overlapping discs marched around a 110 m × 200 m plate, turned by an angle so that nothing is
/// axis-aligned.
March march_of_cusps();

/// A floe of 2000 vertices with a ragged outline, and the two ends of a line across it [m].
struct Split {
  geometry::Ring floe;
  geometry::Point from;
  geometry::Point to;
};
Split split_of_floe(int vertices = 2000);

/// Result of one library for one case, detailed enough to show that all libraries did the same work.
struct Result {
  double area = 0;           ///< area of the plate left, or of both halves [m²]
  std::size_t vertices = 0;  ///< number of vertices of the plate left, or of both halves
};

/// The rectangle that holds all of the floe to the left of the split's line.
geometry::Ring half_plane(const Split& split);

namespace polynya_cuts {
Result march(const March& march);
Result split(const Split& split);
/// Time that the exact check of a valid floe with `vertices` vertices takes [s].
double seconds_to_validate(int vertices);
/// Seconds for one crack across it by the overlay of the whole shape and by the local path, and for two
/// discs, which only the overlay cuts.
double seconds_to_cut_generally(int vertices);
double seconds_to_cut_locally(int vertices);
double seconds_to_cut_by_two(int vertices);
}  // namespace polynya_cuts
namespace boost_geometry {
Result march(const March& march);
Result split(const Split& split);
}  // namespace boost_geometry
namespace geos {
Result march(const March& march);
Result split(const Split& split);
}  // namespace geos
namespace clipper {
Result march(const March& march);
Result split(const Split& split);
}  // namespace clipper

}  // namespace polynya::bench
