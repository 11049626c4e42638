// SPDX-License-Identifier: MIT
// A file with animations.
#pragma once

#include <fstream>
#include <string>

namespace candela::test {

// A red square that slides two metres to the right within a second, and a camera that goes back four within a half.
inline void write_sliding_square(const std::string& path) {
    constexpr const char* buffer =
        "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"
        "AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAAAAAAAAAAAPwAAAAAAAAAAAACAQAAAAAAAAAAA"
        "AAAAQQ==";
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
            "nodes":[{"mesh":0},{"camera":0,"translation":[0,0,4]}],
            "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
            "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.1,0.1,1],"metallicFactor":0}}],
            "animations":[{"name":"slide","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
                           "samplers":[{"input":2,"output":3}]},
                          {"name":"back","channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}],
                           "samplers":[{"input":4,"output":5}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
                         {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
                         {"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
                         {"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
                         {"bufferView":4,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[0.5]},
                         {"bufferView":5,"componentType":5126,"count":2,"type":"VEC3"}],
            "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":8},{"buffer":0,"byteOffset":68,"byteLength":24},{"buffer":0,"byteOffset":92,"byteLength":8},{"buffer":0,"byteOffset":100,"byteLength":24}],
            "buffers":[{"byteLength":124,"uri":"data:application/octet-stream;base64,)"
                        << buffer << "\"}]}";
}

}  // namespace candela::test
