"""Ice pressures according to rules, for comparison with computed loads; no load is computed from them.

`polynya loads` draws the local pressure of ISO 19906 and the pressures of PC1, PC4 and PC7 beside the peaks of a run,
so another number here moves only these curves. The global pressure is for users of the Python module. The formulas are
from memory (*recall* in docs/references.md): compare them with the standard before basing a decision on them."""
import numpy

# P₀, the average pressure over a contact of 1 m², for each polar class [MPa]; PC1 is for the heaviest ice, PC7 for the
# lightest.
POLAR_CLASSES = {"PC1": 6.0, "PC2": 4.2, "PC3": 3.2, "PC4": 2.45, "PC5": 2.0, "PC6": 1.4, "PC7": 1.25}


def iso_local_pressure(area):
    """Design pressure of massive ice features on a local area of a structure [Pa]: 7.40 A^−0.70 MPa up to 10 m²,
    1.48 MPa above [ISO19906]. `area` is a number or an array > 0 [m²]; the result has its shape."""
    area = numpy.asarray(area, dtype=float)
    return 1e6 * numpy.where(area <= 10, 7.40 * area**-0.70, 1.48)


def iso_global_pressure(width, thickness, strength=2.8e6):
    """Mean pressure of ice that crushes along the whole width of a vertical structure [Pa]; times width and thickness
    it is the load [N]. C_R h^n (w/h)^−0.16, with n = −0.5 + h/5 below 1 m of ice and −0.3 from there on [ISO19906].
    Width w and thickness h are numbers or arrays > 0 [m]. `strength` is C_R [Pa], to which the pressure is
    proportional: 1.8e6 for the Baltic, 2.8e6 for the Arctic."""
    thickness = numpy.asarray(thickness, dtype=float)
    power = numpy.where(thickness < 1, -0.5 + thickness / 5, -0.3)
    return strength * thickness**power * (numpy.asarray(width) / thickness) ** -0.16


def polar_class_pressure(area, name):
    """Average pressure over a contact area [m²], from which the design loads of the polar class `name` ("PC1" to "PC7")
    in a glancing impact are derived [Pa]: P₀ A^−0.1, with A relative to 1 m² [Daley2000]. `area` is a number or an
    array > 0. Raises KeyError for another name."""
    return 1e6 * POLAR_CLASSES[name] * numpy.asarray(area, dtype=float) ** -0.1
