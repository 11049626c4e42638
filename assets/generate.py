#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes candela's own small scenes as .glb, with nothing but the standard library.

usage: assets/generate.py [FOLDER]      (default: the folder of this file)

The output is the same to the byte at every run; a test compares it with what is committed. Emitters are one-sided and face their
target; materials that must scatter exactly as Lambert has it carry KHR_materials_specular with specularFactor 0.
"""
import array
import json
import math
import pathlib
import random
import struct
import sys
import zlib


class Glb:
    """Collects meshes, materials and nodes, and packs them."""

    def __init__(self):
        self.bytes = bytearray()
        self.views, self.accessors, self.meshes, self.materials = [], [], [], []
        self.nodes, self.cameras, self.images, self.textures, self.lights = [], [], [], [], []
        self.extensions = set()

    def add_view(self, data, target=None):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        view = dict(buffer=0, byteOffset=len(self.bytes), byteLength=len(data))
        if target:
            view["target"] = target
        self.bytes += data
        self.views.append(view)
        return len(self.views) - 1

    def add_accessor(self, values, kind, component):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
        flat = array.array("f" if component == 5126 else "I", [x for v in values for x in (v if width > 1 else (v,))])
        accessor = dict(bufferView=self.add_view(flat.tobytes(), 34962 if component == 5126 else 34963), componentType=component,
                        count=len(values), type=kind)
        if kind == "VEC3":
            accessor["min"] = [min(flat[c::3]) for c in range(3)]
            accessor["max"] = [max(flat[c::3]) for c in range(3)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def material(self, name, color=(0.8, 0.8, 0.8), metallic=0.0, roughness=1.0, lambert=False, emission=None, **more):
        pbr = dict(baseColorFactor=[*color, more.pop("alpha", 1.0)], metallicFactor=metallic, roughnessFactor=roughness)
        if "texture" in more:
            pbr["baseColorTexture"] = dict(index=more.pop("texture"))
        material = dict(name=name, pbrMetallicRoughness=pbr, **more)
        extensions = material.setdefault("extensions", {})
        if lambert:
            extensions["KHR_materials_specular"] = dict(specularFactor=0.0)
        if emission:
            peak = max(emission)
            material["emissiveFactor"] = [c / peak for c in emission]
            extensions["KHR_materials_emissive_strength"] = dict(emissiveStrength=peak)
        self.extensions |= set(extensions)
        if not extensions:
            del material["extensions"]
        self.materials.append(material)
        return len(self.materials) - 1

    def mesh(self, name, material, positions, triangles, normals=None, uv=None, translation=None):
        attributes = dict(POSITION=self.add_accessor(positions, "VEC3", 5126))
        if normals:
            attributes["NORMAL"] = self.add_accessor(normals, "VEC3", 5126)
        if uv:
            attributes["TEXCOORD_0"] = self.add_accessor(uv, "VEC2", 5126)
        indices = self.add_accessor([i for t in triangles for i in t], "SCALAR", 5125)
        self.meshes.append(dict(name=name, primitives=[dict(attributes=attributes, indices=indices, material=material)]))
        return self.place(name, len(self.meshes) - 1, translation)

    def place(self, name, mesh, translation=None):
        node = dict(name=name, mesh=mesh)
        if translation:
            node["translation"] = list(translation)
        self.nodes.append(node)
        return mesh

    def quad(self, name, material, origin, a, b, uv=False):
        """The parallelogram whose front is where a × b points."""
        corner = lambda s, t: tuple(origin[i] + s * a[i] + t * b[i] for i in range(3))
        self.mesh(name, material, [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)], [(0, 1, 2), (0, 2, 3)],
                  uv=[(0, 1), (1, 1), (1, 0), (0, 0)] if uv else None)

    def block(self, name, material, center, size, yaw=0.0):
        c, s = math.cos(yaw), math.sin(yaw)
        axis = [(c * size[0], 0, -s * size[0]), (0, size[1], 0), (s * size[2], 0, c * size[2])]
        positions, triangles = [], []
        for k in range(3):
            for side in (1, -1):
                a, b, n = axis[(k + 1) % 3], axis[(k + 2) % 3], axis[k]
                if side < 0:
                    a, b = b, a
                first = len(positions)
                for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    positions.append(tuple(center[i] + 0.5 * (side * n[i] + u * a[i] + v * b[i]) for i in range(3)))
                triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
        self.mesh(name, material, positions, triangles)

    def sphere(self, name, material, center, radius, segments, smooth=True, inward=False):
        rings = segments // 2
        points, triangles = [], []
        for j in range(rings + 1):
            theta = math.pi * j / rings
            for i in range(segments + 1):
                phi = 2 * math.pi * (i % segments) / segments
                points.append((math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi)))
        at = lambda i, j: j * (segments + 1) + i
        for j in range(rings):
            for i in range(segments):
                if j + 1 < rings:
                    triangles.append((at(i, j), at(i, j + 1), at(i + 1, j + 1)))
                if j > 0:
                    triangles.append((at(i, j), at(i + 1, j + 1), at(i + 1, j)))
        if inward:
            triangles = [(a, c, b) for a, b, c in triangles]
        sign = -1 if inward else 1
        self.mesh(name, material, [tuple(radius * x for x in p) for p in points], triangles,
                  normals=[tuple(sign * x for x in p) for p in points] if smooth else None, translation=center)

    def texture(self, name, width, height, pixel):
        """An RGBA PNG whose pixel (x, y) is pixel(x, y), four bytes."""
        rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
        chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
        self.images.append(dict(name=name, mimeType="image/png", bufferView=self.add_view(png)))
        self.textures.append(dict(source=len(self.images) - 1))
        return len(self.textures) - 1

    def camera(self, eye, target, yfov_degrees, aspect=None):
        back = [eye[i] - target[i] for i in range(3)]
        length = math.sqrt(sum(x * x for x in back))
        back = [x / length for x in back]
        right = [back[2], 0, -back[0]]
        length = math.hypot(right[0], right[2])
        right = [x / length for x in right]
        up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
              back[0] * right[1] - back[1] * right[0]]
        perspective = dict(yfov=math.radians(yfov_degrees), znear=0.001)
        if aspect:
            perspective["aspectRatio"] = aspect
        self.cameras.append(dict(type="perspective", perspective=perspective))
        self.nodes.append(dict(name="camera", camera=len(self.cameras) - 1,
                               matrix=[*right, 0, *up, 0, *back, 0, *eye, 1]))

    def light(self, light, **place):
        self.lights.append(light)
        self.extensions.add("KHR_lights_punctual")
        self.nodes.append(dict(name="light", **{key: list(value) for key, value in place.items()},
                               extensions=dict(KHR_lights_punctual=dict(light=len(self.lights) - 1))))

    def point_light(self, position, intensity):
        self.light(dict(type="point", intensity=intensity), translation=position)

    def pack(self):
        document = dict(asset=dict(version="2.0", generator="candela assets/generate.py", copyright="CC0"), scene=0,
                        scenes=[dict(nodes=list(range(len(self.nodes))))], nodes=self.nodes, meshes=self.meshes,
                        materials=self.materials, accessors=self.accessors, bufferViews=self.views,
                        buffers=[dict(byteLength=len(self.bytes))])
        for name in ("cameras", "images", "textures"):
            if getattr(self, name):
                document[name] = getattr(self, name)
        if self.extensions:
            document["extensionsUsed"] = sorted(self.extensions)
        if self.lights:
            document["extensions"] = dict(KHR_lights_punctual=dict(lights=self.lights))
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.bytes) + b"\0" * (-len(self.bytes) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def cornell_box():
    g = Glb()
    white = g.material("white", (0.73, 0.73, 0.73), lambert=True)
    red = g.material("red", (0.65, 0.05, 0.05), lambert=True)
    green = g.material("green", (0.12, 0.45, 0.15), lambert=True)
    lamp = g.material("lamp", (0, 0, 0), lambert=True, emission=(40, 34, 26))
    g.quad("floor", white, (-1, 0, 1), (2, 0, 0), (0, 0, -2))
    g.quad("ceiling", white, (-1, 2, -1), (2, 0, 0), (0, 0, 2))
    g.quad("back wall", white, (-1, 0, -1), (2, 0, 0), (0, 2, 0))
    g.quad("left wall", red, (-1, 0, 1), (0, 0, -2), (0, 2, 0))
    g.quad("right wall", green, (1, 0, -1), (0, 0, 2), (0, 2, 0))
    g.quad("lamp", lamp, (-0.24, 1.98, -0.2), (0.48, 0, 0), (0, 0, 0.4))
    g.block("tall block", white, (-0.35, 0.6, -0.3), (0.6, 1.2, 0.6), math.radians(18))
    g.block("short block", white, (0.35, 0.3, 0.35), (0.6, 0.6, 0.6), math.radians(-17))
    g.camera((0, 1, 4.9), (0, 1, 0), 28, 1.0)
    return g


def strip_light():
    g = Glb()
    plane = g.material("lambert", (1, 1, 1), lambert=True)
    strip = g.material("strip", (0, 0, 0), lambert=True, emission=(1, 1, 1))
    g.quad("plane", plane, (-100, 0, 100), (200, 0, 0), (0, 0, -200))
    g.quad("strip", strip, (-1, 1, -1000), (2, 0, 0), (0, 0, 2000))
    g.camera((0, 0.9, 0.01), (0, 0, 0), 120, 3.0)
    return g


def furnace_sphere():
    g = Glb()
    g.sphere("sphere", g.material("lambert", (1, 1, 1), lambert=True), (0, 0, 0), 1, 64, smooth=False)
    g.camera((0, 0, 4), (0, 0, 0), 40, 1.0)
    return g


def integrating_sphere(albedo=0.5):
    g = Glb()
    g.sphere("sphere", g.material("wall", (albedo, albedo, albedo), lambert=True, emission=(1, 1, 1)), (0, 0, 0), 1, 48, smooth=False, inward=True)
    g.camera((0, 0, 0.1), (0, 0, 0), 60, 1.0)
    return g


def point_light_plane():
    g = Glb()
    g.quad("plane", g.material("lambert", (1, 1, 1), lambert=True), (-100, 0, 100), (200, 0, 0), (0, 0, -200))
    g.point_light((0, 1, 0), 100 / (4 * math.pi))
    g.camera((0, 3, 4), (0, 0, 0), 45)
    return g


def veach_plates():
    g = Glb()
    g.quad("floor", g.material("floor", (0.4, 0.4, 0.4), lambert=True), (-10, -1, 10), (20, 0, 0), (0, 0, -20))
    g.quad("wall", g.material("wall", (0.4, 0.4, 0.4), lambert=True), (-10, -1, -4), (20, 0, 0), (0, 12, 0))
    # Each plate mirrors the row of lamps towards the eye.
    eye, lamps = (0, 2, 9), (0, 3.2, -2.5)
    for k, roughness in enumerate((0.08, 0.18, 0.3, 0.45)):
        z = 3.4 - 1.5 * k
        center = (0, -0.6 + 0.25 * k, z)
        to = lambda p: [p[i] - center[i] for i in range(3)]
        unit = lambda v: [x / math.sqrt(sum(y * y for y in v)) for x in v]
        half = unit([a + b for a, b in zip(unit(to(eye)), unit(to(lamps)))])
        along = (0, half[2], -half[1])
        metal = g.material("roughness %g" % roughness, (0.9, 0.9, 0.9), 1.0, roughness)
        g.quad("plate %d" % (k + 1), metal, tuple(center[i] - (3.2 if i == 0 else 0) + 0.55 * (-along[i]) for i in range(3)),
               (6.4, 0, 0), tuple(1.1 * x for x in along))
    for k, radius in enumerate((0.03, 0.12, 0.36, 0.9)):
        power = 8.0 / (radius * radius)
        hue = ((1.0, 0.6, 0.4), (0.9, 0.9, 0.5), (0.5, 0.9, 0.7), (0.5, 0.7, 1.0))[k]
        g.sphere("lamp %d" % (k + 1), g.material("lamp %d" % (k + 1), (0, 0, 0), lambert=True, emission=[0.3 * power * c for c in hue]),
                 (-3.0 + 1.9 * k, 3.2, -2.5), radius, 24)
    g.camera(eye, (0, 0.7, 0), 40, 16 / 9)
    return g


def glass_slab():
    g = Glb()
    checker = g.texture("checker", 64, 64, lambda x, y: (230, 230, 230, 255) if (x // 8 + y // 8) % 2 else (40, 60, 120, 255))
    g.quad("board", g.material("board", (1, 1, 1), lambert=True, texture=checker), (-1, 0, 1), (2, 0, 0), (0, 0, -2), uv=True)
    glass = g.material("glass", (1, 1, 1), 0, 0, extensions={
        "KHR_materials_transmission": dict(transmissionFactor=1.0), "KHR_materials_ior": dict(ior=1.5),
        "KHR_materials_volume": dict(thicknessFactor=0.2, attenuationDistance=0.5, attenuationColor=[0.7, 0.95, 0.8])})
    g.block("slab", glass, (0, 0.3, 0), (1, 0.2, 1))
    g.quad("lamp", g.material("lamp", (0, 0, 0), lambert=True, emission=(8, 8, 8)), (-0.5, 2, -0.5), (1, 0, 0), (0, 0, 1))
    g.camera((1.2, 1.6, 2.2), (0, 0.1, 0), 40, 16 / 9)
    return g


def alpha_cards():
    g = Glb()
    leaf = g.texture("disc", 64, 64, lambda x, y: (90, 160, 60, 255 if math.hypot(x - 31.5, y - 31.5) < 26 else 0))
    ramp = g.texture("ramp", 64, 8, lambda x, y: (220, 80, 60, 4 * x))
    g.quad("floor", g.material("floor", (0.7, 0.7, 0.7), lambert=True), (-3, 0, 3), (6, 0, 0), (0, 0, -6))
    cut = g.material("cut out", (1, 1, 1), texture=leaf, alphaMode="MASK", alphaCutoff=0.5, doubleSided=True, roughness=0.8)
    blended = g.material("blended", (1, 1, 1), texture=ramp, alphaMode="BLEND", doubleSided=True, roughness=0.8)
    for k in range(3):
        g.quad("leaf %d" % (k + 1), cut, (-1.6 + 0.5 * k, 0.1, -0.4 * k), (0.9, 0, 0.2), (0, 0.9, 0), uv=True)
    g.quad("veil", blended, (0.2, 0.1, 0.4), (1.4, 0, -0.3), (0, 1.1, 0), uv=True)
    g.quad("lamp", g.material("lamp", (0, 0, 0), lambert=True, emission=(12, 11, 10)), (-0.6, 3, 0.6), (1.2, 0, 0), (0, 0, 1.2))
    g.camera((0.6, 1.4, 4), (0, 0.5, 0), 38, 16 / 9)
    return g


def many_lights():
    g = Glb()
    rnd = random.Random(7)
    white = g.material("white", (0.7, 0.7, 0.7), lambert=True)
    g.quad("floor", white, (-4, 0, 4), (8, 0, 0), (0, 0, -8))
    g.quad("ceiling", white, (-4, 3, -4), (8, 0, 0), (0, 0, 8))
    g.quad("back wall", white, (-4, 0, -4), (8, 0, 0), (0, 3, 0))
    g.quad("left wall", white, (-4, 0, 4), (0, 0, -8), (0, 3, 0))
    g.quad("right wall", white, (4, 0, -4), (0, 0, 8), (0, 3, 0))
    for k in range(7):
        g.block("block %d" % (k + 1), white, (rnd.uniform(-3, 3), 0.4, rnd.uniform(-3, 2)), (0.6, 0.8, 0.6), rnd.uniform(0, 3))
    colors = [g.material("lamp %d" % k, (0, 0, 0), lambert=True, emission=[20 * rnd.uniform(0.1, 1) ** 2 for _ in range(3)])
              for k in range(12)]
    for k in range(300):
        x, z = -3.8 + 7.6 * ((k * 0.754877666) % 1), -3.8 + 7.6 * ((k * 0.569840291) % 1)
        g.quad("lamp %d" % (k + 1), colors[k % 12], (x, 2.98, z), (0.06, 0, 0), (0, 0, 0.06))
    g.camera((0, 1.6, 5.5), (0, 1.2, 0), 50, 16 / 9)
    return g


def lathe_ring(radius, y, corners):
    return [(radius * math.cos(2 * math.pi * k / corners), y, -radius * math.sin(2 * math.pi * k / corners)) for k in range(corners)]


# Scenes with exact answers, for `candela validate`. The plane is y = 0 and sees its light from above.

def lambert_plane(g, half=4, color=(1, 1, 1)):
    g.quad("plane", g.material("lambert", color, lambert=True), (-half, 0, half), (2 * half, 0, 0), (0, 0, -2 * half))


def sky_plane():
    g = Glb()
    lambert_plane(g, 1, (0.25, 0.25, 0.25))
    g.camera((0, 1, 1), (0, 0, 0), 40, 1.0)
    return g


def directional_light():
    g = Glb()
    lambert_plane(g)
    # Tilted by 30 degrees from the zenith.
    half = math.radians(30 - 90) / 2
    g.light(dict(type="directional", intensity=2.0), rotation=(math.sin(half), 0, 0, math.cos(half)))
    g.camera((0, 2, 3), (0, 0, 0), 45)
    return g


def spot_light():
    g = Glb()
    lambert_plane(g)
    half = -math.pi / 4
    g.light(dict(type="spot", intensity=10.0, spot=dict(innerConeAngle=0.4, outerConeAngle=0.8)), translation=(0, 1, 0),
            rotation=(math.sin(half), 0, 0, math.cos(half)))
    g.camera((0, 2, 3), (0, 0, 0), 45)
    return g


def disc_light():
    """A disc of 64 corners and radius 0.5, one unit above the plane, facing down."""
    g = Glb()
    lambert_plane(g)
    lamp = g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1))
    g.mesh("disc", lamp, [(0, 1, 0)] + lathe_ring(0.5, 1, 64), [(0, 1 + (k + 1) % 64, 1 + k) for k in range(64)])
    g.camera((0, 0.9, 2), (0, 0, 0), 45)
    return g


def sphere_light():
    """A ball of radius 0.5 two units above the plane, with a ring of 64 corners where the view from the origin touches it."""
    g = Glb()
    lambert_plane(g)
    lamp = g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1))
    tangent = math.acos(0.5 / 2)  # from the downward axis
    angles = [tangent * k / 8 for k in range(1, 9)] + [tangent + (math.pi - tangent) * k / 8 for k in range(1, 8)]
    points = [(0, 1.5, 0)]
    for angle in angles:
        points += lathe_ring(0.5 * math.sin(angle), 2 - 0.5 * math.cos(angle), 64)
    points.append((0, 2.5, 0))
    at = lambda ring, k: 1 + 64 * ring + k % 64
    triangles = [(0, at(0, k + 1), at(0, k)) for k in range(64)]
    for ring in range(len(angles) - 1):
        for k in range(64):
            triangles += [(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)), (at(ring, k), at(ring + 1, k + 1), at(ring + 1, k))]
    triangles += [(len(points) - 1, at(len(angles) - 1, k), at(len(angles) - 1, k + 1)) for k in range(64)]
    g.mesh("ball", lamp, points, triangles)
    g.camera((0, 1, 3), (0, 1, 0), 60)
    return g


def facing_squares():
    g = Glb()
    g.quad("receiver", g.material("lambert", (1, 1, 1), lambert=True), (-0.5, 0, 0.5), (1, 0, 0), (0, 0, -1))
    g.quad("lamp", g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1)), (-0.5, 1, -0.5), (1, 0, 0), (0, 0, 1))
    g.camera((0, 0.5, 2.5), (0, 0.5, 0), 45)
    return g


def integrating_sphere_dark():
    return integrating_sphere(0.9)


def glass(g, ior=1.5, color=(1, 1, 1), distance=None, roughness=0.0):
    volume = dict(thicknessFactor=1.0, attenuationColor=list(color))
    if distance:
        volume["attenuationDistance"] = distance
    return g.material("glass", (1, 1, 1), 0, roughness, extensions={
        "KHR_materials_transmission": dict(transmissionFactor=1.0), "KHR_materials_ior": dict(ior=ior), "KHR_materials_volume": volume})


def slab(material_of):
    """A slab one unit thick around z = 0 with a lamp of radiance 1 behind it and one before it."""
    g = Glb()
    g.block("slab", material_of(g), (0, 0, 0), (40, 40, 1))
    g.quad("lamp", g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1)), (-50, -50, -5), (100, 0, 0), (0, 100, 0))
    g.camera((0, 0, 3), (0, 0, 0), 45)
    return g


def slab_clear():
    return slab(glass)


def slab_absorbing():
    return slab(lambda g: glass(g, 1.5, (0.25, 0.25, 0.25), 2.0))


def slab_index_one():
    return slab(lambda g: glass(g, 1.0, (0.25, 0.25, 0.25), 2.0))


def slab_mirror():
    g = Glb()
    g.block("slab", glass(g), (0, 0, 0), (40, 40, 1))
    g.quad("lamp", g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1)), (-50, 50, 9), (100, 0, 0), (0, -100, 0))
    g.camera((0, 0, 3), (0, 0, 0), 45)
    return g


def furnace_glass():
    g = Glb()
    g.sphere("ball", glass(g), (0, 0, 0), 1, 64, smooth=False)
    g.sphere("stone", g.material("lambert", (1, 1, 1), lambert=True), (0, 0, 0), 0.6, 32, smooth=False)
    g.camera((0, 0, 4), (0, 0, 0), 40, 1.0)
    return g


def furnace_drink():
    g = Glb()
    g.block("glass", glass(g, 1.5), (0, 0, 0), (2, 2, 2))
    g.block("drink", glass(g, 1.33), (0.025, 0.05, 0.075), (1.65, 1.5, 1.65))
    g.block("ice", glass(g, 1.31), (0.125, 0.15, 0.1), (0.65, 0.5, 0.5), 0.3)
    g.camera((1.5, 1.2, 5), (0, 0, 0), 40, 1.0)
    return g


def lens_target():
    """A lamp of 64 corners and radius 0.005 at the origin, seen from +Z."""
    g = Glb()
    lamp = g.material("lamp", (0, 0, 0), lambert=True, emission=(1, 1, 1))
    ring = [(x, -z, 0) for x, y, z in lathe_ring(0.005, 0, 64)]
    g.mesh("disc", lamp, [(0, 0, 0)] + ring, [(0, 1 + k, 1 + (k + 1) % 64) for k in range(64)])
    g.camera((0, 0, 2), (0, 0, 0), 2, 1.0)
    return g


SCENES = (cornell_box, veach_plates, glass_slab, alpha_cards, many_lights)
VALIDATION_SCENES = (strip_light, point_light_plane, furnace_sphere, furnace_glass, furnace_drink, integrating_sphere,
                     integrating_sphere_dark, sky_plane, directional_light, spot_light, disc_light, sphere_light, facing_squares,
                     slab_clear, slab_absorbing, slab_index_one, slab_mirror, lens_target)


def sky_hdr(width=512, height=256):
    """A clear sky: a blue gradient that brightens to the horizon, a sun of its true size but milder, a dull ground."""
    sun = (0.48, 0.62, -0.62)
    rows = bytearray()
    for y in range(height):
        elevation = math.pi * (0.5 - (y + 0.5) / height)
        line = []
        for x in range(width):
            phi = 2 * math.pi * ((x + 0.5) / width - 0.5)
            d = (math.cos(elevation) * math.cos(phi), math.sin(elevation), math.cos(elevation) * math.sin(phi))
            if d[1] < 0:
                color = [0.10, 0.09, 0.08]
            else:
                haze = (1 - d[1]) ** 4
                color = [0.16 + 0.75 * haze, 0.32 + 0.65 * haze, 0.75 + 0.30 * haze]
            cosine = sum(a * b for a, b in zip(d, sun))
            if d[1] >= 0:
                color = [c + g * max(cosine, 0) ** 64 for c, g in zip(color, (0.9, 0.7, 0.4))]
            if cosine > math.cos(0.012):
                color = [9000.0, 8200.0, 6800.0]
            peak = max(color)
            exponent = math.frexp(peak)[1]
            scale = 2.0 ** (8 - exponent)
            line.append([*(min(255, int(c * scale)) for c in color), exponent + 128])
        rows += bytes((2, 2, width >> 8, width & 255))
        for component in range(4):
            for begin in range(0, width, 128):
                part = [p[component] for p in line[begin:begin + 128]]
                rows += bytes([len(part), *part])
    head = "#?RADIANCE\nSOFTWARE=candela\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width)
    return head.encode() + bytes(rows)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for scene in SCENES:
        (folder / (scene.__name__ + ".glb")).write_bytes(scene().pack())
    (folder / "validation").mkdir(parents=True, exist_ok=True)
    for scene in VALIDATION_SCENES:
        (folder / "validation" / (scene.__name__ + ".glb")).write_bytes(scene().pack())
    (folder / "sky.hdr").write_bytes(sky_hdr())


if __name__ == "__main__":
    main()
