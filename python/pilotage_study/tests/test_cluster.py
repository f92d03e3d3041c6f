"""Studies on a cluster of this machine are those of the plain program, to the bit."""

import contextlib
import io
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib
from pathlib import Path

import duckdb
from distributed import Client, LocalCluster

from pilotage_study import Program, StudyFailure, run_study
from pilotage_study.__main__ import main

PLAN = """
name = "small"
question = "Is it the same?"
seed = 3
draws = 24
fixed = { seconds = 8, step = 0.25, scenario = "distinct-400ft-calm" }
cross.vehicle = ["airplane-wind", "airplane-full"]
draw.wind-speed = { uniform = [0, 6] }
measure = [{ of = "error-rms" }, { of = "error-max", name = "near", at_most = 6 }]
"""
ROUTE_PLAN = """
name = "survey"
question = "Does the height matter?"
draws = 6
fixed = { mission = "survey.geojson", seconds = 8, step = 0.25 }
cross.height = [40, 80]
measure = [{ of = "error-rms" }]
"""
RUNS_PER_SHARD = 4


def write_map(folder: Path) -> None:
    """A map of 1400 by 1400 m with bright roofs on green ground, as PNG with its world file."""
    side = 1400

    def row(y: int) -> bytes:
        is_roof = [30 <= y % 110 < 46 and 20 <= x % 130 < 32 for x in range(side)]
        noise = [(x * 7919 + y * 104729) % 37 for x in range(side)]
        pixels = (
            (165, 110, 95) if roof else (70 + more, 92 + more, 48 + more)
            for roof, more in zip(is_roof, noise, strict=True)
        )
        return b"\0" + bytes(value for pixel in pixels for value in pixel)

    def chunk(name: bytes, content: bytes) -> bytes:
        sum_of = zlib.crc32(name + content)
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", sum_of)

    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    picture = zlib.compress(b"".join(row(y) for y in range(side)))
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", picture) + chunk(b"IEND", b"")
    Path(folder, "map.png").write_bytes(png)
    Path(folder, "map.pgw").write_text("1\n0\n0\n-1\n100.5\n-50.5\n", encoding="utf-8")

RESULTS = ["rows.parquet", "summary.json", "summary.txt"]


def results(folder: Path) -> list[bytes]:
    return [Path(folder, name).read_bytes() for name in RESULTS]


class OnACluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.root = Path(cls.folder.name)
        cls.plan = Path(cls.root, "plan.toml")
        cls.plan.write_text(PLAN, encoding="utf-8")
        cls.program = Program(os.environ["PILOTAGE"])
        words = [cls.program.path, "study", str(cls.plan), "--quiet", "--out", str(cls.root / "plain")]
        subprocess.run(words, check=True)
        cls.plain = results(cls.root / "plain")
        cls.cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
        cls.addClassCleanup(cls.cluster.close)

    def test_another_reader_finds_in_the_rows_what_the_summary_says_of_them(self):
        summary = json.loads(self.plain[1])
        rows = str(self.root / "plain" / "rows.parquet")
        for number, cell in enumerate(summary["cells"]):
            said = cell["measures"][0]["mean"]
            count, mean, deviation, vehicle = duckdb.execute(
                'select count("error-rms"), avg("error-rms"), stddev_samp("error-rms"), min(vehicle)'
                " from read_parquet(?) where cell = ?",
                [rows, number],
            ).fetchone()
            self.assertEqual((count, vehicle), (said["count"], cell["settings"]["vehicle"]))
            self.assertAlmostEqual(mean, said["mean"], delta=1e-9)
            self.assertAlmostEqual(deviation, said["deviation"], delta=1e-9)

    def test_a_worker_that_is_killed_in_the_middle_changes_nothing(self):
        out = self.root / "killed"
        victim = next(iter(self.cluster.workers.values())).pid
        was_killed = threading.Event()

        def tell(there, _):
            if there >= 3 and not was_killed.is_set():
                os.kill(victim, signal.SIGKILL)
                was_killed.set()

        with Client(self.cluster) as client:
            run_study(
                self.plan, out, client, program=self.program, runs_per_shard=RUNS_PER_SHARD, tell=tell
            )
        self.assertTrue(was_killed.is_set())
        self.assertEqual(results(out), self.plain)

    def test_a_plan_that_names_a_mission_is_sent_to_the_workers_with_the_mission_in_it(self):
        plan = Path(self.root, "route.toml")
        plan.write_text(ROUTE_PLAN, encoding="utf-8")
        mission = Path(__file__).parents[3] / "tests" / "flights" / "brighton" / "route.geojson"
        shutil.copy(mission, self.root / "survey.geojson")
        plain = self.root / "route-plain"
        words = [self.program.path, "study", str(plan), "--quiet", "--out", str(plain)]
        subprocess.run(words, check=True)
        out = self.root / "route"
        with Client(self.cluster) as client:
            run_study(plan, out, client, program=self.program, runs_per_shard=RUNS_PER_SHARD)
        self.assertEqual(results(out), results(plain))

    def test_work_on_a_map_is_shared_out_as_flights_are(self):
        write_map(self.root)
        plan = Path(self.root, "table.toml")
        plan.write_text('name = "table"\nwork = "reference-table"\nmap = "map.png"\n', encoding="utf-8")
        plain = self.root / "table-plain"
        words = [self.program.path, "study", str(plan), "--quiet", "--out", str(plain)]
        subprocess.run(words, check=True)
        out = self.root / "table"
        with Client(self.cluster) as client:
            said = run_study(plan, out, client, program=self.program)
        self.assertIn("landmarks of 16 tiles", said)
        self.assertEqual(len(list(Path(out, "shards").iterdir())), 4)
        self.assertEqual(*(Path(it, "landmarks.table").read_bytes() for it in (plain, out)))

    def test_a_worker_with_another_program_is_refused_by_name_and_nothing_of_it_is_kept(self):
        # A program that is of another version where it flies shards for a driver.
        odd = self.root / "odd"
        odd.write_text(
            f'#!/bin/sh\n"{self.program.path}" "$@" || exit $?\n'
            "case \"$*\" in *--only*) "
            "sed -i 's/\"program\": \"[^\"]*\"/\"program\": \"0.0.9\"/' \"$4/study.json\" ;; esac\n",
            encoding="utf-8",
        )
        odd.chmod(0o755)
        out = self.root / "mixed"
        with Client(self.cluster) as client, self.assertRaises(StudyFailure) as refused:
            run_study(self.plan, out, client, program=Program(str(odd)), runs_per_shard=RUNS_PER_SHARD)
        said = str(refused.exception)
        self.assertIn("program is 0.0.9 there and", said)
        self.assertTrue(any(worker in said for worker in self.cluster.scheduler_info["workers"]), said)
        self.assertEqual(list(Path(out, "shards").iterdir()), [])

    def test_shards_that_a_program_cannot_fly_are_named_with_the_worker_and_what_is_there_is_kept(self):
        # A program that breaks over the fifth shard, as one whose disk is full.
        odd = self.root / "breaks"
        odd.write_text(
            '#!/bin/sh\ncase "$*" in *"--only 4 "*) echo "no space left" >&2; exit 1 ;; esac\n'
            f'exec "{self.program.path}" "$@"\n',
            encoding="utf-8",
        )
        odd.chmod(0o755)
        out = self.root / "broken"
        words = ["run", str(self.plan), "--out", str(out), "--program", str(odd)]
        words += ["--runs-per-shard", str(RUNS_PER_SHARD), "--scheduler", self.cluster.scheduler_address]
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(main(words), 1)
        workers = "|".join(map(re.escape, self.cluster.scheduler_info["workers"]))
        blamed = f"pilotage_study: the worker ({workers}) could not do shard 4: no space left\n$"
        self.assertRegex(said.getvalue(), blamed)
        self.assertEqual([it for it in Path(out, "shards").iterdir() if it.name.startswith(".")], [])
        with Client(self.cluster) as client:
            run_study(self.plan, out, client, program=self.program, runs_per_shard=RUNS_PER_SHARD)
        self.assertEqual(results(out), self.plain)
        scratch = [Path(it["local_directory"]) for it in self.cluster.scheduler_info["workers"].values()]
        self.assertEqual([left for it in scratch for left in it.glob("pilotage-study-*")], [])

    def test_a_study_that_may_stop_ends_at_the_flight_at_which_the_plain_program_does(self):
        plan = Path(self.root, "stop.toml")
        rule = 'stop = { measure = "near", half_width = 0.45, every = 1 }\n'
        plan.write_text(PLAN + rule, encoding="utf-8")
        plain = self.root / "stop-plain"
        words = [self.program.path, "study", str(plan), "--quiet", "--out", str(plain)]
        subprocess.run(words, check=True)
        self.assertTrue(json.loads(results(plain)[1])["is_stopped"])
        # All shards are one task's, and the first are enough.
        out = self.root / "stop"
        with Client(self.cluster) as client:
            run_study(plan, out, client, program=self.program, runs_per_shard=1)
        self.assertEqual(results(out), results(plain))

    def test_a_driver_that_is_killed_in_the_middle_goes_on_when_it_is_started_again(self):
        out = self.root / "driver"
        words = [sys.executable, "-m", "pilotage_study", "run", str(self.plan), "--out", str(out)]
        words += ["--program", self.program.path, "--runs-per-shard", str(RUNS_PER_SHARD)]
        words += ["--scheduler", self.cluster.scheduler_address]

        def shards() -> list[Path]:
            return list(Path(out, "shards").glob("*.parquet"))

        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as driver:
            deadline = time.monotonic() + 300
            while len(shards()) < 2 and time.monotonic() < deadline:
                time.sleep(0.01)
            driver.kill()
        before = {shard: shard.stat().st_mtime_ns for shard in shards()}
        self.assertTrue(0 < len(before) < 12, before)
        again = subprocess.run(words, check=True, capture_output=True, text=True)
        self.assertEqual(again.stdout.encode(), self.plain[2])
        self.assertEqual(results(out), self.plain)
        after = {shard: shard.stat().st_mtime_ns for shard in before}
        self.assertEqual(after, before, "what was there was flown again")


if __name__ == "__main__":
    unittest.main()
