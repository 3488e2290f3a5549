//! The keys of all tables, each with its type, default and description.

/// Declares a table of the configuration. Each key has a description and a field, its name in the file, its [`ValueType`], its default, a TOML
/// value for the file that `init` writes, the cached results that depend on it ([`ResultKind`]), and its description in German. Behind ` | `, the
/// German states the default in words where the book cannot show the value.
///
/// [`ValueType`]: super::reader::ValueType
macro_rules! section {
    ($(
        $(#[doc = $meaning:literal])+
        $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident, $german:literal;
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
            $(Key { name: $name, meaning: &[$($meaning),+], german: $german, example: $example, schema: $kind.schema },)*
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

    /// Length in mm of the longest pieces of moves without `z-split`, except with idw4; the description of the key states it.
    pub const Z_SPLIT: f64 = 20.0;

    /// Like [`section!`], for keys that command-line options can set. Such a key also declares its option: whether the value replaces the configured
    /// one or adds to it (a function of [`OptionReader`]), the parser, the values, and the help in both languages.
    macro_rules! overridable {
        ($(
            $(#[doc = $meaning:literal])+
            $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident, $german:literal
                $(, option $applies:ident: $read:expr, $values:expr, $en:literal, $de:literal)?;
        )*) => {
            section! {
                $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $results, $german;)*
            }

            /// Command-line options that set keys.
            pub const OPTIONS: &[SettingOption] = &[
                $($(SettingOption {
                    name: $name,
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
            "mm/min: F, wenn ein Pfad keines angibt; nötig zum Ausgeben, nicht zum Prüfen",
            option replace_value: GivenOption::speed, Text("MM/MIN"), "Milling feed of paths that give none", "Fräsvorschub für Pfade, die keinen angeben";
        /// mm/min: speed of rapid moves, for times; needed to emit
        rapid: Option<f64> = "rapid", SPEED, None, "1000", Emit,
            "mm/min: Geschwindigkeit von Eilgängen, für die Zeiten; nötig zum Ausgeben",
            option replace_value: GivenOption::speed, Text("MM/MIN"), "Speed of rapid moves, for the times shown", "Eilganggeschwindigkeit, für die angezeigten Zeiten";
        /// mm: S of an emitted path that gives none; needed to emit
        sweep_height: Option<f64> = "sweep-height", MEASURE, None, "20", Check,
            "mm: S eines ausgegebenen Pfads ohne S; nötig zum Ausgeben",
            option replace_value: GivenOption::positive_number, Text("MM"), "Sweep height of an emitted path that gives none", "Leerfahrthöhe, wenn der geschriebene Pfad keine angibt";
        /// mm/min: Z of probes without a Z of their own; default: like feed
        probe_feed: Option<f64> = "probe-feed", SPEED, None, "40", Emit,
            "mm/min: Z für Proben ohne eigenes Z | wie `feed`",
            option replace_value: GivenOption::speed, Text("MM/MIN"), "Probing feed of paths that give none", "Vorschub beim Antasten für Pfade, die keinen angeben";
        /// directories that `check` and `emit` use without arguments, and in which paths are found by name;
        /// includes subdirectories, respects .gitignore and .ignore
        library: Directories = "library", DIRECTORIES, Vec::new(), r#"["."]"#, Neither,
            "die Verzeichnisse, die `check` und `emit` ohne Argumente bearbeiten und in denen Pfade gefunden werden; Unterverzeichnisse eingeschlossen, .gitignore und .ignore gelten";
        /// further directories in which embedded paths are looked for, in this order, without subdirectories
        search: Directories = "search", DIRECTORIES, Vec::new(), "[]", Check,
            "weitere Verzeichnisse für eingebettete Pfade, der Reihe nach, ohne Unterverzeichnisse",
            option append_values: |option| Ok(option.directories()), SearchDirectories, "Look for embedded paths in this directory as well (repeatable)",
            "Sucht eingebettete Pfade auch in diesem Verzeichnis (wiederholbar)";
        /// which names are path names
        path_pattern: Box<str> = "path-pattern", REGEX, PathPattern::DEFAULT.into(), "'([0-9]{4})[.]([0-9]+)([A-Z])'", Check,
            "welche Namen Pfadnamen sind (regulärer Ausdruck) | vier Ziffern, Punkt, Zahl, Buchstabe",
            option replace_value: GivenOption::regex, Text("REGEX"), "Regular expression for path names", "Regulärer Ausdruck für Pfadnamen";
        /// which parts of a file name are path names
        file_pattern: Box<str> = "file-pattern", REGEX, FilePattern::DEFAULT.into(), "'([0-9]{4})(?:[.]([0-9]+))?'", Check,
            "welche Teile eines Dateinamens Pfadnamen sind | vier Ziffern, auch mit Punkt und Zahl",
            option replace_value: GivenOption::regex, Text("REGEX"), "Regular expression for path names in file names",
            "Regulärer Ausdruck für Pfadnamen in Dateinamen";
        /// layers with clamps, by their whole names: no move may enter their outlines below the height
        /// that a text such as Z25 gives (PB407)
        keep_out: Option<Box<str>> = "keep-out", OPTIONAL_REGEX, None, "'Clamps.*'", Check,
            "Layer mit Spannmitteln, nach ihrem ganzen Namen: Keine Bewegung darf in ihre Umrisse geraten, solange sie tiefer ist als die Höhe, die ein Text wie Z25 angibt (PB407) | keine";
        /// layers with finished parts, by their whole names: cuts that go through the material are compared with their outlines
        /// (PB213 to PB223); a group in the expression names the path that cuts the part: 'Part_(.*)'
        part: Option<Box<str>> = "part", OPTIONAL_REGEX, None, "'Part.*'", Check,
            "Layer mit fertigen Teilen, nach ihrem ganzen Namen: Schnitte, die durch das Material gehen, werden mit deren Umrissen verglichen (PB213 bis PB223); eine Gruppe im Ausdruck nennt den Pfad, der das Teil fräst: 'Teil_(.*)' | keine";
        /// mm: how far a cut may miss the outline of a part on either side; at least 0.005
        part_tolerance: f64 = "part-tolerance", PART_TOLERANCE, 0.02, "0.02", Check,
            "mm: wie weit ein Schnitt den Umriss eines Teils auf beiden Seiten verfehlen darf; mindestens 0.005";
        /// bars | otherwise (tape, vacuum): what holds a part that is cut all round (PB217)
        part_held: PartHolding = "part-held", choice::<PartHolding>(), PartHolding::Bars, r#""bars""#, Check,
            "bars oder otherwise (Klebeband, Vakuum): was ein rundum gefrästes Teil hält (PB217)";
        /// PARENT:CHILD, split at the first colon: which paths may embed which, such as "^8:P$"
        restrict: Vec<Restriction> = "restrict", RESTRICTIONS, Vec::new(), "[]", Check,
            r#"AUSSEN:INNEN, am ersten Doppelpunkt geteilt: welche Pfade welche einbetten dürfen, etwa "^8:P$" | alles"#,
            option append_values: GivenOption::restrictions, Texts("PARENT:CHILD"),
            "A path whose name matches PARENT may embed only paths whose names match CHILD; both are regular expressions, and configured rules come first (repeatable)",
            "Ein Pfad, auf dessen Namen AUSSEN passt, darf nur Pfade einbetten, auf deren Namen INNEN passt; beides sind reguläre Ausdrücke, und konfigurierte Regeln gelten zuerst (wiederholbar)";
        /// en | de: language of messages; --lang, PATHBUILD_LANG and your own config.toml take precedence
        lang: Lang = "lang", choice::<Lang>(), Lang::En, r#""en""#, Emit,
            "en oder de: Sprache der Meldungen; Vorrang haben `--lang`, `PATHBUILD_LANG` und die eigene config.toml";
        /// en | de: language of comments in programs; without it, `lang` of this file; no option changes it
        comment_lang: Lang = "comment-lang", choice::<Lang>(), Lang::En, r#""en""#, Emit,
            "en oder de: Sprache der Kommentare in Programmen; keine Option ändert sie | wie `lang`";
        /// header (mm or none, otherwise PB113) | drawing (convert) | mm (ignore the drawing's header)
        units: Units = "units", choice::<Units>(), Units::Header, r#""header""#, Check,
            "header (mm oder keine Angabe, sonst PB113), drawing (umrechnen), mm (die Angabe der Zeichnung ignorieren)";
        /// ascii (umlauts transliterated) | utf-8, for written programs
        charset: Charset = "charset", choice::<Charset>(), Charset::Ascii, r#""ascii""#, Emit,
            "ascii (Umlaute umschrieben) oder utf-8, für geschriebene Programme";
        /// mm: tolerance for ELLIPSE and SPLINE on path layers; with 0 they are not part of the path (PB111)
        approximate_curves: f64 = "approximate-curves", NOT_NEGATIVE, 0.0, "0", Check,
            "mm: Toleranz für ELLIPSE und SPLINE auf Pfadlayern; mit 0 gehören sie nicht zum Pfad (PB111)";
        /// mm: ends at most this far apart count as joined, with a warning for each (PB115)
        join_tolerance: f64 = "join-tolerance", NOT_NEGATIVE, 0.0, "0", Check,
            "mm: Enden mit höchstens diesem Abstand gelten als verbunden, mit je einer Warnung (PB115)";
        /// true: programs exactly as PathDxf2GCode writes them, even where it deviates from its manuals
        compatible: bool = "compatible", SWITCH, false, "false", Check,
            "true: Programme genau wie die von PathDxf2GCode",
            option replace_value: |_| Ok(true), Switch, "Write programs exactly as `PathDxf2GCode` does", "Schreibt Programme genau so wie `PathDxf2GCode`";
        /// idw4 | plane | tin: how heights between probes are calculated
        z_model: ZModel = "z-model", choice::<ZModel>(), ZModel::Idw4, r#""idw4""#, Emit,
            "idw4, plane oder tin: wie Höhen zwischen Proben berechnet werden";
        /// mm: longest move that is corrected as a whole; 0: never split; without it 0 for idw4, otherwise 20
        z_split: Option<f64> = "z-split", PIECE, None, "0", Emit,
            "mm: längste Bewegung, die als Ganzes korrigiert wird; 0: nie teilen | idw4: 0, sonst 20";
        /// a built-in post-processor or a file; with further settings { name = "...", unchecked = true, program-number = 8001 }
        /// (unchecked: also write moves that cannot be read back, at your own risk)
        post: PostChoice = "post", POST, "native".into(), r#""native""#, Emit,
            r#"ein eingebauter Postprozessor oder eine Datei; mit weiteren Angaben { name = "...", unchecked = true, program-number = 8001 } (unchecked: auch Programme schreiben, die sich nicht zurücklesen lassen; auf eigene Verantwortung)"#;
        /// tool (the tools' speeds, otherwise PB754) | manual (posts neither start nor stop the spindle)
        spindle: SpindleControl = "spindle", choice::<SpindleControl>(), SpindleControl::Tool, r#""tool""#, Emit,
            "tool (Drehzahlen der Werkzeuge, sonst PB754) oder manual (kein Programm schaltet die Spindel)";
        /// whether holes become canned cycles if the post has them
        cycles: bool = "cycles", SWITCH, false, "false", Check,
            "ob Löcher zu Bohrzyklen werden, wenn der Postprozessor sie hat";
        /// directory for written files; empty: beside the drawing
        out_dir: Option<Utf8PathBuf> = "out-dir", DIRECTORY, None, r#""""#, Emit,
            "wohin Dateien geschrieben werden | neben die Zeichnung",
            option replace_value: |option| Ok(Some(option.directory())), Directory, "Write into this directory instead of beside the drawing",
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
            $field:ident: $type:ty = $name:literal, $kind:expr, $default:expr, $example:literal, $results:ident, $german:literal;
        )*) => {
            section! {
                $($(#[doc = $meaning])+ $field: $type = $name, $kind, $default, $example, $results, $german;)*
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
        file_size: u64 = "file-size", SIZE, 256 << 20, r#""256 MiB""#, Check,
            "größte Zeichnung";
        /// largest number of entities in a drawing
        entities: u64 = "entities", COUNT, 2_000_000, "2_000_000", Check,
            "größte Zahl der Objekte in einer Zeichnung";
        /// largest number of moves of a program, with everything that it embeds
        embedding_moves: u64 = "embedding-moves", COUNT, 50_000_000, "50_000_000", Check,
            "größte Zahl der Bewegungen eines Programms, mit allem Eingebetteten";
        /// memory that the moves of one program may take
        program_memory: u64 = "program-memory", SIZE, 1 << 30, r#""1 GiB""#, Check,
            "Speicher, den die Bewegungen eines Programms belegen dürfen";
        /// largest program that is written
        output_size: u64 = "output-size", SIZE, 256 << 20, r#""256 MiB""#, Emit,
            "größtes Programm, das geschrieben wird";
        /// largest number of cells of the material map that `verify` visits
        verify_cells: u64 = "verify-cells", COUNT, 1_000_000_000, "1_000_000_000", Neither,
            "größte Zahl der Felder der Materialkarte, die `verify` besucht";
        /// largest number of pieces into which `verify` divides arcs and slopes, to follow the material
        verify_pieces: u64 = "verify-pieces", COUNT, 5_000_000, "5_000_000", Neither,
            "größte Zahl der Stücke, in die `verify` Bögen und Schrägen zerlegt, um das Material zu verfolgen";
        /// largest number of different paths, each with its values, in a program
        embedded_paths: u64 = "embedded-paths", COUNT, 100_000, "100_000", Check,
            "größte Zahl verschiedener Pfade in einem Programm, jeder mit seinen Werten";
        /// largest number of files and directories below a searched directory, and in a Git revision
        library_entries: u64 = "library-entries", COUNT, 200_000, "200_000", Neither,
            "größte Zahl der Dateien und Verzeichnisse unter einem durchsuchten Verzeichnis, auch der Dateien einer Git-Revision";
        /// largest .gitignore or .ignore file
        ignore_file_size: u64 = "ignore-file-size", SIZE, 64 << 10, r#""64 KiB""#, Neither,
            "größte .gitignore- oder .ignore-Datei";
        /// largest number of bytes in a parameter text
        text_length: u64 = "text-length", COUNT, 65_536, "65_536", Check,
            "größte Zahl der Bytes eines Parametertexts";
        /// longest time for one path
        seconds_per_path: Duration = "seconds-per-path", SECONDS, Duration::from_mins(1), "60", Check,
            "längste Zeit für einen Pfad";
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
        targets: Vec<Pattern> = "targets", PATTERNS, Vec::new(), "[]", Neither,
            "Muster von Pfadnamen: die Pfade, die `emit` ohne Argumente und `watch --emit` schreiben";
        /// none | pdf | html | svg: a setup sheet for the machine operator, written beside each program
        sheet: SheetFormat = "sheet", choice::<SheetFormat>(), SheetFormat::No, r#""none""#, Emit,
            r#"`"none"`, `"pdf"`, `"html"`, `"svg"`: ein Einrichteblatt neben jedem Programm"#;
    }
}

/// `[machine]`: capabilities of the machine, for `emit`, `verify` and time estimates. (book: program/reading)
pub mod machine {
    use crate::config::kinds::{AXES, NOT_NEGATIVE, NUMBER_RANGE, SPEED, WAIT, choice};
    use crate::config::types::{DwellTime, NumberRange};

    section! {
        /// s: how long the spindle takes to reach its speed; posts wait this long after M3
        spin_up: f64 = "spin-up", WAIT, 0.0, "0", Emit,
            "s: wie lange die Spindel zum Hochlaufen braucht; so lange warten Programme nach M3";
        /// unit of P in G4 on a controller where it can be set (Mach3: Config > Logic): "seconds" or "milliseconds"
        dwell: DwellTime = "dwell", choice::<DwellTime>(), DwellTime::Seconds, r#""seconds""#, Emit,
            r#"die Einheit von P bei G4, wenn sie einstellbar ist (Mach3: Config > Logic): "seconds" oder "milliseconds""#;
        /// mm: smallest and largest X, in the program's coordinates; without it, X is not limited
        x: Option<NumberRange> = "x", NUMBER_RANGE, None, "[0, 300]", Emit,
            "mm: kleinstes und größtes X, in Koordinaten des Programms; ohne Angabe ist X nicht begrenzt";
        /// mm: the same for the Y axis
        y: Option<NumberRange> = "y", NUMBER_RANGE, None, "[0, 200]", Emit,
            "mm: dasselbe für die Y-Achse";
        /// mm: the same for the Z axis
        z: Option<NumberRange> = "z", NUMBER_RANGE, None, "[0, 60]", Emit,
            "mm: dasselbe für die Z-Achse";
        /// mm/min: maximum feed
        max_feed: Option<f64> = "maximum-feed", SPEED, None, "1500", Check,
            "mm/min: maximaler Vorschub";
        /// mm: travel of X, Y and Z, wherever the part is clamped; x, y and z are more specific
        travel: Option<[f64; 3]> = "travel", AXES, None, "[300, 200, 60]", Emit,
            "mm: Verfahrwege von X, Y und Z, gleich wo das Teil gespannt ist; `x`, `y` und `z` sind genauer";
        /// 1/min: the spindle's slowest and fastest speed
        spindle_speeds: Option<NumberRange> = "spindle-speeds", NUMBER_RANGE, None, "[3000, 24000]", Emit,
            "1/min: kleinste und größte Drehzahl";
        /// mm/min: highest speeds of X, Y and Z; with accelerations, import also states the time on the machine
        rates: Option<[f64; 3]> = "rates", AXES, None, "[3000, 3000, 1000]", Neither,
            "mm/min: größte Geschwindigkeiten von X, Y und Z; mit `accelerations` nennt `import` auch die Zeit auf der Maschine";
        /// mm/s²: largest accelerations of X, Y and Z
        accelerations: Option<[f64; 3]> = "accelerations", AXES, None, "[200, 200, 50]", Neither,
            "mm/s²: größte Beschleunigungen von X, Y und Z";
        /// mm: how far the controller may cut a corner (GRBL's $11); 0: full stop
        junction_deviation: f64 = "junction-deviation", NOT_NEGATIVE, 0.01, "0.01", Neither,
            "mm: wie weit die Steuerung eine Ecke abkürzen darf (GRBL: $11); 0: voller Halt";
    }
}

/// `[verify]`: what `verify` must be able to check. (book: program/reading)
pub mod verify {
    use crate::config::kinds::choices;
    use crate::config::types::Requirement;

    section! {
        /// checks without which `verify` fails: rapids, envelope, feeds, spindle, drawing, clamps, corners, coolant; with rapids=assumed,
        /// cutter and surface may come from comments of the program
        require: Vec<Requirement> = "require", choices::<Requirement>(), Vec::new(), r#"["rapids", "envelope"]"#, Neither,
            "Prüfungen, ohne die `verify` scheitert: rapids, envelope, feeds, spindle, drawing, clamps, corners, coolant; mit rapids=assumed dürfen Fräser und Oberfläche aus Kommentaren des Programms stammen";
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
        line_types: Vec<LineTypeAlias> = "line-types", LINE_TYPES, Vec::new(), "[line-types]\n\"MITTE\" = \"CENTER\"", Check,
            "weitere Namen: Name in der Zeichnung = einer der bekannten Linientypen";
        /// code = "error" | "warning" | "ignore"; errors that protect programs from being wrong
        /// (PB0 to PB609) cannot be lowered
        severity: Vec<(Code, Level)> = "severity", SEVERITY, Vec::new(), "[severity]\nPB210 = \"ignore\"", Neither,
            r#"Code = "error", "warning" oder "ignore", etwa PB210 = "ignore"; Fehler PB0 bis PB609 lassen sich nicht senken"#;
        /// the same for some drawings or programs: globs, relative to this file, which ignore case (old/** is everything in the
        /// directory old and below); with `reason`, and `until` a date, the last day on which it holds
        severity_in: Vec<FileSeverities> = "severity-in", SEVERITY_IN, Vec::new(), "[[severity-in]]\nfiles = [\"old/**\"]\nPB112 = \"ignore\"\nreason = \"milled by hand\"\nuntil = \"2031-12-31\"", Neither,
            r#"dasselbe für einige Zeichnungen oder Programme, etwa PB112 = "ignore"; `files`: Muster von Dateinamen, relativ zu dieser Datei, ohne Unterschied von Groß- und Kleinschreibung (`old/**` ist alles im Verzeichnis old und darunter); `reason`: der Grund; `until`: ein Datum, der letzte Tag, an dem es gilt"#;
        /// a tool, for post-processors: found by O (and by paths, a pattern of path names); with shape = "slot" (T-slot cutter,
        /// wider than its shank) its paths are compared with parts only for cuts into them, and with shape = "other" (V-bit,
        /// drill) verify counts only the centre line of its cuts; corner-radius in mm (ball: half the diameter); length of the cutting
        /// edges in mm: a deeper cut is a warning (PB792);
        /// chip-load in mm per tooth: with flutes, feeds outside are a warning (PB790); a cut with the spindle turning against
        /// direction, or counter-clockwise where only spindle is given, is an error of verify (PB783)
        tools: Vec<Tool> = "tool", TOOLS, Vec::new(),
            "[tool.2mm]\ndiameter = 2\nnumber = 1\npaths = '[A-Z]$'\nshape = \"end-mill\"\nspindle = 12000\ndirection = \"cw\"\ncoolant = \"off\"\nflutes = 2\nchip-load = [0.005, 0.02]\ncorner-radius = 0\nlength = 8", Check,
            "ein Werkzeug für Postprozessoren; der Name ist frei wählbar (Schlüssel: nächster Abschnitt)";
        /// texts for post-processors: a macro {$name}, or ~name~ in control texts; they take precedence over the definition's
        macros: Vec<PostMacro> = "macros", MACROS, Vec::new(), "[macros]\noperator = \"anna\"", Emit,
            "Texte für Postprozessoren, etwa `operator`: ein Makro {$name} oder ~name~ in Steuertexten; sie haben Vorrang vor denen der Definition";
    }
}

/// `[warnings]`: thresholds beyond which something allowed is doubtful.
pub mod warnings {
    use pathbuild_path::DoubtThresholds;

    use crate::config::kinds::NOT_NEGATIVE;

    const DEFAULT: DoubtThresholds = DoubtThresholds::DEFAULT;

    /// Like [`section!`], for thresholds: fields of [`DoubtThresholds`], which has their defaults.
    macro_rules! thresholds {
        ($($(#[doc = $meaning:literal])+ $field:ident = $name:literal, $example:literal, $german:literal;)*) => {
            section! {
                $($(#[doc = $meaning])+ $field: f64 = $name, NOT_NEGATIVE, DEFAULT.$field, $example, Check, $german;)*
            }

            impl Settings {
                /// Returns the thresholds; those that other tables set have their defaults.
                pub fn thresholds(&self) -> DoubtThresholds {
                    DoubtThresholds { $($field: self.$field.value,)* ..DEFAULT }
                }
            }
        };
    }

    thresholds! {
        /// mm: how far B may be below the plate (PB211)
        below_plate = "below-plate", "0.5",
            "mm: wie weit B unter der Platte liegen darf (PB211)";
        /// how many times T an infeed I may be at most (PB211)
        infeed = "infeed", "1",
            "bis zum Wievielfachen von T die Zustellung I gehen darf (PB211)";
        /// how many times T a mark may be deep at most (PB211)
        mark_depth = "mark-depth", "0.5",
            "bis zum Wievielfachen von T eine Markierung tief sein darf (PB211)";
        /// mm: by how much a text must be nearer to its element than to another (PB116)
        text_margin = "text-margin", "0.1",
            "mm: um wie viel ein Text seinem Element näher sein muss als einem anderen (PB116)";
        /// mm: up to how much larger than the cutter a circle looks like a hole to be drilled (PB118)
        hole_margin = "hole-margin", "0.05",
            "mm: bis zu welchem Übermaß gegenüber dem Fräser ein Kreis wie ein Bohrloch aussieht (PB118)";
    }
}

/// `[watch]`: how changes are detected.
pub mod watch {
    use std::time::Duration;

    use crate::config::kinds::{DURATION, SWITCH};

    section! {
        /// how long no file may change before drawings are read again
        debounce: Duration = "debounce", DURATION, Duration::from_millis(50), r#""50 ms""#, Neither,
            "wie lange sich nichts ändern darf, bevor Zeichnungen neu gelesen werden";
        /// look for changes at intervals (network drives)
        poll: bool = "poll", SWITCH, false, "false", Neither,
            "in festen Abständen nach Änderungen sehen (Netzlaufwerke)";
    }
}
