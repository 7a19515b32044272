"""Which harmonics a step's measured modes can live in."""

import synthetic_stage as stage

from statorhom.identify.stages.bands import highest_hz, mode_names


def test_the_band_ends_at_the_highest_mode():
    assert highest_hz(stage.measured()) == max(stage.truth_modes()[name] for name in stage.MODES)


def test_labelled_modes_keep_their_names():
    assert mode_names(stage.ring(), stage.steel(), stage.measured()) == set(stage.MODES)


def test_a_mode_without_a_label_may_be_any_visible_one_of_the_band():
    modes = stage.measured(((3, 0),), labelled=False)
    names = mode_names(stage.ring(), stage.steel(), modes, margin=1.1)
    assert {(2, None), (3, None)} <= names
    assert (6, None) not in names  # its lowest mode lies far above
