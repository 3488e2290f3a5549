//! The keys of all tables, each with its type, default and description.

/// Declares a table of the configuration. Each key has a description and a field, its name in the file, its [`ValueType`], its default, a TOML
/// value for the file that `init` writes, and the cached results that depend on it ([`ResultKind`]).
///
/// [`ValueType`]: super::reader::ValueType
macro_rules! section {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident;
    )*) => {
        use std::fmt::Debug;

        use crate::config::origin::{Key, ResultKind, ShownSetting, SourcedValue};
        use crate::config::reader::Table;

        /// The values that one source sets; `None` for keys that it does not set.
        #[derive(Clone, Debug, Default)]
        pub struct Options {
            $($(#[doc = $meaning])+ pub $field: Option<SourcedValue<$type>>,)*
        }

        /// The values after applying defaults.
        #[derive(Clone, Debug)]
        pub struct Settings {
            $($(#[doc = $meaning])+ pub $field: SourcedValue<$type>,)*
        }

        impl Options {
            pub(in crate::config) fn read(table: &mut Table<'_, '_, '_>) -> Self {
                Self { $($field: table.take($name, &$kind),)* }
            }

            pub(in crate::config) fn resolve(self) -> Settings {
                Settings { $($field: self.$field.unwrap_or_else(|| SourcedValue::default($default)),)* }
            }
        }

        impl Settings {
            /// Returns the keys with their values as TOML.
            pub(in crate::config) fn shown(&self) -> Vec<ShownSetting> {
                vec![$(ShownSetting { name: $name, value: ($kind.show)(&self.$field.value), origin: self.$field.origin },)*]
            }
        }

        impl Settings {
            /// Passes to `add` each value on which the cached results of the command `result_kind` depend.
            pub(in crate::config) fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
                $(if ResultKind::$results.is_part_of(result_kind) {
                    add($name, &self.$field.value);
                })*
            }
        }

        pub(in crate::config) const KEYS: &[Key] = &[
            $(Key { name: $name, meaning: &[$($meaning),+], example: $example, schema: $kind.schema },)*
        ];
    };
}

/// Keys outside any table, before all headers.
#[expect(clippy::doc_markdown, reason = "users see these texts in their pathbuild.toml")]
pub mod general {
    use camino::Utf8PathBuf;
    use pathbuild_diagnostic::Lang;
    use pathbuild_dxf::Units;
    use pathbuild_gcode::dialect::Charset;
    use pathbuild_path::{FilePattern, PathPattern};
    use pathbuild_toolpath::ZModel;

    use crate::config::arguments::OptionValues::{
        Directories as SearchDirectories, Directory, Switch, Text, Texts,
    };
    use crate::config::arguments::{GivenOption, OptionReader, SettingOption};
    use crate::config::kinds::{
        DIRECTORIES, DIRECTORY, MEASURE, NOT_NEGATIVE, OPTIONAL_REGEX, PART_TOLERANCE, PIECE, REGEX,
        RESTRICTIONS, SPEED, SWITCH, choice,
    };
    use crate::config::table_kinds::POST;
    use crate::config::types::{Directories, PartHolding, PostChoice, Restriction, SpindleControl};

    /// Like [`section!`], for keys that command-line options can set. Such a key also declares its option: the position among the common options in
    /// the help, whether the value replaces the configured one or adds to it (a function of [`OptionReader`]), the parser, the values, and the help
    /// in both languages.
    macro_rules! overridable {
        ($(
            $(#[doc = $meaning:literal])+
            $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $concerns:ident
                $(, option $position:literal $applies:ident: $read:expr, $values:expr, $en:literal, $de:literal)?;
        )*) => {
            section! {
                $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $concerns;)*
            }

            /// Command-line options that set keys.
            pub const OPTIONS: &[SettingOption] = &[
                $($(SettingOption {
                    name: $name,
                    position: $position,
                    values: $values,
                    help: pathbuild_diagnostic::Text { en: $en, de: $de },
                },)?)*
            ];

            impl Options {
                pub(in crate::config) fn apply(&mut self, reader: &mut OptionReader<'_>) {
                    $($(reader.$applies(&mut self.$field, $name, $read);)?)*
                }
            }
        };
    }

    overridable! {
        /// mm/min: F of paths that give none; needed to emit, not to check
        feed: Option<f64> = "feed", SPEED, None, "150", Check,
            option 0 replace_value: GivenOption::speed, Text("MM/MIN"), "Milling feed of paths that give none", "Fräsvorschub für Pfade, die keinen angeben";
        /// mm/min: speed of rapid moves, for times; needed to emit
        rapid: Option<f64> = "rapid", SPEED, None, "1000", Emit,
            option 1 replace_value: GivenOption::speed, Text("MM/MIN"), "Speed of rapid moves, for the times shown", "Eilganggeschwindigkeit, für die angezeigten Zeiten";
        /// mm: S of an emitted path that gives none; needed to emit
        sweep_height: Option<f64> = "sweep-height", MEASURE, None, "20", Check,
            option 2 replace_value: GivenOption::positive_number, Text("MM"), "Sweep height of an emitted path that gives none", "Leerfahrthöhe, wenn der geschriebene Pfad keine angibt";
        /// mm/min: Z of probes without a Z of their own; default: like feed
        probe_feed: Option<f64> = "probe-feed", SPEED, None, "40", Emit,
            option 3 replace_value: GivenOption::speed, Text("MM/MIN"), "Probing feed of paths that give none", "Vorschub beim Antasten für Pfade, die keinen angeben";
        /// directories that `check` and `emit` use without arguments, and in which paths are found by name;
        /// includes subdirectories, respects .gitignore and .ignore
        library: Directories = "library", DIRECTORIES, Vec::new(), r#"["."]"#, Neither;
        /// further directories in which embedded paths are looked for, in this order, without subdirectories
        search: Directories = "search", DIRECTORIES, Vec::new(), "[]", Check,
            option 5 append_values: |option| Ok(option.directories()), SearchDirectories, "Look for embedded paths in this directory as well (repeatable)",
            "Sucht eingebettete Pfade auch in diesem Verzeichnis (wiederholbar)";
        /// which names are path names
        path_pattern: Box<str> = "path-pattern", REGEX, PathPattern::DEFAULT.into(), "'([0-9]{4})[.]([0-9]+)([A-Z])'", Check,
            option 6 replace_value: GivenOption::regex, Text("REGEX"), "Regular expression for path names", "Regulärer Ausdruck für Pfadnamen";
        /// which parts of a file name are path names
        file_pattern: Box<str> = "file-pattern", REGEX, FilePattern::DEFAULT.into(), "'([0-9]{4})(?:[.]([0-9]+))?'", Check,
            option 7 replace_value: GivenOption::regex, Text("REGEX"), "Regular expression for path names in file names",
            "Regulärer Ausdruck für Pfadnamen in Dateinamen";
        /// layers with clamps, by their whole names: no move may enter their outlines below the height
        /// that a text such as Z25 gives (PB407)
        keep_out: Option<Box<str>> = "keep-out", OPTIONAL_REGEX, None, "'Clamps.*'", Check;
        /// layers with finished parts, by their whole names: cuts that go through the material are compared with their outlines
        /// (PB213 to PB223); a group in the expression names the path that cuts the part: 'Part_(.*)'
        part: Option<Box<str>> = "part", OPTIONAL_REGEX, None, "'Part.*'", Check;
        /// mm: how far a cut may miss the outline of a part on either side; at least 0.005
        part_tolerance: f64 = "part-tolerance", PART_TOLERANCE, 0.02, "0.02", Check;
        /// bars | otherwise (tape, vacuum): what holds a part that is cut all round (PB217)
        part_held: PartHolding = "part-held", choice::<PartHolding>(), PartHolding::Bars, r#""bars""#, Check;
        /// PARENT:CHILD, split at the first colon: which paths may embed which, such as "^8:P$"
        restrict: Vec<Restriction> = "restrict", RESTRICTIONS, Vec::new(), "[]", Check,
            option 8 append_values: GivenOption::restrictions, Texts("PARENT:CHILD"),
            "A path whose name matches PARENT may embed only paths whose names match CHILD; both are regular expressions, and configured rules come first (repeatable)",
            "Ein Pfad, auf dessen Namen AUSSEN passt, darf nur Pfade einbetten, auf deren Namen INNEN passt; beides sind reguläre Ausdrücke, und konfigurierte Regeln gelten zuerst (wiederholbar)";
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
            option 4 replace_value: |_| Ok(true), Switch, "Write programs exactly as `PathDxf2GCode` does", "Schreibt Programme genau so wie `PathDxf2GCode`";
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
        cycles: bool = "cycles", SWITCH, false, "false", Check;
        /// directory for written files; empty: beside the drawing
        out_dir: Option<Utf8PathBuf> = "out-dir", DIRECTORY, None, r#""""#, Emit,
            option 10 replace_value: |option| Ok(Some(option.directory())), Directory, "Write into this directory instead of beside the drawing",
            "Schreibt in dieses Verzeichnis statt neben die Zeichnung";
    }
}

/// `[limits]`: upper bounds on sizes and times. PB005 names the key if one is exceeded.
pub mod limits {
    use std::time::Duration;

    use crate::config::kinds::{COUNT, SECONDS, SIZE};

    /// Like [`section!`], for limits, which an untrusted configuration may lower but not raise.
    macro_rules! limits {
        ($(
            $(#[doc = $meaning:literal])+
            $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident;
        )*) => {
            section! {
                $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $results;)*
            }

            impl Options {
                /// Reads the limits, and reports those that an untrusted configuration raises above their defaults.
                pub(in crate::config) fn read_lowered(table: &mut Table<'_, '_, '_>) -> Self {
                    let options = Self::read(table);
                    $(if table.is_untrusted() && options.$field.as_ref().is_some_and(|limit| limit.value > $default) {
                        table.report_raised($name, $example);
                    })*
                    options
                }
            }
        };
    }

    limits! {
        /// largest drawing
        file_size: u64 = "file-size", SIZE, 256 << 20, r#""256 MiB""#, Check;
        /// largest number of entities in a drawing
        entities: u64 = "entities", COUNT, 2_000_000, "2_000_000", Check;
        /// largest number of moves of a program, with everything that it embeds
        embedding_moves: u64 = "embedding-moves", COUNT, 50_000_000, "50_000_000", Check;
        /// memory that the moves of one program may take
        program_memory: u64 = "program-memory", SIZE, 1 << 30, r#""1 GiB""#, Check;
        /// largest program that is written
        output_size: u64 = "output-size", SIZE, 256 << 20, r#""256 MiB""#, Emit;
        /// largest number of cells of the material map that `verify` visits
        verify_cells: u64 = "verify-cells", COUNT, 1_000_000_000, "1_000_000_000", Neither;
        /// largest number of pieces into which `verify` divides arcs and slopes, to follow the material
        verify_pieces: u64 = "verify-pieces", COUNT, 5_000_000, "5_000_000", Neither;
        /// largest number of different paths, each with its values, in a program
        embedded_paths: u64 = "embedded-paths", COUNT, 100_000, "100_000", Check;
        /// largest number of files and directories below a searched directory, and in a Git revision
        library_entries: u64 = "library-entries", COUNT, 200_000, "200_000", Neither;
        /// largest .gitignore or .ignore file
        ignore_file_size: u64 = "ignore-file-size", SIZE, 64 << 10, r#""64 KiB""#, Neither;
        /// largest number of bytes in a parameter text
        text_length: u64 = "text-length", COUNT, 65_536, "65_536", Check;
        /// longest time for one path
        seconds_per_path: Duration = "seconds-per-path", SECONDS, Duration::from_mins(1), "60", Check;
    }

    impl Settings {
        /// Returns the upper bound on the size of an output file in bytes.
        pub fn output_size(&self) -> usize {
            usize::try_from(self.output_size.value).unwrap_or(usize::MAX)
        }
    }
}

/// `[emit]`: what `emit` writes without arguments.
pub mod emit {
    use crate::config::kinds::{PATTERNS, choice};
    use crate::config::types::{Pattern, SheetFormat};

    section! {
        /// globs of path names: the paths that `emit` without arguments and `watch --emit` write
        targets: Vec<Pattern> = "targets", PATTERNS, Vec::new(), "[]", Neither;
        /// none | pdf | html | svg: a setup sheet for the machine operator, written beside each program
        sheet: SheetFormat = "sheet", choice::<SheetFormat>(), SheetFormat::No, r#""none""#, Emit;
    }
}

/// `[machine]`: capabilities of the machine, for `emit`, `verify` and time estimates. (book: program/reading)
pub mod machine {
    use crate::config::kinds::{AXES, NOT_NEGATIVE, NUMBER_RANGE, SPEED, WAIT, choice};
    use crate::config::types::{DwellTime, NumberRange};

    section! {
        /// s: how long the spindle takes to reach its speed; posts wait this long after M3
        spin_up: f64 = "spin-up", WAIT, 0.0, "0", Emit;
        /// unit of P in G4 on a controller where it can be set (Mach3: Config > Logic): "seconds" or "milliseconds"
        dwell: DwellTime = "dwell", choice::<DwellTime>(), DwellTime::Seconds, r#""seconds""#, Emit;
        /// mm: smallest and largest X, in the program's coordinates; without it, X is not limited
        x: Option<NumberRange> = "x", NUMBER_RANGE, None, "[0, 300]", Emit;
        /// mm: the same for the Y axis
        y: Option<NumberRange> = "y", NUMBER_RANGE, None, "[0, 200]", Emit;
        /// mm: the same for the Z axis
        z: Option<NumberRange> = "z", NUMBER_RANGE, None, "[0, 60]", Emit;
        /// mm/min: maximum feed
        max_feed: Option<f64> = "maximum-feed", SPEED, None, "1500", Check;
        /// mm: travel of X, Y and Z, wherever the part is clamped; x, y and z are more specific
        travel: Option<[f64; 3]> = "travel", AXES, None, "[300, 200, 60]", Emit;
        /// 1/min: the spindle's slowest and fastest speed
        spindle_speeds: Option<NumberRange> = "spindle-speeds", NUMBER_RANGE, None, "[3000, 24000]", Emit;
        /// mm/min: highest speeds of X, Y and Z; with accelerations, import also states the time on the machine
        rates: Option<[f64; 3]> = "rates", AXES, None, "[3000, 3000, 1000]", Neither;
        /// mm/s²: largest accelerations of X, Y and Z
        accelerations: Option<[f64; 3]> = "accelerations", AXES, None, "[200, 200, 50]", Neither;
        /// mm: how far the controller may cut a corner (GRBL's $11); 0: full stop
        junction_deviation: f64 = "junction-deviation", NOT_NEGATIVE, 0.01, "0.01", Neither;
    }
}

/// `[verify]`: what `verify` must be able to check. (book: program/reading)
pub mod verify {
    use crate::config::kinds::choices;
    use crate::config::types::Requirement;

    section! {
        /// checks without which `verify` fails: rapids, envelope, feeds, spindle, drawing, clamps, corners, coolant; with rapids=assumed,
        /// cutter and surface may come from comments of the program
        require: Vec<Requirement> = "require", choices::<Requirement>(), Vec::new(), r#"["rapids", "envelope"]"#, Neither;
    }
}

/// Tables with user-defined keys.
pub mod tables {
    use pathbuild_diagnostic::Code;
    use pathbuild_post::PostMacro;

    use crate::config::table_kinds::{LINE_TYPES, MACROS, SEVERITY, SEVERITY_IN, TOOLS};
    use crate::config::types::{FileSeverities, Level, LineTypeAlias, Tool};

    section! {
        /// further names: name in the drawing = one of the known line types
        line_types: Vec<LineTypeAlias> = "line-types", LINE_TYPES, Vec::new(), "[line-types]\n\"MITTE\" = \"CENTER\"", Check;
        /// code = "error" | "warning" | "ignore"; errors that protect programs from being wrong
        /// (PB0 to PB609) cannot be lowered
        severity: Vec<(Code, Level)> = "severity", SEVERITY, Vec::new(), "[severity]\nPB210 = \"ignore\"", Neither;
        /// the same for some drawings or programs: globs, relative to this file, which ignore case (old/** is everything in the
        /// directory old and below); with `reason`, and `until` a date, the last day on which it holds
        severity_in: Vec<FileSeverities> = "severity-in", SEVERITY_IN, Vec::new(), "[[severity-in]]\nfiles = [\"old/**\"]\nPB112 = \"ignore\"\nreason = \"milled by hand\"\nuntil = \"2031-12-31\"", Neither;
        /// a tool, for post-processors: found by O (and by paths, a pattern of path names); with shape = "slot" (T-slot cutter,
        /// wider than its shank) its paths are compared with parts only for cuts into them, and with shape = "other" (V-bit,
        /// drill) verify counts only the centre line of its cuts; corner-radius in mm (ball: half the diameter); length of the cutting
        /// edges in mm: a deeper cut is a warning (PB792);
        /// chip-load in mm per tooth: with flutes, feeds outside are a warning (PB790); a cut with the spindle turning against
        /// direction, or counter-clockwise where only spindle is given, is an error of verify (PB783)
        tools: Vec<Tool> = "tool", TOOLS, Vec::new(),
            "[tool.2mm]\ndiameter = 2\nnumber = 1\npaths = '[A-Z]$'\nshape = \"end-mill\"\nspindle = 12000\ndirection = \"cw\"\ncoolant = \"off\"\nflutes = 2\nchip-load = [0.005, 0.02]\ncorner-radius = 0\nlength = 8", Check;
        /// texts for post-processors: a macro {$name}, or ~name~ in control texts; they take precedence over the definition's
        macros: Vec<PostMacro> = "macros", MACROS, Vec::new(), "[macros]\noperator = \"anna\"", Emit;
    }
}

/// `[warnings]`: thresholds beyond which something allowed is doubtful.
pub mod warnings {
    use pathbuild_path::DoubtThresholds;

    use crate::config::kinds::NOT_NEGATIVE;

    const DEFAULT: DoubtThresholds = DoubtThresholds::DEFAULT;

    section! {
        /// mm: how far B may be below the plate (PB211)
        below_plate: f64 = "below-plate", NOT_NEGATIVE, DEFAULT.below_plate, "0.5", Check;
        /// how many times T an infeed I may be at most (PB211)
        infeed: f64 = "infeed", NOT_NEGATIVE, DEFAULT.infeed, "1", Check;
        /// how many times T a mark may be deep at most (PB211)
        mark_depth: f64 = "mark-depth", NOT_NEGATIVE, DEFAULT.mark_depth, "0.5", Check;
        /// mm: by how much a text must be nearer to its element than to another (PB116)
        text_margin: f64 = "text-margin", NOT_NEGATIVE, DEFAULT.text_margin, "0.1", Check;
        /// mm: up to how much larger than the cutter a circle looks like a hole to be drilled (PB118)
        hole_margin: f64 = "hole-margin", NOT_NEGATIVE, DEFAULT.hole_margin, "0.05", Check;
    }
}

/// `[watch]`: how changes are detected.
pub mod watch {
    use std::time::Duration;

    use crate::config::kinds::{DURATION, SWITCH};

    section! {
        /// how long no file may change before drawings are read again
        debounce: Duration = "debounce", DURATION, Duration::from_millis(50), r#""50 ms""#, Neither;
        /// look for changes at intervals (network drives)
        poll: bool = "poll", SWITCH, false, "false", Neither;
    }
}
