# SPDX-License-Identifier: MIT
# Runs the generator into OUT and compares every file with the committed one.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
execute_process(COMMAND ${PYTHON} ${ASSETS}/generate.py ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE made RELATIVE ${OUT} ${OUT}/*)
foreach(name IN LISTS made)
    file(SHA256 ${OUT}/${name} fresh)
    file(SHA256 ${ASSETS}/${name} committed)
    if(NOT fresh STREQUAL committed)
        message(FATAL_ERROR "assets/${name} is not what assets/generate.py writes; run it and commit the result")
    endif()
endforeach()
