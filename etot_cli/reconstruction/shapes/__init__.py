"""The families of shapes that are fitted, simple ones first."""
