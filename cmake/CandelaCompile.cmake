# SPDX-License-Identifier: MIT
# How every target of the project is compiled: language level, warnings, optimisation, sanitizers, ccache.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(THREADS_PREFER_PTHREAD_FLAG ON)

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer")
set(CMAKE_C_FLAGS_SANITIZE "${CMAKE_CXX_FLAGS_SANITIZE}")

find_program(CANDELA_CCACHE ccache)
if(CANDELA_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
        ${CANDELA_CCACHE})
endif()

add_library(candela_compile INTERFACE)
target_compile_features(candela_compile INTERFACE cxx_std_20)
target_compile_options(
    candela_compile
    INTERFACE -Wall
              -Wextra
              -Wpedantic
              -Wshadow
              -Wconversion
              -Wno-sign-conversion
              -Wnon-virtual-dtor
              -Wold-style-cast
              -Woverloaded-virtual
              -Wnull-dereference
              -Wdouble-promotion
              -Wimplicit-fallthrough
              # Contraction would make results depend on the instruction set, and so break bit-identity.
              -ffp-contract=off
              # Nobody reads errno after a root; without it a root is one instruction, and vectors of them are too.
              -fno-math-errno)
if(CANDELA_WERROR)
    target_compile_options(candela_compile INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # GCC 12 reports false positives of these inside the standard library at -O3.
    target_compile_options(candela_compile INTERFACE -Wno-null-dereference -Wno-restrict -Wno-maybe-uninitialized
                                                     -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(CANDELA_SANITIZE)
    add_compile_options(-fsanitize=${CANDELA_SANITIZE} -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${CANDELA_SANITIZE})
endif()
if(CANDELA_FUZZ)
    # Every branch tells the fuzzer that it was taken.
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()
