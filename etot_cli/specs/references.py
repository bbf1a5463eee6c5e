"""Names that documents refer to: which exist, and which can carry, contain, open or close."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from etot_cli.specs.disturbance import Disturbance, Role
from etot_cli.specs.document import DataPath
from etot_cli.specs.objects import (
    Box,
    Cabinet,
    Cup,
    Cylinder,
    DrawerUnit,
    Mesh,
    Mjcf,
    ObjectBase,
    Shelf,
    Sphere,
    is_fastened,
)
from etot_cli.specs.problems import Problem, show, unknown
from etot_cli.specs.scene import RESERVED_NAMES, ROBOT_VIEWPOINT, Scene
from etot_cli.specs.task import BESIDE_KEYS, Condition, Task

DESK = "desk"


def movable_parts(item: ObjectBase) -> tuple[str, ...]:
    """Names of the parts that open: drawers that travel, doors, the parts of an MJCF object."""
    if isinstance(item, DrawerUnit):
        return tuple(drawer.name for drawer in item.drawers if drawer.travel > 0.0)
    if isinstance(item, Cabinet):
        return (item.door.name,)
    return tuple(item.parts) if isinstance(item, Mjcf) else ()


def surfaces(scene: Scene) -> list[str]:
    """What things can stand on: the desk, flat tops, the mouths of vessels, boards."""
    names = [DESK]
    for name, item in scene.objects.items():
        flat = isinstance(item, Box | Cylinder | Cup | DrawerUnit | Cabinet | Shelf | Mesh)
        sites = (item.surface_site, item.container_site) if isinstance(item, Mjcf) else ()
        if flat or any(site is not None for site in sites):
            names.append(name)
        if isinstance(item, Shelf):
            names.extend(f"{name}.{board}" for board in item.boards)
    return names


def containers(scene: Scene) -> list[str]:
    """What things can be put into; a unit with one moving drawer also goes by its own name."""
    names = []
    for name, item in scene.objects.items():
        if isinstance(item, Cup | Cabinet) or (isinstance(item, Mesh) and item.hollow):
            names.append(name)
        elif isinstance(item, DrawerUnit):
            names.extend(_addresses(name, movable_parts(item)))
        elif isinstance(item, Mjcf):
            held = [key for key, part in item.parts.items() if part.container_site is not None]
            if item.container_site is not None or len(item.parts) == len(held) == 1:
                names.append(name)
            names.extend(f"{name}.{part}" for part in held)
    return names


def openable(scene: Scene) -> list[str]:
    """What can be opened and closed; an object with one movable part also goes by its name."""
    return [
        address
        for name, item in scene.objects.items()
        for address in _addresses(name, movable_parts(item))
    ]


def _addresses(name: str, parts: tuple[str, ...]) -> list[str]:
    own = [name] if len(parts) == 1 else []
    return own + [f"{name}.{part}" for part in parts]


def scene_problems(scene: Scene) -> list[Problem]:
    """Checks the names in a scene: reserved words, supports that exist and fit, no cycles."""
    problems = [
        Problem(("objects", name), f"{name!r} is reserved; give the object another name")
        for name in scene.objects
        if name in RESERVED_NAMES
    ]
    surface, container = surfaces(scene), containers(scene)
    for name, item in scene.objects.items():
        path = ("objects", name)
        if item.on is not None:
            problems.extend(_check((*path, "on"), item.on, surface, "surface", scene))
        if item.inside is not None:
            problems.extend(_check((*path, "inside"), item.inside, container, "container", scene))
    for index, name in enumerate(scene.variation.keep):
        problems.extend(
            _check(("variation", "keep", index), name, list(scene.objects), "object", scene)
        )
    viewpoints = [ROBOT_VIEWPOINT, *(name for name in scene.cameras if name != ROBOT_VIEWPOINT)]
    problems.extend(_check(("viewpoint",), scene.viewpoint, viewpoints, "viewpoint", scene))
    return problems or _cycles(scene)


def support_of(item: ObjectBase) -> str:
    """The object (or ``desk``) that an object stands on or lies in, without the part's name."""
    return (item.on or item.inside or DESK).split(".")[0]


def _cycles(scene: Scene) -> list[Problem]:
    for start, item in scene.objects.items():
        chain = [start]
        while (below := support_of(item)) != DESK:
            chain.append(below)
            if below == start:
                key = "on" if scene.objects[start].on else "inside"
                message = f"objects support each other in a circle: {' → '.join(chain)}"
                return [Problem(("objects", start, key), message)]
            if below in chain[:-1]:
                break  # the circle does not include the start; another object reports it
            item = scene.objects[below]
    return []


def task_problems(task: Task) -> list[Problem]:
    """Checks the names in a task's conditions and disturbance against its scene."""
    problems: list[Problem] = []
    for key, conditions in (("success", task.success), ("goal", task.goal or ())):
        for index, condition in enumerate(conditions):
            problems.extend(_condition_problems((key, index), condition, task.scene))
    given = task.disturbance
    listed = given if isinstance(given, tuple) else None
    added: dict[str, ObjectBase] = {}
    for index, item in enumerate(task.disturbances):
        path: DataPath = ("disturbance",) if listed is None else ("disturbance", index)
        problems.extend(_disturbance_problems(path, item, task.scene, added))
        if item.add is not None and item.object is not None:
            added[item.add] = item.object
    return problems


