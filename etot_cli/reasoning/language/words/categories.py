"""Words for everything of a sort ("the fruit", "the tools"), and what people count among it.

A category word is understood where nothing in the scene is called so, and what it was taken for is
always said. What is of two sorts stands in both; what is of a sort only in some uses (a bowl of
fruit, a toy car) is told by its own noun alone.
"""

from __future__ import annotations

from etot_cli.reasoning.language.words.lexicon import head_of, singular, word_set

_FRUIT = word_set(
    """
    apple orange banana lemon lime peach pear plum cherry grape berry strawberry blueberry
    raspberry blackberry cranberry melon watermelon cantaloupe mango papaya pineapple kiwi apricot
    nectarine grapefruit mandarin tangerine clementine satsuma pomegranate fig date coconut
    persimmon lychee guava quince currant avocado passionfruit pomelo plantain dragonfruit mulberry
    gooseberry
    """
)
_VEGETABLES = word_set(
    """
    potato onion carrot cucumber eggplant aubergine corn garlic mushroom cabbage lettuce broccoli
    cauliflower spinach zucchini courgette pumpkin squash radish turnip beet beetroot celery leek
    asparagus artichoke pea bean tomato pepper chili kale parsnip ginger shallot scallion yam
    avocado okra fennel sprout rutabaga arugula chard edamame jalapeno capsicum maize swede endive
    chive
    """
)
_PASTRIES = word_set(
    "bun cake cookie biscuit donut doughnut muffin cupcake croissant pie pastry brownie scone tart "
    "bagel roll pretzel baguette danish waffle cracker strudel cheesecake eclair macaron churro"
)
_SWEETS = word_set(
    "candy chocolate lollipop gum caramel toffee truffle marshmallow fudge lolly licorice "
    "liquorice "
    "jellybean jelly_bean gummy gummy_bear nougat"
)
_SNACKS = word_set(
    "chip crisp nut peanut almond popcorn granola raisin cracker pringle dorito cashew pistachio "
    "walnut hazelnut pecan jerky trail_mix"
)
_DRINKS = word_set(
    "milk juice water coffee tea cola coke soda beer wine lemonade smoothie cocoa cider sprite "
    "pepsi fanta kombucha redbull gatorade gin vodka rum whisky whiskey tequila 7up drpepper "
    "espresso latte cappuccino ale lager champagne prosecco liqueur seltzer milkshake mocha matcha "
    "hot_chocolate"
)
_SPICES = word_set(
    "salt pepper cinnamon paprika cumin oregano basil thyme turmeric nutmeg curry saffron rosemary "
    "sage coriander cardamom clove cayenne"
)
_SAUCES = word_set(
    "ketchup catsup mustard mayonnaise mayo relish salsa vinegar dressing sauce syrup gravy pesto "
    "chutney sriracha tabasco tahini guacamole aioli wasabi"
)
_DAIRY = word_set(
    "milk cheese butter cream yogurt yoghurt mozzarella milkshake ice_cream margarine"
)
_OTHER_FOOD = word_set(
    """
    bread toast bagel loaf pizza egg cheese butter meat steak ham bacon sausage fish salmon tuna
    chicken turkey soup cereal granola oatmeal rice pasta noodle spaghetti jam honey yogurt
    sandwich burger hamburger hotdog taco burrito sushi salad pancake fries chip cracker nut
    peanut almond tofu spam pudding patty nigiri maki kebab omelette lasagna
    dumpling falafel popcorn sugar flour jello jelly muesli ravioli lentil quinoa hummus tortilla
    marmalade nutella pickle olive margarine cream oil porridge yoghurt salami mozzarella broth
    hot_dog ice_cream peanut_butter
    nut_butter almond_butter cashew_butter coconut_milk stew shrimp prawn crab lobster sardine
    pretzel crouton quesadilla gnocchi macaroni seaweed cheddar feta
    """
)
_FOOD = frozenset().union(
    *(_FRUIT, _VEGETABLES, _PASTRIES, _SWEETS, _SNACKS, _DAIRY, _SPICES, _SAUCES, _OTHER_FOOD)
)
"""With what is eaten with it; drinks are none, but for milk."""
_TOOLS = word_set(
    """
    hammer mallet wrench spanner screwdriver drill saw hacksaw plier chisel file rasp clamp vise
    tweezer tong cutter snip nipper scraper awl crimper pry_bar torque_wrench
    level crowbar axe hatchet ratchet sander soldering_iron multimeter caliper trowel shears
    secateurs rake shovel spade hoe pruner hand_fork handsaw pincer mattock pickaxe
    tape_measure measuring_tape box_cutter wire_cutter bolt_cutter wire_stripper utility_knife
    putty_knife stanley_knife craft_knife allen_key hex_key allen_wrench nut_driver heat_gun
    glue_gun
    nail_gun caulking_gun
    """
)
_FASTENERS = word_set("screw nail bolt nut washer rivet staple wing_nut hex_nut lug_nut lock_nut")
_CUTLERY = word_set("fork knife spoon teaspoon tablespoon chopstick spork")
_COOKING = word_set(
    "spatula ladle whisk tongs peeler grater masher colander strainer turner rolling_pin corkscrew "
    "can_opener bottle_opener sieve zester skewer slicer pizza_cutter measuring_cup"
)
_DISHES = word_set(
    "plate bowl saucer cup mug glass platter dish teacup ramekin tumbler goblet wineglass "
    "wine_glass"
)
_WRITING = word_set("pen pencil marker crayon highlighter chalk sharpie biro ballpoint fineliner")
_STATIONERY = word_set(
    "stapler ruler eraser notebook notepad envelope folder binder scissors sharpener "
    "glue glue_stick paperclip paper_clip tape sticky_notes clipboard paper pushpin push_pin "
    "thumbtack hole_punch binder_clip rubber_band protractor"
)
_VEHICLES = word_set(
    "car truck train bus van taxi ambulance tractor bicycle bike motorcycle scooter plane airplane "
    "aeroplane helicopter boat ship rocket"
)
_ANIMALS = word_set(
    """
    bear duck dog cat horse cow pig sheep lamb goat lion tiger elephant giraffe zebra monkey rabbit
    bunny dinosaur penguin frog turtle fox wolf panda owl bird chick hen rooster fish shark
    whale dolphin unicorn dragon octopus camel deer hippo rhino kangaroo koala crocodile alligator
    squirrel hedgehog snake lizard pony donkey goose swan parrot eagle butterfly ladybug hamster
    puppy kitten raccoon otter gorilla leopard cheetah llama ostrich flamingo t_rex trex
    """
)
_PLAYTHINGS = word_set(
    "ball doll teddy puppet yoyo kite puzzle figurine block robot lego rattle drum jigsaw marble "
    "xylophone frisbee tambourine yo_yo plushie slinky spinning_top lego_brick toy_brick jump_rope "
    "action_figure rubiks_cube"
)
_LIKE_PEOPLE = _ANIMALS | word_set(
    "doll teddy puppet figurine robot guard soldier knight king queen prince princess pirate clown "
    "baby man woman boy girl wizard witch astronaut fireman policeman santa snowman gnome mermaid"
)
_CLOTHES = word_set(
    "shirt tshirt sweater pullover hoodie coat jacket sock hat cap beanie scarf glove mitten pants "
    "trouser jean short skirt dress blouse belt tie pajama pyjama sweatshirt jumper cardigan vest "
    "legging raincoat swimsuit bathrobe"
)
_SHOES = word_set("shoe boot sneaker trainer sandal slipper heel loafer flip_flop clog")
_TOILETRIES = word_set(
    "toothbrush toothpaste soap shampoo conditioner deodorant razor comb hairbrush lotion floss "
    "mouthwash perfume sunscreen shower_gel body_wash moisturizer hand_cream shaving_cream "
    "sun_cream "
    "face_cream nail_file"
)
_MEDICINES = word_set(
    "pill tablet capsule lozenge aspirin ibuprofen paracetamol antibiotic antacid ointment salve "
    "insulin inhaler cough_syrup cough_drop cough_medicine eye_drop ear_drop nose_drop nasal_spray"
)
"""What cures; plasters and bandages only cover."""
_ELECTRONICS = word_set(
    "phone telephone cellphone smartphone laptop computer tablet keyboard monitor camera headphone "
    "earphone earbud charger calculator remote controller console radio speaker headset webcam "
    "television tv router printer smartwatch power_bank"
)
_JEWELRY = word_set("ring necklace bracelet earring brooch pendant bangle anklet locket")
_FLOWERS = word_set(
    "rose tulip daisy lily sunflower daffodil orchid carnation peony poppy hyacinth"
)
_READING = word_set("book magazine newspaper comic novel dictionary atlas textbook")

