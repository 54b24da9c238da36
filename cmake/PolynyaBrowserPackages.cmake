# The packages of the native build, for WebAssembly. Packages that consist of headers alone are taken from where Debian
# installs them; browser/platform replaces the others. Its folder precedes all other include folders, so that its
# headers replace headers that a browser's C++ library lacks, or has without threads.
set(platform ${PROJECT_SOURCE_DIR}/browser/platform/include)
include_directories(BEFORE ${PROJECT_SOURCE_DIR}/browser/platform/overrides)
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(package boost CGAL fmt tl nlohmann)
  find_path(folder_of_${package} ${package} PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${folder_of_${package}}/${package} ${headers}/${package} SYMBOLIC)
endforeach()
find_path(eigen Eigen/Core PATHS /usr/include/eigen3 NO_CMAKE_FIND_ROOT_PATH REQUIRED)
file(CREATE_LINK ${eigen}/Eigen ${headers}/Eigen SYMBOLIC)

set(library /usr/lib/llvm-16/include/wasm32-wasi/c++/v1)
foreach(option "-nostdinc++" "-isystem ${platform}" "-isystem ${library}" "-fwasm-exceptions")
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:${option}>")
endforeach()
add_compile_options("SHELL:-isystem ${headers}" -msimd128 -mbulk-memory)
add_compile_definitions(_WASI_EMULATED_SIGNAL _WASI_EMULATED_MMAN _WASI_EMULATED_PROCESS_CLOCKS
  FMT_HEADER_ONLY=1 _LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION
  # WebAssembly has one rounding mode and this build has one thread.
  CGAL_ALWAYS_ROUND_TO_NEAREST
  FE_UPWARD=0x800 FE_DOWNWARD=0x400 FE_TOWARDZERO=0xc00 CGAL_HAS_NO_THREADS CGAL_USE_BOOST_MP=1 CGAL_DISABLE_GMP=1
  BOOST_HAS_PRAGMA_ONCE BOOST_AC_DISABLE_THREADS)
foreach(package CGAL::CGAL Eigen3::Eigen tl::expected fmt::fmt Threads::Threads nlohmann_json::nlohmann_json
    gmpxx gmp)
  add_library(${package} INTERFACE IMPORTED GLOBAL)
endforeach()
set(nlohmann_json_FOUND TRUE)
