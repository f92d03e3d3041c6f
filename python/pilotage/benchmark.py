"""Prints how long logs take to be read, beside pyulog and pymavlink: all values of all fields, best of several runs.

`python benchmark.py FILE …`: any of `.ulg`, `.bin`, `.tlog`; without a file those of the shared data. `--make FOLDER` makes
larger ones of them there first: a telemetry log by pymavlink, and the dataflash log again and again.
"""

import argparse
import contextlib
import io
import os
import struct
import time
from pathlib import Path

os.environ["MAVLINK20"] = "1"

import numpy as np  # noqa: E402
import pilotage  # noqa: E402

SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"
FILES = ["px4_ulog/sample.ulg", "px4_ulog/sample-small.ulg", "px4_ulog/sample_log_small.ulg"]
FILES += ["ardupilot_bin/test.BIN"]


def best(read, path, runs):
    """Least seconds of `runs`, and the values that were read."""
    least, values = float("inf"), 0
    for _ in range(runs):
        begun = time.perf_counter()
        with contextlib.redirect_stdout(io.StringIO()):
            values = read(str(path))
        least = min(least, time.perf_counter() - begun)
    return least, values


def ours(path):
    topics = pilotage.read_log(path).arrays().values()
    return sum(len(topic["times"]) * (len(topic) - 1) for topic in topics)


def pyulog(path):
    from pyulog import ULog

    topics = ULog(path).data_list
    return sum(len(values) for topic in topics for values in topic.data.values())


def pymavlink(path):
    """Arrays of all fields, gathered from the messages: pymavlink hands out one after the other."""
    from pymavlink import mavutil

    log = mavutil.mavlink_connection(path)
    rows = {}
    while (message := log.recv_msg()) is not None:
        names = message.get_fieldnames()
        values = [getattr(message, name) for name in names]
        rows.setdefault(message.get_type(), []).append((message._timestamp, *values))
    columns = [list(zip(*of_kind, strict=True)) for of_kind in rows.values()]
    arrays = [np.array(c) if isinstance(c[0], int | float) else c for cs in columns for c in cs]
    return sum(len(array) for array in arrays)


def make(folder):
    """Larger logs of what is there: a telemetry log, and a dataflash log of the rows of the recorded one."""
    from pymavlink.dialects.v20 import ardupilotmega as mavlink

    sender = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    made = [folder / "made.tlog", folder / "made.bin"]
    with made[0].open("wb") as file:
        for i in range(40_000):
            angle = 0.001 * i
            messages = [
                mavlink.MAVLink_attitude_message(20 * i, angle, -angle, 1.0, 0.1, 0.2, 0.3),
                mavlink.MAVLink_raw_imu_message(20_000 * i, 1, 2, 3, 4, 5, 6, 7, 8, 9),
            ]
            for message in messages:
                file.write(struct.pack(">Q", 1_650_000_000_000_000 + 20_000 * i))
                file.write(message.pack(sender))
    recorded = (SHARED / FILES[-1]).read_bytes()
    made[1].write_bytes(recorded * 64)
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--make", type=Path, metavar="FOLDER")
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    files = arguments.files or [SHARED / name for name in FILES]
    if arguments.make:
        files += make(arguments.make)
    print("| log | MB | values | ours, ms | MB/s | other, ms | ratio |")
    print("|---|---|---|---|---|---|---|")
    for path in files:
        other = pyulog if path.suffix == ".ulg" else pymavlink
        least, values = best(ours, path, arguments.runs)
        theirs, their_values = best(other, path, max(1, arguments.runs // 2))
        size = path.stat().st_size / 1e6
        print(
            f"| {path.name} | {size:.2f} | {values:,} | {1e3 * least:.1f} | {size / least:.0f} | "
            f"{other.__name__} {1e3 * theirs:.1f} ({their_values:,} values) | {theirs / least:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
