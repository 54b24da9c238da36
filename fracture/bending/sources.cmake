# The bending folder's sources, relative to fracture/, and the default database compiled into one of them.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_SOURCE_DIR}/bending/default_database.txt)
file(READ ${CMAKE_CURRENT_SOURCE_DIR}/bending/default_database.txt POLYNYA_DEFAULT_DATABASE)
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/bending/default_database_text.cpp.in
  ${CMAKE_CURRENT_BINARY_DIR}/default_database_text.cpp @ONLY)

set(POLYNYA_BENDING_SOURCES
  ${CMAKE_CURRENT_BINARY_DIR}/default_database_text.cpp
  bending/database.cpp
  bending/edge_deflection.cpp
  bending/edge_sections.cpp
  bending/fsi_database_model.cpp
  bending/internal/fluid.cpp
  bending/internal/modes.cpp
  bending/internal/plate.cpp
  bending/published_forms.cpp
  bending/peak.cpp
  bending/wedge_solver.cpp
)
