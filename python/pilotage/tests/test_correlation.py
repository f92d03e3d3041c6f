"""Patches matched with pictures, beside OpenCV."""

import numpy as np
import pilotage
import pytest


def ground(height, width, seed=3):
    random = np.random.default_rng(seed)
    picture = random.normal(size=(height, width))
    for axis in (0, 1):
        picture = sum(np.roll(picture, shift, axis) for shift in range(-2, 3))
    return (100 + 6 * picture).astype(np.float32)


@pytest.mark.parametrize("kind", [np.float32, np.uint8, np.float64])
def test_the_surface_is_opencvs(kind):
    cv2 = pytest.importorskip("cv2")
    picture = ground(120, 160).clip(0, 255).astype(kind)
    patch = picture[40:61, 70:95].copy()
    ours = pilotage.correlate(picture, patch)
    theirs = cv2.matchTemplate(
        picture.astype(np.float32), patch.astype(np.float32), cv2.TM_CCOEFF_NORMED
    )
    assert ours.dtype == np.float32 and ours.shape == theirs.shape == (100, 136)
    np.testing.assert_allclose(ours, theirs, atol=2e-4)


def test_a_patch_is_found_where_it_was_cut_out_in_other_light():
    picture = ground(200, 300)
    patch = 0.5 * picture[33:65, 121:161] + 60
    found = pilotage.match_patch(picture, patch)
    assert abs(found.x - 121) < 0.05 and abs(found.y - 33) < 0.05
    assert found.score > 0.999 and found.second_score < 0.8


def test_a_mask_leaves_out_what_was_painted_over():
    picture = ground(100, 100)
    patch = picture[20:52, 30:62].copy()
    counts = np.ones(patch.shape, bool)
    patch[:10, :10], counts[:10, :10] = 999.0, False
    assert pilotage.match_patch(picture, patch).score < 0.9
    found = pilotage.match_patch(picture, patch, mask=counts)
    assert found.score > 0.999 and abs(found.x - 30) < 0.05


def test_a_flat_patch_and_one_that_is_too_large_are_refused():
    picture = ground(50, 50)
    with pytest.raises(pilotage.PilotageError, match="flat"):
        pilotage.correlate(picture, np.full((8, 8), 5.0))
    with pytest.raises(pilotage.PilotageError, match="60 × 8 pixels does not fit.*50 × 50"):
        pilotage.correlate(picture, ground(8, 60))
