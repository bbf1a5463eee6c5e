"""What the things of a scene are called, and which of them a noun with adjectives fits."""
