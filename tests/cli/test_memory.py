"""Narrow address spaces and few files: refused in words or managed with, never a hang."""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from pathlib import Path

import pytest

from etot_cli.cli.memory import NEEDED_MIB, is_lack_of_memory
from etot_cli.errors import EtotError, ServiceError, WorldError
from tests.cli.test_process import REAL, ROOT, environment

TASK = str(ROOT / "tasks" / "task3.yaml")
SOON_S = 10.0
ROOMY_MIB = NEEDED_MIB + 128


def narrow(folder: Path, mib: int, files: int, *arguments: str) -> subprocess.CompletedProcess[str]:
    """A run within limits on address space [MiB] and open files."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (mib << 20, mib << 20))
        resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))

    return subprocess.run(
        [*REAL, *arguments], cwd=folder, env=environment(), text=True, capture_output=True,
        timeout=120, check=False, preexec_fn=limit,
    )  # fmt: skip


@pytest.mark.parametrize("mib", [100, 150, 250, NEEDED_MIB - 1])
@pytest.mark.slow
def test_too_little_address_space_is_refused_at_once(tmp_path: Path, mib: int) -> None:
    begun = time.monotonic()
    done = narrow(tmp_path, mib, 64, "plan", TASK, "--jobs", "2")
    assert done.returncode == 3 and time.monotonic() - begun < SOON_S
    assert done.stderr.startswith(f"error: the address space is limited to {mib} MiB")
    assert f"at least {NEEDED_MIB} MiB" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "arguments",
    [
        ("simulate", TASK, "--plan", "[PICK UP, holder]"),
        ("reconstruct", "nowhere"),
        ("new", "mine.yaml", "--object", "ball=sphere@0.4,0.2", "--instruction", "Take the ball."),
    ],
)
@pytest.mark.slow
def test_so_does_every_command(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    done = narrow(tmp_path, 200, 64, *arguments)
    assert done.returncode == 3 and f"at least {NEEDED_MIB} MiB" in done.stderr
    assert not any(tmp_path.iterdir())


@pytest.mark.slow
def test_a_narrow_place_is_enough_for_workers_too(tmp_path: Path) -> None:
    done = narrow(tmp_path, ROOMY_MIB, 12, "plan", TASK, "--jobs", "2", "--no-html", "-q")
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_nothing_is_loaded_that_neither_a_plan_nor_a_benchmark_begins_with() -> None:
    """OpenCV and the video library take more address space than all the others together; the rest
    would keep all workers of a benchmark waiting.
    """
    loaded = (
        "import sys, etot_cli.commands.plan, etot_cli.reporting.plan_summary, "
        "etot_cli.commands.bench, etot_cli.commands.bench_trial\n"
        "print({'cv2', 'av', 'coacd', 'scipy', 'jinja2', 'httpx', "
        "'etot_cli.benchmark.problems'} & {*sys.modules})"
    )
    done = subprocess.run(
        [sys.executable, "-c", loaded], cwd=ROOT, env=environment(), capture_output=True,
        text=True, check=True,
    )  # fmt: skip
    assert done.stdout == "set()\n"


def _raised(outer: Exception, inner: Exception) -> Exception:
    try:
        raise outer from inner
    except Exception as error:
        return error


@pytest.mark.parametrize(
    ("error", "lack"),
    [
        (MemoryError(), True),
        (ValueError("Error: engine error: Could not allocate memory"), True),
        (ImportError("libquadmath.so: failed to map segment from shared object"), True),
        (RuntimeError("can't start new thread"), True),
        (_raised(WorldError("the scene does not compile"), RuntimeError("out of memory")), True),
        # What a server says of itself, or a file is called.
        (ServiceError("HTTP 500: CUDA out of memory"), False),
        (EtotError("out of memory.yaml: no such file"), False),
        (ValueError("no"), False),
    ],
)
def test_what_counts_as_a_lack_of_memory(error: Exception, lack: bool) -> None:
    assert is_lack_of_memory(error) is lack
