// SPDX-License-Identifier: MIT
// The exact values of a validation scene beside what the picture shows of it so far.
#pragma once

#include "app/validation/case.h"
#include "app/viewer/viewer_model.h"
#include "renderer/film/frame.h"

namespace candela {

struct ValidationReading {
    const ValidationCase* of = nullptr;
    Vec2 film_uv{0};  // where its point appears
    bool visible = false;
    std::optional<double> shown;  // in units of the exact value; the mean of a few pixels around it
};

// A scene of assets/validation by its name, in the order of the report, with the sky that its cases want.
struct ValidationScene {
    std::string name;
    std::optional<float> sky;
};
const std::vector<ValidationScene>& validation_scenes();

// For the cases whose point any camera can look at; empty for other scenes. frame may be null.
std::vector<ValidationReading> read_validation(const std::string& scene_path, const World& world, const View& view,
                                               const Frame* frame);

}  // namespace candela
