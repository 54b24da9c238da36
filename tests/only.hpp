#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace polynya::tests {

/// Returns the only element of a list. The test fails if there is none or more than one.
template <class T>
T only(const std::vector<T>& list) {
  if (list.size() != 1) throw std::length_error("one is expected, there are " + std::to_string(list.size()));
  return list.front();
}

}  // namespace polynya::tests
