"""The filter and the vehicle models by themselves, beside FilterPy and what can be computed by hand."""

import numpy as np
import pilotage
import pytest


def range_and_bearing(state, landmark):
    north, east = landmark[0] - state[0], landmark[1] - state[1]
    return np.array([np.hypot(north, east), np.arctan2(east, north) - state[2]])


def drive(state, dt=0.1, speed=15.0, rate=0.12):
    step = [speed * dt * np.cos(state[2]), speed * dt * np.sin(state[2]), rate * dt]
    return np.asarray(state) + step


LANDMARKS = [(120.0, 40.0), (-60.0, 150.0), (200.0, -80.0)]


@pytest.mark.parametrize("alpha, beta, kappa", [(0.5, 2.0, 0.0), (1.0, 0.0, 0.0), (0.1, 2.0, 1.0)])
def test_the_filter_equals_filterpy_to_1e_9(alpha, beta, kappa):
    kalman = pytest.importorskip("filterpy.kalman")
    mean, covariance = np.array([1.0, -2.0, 0.1]), np.diag([4.0, 4.0, 0.05])
    process_noise, noise = np.diag([0.01, 0.01, 1e-4]), np.diag([4.0, 0.0025])

    points = kalman.MerweScaledSigmaPoints(3, alpha, beta, kappa)
    theirs = kalman.UnscentedKalmanFilter(
        3, 2, 0.1, hx=range_and_bearing, fx=lambda x, dt: drive(x, dt), points=points
    )
    theirs.x, theirs.P = mean.copy(), covariance.copy()
    theirs.Q, theirs.R = process_noise, noise
    ours = pilotage.Ukf(mean, covariance, alpha=alpha, beta=beta, kappa=kappa)
    truth = mean.copy()
    random = np.random.default_rng(7)
    for step in range(200):
        truth = drive(truth)
        landmark = LANDMARKS[step % 3]
        measured = range_and_bearing(truth, landmark) + random.normal(size=2) * [2.0, 0.05]
        ours.predict(drive, process_noise)
        theirs.predict()
        correction = ours.correct(measured, lambda x: range_and_bearing(x, landmark), noise)
        theirs.update(measured, landmark=landmark)
        nis = float(theirs.y @ theirs.SI @ theirs.y)
        np.testing.assert_allclose(ours.mean, theirs.x, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(ours.covariance, theirs.P, rtol=1e-9, atol=1e-9)
        assert correction.nis == pytest.approx(nis, rel=1e-9, abs=1e-9)
        np.testing.assert_allclose(correction.gain, theirs.K, rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(correction.innovation_covariance, theirs.S, rtol=1e-9)


def test_stored_steps_of_filterpy_are_reproduced(shared):
    import json

    stored = json.loads(shared("kalman_golden/filterpy_ukf_vectors.json").read_text())
    ours = pilotage.Ukf(stored["rb_x0"], np.diag(stored["rb_P0"]), alpha=0.5)
    for step in stored["rb_steps"]:
        ours.predict(drive, np.diag(stored["rb_Q"]))
        if step.get("z") is not None:
            landmark = stored["landmarks"][step["lm"]]
            wrapped = np.array(step["z"])
            expected = range_and_bearing(ours.mean, landmark)[1]
            wrapped[1] += 2 * np.pi * np.round((expected - wrapped[1]) / (2 * np.pi))
            ours.correct(wrapped, lambda x: continuous(x, landmark, expected), np.diag(stored["rb_R"]))
        np.testing.assert_allclose(ours.mean, step["x"], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(ours.covariance, step["P"], rtol=1e-9, atol=1e-9)


def continuous(state, landmark, near):
    """Range and bearing without a jump about `near`."""
    seen = range_and_bearing(state, landmark)
    seen[1] += 2 * np.pi * np.round((near - seen[1]) / (2 * np.pi))
    return seen


@pytest.mark.parametrize("size", range(1, 13))
def test_a_linear_step_of_any_size_is_kalmans(size):
    random = np.random.default_rng(size)
    root = random.normal(size=(size, size))
    mean, covariance = random.normal(size=size), root @ root.T + np.eye(size)
    transition, process_noise = random.normal(size=(size, size)), 0.1 * np.eye(size)
    seen, noise, measured = random.normal(size=(2, size)), np.diag([0.5, 2.0]), np.array([1.0, -1.0])
    ukf = pilotage.Ukf(mean, covariance)
    ukf.predict(transition, process_noise)
    mean, covariance = transition @ mean, transition @ covariance @ transition.T + process_noise
    np.testing.assert_allclose(ukf.mean, mean, atol=1e-9)
    np.testing.assert_allclose(ukf.covariance, covariance, rtol=1e-9, atol=1e-9)
    correction = ukf.correct(measured, seen, noise)
    innovation = measured - seen @ mean
    of_innovation = seen @ covariance @ seen.T + noise
    gain = covariance @ seen.T @ np.linalg.inv(of_innovation)
    np.testing.assert_allclose(correction.innovation, innovation, atol=1e-9)
    np.testing.assert_allclose(correction.gain, gain, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(ukf.mean, mean + gain @ innovation, atol=1e-8)
    np.testing.assert_allclose(ukf.covariance, covariance - gain @ of_innovation @ gain.T, atol=1e-8)
    assert ukf.sigma_points.shape == (2 * size + 1, size)


def test_the_gate_leaves_the_belief_as_it_is():
    ukf = pilotage.Ukf([0.0], [[1.0]])
    far = ukf.correct([10.0], [[1.0]], [[1.0]], gate=0.99)
    assert not far.accepted and far.gain is None and far.nis == pytest.approx(50.0)
    assert far.limit == pytest.approx(6.6349, abs=1e-4)  # printed tables of chi-square
    assert ukf.mean[0] == 0.0 and ukf.covariance[0, 0] == pytest.approx(1.0)
    assert ukf.correct([1.0], [[1.0]], [[1.0]], gate=0.99).accepted
    with pytest.raises(pilotage.FilterError, match="probability"):
        ukf.correct([1.0], [[1.0]], [[1.0]], gate=1.5)


def test_what_a_model_raises_comes_out_and_the_filter_stays_as_it_was():
    ukf = pilotage.Ukf([1.0, 2.0], np.eye(2))

    def broken(_state):
        raise RuntimeError("no answer today")

    with pytest.raises(RuntimeError, match="no answer today"):
        ukf.predict(broken, np.eye(2))
    with pytest.raises(RuntimeError, match="no answer today"):
        ukf.correct([1.0], broken, [[1.0]])
    with pytest.raises(pilotage.PilotageError, match="process has 3 components where 2"):
        ukf.predict(lambda state: [1.0, 2.0, 3.0], np.eye(2))
    np.testing.assert_array_equal(ukf.mean, [1.0, 2.0])
    np.testing.assert_array_equal(ukf.covariance, np.eye(2))


def test_refusals_say_what_was_given_and_what_was_expected():
    with pytest.raises(pilotage.PilotageError, match="covariance is 3 × 3 where 2 × 2"):
        pilotage.Ukf([0.0, 0.0], np.eye(3))
    with pytest.raises(pilotage.FilterError, match="13 components; give 1 to 12"):
        pilotage.Ukf(np.zeros(13), np.eye(13))
    with pytest.raises(pilotage.FilterError, match="not a covariance"):
        pilotage.Ukf([0.0, 0.0], -np.eye(2))
    with pytest.raises(pilotage.FilterError, match="the filter has 2 components where airplane-wind has 4"):
        pilotage.Ukf([0.0, 0.0], np.eye(2)).predict_vehicle(
            pilotage.Vehicle(), pilotage.Controls(airspeed=20.0), 1.0
        )


def test_an_airplane_flies_its_airspeed_along_its_heading_in_the_wind():
    vehicle = pilotage.Vehicle("airplane-wind")
    assert [name for name, _ in vehicle.state_names] == ["north", "east", "wind north", "wind east"]
    east = pilotage.Controls(airspeed=20.0, heading=np.pi / 2)
    states = np.array([[0.0, 0.0, 5.0, 0.0], [10.0, 0.0, 0.0, -5.0]])
    moved = vehicle.propagate(states, east, 10.0)
    np.testing.assert_allclose(moved, [[50, 200, 5, 0], [10, 150, 0, -5]], atol=1e-9)
    slope = vehicle.transition(states[0], east, 10.0)
    np.testing.assert_allclose(slope, np.eye(4) + 10 * np.eye(4, k=2), atol=1e-9)


@pytest.mark.parametrize("model", pilotage.vehicle_models())
def test_a_filter_moves_as_each_vehicle_does(model):
    vehicle = pilotage.Vehicle(model)
    controls = pilotage.Controls(airspeed=18.0, heading=0.7, roll=0.05, ground_velocity=(10.0, 3.0))
    mean, covariance = vehicle.prior(100.0, -50.0, deviation=4.0)
    assert mean[:2].tolist() == [100.0, -50.0] and covariance[0, 0] == pytest.approx(16.0)
    by_model, by_hand = pilotage.Ukf(mean, covariance), pilotage.Ukf(mean, covariance)
    by_model.predict_vehicle(vehicle, controls, 0.5)
    noise = by_model.covariance - noiseless(vehicle, controls, mean, covariance)
    by_hand.predict(lambda x: vehicle.propagate([x], controls, 0.5)[0], np.zeros_like(covariance))
    np.testing.assert_allclose(by_model.mean, by_hand.mean, rtol=1e-12, atol=1e-12)
    assert np.linalg.eigvalsh((noise + noise.T) / 2).min() > -1e-9
    stated = vehicle.process_noise(mean, controls, 0.5)
    np.testing.assert_allclose(stated, stated.T)


def noiseless(vehicle, controls, mean, covariance):
    ukf = pilotage.Ukf(mean, covariance)
    ukf.predict(lambda x: vehicle.propagate([x], controls, 0.5)[0], np.zeros_like(covariance))
    return ukf.covariance


def test_settings_of_a_vehicle_change_by_name_and_unknown_ones_are_refused():
    usual = pilotage.Vehicle("airplane-wind")
    name, value = next(
        (key, value) for key, value in usual.settings.items() if isinstance(value, float)
    )
    changed = pilotage.Vehicle("airplane-wind", **{name: value + 1.0})
    assert changed.settings[name] == value + 1.0
    with pytest.raises(pilotage.PilotageError, match="colour"):
        pilotage.Vehicle("airplane-wind", colour=1.0)
    with pytest.raises(pilotage.PilotageError, match="balloon.*airplane-wind"):
        pilotage.Vehicle("balloon")
