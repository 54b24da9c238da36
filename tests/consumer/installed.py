"""Steps a scene with the installed module, found as the system's Python finds local packages.

    python3 tests/consumer/installed.py SITE SCENE
"""
import site
import sys

site.addsitedir(sys.argv[1])
import polynya  # noqa: E402

simulation = polynya.Simulation(sys.argv[2])
simulation.step(5)
print(simulation.steps, polynya._core.__file__)
