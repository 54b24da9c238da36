# The bending folder's sources, relative to fracture/.
set(POLYNYA_BENDING_SOURCES
  bending/floating_beam.cpp
  bending/kashtelyan.cpp
  bending/nevel.cpp
  bending/peak.cpp
)
