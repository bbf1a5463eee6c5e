"""Words of the controlled English: about kinds, colours, places and numbers, never about tasks.

Words for particular objects come from the scene itself, from each object's name and label.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from etot_cli.world.colors import BASIC_COLORS, NAMED_COLORS, nearest_basic


def word_set(text: str) -> frozenset[str]:
    """The words of a text."""
    return frozenset(text.split())


KIND_GROUPS: dict[str, tuple[tuple[str, ...], ...]] = {
    "sphere": (("ball", "sphere", "orb"),),
    "box": (
        ("block", "cube", "brick", "cuboid"),
        ("box", "carton", "crate", "package", "packet", "parcel", "case"),
    ),
    "cylinder": (("cylinder",), ("can", "tin"), ("bottle", "flask"), ("jar",)),
    "capsule": (("capsule",),),
    "pen": (("pen",), ("pencil",), ("marker",), ("crayon",), ("rod", "stick")),
    "cup": (
        ("cup", "mug", "holder", "beaker", "tumbler", "vessel"), ("glass",), ("pot",), ("vase",),
    ),
    "bowl": (("bowl", "dish", "basin", "vessel"),),
    "drawer_unit": (("drawer", "chest", "dresser", "cabinet", "unit"),),
    "cabinet": (("cabinet", "cupboard", "locker"), ("microwave", "oven")),
    "shelf": (("shelf", "rack", "bookcase", "bookshelf", "stand"),),
}  # fmt: skip
"""Nouns that name an object by its kind, those that may stand for each other together."""
ONLY_SO_CALLED = frozenset({"microwave", "oven", "vase"})
"""Nouns of a kind for what is called so, and for nothing else of that kind: a safe is no oven."""
NAMED_FOR_A_SORT = frozenset({"pen"})
"""Kinds named for but one sort of them: a marker is no pen, and what is neither is a rod."""
KIND_NOUNS = {
    kind: tuple(noun for group in groups for noun in group) for kind, groups in KIND_GROUPS.items()
}
PAIRED = word_set(
    """
    scissors pliers tongs tweezers shears clippers pincers forceps goggles binoculars sunglasses
    headphones trousers pants jeans shorts tights
    """
)
"""Of these a pair is one thing."""
PACKS = (
    *KIND_GROUPS["box"][1],
    *(n for group in KIND_GROUPS["cylinder"][1:] for n in group),
    "bag",
)
"""Nouns for what food and the like is sold in."""
PADS = ("pad", "deck", "bundle")
"""Nouns for what consists of things of one sort, and holds nothing ("sticky note pad")."""
_SPELLINGS = """
    tyre/tire mould/mold doughnut/donut yoghurt/yogurt fibre/fiber aluminium/aluminum
    jewellery/jewelry pyjama/pajama plough/plow moustache/mustache cosy/cozy litre/liter axe/ax
    omelette/omelet sulphur/sulfur chilli/chili/chile whisky/whiskey liquorice/licorice
    ketchup/catsup calliper/caliper vice/vise woollen/woolen disc/disk racquet/racket dryer/drier
    catalogue/catalog armour/armor carburettor/carburetor mitre/miter barbecue/barbeque
    hairdryer/hairdrier
