//! Vocabulary of setup sheets.

use pathbuild_diagnostic::Lang;

/// Chooses words by language.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words(pub(super) Lang);

impl Words {
    pub(super) fn either<T>(self, en: T, de: T) -> T {
        self.0.choose(en, de)
    }

    /// The position of zero relative to the lower end of a length along X or Y.
    pub(super) fn beside(self, low: f64, is_across: bool) -> String {
        let mm = crate::svg::legend::mm;
        let (sides, edge) = match (is_across, self.0) {
            (true, Lang::En) => (["right", "left"], "left edge"),
            (true, Lang::De) => (["rechts", "links"], "linken Rand"),
            (false, Lang::En) => (["above", "below"], "lower edge"),
            (false, Lang::De) => (["über", "unter"], "unteren Rand"),
        };
        if low.abs() < 0.0005 {
            return self.either(format!("on the {edge}"), format!("auf dem {edge}"));
        }
        let side = if low < 0.0 { sides[0] } else { sides[1] };
        let length = mm(low.abs());
        match (self.0, is_across) {
            (Lang::En, true) => format!("{length} mm {side} of the {edge}"),
            (Lang::En, false) => format!("{length} mm {side} the {edge}"),
            (Lang::De, true) => format!("{length} mm {side} vom {edge}"),
            (Lang::De, false) => format!("{length} mm {side} dem {edge}"),
        }
    }
}
