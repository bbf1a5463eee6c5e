"""Methods, ablations and trials over tasks, shipped ones and random ones."""
