# The cut's fuzzer, where clang and its fuzzer runtime are present: built with clang whatever builds the rest, because only
# clang has libFuzzer. Ten seconds of it run with the tests; for longer:
#   BUILD/…/geometry_cut_fuzz -entropic=0 -max_total_time=3600 -timeout=20 NEW_CORPUS tests/fuzz/geometry_cut_corpus
find_program(POLYNYA_CLANGXX NAMES clang++ clang++-14 clang++-15 clang++-16)
if(POLYNYA_CLANGXX)
  execute_process(COMMAND ${POLYNYA_CLANGXX} -print-file-name=libclang_rt.fuzzer-x86_64.a
    OUTPUT_VARIABLE fuzzer_runtime OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT EXISTS "${fuzzer_runtime}")
    execute_process(COMMAND ${POLYNYA_CLANGXX} -print-runtime-dir
      OUTPUT_VARIABLE runtime_dir OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    file(GLOB fuzzer_runtime "${runtime_dir}/libclang_rt.fuzzer*.a")
  endif()
endif()
if(NOT POLYNYA_CLANGXX OR NOT fuzzer_runtime)
  message(STATUS "No clang fuzzer runtime: the cut's fuzzer is not built")
  return()
endif()

get_target_property(room_sources polynya_geometry SOURCES)
get_target_property(room_dir polynya_geometry SOURCE_DIR)
list(TRANSFORM room_sources PREPEND ${room_dir}/)
set(fuzz_sources ${PROJECT_SOURCE_DIR}/tests/fuzz/geometry_cut_fuzz.cpp
  ${PROJECT_SOURCE_DIR}/tests/geometry/dice.cpp ${PROJECT_SOURCE_DIR}/tests/geometry/trials.cpp ${room_sources})
# -frounding-math for CGAL's interval arithmetic; its checks throw, as in the room itself.
set(fuzz_flags -std=c++20 -O2 -g1 -ffp-contract=off -frounding-math -DCGAL_DEBUG -DCGAL_USE_GMP -DCGAL_USE_MPFR
  -DCGAL_USE_GMPXX -I${PROJECT_SOURCE_DIR} -Wno-everything -fsanitize=fuzzer-no-link,address)
# Not CGAL's own code: it doubles the compilation and slows the oracle most of all.
set(fuzz_flags_of_ours -fsanitize=undefined -fno-sanitize-recover=undefined)
set(fuzz_objects)
foreach(source ${fuzz_sources})
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
  string(REPLACE "/" "_" name ${name})
  set(object ${CMAKE_CURRENT_BINARY_DIR}/fuzz/${name}.o)
  if(name MATCHES arrangement)
    set(extra_flags)
  else()
    set(extra_flags ${fuzz_flags_of_ours})
  endif()
  add_custom_command(OUTPUT ${object}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/fuzz
    COMMAND ${POLYNYA_CLANGXX} ${fuzz_flags} ${extra_flags} -MD -MF ${object}.d -MT ${object} -c ${source} -o ${object}
    DEPENDS ${source} DEPFILE ${object}.d VERBATIM)
  list(APPEND fuzz_objects ${object})
endforeach()
set(fuzzer ${CMAKE_CURRENT_BINARY_DIR}/geometry_cut_fuzz)
add_custom_command(OUTPUT ${fuzzer}
  COMMAND ${POLYNYA_CLANGXX} -fsanitize=fuzzer,address,undefined ${fuzz_objects} -lgtest -lgmpxx -lgmp -lmpfr -o ${fuzzer}
  DEPENDS ${fuzz_objects} VERBATIM)
add_custom_target(polynya_fuzz_geometry_cut ALL DEPENDS ${fuzzer})
# A fixed seed; new findings go to the build directory, not into the repository's corpus.
add_test(NAME geometry.fuzz_cut_ten_seconds COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=malloc_context_size=1
  ${fuzzer} -seed=1 -entropic=0 -max_total_time=10 -timeout=20
  -print_final_stats=0 -verbosity=0 ${CMAKE_CURRENT_BINARY_DIR}/fuzz/found ${PROJECT_SOURCE_DIR}/tests/fuzz/geometry_cut_corpus)
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/fuzz/found)
set_tests_properties(geometry.fuzz_cut_ten_seconds PROPERTIES LABELS fuzz TIMEOUT 120)
