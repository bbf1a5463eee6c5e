"""Where things stand to each other, as people say it."""
