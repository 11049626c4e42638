// SPDX-License-Identifier: MIT
// The packaged tinygltf, whose image code is not used, and values of its extension objects.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <string>

namespace candela {

using TinyExtensions = tinygltf::ExtensionMap;

// The extension object, or null.
inline const tinygltf::Value* find_extension(const TinyExtensions& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

inline double number_member(const tinygltf::Value& object, const char* member, double otherwise) {
    return object.Has(member) ? object.Get(member).GetNumberAsDouble() : otherwise;
}

// Element i of an array member, whose length has been validated.
inline double array_member(const tinygltf::Value& object, const char* member, int i, double otherwise) {
    return object.Has(member) ? object.Get(member).Get(i).GetNumberAsDouble() : otherwise;
}

}  // namespace candela
