"""What stands on another thing, fitted together with it.

How high the lower one is cannot be seen where the upper one covers its top; but there the upper
one's foot is seen, and that is as high.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from etot_cli.reconstruction.capture.view import Array
from etot_cli.reconstruction.fit.pose import freedom_of, judge, residuals_of
from etot_cli.reconstruction.fit.rims import disagreement
from etot_cli.reconstruction.fit.solver import minimize
from etot_cli.reconstruction.objects import Solid

OPEN = 1.0
"""By so much more may the lower one disagree with what is seen of it, in squares of its
standard deviations: one is as good as none. A covered can's rises by 0.001, that of a chest in
sight by 27."""


def stacked(solids: list[Solid]) -> list[Solid]:
    """The solids, with the last one fitted together with what it stands on.

    Where another thing stands there already, the height is known from that one; and where what is
    seen of the lower one says otherwise, that is believed.
    """
    above = solids[-1]
    borne = [solid for solid in solids if solid.support == above.support]
    below = next((solid for solid in solids if solid.name == above.support), None)
    if below is None or above.relation != "on" or len(borne) > 1:
        return solids
    pair = (below, above)
    free, low, high, scale = zip(
        *(freedom_of(one.fit.family, one.observation, one.fit.params, ("z",)) for one in pair),
        strict=True,
    )

    def parted(values: Array) -> list[Array]:
        found = [one.fit.params.copy() for one in pair]
        split = int(free[0].sum())
        found[0][free[0]], found[1][free[1]] = values[:split], values[split:]
        found[1][2] = found[0][2] + below.fit.family.size(found[0])[2]
        return found

    def residuals(values: Array) -> Array:
        return np.concatenate([
            residuals_of(one.fit.family, one.observation, params)
            for one, params in zip(pair, parted(values), strict=True)
        ])  # fmt: skip

    start = [one.fit.params[own] for one, own in zip(pair, free, strict=True)]
    found = minimize(
        residuals, np.concatenate(start), scale=np.concatenate(scale), low=np.concatenate(low),
        high=np.concatenate(high),
    )  # fmt: skip
    settled = {
        one.name: replace(one, fit=judge(one.fit.family, one.observation, params))
        for one, params in zip(pair, parted(found.x), strict=True)
    }
    if disagreement([settled[below.name]]) > disagreement([below]) + OPEN:
        return solids
    return [settled.get(solid.name, solid) for solid in solids]
