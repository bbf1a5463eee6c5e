"""Where and how an object can be held."""
