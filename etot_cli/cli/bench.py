"""The command ``etot bench``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from etot_cli.cli.exits import NO, OK
from etot_cli.cli.interrupts import heed
from etot_cli.cli.options import (
    Force,
    Html,
    Json,
    Out,
    Quiet,
    Reasoner,
    ReasonerName,
    TrialJobs,
    Verbose,
    VlmJudge,
    VlmMaxCalls,
    VlmMaxCost,
    VlmModelName,
    VlmRecord,
    VlmReplay,
    VlmUrl,
    model_settings,
    refuse_beside,
)
from etot_cli.cli.session import Session, print_json
from etot_cli.errors import ServiceError
from etot_cli.specs.bounds import MAX_TRIALS

ENGINES = ("local", "ray")


def _engine(value: str) -> str:
    if value not in ENGINES:
        raise typer.BadParameter(f"found {value!r}, expected local or ray")
    return value


def bench(
    context: typer.Context,
    tasks: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TASKS...",
            help="Task files, folders of them, suite files, and random:N for N random problems.",
        ),
    ] = None,
    methods: Annotated[
        str | None,
        typer.Option(
            "--methods",
            metavar="A,B,...",
            help="Methods, with commas: rekep, rekep_cot, reflect, etot, etot_without_priori, "
            "etot_without_reflective, etot_without_replan, etot_kinematic. [default: all]",
        ),
    ] = None,
    trials: Annotated[
        int | None,
        typer.Option(
            "--trials",
            min=1,
            max=MAX_TRIALS,
            metavar="N",
            help="Trials of each method on each task. [default: as the suite says, else 10]",
        ),
    ] = None,
    jobs: TrialJobs = 1,
    engine: Annotated[
        str,
        typer.Option(
            "--engine",
            callback=_engine,
            metavar="local|ray",
            help="Where trials are run: in processes here, or on the Ray cluster that RAY_ADDRESS "
            "names (without it, on one of its own).",
        ),
    ] = "local",
    resume: Annotated[
        Path | None,
        typer.Option(
            "--resume", metavar="DIR", help="Go on with a run that ended early, in its folder."
        ),
    ] = None,
    compare: Annotated[
        tuple[Path, Path] | None,
        typer.Option(
            "--compare",
            metavar="A B",
            help="Compare two reports instead of running; exit code 1 when a method got "
            "significantly worse. With --out, report and page are written.",
        ),
    ] = None,
    reasoner: Reasoner = ReasonerName.BUILTIN,
    vlm_url: VlmUrl = None,
    model: VlmModelName = None,
    judge: VlmJudge = None,
    record: VlmRecord = None,
    replay: VlmReplay = None,
    max_calls: VlmMaxCalls = None,
    max_cost: VlmMaxCost = None,
    video_url: Annotated[
        str | None,
        typer.Option(
            "--video-url",
            metavar="URL",
            help="A video-generation endpoint as the world model of etot_kinematic; its videos are "
            "judged by the model of --vlm-url.",
        ),
    ] = None,
    html: Html = True,
    out: Out = None,
    force: Force = False,
    seed: Annotated[
        int | None,
        typer.Option(
            "--seed",
            min=0,
            max=2**32 - 1,
            metavar="N",
            help="Same inputs and seed, same result. [default: as the suite says, else 0]",
        ),
    ] = None,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> int:
    """Measure how often methods succeed on tasks, in varied worlds, and at what cost.

    Exit code 0: all trials were run; 1: --max-calls or --max-cost ended the run, or, with
    --compare, a method got significantly worse; 2: unusable input; 3: a service is not there or
    went away, or no trial could be carried out; 130: interrupted.
    """
    if compare is not None:
        refuse_beside(context, "--compare", ("compare", "out", "force", "json", "quiet"))
        return _compare(*compare, out=out, force=force, json=json, quiet=quiet)
    if not tasks and resume is None:
        raise typer.BadParameter("nothing to run; name task files, folders, suites or random:N")
    if resume is not None and (out is not None or force):
        other = "--force" if force else "--out"
        raise typer.BadParameter(f"--resume DIR goes on in DIR; {other} has no place beside it")
    if resume is not None and not resume.is_dir():
        raise typer.BadParameter(f"--resume {resume}: there is no such folder")
    vlm = model_settings(
        reasoner, vlm_url=vlm_url, model=model, judge=judge, record=record, replay=replay,
        max_calls=max_calls, max_cost=max_cost,
    )  # fmt: skip
    if video_url is not None and reasoner is not ReasonerName.VLM:
        raise typer.BadParameter("--video-url needs --reasoner vlm, which looks at the videos")
    subject = Path((tasks or [str(resume)])[0].replace(":", "-"))
    session = Session(
        "bench", subject, out=resume or out, json=json, quiet=quiet, verbose=verbose,
        force=force or resume is not None,
    )  # fmt: skip
    from etot_cli.commands.bench import BenchOptions, run_bench

    heed()

    options = BenchOptions(
        inputs=tuple(tasks or ()),
        seed=seed,
        trials=trials,
        methods=None if methods is None else tuple(map(str.strip, methods.split(","))),
        jobs=jobs,
        engine=engine,
        reasoner=reasoner.value,
        vlm=vlm,
        video_url=video_url,
        pages=html,
        resume=resume is not None,
        force=force,
    )  # fmt: skip
    with session.trial_observer() as observer:
        report = run_bench(options, session.folder, observer)
    path = session.save(report)
    if html:
        from etot_cli.reporting.files import write_page
        from etot_cli.reporting.page.bench_page import bench_page

        folder = session.folder
        session.add_page(report, lambda told: write_page(bench_page(report, folder), folder))
    from etot_cli.reporting.bench_table import BenchSummary

    code = session.conclude(
        report, path,
        lambda out: BenchSummary(out.console, out.verbosity).show(report, path),
    )  # fmt: skip
    if report.status == "lost":
        raise ServiceError(
            f"the run was ended: {report.reason}; go on with it by --resume {session.folder}"
        )
    if code == OK and all(trial.status == "error" for trial in report.trials):
        raise ServiceError(f"no trial could be carried out: {report.trials[0].reason}")
    return code


def _compare(
    first: Path, second: Path, *, out: Path | None, force: bool, json: bool, quiet: bool
) -> int:
    """Prints how two runs differ; with ``out``, writes report and page."""
    from etot_cli.commands.bench_compare import compare
    from etot_cli.reporting.bench_table import significantly_worse, told
    from etot_cli.reporting.files import claim_folder, write_page, write_report

    report = compare(first, second)
    if out is not None:
        from etot_cli.reporting.page.compare_page import compare_page

        claim = claim_folder("bench", "compare", out, force=force)
        try:
            write_report(report, claim.path)
            page = write_page(compare_page(report), claim.path)
        finally:
            claim.release()
        if not quiet:
            print(f"page: {page}", file=sys.stderr)
    worse = [pair for pair in report.comparisons if significantly_worse(pair)]
    if json:
        print_json(report)
    else:
        for pair in [] if quiet else report.comparisons:
            print(("worse: " if pair in worse else "") + told(pair))
        if report.left_out and not quiet:
            print(f"{report.left_out} trials that only one of the reports has are left out")
        names = ", ".join(pair.second for pair in worse)
        print(f"significantly worse: {names}" if worse else "no method got significantly worse")
    return NO if worse else OK
