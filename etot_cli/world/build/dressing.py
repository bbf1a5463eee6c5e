"""What a world wears for people: wood, floor and wall, light with soft shadows, materials.

Only pictures for people are taken of a dressed world. It has the bodies and joints of the plain
one, so configurations fit both; nothing added here touches anything or weighs anything. Cameras of
a scene, and what a model or a reconstruction gets to see, show the plain world.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from etot_cli.specs import objects as specs
from etot_cli.specs.scene import Scene
from etot_cli.world.build.material import add_visual
from etot_cli.world.build.surroundings import FLOOR_DEPTH
from etot_cli.world.colors import rgb
from etot_cli.world.robot_index import ROBOT_PREFIX
from etot_cli.world.state import DESK

EXTENT_M = 1.0
"""The length that shadows and clipping planes are measured by [m]: about the size of a desk."""
SHADOW_REACH = 2.6
"""Shadows fall within this many extents of the middle. At the shadow map's edge the floor shades
itself in dots; from here on that edge lies outside all pictures."""
SHADOW_PX = 1024
"""Side of the shadow map: 4 mm of desk per pixel. Every sample has its own lamp position, so finer
ones look the same (0.2 of 255 levels apart) and take 1.4 times as long."""
BLACKEST = 0.07
"""Nothing real is blacker; with less, a black cup is a hole in the picture."""
TEXTURE_PX = 512
"""Side of a texture: a grain of some millimetres on a desk of a metre."""
LEG_M, INSET_M = 0.05, 0.04
"""Thickness of the desk's legs, and how far they stand in from its edge [m]."""
WALL_BEHIND_M = 0.55
"""Distance of the wall behind the robot's base [m]."""

OAK, OAK_SHARE = (0.80, 0.62, 0.42), 0.6
"""Wood that a desk is made of, and how much of it shows through the desk's own colour."""
WOODEN = ("brown", "beech", "wheat", "tan", "oak", "walnut", "wood")
MATERIALS = {
    # name: specular, shininess, reflectance
    "matte": (0.08, 0.15, 0.0),
    "plastic": (0.35, 0.55, 0.0),
    "glossy": (0.55, 0.80, 0.0),
    "metal": (0.80, 0.85, 0.0),
}
KIND_MATERIAL = {
    "sphere": "glossy", "cup": "plastic", "bowl": "plastic", "pen": "plastic", "box": "matte",
    "cylinder": "plastic", "capsule": "plastic", "cabinet": "plastic", "mesh": "matte",
    "mjcf": "plastic",
}  # fmt: skip
"""What things are made of when nobody says; furniture in a wood colour is wooden."""


def dress(mj: mujoco.MjSpec, scene: Scene) -> None:
    """Dresses a model that is about to be compiled."""
    _look_and_light(mj, scene)
    for name, (specular, shininess, reflectance) in MATERIALS.items():
        mj.add_material(
            name=name, specular=specular, shininess=shininess, reflectance=reflectance
        )  # fmt: skip
    _texture(mj, "wood", wood_grain(seed=1))
    _texture(mj, "boards", floor_boards())
    _texture(mj, "plaster", plaster())
    _wooden(mj, "tabletop", "wood", repeat=(1.0, 1.0), cube=False)
    _wooden(mj, "timber", "wood", repeat=(1.0, 1.0), cube=True)
    _wooden(mj, "floorboards", "boards", repeat=(3.0, 3.0), cube=False)
    _wooden(mj, "plastered", "plaster", repeat=(2.0, 2.0), cube=False)
    _room(mj, scene)
    _materials(mj, scene)


