# `cpack` in a build tree makes two Debian packages: polynya (the program, its manual page and completion, the package
# in Python that it starts, scenes, examples, documentation) and polynya-python (the compiled module). Shared libraries
# are found by dpkg-shlibdeps. .ci/package makes, checks and tries them.
# cpack also runs this file as a script before it packs the staged files. The script then adds the files that Debian's
# policy requires.
if(CPACK_TEMPORARY_DIRECTORY)
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(GLOB stages ${CPACK_TEMPORARY_DIRECTORY}/*/usr)
  foreach(stage IN LISTS stages)
    cmake_path(GET stage PARENT_PATH component)
    cmake_path(GET component FILENAME component)
    set(package polynya)
    if(component STREQUAL "python")
      set(package polynya-python)
    endif()
    file(GLOB of_one_python ${stage}/lib/python3.*)  # Debian's own packages are found in python3, whichever 3.x it is
    if(of_one_python)
      file(RENAME ${of_one_python} ${stage}/lib/python3)
    endif()
    set(folder ${stage}/share/doc/${package})
    file(MAKE_DIRECTORY ${folder})
    file(WRITE ${folder}/changelog "polynya (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
      "  * CHANGELOG.md of the source has what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
    file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/debian_copyright.txt ${folder}/copyright)
    file(GLOB compressed ${stage}/share/man/man1/*.1 ${folder}/changelog)
    execute_process(COMMAND gzip -9nf ${compressed} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND chmod -R u=rwX,go=rX ${stage} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  return()
endif()

get_property(python_minor GLOBAL PROPERTY POLYNYA_PYTHON_MINOR)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Polynya maintainers <maintainers@users.noreply.github.com>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_FILE})
set(CPACK_COMPONENTS_ALL program)
if(TARGET polynya_core)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME polynya)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
  "python3, python3-numpy, python3-scipy, python3-matplotlib, librsvg2-bin, gdal-bin, polynya-python")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-pandas, python3-shapely")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Floes are exact polygons: ships push them, break plates by bending and
split them; the channel behind the ship, the ice forces and every
fractured floe come out.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME polynya-python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
math(EXPR next_python "0${python_minor} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "polynya (= ${PROJECT_VERSION}), python3 (>= 3.${python_minor}), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The compiled module of polynya: scenes, stepped and steered in the process
of a script or a notebook; exact cuts of polygons.")
include(CPack)
