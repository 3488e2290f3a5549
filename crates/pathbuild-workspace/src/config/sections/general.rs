//! Keys outside any table.

#![expect(clippy::doc_markdown, reason = "users see these texts in their pathbuild.toml")]

use camino::Utf8PathBuf;
use pathbuild_diagnostic::Lang;
use pathbuild_path::{FilePattern, PathPattern};

use crate::config::arguments::OptionValues::{
    Directories as SearchDirectories, Directory, Switch, Text, Texts,
};
use crate::config::arguments::{GivenOption, OptionReader, SettingOption};
use crate::config::kinds::{
    DIRECTORIES, DIRECTORY, NOT_NEGATIVE, OPTIONAL_REGEX, PART_TOLERANCE, PIECE, POSITIVE, REGEX,
    RESTRICTIONS, SWITCH, choice,
};
use crate::config::table_kinds::POST;
use crate::config::types::{
    Charset, Directories, PartHolding, PostChoice, Restriction, SpindleControl, Units, ZModel,
};

/// Like [`section!`], for keys that command-line options can override. Such a key adds its option: position among the common options
/// in the help, parser, values, and help in both languages.
macro_rules! overridable {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $concerns:ident
            $(, option $position:literal: $read:expr, $values:expr, $en:literal, $de:literal)?;
    )*) => {
        section! {
            $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $concerns;)*
        }

        /// Command-line options that override keys.
        pub const OPTIONS: &[SettingOption] = &[
            $($(SettingOption {
                name: $name,
                position: $position,
                values: $values,
                help: pathbuild_diagnostic::Text { en: $en, de: $de },
            },)?)*
        ];

        impl Options {
            /// Validates the options of the command line.
            pub(in crate::config) fn given(reader: &mut OptionReader<'_>) -> Self {
                Self { $($($field: reader.take($name, $read),)?)* ..Self::default() }
            }
        }
    };
}

