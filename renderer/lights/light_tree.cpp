// SPDX-License-Identifier: MIT
#include "renderer/lights/light_tree.h"

#include <bit>
#include <limits>
#include <memory>

#include "renderer/math/parallel.h"

namespace candela {

namespace {

// cos(max(0, a − b)) of two angles in [0, π].
Float4 cos_of_difference(Float4 sin_a, Float4 cos_a, Float4 sin_b, Float4 cos_b) {
    return select4(cos_a > cos_b, splat4(1), cos_a * cos_b + sin_a * sin_b);
}

Float4 sine_of(Float4 cosine) {
    return sqrt4(max4(1.0f - cosine * cosine, splat4(0)));
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

    // A way of more branches than a word holds would be lost: where it comes to that, halves keep it short.
    static constexpr uint32_t deepest = 64 / bits_per_level;
    static constexpr int bucket_count = 12;
    // Fewer lights are not worth another core.
    static constexpr size_t parallel_from = 2048;

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
            // cos(a + b), or -1 beyond π; most lights have one normal.
            const float cos_a = glm::dot(bucket.axis, lights[light].axis), cos_b = lights[light].cos_normals;
            const float sum = cos_a < -cos_b  ? -1.0f
                              : cos_b == 1.0f ? cos_a
                                              : cos_a * cos_b - sine_of(cos_a) * sine_of(cos_b);
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
            if (members.size() < searched_from() || depth + std::bit_width(members.size()) >= deepest) break;
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

    // A part of the order with the bounds of its lights, and where it is cut.
    struct Part {
        size_t first = 0, last = 0;
        LightBounds bounds;
        std::unique_ptr<Part> below, above;

        bool is_light() const { return last - first == 1; }
    };

    // The binary tree over [first, last).
    std::unique_ptr<Part> divide(size_t first, size_t last, uint32_t depth) {
        auto part = std::make_unique<Part>();
        part->first = first;
        part->last = last;
        if (part->is_light()) {
            part->bounds = lights[order[first]];
            return part;
        }
        const size_t middle = split(first, last, depth);
        // The order of each half is its own: which comes first makes no difference.
        const auto divide_below = [&] { part->below = divide(first, middle, depth + 1); };
        const auto divide_above = [&] { part->above = divide(middle, last, depth + 1); };
        if (last - first < parallel_from) {
            divide_below();
            divide_above();
        } else {
            parallel_pair(divide_below, divide_above);
        }
        part->bounds = united(part->below->bounds, part->above->bounds);
        return part;
    }

    // Makes the node of a part: its halves, of which the brightest are opened until there are four.
    uint32_t make_node(std::unique_ptr<Part> part, uint64_t way, uint32_t depth) {
        std::vector<std::unique_ptr<Part>> branches;
        branches.push_back(std::move(part));
        while (branches.size() < width) {
            size_t brightest = branches.size();
            for (size_t k = 0; k < branches.size(); ++k) {
                if (branches[k]->is_light()) continue;
                if (brightest == branches.size() ||
                    branches[k]->bounds.intensity > branches[brightest]->bounds.intensity) {
                    brightest = k;
                }
            }
            if (brightest == branches.size()) break;
            const std::unique_ptr<Part> opened = std::move(branches[brightest]);
            branches[brightest] = std::move(opened->below);
            branches.push_back(std::move(opened->above));
        }

        const auto at = static_cast<uint32_t>(tree.nodes_.size());
        tree.nodes_.emplace_back();
        for (uint32_t k = 0; k < branches.size(); ++k) {
            put(branches[k]->bounds, k, tree.nodes_[at]);
            const uint64_t here = way | (uint64_t{k} << (bits_per_level * depth));
            const bool is_light = branches[k]->is_light();
            uint32_t child = 0;
            if (is_light) {
                child = order[branches[k]->first];
                tree.ways_[child] = here;
                tree.reachable_[child] = 1;
            } else {
                child = make_node(std::move(branches[k]), here, depth + 1);
            }
            tree.nodes_[at].child[k] = child;
            tree.nodes_[at].is_light[k] = is_light ? 1 : 0;
        }
        return at;
    }

    static void put(const LightBounds& bounds, uint32_t k, Node& node) {
        const Vec3 center = bounds.box.center();
        for (int axis = 0; axis < 3; ++axis) {
            node.center[axis][k] = center[axis];
            node.axis[axis][k] = bounds.axis[axis];
        }
        node.radius_squared[k] = sqr(bounds.box.radius());
        node.cos_normals[k] = bounds.cos_normals;
        node.sin_normals[k] = sine_of(bounds.cos_normals);
        node.cos_emission[k] = bounds.cos_emission;
        node.intensity[k] = bounds.intensity;
        node.two_sided[k] = bounds.two_sided ? 1.0f : 0.0f;
    }
};

LightTree::LightTree(std::span<const LightBounds> lights) : ways_(lights.size(), 0), reachable_(lights.size(), 0) {
    Build build{lights, {}, *this};
    for (uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].intensity > 0.0f && std::isfinite(lights[i].intensity)) build.order.push_back(i);
    }
    if (build.order.empty()) return;
    nodes_.reserve(build.order.size() / 2 + 1);
    build.make_node(build.divide(0, build.order.size(), 0), 0, 0);
}