ROUND = "round_thing"
"""What is a ball by its shape, whatever it is called."""
FRUITING = "botanical_fruit"
"""What is a fruit to a botanist, and where there is no other one to anybody."""
SORTS: dict[str, frozenset[str]] = {
    ROUND: word_set("ball sphere"),
    "fruit": _FRUIT,
    FRUITING: _FRUIT | word_set("tomato cucumber pumpkin aubergine eggplant olive"),
    "citrus": word_set("orange lemon lime grapefruit mandarin tangerine clementine satsuma"),
    "vegetable veggie veg": _VEGETABLES,
    "dairy": _DAIRY,
    "produce": _FRUIT | _VEGETABLES,
    "pastry dessert": _PASTRIES,
    "sweet": _SWEETS,
    "snack": _SWEETS | _PASTRIES | _SNACKS,
    "drink beverage": _DRINKS,
    "soda soft_drink": word_set("soda cola coke pepsi sprite fanta lemonade 7up drpepper"),
    "spice seasoning": _SPICES,
    "condiment": _SPICES | _SAUCES,
    "food edible": _FOOD | _FRUIT | _VEGETABLES,
    "grocery": _FOOD | _DRINKS,
    "tool": _TOOLS,
    "fastener": _FASTENERS,
    "cutlery silverware flatware": _CUTLERY,
    "utensil": _CUTLERY | _COOKING,
    "dish tableware crockery dishware dinnerware": _DISHES,
    "kitchenware": _CUTLERY
    | _COOKING
    | _DISHES
    | word_set("pot pan skillet wok saucepan kettle teapot jug pitcher"),
    "writing_utensil": _WRITING,
    "stationery": _WRITING | _STATIONERY,
    "vehicle": _VEHICLES,
    "animal": _ANIMALS,
    "toy plaything": _PLAYTHINGS | _VEHICLES | _ANIMALS,
    "clothes clothing garment laundry": _CLOTHES,
    "footwear": _SHOES,
    "toiletry": _TOILETRIES,
    "medicine medication": _MEDICINES,
    "gadget electronics": _ELECTRONICS,
    "jewelry jewellery": _JEWELRY,
    "flower": _FLOWERS,
    "literature": _READING,
}
"""Category words, several for one thing, with the nouns of what counts among it."""
_SUPPLIES = word_set(
    "glue paint ink oil grease flux solder varnish acetone ethanol detergent bleach polish wax"
)
PACKED = frozenset().union(
    *(_DRINKS, _SPICES, _SAUCES, _SWEETS, _OTHER_FOOD, _FRUIT, _VEGETABLES),
    *(_TOILETRIES, _SUPPLIES, _MEDICINES),
)
"""What :data:`PACKS` of it are still called by (a milk carton is among "the drinks")."""
_POURED = word_set("shampoo conditioner lotion toothpaste perfume honey soup sugar flour").union(
    _SUPPLIES, _DRINKS, _SPICES, _SAUCES
)
"""What comes out of its pack bit by bit: without an article some of it is meant, not the pack."""
_KEEPING = word_set("basket hamper crate box bin bag tray rack cooler caddy cart sink trash can")
"""Where packs are kept or carried as they are: nobody pours ketchup into a basket."""
_OF_A_PIECE = word_set("bar leaf slice wedge fillet clove")
PACKS = _OF_A_PIECE | word_set(
    "can tin carton bottle jar packet pack bag box tube pouch shaker mill grinder stick"
)
"""Nouns for what food and drink come in, or come off in."""
LUMPS = word_set("cube lump slice loaf wedge chunk")
"""So much of a food as is one thing ("sugar cube"), unless it is a colour (an orange cube)."""
GROUND = word_set("shaker mill grinder")
"""Packs of seasoning: a pepper mill is no vegetable."""
SERVING = word_set("glass mug cup bowl teacup tumbler goblet jug pitcher carafe")
SERVED = _DRINKS | word_set("water soup stew porridge cereal oatmeal broth cocoa chili")
"""What a vessel may be called by that it is served in ("my soup")."""
PART_NOUNS = word_set("part component workpiece")
_BASES = word_set(
    "tray mat placemat plate board pad pallet platform base fixture jig rack book notebook notepad "
    "paper cloth towel napkin scale"
)
OF_A_SORT = frozenset().union(*SORTS.values())
"""What counts among any sort."""
NO_PARTS = (OF_A_SORT | _BASES) - _FASTENERS
"""What no :data:`PART_NOUNS` speak of: what has a use of its own, or bears what is worked on."""
MASS_NOUNS = word_set(
    """
    fruit produce food cutlery silverware flatware tableware crockery dishware dinnerware
    veg stationery citrus dairy kitchenware money cash clothes clothing laundry footwear electronics
    jewelry jewellery literature medicine medication yarn wool
    """
)
"""Words that mean all of a sort without a plural ("put the fruit in the bowl")."""

