"""The closed loop: plan, act, look, judge, and plan anew from what is seen."""
