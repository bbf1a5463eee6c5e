"""What all tests share."""

from __future__ import annotations

import os

# Pages have tests of their own; the hundreds of other runs need not render pictures.
os.environ.setdefault("ETOT_HTML", "0")
