// SPDX-License-Identifier: MIT
#include "renderer/lights/light_tree.h"

#include <limits>

namespace candela {

namespace {

// cos(max(0, a − b)) of two angles in [0, π].
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

float sine_of(float cosine) {
    return safe_sqrt(1.0f - cosine * cosine);
}

float angle_of(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

struct Cone {
    Vec3 axis{0, 0, 1};
    float cosine = 1;
};

// The smallest cone around two (Barequet and Elber 2005).
Cone cone_around(const Cone& a, const Cone& b) {
    const float angle_a = angle_of(a.cosine), angle_b = angle_of(b.cosine);
    const float between = angle_of(glm::dot(a.axis, b.axis));
    if (std::min(between + angle_b, pi) <= angle_a) return a;
    if (std::min(between + angle_a, pi) <= angle_b) return b;
    const float angle = 0.5f * (angle_a + between + angle_b);
    const Vec3 pole = glm::cross(a.axis, b.axis);
    const float length = glm::length(pole);
    if (angle >= pi || !(length > 1e-6f)) return {a.axis, -1.0f};
    // a's axis turned towards b's (Rodrigues' formula, the axis square to the pole).
    const float turn = angle - angle_a;
    const Vec3 axis = std::cos(turn) * a.axis + std::sin(turn) * glm::cross(pole / length, a.axis);
    return {glm::normalize(axis), std::cos(angle)};
}

LightBounds united(const LightBounds& a, const LightBounds& b) {
    if (!(a.intensity > 0.0f)) return b;
    if (!(b.intensity > 0.0f)) return a;
    LightBounds out;
    out.box = a.box;
    out.box.extend(b.box);
    const Cone cone = cone_around({a.axis, a.cos_normals}, {b.axis, b.cos_normals});
    out.axis = cone.axis;
    out.cos_normals = cone.cosine;
    out.cos_emission = std::min(a.cos_emission, b.cos_emission);
    out.intensity = a.intensity + b.intensity;
    out.two_sided = a.two_sided || b.two_sided;
    return out;
}

// The surface area orientation heuristic: intensity times area times the measure of the directions that are lit.
double cost_of(const LightBounds& bounds, float longest, float along) {
    if (!(bounds.intensity > 0.0f)) return 0.0;
    const double normals = static_cast<double>(angle_of(bounds.cos_normals));
    const double lit = std::min(normals + static_cast<double>(angle_of(bounds.cos_emission)), 3.14159265358979);
    const double sine = std::sin(normals), cosine = std::cos(normals);
    const double directions =
        2 * 3.14159265358979 * (1 - cosine) +
        0.5 * 3.14159265358979 * (2 * lit * sine - std::cos(normals - 2 * lit) - 2 * normals * sine + cosine);
    const Vec3 d = bounds.box.extent();
    const float area = d.x * d.y + d.y * d.z + d.z * d.x;
    // Flat or straight boxes still differ by their length.
    const float size = area + 1e-3f * longest * longest;
    return static_cast<double>(bounds.intensity) * directions * static_cast<double>(size) *
           static_cast<double>(along > 0.0f ? longest / along : 1e6f);
}

}  // namespace

struct LightTree::Build {
    std::span<const LightBounds> lights;
    std::vector<uint32_t> order;
    LightTree& tree;

    // Deeper ways than a word holds are cut short by splitting in halves.
    static constexpr uint32_t deepest_unbalanced = 32;
    static constexpr int bucket_count = 12;

    // Below this many lights of a large scene cuts in the middle will do: the search would cost more than it saves.
    size_t searched_from() const { return order.size() > (size_t{1} << 14) ? 17 : 3; }

    Vec3 center_of(uint32_t light) const { return lights[light].box.center(); }

