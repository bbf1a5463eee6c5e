"""An instruction as it was typed: cut into sentences and words, slips of the pen put right."""
