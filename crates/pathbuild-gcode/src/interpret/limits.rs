//! Limits of values, as used in the messages of PB725. (book: reference/diagnostics)

use pathbuild_diagnostic::Text;

macro_rules! limits {
    ($($key:ident: $en:literal, $de:literal;)*) => {
        $(pub(super) static $key: Text = Text { en: $en, de: $de };)*
    };
}

limits! {
    COUNT: "a whole number, 0 or more", "eine ganze Zahl ab 0";
    HOLES: "a whole number of holes, 1 or more", "eine ganze Zahl von Bohrungen ab 1";
    MOVES_OF_A_CYCLE: "at most 100000 moves in all", "höchstens 100000 Bewegungen insgesamt";
    NOT_BELOW_Z: "not below Z", "nicht unter Z";
    NOT_NEGATIVE: "0 or more", "0 oder mehr";
    NUMBER_OF_LAYER: "the number of a layer", "die Nummer eines Layers";
    OFFSETS: "0 to 9", "0 bis 9";
    POSITIVE: "more than 0", "größer als 0";
    POSITIVE_COUNT: "a whole number, 1 or more", "eine ganze Zahl ab 1";
    SECONDS: "0 seconds or more", "0 Sekunden oder mehr";
    TURNS: "a whole number of turns from 1 to 100000", "eine ganze Zahl von Umläufen von 1 bis 100000";
}
