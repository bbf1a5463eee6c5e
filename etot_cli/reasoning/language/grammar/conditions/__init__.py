"""Rules for what must hold: what is forbidden, stays as it is, or is so in the end."""
