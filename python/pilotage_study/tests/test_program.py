"""What comes back from a worker is kept where it is of the same study, and refused where it is not."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from pilotage_study import StudyFailure
from pilotage_study.__main__ import main
from pilotage_study.program import FlownShards, folder_of, keep

BEGUN = {
    "program": "0.2.0",
    "plan": {"name": "county", "measure": [{"of": "error-rms"}]},
    "files": [{"name": "map.pgw", "bytes": 30, "crc32": 7}, {"name": "map.png", "bytes": 900, "crc32": 8}],
}


class FromWorkers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)
        Path(self.out, "shards").mkdir()
        Path(self.out, "study.json").write_text(json.dumps(BEGUN, indent=2), encoding="utf-8")

    def _kept(self) -> dict[str, bytes]:
        return {file.name: file.read_bytes() for file in Path(self.out, "shards").iterdir()}

    def test_shards_of_another_map_or_program_are_refused_with_the_worker_and_what_differs(self):
        other_map = json.loads(json.dumps(BEGUN))
        other_map["files"][0]["crc32"] = 9
        other_plan = {**BEGUN, "plan": {"name": "county", "measure": [{"of": "error-max"}]}}
        for begun, words in [
            (other_map, "files.map.pgw.crc32 is 9 there and 7 here"),
            ({**BEGUN, "program": "0.1.0"}, "program is 0.1.0 there and 0.2.0 here"),
            (other_plan, "plan.measure.0.of is error-max there and error-rms here"),
            ({**BEGUN, "files": []}, "files.map.pgw.name is missing there and map.pgw here"),
        ]:
            flown = FlownShards(json.dumps(begun), {"000000.piece": b"other"})
            with self.assertRaises(StudyFailure) as refused:
                keep(self.out, flown, "tcp://node7:4001")
            self.assertIn(words, str(refused.exception))
            self.assertIn("tcp://node7:4001", str(refused.exception))
            self.assertEqual(self._kept(), {})
        keep(self.out, FlownShards(json.dumps(BEGUN), {"000000.piece": b"own"}), "tcp://node7:4001")
        self.assertEqual(self._kept(), {"000000.piece": b"own"})

    def test_a_shard_that_cannot_be_written_leaves_nothing_behind(self):
        # A folder is in the place of the file.
        Path(self.out, "shards", "000001.piece").mkdir()
        flown = FlownShards(json.dumps(BEGUN), {"000001.piece": b"own"})
        with self.assertRaises(OSError):
            keep(self.out, flown, "tcp://node7:4001")
        self.assertEqual([it.name for it in Path(self.out, "shards").iterdir()], ["000001.piece"])

    def test_the_folder_is_called_by_the_name_of_the_plan_as_the_program_calls_it(self):
        plan = Path(self.out, "second-try.toml")
        plan.write_text('name = "county"\nwork = "reference-table"\n', encoding="utf-8")
        self.assertEqual(folder_of(plan), Path("county.study"))
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(main(["slurm", str(plan), "--tasks", "2"]), 0)
        self.assertIn("--out county.study ", said.getvalue())
        with self.assertRaisesRegex(StudyFailure, "give --out"):
            folder_of(Path(self.out, "none.toml"))


if __name__ == "__main__":
    unittest.main()
