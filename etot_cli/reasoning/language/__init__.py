"""Reading instructions: controlled English about a scene becomes a goal, or a refusal that helps.

Text becomes words (``text``), words become every clause that the ``grammar`` allows (``syntax``),
phrases find their things (``noun_phrases``, ``coreference``), clauses become a goal (``goals``).
"""
