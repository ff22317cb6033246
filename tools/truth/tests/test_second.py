"""The numbers of a second opinion, and the rows that keep means of Mitsuba."""

import os
import tempfile
import unittest

import numpy as np

from hairtruth import second

MEANS = {"mitsuba": (0.1, 0.2, 0.4), "cycles": (0.11, 0.2, 0.3), "drawn": (0.1, 0.1, 0.4)}


class TestSecond(unittest.TestCase):
    def test_difference_is_relative_to_the_other_source(self):
        row = second.cells(MEANS)
        np.testing.assert_allclose(second.difference(row, "cycles", "mitsuba"), (0.1, 0, -0.25))
        np.testing.assert_allclose(second.difference(row, "drawn", "cycles"),
                                   (0.1 / 0.11 - 1, -0.5, 1 / 3), rtol=1e-6)

    def test_means_of_a_file_keep_unknown_errors_unknown(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rows.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("case,error,mitsuba_red,mitsuba_green,mitsuba_blue\n"
                           "a,0.02,1,2,3\nb,,4,5,6\n")
            means = second.read_means(path)
        self.assertEqual(means["a"][0].tolist(), [1, 2, 3])
        self.assertEqual(means["a"][1], 0.02)
        self.assertIsNone(means["b"][1])


if __name__ == "__main__":
    unittest.main()
