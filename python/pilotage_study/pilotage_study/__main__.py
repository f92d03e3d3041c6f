"""The command line."""

from __future__ import annotations

import argparse
import sys
from contextlib import ExitStack
from pathlib import Path

from .arrays import kubernetes, slurm
from .program import Program, StudyFailure, folder_of


def _arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="pilotage_study", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, about in [
        ("run", "carry out a study on a Dask cluster"),
        ("slurm", "print a job array for Slurm"),
        ("kubernetes", "print an indexed job for Kubernetes"),
    ]:
        one = commands.add_parser(name, help=about)
        one.add_argument("plan", type=Path)
        one.add_argument("--out", type=Path, help="folder of the study; NAME.study by the plan's name if not given")
        one.add_argument("--program", default="pilotage", help="the program pilotage where the shards are flown")
        one.add_argument("--runs-per-shard", type=int, default=200)
        if name == "run":
            one.add_argument("--scheduler", help="address of a cluster in use; one on this machine if not given")
            one.add_argument("--workers", type=int, help="workers of that one; as many as processors if not given")
        else:
            one.add_argument("--tasks", type=int, required=True)
        if name == "kubernetes":
            one.add_argument("--image", required=True)
            one.add_argument("--claim", required=True, help="claim of the volume with plan and folder")
    return parser.parse_args(words)


def _run(given: argparse.Namespace, out: Path) -> None:
    # Only here, for the arrays need no Dask.
    from distributed import Client, LocalCluster

    from .cluster import run_study

    def tell(there: int, all_of_them: int) -> None:
        print(f"\r{there} of {all_of_them} shards", end="", file=sys.stderr, flush=True)

    with ExitStack() as opened:
        address = given.scheduler
        if address is None:
            cluster = LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=":0")
            address = opened.enter_context(cluster).scheduler_address
        client = opened.enter_context(Client(address))
        print(f"dashboard: {client.dashboard_link}", file=sys.stderr)
        table = run_study(
            given.plan,
            out,
            client,
            program=Program(given.program),
            runs_per_shard=given.runs_per_shard,
            tell=tell,
        )
    print(file=sys.stderr)
    print(table, end="")


def main(words: list[str] | None = None) -> int:
    """Does what the words say; gives the code with which the program ends."""
    given = _arguments(words)
    common = {"program": given.program, "runs_per_shard": given.runs_per_shard}
    try:
        out = given.out or folder_of(given.plan)
        if given.command == "run":
            _run(given, out)
        elif given.command == "slurm":
            print(slurm(given.plan, out, given.tasks, **common), end="")
        else:
            print(
                kubernetes(given.plan, out, given.tasks, image=given.image, claim=given.claim, **common),
                end="",
            )
    except (StudyFailure, OSError) as failure:
        print(f"pilotage_study: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