"""
SPELLINGS = tuple(tuple(words.split("/")) for words in _SPELLINGS.split())
"""One word in the spellings of either English, without endings."""
RUBBISH = word_set("trash rubbish garbage waste litter recycling")
"""What is put where it belongs, called by the same word."""
REFUSE = ("trash", "garbage")
"""Names of a bin and of what goes there."""
COMPOUNDS: dict[str, frozenset[str]] = {
    "can": RUBBISH | {"watering"}, "butter": word_set("peanut almond cashew cocoa"),
    "cream": word_set("ice shaving hand"), "dog": word_set("hot"),
}  # fmt: skip
"""Nouns that with some word before them mean no such thing: a trash can is none of the cans."""
OTHER_SORTS: dict[str, frozenset[str]] = {
    "butter": word_set("shea body nut"), "cream": word_set("sun face body foot skin"),
    "oil": word_set("motor engine machine lamp hair massage brake"),
    "roll": word_set("toilet paper tape towel kitchen film foil wire cable yarn"),
    "chip": word_set("poker casino computer memory wood"), "tape": word_set("measuring"),
    "glass": word_set("magnifying wine"), "dish": word_set("petri soap"), "file": word_set("nail"),
    "knife": word_set("utility craft stanley palette putty pocket hobby"),
    "ring": word_set("key napkin"), "nut": word_set("wing hex lug lock"),
    "cup": word_set("suction measuring"), "paper": word_set("toilet wrapping baking sand"),
    "bear": word_set("gummy"), "bean": word_set("jelly coffee"), "block": word_set("knife"),
    "plate": word_set("license number"), "nail": word_set("finger"), "egg": word_set("easter"),
    "belt": word_set("conveyor tool"), "tie": word_set("cable zip twist"),
    "boat": word_set("gravy"), "cap": word_set("bottle lens pen"),
    "milk": word_set("coconut almond oat soy"),
}  # fmt: skip
"""Nouns that with some word before them mean something of another sort, which is called so where
nothing else is: a petri dish is none of the dishes, and yet "the dish" of a laboratory.
"""
PURPOSES = word_set(
    """
    coffee tea water milk beer wine juice soup salad fruit cereal sugar salt pepper flower
    plant pencil pen tennis golf ping pong billiard base basket bouncy play toy kitchen desk
    office storage writing drinking mixing serving packing working work lab laboratory dining sewing
    potting ironing reading drawing craft picnic dinner breakfast cookie candy soda cola
    """
)
"""What a thing may be for or made for, before its noun ("a pencil cup")."""
MATERIALS = word_set(
    """
    wooden wood plastic metal metallic steel iron ceramic porcelain paper cardboard glass
    rubber leather cotton cloth stone marble copper brass silicone woolen
    """
)
"""What things are made of, of which a scene says nothing but by their labels."""
MADE_OF: dict[str, frozenset[str]] = {
    **dict.fromkeys(
        ("metal", "metallic"),
        word_set("steel iron copper brass aluminium aluminum tin bronze silver zinc chrome"),
    ),
    **dict.fromkeys(
        ("wooden", "wood"),
        word_set("oak pine beech birch maple ash walnut bamboo teak plywood mahogany spruce"),
    ),
}  # fmt: skip
"""What material a word of a label tells of ("steel tumbler")."""
COMMON_NOUNS = word_set(
    """
    apple orange banana lemon lime peach pear plum cherry grape berry strawberry melon mango
    pineapple tomato potato onion carrot cucumber eggplant corn pepper garlic mushroom
    cabbage bread toast bun cake cookie donut pizza egg cheese butter meat steak fish
    chicken soup sauce milk juice water coffee tea cola soda beer wine sugar salt cereal
    chocolate candy jam honey plate saucer tray spoon fork knife spatula ladle whisk tongs
    pan pot kettle lid toaster stove sink faucet fridge refrigerator freezer dishwasher
    towel napkin cloth rag washcloth sponge soap brush broom book magazine newspaper paper notebook
    letter
    envelope stapler scissors tape glue ruler eraser phone telephone laptop computer
    keyboard mouse monitor camera control coaster lamp light bulb battery cable clock watch
    key wallet purse bag basket bin trash bucket hat shoe sock glove shirt coat scarf toy doll bear
    duck car truck train robot dice coin card button bell whistle screw nut bolt hammer wrench
    screwdriver drill saw nail chair sofa couch bed pillow blanket door window wall floor
    vase flower plant candle picture frame mirror bottle can jar cup mug glass bowl dish box
    block cube ball pen pencil marker stick shelf drawer cabinet table desk cake caddy moka
    skillet tissue sandwich burger ring rope string sphere cylinder star heart cross hexagon
    moon pentagon triangle square
    """
)
"""Things that people have: such a word is no slip of the pen for another, and what is called by one
is not also called by a noun for its mere shape (an apple is no ball)."""
HELPING_NOUNS = word_set(
    """
    holder stand rack caddy organizer tray plate basket bag bucket bin pouch purse sack tub tank
    lever tube pack set kit bundle roll dispenser machine clip case cover cap lid stopper plug hook
    peg hanger strap cord lace charger cable key ring bell end stop board mat rest shade stick stump
    brush knife fork spoon scoop ladle spatula whisk tongs scissors press mill grinder grater
    opener peeler slicer cutter corer sharpener punch roller timer remover cleaner shaker pad
    """
)
"""What holds, covers, cleans, cuts or serves what stands before it ("paper clip")."""
_DRINKING = word_set("cup mug teacup glass tumbler goblet")
BINS = word_set(
    """
    bin trash rubbish garbage waste wastepaper wastebasket dustbin litter recycling compost hamper
    laundry
    """
)
"""Words of names of what things are thrown into when they are but put there."""
JOINT_NOUNS: dict[str, tuple[str, ...]] = {
    "slide": ("drawer", "compartment", "level", "layer"),
    "hinge": ("door", "lid", "flap", "cover"),
}
"""Nouns that name a movable part by the way it moves."""
RACKED = word_set(
    "dishwasher oven fridge refrigerator freezer stove cooker dryer incubator toaster"
)
"""What has racks, shelves or trays that slide; a chest has drawers."""
LIDS = word_set("lid cover cap")
"""What lies loose on what it closes."""
LIDDED = word_set("chest box trunk case crate bin coffer cooler hamper container basket")
"""Names of furniture whose door people call its lid."""
OPEN_VESSELS = word_set("bin crate box basket tub tote hamper caddy container carton bucket pail")
"""Names of open vessels, of which people use one for another."""
CONTAINER_NOUNS = ("container", "receptacle", "vessel")
"""Nouns for anything that things can be put into; a vessel is no furniture."""
THING_NOUNS = (
    "object", "thing", "item", "one", "stuff", "everything", "anything", "something", "rest",
    "others", "else",
)  # fmt: skip
"""Nouns that fit any movable object."""
DESK_NOUNS = (
    "desk",
    "table",
    "tabletop",
    "desktop",
    "worktop",
    "workbench",
    "bench",
    "counter",
    "countertop",
    "surface",
)
BOARD_NOUNS = (
    "board", "level", "shelf", "tier", "surface", "layer", "compartment", "rack", "tray",
)  # fmt: skip
"""Nouns for one surface of a piece of furniture that has several."""
SAID_OF_BOARDS = ("board", "level", "shelf", "tier")
"""Those that mean a drawer only where nothing has boards."""
OPEN_SURFACES = (
    "tray", "plate", "saucer", "platter", "dish", "pan", "shelf", "rack", "bookcase", "bookshelf",
    "bed", "crib", "cot", "armchair", "zone", "area", "region", "field", "spot", "square",
)  # fmt: skip
"""Nouns for what things are said to be "in", though they lie on it."""

NUMBERS = {
    "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8,
    "nine": 9, "ten": 10,
}  # fmt: skip
ORDINALS = {
    "first": 0, "1st": 0, "second": 1, "2nd": 1, "third": 2, "3rd": 2, "fourth": 3, "4th": 3,
    "fifth": 4, "5th": 4, "sixth": 5, "6th": 5, "last": -1,
}  # fmt: skip

OF_TWO = {"former": 0, "latter": 1}

SIDES = {
    "left": "left", "leftmost": "left", "lefthand": "left",
    "right": "right", "rightmost": "right", "righthand": "right",
    "front": "front", "frontmost": "front", "near": "near", "nearest": "near", "nearer": "near",
    "closest": "near", "closer": "near",
    "back": "back", "rear": "back", "rearmost": "back", "hindmost": "back",
    "far": "far", "farthest": "far",
    "furthest": "far", "farther": "far", "further": "far",
    "middle": "middle", "center": "middle", "centre": "middle", "central": "middle",
    "outer": "outer", "outermost": "outer", "inner": "inner", "innermost": "inner",
}  # fmt: skip
"""Words for where an object is, as seen from the robot."""
LEVELS = {
    "top": "top", "upper": "top", "uppermost": "top", "topmost": "top", "highest": "top",
    "bottom": "bottom", "lower": "bottom", "lowest": "bottom", "lowermost": "bottom",
    "bottommost": "bottom",
    "middle": "middle", "center": "middle", "centre": "middle", "mid": "middle",
    "central": "middle",
}  # fmt: skip
"""Words for one of several parts or boards stacked on each other."""
SIZES = {
    **dict.fromkeys(("big", "bigger", "biggest", "large", "larger", "largest"), ("volume", 1)),
    **dict.fromkeys(("small", "smaller", "smallest", "little", "tiny"), ("volume", -1)),
    **dict.fromkeys(("tall", "taller", "tallest", "high", "higher"), ("height", 1)),
    **dict.fromkeys(("short", "shorter", "shortest", "low", "flat"), ("height", -1)),
    **dict.fromkeys(("wide", "wider", "widest", "broad", "broader", "broadest"), ("width", 1)),
    **dict.fromkeys(("narrow", "narrower", "narrowest"), ("width", -1)),
    **dict.fromkeys(("thick", "thicker", "thickest", "fat", "fatter", "fattest"), ("girth", 1)),
    **dict.fromkeys(
        ("thin", "thinner", "thinnest", "slim", "slimmer", "slimmest", "slender"), ("girth", -1)
    ),
    **dict.fromkeys(("long", "longer", "longest"), ("width", 1)),
    **dict.fromkeys(("heavy", "heavier", "heaviest"), ("mass", 1)),
    **dict.fromkeys(("lighter", "lightest"), ("mass", -1)),
    **dict.fromkeys(("darker", "darkest"), ("darkness", 1)),
}
"""Comparisons: the quantity, and whether more (1) or less (-1) of it is meant."""
STATES = {
    "open": "open", "opened": "open", "ajar": "ajar", "closed": "closed", "shut": "closed",
    **dict.fromkeys(("empty", "free", "vacant", "unoccupied", "unused"), "empty"),
    **dict.fromkeys(("available", "spare"), "empty"),
    "full": "full", "filled": "full", "toppled": "toppled", "fallen": "toppled",
    **dict.fromkeys(("tipped over", "toppled over", "knocked over", "fallen over"), "toppled"),
    **dict.fromkeys(("on its side", "on their side", "on their sides"), "toppled"),
    "stacked": "stacked", "loose": "loose", "outside": "loose", "round": "round", "dark": "dark",
}  # fmt: skip
"""Adjectives for what the scene's state says about an object, or its shape and shade."""

