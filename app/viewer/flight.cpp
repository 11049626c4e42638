// SPDX-License-Identifier: MIT
#include "app/viewer/flight.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

constexpr float crossings_per_second = 0.125f;  // of the scene's diagonal
constexpr float fast_factor = 4, factor_per_step = 1.25f;
constexpr float slowest = 1e-3f, fastest = 1e3f;
constexpr float turns_per_second = 1;  // of the picture's height

struct FlightKey {
    Key key;
    Vec3 move;  // right, up, forward
    Vec2 turn;  // as a drag of the picture
};

constexpr FlightKey keys[] = {{Key::w, {0, 0, 1}, {0, 0}},    {Key::s, {0, 0, -1}, {0, 0}},
                              {Key::d, {1, 0, 0}, {0, 0}},    {Key::a, {-1, 0, 0}, {0, 0}},
                              {Key::e, {0, 1, 0}, {0, 0}},    {Key::q, {0, -1, 0}, {0, 0}},
                              {Key::left, {0, 0, 0}, {1, 0}}, {Key::right, {0, 0, 0}, {-1, 0}},
                              {Key::up, {0, 0, 0}, {0, 1}},   {Key::down, {0, 0, 0}, {0, -1}}};

}  // namespace

void Flight::toggle() {
    on_ = !on_;
    held_ = 0;
}

bool Flight::handle(const KeyPressed& event) {
    if (!on_) return false;
    fast_ = event.key == Key::shift ? event.pressed : event.modifiers.shift;
    if (event.key == Key::shift) return true;
    for (size_t i = 0; i < std::size(keys); ++i) {
        if (keys[i].key != event.key) continue;
        const unsigned bit = 1u << i;
        // What is pressed with Ctrl or Alt means something else, but every release ends a movement.
        if (event.pressed && (event.modifiers.ctrl || event.modifiers.alt)) return false;
        held_ = event.pressed ? held_ | bit : held_ & ~bit;
        return true;
    }
    return false;
}

void Flight::change_speed(float steps) {
    factor_ = std::clamp(factor_ * std::pow(factor_per_step, steps), slowest, fastest);
}

float Flight::speed(float scene_size_m) const {
    return crossings_per_second * factor_ * scene_size_m;
}

OrbitView Flight::advance(const OrbitView& view, double dt_s, float scene_size_m) const {
    if (!moves() || !(dt_s > 0)) return view;
    Vec3 move(0);
    Vec2 turn(0);
    for (size_t i = 0; i < std::size(keys); ++i) {
        if ((held_ & (1u << i)) == 0) continue;
        move += keys[i].move;
        turn += keys[i].turn;
    }
    const auto dt = static_cast<float>(dt_s);
    // Across is not faster than along.
    if (move != Vec3(0)) move = glm::normalize(move);
    OrbitView out = fly(view, dt * (fast_ ? fast_factor : 1.0f) * speed(scene_size_m) * move);
    if (turn != Vec2(0)) out = look_around(out, dt * turns_per_second * turn);
    return out;
}

}  // namespace candela