    // Bounds of the lights in each bucket. The cone's axis is their mean normal, which needs no trigonometry.
    template <typename BucketOf>
    std::array<LightBounds, bucket_count> fill_buckets(std::span<const uint32_t> members,
                                                       const BucketOf& bucket_of) const {
        std::array<LightBounds, bucket_count> out;
        std::array<Vec3, bucket_count> axes{};
        for (const uint32_t light : members) {
            const auto k = static_cast<size_t>(bucket_of(light));
            LightBounds& bucket = out[k];
            bucket.box.extend(lights[light].box);
            bucket.intensity += lights[light].intensity;
            bucket.cos_emission = std::min(bucket.cos_emission, lights[light].cos_emission);
            bucket.two_sided = bucket.two_sided || lights[light].two_sided;
            axes[k] += lights[light].axis;
        }
        for (size_t k = 0; k < out.size(); ++k) {
            const float length = glm::length(axes[k]);
            if (length > 1e-3f) {
                out[k].axis = axes[k] / length;
            } else {
                out[k].cos_normals = -1;
            }
        }
        for (const uint32_t light : members) {
            LightBounds& bucket = out[static_cast<size_t>(bucket_of(light))];
            // cos(a + b), or -1 beyond π.
            const float cos_a = glm::dot(bucket.axis, lights[light].axis), cos_b = lights[light].cos_normals;
            const float sum = cos_a < -cos_b ? -1.0f : cos_a * cos_b - sine_of(cos_a) * sine_of(cos_b);
            bucket.cos_normals = std::min(bucket.cos_normals, sum);
        }
        return out;
    }

    // Where to cut [first, last): by the cheapest of the cuts between buckets along each axis, else in the middle.
    size_t split(size_t first, size_t last, uint32_t depth) {
        const std::span<uint32_t> members = std::span(order).subspan(first, last - first);
        Bounds3 centers, box;
        for (const uint32_t light : members) {
            centers.extend(center_of(light));
            box.extend(lights[light].box);
        }
        const Vec3 extent = centers.extent(), whole = box.extent();
        const float longest = max_component(whole);
        const auto bucket_along = [&](int axis) {
            return [this, axis, lower = centers.lower[axis], width = extent[axis]](uint32_t light) {
                const float at = (center_of(light)[axis] - lower) / width;
                return std::clamp(static_cast<int>(at * bucket_count), 0, bucket_count - 1);
            };
        };

        int best_axis = -1, best_cut = 0;
        double best_cost = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if (members.size() < searched_from() || depth >= deepest_unbalanced) break;
            if (!(extent[axis] > 0.0f) || !std::isfinite(extent[axis])) continue;
            const auto buckets = fill_buckets(members, bucket_along(axis));
            std::array<LightBounds, bucket_count> above = buckets;
            for (size_t k = bucket_count - 1; k-- > 1;)
                above[k] = united(buckets[k], above[k + 1]);
            LightBounds below;
            for (size_t cut = 1; cut < bucket_count; ++cut) {
                below = united(below, buckets[cut - 1]);
                if (!(below.intensity > 0.0f) || !(above[cut].intensity > 0.0f)) continue;
                const double cost = cost_of(below, longest, whole[axis]) + cost_of(above[cut], longest, whole[axis]);
                if (cost < best_cost) {
                    best_cost = cost;
                    best_axis = axis;
                    best_cut = static_cast<int>(cut);
                }
            }
        }
        if (best_axis >= 0) {
            const auto in_bucket = bucket_along(best_axis);
            const auto middle = std::partition(members.begin(), members.end(),
                                               [&](uint32_t light) { return in_bucket(light) < best_cut; });
            if (middle != members.begin() && middle != members.end()) {
                return first + static_cast<size_t>(middle - members.begin());
            }
        }
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const size_t half = members.size() / 2;
        std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
                         [&](uint32_t a, uint32_t b) {
                             const float x = center_of(a)[axis], y = center_of(b)[axis];
                             return x != y ? x < y : a < b;
                         });
        return first + half;
    }

    // Makes the subtree over [first, last) and returns its bounds.
    LightBounds build(size_t first, size_t last, uint64_t way, uint32_t depth) {
        const size_t at = tree.nodes_.size();
        tree.nodes_.emplace_back();
        LightBounds bounds;
        if (last - first == 1) {
            const uint32_t light = order[first];
            bounds = lights[light];
            tree.ways_[light] = way;
            tree.reachable_[light] = 1;
            tree.nodes_[at].is_leaf = true;
            tree.nodes_[at].child_or_light = light;
        } else {
            const size_t middle = split(first, last, depth);
            bounds = build(first, middle, way, depth + 1);
            tree.nodes_[at].child_or_light = static_cast<uint32_t>(tree.nodes_.size());
            bounds = united(bounds, build(middle, last, way | (uint64_t{1} << depth), depth + 1));
        }
        Node& node = tree.nodes_[at];
        node.center = bounds.box.center();
        node.radius_squared = sqr(bounds.box.radius());
        node.axis = bounds.axis;
        node.cos_normals = bounds.cos_normals;
        node.sin_normals = sine_of(bounds.cos_normals);
        node.cos_emission = bounds.cos_emission;
        node.intensity = bounds.intensity;
        node.two_sided = bounds.two_sided;
        return bounds;
    }
};

