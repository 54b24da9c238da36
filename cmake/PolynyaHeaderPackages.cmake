# Packages that consist of headers alone, for builds for other systems: they are taken from where Debian installs them.
# The build's folder `headers` has links to these packages alone, because the folder of all of Debian's headers also has
# the headers of this machine's C library.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(package boost CGAL fmt tl nlohmann)
  find_path(folder_of_${package} ${package} PATHS /usr/include /usr/local/include
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${folder_of_${package}}/${package} ${headers}/${package} SYMBOLIC)
endforeach()
find_path(eigen Eigen/Core PATHS /usr/include/eigen3 NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
file(CREATE_LINK ${eigen}/Eigen ${headers}/Eigen SYMBOLIC)
add_compile_options("SHELL:-isystem ${headers}")
# fmt without its library, and rational numbers of Boost.Multiprecision in place of GMP's.
add_compile_definitions(FMT_HEADER_ONLY=1 CGAL_USE_BOOST_MP=1 CGAL_DISABLE_GMP=1)
foreach(package CGAL::CGAL Eigen3::Eigen tl::expected fmt::fmt nlohmann_json::nlohmann_json gmpxx gmp)
  add_library(${package} INTERFACE IMPORTED GLOBAL)
endforeach()
set(nlohmann_json_FOUND TRUE)
