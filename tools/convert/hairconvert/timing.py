"""Times of frames."""

import numpy as np


def find_rate(times):
    """Return the frames per second of times, 24 for a single frame."""
    if len(times) < 2 or times[-1] <= times[0]:
        return 24.0
    rate = 1 / np.diff(times).min()
    whole = round(rate)
    return float(whole) if whole and abs(rate - whole) < 1e-3 * rate else float(rate)
