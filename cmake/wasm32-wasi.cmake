# Builds for WebAssembly with Debian's packages only: ./setup.sh browser.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_C_COMPILER clang-16)
set(CMAKE_AR llvm-ar-16)
set(CMAKE_RANLIB llvm-ranlib-16)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# Headers and libraries of the build machine do not fit WebAssembly. PolynyaBrowserPackages.cmake links the packages
# that consist of headers alone.
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY NEVER)
