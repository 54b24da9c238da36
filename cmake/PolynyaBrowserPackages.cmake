# The packages of the native build, for WebAssembly. browser/platform replaces those that do not consist of headers
# alone. Its folder precedes all other include folders, so that its headers replace headers that a browser's C++ library
# lacks, or has without threads.
set(platform ${PROJECT_SOURCE_DIR}/browser/platform/include)
set(POLYNYA_OVERRIDES ${PROJECT_SOURCE_DIR}/browser/platform/overrides)
include_directories(BEFORE ${POLYNYA_OVERRIDES})

set(library /usr/lib/llvm-16/include/wasm32-wasi/c++/v1)
foreach(option "-nostdinc++" "-isystem ${platform}" "-isystem ${library}" "-fwasm-exceptions")
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:${option}>")
endforeach()
include(PolynyaHeaderPackages)
add_compile_options(-msimd128 -mbulk-memory)
add_compile_definitions(_WASI_EMULATED_SIGNAL _WASI_EMULATED_MMAN _WASI_EMULATED_PROCESS_CLOCKS
  _LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION
  # WebAssembly has one rounding mode and this build has one thread.
  CGAL_ALWAYS_ROUND_TO_NEAREST
  FE_UPWARD=0x800 FE_DOWNWARD=0x400 FE_TOWARDZERO=0xc00 CGAL_HAS_NO_THREADS
  BOOST_HAS_PRAGMA_ONCE BOOST_AC_DISABLE_THREADS)
add_library(Threads::Threads INTERFACE IMPORTED GLOBAL)
