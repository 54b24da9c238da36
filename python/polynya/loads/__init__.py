"""Ice loads by place on a hull: peaks of contact forces and loads of panels, of a run or of all cases of a study.

    from polynya import loads
    found = loads.gather("studies/load-peaks")
    loads.estimate.exceedance(found)
"""
from . import bursts, estimate, rules
from .gather import Loads, gather

__all__ = ["Loads", "bursts", "estimate", "gather", "rules"]
