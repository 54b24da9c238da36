"""`polynya performance SHIP`: the speed that a ship keeps in level ice of each thickness."""
