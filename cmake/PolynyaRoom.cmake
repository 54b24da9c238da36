# One function that makes a room: a static library polynya::NAME whose includes begin with "NAME/".
#
#   polynya_room(geometry SOURCES file... [PUBLIC lib...] [PRIVATE lib...] [COLD])
#
# COLD: no step runs its code, so that it is not worth the time of -O3, which is a third more of the compiler's.

add_library(polynya_options INTERFACE)
target_compile_features(polynya_options INTERFACE cxx_std_20)
# Contraction is off, so that the same source gives the same bytes whether or not the machine has fused multiply-add.
target_compile_options(polynya_options INTERFACE -ffp-contract=off)
# Failed assertions name their source relative to the project's folder, so that no product contains a path of the build
# machine.
target_compile_options(polynya_options INTERFACE $<BUILD_INTERFACE:-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=>)

add_library(polynya_warnings INTERFACE)
target_compile_options(polynya_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False alarms of GCC 12 inside the standard library's strings, variants and vectors once inlined.
  target_compile_options(polynya_warnings INTERFACE
    -Wno-restrict -Wno-maybe-uninitialized -Wno-alloc-size-larger-than -Wno-array-bounds -Wno-stringop-overflow
    # The compiler collects its garbage from half a gigabyte on, not from 128 MB, which saves 3 to 6 % of its time.
    "SHELL:--param ggc-min-heapsize=524288")
endif()
# Options for code that every step runs; they save 4 to 5 % of a run's time together. They are used everywhere, because
# precompiled headers need one set of options. Neither changes a result: square roots set no errno, and both sides of a
# conditional may be computed before it.
target_compile_options(polynya_warnings INTERFACE -fno-math-errno -fno-trapping-math)

# Headers of the standard library and of fmt are compiled once for all rooms instead of in every source: a third of the
# time. Sources include what they use all the same (`./test -L fuzz` compiles each by itself).
set(POLYNYA_HEADERS <algorithm> <array> <charconv> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <numbers> <numeric> <optional> <ranges> <set> <span> <sstream> <string> <string_view> <system_error>
  <unordered_map> <utility> <variant> <vector> <fmt/format.h> <fmt/ranges.h> <tl/expected.hpp>)
file(CONFIGURE OUTPUT precompiled.cpp CONTENT "// Has the precompiled headers of all rooms.\n")
add_library(polynya_precompiled OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(polynya_precompiled PRIVATE polynya_options polynya_warnings fmt::fmt tl::expected)
set_target_properties(polynya_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_precompile_headers(polynya_precompiled PRIVATE ${POLYNYA_HEADERS})

set(POLYNYA_COLD_OPTIONS $<$<CONFIG:Release,Dev>:-O1>)

function(polynya_room name)
  cmake_parse_arguments(ROOM "COLD" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target polynya_${name})
  foreach(folder IN LISTS POLYNYA_OVERRIDES)  # sources of which a browser or Windows has its own
    foreach(source IN LISTS ROOM_SOURCES)
      if(EXISTS ${folder}/${name}/${source})
        list(TRANSFORM ROOM_SOURCES REPLACE "^${source}$" "${folder}/${name}/${source}")
      endif()
    endforeach()
  endforeach()
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(polynya::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  # Eight sources at a time: most of a source's time goes into the headers that it shares with its neighbours. So a name
  # without linkage is one of its whole room. Sources with options of their own are compiled by themselves.
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${POLYNYA_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..> $<INSTALL_INTERFACE:include/polynya>)
  target_link_libraries(${target}
    PUBLIC polynya_options ${ROOM_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:polynya_warnings> ${ROOM_PRIVATE})
  if(ROOM_COLD)
    target_compile_options(${target} PRIVATE ${POLYNYA_COLD_OPTIONS})
  endif()
  target_precompile_headers(${target} REUSE_FROM polynya_precompiled)
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  set_property(GLOBAL APPEND PROPERTY POLYNYA_ROOMS ${target})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION include/polynya/${name}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "internal" EXCLUDE)
endfunction()
