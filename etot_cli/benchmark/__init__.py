"""Methods, tasks and trials: who succeeds how often, and at what cost."""
