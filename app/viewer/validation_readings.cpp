// SPDX-License-Identifier: MIT
#include "app/viewer/validation_readings.h"

namespace candela {

namespace {

const std::vector<ValidationCase>& all_cases() {
    static const std::vector<ValidationCase> cases = validation_cases();
    return cases;
}

// The mean luminance over the square of five pixels a side that is centred at a point of the film, pixels at its rim
// counted by the part inside; nothing near the border.
std::optional<double> luminance_around(const ImageRgba32f& image, const Vec2& film_uv) {
    constexpr float half_side = 2.5f;
    const Vec2 center = film_uv * Vec2(static_cast<float>(image.width()), static_cast<float>(image.height()));
    const Vec2 lower = center - half_side, upper = center + half_side;
    if (lower.x < 0 || lower.y < 0 || upper.x >= static_cast<float>(image.width()) ||
        upper.y >= static_cast<float>(image.height())) {
        return std::nullopt;
    }
    const auto covered = [](int pixel, float from, float to) {
        return std::min(to, static_cast<float>(pixel + 1)) - std::max(from, static_cast<float>(pixel));
    };
    double sum = 0;
    for (int y = static_cast<int>(lower.y); y <= static_cast<int>(upper.y); ++y) {
        for (int x = static_cast<int>(lower.x); x <= static_cast<int>(upper.x); ++x) {
            const float weight = covered(x, lower.x, upper.x) * covered(y, lower.y, upper.y);
            sum += static_cast<double>(weight * luminance(Vec3(image(x, y))));
        }
    }
    return sum / static_cast<double>(4 * half_side * half_side);
}

bool can_be_seen(const World& world, const Camera& camera, const Vec3& point, const Vec3& film) {
    if (!(film.z > 0.0f) || film.x <= 0.0f || film.x >= 1.0f || film.y <= 0.0f || film.y >= 1.0f) return false;
    if (camera.projection == Projection::orthographic) return true;
    const Vec3 to_point = point - camera.position();
    const float distance = glm::length(to_point);
    constexpr float nearly_all = 0.999f;
    return !is_black(world.accel->transmittance({camera.position(), to_point / distance, nearly_all * distance}));
}

}  // namespace

const std::vector<ValidationScene>& validation_scenes() {
    static const std::vector<ValidationScene> scenes = [] {
        std::vector<ValidationScene> out;
        for (const ValidationCase& c : all_cases()) {
            const bool known =
                std::any_of(out.begin(), out.end(), [&](const ValidationScene& s) { return s.name == c.scene; });
            if (!known) out.push_back({c.scene, c.sky});
        }
        return out;
    }();
    return scenes;
}

std::vector<ValidationReading> read_validation(const std::string& scene_path, const World& world, const View& view,
                                               const Frame* frame) {
    std::vector<ValidationReading> out;
    const std::filesystem::path path(scene_path);
    if (path.parent_path().filename() != "validation") return out;
    const std::string name = path.filename().string();
    const float aspect = static_cast<float>(view.extent.x) / static_cast<float>(std::max(view.extent.y, 1u));
    for (const ValidationCase& c : all_cases()) {
        if (c.scene != name || !c.point) continue;
        ValidationReading reading;
        reading.of = &c;
        const Vec3 film = project(view.camera, aspect, *c.point);
        reading.film_uv = Vec2(film);
        reading.visible = can_be_seen(world, view.camera, *c.point, film);
        if (reading.visible && frame != nullptr && frame->stride == 1) {
            reading.shown = luminance_around(frame->image, reading.film_uv);
            if (reading.shown) *reading.shown /= c.radiance_per_unit;
        }
        out.push_back(reading);
    }
    return out;
}

}  // namespace candela
