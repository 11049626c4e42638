// SPDX-License-Identifier: MIT
// Run by the build: writes the tables of isotropic albedo as the initializer of an AlbedoTables, exact to the bit.
// usage: make_albedo_table FILE
#include <cstdio>

#include "renderer/bsdf/albedo_integral.h"

namespace {

void print(FILE* to, const candela::SpecularAlbedo& a) {
    std::fprintf(to, "{%af, %af},", static_cast<double>(a.scale), static_cast<double>(a.bias));
}

}  // namespace

int main(int argc, char** argv) {
    FILE* to = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
    if (to == nullptr) return 1;
    const candela::AlbedoTables tables = candela::AlbedoTables::integrated();
    std::fprintf(to, "{{{");
    for (const auto& row : tables.albedo) {
        std::fprintf(to, "\n{{");
        for (const candela::SpecularAlbedo& a : row)
            print(to, a);
        std::fprintf(to, "}},");
    }
    std::fprintf(to, "}},\n{{");
    for (const candela::MeanSpecularAlbedo& m : tables.mean) {
        std::fprintf(to, "\n{");
        print(to, m.single);
        print(to, m.compensated);
        std::fprintf(to, "},");
    }
    std::fprintf(to, "}}}\n");
    return std::fclose(to) == 0 ? 0 : 1;
}
