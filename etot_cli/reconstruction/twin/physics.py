"""Mass and friction: guesses from shape and material, written where a person can change them."""

from __future__ import annotations

from dataclasses import dataclass

from etot_cli.errors import SpecError
from etot_cli.reconstruction.objects import Solid
from etot_cli.reconstruction.shapes.upright import Cup


@dataclass(frozen=True)
class Material:
    """Density of the material [kg/m³] and sliding friction."""

    density: float
    friction: float


MATERIALS: dict[str, Material] = {
    "wood": Material(600.0, 0.5),
    "plastic": Material(1050.0, 0.45),
    "metal": Material(7800.0, 0.4),
    "aluminium": Material(2700.0, 0.4),
    "glass": Material(2500.0, 0.4),
    "ceramic": Material(2300.0, 0.5),
    "rubber": Material(1100.0, 0.9),
    "foam": Material(60.0, 0.8),
    "cardboard": Material(250.0, 0.5),
    "fruit": Material(820.0, 0.6),
    "light plastic": Material(400.0, 0.45),
    "hollow": Material(250.0, 0.6),
    "pencil": Material(700.0, 0.5),
}
"""``light plastic``: printed or foamed, as most small vessels are. ``hollow``: things with thin
walls that are modelled as solid, such as play balls. ``pencil``: wood with a lead, or a plastic
tube with a refill; a common pencil of 7 cm³ weighs 5 g."""
DEFAULTS = {
    "sphere": "hollow", "box": "hollow", "cylinder": "wood", "cup": "light plastic",
    "bowl": "light plastic",
    "pen": "pencil", "capsule": "wood", "mesh": "hollow", "drawer_unit": "plastic",
    "cabinet": "plastic",
}  # fmt: skip
MASS_DOUBT = 0.4
"""Relative; wood alone reaches from 400 to 750 kg/m³, and walls and fillings are not seen."""
FRICTION_DOUBT = 0.3
"""Relative."""
WORLDS = 8
"""Plans for a twin are tried in so many worlds: masses and friction are guesses, and what works
with one guess alone proves little."""
LIGHTEST = 0.005
"""Guessed masses are no smaller [kg]: a pen's few grams."""
THICK_WALL = 0.005
"""Vessels with thicker walls are solid ware rather than light prints and foams [m]."""


def guess(
    solid: Solid, material: str | None, wall: float | None = None
) -> tuple[float, float, str]:
    """Mass [kg], friction and the material that they are from.

    Args:
        solid: the object.
        material: what it is made of, when that is known.
        wall: a cup's wall [m], where another than the fitted one is written.

    Raises:
        SpecError: the material is not known.
    """
    name = material or DEFAULTS.get(solid.kind, "hollow")
    if material is None and wall is not None and wall > THICK_WALL:
        name = "plastic"
    if name not in MATERIALS:
        raise SpecError(f"unknown material {name!r}; expected one of {', '.join(MATERIALS)}")
    found = MATERIALS[name]
    params = solid.fit.params
    if wall is not None and isinstance(solid.fit.family, Cup):
        params = params.copy()
        params[5] = wall
    mass = max(found.density * solid.fit.family.volume(params), LIGHTEST)
    return mass, found.friction, name
