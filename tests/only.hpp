#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace polynya::tests {

/// The only one of a list; fails the test where there are none or several.
template <class T>
T only(const std::vector<T>& list) {
  if (list.size() != 1) throw std::length_error("one is expected, there are " + std::to_string(list.size()));
  return list.front();
}

}  // namespace polynya::tests
