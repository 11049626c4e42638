# SPDX-License-Identifier: MIT
# One static library per room of the renderer, one test program per room.

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
    target_precompile_headers(
        candela_${name}
        PRIVATE
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
    target_precompile_headers(test_${name} PRIVATE <gtest/gtest.h> <vector> <string> <memory> <glm/glm.hpp>)
    include(GoogleTest)
    gtest_discover_tests(
        test_${name}
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        TEST_PREFIX ${name}.
        DISCOVERY_TIMEOUT 60
        PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT ${TEST_TIMEOUT})
endfunction()
