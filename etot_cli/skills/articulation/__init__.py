"""How doors and drawers are opened and closed."""
