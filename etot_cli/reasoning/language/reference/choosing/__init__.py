"""Which of the things that fit a noun phrase are meant."""
