# Initial cache of the build of the fuzz targets: clang, which has libFuzzer (Debian: libclang-rt-14-dev). SUNDIALS asks
# for OpenMP although no library that we link uses it; clang's own need not be installed.
find_program(CMAKE_C_COMPILER NAMES clang clang-14 clang-15 clang-16 clang-17 clang-18 clang-19)
find_program(CMAKE_CXX_COMPILER NAMES clang++ clang++-14 clang++-15 clang++-16 clang++-17 clang++-18 clang++-19)
foreach(language C CXX)
  set(OpenMP_${language}_FLAGS -pthread CACHE STRING "")
  set(OpenMP_${language}_LIB_NAMES pthread CACHE STRING "")
endforeach()
set(OpenMP_pthread_LIBRARY -pthread CACHE STRING "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "")
set(LACUNA_FUZZ ON CACHE BOOL "")
set(LACUNA_SANITIZE ON CACHE BOOL "")
set(LACUNA_WERROR OFF CACHE BOOL "")
