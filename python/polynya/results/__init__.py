"""Runs and studies read back (docs/python.md, "A run folder"): polynya.Run and polynya.Study. Needs numpy."""
