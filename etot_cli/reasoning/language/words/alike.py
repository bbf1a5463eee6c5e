"""Everyday names of things: those of one and the same thing, and the sorts of a thing.

They count only where nothing is called so itself: what is called by the very noun comes before what
has another name for it, and several that have are asked about.
"""

from __future__ import annotations

TWINS: tuple[tuple[str, ...], ...] = (
    ("train", "toy train", "locomotive"), ("teddy", "teddy bear"), ("rabbit", "bunny"),
    ("truck", "lorry"), ("airplane", "aeroplane", "plane"),
    ("fridge", "refrigerator"), ("closet", "wardrobe"), ("couch", "sofa", "settee"),
    ("faucet", "tap"), ("phone", "telephone", "cellphone"), ("tv", "television", "telly"),
    ("flashlight", "torch"), ("sneaker", "trainer"), ("cookie", "biscuit"),
    ("cutting board", "chopping board"), ("spanner", "wrench"), ("eraser", "rubber"),
    ("paper ball", "crumpled paper", "paper wad"), ("tube", "test tube"),
    ("remote", "remote control"),
    ("pen holder", "pen pot", "pen cup", "pencil holder", "pencil pot", "pencil cup"),
    ("tv cabinet", "telly cabinet", "television cabinet"), ("stove", "cooker", "hob"),
    ("dish towel", "tea towel", "dishcloth"), ("candy", "sweet"), ("tape", "sellotape"),
    ("eggplant", "aubergine"), ("zucchini", "courgette"), ("diaper", "nappy"),
    ("ladybird", "ladybug"), ("pacifier", "dummy"), ("backpack", "rucksack"),
    ("cotton bud", "cotton swab"), ("clothes peg", "clothespin"), ("drawing pin", "thumbtack"),
    ("paper towel", "kitchen towel", "kitchen roll"), ("cling film", "plastic wrap"),
    ("hex key", "allen key", "hex wrench", "allen wrench"), ("beetroot", "beet"),
    ("bell pepper", "capsicum"), ("spring onion", "scallion", "green onion"), ("prawn", "shrimp"),
    ("nail polish", "nail varnish"), ("band aid", "sticking plaster", "adhesive bandage"),
    ("popsicle", "ice lolly"),
    ("trash can", "trash bin", "garbage can", "garbage bin", "rubbish bin", "waste bin",
     "waste container", "wastepaper bin", "wastepaper basket", "dustbin", "wastebasket", "trash",
     "garbage"),
    ("letter", "envelope"), ("glass", "tumbler"), ("glass", "beaker"), ("cup", "mug"),
    ("parcel", "package"), ("cloth", "rag"), ("napkin", "serviette"), ("tissue", "kleenex"),
    ("jug", "pitcher"), ("bucket", "pail"), ("frying pan", "skillet"), ("strainer", "sieve"),
    ("sponge", "scourer"), ("spatula", "turner"), ("bread", "loaf"), ("corn", "sweetcorn"),
    ("chip", "crisp"), ("coke", "cola"), ("notebook", "notepad"),
    ("folder", "binder"), ("tape", "sticky tape", "adhesive tape"),
    ("thumbtack", "tack"),
    ("photo", "photograph", "picture"), ("monitor", "screen"), ("phone", "mobile"),
    ("headphones", "headset"), ("headphones", "earphones"), ("cable", "cord"), ("rope", "cord"),
    ("glasses", "spectacles", "specs", "eyeglasses"), ("string", "twine"), ("yarn", "wool"),
    ("cushion", "pillow"), ("tape measure", "measuring tape"), ("shovel", "spade"),
    ("utility knife", "box cutter", "stanley knife", "craft knife"), ("secateurs", "pruners"),
    ("forceps", "tweezers"), ("pipette", "dropper"), ("vial", "phial"), ("balance", "scale"),
    ("till", "cash register"), ("trolley", "cart"), ("tin opener", "can opener"),
    ("oven glove", "oven mitt"), ("baking tray", "baking sheet", "cookie sheet"),
    ("salt shaker", "salt cellar"), ("pepper mill", "pepper grinder"),
    ("salt mill", "salt grinder"), ("peeler", "potato peeler", "vegetable peeler"),
    ("dish soap", "dishwashing liquid", "dish liquid"),
    ("tin foil", "aluminium foil", "aluminum foil", "kitchen foil", "tinfoil"),
    ("measuring cup", "measuring jug"), ("thermos", "thermos flask", "vacuum flask"),
    ("drinking straw", "straw"), ("cilantro", "coriander"), ("oatmeal", "porridge"),
    ("chickpea", "garbanzo bean"), ("toilet paper", "toilet roll", "loo roll"),
    ("hairdryer", "blow dryer"), ("nail clippers", "nail cutter"), ("razor", "shaver"),
    ("sticky notes", "adhesive notes"), ("sticky note", "adhesive note"),
    ("hole punch", "hole puncher", "paper punch"),
    ("marker", "marker pen", "felt pen"), ("highlighter", "text marker"),
    ("usb stick", "flash drive", "thumb drive", "usb drive"),
    ("scotch tape", "sticky tape", "adhesive tape", "sellotape"),
    ("power strip", "extension lead", "extension cord"),
    ("magnifying glass", "magnifier"), ("picture frame", "photo frame"),
    ("duct tape", "duck tape", "gaffer tape"),
    ("electrical tape", "insulating tape", "insulation tape"),
    ("adjustable spanner", "adjustable wrench"),
    ("phillips screwdriver", "crosshead screwdriver", "cross head screwdriver"),
    ("flathead screwdriver", "slotted screwdriver", "flat head screwdriver"),
    ("needle nose pliers", "long nose pliers"),
    ("cable tie", "zip tie"),
    ("safety glasses", "safety goggles"), ("hard hat", "safety helmet"),
    ("sweater", "jumper", "pullover"), ("trousers", "pants"), ("bathrobe", "dressing gown"),
    ("stuffed animal", "stuffed toy", "soft toy", "plush toy", "plushie"),
    ("skipping rope", "jump rope"),
    ("race car", "racing car"), ("hose", "hosepipe"),
    ("flower pot", "plant pot", "flowerpot"), ("hanger", "coat hanger", "clothes hanger"),
    ("storage box", "storage bin", "storage container"),
    ("graduated cylinder", "measuring cylinder"), ("petri dish", "culture dish"),
    ("erlenmeyer flask", "conical flask"),
)  # fmt: skip
"""Everyday names of one and the same thing, in whichever English."""
SORTS: dict[str, str] = {
    word: noun
    for noun, words in {
        "ball": "football basketball baseball softball volleyball",
        "board": "chessboard checkerboard breadboard clipboard pegboard whiteboard blackboard "
        "chalkboard corkboard pinboard",
        "book": "textbook schoolbook storybook cookbook novel hardback hardcover paperback "
        "thriller dictionary encyclopedia notebook atlas workbook sketchbook scrapbook guidebook",
        "nut": "walnut hazelnut chestnut peanut cashew pecan",
        "spoon": "teaspoon tablespoon soupspoon dessertspoon",
        "berry": "strawberry blueberry raspberry blackberry cranberry gooseberry",
        "knife": "penknife pocketknife scalpel", "glass": "wineglass tumbler goblet",
        "cup": "teacup", "pan": "saucepan skillet wok", "case": "suitcase briefcase",
        "pot": "teapot flowerpot coffeepot stockpot planter casserole", "jug": "carafe",
        "bag": "handbag schoolbag toolbag backpack rucksack sack", "flask": "thermos",
        "basket": "breadbasket punnet hamper", "melon": "watermelon", "strainer": "colander",
        "brush": "toothbrush paintbrush hairbrush nailbrush", "cake": "cheesecake fruitcake",
        "box": "lunchbox toolbox matchbox shoebox breadbox toybox",
        "cloth": "washcloth tablecloth dishcloth rag duster towel", "plate": "platter",
        "mat": "placemat doormat bathmat rug", "pen": "biro ballpoint", "hammer": "mallet",
        "marker": "highlighter", "computer": "laptop", "pad": "notepad",
        "paper": "newspaper", "card": "postcard flashcard", "clip": "paperclip hairclip",
        "pin": "pushpin hairpin", "watch": "wristwatch stopwatch", "coat": "raincoat overcoat",
        "phone": "smartphone", "chair": "armchair", "truck": "firetruck", "bike": "motorbike",
        "boat": "sailboat speedboat rowboat lifeboat tugboat", "saw": "hacksaw handsaw",
    }.items()
    for word in words.split()
}  # fmt: skip
"""Nouns in one word, and the noun of which they are a sort. Many that end alike are none: a
cupboard is no board, a dustpan no pan, a pineapple no apple."""
