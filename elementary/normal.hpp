#pragma once

namespace polynya::elementary {

/// Share of the standard normal distribution that is below x.
double normal_share(double x);

/// Inverse of normal_share() for 0 < share < 1, to 1e-15 of the value; ∓∞ at 0 and 1.
double normal_quantile(double share);

}  // namespace polynya::elementary