def _look_and_light(mj: mujoco.MjSpec, scene: Scene) -> None:
    mj.stat.extent = EXTENT_M
    mj.stat.center = [*scene.desk.center, scene.desk.top + 0.15]
    visual = mj.visual
    visual.quality.shadowsize = SHADOW_PX
    visual.quality.offsamples = 0  # several samples per picture smooth edges and shadows alike
    visual.map.shadowclip = SHADOW_REACH
    visual.map.znear, visual.map.zfar = 0.02, 12.0
    visual.headlight.ambient = [0.42, 0.42, 0.43]
    visual.headlight.diffuse = [0.16, 0.16, 0.16]
    visual.headlight.specular = [0.0, 0.0, 0.0]
    for light in list(mj.lights):
        mj.delete(light)
    middle = np.array([*scene.desk.center, scene.desk.top])
    lamps = (
        # offset from the desk's middle, strength, casts shadows
        ((0.75, 0.95, 2.1), 0.48, True),
        ((1.6, -1.2, 1.0), 0.20, False),
    )
    for offset, strength, shadows in lamps:
        light = mj.worldbody.add_light(
            pos=(middle + offset).tolist(), dir=(-np.array(offset)).tolist()
        )
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse = [strength, strength, strength * 0.97]
        light.specular = [0.35 * strength] * 3
        light.ambient = [0.0, 0.0, 0.0]
        light.castshadow = shadows


def _texture(mj: mujoco.MjSpec, name: str, pixels: NDArray[np.uint8]) -> None:
    """A texture for flat faces, and one for all faces of a box (``name/cube``)."""
    for kind, suffix, faces in (("2D", "", 1), ("CUBE", "/cube", 6)):
        texture = mj.add_texture(
            name=name + suffix,
            type=getattr(mujoco.mjtTexture, f"mjTEXTURE_{kind}"),
            width=pixels.shape[1],
            height=pixels.shape[0] * faces,
            nchannel=3,
        )
        texture.data = np.concatenate([pixels] * faces).tobytes()


def _wooden(
    mj: mujoco.MjSpec, name: str, texture: str, *, repeat: tuple[float, float], cube: bool
) -> None:
    material = mj.add_material(name=name, specular=0.15, shininess=0.3, texrepeat=list(repeat))
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture + ("/cube" if cube else "")


def _room(mj: mujoco.MjSpec, scene: Scene) -> None:
    """Desk legs, floor boards, a wall and a skirting board."""
    desk, world = scene.desk, mj.worldbody
    floor = desk.top - FLOOR_DEPTH
    half_x, half_y = desk.size[0] / 2, desk.size[1] / 2
    paint = desk_wood(rgb(desk.color))
    for side_x in (-1, 1):
        for side_y in (-1, 1):
            x = desk.center[0] + side_x * (half_x - INSET_M - LEG_M / 2)
            y = desk.center[1] + side_y * (half_y - INSET_M - LEG_M / 2)
            _box(world, (LEG_M / 2, LEG_M / 2, (FLOOR_DEPTH - 0.03) / 2),
                  (x, y, floor + (FLOOR_DEPTH - 0.03) / 2), paint, "timber")  # fmt: skip
    wall = min(-WALL_BEHIND_M, desk.center[0] - half_x - WALL_BEHIND_M)
    _box(world, (0.02, 4.0, 1.6), (wall, 0.0, floor + 1.6), (1.0, 0.99, 0.96), "plastered")
    _box(world, (0.008, 4.0, 0.05), (wall + 0.028, 0.0, floor + 0.05),
          (0.97, 0.97, 0.96), "matte")  # fmt: skip
    for geom in mj.geoms:
        if geom.name == DESK:
            geom.material, geom.rgba = "tabletop", [*paint, 1.0]
        elif geom.name == "floor":
            geom.material, geom.rgba = "floorboards", [0.74, 0.71, 0.68, 1.0]


def _box(
    world: Any,
    size: tuple[float, float, float],
    position: tuple[float, float, float],
    color: tuple[float, float, float],
    material: str,
) -> None:
    add_visual(world, [*color, 1.0], type=mujoco.mjtGeom.mjGEOM_BOX, size=list(size),
               pos=list(position), material=material)  # fmt: skip


