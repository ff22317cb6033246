"""Whole numbers along strands as second differences, packed into bits, as .groom files have them.

Each axis of a strand has one width in bits for the first difference, and one for all others. A
strand that is stored as it is has 32 bits for every number.
"""

import numpy as np

FLOATS = 32  # width of numbers that are stored as they are


def _places(counts):
    """Return the index of each vertex in its strand, the strand, and the place of its numbers.

    Roots have no numbers. The numbers of a strand stand axis after axis.
    """
    starts = np.cumsum(counts) - counts
    strand = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(counts.sum()) - starts[strand]
    more = counts - 1
    first = 3 * (np.cumsum(more) - more)
    places = (first[strand] + within - 1)[:, None] + more[strand][:, None] * np.arange(3)
    return within, strand, places


def _bit_length(values):
    return np.frexp(values.astype(np.float64))[1].astype(np.int64)


def _spread(widths, counts, floats):
    """Return the width of each number of vertices that are no roots, in the order of vertices."""
    within, strand, places = _places(counts)
    shifts = 10 * np.arange(3)[None, :] + np.where(within > 1, 5, 0)[:, None]
    each = (widths[strand].astype(np.int64)[:, None] >> shifts) & 31
    each[floats[strand]] = FLOATS
    return each, within, places


def count_bits(widths, counts, floats):
    """Return the number of bits of all tracks."""
    widths, more = widths.astype(np.int64), counts - 1
    first = sum((widths >> 10 * k) & 31 for k in range(3))
    rest = sum((widths >> 10 * k + 5) & 31 for k in range(3))
    bits = np.where(more > 0, first + rest * (more - 1), 0)
    return int(np.where(floats, 3 * FLOATS * more, bits).sum())


def pack(points, counts, bits, floats):
    """Return the widths of each strand and the bytes of all tracks.

    `points` are whole numbers from the root. `bits` are those of strands in `floats`.
    """
    starts = np.cumsum(counts) - counts
    within, strand, places = _places(counts)
    numbers = np.zeros_like(points)
    numbers[1:] = np.diff(points, axis=0)
    numbers[within == 0] = 0
    second = np.zeros_like(numbers)
    second[1:] = np.diff(numbers, axis=0)
    numbers = np.where((within > 1)[:, None], second, numbers)
    numbers = (numbers << 1) ^ (numbers >> 63)
    widths = np.zeros(len(counts), np.int64)
    for k in range(3):
        first = np.maximum.reduceat(np.where(within == 1, numbers[:, k], 0), starts)
        rest = np.maximum.reduceat(np.where(within > 1, numbers[:, k], 0), starts)
        widths |= (_bit_length(first) | _bit_length(rest) << 5) << 10 * k
    widths[floats] = 0
    numbers[floats[strand]] = bits[floats[strand]]
    each, _, _ = _spread(widths, counts, floats)
    inner = within > 0
    order = places[inner].ravel()
    values, sizes = np.zeros(len(order), np.uint64), np.zeros(len(order), np.int64)
    values[order] = numbers[inner].ravel().astype(np.uint64)
    sizes[order] = each[inner].ravel()
    return widths.astype("<u4"), _pack_bits(values, sizes)


def _pack_bits(values, sizes):
    """Return bytes of numbers of any sizes up to 32 bits, from the lowest bit on."""
    total = int(sizes.sum())
    offsets = np.cumsum(sizes) - sizes
    words = np.zeros(total // 64 + 2, np.uint64)
    word, shift = offsets >> 6, (offsets & 63).astype(np.uint64)
    firsts = np.flatnonzero(np.diff(word, prepend=-1))
    words[word[firsts]] = np.bitwise_or.reduceat(values << shift, firsts)
    # At most one number goes on in the next word.
    over = (shift.astype(np.int64) + sizes) > 64
    words[word[over] + 1] |= values[over] >> (np.uint64(64) - shift[over])
    return words.astype("<u8").tobytes()[:(total + 7) // 8]


def unpack(data, widths, counts, floats):
    """Return whole numbers from the root, (n, 3) int32, and the bits of numbers as they are."""
    each, within, places = _spread(widths, counts, floats)
    inner = within > 0
    order = places[inner].ravel()
    sizes = np.zeros(len(order), np.int64)
    sizes[order] = each[inner].ravel()
    offsets = np.cumsum(sizes) - sizes
    padded = np.zeros(len(data) // 8 + 3, "<u8")
    padded.view("u1")[:len(data)] = np.frombuffer(data, "u1")
    word, shift = offsets >> 6, (offsets & 63).astype(np.uint64)
    values = padded[word] >> shift
    over = shift > 0
    values[over] |= padded[word[over] + 1] << (np.uint64(64) - shift[over])
    values &= (np.uint64(1) << sizes.astype(np.uint64)) - np.uint64(1)
    numbers = np.zeros((len(within), 3), np.int64)
    numbers[inner] = values.astype(np.int64)[order].reshape(-1, 3)
    bits = numbers.astype(np.uint32)
    numbers = (numbers >> 1) ^ -(numbers & 1)
    starts = np.cumsum(counts) - counts
    for _ in range(2):
        numbers = np.cumsum(numbers, axis=0)
        numbers -= np.repeat(numbers[starts], counts, axis=0)
    return numbers.astype(np.int32), bits
