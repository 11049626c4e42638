# SPDX-License-Identifier: MIT
# cmake -DSHADERS=a.vert;b.frag -DOUTPUT=shaders.cpp -P embed.cmake: each file as the string constant a_vert, b_frag.

set(text "#include \"shaders/shaders.h\"\n\nnamespace candela::shaders {\n")
foreach(path IN LISTS SHADERS)
    get_filename_component(name ${path} NAME)
    string(REPLACE "." "_" name ${name})
    file(READ ${path} source)
    string(APPEND text "const char* const ${name} = R\"glsl(${source})glsl\";\n")
endforeach()
string(APPEND text "}\n")
file(WRITE ${OUTPUT} "${text}")
