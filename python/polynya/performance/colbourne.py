"""Fits Colbourne's formula for the resistance of broken ice to points: R = ½ k F⁻ᵇ ρ_i B h V² Cⁿ with F = V / √(g h
C). B is the beam, h the thickness, C the cover, V the speed and ρ_i the density of the ice; the floe size is not in
it."""
import dataclasses
import math

import numpy as np

from ..formulas import G

FORM = "R = 0.5 k F^(-b) rho_i B h V^2 C^n with F = V / sqrt(g h C)"
FEWEST = 2  # least number of points beyond the number of coefficients, so that errors can be estimated


class NotEnough(Exception):
    """Raised if there are too few points to determine the coefficients."""


@dataclasses.dataclass
class Fit:
    """Coefficients with their standard errors. If all points have the same cover, n is None, and k contains the effect
    of the cover."""

    k: float
    k_error: float
    b: float
    b_error: float
    n: float
    n_error: float
    scatter: float  #: typical factor between a point and the fit: exp of the residuals' standard deviation
    points: int

    def resistance(self, point, beam, density):
        """Resistance of a point by the fit [N]."""
        return scale(point, beam, density) * self.k * froude(point) ** -self.b * point["cover"] ** (self.n or 0)


def froude(point):
    """Froude number of pack ice at a point."""
    return point["speed_m_per_s"] / math.sqrt(G * point["thickness_m"] * point["cover"])


def scale(point, beam, density):
    """½ ρ_i B h V² of a point [N]."""
    return 0.5 * density * beam * point["thickness_m"] * point["speed_m_per_s"] ** 2


def fit(points, resistances, beam, density):
    """Fits by least squares of the logarithm of the resistance [N]. Points are mappings with the speed, the thickness
    and the cover, which must be > 0, as must resistances. `beam` is that of the ship [m], `density` that of the ice
    [kg/m³]. Raises NotEnough if there are too few points, or if they do not determine the coefficients: if they have
    only one Froude number, or if their Froude numbers follow from their covers."""
    has_covers = len({point["cover"] for point in points}) > 1
    columns = [np.ones(len(points)), [-math.log(froude(point)) for point in points]]
    if has_covers:
        columns.append([math.log(point["cover"]) for point in points])
    matrix = np.column_stack(columns)
    if len(points) < matrix.shape[1] + FEWEST or np.linalg.matrix_rank(matrix) < matrix.shape[1]:
        raise NotEnough(f"{len(points)} points with a resistance do not decide {matrix.shape[1]} coefficients")
    wanted = np.array([math.log(r / scale(point, beam, density)) for point, r in zip(points, resistances)])
    found, *_ = np.linalg.lstsq(matrix, wanted, rcond=None)
    residuals = wanted - matrix @ found
    variance = residuals @ residuals / (len(points) - matrix.shape[1])
    errors = np.sqrt(variance * np.diag(np.linalg.inv(matrix.T @ matrix)))
    k = math.exp(found[0])
    found, errors = found.tolist(), errors.tolist()
    n, n_error = (found[2], errors[2]) if has_covers else (None, None)
    return Fit(k, k * errors[0], found[1], errors[1], n, n_error, math.exp(math.sqrt(variance)), len(points))
