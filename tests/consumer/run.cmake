# Installs a build into an empty prefix. Then it configures, builds and runs the consumer with nothing but that prefix.
#   cmake -DBUILD=<polynya's build folder> -DWORK=<scratch folder> -DGENERATOR=<generator>
#         [-DFLAGS=<compiler flags>] -P run.cmake
foreach(needed BUILD WORK GENERATOR)
  if(NOT ${needed})
    message(FATAL_ERROR "run.cmake needs -D${needed}=")
  endif()
endforeach()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(SUBSTRING "${output}" 0 3000 output)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer ${WORK}/prefix/share/polynya/scenes/two-floes.json ${WORK}/run)
message(STATUS "${output}")
run(${WORK}/prefix/bin/polynya validate ${WORK}/prefix/share/polynya/scenes/sawamura2017-fig4b.json)
message(STATUS "${output}")
run(${WORK}/prefix/bin/polynya study plan --help)  # finds the Python package below the prefix
# The installed program comes with its manual page and its completion, which is tried in bash.
foreach(file share/man/man1/polynya.1 share/bash-completion/completions/polynya)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
string(CONCAT complete "source ${WORK}/prefix/share/bash-completion/completions/polynya && "
  "COMP_WORDS=(polynya run scene.json --progress j) && COMP_CWORD=4 && _polynya && echo completed:\${COMPREPLY[0]}")
run(bash -c "${complete}")
if(NOT output MATCHES "completed:json")
  message(FATAL_ERROR "completing --progress j gives ${output}")
endif()
# If the compiled module is built, Python finds the package and the module by the installed .pth file, and type checkers
# find the stub.
file(GLOB line ${WORK}/prefix/lib/python3*/dist-packages/polynya.pth)
file(GLOB module ${WORK}/prefix/lib/polynya/python_core/_core*.so)
if(module)
  if(NOT line OR NOT EXISTS ${WORK}/prefix/lib/polynya/python/polynya/_core.pyi OR NOT EXISTS
    ${WORK}/prefix/lib/polynya/python/polynya/py.typed)
    message(FATAL_ERROR "polynya.pth, _core.pyi or py.typed is not installed")
  endif()
  get_filename_component(site ${line} DIRECTORY)
  run(${CMAKE_COMMAND} -E env --unset=PYTHONPATH /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/installed.py ${site}
      ${WORK}/prefix/share/polynya/scenes/two-floes.json)
  if(NOT output MATCHES "5 ${WORK}/prefix/lib/polynya/python_core/_core")
    message(FATAL_ERROR "the installed module gives ${output}")
  endif()
endif()
