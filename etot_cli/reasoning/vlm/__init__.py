"""A vision-language model as the reasoner, over any OpenAI-compatible endpoint.

Start at :mod:`etot_cli.reasoning.vlm.session`. Layers, from the wire up: ``wire`` (one HTTP
request), ``envelope`` (what a response means), ``client`` (retries, format ladder, limits,
cassettes), ``asking`` (prompt, frames, repair), ``reasoner``.
"""
