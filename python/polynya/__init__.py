"""Polynya in Python.

`polynya.study` plans, runs and gathers many runs of one scene (docs/studies.md); `polynya.statistics` has the estimators
of its reports. The simulator itself is the program `polynya`.
"""
