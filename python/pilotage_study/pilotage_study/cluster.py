"""Shards on a Dask cluster."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path

import cloudpickle
from distributed import CancelledError, Client, as_completed, get_worker
from distributed.scheduler import KilledWorker

from .program import FlownShards, Program, StudyFailure, begin, keep

# Tasks for each thread of the cluster, if not more: a worker that joins late or is slow finds something to do.
TASKS_EACH = 6
# Most shards of a task, so that little is lost with a worker.
MOST_SHARDS = 25
# Rounds of tasks that are given out before it is asked whether it is enough, where the plan has a rule to stop.
ROUNDS = 2


def _fly(program: Program, plan: str, shards: tuple[int, ...], runs_per_shard: int) -> tuple[FlownShards, str]:
    worker = get_worker()
    try:
        # Dask removes what a worker that was killed leaves there.
        return program.fly(plan, shards, runs_per_shard, Path(worker.local_directory)), worker.address
    except (StudyFailure, OSError) as failure:
        raise StudyFailure(f"the worker {worker.address} could not do {_named(shards)}: {failure}") from None


def _named(shards: tuple[int, ...]) -> str:
    """The shards in words."""
    if len(shards) == 1:
        return f"shard {shards[0]}"
    if shards[-1] - shards[0] == len(shards) - 1:
        return f"shards {shards[0]} to {shards[-1]}"
    return f"shards {', '.join(map(str, shards))}"


def _lost(shards: tuple[int, ...], times: int, last: BaseException) -> str:
    """That shards were lost too often, in words."""
    were = "was" if len(shards) == 1 else "were"
    often = f"{times} times, the last time so" if times > 1 else "once"
    return f"{_named(shards)} {were} lost {often}: {last}"


def _pieces(missing: tuple[int, ...], threads: int) -> Iterator[tuple[int, ...]]:
    each = max(1, min(MOST_SHARDS, len(missing) // (TASKS_EACH * max(1, threads))))
    for first in range(0, len(missing), each):
        yield missing[first : first + each]


def run_study(
    plan: Path,
    out: Path,
    client: Client,
    *,
    program: Program | None = None,
    runs_per_shard: int = 200,
    tries: int = 5,
    tell: Callable[[int, int], None] | None = None,
) -> str:
    """Carries out what is missing of a study, merges, and gives its table.

    Shards of a worker that is lost are given to another, `tries` times at most. `tell` hears how many shards
    are there and how many there are. Raises StudyFailure where a program fails, shards are lost too often, or a worker has
    another program, or another map under the name of this one: the sentence names the worker, the shards, what differs.
    """
    # Workers of a cluster in use need not have this package.
    cloudpickle.register_pickle_by_value(sys.modules[__package__])
    program = program or Program()
    text = program.packed(plan)
    description = program.describe(plan, out, runs_per_shard)
    begin(out, description.begun)
    while not description.is_complete:
        _fly_round(text, out, client, program, runs_per_shard, tries, description, tell)
        description = program.describe(plan, out, runs_per_shard)
    return program.merge(plan, out, runs_per_shard)


def _fly_round(text, out, client, program, runs_per_shard, tries, description, tell) -> None:
    threads = sum(client.nthreads().values())
    pieces = list(_pieces(description.missing, threads))
    if "stop" in tomllib.loads(text):
        # It may be enough before the end: no more is given out than a few rounds.
        pieces = pieces[: ROUNDS * max(1, threads)]

    def submit(shards: tuple[int, ...]):
        return client.submit(
            _fly, program, text, shards, runs_per_shard, pure=False, priority=-shards[0]
        )

    left = {}
    for shards in pieces:
        left[submit(shards)] = (shards, 1)
    there = description.shards - len(description.missing)
    flown = as_completed(list(left))
    try:
        for future in flown:
            shards, tried = left.pop(future)
            try:
                keep(out, *future.result())
            except (KilledWorker, CancelledError) as loss:
                if tried >= tries:
                    raise StudyFailure(_lost(shards, tried, loss)) from loss
                again = submit(shards)
                left[again] = (shards, tried + 1)
                flown.add(again)
                continue
            there += len(shards)
            if tell is not None:
                tell(there, description.shards)
    finally:
        # Nobody waits any more for what is under way where it failed; the cluster may be in use by others.
        client.cancel(list(left))
