#pragma once

#include <exception>
#include <new>
#include <string>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry {

inline tl::unexpected<CutError> refuse(CutFailure reason, std::string detail) {
  return tl::unexpected(CutError{reason, std::move(detail)});
}
inline tl::unexpected<CutError> refuse(CutFailure reason, Defect defect) {
  return refuse(reason, std::string(name_of(defect)));
}

/// A geometric failure is a value: what CGAL throws in `work` becomes one (kInternal). Out of memory is
/// thrown on.
template <typename Work>
auto guarded(Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return refuse(CutFailure::kInternal, failure.what());
  }
}

}  // namespace polynya::geometry
