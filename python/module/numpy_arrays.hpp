#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "python/module/scene.hpp"
#include <pybind11/numpy.h>

#include "geometry/shape/polygon.hpp"

namespace polynya::python {

using Numbers = py::array_t<double>;
using Integers = py::array_t<std::int64_t>;

/// Returns an array of a shape that takes over the memory of the vector, without a copy.
template <class Value>
py::array_t<Value> array_of(std::vector<Value> values, std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  Value* const data = kept->data();
  if (data == nullptr) return py::array_t<Value>(std::move(shape));  // there is no memory to keep
  const py::capsule owner(kept.release(), [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return py::array_t<Value>(std::move(shape), data, owner);
}

/// Returns an array with this number of columns.
inline Numbers table(std::vector<double> values, py::ssize_t columns) {
  const py::ssize_t rows = static_cast<py::ssize_t>(values.size()) / columns;
  return array_of(std::move(values), {rows, columns});
}
template <class Value>
py::array_t<Value> column_of(std::vector<Value> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

/// Rings of many polygons, one after the other. Ring r has the vertices ring_offsets[r] to ring_offsets[r + 1]. Polygon
/// i has the rings polygon_offsets[i] to polygon_offsets[i + 1], the outer one first.
struct PolygonTable {
  std::vector<double> vertices;  ///< x, y, x, y, … [m]
  std::vector<std::int64_t> ring_offsets{0}, polygon_offsets{0};

  void add(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body) {
    add_ring(polygon.outer, frame_from_body);
    for (const geometry::Ring& hole : polygon.holes) add_ring(hole, frame_from_body);
    polygon_offsets.push_back(static_cast<std::int64_t>(ring_offsets.size()) - 1);
  }

 private:
  void add_ring(const geometry::Ring& ring, const geometry::Pose& frame_from_body) {
    for (const geometry::Point p : ring) {
      const geometry::Point q = transform(frame_from_body, p);
      vertices.insert(vertices.end(), {q.x, q.y});
    }
    ring_offsets.push_back(static_cast<std::int64_t>(vertices.size() / 2));
  }
};

}  // namespace polynya::python
