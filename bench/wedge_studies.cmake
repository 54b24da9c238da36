# References of tests and the tables of docs/theory/bending.md.
include_guard(GLOBAL)
add_library(polynya_wedge_studies STATIC ${CMAKE_CURRENT_LIST_DIR}/wedge_studies.cpp)
target_link_libraries(polynya_wedge_studies PUBLIC polynya::fracture polynya_warnings polynya_eigen)
