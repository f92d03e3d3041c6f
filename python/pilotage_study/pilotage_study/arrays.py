"""Job arrays, as texts that other programs take. Nothing is started here."""

from __future__ import annotations

import shlex
from pathlib import Path


def _words(program: str, plan: Path, out: Path, runs_per_shard: int) -> list[str]:
    return [program, "study", str(plan), "--out", str(out), "--runs-per-shard", str(runs_per_shard)]


def slurm(plan: Path, out: Path, tasks: int, *, program: str = "pilotage", runs_per_shard: int = 200) -> str:
    """A script for a shell: a job array of `tasks` on a folder that all share, and the merging after it."""
    words = _words(program, plan, out, runs_per_shard)
    share = shlex.join([*words, "--quiet", "--threads", "1", "--shares", str(tasks)])
    merge = shlex.join([*words, "--merge"])
    return "\n".join(
        [
            "#!/bin/sh",
            "# Run again after a failure: what is there already is not flown again.",
            "set -eu",
            f"array=$(sbatch --parsable --requeue --cpus-per-task=1 --array=0-{tasks - 1} \\",
            f"  --wrap={shlex.quote(share + ' --share $SLURM_ARRAY_TASK_ID')})",
            f"sbatch --dependency=afterok:$array --wrap={shlex.quote(merge)}",
            "",
        ]
    )


def kubernetes(
    plan: Path,
    out: Path,
    tasks: int,
    *,
    image: str,
    claim: str,
    program: str = "pilotage",
    runs_per_shard: int = 200,
    name: str = "study",
) -> str:
    """A manifest of an indexed job of `tasks`; plan and folder lie on the volume of `claim`, below /study."""
    words = _words(program, Path("/study", plan.name), Path("/study", out.name), runs_per_shard)
    share = shlex.join([*words, "--quiet", "--threads", "1", "--shares", str(tasks)])
    command = share + " --share $JOB_COMPLETION_INDEX"
    merge = shlex.join([*words, "--merge"])
    return f"""\
# kubectl apply -f FILE; when it is complete, in a pod with the same volume: {merge}
apiVersion: batch/v1
kind: Job
metadata:
  name: {name}
spec:
  completionMode: Indexed
  completions: {tasks}
  parallelism: {tasks}
  backoffLimitPerIndex: 5
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: share
          image: {image}
          command: ["sh", "-c", {_quoted(command)}]
          resources:
            requests: {{cpu: "1", memory: 300Mi}}
          volumeMounts:
            - {{name: study, mountPath: /study}}
      volumes:
        - name: study
          persistentVolumeClaim: {{claimName: {claim}}}
"""


def _quoted(text: str) -> str:
    """The text as YAML has it between double quotes."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
