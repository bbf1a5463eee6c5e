"""Rules for what is to be done: putting, taking, opening, stacking, emptying, grasping."""
