"""From text to syntax: the grammar of the controlled English.

Every rule finds all its readings; the scene decides between them. Nouns are any words that are no
words of the grammar, so it knows no object. What a phrase of the tables in ``words`` means is in
the value beside it: a word that stands in none of them is never read over.
"""
