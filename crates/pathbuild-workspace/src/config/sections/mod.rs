//! The keys of all tables, each with its type, default and description.

/// Declares a table of the configuration. Each key has: a description and a field, its name in the file, its [`ValueType`], its default, a
/// TOML value for the file that `init` writes, and the cached results that depend on it ([`ResultKind`]).
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

        /// The values that a source sets.
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

            pub(in crate::config) fn over(self, below: Self) -> Self {
                Self { $($field: self.$field.or(below.$field),)* }
            }

            pub(in crate::config) fn resolve(self) -> Settings {
                Settings { $($field: self.$field.unwrap_or_else(|| SourcedValue::default($default)),)* }
            }
        }

        impl Settings {
            /// The keys with their values as TOML.
            pub(in crate::config) fn shown(&self) -> Vec<ShownSetting> {
                vec![$(ShownSetting { name: $name, value: ($kind.show)(&self.$field.value), origin: self.$field.origin },)*]
            }
        }

        impl Settings {
            /// Passes the values that cached results of the command `result_kind` depend on to `add`.
            pub(in crate::config) fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
                $(if ResultKind::$results.is_part_of(result_kind) {
                    add($name, &self.$field.value);
                })*
            }
        }

        /// Descriptions of the keys.
        pub(in crate::config) const KEYS: &[Key] = &[
            $(Key { name: $name, meaning: &[$($meaning),+], example: $example, schema: $kind.schema },)*
        ];
    };
}

pub mod general;
pub mod limits;

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
    use crate::config::kinds::{AXES, EXTENT, NOT_NEGATIVE, POSITIVE, choice};
    use crate::config::types::{DwellTime, Extent};

    section! {
        /// s: how long the spindle takes to reach its speed; posts wait this long after M3
        spin_up: f64 = "spin-up", NOT_NEGATIVE, 0.0, "0", Emit;
        /// unit of P in G4 on a controller where it can be set (Mach3: Config > Logic): "seconds" or "milliseconds"
        dwell: DwellTime = "dwell", choice::<DwellTime>(), DwellTime::Seconds, r#""seconds""#, Emit;
        /// mm: smallest and largest X, in the program's coordinates; without it, X is not limited
        x: Option<Extent> = "x", EXTENT, None, "[0, 300]", Emit;
        /// mm: the same for the Y axis
        y: Option<Extent> = "y", EXTENT, None, "[0, 200]", Emit;
        /// mm: the same for the Z axis
        z: Option<Extent> = "z", EXTENT, None, "[0, 60]", Emit;
        /// mm/min: largest feed
        max_feed: Option<f64> = "maximum-feed", POSITIVE, None, "1500", Check;
        /// mm: travel of X, Y and Z, wherever the part is clamped; x, y and z are more specific
        travel: Option<[f64; 3]> = "travel", AXES, None, "[300, 200, 60]", Emit;
        /// 1/min: the spindle's slowest and fastest speed
        spindle_speeds: Option<Extent> = "spindle-speeds", EXTENT, None, "[3000, 24000]", Emit;
        /// mm/min: highest speeds of X, Y and Z; with accelerations, times are those of the machine
        rates: Option<[f64; 3]> = "rates", AXES, None, "[3000, 3000, 1000]", Neither;
        /// mm/s²: largest accelerations of X, Y and Z
        accelerations: Option<[f64; 3]> = "accelerations", AXES, None, "[200, 200, 50]", Neither;
        /// mm: how far the controller may cut a corner (GRBL's $11); 0: full stop
        junction_deviation: f64 = "junction-deviation", NOT_NEGATIVE, 0.01, "0.01", Neither;
    }
}

/// Tables with user-defined keys.
pub mod tables {
    use pathbuild_diagnostic::Code;

    use crate::config::table_kinds::{LINE_TYPES, MACROS, SEVERITY, SEVERITY_IN, TOOLS};
    use crate::config::types::{Level, LineTypeAlias, Macro, SeveritiesIn, Tool};

    section! {
        /// further names: name in the drawing = one of the known line types
        line_types: Vec<LineTypeAlias> = "line-types", LINE_TYPES, Vec::new(), "[line-types]\n\"MITTE\" = \"CENTER\"", Check;
        /// code = "error" | "warning" | "ignore"; errors that protect programs from being wrong
        /// (PB0 to PB5) cannot be lowered
        severity: Vec<(Code, Level)> = "severity", SEVERITY, Vec::new(), "[severity]\nPB210 = \"ignore\"", Neither;
        /// the same for some drawings: globs, relative to this file
        severity_in: Vec<SeveritiesIn> = "severity-in", SEVERITY_IN, Vec::new(), "[[severity-in]]\nfiles = [\"old/**\"]\nPB112 = \"ignore\"", Neither;
        /// a tool, for post-processors: found by O (and by paths, a pattern of path names)
        tools: Vec<Tool> = "tool", TOOLS, Vec::new(),
            "[tool.2mm]\ndiameter = 2\nnumber = 1\npaths = '[A-Z]$'\nspindle = 12000\ndirection = \"cw\"\ncoolant = \"off\"", Emit;
        /// texts for post-processors: a macro {$name}, or ~name~ in control texts; they take precedence over the definition's
        macros: Vec<Macro> = "macros", MACROS, Vec::new(), "[macros]\noperator = \"anna\"", Emit;
    }
}

/// `[warnings]`: thresholds beyond which something allowed is doubtful.
pub mod warnings {
    use crate::config::kinds::NOT_NEGATIVE;

    section! {
        /// mm: how far B may be below the plate (PB211)
        below_plate: f64 = "below-plate", NOT_NEGATIVE, 0.5, "0.5", Check;
        /// how many times T an infeed I may be at most (PB211)
        infeed: f64 = "infeed", NOT_NEGATIVE, 1.0, "1", Check;
        /// how many times T a mark may be deep at most (PB211)
        mark_depth: f64 = "mark-depth", NOT_NEGATIVE, 0.5, "0.5", Check;
        /// mm: by how much a text must be nearer to its element than to another (PB116)
        text_margin: f64 = "text-margin", NOT_NEGATIVE, 0.1, "0.1", Check;
        /// mm: up to how much larger than the cutter a circle looks like a hole to be drilled (PB118)
        hole_margin: f64 = "hole-margin", NOT_NEGATIVE, 0.05, "0.05", Check;
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
