#pragma once

namespace polynya::geometry {

/// A sum that keeps the exact error of its additions (Knuth's two-sum, which needs no branch): the error does
/// not grow with the number of terms.
struct CompensatedSum {
  double value = 0;
  double lost = 0;
  void operator+=(double term) {
    const double next = value + term;
    const double virtual_term = next - value;
    lost += (value - (next - virtual_term)) + (term - virtual_term);
    value = next;
  }
  double total() const { return value + lost; }
};

}  // namespace polynya::geometry