_COLOR_SYNONYMS = {
    "violet": "purple", "magenta": "pink", "gold": "yellow", "golden": "yellow", "tan": "brown",
    "beige": "brown", "maroon": "red", "crimson": "red", "navy": "blue", "turquoise": "blue",
    "teal": "green",
}  # fmt: skip
_IRREGULAR = {
    "shelves": "shelf", "knives": "knife", "loaves": "loaf", "boxes": "box", "leaves": "leaf",
    "scarves": "scarf", "halves": "half", "wolves": "wolf", "calves": "calf", "elves": "elf",
    "hooves": "hoof", "dice": "die", "mice": "mouse", "geese": "goose", "teeth": "tooth",
    "feet": "foot", "children": "child", "oxen": "ox", "cacti": "cactus", "fungi": "fungus",
    "buses": "bus", "gases": "gas", "heroes": "hero", "quizzes": "quiz",
    **{f"{who}men": f"{who}man" for who in (
        "", "wo", "fire", "police", "snow", "post", "space", "milk", "sports",
    )},
    "canvases": "canvas", "canvas": "canvas", "lenses": "lens", "lens": "lens",
    "cds": "cd", "tvs": "tv",
    **{f"{word}s": word for word in (
        "cookie", "brownie", "veggie", "smoothie", "hoodie", "beanie", "birdie", "genie", "kiwi",
        "taxi", "chili", "zucchini", "broccoli", "ravioli", "panini", "martini", "ski", "bikini",
    )},
}  # fmt: skip


