"""The words of the controlled English by what they mean: tables of patterns, without rules.

Words that have no meaning of their own stand in ``small_words``, as ``WITHOUT_MEANING`` and
``FRAMES``, and nowhere else.
"""
