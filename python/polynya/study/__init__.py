"""Many runs of one scene: `polynya study` (docs/studies.md). Only `report` needs packages outside of Python's standard
library."""