overridable! {
    /// mm/min: F of paths that give none; needed to emit, not to check
    feed: Option<f64> = "feed", POSITIVE, None, "150", Check,
        option 0: GivenOption::positive, Text("MM/MIN"), "Milling feed of paths that give none", "Fräsvorschub für Pfade, die keinen angeben";
    /// mm/min: speed of rapid moves, for times; needed to emit
    rapid: Option<f64> = "rapid", POSITIVE, None, "1000", Emit,
        option 1: GivenOption::positive, Text("MM/MIN"), "Speed of rapid moves, for the times shown", "Eilganggeschwindigkeit, für die angezeigten Zeiten";
    /// mm: S of an emitted path that gives none; needed to emit
    sweep_height: Option<f64> = "sweep-height", POSITIVE, None, "20", Check,
        option 2: GivenOption::positive, Text("MM"), "Sweep height of an emitted path that gives none", "Leerfahrthöhe, wenn der geschriebene Pfad keine angibt";
    /// mm/min: Z of probes that give none; without it, like feed
    probe_feed: Option<f64> = "probe-feed", POSITIVE, None, "40", Emit,
        option 3: GivenOption::positive, Text("MM/MIN"), "Probing feed of paths that give none", "Vorschub beim Antasten für Pfade, die keinen angeben";
    /// directories that `check` and `emit` use without arguments, and in which paths are found by name;
    /// includes subdirectories, respects .gitignore and .ignore
    library: Directories = "library", DIRECTORIES, Vec::new(), r#"["."]"#, Neither;
    /// further directories in which embedded paths are looked for, in this order, without subdirectories
    search: Directories = "search", DIRECTORIES, Vec::new(), "[]", Check,
        option 5: |option| Ok(option.directories()), SearchDirectories, "Look for embedded paths in this directory as well (repeatable)",
        "Sucht eingebettete Pfade auch in diesem Verzeichnis (wiederholbar)";
    /// which names are path names
    path_pattern: Box<str> = "path-pattern", REGEX, PathPattern::DEFAULT.into(), "'([0-9]{4})[.]([0-9]+)([A-Z])'", Check,
        option 6: GivenOption::regex, Text("REGEX"), "Regular expression for path names", "Regulärer Ausdruck für Pfadnamen";
    /// which parts of a file name are path names
    file_pattern: Box<str> = "file-pattern", REGEX, FilePattern::DEFAULT.into(), "'([0-9]{4})(?:[.]([0-9]+))?'", Check,
        option 7: GivenOption::regex, Text("REGEX"), "Regular expression for path names in file names",
        "Regulärer Ausdruck für Pfadnamen in Dateinamen";
    /// layers with clamps, by their whole names: no move may enter their outlines below the height
    /// that a text such as Z25 gives (PB407)
    keep_out: Option<Box<str>> = "keep-out", OPTIONAL_REGEX, None, "'Clamps.*'", Check;
    /// layers with finished parts, by their whole names: cuts that go through the plate are compared with their outlines
    /// (PB213 to PB220); a group in the expression names the path that cuts the part: 'Part_(.*)'
    part: Option<Box<str>> = "part", OPTIONAL_REGEX, None, "'Part.*'", Check;
    /// mm: how far a cut may miss the outline of a part on either side; at least 0.005
    part_tolerance: f64 = "part-tolerance", PART_TOLERANCE, 0.02, "0.02", Check;
    /// bars | otherwise (tape, vacuum): what holds a part that is cut all round (PB217)
    part_held: PartHolding = "part-held", choice::<PartHolding>(), PartHolding::Bars, r#""bars""#, Check;
    /// PARENT:CHILD, split at the first colon: which paths may embed which, such as "^8:P$"
    restrict: Vec<Restriction> = "restrict", RESTRICTIONS, Vec::new(), "[]", Check,
        option 8: GivenOption::restrictions, Texts("PARENT:CHILD"),
        "A path whose name matches PARENT may embed only paths whose names match CHILD; both are regular expressions (repeatable)",
        "Ein Pfad, auf dessen Namen AUSSEN passt, darf nur Pfade einbetten, auf deren Namen INNEN passt; beides sind reguläre Ausdrücke (wiederholbar)";
    /// en | de: language of messages; --lang, PATHBUILD_LANG and your own config.toml take precedence
    lang: Lang = "lang", choice::<Lang>(), Lang::En, r#""en""#, Emit;
    /// en | de: language of comments in programs; without it, `lang` of this file; no option changes it
    comment_lang: Lang = "comment-lang", choice::<Lang>(), Lang::En, r#""en""#, Emit;
    /// header (mm or none, otherwise PB113) | drawing (convert) | mm (ignore the drawing's header)
    units: Units = "units", choice::<Units>(), Units::Header, r#""header""#, Check;
    /// ascii (umlauts transliterated) | utf-8, for written programs
    charset: Charset = "charset", choice::<Charset>(), Charset::Ascii, r#""ascii""#, Emit;
    /// mm: tolerance for ELLIPSE and SPLINE on path layers; with 0 they are not part of the path (PB111)
    approximate_curves: f64 = "approximate-curves", NOT_NEGATIVE, 0.0, "0", Check;
    /// mm: ends at most this far apart count as joined, with a warning for each (PB115)
    join_tolerance: f64 = "join-tolerance", NOT_NEGATIVE, 0.0, "0", Check;
    /// true: programs exactly as PathDxf2GCode writes them, even where it deviates from its manuals
    compatible: bool = "compatible", SWITCH, false, "false", Check,
        option 4: |_| Ok(true), Switch, "Write programs exactly as `PathDxf2GCode` does", "Schreibt Programme genau so wie `PathDxf2GCode`";
    /// idw4 | plane | tin: how heights between probes are calculated
    z_model: ZModel = "z-model", choice::<ZModel>(), ZModel::Idw4, r#""idw4""#, Emit;
    /// mm: longest move that is corrected as a whole; 0: never split; without it 0 for idw4, otherwise 20
    z_split: Option<f64> = "z-split", PIECE, None, "0", Emit;
    /// a built-in post-processor or a file; with further settings { name = "...", unchecked = true, program-number = 8001 }
    /// (unchecked: also write moves that cannot be read back, at your own risk)
    post: PostChoice = "post", POST, "native".into(), r#""native""#, Emit;
    /// tool (the tools' speeds, otherwise PB754) | manual (posts neither start nor stop the spindle)
    spindle: SpindleControl = "spindle", choice::<SpindleControl>(), SpindleControl::Tool, r#""tool""#, Emit;
    /// whether holes become canned cycles if the post has them
    cycles: bool = "cycles", SWITCH, false, "false", Emit;
    /// directory for written files; empty: beside the drawing
    out_dir: Option<Utf8PathBuf> = "out-dir", DIRECTORY, None, r#""""#, Emit,
        option 10: |option| Ok(Some(option.directory())), Directory, "Write into this directory instead of beside the drawing",
        "Schreibt in dieses Verzeichnis statt neben die Zeichnung";
}
