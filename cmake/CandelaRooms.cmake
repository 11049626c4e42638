# SPDX-License-Identifier: MIT
# One static library per room of the renderer, one test program per room.

# candela_headers(NAME TYPE LINK target … HEADERS <a> …)
# Compiles headers once for all whose flags are alike (rooms, tests): to do it again for each takes a fifth of a build.
# TYPE is that of those who use them, library or executable, whose code must be as position-independent.
function(candela_headers name type)
    cmake_parse_arguments(COMMON "" "" "LINK;HEADERS" ${ARGN})
    if(TARGET ${name})
        return()
    endif()
    set(nothing ${PROJECT_BINARY_DIR}/nothing.cpp)
    file(CONFIGURE OUTPUT ${nothing} CONTENT "")
    cmake_language(CALL add_${type} ${name} ${nothing})
    target_link_libraries(${name} PRIVATE candela_compile ${COMMON_LINK})
    target_precompile_headers(${name} PRIVATE ${COMMON_HEADERS})
endfunction()

# candela_room(NAME SOURCES a.cpp … [DEPENDS room …] [PACKAGES target …])
# Makes the library candela_NAME from the sources of this folder. PACKAGES stay private to the room.
function(candela_room name)
    cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS;PACKAGES" ${ARGN})
    add_library(candela_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(candela_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    list(TRANSFORM ROOM_DEPENDS PREPEND candela_)
    target_link_libraries(
        candela_${name}
        PUBLIC ${ROOM_DEPENDS} glm::glm Threads::Threads
        PRIVATE candela_compile ${ROOM_PACKAGES})
    candela_headers(
        candela_room_headers
        library
        LINK
        glm::glm
        Threads::Threads
        HEADERS
        <algorithm>
        <array>
        <atomic>
        <cmath>
        <cstdint>
        <memory>
        <optional>
        <span>
        <string>
        <vector>
        <glm/glm.hpp>)
    target_precompile_headers(candela_${name} REUSE_FROM candela_room_headers)
endfunction()

# candela_test(NAME SOURCES a_test.cpp … [LINK target …] [LABELS label …])
# Makes the GoogleTest program test_NAME and registers it with ctest as one test per TEST().
# LABELS: fast (default; also run under the sanitizers), slow, gl, window.
function(candela_test name)
    cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;LINK;LABELS" ${ARGN})
    if(NOT TEST_LABELS)
        set(TEST_LABELS fast)
    endif()
    if(NOT TEST_TIMEOUT)
        set(TEST_TIMEOUT 300)
    endif()
    add_executable(test_${name} ${TEST_SOURCES})
    target_link_libraries(test_${name} PRIVATE candela_compile candela_test_support ${TEST_LINK} GTest::gtest_main)
    candela_headers(
        candela_test_headers
        executable
        LINK
        glm::glm
        GTest::gtest_main
        HEADERS
        <gtest/gtest.h>
        <vector>
        <string>
        <memory>
        <glm/glm.hpp>)
    target_precompile_headers(test_${name} REUSE_FROM candela_test_headers)
    include(GoogleTest)
    gtest_discover_tests(
        test_${name}
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        TEST_PREFIX ${name}.
        DISCOVERY_TIMEOUT 60
        PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT ${TEST_TIMEOUT})
endfunction()
