"""A scene file of glimt as a dictionary for Mitsuba 3. Needs no Mitsuba."""

import tomllib
from pathlib import Path


class Untranslated(Exception):
    """The scene has something that has no counterpart here."""


def read(path):
    return tomllib.loads(Path(path).read_text())


def _rgb(value):
    return {"type": "rgb", "value": [float(v) for v in value]}


def _facets(material, kind):
    """The type of a BSDF, and alpha = roughness^2 where it is rough."""
    roughness = float(material.get("roughness", 0))
    return {"type": f"rough{kind}", "distribution": "ggx", "alpha": roughness**2} if roughness > 0 else {"type": kind}


def _bsdf(name, material):
    kind = material["type"]
    if "emission" in material:
        raise Untranslated(f"material {name}: emission of a surface that reflects")
    if kind == "lambertian":
        inner = {"type": "diffuse", "reflectance": _rgb(material["reflectance"])}
    elif kind == "mirror":
        inner = {"type": "conductor", "material": "none", "specular_reflectance": _rgb(material["reflectance"])}
    elif kind == "conductor":
        if "preset" in material:
            raise Untranslated(f"material {name}: a preset, which only glimt knows")
        inner = {"eta": _rgb(material["eta"]), "k": _rgb(material["k"]), **_facets(material, "conductor")}
    elif kind == "glass":
        if material.get("fresnel", "exact") != "exact":
            raise Untranslated(f"material {name}: Fresnel by {material['fresnel']}")
        return {"int_ior": float(material["ior"]), "ext_ior": 1.0, **_facets(material, "dielectric")}
    elif kind == "light":
        return {"type": "diffuse", "reflectance": _rgb([0, 0, 0])}
    else:
        raise Untranslated(f"material {name}: {kind}")
    return {"type": "twosided", "bsdf": inner}


def _ply(vertices, triangles):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(repr(float(c)) for c in v) for v in vertices]
    lines += [" ".join(map(str, (3, *t))) for t in triangles]
    return "\n".join(lines) + "\n"


def _to_square(vertices):
    """The matrix that takes Mitsuba's rectangle, (-1, -1, 0) to (1, 1, 0) facing +z, to a parallelogram; None for other
    polygons."""
    if len(vertices) != 4:
        return None
    v0, v1, v2, v3 = vertices
    if any(abs(a + c - b - d) > 1e-9 for a, b, c, d in zip(v0, v1, v2, v3)):
        return None
    half_1, half_2 = ([(b - a) / 2 for a, b in zip(v0, v)] for v in (v1, v3))
    normal = [half_1[i - 2] * half_2[i - 1] - half_1[i - 1] * half_2[i - 2] for i in range(3)]
    length = sum(c * c for c in normal) ** 0.5
    centre = [(a + c) / 2 for a, c in zip(v0, v2)]
    return [[half_1[i], half_2[i], normal[i] / length, centre[i]] for i in range(3)] + [[0, 0, 0, 1]]


def translate(scene, folder, look_at, matrix, width, height, spp, sampler, rr_depth):
    """The scene, as read from TOML, for mitsuba.load_dict.

    Lamps that are parallelograms become rectangles and all else that is flat meshes, written to `folder` as PLY files:
    so Mitsuba is fastest. `look_at(origin, target, up)` and `matrix(rows)` make transforms. Raises Untranslated.
    """
    camera = scene["camera"]
    result = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1, "rr_depth": rr_depth},
        "sensor": {
            "type": "perspective",
            "fov": float(camera["fov_y"]),
            "fov_axis": "y",
            "near_clip": 1e-3,
            "to_world": look_at(origin=camera["eye"], target=camera["look_at"], up=camera["up"]),
            "sampler": {"type": sampler, "sample_count": spp},
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
        },
    }
    for name, material in scene["material"].items():
        result[f"material_{name}"] = _bsdf(name, material)

    def add(key, shape, material):
        shape["bsdf"] = {"type": "ref", "id": f"material_{material}"}
        if scene["material"][material]["type"] == "light":
            shape["emitter"] = {"type": "area", "radiance": _rgb(scene["material"][material]["radiance"])}
        result[key] = shape

    def add_mesh(key, vertices, triangles, material):
        file = Path(folder) / f"{key}.ply"
        file.write_text(_ply(vertices, triangles))
        add(key, {"type": "ply", "filename": str(file), "face_normals": True}, material)

    for i, sphere in enumerate(scene.get("sphere", [])):
        shape = {"type": "sphere", "center": sphere["center"], "radius": float(sphere["radius"])}
        add(f"sphere_{i}", shape, sphere["material"])
    for i, polygon in enumerate(scene.get("polygon", [])):
        square = _to_square(polygon["vertices"])
        if square and scene["material"][polygon["material"]]["type"] == "light":
            add(f"polygon_{i}", {"type": "rectangle", "to_world": matrix(square)}, polygon["material"])
            continue
        fan = [(0, k, k + 1) for k in range(1, len(polygon["vertices"]) - 1)]
        add_mesh(f"polygon_{i}", polygon["vertices"], fan, polygon["material"])
    for i, mesh in enumerate(scene.get("mesh", [])):
        add_mesh(f"mesh_{i}", mesh["vertices"], mesh["triangles"], mesh["material"])
    return result
