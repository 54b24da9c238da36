"""Reads runs and studies (docs/python.md, "A run folder, a study's folder"): polynya.Run and polynya.Study.

Needs numpy."""
