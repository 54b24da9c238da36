"""`polynya performance SHIP`: the speed that a ship can keep in level ice of each thickness."""
