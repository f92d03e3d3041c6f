"""Studies of Pilotage on a Dask cluster, and as job arrays."""

from .arrays import kubernetes, slurm
from .cluster import run_study
from .program import Description, Program, StudyFailure

__all__ = ["Description", "Program", "StudyFailure", "kubernetes", "run_study", "slurm"]
