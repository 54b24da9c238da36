"""Many runs of one scene: `polynya study` (docs/studies.md). Only `report` needs more than Python's standard
library."""
