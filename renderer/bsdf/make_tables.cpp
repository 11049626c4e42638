// SPDX-License-Identifier: MIT
// Run by the build: writes each table as the initializer of its struct, exact to the bit, to a file in the working
// folder.
#include <cstdio>

#include "renderer/bsdf/albedo_integral.h"
#include "renderer/bsdf/interface_integral.h"
#include "renderer/bsdf/sheen_integral.h"

namespace {

using namespace candela;

void print(FILE* to, float value) {
    std::fprintf(to, "%af,", static_cast<double>(value));
}

void print(FILE* to, const SpecularAlbedo& a) {
    std::fprintf(to, "{");
    print(to, a.scale);
    print(to, a.bias);
    std::fprintf(to, "},");
}

void print(FILE* to, const MeanSpecularAlbedo& m) {
    std::fprintf(to, "{");
    print(to, m.single);
    print(to, m.compensated);
    std::fprintf(to, "},");
}

template <typename T, size_t n>
void print(FILE* to, const std::array<T, n>& values) {
    std::fprintf(to, "{{");
    for (const T& value : values)
        print(to, value);
    std::fprintf(to, "}},\n");
}

template <typename... Members>
bool write(const char* path, const Members&... members) {
    FILE* to = std::fopen(path, "w");
    if (to == nullptr) return false;
    std::fprintf(to, "{");
    (print(to, members), ...);
    std::fprintf(to, "}\n");
    return std::fclose(to) == 0;
}

}  // namespace

int main() {
    const AlbedoTables isotropic = AlbedoTables::integrated();
    const bool written = write("albedo_values.inc", isotropic.albedo, isotropic.mean) &&
                         write("anisotropic_values.inc", AnisotropicTable::integrated().albedo) &&
                         write("interface_values.inc", InterfaceTable::integrated().albedo) &&
                         write("sheen_values.inc", SheenTable::integrated().albedo);
    return written ? 0 : 1;
}
