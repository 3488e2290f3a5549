//! Names of things in messages, in every language. (Glossary in book: reference/glossary)

/// Declares texts, each with its documentation, and the list of them.
macro_rules! words {
    ($($(#[$doc:meta])* $key:ident: $en:literal, $de:literal;)*) => {
        $($(#[$doc])* pub static $key: crate::Text = crate::Text { en: $en, de: $de };)*

        /// The texts of this subject.
        pub(crate) static TEXTS: &[&crate::Text] = &[$(&$key),*];
    };
}
pub(crate) use words;

/// Every text that messages put in, those of other crates aside.
pub fn all() -> impl Iterator<Item = &'static crate::Text> {
    let texts = [TEXTS, crate::reasons::TEXTS, crate::limits::TEXTS, crate::messages::configuration::TEXTS];
    texts.into_iter().flatten().copied()
}

words! {
    /// An empty list.
    NONE: "none", "keine";
    /// The text of a start marker, with the path's own parameters.
    PATH_START: "a path start", "ein Pfadanfang";
    /// CONTINUOUS line or arc.
    MILLING_SEGMENT: "a milling segment", "ein Frässegment";
    /// DIVIDE line or arc.
    MARKING_SEGMENT: "a marking segment", "ein Markierungssegment";
    /// BORDER or CENTER line or arc.
    SUPPORT_SEGMENT: "a segment with support bars", "ein Segment mit Stützstegen";
    /// DASHED line or arc.
    SWEEP: "a sweep", "eine Leerfahrt";
    /// Circle of the cutter's diameter.
    DRILLED_HOLE: "a drilled hole", "ein Bohrloch";
    /// A hole to marking depth.
    DRILLED_MARK: "a drilled mark", "eine Bohrmarkierung";
    /// A circle larger than the cutter.
    HELICAL_CIRCLE: "a helical circle", "ein Helixkreis";
    /// A helical circle to marking depth.
    HELICAL_MARK: "a helical mark", "eine Helixmarkierung";
    /// A helical circle with support bars.
    HELICAL_SUPPORT: "a helical circle with support bars", "ein Helixkreis mit Stützstegen";
    /// A circle that may be a hole or a helical circle.
    CIRCLE: "a circle", "ein Kreis";
    /// DASHDOT line or arc.
    SUBPATH: "a subpath", "ein Unterpfad";
    /// Circle of 6 mm.
    PROBE: "a Z-probe", "eine Z-Probe";
    /// Anything else.
    ELEMENT: "an element", "ein Element";
    /// A line, whatever its meaning.
    LINE: "a line", "eine Linie";
    /// An arc, whatever its meaning.
    ARC: "an arc", "ein Bogen";
    /// G00.
    RAPID_MOVE: "rapid move", "Eilgang";
    /// G01 straight down.
    PLUNGE: "plunge", "Eintauchen";
    /// G01, G02, G03.
    CUT: "cut", "Schnitt";
    /// G38.2, G31.
    PROBING_MOVE: "probing move", "Messbewegung";
    /// The value comes from the element.
    OWN_TEXT: "own text", "eigener Text";
    /// The value comes from the first segment of the chain.
    CHAIN_TEXT: "first segment of the chain", "erstes Segment der Kette";
    /// The value comes from the path's start.
    PATH_TEXT: "text of the path", "Text des Pfads";
    /// The value comes from the path named by @.
    LENDER_TEXT: "text of the path that @ names", "Text des Pfads, den @ nennt";
    /// The value comes from an option or the configuration.
    OPTION: "option", "Option";
    /// The value is the default.
    DEFAULT: "default", "Vorgabe";
}
