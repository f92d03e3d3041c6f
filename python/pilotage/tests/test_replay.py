"""The navigator and predicted routes, beside the program of the terminal."""

import _thread
import functools
import json
import signal
import subprocess
import threading
import time

import numpy as np
import pilotage
import pytest

# 64-bit floats of both are compared as they are stored: to the bit.
ARRAYS = [
    "times",
    "mean",
    "covariance",
    "predicted_mean",
    "predicted_covariance",
    "dead_reckoned",
    "nis",
    "degrees_of_freedom",
    "landmarks_used",
]


def call(program, folder, *words):
    done = subprocess.run(
        [program, *words], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def flown(program, tmp_path_factory):
    """A short flight over a map of 600 m with patches of all sizes, and what `pilotage replay` makes of it."""
    cv2 = pytest.importorskip("cv2")
    folder = tmp_path_factory.mktemp("flown")
    random = np.random.default_rng(5)
    picture = np.zeros((1200, 1200, 3), np.float32)
    for size in (6, 12, 40, 120, 400):
        coarse = random.normal(size=(size, size, 3)).astype(np.float32)
        picture += cv2.resize(coarse, (1200, 1200), interpolation=cv2.INTER_CUBIC)
    cv2.imwrite(str(folder / "map.png"), (110 + 22 * picture).clip(0, 255).astype(np.uint8))
    (folder / "map.pgw").write_text("0.5\n0\n0\n-0.5\n400000.25\n5200599.75\n")
    (folder / "map.prj").write_text('PROJCS["WGS_1984_UTM_Zone_32N",GEOGCS["GCS_WGS_1984",')
    # From the middle of the south to that of the north, by the series of Krüger (1912).
    route = "46.947113,7.689884;46.950352,7.689805"
    words = ["simulate", "--map", "map.png", "--out", "flight", "--route", route]
    call(program, folder, *words, "--height", "120", "--day", "same")
    words = ["replay", "flight", "--map", "map.png", "--out", "terminal.run"]
    printed = call(program, folder, *words, "--filter", "alpha=0.5")
    return folder, json.loads(printed)


def assert_equal_to_the_bit(ours, theirs):
    assert len(ours) == len(theirs) > 10
    assert ours.state_names == theirs.state_names
    for name in ARRAYS:
        a, b = getattr(ours, name), getattr(theirs, name)
        assert a.dtype == b.dtype and a.shape == b.shape, name
        assert a.tobytes() == b.tobytes(), name


def test_positions_are_those_of_the_terminal_to_the_bit(flown):
    folder, printed = flown
    ours = pilotage.replay(folder / "flight", folder / "map.png", filter="alpha=0.5")
    theirs = pilotage.read_run(folder / "terminal.run")
    assert_equal_to_the_bit(ours, theirs)
    timed = ("timing", "_ms", "ms_")
    plain = {k: v for k, v in ours.summary.items() if not any(t in k for t in timed)}
    assert plain == {k: v for k, v in printed.items() if not any(t in k for t in timed)}
    assert ours.settings["alpha"] == 0.5
    # Pictures corrected it, and what it believes is a covariance.
    assert np.isfinite(ours.nis).any()
    assert np.linalg.eigvalsh(ours.covariance).min() > 0
    assert [name for name, _ in ours.state_names[:2]] == ["north", "east"]


def test_a_run_survives_its_file(flown, tmp_path):
    folder, _ = flown
    theirs = pilotage.read_run(folder / "terminal.run")
    theirs.save(tmp_path / "again.run")
    assert (tmp_path / "again.run").read_bytes() == (folder / "terminal.run").read_bytes()
    assert_equal_to_the_bit(pilotage.read_run(tmp_path / "again.run"), theirs)


def test_the_flight_is_there_as_arrays(flown):
    folder, _ = flown
    flight = pilotage.read_flight(folder / "flight")
    run = pilotage.read_run(folder / "terminal.run")
    times, airspeed = flight.channels["airspeed"]
    assert times.shape == airspeed.shape and 10 < airspeed.mean() < 30
    assert len(flight.frame_times) == len(flight.frame_names) > 5
    truth = flight.truth
    north, east = (np.interp(run.times, truth[:, 0], truth[:, i]) for i in (1, 2))
    error = np.hypot(run.mean[:, 0] - north, run.mean[:, 1] - east)
    assert np.sqrt((error**2).mean()) < 15.0


def test_refusals_name_the_file(flown):
    folder, _ = flown
    with pytest.raises(pilotage.PilotageError, match="nowhere.png"):
        pilotage.replay(folder / "flight", folder / "nowhere.png")
    with pytest.raises(pilotage.PilotageError, match="alhpa"):
        pilotage.replay(folder / "flight", folder / "map.png", filter="alhpa=1")
    with pytest.raises(pilotage.PilotageError, match="map.png"):
        pilotage.read_run(folder / "map.png")
    with pytest.raises(pilotage.PilotageError, match="no scenario.*distinct-400ft-wind"):
        pilotage.replay_scenario("nowhere")


def test_a_predicted_corridor_widens_without_landmarks():
    def predict(*detection):
        return pilotage.predict_route(
            scenario="distinct-400ft-wind", detection=detection, worlds=8, limit=10.0
        )

    stated, blind = predict(0.8, 0.7), predict(0.0, 0.0)
    assert len(stated) == len(blind) and len(stated.landmarks) == 10
    assert stated.detection.shape == (len(stated), 10)
    assert blind.sigma_major[-1] > 3 * stated.sigma_major[-1]
    assert max(stretch["sigma"] for stretch in blind.over_limit) == blind.sigma_major.max()
    # The axes are those of the covariance.
    values = np.linalg.eigvalsh(stated.covariance)
    np.testing.assert_allclose(np.sqrt(values[:, 1]), stated.sigma_major, rtol=1e-9)
    np.testing.assert_allclose(np.sqrt(values[:, 0]), stated.sigma_minor, rtol=1e-9)
    with pytest.raises(pilotage.PilotageError, match="nowhere.zip"):
        pilotage.predict_route("nowhere.zip")


def in_hall():
    return pilotage.replay_scenario("indoor-hall")


def predicted():
    # Its landmarks are measured over the map first; then 400 worlds are tried.
    return pilotage.predict_route(scenario="distinct-1000ft-extended", worlds=400)


def correlated():
    random = np.random.default_rng(3)
    picture = random.normal(size=(3000, 3000)).astype(np.float32)
    return pilotage.correlate(picture, picture[100:700, 200:800])


def many_worlds():
    return pilotage.predict_route(
        scenario="distinct-400ft-wind", detection=(0.8, 0.7), worlds=2000
    )


@functools.cache
def whole(work):
    """What comes of `work` if nobody interrupts it, and the seconds that it takes and costs the processor."""
    begun, spent = time.monotonic(), time.process_time()
    result = work()
    return result, time.monotonic() - begun, time.process_time() - spent


@pytest.fixture
def heeds_interrupts():
    """Has Python hear of interrupts as at a terminal; what is started in the background ignores them."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heeds_interrupts")
@pytest.mark.parametrize(
    "work",
    [in_hall, predicted, many_worlds, correlated],
    ids=["replay", "landmarks", "worlds", "correlation"],
)
def test_whatever_takes_long_can_be_interrupted(work):
    # As Ctrl+C does, or a notebook that interrupts its kernel.
    result, takes, costs = whole(work)
    assert takes > 0.3, "too short to be interrupted"
    timer = threading.Timer(takes / 4, _thread.interrupt_main)
    timer.start()
    begun, spent = time.monotonic(), time.process_time()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert time.monotonic() - begun < 0.75 * takes + 0.1
    timer.join()
    # Work that was told to stop is not done behind it, however busy the machine is.
    time.sleep(takes)
    assert work is correlated or time.process_time() - spent < 0.75 * costs
    assert len(work()) == len(result)


def test_scenarios_of_every_world_can_be_flown():
    names = pilotage.scenario_names()
    assert "indoor-hall" in names and "distinct-400ft-wind" in names
    run, _, _ = whole(in_hall)
    assert run.summary["position_error_m"]["rms"] < 0.3
