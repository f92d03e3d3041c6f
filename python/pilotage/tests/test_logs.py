"""Logs beside the readers of other programs, to the bit."""

import contextlib
import io
import math
import os
import struct

import numpy as np
import pilotage
import pytest

ULOGS = ["px4_ulog/sample.ulg", "px4_ulog/sample-small.ulg", "px4_ulog/sample_log_small.ulg"]


@pytest.mark.parametrize("name", ULOGS)
def test_every_field_of_a_ulog_is_what_pyulog_reads(shared, name):
    pyulog = pytest.importorskip("pyulog")
    path = shared(name)
    log = pilotage.read_log(path)
    with contextlib.redirect_stdout(io.StringIO()):
        theirs = pyulog.ULog(str(path))
    assert log.format == "PX4 ULog"
    compared = named = 0
    for data in theirs.data_list:
        stamps = data.data["timestamp"]
        if len(stamps) == 0:
            continue  # announced, and never logged: no topic of ours
        told = f"{data.name}[{data.multi_id}] {len(stamps)} "
        if told in str(log.report):
            continue  # its only rows have times far from all others: left out, and said so
        named += 1
        topic = topic_of(log, data.name, data.multi_id)
        np.testing.assert_array_equal(topic.times, stamps.astype(np.float64) / 1e6)
        for field, values in data.data.items():
            if "_padding" in field:
                continue  # bytes between the fields of a struct, not one of them
            ours = topic[field]
            assert isinstance(ours, np.ndarray), (data.name, field)
            if ours.dtype == np.float64 and values.dtype.kind in "iu":
                scale = 1e7 if field in ("lat", "lon") else 1e3
                np.testing.assert_array_equal(np.rint(ours * scale), values, (data.name, field))
            else:
                # pyulog hands a flag over as a small number.
                flag = ours.dtype == bool and values.dtype == np.int8
                assert flag or ours.dtype == values.dtype, (data.name, field)
                assert ours.tobytes() == values.tobytes(), (data.name, field)
            compared += 1
    assert compared > 100
    assert len(log) == named
    for parameter, value in theirs.initial_parameters.items():
        changed = [v for _, n, v in theirs.changed_parameters if n == parameter]
        assert log.parameters[parameter] == (changed or [value])[-1]
    assert [text for _, text in log.messages] == [m.message for m in theirs.logged_messages]


def topic_of(log, name, instance):
    found = [t for t in log.topics if t.name.split("[")[0] == name and (t.instance or 0) == instance]
    assert len(found) == 1, (name, instance, log.keys())
    return found[0]


def test_every_field_of_a_dataflash_log_is_what_pymavlink_reads(shared):
    reader = pytest.importorskip("pymavlink.DFReader")
    path = shared("ardupilot_bin/test.BIN")
    log = pilotage.read_log(path)
    rows = {}
    with contextlib.redirect_stdout(io.StringIO()):
        theirs = reader.DFReader_binary(str(path), zero_time_base=True)
        while (message := theirs.recv_msg()) is not None:
            rows.setdefault(message.get_type(), []).append(message)
    compared = 0
    for kind, messages in rows.items():
        # What describes the log is no topic of it.
        if kind not in log:
            assert kind in ("FMT", "PARM"), kind
            continue
        topic = log[kind]
        assert len(topic) == len(messages), kind
        for field in topic.fields:
            values = [getattr(message, field.name) for message in messages]
            ours = topic[field.name]
            if field.kind == "str":
                assert ours == values, (kind, field.name)
            elif field.kind != "bytes":
                theirs_as = np.array(values, dtype=np.float64)
                # Hundredths are divided here and multiplied there: the last digit may differ.
                np.testing.assert_allclose(np.asarray(ours, np.float64), theirs_as, rtol=5e-16)
            compared += len(values)
    assert compared > 1000
    assert len(log.parameters) > 100
    assert log.parameters == dict(theirs.params)


