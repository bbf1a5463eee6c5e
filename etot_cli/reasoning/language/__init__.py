"""Reading instructions: controlled English about a scene becomes a goal, or a refusal that helps.

Text becomes every clause that the ``grammar`` allows, with its tables in ``words``; phrases find
their things (``reference``); clauses become a goal (``goals``). ``instructions`` does all of it.
"""
