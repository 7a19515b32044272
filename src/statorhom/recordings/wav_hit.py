"""Hits in WAV files: the first channel is the force, the others are accelerations."""

from __future__ import annotations

import struct
import warnings
from pathlib import Path

import numpy as np
from scipy.io import wavfile

from statorhom.recordings.hit import Hit
from statorhom.recordings.message import recording_error
from statorhom.recordings.placement import Placement
from statorhom.study.message import quoted


def read_wav_hit(path: Path, placement: Placement, number: int) -> Hit:
    """The hit of a WAV file.

    Parameters
    ----------
    path : Path
    placement : Placement
        Points, direction and what full scale means in N and m/s².
    number : int
        Of the hit.

    Raises
    ------
    RecordingError
    """
    force, acceleration = placement.force_full_scale_n, placement.acceleration_full_scale_m_s2
    if force is None or acceleration is None:
        raise recording_error(
            path,
            "",
            "says nothing about what its samples mean",
            "add force_full_scale_n and acceleration_full_scale_m_s2 to the study's test",
        )
    rate, samples = _samples(path)
    if samples.ndim != 2 or samples.shape[1] < 2 or not len(samples):
        raise recording_error(
            path, "", "has a single channel or no samples", "record the force first, then accelerations"
        )
    if placement.sample_rate_hz is not None and placement.sample_rate_hz != rate:
        raise recording_error(
            path,
            "",
            f"has {rate} samples per second, but sample_rate_hz differs",
            "correct it or leave it out",
        )
    channels = samples.shape[1] - 1
    responses = (
        (placement.response(),)
        if channels == 1
        else tuple(placement.response(node) for node in range(1, channels + 1))
    )
    return Hit(
        number=number,
        sample_rate_hz=float(rate),
        force_n=force * samples[:, 0],
        acceleration_m_s2=acceleration * np.ascontiguousarray(samples[:, 1:].T),
        reference=placement.hammer(),
        responses=responses,
        source=str(path),
    )


def _samples(path: Path) -> tuple[int, np.ndarray]:
    """Sample rate, and samples in parts of full scale."""
    try:
        # scipy only warns where a file ends early
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            rate, samples = wavfile.read(path)
    # scipy's reader lets any exception through that damaged bytes lead to
    except (
        ValueError,
        TypeError,
        ArithmeticError,
        LookupError,
        OSError,
        EOFError,
        struct.error,
        Warning,
        MemoryError,
        UnboundLocalError,
    ) as error:
        raise recording_error(
            path, "", f"is no complete WAV file ({quoted(str(error))})", "export or copy it again"
        ) from None
    if rate <= 0:
        raise recording_error(path, "", "has no sample rate", "export it again")
    if samples.dtype == np.uint8:
        return rate, (samples - 128.0) / 128.0
    full_scale = -float(np.iinfo(samples.dtype).min) if samples.dtype.kind == "i" else 1.0
    scaled = samples.astype(float) / full_scale
    if not np.isfinite(scaled).all():
        raise recording_error(path, "", "holds samples that are not numbers", "export the record again")
    return rate, scaled