def basic_color(word: str) -> str | None:
    """The basic colour that a word names, None when it is no colour."""
    if word in BASIC_COLORS:
        return word
    if word in NAMED_COLORS:
        return nearest_basic(word)
    return _COLOR_SYNONYMS.get(word)


def is_drunk_from(label: str) -> bool:
    """Whether a label is that of a cup or glass, not of a holder, a beaker or a bin."""
    return singular(label.casefold().split()[-1]) in _DRINKING


def is_descriptive(text: str) -> bool:
    """Whether a word is an adjective of colour, place, size or order."""
    described = text in SIDES or text in SIZES or text in ORDINALS
    return described or basic_color(text) is not None


@lru_cache(maxsize=4096)
def singular(word: str) -> str:
    """The singular of a regular noun; other words come back as they are."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if named := re.fullmatch("(.+?)(_(?:of|with|for)_.+)", word):
        return singular(named[1]) + named[2]
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("shes", "ches", "xes", "sses", "zes")):
        return word[:-2]
    if word.endswith(("atoes", "goes", "inoes")) and len(word) > 5:
        return word[:-2]  # tomatoes, mangoes, dominoes; shoes and canoes are regular
    if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        return word[:-1]
    return word


def plural(word: str) -> str:
    """The plural of a noun."""
    irregular = (several for several, one in _IRREGULAR.items() if one == word != several)
    ending = "es" if singular(f"{word}es") == word else "s"
    soft = re.search("[^aeiou]y$", word)
    return next(irregular, f"{word[:-1]}ies" if soft else f"{word}{ending}")


def head_of(noun: str) -> str:
    """The noun in one of several words: "crate" in "crate_a", "carton" in "carton_of_milk"."""
    return re.sub(r"_(?:(?:of|with|for)_.*|\w|\d+)$", "", noun).rpartition("_")[2]


def same_noun(first: str, second: str) -> bool:
    """Whether two words are the same noun, apart from number."""
    return singular(first) == singular(second)


def matches_any(word: str, nouns: Iterable[str]) -> bool:
    """Whether a word is one of some nouns, apart from number."""
    return singular(word) in map(singular, nouns)


def is_plural_of(word: str, nouns: Iterable[str]) -> bool:
    """Whether a word is the plural of one of some nouns."""
    return any(word != noun and singular(word) == noun for noun in nouns)


def is_general_noun(word: str) -> bool:
    """Whether a word is one of the lexicon's nouns, whatever the scene."""
    groups: tuple[Iterable[str], ...] = (
        *KIND_NOUNS.values(), *JOINT_NOUNS.values(), CONTAINER_NOUNS, THING_NOUNS, DESK_NOUNS,
    )  # fmt: skip
    return any(matches_any(word, group) for group in groups)


def is_in_lexicon(word: str) -> bool:
    """Whether a word is one of these tables, in either number."""
    tables = (LEVELS, STATES, NUMBERS, COMMON_NOUNS, PURPOSES, MATERIALS, HELPING_NOUNS, BINS)
    single = singular(word)
    listed = any(word in table or single in table for table in tables)
    return listed or is_descriptive(word) or is_general_noun(word)
