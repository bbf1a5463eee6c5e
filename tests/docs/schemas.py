"""JSON Schemas of all reports, and of the files that are one document each:
``python -m tests.docs.schemas docs/schemas``.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from etot_cli.benchmark.suite import Suite
from etot_cli.reporting.bench_report import BenchReport, CompareReport
from etot_cli.reporting.execute_report import ExecuteReport
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.models import Model
from etot_cli.reporting.motion_report import TrajectoryModel
from etot_cli.reporting.plan_report import PlanReport
from etot_cli.reporting.reconstruct_report import ReconstructReport
from etot_cli.reporting.simulate_report import SimulateReport
from etot_cli.reporting.trial_report import TrialReport
from etot_cli.specs.calibration import Calibration
from tests.docs.formats import field_docstrings

DIALECT = "https://json-schema.org/draft/2020-12/schema"
REPORTS: dict[str, type[Model]] = {
    "etot.plan-1.json": PlanReport,
    "etot.simulate-1.json": SimulateReport,
    "etot.execute-1.json": ExecuteReport,
    "etot.reconstruct-1.json": ReconstructReport,
    "etot.trajectory-1.json": TrajectoryModel,
    "etot.bench-1.json": BenchReport,
    "etot.compare-1.json": CompareReport,
    "etot.trial-1.json": TrialReport,
}
"""Schema file name → report model."""
INPUTS: dict[str, type[BaseModel]] = {
    "etot.suite-1.json": Suite,
    "etot.calibration-1.json": Calibration,
}
"""Schema file name → model of a file that is read, for editors. Tasks and scenes are put together
from several files, which no schema of one of them can tell; docs/formats.md has their keys.
"""


def schema_text(model: type[BaseModel]) -> str:
    """A model's JSON Schema, as it stands in its file."""
    written = issubclass(model, Model)
    schema = model.model_json_schema(mode="serialization" if written else "validation")
    if written:
        described = {**schema.pop("$defs", {}), model.__name__: schema}
        for kind in _report_models(Model):
            _describe(described.get(kind.__name__, {}), kind)
        described.pop(model.__name__)
        schema = {"$defs": described, **schema}
    return json.dumps({"$schema": DIALECT, **schema}, indent=2, ensure_ascii=False) + "\n"


def _report_models(base: type[Model]) -> Iterator[type[Model]]:
    for kind in base.__subclasses__():
        yield kind
        yield from _report_models(kind)


def _describe(schema: dict[str, Any], model: type[Model]) -> None:
    """Gives properties the docstrings of their fields, which no command needs to know."""
    for name, told in field_docstrings(model).items():
        key = model.model_fields[name].alias or name
        if key in schema.get("properties", {}):
            content = {**schema["properties"][key], "description": told}
            schema["properties"][key] = dict(sorted(content.items()))


def main(arguments: list[str]) -> int:
    """Writes all schema files into the folder given as the only argument."""
    if len(arguments) != 1:
        print("usage: python -m tests.docs.schemas FOLDER", file=sys.stderr)
        return 2
    for name, model in (REPORTS | INPUTS).items():
        write_atomically(Path(arguments[0]) / name, schema_text(model))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
