"""Ice pressure over an area, and load of a whole structure, according to rules. The formulas are from memory (*recall*
in docs/references.md): compare them with the standard before basing a decision on them."""
import numpy

POLAR_CLASSES = {"PC1": 6.0, "PC2": 4.2, "PC3": 3.2, "PC4": 2.45, "PC5": 2.0, "PC6": 1.4, "PC7": 1.25}  # P₀ [MPa]


def iso_local_pressure(area):
    """Local pressure of massive ice features over an area [m²] in Pa: 7.40 A^−0.70 MPa up to 10 m², 1.48 MPa above
    [ISO19906]."""
    area = numpy.asarray(area, dtype=float)
    return 1e6 * numpy.where(area <= 10, 7.40 * area**-0.70, 1.48)


def iso_global_pressure(width, thickness, strength=2.8e6):
    """Limit stress of a vertical structure in Pa: C_R h^n (w/h)^−0.16 with n = −0.5 + h/5 below 1 m of ice and −0.3
    above. C_R is 1.8 MPa (Baltic) to 2.8 MPa (Arctic); width w and thickness h in metres [ISO19906]."""
    thickness = numpy.asarray(thickness, dtype=float)
    power = numpy.where(thickness < 1, -0.5 + thickness / 5, -0.3)
    return strength * thickness**power * (numpy.asarray(width) / thickness) ** -0.16


def polar_class_pressure(area, name):
    """Average pressure over a contact area [m²], from which the loads of a polar class in a glancing impact are
    derived, in Pa: P₀ A^−0.1 [Daley2000]."""
    return 1e6 * POLAR_CLASSES[name] * numpy.asarray(area, dtype=float) ** -0.1