def _disturbance_problems(
    path: DataPath, given: Disturbance, scene: Scene, added: Mapping[str, ObjectBase]
) -> Iterator[Problem]:
    """Checks one of them; ``added`` are the objects that came with those before it."""
    objects = {**scene.objects, **added}
    scene = scene.model_copy(update={"objects": objects})
    place: Disturbance | ObjectBase = given
    if given.add is not None:
        if given.add in RESERVED_NAMES or given.add in objects:
            taken = "reserved" if given.add in RESERVED_NAMES else "in the scene already"
            yield Problem((*path, "add"), f"{given.add!r} is {taken}; give another name")
        assert given.object is not None  # the model has seen to it
        place, path = given.object, (*path, "object")
    elif given.part is not None:
        yield from _check((*path, "part"), given.part, openable(scene), "part that opens", scene)
        return
    else:
        names = [*Role, *(name for name, item in objects.items() if not is_fastened(item))]
        yield from _check((*path, given.deed), given.name, names, "loose object", scene)
    if place.on is not None:
        yield from _check((*path, "on"), place.on, surfaces(scene), "surface", scene)
    if place.inside is not None:
        yield from _check((*path, "inside"), place.inside, containers(scene), "container", scene)
    if place.at is not None and not _above_desk(place.at[:2], scene):
        message = f"found {list(place.at)}, expected x y on the desk"
        yield Problem((*path, "at"), message)
    if given.name in (given.on, given.inside):
        yield Problem(path, f"{given.name!r} cannot be put on or into itself")


def _above_desk(point: tuple[float, float], scene: Scene) -> bool:
    desk = scene.desk
    return all(
        abs(value - centre) <= size / 2
        for value, centre, size in zip(point, desk.center, desk.size, strict=True)
    )


def _with_a_side(scene: Scene) -> list[str]:
    """What may be laid down, as far as the scene alone tells: no balls."""
    return [name for name, item in scene.objects.items() if not isinstance(item, Sphere)]


_SINGLE: Mapping[str, tuple[str, Callable[[Scene], list[str]]]] = {
    "in_hand": ("object", lambda scene: list(scene.objects)),
    "upright": ("object", lambda scene: list(scene.objects)),
    "lying": ("object that has a side to lie on", _with_a_side),
    "present": ("object", lambda scene: list(scene.objects)),
    "open": ("part that opens", openable),
    "closed": ("part that opens", openable),
}


def _condition_problems(path: DataPath, condition: Condition, scene: Scene) -> Iterator[Problem]:
    for key, (role, valid) in _SINGLE.items():
        name = getattr(condition, key)
        if name is not None:
            yield from _check((*path, key), name, valid(scene), role, scene)
    pairs = (("on", condition.on, "surface"), ("inside", condition.inside, "container"))
    for key, pair, role in pairs:
        if pair is None:
            continue
        here = (*path, key)
        yield from _check((*here, 0), pair[0], list(scene.objects), "object", scene)
        targets = surfaces(scene) if key == "on" else containers(scene)
        yield from _check((*here, 1), pair[1], targets, role, scene)
        if pair[0] == pair[1]:
            yield Problem(here, f"{pair[0]!r} cannot be {key} itself")
    for key in BESIDE_KEYS:
        names = getattr(condition, key)
        if names is not None:
            for index, name in enumerate(names):
                yield from _check((*path, key, index), name, list(scene.objects), "object", scene)
            if len(set(names)) < len(names):
                yield Problem((*path, key), "an object cannot be beside itself")
    if condition.at is not None:
        yield from _check((*path, "at", 0), condition.at[0], list(scene.objects), "object", scene)
    for key, children in (("any", condition.any), ("all", condition.all)):
        for index, child in enumerate(children or ()):
            yield from _condition_problems((*path, key, index), child, scene)
    if condition.not_ is not None:
        yield from _condition_problems((*path, "not"), condition.not_, scene)


def _check(
    path: DataPath, name: str, valid: list[str], role: str, scene: Scene
) -> Iterator[Problem]:
    """Yields a problem when ``name`` is not among the valid ones for its role."""
    if name in valid:
        return
    if not valid:
        message = f"found {show(name)}, but the scene has no {role}"
        yield Problem(path, message + _to_become(name, role, scene))
    elif name in scene.objects:
        # The name is right, the object is of the wrong sort: say so and list the right ones.
        message = f"{name!r} is no {role}; expected one of {', '.join(valid)}"
        yield Problem(path, message + _to_become(name, role, scene))
    else:
        yield Problem(path, f"the scene has no {role} {name!r}{unknown(name, valid)}")


def _to_become(name: str, role: str, scene: Scene) -> str:
    """What an object from a file lacks to serve in a role, which only its author can tell."""
    item = scene.objects.get(name)
    if role == "container" and isinstance(item, Mesh):
        return f"; add 'hollow: true' to {name!r} where it is open at the top"
    if not isinstance(item, Mjcf) or role not in ("container", "surface"):
        return ""
    if any(part.container_site is not None for part in item.parts.values()):
        hollow = ""  # the list has them
    else:
        place = "a part of it" if item.parts else "it"
        hollow = f"'container_site: <box site that spans its hollow>' to {place}"
    flat = "'surface_site: <box site that things stand on>' to it" if role == "surface" else ""
    if flat and item.parts:
        hollow = ""
    wanted = " or ".join(key for key in (hollow, flat) if key)
    return f"; to make it one, add {wanted}" if wanted else ""