LightTree::LightTree(std::span<const LightBounds> lights) : ways_(lights.size(), 0), reachable_(lights.size(), 0) {
    Build build{lights, {}, *this};
    for (uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].intensity > 0.0f && std::isfinite(lights[i].intensity)) build.order.push_back(i);
    }
    if (build.order.empty()) return;
    nodes_.reserve(2 * build.order.size());
    build.build(0, build.order.size(), 0, 0);
}

// An upper bound, but for the cosine at the light's centre, of intensity · cos / distance²; section 4 of the paper in
// the form of Pharr et al. 2023, section 12.6.3.
float LightTree::importance(const Node& node, const LightReceiver& receiver) noexcept {
    const Vec3 to_light = node.center - receiver.position;
    const float distance_squared = glm::dot(to_light, to_light);
    const float inverse = distance_squared > 0.0f ? 1.0f / std::sqrt(distance_squared) : 0.0f;
    const Vec3 wi = to_light * inverse;

    // The angle under which the sphere around the lights is seen.
    float cos_seen = -1, sin_seen = 0;
    if (distance_squared > node.radius_squared) {
        const float sin_squared = node.radius_squared / distance_squared;
        sin_seen = std::sqrt(sin_squared);
        cos_seen = std::sqrt(1.0f - sin_squared);
    }

    // The smallest angle between a light's normal and the direction to the receiver.
    float cos_light = -glm::dot(node.axis, wi);
    if (node.two_sided) cos_light = std::abs(cos_light);
    const float sin_light = sine_of(cos_light);
    const float cos_least = cos_of_difference(sin_light, cos_light, node.sin_normals, node.cos_normals);
    const float cos_emitted = cos_of_difference(sine_of(cos_least), cos_least, sin_seen, cos_seen);
    if (!(cos_emitted > node.cos_emission)) return 0.0f;
    float out = node.intensity * cos_emitted / std::max(distance_squared, std::max(node.radius_squared, 1e-30f));

    // The largest cosine at the receiver.
    if (receiver.normal != Vec3(0)) {
        float cos_received = glm::dot(wi, receiver.normal);
        if (receiver.both_sides) cos_received = std::abs(cos_received);
        out *= std::max(cos_of_difference(sine_of(cos_received), cos_received, sin_seen, cos_seen), 0.0f);
    }
    return out;
}

LightTree::Choice LightTree::sample(const LightReceiver& receiver, float u) const noexcept {
    if (nodes_.empty()) return {};
    uint32_t at = 0;
    float probability = 1;
    if (nodes_[0].is_leaf && !(importance(nodes_[0], receiver) > 0.0f)) return {};
    while (!nodes_[at].is_leaf) {
        const uint32_t first = at + 1, second = nodes_[at].child_or_light;
        const float a = importance(nodes_[first], receiver), b = importance(nodes_[second], receiver);
        if (!(a + b > 0.0f)) return {};
        const float share = a / (a + b);
        // What is left of u is uniform again.
        if (u < share) {
            u = std::min(u / share, one_minus_epsilon);
            probability *= share;
            at = first;
        } else {
            u = std::min((u - share) / (1.0f - share), one_minus_epsilon);
            probability *= 1.0f - share;
            at = second;
        }
    }
    return {nodes_[at].child_or_light, probability};
}

float LightTree::probability(uint32_t index, const LightReceiver& receiver) const noexcept {
    if (nodes_.empty() || reachable_[index] == 0) return 0.0f;
    uint32_t at = 0;
    float probability = 1;
    if (nodes_[0].is_leaf) return importance(nodes_[0], receiver) > 0.0f ? 1.0f : 0.0f;
    for (uint64_t way = ways_[index]; !nodes_[at].is_leaf; way >>= 1) {
        const uint32_t first = at + 1, second = nodes_[at].child_or_light;
        const float a = importance(nodes_[first], receiver), b = importance(nodes_[second], receiver);
        if (!(a + b > 0.0f)) return 0.0f;
        const float share = a / (a + b);
        const bool goes_second = (way & 1) != 0;
        probability *= goes_second ? 1.0f - share : share;
        at = goes_second ? second : first;
    }
    return probability;
}

}  // namespace candela
