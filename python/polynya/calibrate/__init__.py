"""`polynya calibrate SHIP TESTS.csv`: the factors of bending with which a ship has the resistance of level-ice
tests."""
