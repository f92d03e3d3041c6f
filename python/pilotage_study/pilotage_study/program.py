"""The program `pilotage` and its shards."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

from .differences import differences


class StudyFailure(RuntimeError):
    """What the program said when it failed."""


@dataclass(frozen=True)
class Description:
    """A study and how far its folder is."""

    name: str
    flights: int
    shards: int
    missing: tuple[int, ...]
    is_complete: bool
    # Text with which the folder is begun, which says of what its shards are.
    begun: str


@dataclass(frozen=True)
class FlownShards:
    """Shards as a program flew them: the text with which it began its folder, which says of what they are, and the bytes
    of their files by name."""

    begun: str
    files: dict[str, bytes]


@dataclass(frozen=True)
class Program:
    """The program `pilotage`, by its path or by its name on the path of whoever runs it."""

    path: str = "pilotage"

    def _call(self, words: list[str], stdin: int | None = None) -> str:
        found = shutil.which(self.path)
        if found is None:
            raise StudyFailure(f"there is no program {self.path}; give its path with --program")
        done = subprocess.run([found, "study", *words], stdin=stdin, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise StudyFailure(done.stderr.strip() or f"{self.path} ended with {done.returncode}")
        return done.stdout

    def describe(self, plan: Path, out: Path, runs_per_shard: int) -> Description:
        """What there is to fly, and what is missing. Nothing is written."""
        words = [str(plan), "--out", str(out), "--runs-per-shard", str(runs_per_shard), "--describe"]
        said = json.loads(self._call(words))
        try:
            return Description(
                name=said["name"],
                flights=said["flights"],
                shards=said["shards"],
                missing=tuple(said["missing"]),
                is_complete=said["is_complete"],
                begun=said["begun"],
            )
        except KeyError as cause:
            raise StudyFailure(
                f"{self.path} does not tell {cause} of a study; give one of the version of this package"
            ) from cause

    def packed(self, plan: Path) -> str:
        """Text of the plan as other machines need it: of a study with the mission files that it names in it, of work on a
        map with the full paths of its files.
        """
        with tempfile.TemporaryDirectory(prefix="pilotage-study-") as folder:
            file = Path(folder, "plan.toml")
            self._call([str(plan), "--pack", str(file)])
            return file.read_text(encoding="utf-8")

    def fly(
        self, plan: str, shards: tuple[int, ...], runs_per_shard: int, scratch: Path | None = None
    ) -> FlownShards:
        """These shards of the plan with this text, in a folder of their own below `scratch` that is removed afterwards."""
        with tempfile.TemporaryDirectory(prefix="pilotage-study-", dir=scratch) as folder:
            file = Path(folder, "plan.toml")
            file.write_text(plan, encoding="utf-8")
            out = Path(folder, "out")
            only = ",".join(str(shard) for shard in shards)
            words = [str(file), "--out", str(out), "--runs-per-shard", str(runs_per_shard)]
            words += ["--only", only, "--threads", "1", "--quiet", "--until", "input-ends"]
            # Nobody else has the end that is written to: the program's input ends with this process, however that ends.
            input_of_program, held = os.pipe()
            try:
                self._call(words, stdin=input_of_program)
            finally:
                os.close(input_of_program)
                os.close(held)
            files = sorted(Path(out, "shards").glob("[0-9]*"))
            if len(files) != len(shards):
                raise StudyFailure(f"{len(files)} of {len(shards)} shards came")
            begun = Path(out, "study.json").read_text(encoding="utf-8")
            return FlownShards(begun, {file.name: file.read_bytes() for file in files})

    def merge(self, plan: Path, out: Path, runs_per_shard: int) -> str:
        """The table of the study, which is written beside its shards."""
        words = [str(plan), "--out", str(out), "--runs-per-shard", str(runs_per_shard), "--merge"]
        return self._call(words)


def folder_of(plan: Path) -> Path:
    """The folder that the program gives a plan that has no other: by its name, whatever its file is called.

    Raises StudyFailure where the plan cannot be read or has no name.
    """
    try:
        name = tomllib.loads(plan.read_text(encoding="utf-8"))["name"]
    except (OSError, ValueError, KeyError) as cause:
        raise StudyFailure(f"{plan}: the name of the plan cannot be read ({cause}); give --out") from cause
    return Path(f"{name}.study")


def keep(out: Path, flown: FlownShards, worker: str) -> None:
    """Puts shards that `worker` flew into the folder of a study, each file whole or not at all.

    Raises StudyFailure, and keeps none, where they are not of the study of the folder: of another program, plan or map.
    """
    begun = json.loads(Path(out, "study.json").read_text(encoding="utf-8"))
    apart = differences(json.loads(flown.begun), begun)
    if apart:
        raise StudyFailure(
            f"the worker {worker} did not do the work of {out}: {'; '.join(apart)}. Nothing of it was kept; give all"
            " workers the same program and the same files"
        )
    for name, content in flown.files.items():
        _write_whole(Path(out, "shards", name), content)


def begin(out: Path, begun: str) -> None:
    """Begins the folder of a study, unless it is: by the text that the program described it with, which looked at what is
    there."""
    Path(out, "shards").mkdir(parents=True, exist_ok=True)
    if not Path(out, "study.json").exists():
        _write_whole(Path(out, "study.json"), begun.encode())


def _write_whole(path: Path, content: bytes) -> None:
    # Processes in containers have the same number.
    fresh = path.with_name(f".{path.name}.{secrets.token_hex(8)}.unfinished")
    try:
        with fresh.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(path)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise
