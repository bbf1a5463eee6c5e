"""From words to things: which objects, parts and places of a scene a phrase means."""
