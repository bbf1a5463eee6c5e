"""Where known objects are, from RGB-D pictures."""
