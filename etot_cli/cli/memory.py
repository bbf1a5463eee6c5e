"""Room for the libraries, looked at before they are loaded.

Some of them answer a lack of address space by hanging, by aborting, or by errors that name neither
the lack nor a remedy; so what cannot work is refused first, and what they say later is recognised.
"""

from __future__ import annotations

import gc
import os
import re

from etot_cli.errors import EtotError, ServiceError

NEEDED_MIB = 350
"""Address space in which a task can be planned: 320 to 340 MiB for libraries and models, most of it
numpy and MuJoCo. Pictures (OpenCV) take 170 MiB more and are loaded where there are some."""
MIB = 1 << 20
FIRST_AFTER = 400_000
"""New objects before reference cycles are looked for first, which loading, reading an instruction
and a search stay below: looks at what is loaded meanwhile took a sixth of the time in which the
grammar is. Python looks after every 700, which takes 130 ms of a plan's 1.5 s. A search leaves
5,000 objects in cycles, with 4 MiB of models, so a process with many of them grows: 25 searches
take 276 MiB, and 181 with Python's own looks. Workers look after each call.
"""
COLLECT_EVERY = 50_000
"""New objects after which it is done later: so seldom it takes 40 ms of a plan's time."""
COLLECT_OLDER_EVERY = 12
"""Such looks after which older objects are looked at, too, for 40 ms: not within one plan. At half
of it most plans that read an instruction had one, and it spares no memory.
"""
_LACK = re.compile(
    r"(?i)(could not|cannot|unable to|failed to) (allocate|map segment)|out of memory|"
    r"can't start new thread|memory allocation (still )?failed"
)


def address_space() -> int | None:
    """Bytes of address space that this process may use; None without a limit."""
    try:
        import resource
    except ImportError:  # Windows knows no such limit
        return None
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    return None if limit == resource.RLIM_INFINITY else limit


def spare_threads() -> None:
    """Keeps the linear algebra to one thread where address space is limited.

    Each of its threads reserves a share before it has anything to do, so that what a run needs
    would grow with the processor's cores. To be called before numpy is imported.
    """
    if address_space() is not None:
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def collect_seldom() -> None:
    """Looks for garbage less often than Python would, and not at all at what is there by the first
    look: libraries and what was read; a few MiB more are in use for it.
    """
    gc.set_threshold(FIRST_AFTER, COLLECT_OLDER_EVERY)
    if _after_first_look not in gc.callbacks:
        gc.callbacks.append(_after_first_look)


def _after_first_look(phase: str, _: dict[str, int]) -> None:
    if phase == "stop":
        gc.callbacks.remove(_after_first_look)
        gc.freeze()
        gc.set_threshold(COLLECT_EVERY, COLLECT_OLDER_EVERY)


def check_address_space() -> None:
    """Refuses a limit in which the libraries cannot work.

    Raises:
        ServiceError: naming the limit and what is needed.
    """
    limit = address_space()
    if limit is not None and limit < NEEDED_MIB * MIB:
        raise ServiceError(
            f"the address space is limited to {limit // MIB} MiB, and at least {NEEDED_MIB} MiB "
            "are needed; raise the limit (ulimit -v)"
        )


def is_lack_of_memory(error: BaseException) -> bool:
    """Whether an error came of there being no room, in whatever words a library says so.

    Errors of this program quote servers and files, so they count only for what they came from.
    """
    seen: BaseException | None = error
    while seen is not None:
        said = not isinstance(seen, EtotError) and _LACK.search(str(seen))
        if said or isinstance(seen, MemoryError):
            return True
        seen = seen.__cause__ or seen.__context__
    return False