def test_a_telemetry_log_is_what_pymavlink_wrote(tmp_path):
    os.environ.setdefault("MAVLINK20", "1")
    mavlink = pytest.importorskip("pymavlink.dialects.v20.all")
    sender = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    path = tmp_path / "flight.tlog"
    start, rolls = 1_650_000_000, [0.25, -0.5, 1.0]
    with path.open("wb") as file:
        for i, roll in enumerate(rolls):
            message = mavlink.MAVLink_attitude_message(1000 * i, roll, 0.5, 2.0, 0.1, 0.2, 0.3)
            stamp = struct.pack(">Q", 1_000_000 * start + 200_000 * i)
            file.write(stamp + message.pack(sender))
    log = pilotage.read_log(path)
    attitude = log["ATTITUDE"]
    np.testing.assert_allclose(np.diff(attitude.times), 0.2, atol=1e-6)
    assert attitude["roll"].dtype == np.float32
    np.testing.assert_array_equal(attitude["roll"], np.array(rolls, np.float32))
    np.testing.assert_array_equal(attitude["time_boot_ms"], [0, 1000, 2000])


def test_a_log_of_text_has_its_topics_times_texts_and_report(tmp_path):
    path = tmp_path / "flight.log"
    path.write_text(
        "FMT, 1, 13, ATT, Qcc, TimeUS,Roll,Yaw\n"
        "FMT, 2, 13, MSG, QZ, TimeUS,Message\n"
        "ATT, 1000000, 1.5, 90.0\n"
        "MSG, 1200000, hello\n"
        "ATT, 1500000, -2.25, 91.0\n"
    )
    log = pilotage.read_log(path)
    assert log.format == "ArduPilot dataflash, text"
    attitude = log["ATT"]
    assert len(attitude) == 2 and "Roll" in attitude and "Colour" not in attitude
    np.testing.assert_array_equal(attitude.times, [1.0, 1.5])
    np.testing.assert_array_equal(attitude["Roll"], [1.5, -2.25])
    all_arrays = log.arrays()
    np.testing.assert_array_equal(all_arrays["ATT"]["Yaw"], [90.0, 91.0])
    np.testing.assert_array_equal(all_arrays["ATT"]["times"], [1.0, 1.5])
    assert log.messages == [(1.2, "hello")]
    assert log.span == (1.0, 1.5)
    assert log.report["bytes"] == path.stat().st_size


def test_arrays_belong_to_whoever_asked_for_them(tmp_path):
    path = tmp_path / "flight.log"
    path.write_text("FMT, 1, 13, ATT, Qcc, TimeUS,Roll,Yaw\nATT, 1000000, 1.5, 90.0\n")
    topic = pilotage.read_log(path)["ATT"]
    roll = topic["Roll"]
    # The memory of the library is handed over, not copied: NumPy does not own it, and it can be written.
    assert not roll.flags.owndata and roll.flags.writeable and roll.flags.c_contiguous
    roll[0] = 7.0
    assert topic["Roll"][0] == 1.5


def test_tables_are_read_as_topics_and_as_a_flight(tmp_path):
    path = tmp_path / "flight.csv"
    lines = ["time_s,airspeed_mps,heading_deg,gps_north_m,gps_east_m"]
    lines += [f"{0.5 * i},{20 + 0.1 * i},{90},{0},{10 * i}" for i in range(40)]
    path.write_text("\n".join(lines) + "\n")
    log = pilotage.read_log(path)
    (topic,) = log.topics
    np.testing.assert_array_equal(topic["airspeed_mps"], [float(f"{20 + 0.1 * i}") for i in range(40)])
    flight = pilotage.read_flight(path)
    times, heading = flight.channels["heading"]
    assert len(times) == 40 and flight.units["heading"] == "rad"
    np.testing.assert_allclose(heading, math.pi / 2, rtol=1e-15)


def test_refusals_name_the_file_and_what_is_there(tmp_path):
    letter = tmp_path / "letter.bin"
    letter.write_text("Dear engineer, this is no log.\n")
    with pytest.raises(pilotage.PilotageError, match="letter.bin"):
        pilotage.read_log(letter)
    with pytest.raises(pilotage.PilotageError, match="nowhere.ulg"):
        pilotage.read_log(tmp_path / "nowhere.ulg")
    path = tmp_path / "flight.log"
    path.write_text("FMT, 1, 13, ATT, Qcc, TimeUS,Roll,Yaw\nATT, 1000000, 1.5, 90.0\n")
    log = pilotage.read_log(path)
    with pytest.raises(KeyError, match="flight.log.*no topic.*GPS.*ATT"):
        log["GPS"]
    with pytest.raises(KeyError, match="flight.log.*no field.*Rolls.*Roll, Yaw"):
        log["ATT"]["Rolls"]
