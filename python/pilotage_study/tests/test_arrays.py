"""Job arrays share the shards out completely."""

import subprocess
import tempfile
import unittest
from pathlib import Path

from pilotage_study import kubernetes, slurm

PLAN, OUT = Path("my plan.toml"), Path("out")


class Arrays(unittest.TestCase):
    def test_a_script_for_slurm_starts_every_share_with_its_number_and_merges_after_it(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder, "log")
            # A stand-in for sbatch that runs what it is told to wrap, for every task.
            sbatch = Path(folder, "sbatch")
            sbatch.write_text(
                "#!/bin/sh\n"
                'for word in "$@"; do case $word in\n'
                "  --array=0-*) last=${word#--array=0-} ;;\n"
                "  --wrap=*) wrap=${word#--wrap=} ;;\n"
                "esac; done\n"
                'for SLURM_ARRAY_TASK_ID in $(seq 0 "${last:-0}"); do eval "$wrap"; done >&2\n'
                "echo 17\n"
            )
            pilotage = Path(folder, "pilotage")
            pilotage.write_text(f'#!/bin/sh\nprintf "%s|" "$@" >> {log}; echo >> {log}\n')
            for file in [sbatch, pilotage]:
                file.chmod(0o755)
            script = slurm(PLAN, OUT, 3)
            path = f"{folder}:/usr/bin:/bin"
            subprocess.run(["sh", "-c", script], check=True, env={"PATH": path}, capture_output=True)
            lines = log.read_text().splitlines()
        common = "study|my plan.toml|--out|out|--runs-per-shard|200|"
        shares = [f"{common}--quiet|--threads|1|--shares|3|--share|{index}|" for index in range(3)]
        self.assertEqual(lines, [*shares, f"{common}--merge|"])

    def test_a_manifest_for_kubernetes_has_as_many_completions_as_shares(self):
        text = kubernetes(PLAN, OUT, 40, image="pilotage:1", claim="disk")
        self.assertIn("completions: 40\n", text)
        self.assertIn("completionMode: Indexed\n", text)
        command = "'/study/my plan.toml' --out /study/out --runs-per-shard 200 --quiet --threads 1 --shares 40"
        self.assertIn(f'"pilotage study {command} --share $JOB_COMPLETION_INDEX"', text)


if __name__ == "__main__":
    unittest.main()
