"""Runs and studies read back (docs/python.md, "A run folder, a study's folder"): polynya.Run and polynya.Study.

Needs numpy."""
