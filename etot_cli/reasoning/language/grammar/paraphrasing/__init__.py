"""Ways of speaking that are put into plainer ones before the rules read them."""
