"""Which pixels belong to which object, and what the objects are called."""
