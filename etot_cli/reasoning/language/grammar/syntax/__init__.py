"""The syntax tree of an instruction, before any scene is looked at."""