// An upper bound, but for the cosine at the light's centre, of intensity · cos / distance²; section 4 of the paper in
// the form of Pharr et al. 2023, section 12.6.3.
Float4 LightTree::weigh(const Node& node, const LightReceiver& receiver) noexcept {
    const Vec3 from = receiver.position, normal = receiver.normal;
    const Float4 x = node.center[0] - from.x, y = node.center[1] - from.y, z = node.center[2] - from.z;
    const Float4 distance_squared = x * x + y * y + z * z;
    const Float4 inverse = 1.0f / sqrt4(max4(distance_squared, splat4(1e-36f)));

    // The angle under which the sphere around the lights is seen; from inside, all around.
    const Mask4 is_outside = distance_squared > node.radius_squared;
    const Float4 sin_squared = min4(node.radius_squared * inverse * inverse, splat4(1));
    const Float4 sin_seen = select4(is_outside, sqrt4(sin_squared), splat4(0));
    const Float4 cos_seen = select4(is_outside, sqrt4(1.0f - sin_squared), splat4(-1));

    // The smallest angle between a light's normal and the direction to the receiver.
    const Float4 along = -(node.axis[0] * x + node.axis[1] * y + node.axis[2] * z) * inverse;
    const Float4 cos_light = select4(node.two_sided > 0.0f, abs4(along), along);
    const Float4 cos_least = cos_of_difference(sine_of(cos_light), cos_light, node.sin_normals, node.cos_normals);
    const Float4 cos_emitted = cos_of_difference(sine_of(cos_least), cos_least, sin_seen, cos_seen);
    const Float4 nearest = max4(distance_squared, max4(node.radius_squared, splat4(1e-30f)));
    const Float4 sent = select4(cos_emitted > node.cos_emission, node.intensity * cos_emitted / nearest, splat4(0));
    if (normal == Vec3(0)) return sent;

    // The largest cosine at the receiver.
    const Float4 facing = (normal.x * x + normal.y * y + normal.z * z) * inverse;
    const Float4 cos_received = receiver.both_sides ? abs4(facing) : facing;
    return sent * max4(cos_of_difference(sine_of(cos_received), cos_received, sin_seen, cos_seen), splat4(0));
}

LightTree::Choice LightTree::sample(const LightReceiver& receiver, float u) const noexcept {
    if (nodes_.empty()) return {};
    float probability = 1;
    for (uint32_t at = 0;;) {
        const Node& node = nodes_[at];
        const Float4 weights = weigh(node, receiver);
        const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
        if (!(sum > 0.0f)) return {};

        // The last branch that has light takes what rounding leaves; what is left of u is uniform again.
        float rest = u * sum;
        uint32_t taken = width;
        for (uint32_t k = 0; k < width; ++k) {
            if (!(weights[k] > 0.0f)) continue;
            if (taken < width) rest -= weights[taken];
            taken = k;
            if (rest < weights[k]) break;
        }
        u = std::clamp(rest / weights[taken], 0.0f, one_minus_epsilon);
        probability *= weights[taken] / sum;
        at = node.child[taken];
        if (node.is_light[taken] != 0) return {at, probability};
    }
}

float LightTree::probability(uint32_t index, const LightReceiver& receiver) const noexcept {
    if (nodes_.empty() || reachable_[index] == 0) return 0.0f;
    float probability = 1;
    uint64_t way = ways_[index];
    for (uint32_t at = 0;; way >>= bits_per_level) {
        const Node& node = nodes_[at];
        const Float4 weights = weigh(node, receiver);
        const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
        const auto taken = static_cast<uint32_t>(way & (width - 1));
        if (!(weights[taken] > 0.0f)) return 0.0f;
        probability *= weights[taken] / sum;
        at = node.child[taken];
        if (node.is_light[taken] != 0) return probability;
    }
}

}  // namespace candela
