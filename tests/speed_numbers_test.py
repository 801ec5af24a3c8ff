"""The numbers of tools/bench/speed.py on what is known on paper. Exit code 77, skipped, without numpy."""
import pathlib
import sys
import unittest

try:
    import numpy
except ImportError:
    print("skipped: apt-get install python3-numpy")
    sys.exit(77)

sys.path.append(str(pathlib.Path(__file__).parent.parent / "tools/bench"))
sys.dont_write_bytecode = True
import speed_numbers as numbers


class SpeedNumbers(unittest.TestCase):
    def test_one_firefly_in_a_thousand_pixels_is_left_out_and_two_are_not(self):
        reference = numpy.ones((10, 100, 3))
        picture = reference * 1.1
        picture[3, 5] = 1e6
        self.assertAlmostEqual(numbers.trimmed_relmse(picture, reference), 0.01 / 1.01, delta=1e-12)
        picture[7, 9] = 1e6
        self.assertGreater(numbers.trimmed_relmse(picture, reference), 1e5)

    def test_the_error_of_black_pixels_is_relative_to_the_offset(self):
        self.assertAlmostEqual(numbers.trimmed_relmse(numpy.full((4, 4, 3), 0.2), numpy.zeros((4, 4, 3))), 0.04 / 0.01)

    def test_pictures_held_against_each_other_show_their_own_variance(self):
        # Of 400 x 250 pixels the worst 0.1 % are left out: of a normal distribution they hold 1.2 % of the variance,
        # erfc(t / sqrt 2) = 0.001 and t = 3.291: sqrt(2 / pi) t exp(-t^2 / 2) + 0.001. One standard deviation of a
        # picture's mean square is sqrt(2 / 100000) = 0.45 %; reference noise in the denominator adds 3 sigma^2 / n.
        rng = numpy.random.default_rng(7)
        sigma, light = 0.1, 10.0
        for n in (2, 3, 8):
            pictures = [light + rng.normal(0, sigma, (250, 400, 1)) for _ in range(n)]
            expected = sigma**2 / (light**2 + 0.01) * (1 - 0.0127)
            for error in numbers.left_out_relmse(pictures):
                self.assertAlmostEqual(error / expected, 1, delta=5 * 0.0045)

    def test_half_the_error_takes_twice_the_samples_and_none_takes_one(self):
        self.assertEqual(numbers.samples_for(0.02, 64, 0.01), 128)
        self.assertEqual(numbers.samples_for(0.01, 64, 0.01), 64)
        self.assertEqual(numbers.samples_for(0.00001, 64, 0.01), 1)

    def test_points_of_a_line_have_its_slope(self):
        slope, apart = numbers.slope([1, 2, 5], [3, 5, 11])
        self.assertAlmostEqual(slope, 2)
        self.assertAlmostEqual(apart, 0)

    def test_a_ratio_above_one_is_better_for_rates_as_for_times(self):
        self.assertEqual(numbers.row("", "", 8, "M/s", 4, target=2)["ratio"], 2)
        self.assertTrue(numbers.row("", "", 8, "M/s", 4, target=2)["met"])
        self.assertEqual(numbers.row("", "", 8, "s", 4, target=2, higher=False)["ratio"], 0.5)
        self.assertFalse(numbers.row("", "", 8, "s", 4, target=2, higher=False)["met"])
        self.assertIsNone(numbers.row("", "", 8, "s")["met"])

    def test_a_line_of_the_table_has_as_many_cells_as_its_head(self):
        lines = numbers.table([numbers.row("rays", "street", 8.1234, "M/s", 4, 2), numbers.row("error", "day", 1, "s")])
        self.assertEqual({line.count("|") for line in lines.split("\n")}, {9})
        self.assertIn("| rays | street | 8.12 M/s | 4 | 2.03 | 2 | yes |  |", lines)

    def test_the_spread_is_the_largest_over_the_smallest(self):
        self.assertEqual(numbers.spread([2, 3, 4]), 2)
        self.assertEqual(numbers.median([5, 1, 3]), 3)


unittest.main()