CALLED = {
    "writing_utensil": "writing (?:utensil|implement|instrument|tool|thing)",
    "utensil": "(?:kitchen|cooking) (?:utensil|tool|implement)",
    "tool": "hand tool",
    "cutlery": "(?:eating|table) utensils",
    "stationery": "office supplies",
    "citrus": "citrus fruits?",
    "soft_drink": "(?:soft|fizzy) drink",
    ROUND: "(?:round|(?:ball|sphere) shaped|spherical) (?:thing|object|item)",
}
"""Several words for such a word."""


CATEGORIES: dict[str, frozenset[str]] = {
    word: frozenset(map(singular, nouns))
    for words, nouns in SORTS.items()
    for word in words.split()
}
"""The same by each word, all nouns in the singular."""


def is_category(word: str) -> bool:
    """Whether a noun, in either number, stands for everything of a sort."""
    return bool(members_of(word))


def members_of(category: str) -> frozenset[str]:
    """The nouns, in the singular, of what counts among a category; empty where it is none."""
    return CATEGORIES.get(category) or CATEGORIES.get(singular(category), frozenset())


_NO_TOPS = frozenset().union(*(_FRUIT, _VEGETABLES, _CUTLERY, _WRITING, _FLOWERS, _TOOLS))
_NO_TOPS |= word_set("scissors ball sphere bottle egg brush toothbrush key needle candle")


def has_no_top(label: str) -> bool:
    """Whether nobody sets anything down on what has a label, flat as it may be: what is brought to
    a pair of scissors is to lie beside it.
    """
    head = head_of(label.casefold().replace(" ", "_"))
    return bool({head, singular(head)} & _NO_TOPS)


def is_like_people(label: str) -> bool:
    """Whether what has a label is spoken of as "he" or "she"; a dog's bowl is not."""
    return head_of(label.casefold().replace(" ", "_")) in _LIKE_PEOPLE


def is_eaten(label: str) -> bool:
    """Whether what has a label is food."""
    return singular(label.casefold().rpartition(" ")[2]) in CATEGORIES["food"]


def is_poured(noun: str, name: str, label: str) -> bool:
    """Whether a noun without an article is rather some of what a thing so called holds."""
    head, _, content = label.casefold().partition(" of ")
    if noun and content == noun:
        return singular(noun) == noun and head.rpartition(" ")[2] in PACKS - _OF_A_PIECE
    return noun in _POURED and noun in f"{label} {name}".casefold().replace("_", " ").split()


def is_keeping(label: str) -> bool:
    """Whether things are put into what has a label to be carried or kept, in their packs."""
    return singular(label.casefold().rpartition(" ")[2]) in _KEEPING