def _materials(mj: mujoco.MjSpec, scene: Scene) -> None:
    """Every geom that has none gets a material; its colour stays its own."""
    for name, spec in scene.objects.items():
        furniture = isinstance(spec, specs.FURNITURE)
        wooden = furniture and (spec.color is None or str(spec.color).lower() in WOODEN)
        material = "timber" if wooden else KIND_MATERIAL.get(spec.kind, "matte")
        for geom in _geoms_below(mj.body(name)):
            if not geom.material:
                geom.material = material
                geom.rgba = [*np.maximum(geom.rgba[:3], BLACKEST), geom.rgba[3]]
                if wooden:
                    geom.rgba = [*_wood_tint(tuple(geom.rgba[:3])), geom.rgba[3]]
    for body in mj.bodies:
        if body.name.startswith(ROBOT_PREFIX):
            for geom in body.geoms:
                if not geom.material:
                    geom.material = "plastic"


def _geoms_below(body: Any) -> list[Any]:
    found, stack = [], [body]
    while stack:
        current = stack.pop()
        found += list(current.geoms)
        stack += list(current.bodies)
    return found


def desk_wood(color: tuple[float, float, float]) -> tuple[float, float, float]:
    """A desk's colour as stained wood: its own, shining through oak."""
    red, green, blue = (
        min(1.0, 1.1 * ((1 - OAK_SHARE) * own + OAK_SHARE * oak))
        for own, oak in zip(color, OAK, strict=True)
    )
    return red, green, blue


def _wood_tint(color: Any) -> tuple[float, float, float]:
    """A little lighter: the grain's dark lines take from every colour."""
    red, green, blue = (min(1.0, 1.12 * float(value)) for value in color)
    return red, green, blue


def wood_grain(seed: int) -> NDArray[np.uint8]:
    """Planks with a grain, gray with a hint of warmth, (n, n, 3); colours come from the geom."""
    draw = np.random.default_rng(seed)
    size = TEXTURE_PX
    rows, columns = np.arange(size)[:, None] / size, np.arange(size) / size
    image = np.zeros((size, size))
    planks = 5
    on_plank = (rows[:, 0] * planks).astype(int)
    for plank in range(planks):
        phase, bend, tone = draw.uniform(0, 6), draw.uniform(0.6, 1.4), draw.uniform(-0.03, 0.03)
        wave = 0.05 * np.sin(2 * np.pi * (bend * columns + phase))
        across = rows[on_plank == plank] * planks % 1
        broad = np.sin(2 * np.pi * (1.3 * across + 2.2 * wave * planks + phase))
        rings = np.sin(2 * np.pi * (4.5 * across**1.5 + 3.0 * wave * planks + phase))
        image[on_plank == plank] = 0.88 + tone + 0.02 * broad + 0.018 * rings
    # Fibres: every row its own shade, changing slowly along the plank.
    knots = draw.normal(0, 1, (size, 9))
    where = np.linspace(0, 8, size)
    image += 0.016 * np.stack([np.interp(where, np.arange(9), row) for row in knots])
    image[(rows[:, 0] * planks % 1) < 0.012] -= 0.16
    warm = np.stack([image, image * 0.975, image * 0.94], axis=-1)
    return np.asarray(np.clip(warm, 0, 1) * 255, dtype=np.uint8)


def floor_boards() -> NDArray[np.uint8]:
    """Wide boards of a floor, (n, n, 3)."""
    grain = wood_grain(seed=7).astype(np.float64)
    return np.asarray(np.clip(grain * 0.35 + 138, 0, 255), dtype=np.uint8)


def plaster() -> NDArray[np.uint8]:
    """A wall that is not quite even, (n, n, 3)."""
    draw = np.random.default_rng(3)
    coarse = draw.normal(0, 1, (32, 32))
    smooth = np.kron(coarse, np.ones((TEXTURE_PX // 32, TEXTURE_PX // 32)))
    kernel = np.ones(33) / 33
    for axis in (0, 1):
        smooth = np.apply_along_axis(
            lambda row: np.convolve(np.concatenate([row[-16:], row, row[:16]]), kernel, "valid"),
            axis, smooth,
        )  # fmt: skip
    image = 0.97 + 0.006 * smooth / max(float(smooth.std()), 1e-9)
    return np.asarray(np.clip(np.repeat(image[..., None], 3, axis=-1), 0, 1) * 255, dtype=np.uint8)
