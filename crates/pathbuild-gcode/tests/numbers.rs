//! Tests numbers with three decimals: the exact binary value, with ties to even, as in `{:.3}`. (book: reference/glossary)

use pathbuild_gcode::native::three_decimals;
use proptest::prelude::*;

fn formatted(number: f64) -> String {
    let text = format!("{number:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbers_of_drawings_are_as_format_makes_them(number in -1e5..1e5_f64) {
        prop_assert_eq!(three_decimals(number), formatted(number));
    }

    #[test]
    fn any_numbers_are_as_format_makes_them(bits in any::<u64>()) {
        let number = f64::from_bits(bits);
        prop_assert_eq!(three_decimals(number), formatted(number));
    }

    /// Halves of a thousandth are exact in binary if they are multiples of an eighth. The neighbouring numbers are not ties.
    #[test]
    fn ties_go_to_even(sixteenths in -1_000_000..1_000_000_i32, beside in -2..=2_i64) {
        let tie = f64::from(sixteenths) / 16.0;
        let number = f64::from_bits(tie.to_bits().saturating_add_signed(beside));
        prop_assert_eq!(three_decimals(number), formatted(number));
    }
}

#[test]
fn extremes_are_as_format_makes_them() {
    let limits = [0.0, -0.0, 0.0005, 0.000_499_99, -0.0005, 0.0625, 0.1875, 0.9995, 999.9995, 5e-324, 9.0e15];
    let large = [4_503_599_627_370_496.5, 9_007_199_254_740_992.0, 1e300, f64::MAX, f64::INFINITY, f64::NAN];
    for number in limits.into_iter().chain(large) {
        assert_eq!(three_decimals(number), formatted(number), "{number:e}");
        assert_eq!(three_decimals(-number), formatted(-number), "-{number:e}");
    }
}
