# The commit from which a program is built, for `polynya --version`. It is written as a C++ source when it changes. A
# plus follows the commit if the tree has uncommitted changes. Outside of git the text is empty.
#
#   polynya_commit(TARGET OUTPUT)
function(polynya_commit target output)
  add_custom_target(${target}_commit BYPRODUCTS ${output} VERBATIM COMMAND ${CMAKE_COMMAND}
    -DSOURCE=${PROJECT_SOURCE_DIR}
    -DOUTPUT=${output} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
  target_sources(${target} PRIVATE ${output})
  add_dependencies(${target} ${target}_commit)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=9 --dirty=+ --exclude=* OUTPUT_VARIABLE commit
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(CONCAT source "#include \"app/command_line/command_line.hpp\"\n\nnamespace polynya::app {\n\n"
    "const std::string_view kCommit = \"${commit}\";\n\n}  // namespace polynya::app\n")
  file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${source}" @ONLY)
endif()
