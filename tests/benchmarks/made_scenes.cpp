// SPDX-License-Identifier: MIT
#include "tests/benchmarks/made_scenes.h"

#include <fstream>
#include <random>

#include <nlohmann/json.hpp>

#include "renderer/math/math.h"

namespace candela::bench {

namespace {

using Json = nlohmann::json;

// Three waves in each of seven octaves.
class HeightField {
  public:
    HeightField() {
        std::mt19937 random(3);
        const auto angle = [&] { return 6.2831853 * static_cast<double>(random()) / 4294967296.0; };
        for (int octave = 0; octave < 7; ++octave) {
            for (int k = 0; k < 3; ++k) {
                const double frequency = 0.35 * std::pow(2.0, octave), turn = angle();
                waves_.push_back(
                    {frequency * std::cos(turn), frequency * std::sin(turn), angle(), 0.5 * std::pow(1.7, -octave)});
            }
        }
    }
    // Height, and its slopes along x and z.
    glm::dvec3 at(double x, double z) const {
        glm::dvec3 out(0);
        for (const Wave& w : waves_) {
            const double phase = w.kx * x + w.kz * z + w.phase;
            const double c = w.amplitude * std::cos(phase);
            out += glm::dvec3(w.amplitude * std::sin(phase), c * w.kx, c * w.kz);
        }
        return out;
    }

  private:
    struct Wave {
        double kx, kz, phase, amplitude;
    };
    std::vector<Wave> waves_;
};

template <typename T>
void append(std::string& to, const std::vector<T>& values) {
    to.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

void write_glb(const std::filesystem::path& path, const Json& document, const std::string& bin) {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream file(path, std::ios::binary);
    const auto word = [&](size_t value) {
        const auto bits = static_cast<uint32_t>(value);
        file.write(reinterpret_cast<const char*>(&bits), sizeof(bits));
    };
    file << "glTF";
    word(2);
    word(28 + text.size() + bin.size());
    word(text.size());
    file << "JSON" << text;
    word(bin.size());
    file.write("BIN\0", 4);
    file << bin;
}

}  // namespace

std::filesystem::path terrain_file() {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "candela_bench_terrain.glb";
    if (std::filesystem::exists(path)) return path;
    constexpr uint32_t n = 1000, row = n + 1;
    constexpr double size_m = 40;
    const HeightField field;
    std::vector<Vec3> positions, normals;
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i <= n; ++i) {
            const double x = size_m * (i / double{n} - 0.5), z = size_m * (j / double{n} - 0.5);
            const glm::dvec3 height = field.at(x, z);
            positions.emplace_back(x, height.x, z);
            normals.emplace_back(glm::normalize(glm::dvec3(-height.y, 1, -height.z)));
        }
    }
    std::vector<Vec3u> triangles;
    for (uint32_t j = 0; j < n; ++j) {
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * row + i, b = a + row;
            triangles.emplace_back(a, b, a + 1);
            triangles.emplace_back(a + 1, b, b + 1);
        }
    }
    std::string bin;
    Json views, accessors;
    const auto add = [&](const auto& values, const char* type, int component, size_t count) {
        views.push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", values.size() * sizeof(values[0])}});
        append(bin, values);
        accessors.push_back(
            {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    };
    add(positions, "VEC3", 5126, positions.size());
    add(normals, "VEC3", 5126, normals.size());
    add(triangles, "SCALAR", 5125, 3 * triangles.size());
    const Json primitive = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}};
    write_glb(path,
              {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", Json::array({primitive})}}}},
               {"buffers", {{{"byteLength", bin.size()}}}},
               {"bufferViews", views},
               {"accessors", accessors}},
              bin);
    return path;
}

}  // namespace candela::bench
