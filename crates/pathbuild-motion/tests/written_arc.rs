//! Tests that arcs keep both ends on a single circle when their numbers are rounded. (book: program/gcode)

use pathbuild_motion::WrittenArc;

/// Arcs with rounded radii that differ by more than 0.002 mm. Each has a start, an end, and a centre relative to the start.
const UNLUCKY: [[[f64; 2]; 3]; 3] = [
    [
        [17.795_257_996_527_887, -5.848_451_641_270_525],
        [33.620_060_494_583_24, -27.932_545_617_717_057],
        [8.771_422_003_472_114, -10.426_498_358_729_475],
    ],
    [
        [3.570_464_544_774_904_7, 13.111_317_863_497_769],
        [22.043_085_129_166_343, 42.576_530_950_915_114],
        [8.228_405_455_225_097, 15.364_492_136_502_23],
    ],
    [
        [-19.738_631_600_187_475, -31.571_535_0],
        [-22.988_514_958_166_455, -25.392_493_582_929_65],
        [-2.465_408_399_812_524_5, 2.647_475_0],
    ],
];

fn thousandths(length: f64) -> f64 {
    libm::round(length * 1000.0) / 1000.0
}

/// Returns the difference between the radii at both ends, with all numbers rounded and the centre moved by `by`.
fn difference(arc: &WrittenArc<'_>, by: [f64; 2]) -> f64 {
    let round = arc.length;
    let origin = if arc.is_absolute { [0.0; 2] } else { arc.from.map(round) };
    let centre = [0, 1].map(|axis| origin[axis] + round(arc.centre[axis] + by[axis]));
    let radius = |at: [f64; 2]| libm::hypot(round(at[0]) - centre[0], round(at[1]) - centre[1]);
    (radius(arc.from) - radius(arc.to)).abs()
}

#[test]
fn a_centre_beside_the_nearest_one_fits_both_ends() {
    for [from, to, centre] in UNLUCKY {
        let arc = WrittenArc { from, to, centre, length: &thousandths, is_absolute: false, unit: 1.0 };
        assert!(difference(&arc, [0.0; 2]) > 0.002);
        let by = arc.centre_correction().unwrap();
        assert!(difference(&arc, by) < 0.001 && by.iter().all(|by| by.abs() <= 0.001), "{by:?}");
        // Numbers in inches with four decimals are 2.54 times as coarse, so the same applies to arcs that are larger by this factor.
        let large = |point: [f64; 2]| point.map(|at| at * 2.54);
        let inches = |length: f64| libm::round(length / 25.4 * 10_000.0) / 10_000.0;
        let [from, to, centre] = [large(from), large(to), large(centre)];
        let arc = WrittenArc { from, to, centre, length: &inches, is_absolute: false, unit: 25.4 };
        assert!(difference(&arc, [0.0; 2]) > 0.000_2);
        assert!(difference(&arc, arc.centre_correction().unwrap()) < 0.000_1);
    }
}

#[test]
fn a_centre_that_fits_stays_the_nearest_one() {
    let centre = [-10.0, 0.0];
    let (from, to) = ([10.0, 0.0], [0.0, 10.001_4]);
    let arc = WrittenArc { from, to, centre, length: &thousandths, is_absolute: false, unit: 1.0 };
    assert_eq!(arc.centre_correction(), Ok([0.0; 2]));
}

#[test]
fn an_arc_that_is_wrong_before_it_is_rounded_is_not_made_to_fit() {
    for is_absolute in [false, true] {
        let centre = if is_absolute { [0.0; 2] } else { [-10.0, 0.0] };
        let (from, to) = ([10.0, 0.0], [0.0, 10.003]);
        let arc = WrittenArc { from, to, centre, length: &thousandths, is_absolute, unit: 1.0 };
        let [start, end] = arc.centre_correction().unwrap_err();
        assert!((start - 10.0).abs() < 1e-9 && (end - 10.003).abs() < 1e-9);
    }
}

#[test]
fn absolute_centres_are_fitted_as_they_are_written() {
    let (from, to) = (
        [1.976_503_581_994_828_5, 29.096_368_711_370_648],
        [33.622_631_100_772_75, -1.642_888_030_028_318_6],
    );
    let centre = [17.828_481_979_091_805, 13.756_508_019_173_125];
    let arc = WrittenArc { from, to, centre, length: &thousandths, is_absolute: true, unit: 1.0 };
    assert!(difference(&arc, [0.0; 2]) > 0.002);
    assert!(difference(&arc, arc.centre_correction().unwrap()) < 0.001);
}
