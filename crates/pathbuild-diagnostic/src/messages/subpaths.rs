//! Messages about embedding. (PB501 to PB511)

messages! {
    /// A subpath without `>`.
    MISSING_NAME: MissingSubpathName {
        en: "the subpath does not say which path to embed",
        de: "der Unterpfad sagt nicht, welcher Pfad einzubetten ist",
        help_en: "put a text over it: \">1234.1P\"; or make it DOT to skip it, DASHED for a sweep",
        help_de: "einen Text darüberlegen: \">1234.1P\"; oder DOT, um ihn auszulassen, DASHED für eine Leerfahrt",
    }
    /// `>` without a path name.
    INVALID_NAME: InvalidPathName {
        en: "\"{value}\" is not a path name",
        de: "\"{value}\" ist kein Pfadname",
        help_en: "path names match {pattern}",
        help_de: "Pfadnamen entsprechen {pattern}",
    }
    /// Further text after the name.
    MORE_THAN_NAME: InvalidPathName {
        en: "\"{value}\" is read as {name}; the rest is ignored",
        de: "\"{value}\" wird als {name} gelesen; der Rest wird nicht beachtet",
        help_en: "separate parameters from the name by a space",
        help_de: "Parameter durch ein Leerzeichen vom Namen trennen",
    }
    /// A name that is only part of a word.
    NAME_GOES_ON: InvalidPathName {
        en: "\"{value}\" is not a path name, only its part {name}",
        de: "\"{value}\" ist kein Pfadname, nur der Teil {name}",
        help_en: "write the name of the path, and a space before what follows",
        help_de: "den Namen des Pfads schreiben und vor dem, was folgt, ein Leerzeichen",
    }
    /// A path that is not found.
    NOT_FOUND: PathNotFound {
        en: "path {name} was not found",
        de: "Pfad {name} wurde nicht gefunden",
        help_en: "searched in {directories}; files whose names admit it: {files}",
        help_de: "gesucht in {directories}; Dateien, deren Namen ihn zulassen: {files}",
    }
    /// Note: similar names.
    NEAR_NAMES: PathNotFound {
        en: "similar names: {names}",
        de: "ähnliche Namen: {names}",
    }
    /// Note: the paths of the drawings that were searched, none of them with a similar name.
    NAMES_THERE: PathNotFound {
        en: "paths in the drawings that may hold it by their names: {names}",
        de: "Pfade in den Zeichnungen, die ihn dem Namen nach enthalten können: {names}",
    }
    /// Note: the path is elsewhere in the library.
    ELSEWHERE: PathNotFound {
        en: "the library contains it in {file}: add {directory} to `search`",
        de: "die Bibliothek enthält ihn in {file}: {directory} zu `search` hinzufügen",
    }
    /// A path that is defined twice.
    DEFINED_TWICE: PathDefinedTwice {
        en: "path {name} is defined twice: in {first} and in {second}",
        de: "Pfad {name} ist zweimal festgelegt: in {first} und in {second}",
        help_en: "rename or remove one of them",
        help_de: "einen davon umbenennen oder entfernen",
    }
    /// A segment with another length than its path.
    SIZE_DIFFERS: SubpathSizeDiffers {
        en: "the segment is {segment} mm long, but path {name} is {path} mm from start to end",
        de: "das Segment ist {segment} mm lang, Pfad {name} aber {path} mm von Anfang bis Ende",
        help_en: "draw the segment from where the path starts to where it ends: copy the component's proxy line",
        help_de: "das Segment vom Anfang des Pfads bis zu seinem Ende zeichnen: die Stellvertreterlinie des Bauteils kopieren",
    }
    /// A segment with another cutter than its path.
    CUTTER_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "one cutter mills both paths: give both the same O, or embed a component that is drawn for this cutter",
        help_de: "ein Fräser fräst beide Pfade: beiden dasselbe O geben oder ein Bauteil einbetten, das für diesen Fräser gezeichnet ist",
    }
    /// An embedding path with another cutter, regardless of its segment.
    CUTTER_OF_PROJECT: SubpathParameterDiffers {
        en: "path {name} is drawn for a cutter of {there} mm, but path {outer} has O{here}",
        de: "Pfad {name} ist für einen Fräser von {there} mm gezeichnet, Pfad {outer} aber hat O{here}",
        help_en: "a program has one cutter: embed the path in a project with its O, and write both programs into one with --join",
        help_de: "ein Programm hat einen Fräser: den Pfad in einem Projekt mit seinem O einbetten und beide Programme mit --join zusammen schreiben",
    }
    /// A segment with another thickness than its path.
    THICKNESS_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "both paths are milled from the same sheet: give both the same T, or embed a component that is drawn for this thickness",
        help_de: "beide Pfade werden aus derselben Platte gefräst: beiden dasselbe T geben oder ein Bauteil einbetten, das für diese Dicke gezeichnet ist",
    }
    /// A segment with another T, O or M than its path.
    PARAMETER_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "write the path's {letter} on the segment, if it really is milled from that; else use another component",
        help_de: "das {letter} des Pfads an das Segment schreiben, wenn wirklich daraus gefräst wird; sonst ein anderes Bauteil verwenden",
    }
    /// An embedding that E or --restrict forbids.
    FORBIDDEN: SubpathForbidden {
        en: "path {name} may not be embedded here: it does not match {rule}",
        de: "Pfad {name} darf hier nicht eingebettet werden: er entspricht nicht {rule}",
        help_en: "the rule is the path's E, or --restrict (`restrict` in pathbuild.toml)",
        help_de: "die Regel ist das E des Pfads oder --restrict (`restrict` in pathbuild.toml)",
    }
    /// Embedding that is nested too deeply.
    TOO_DEEP: NestingTooDeep {
        en: "path {name} is embedded more than {limit} levels deep: {chain}",
        de: "Pfad {name} ist mehr als {limit} Ebenen tief eingebettet: {chain}",
        help_en: "embed it in a project nearer to the outermost",
        help_de: "in einem Projekt einbetten, das dem äußersten näher ist",
    }
    /// A path that embeds itself.
    CYCLE: SubpathCycle {
        en: "path {name} embeds itself: {chain}",
        de: "Pfad {name} bettet sich selbst ein: {chain}",
        help_en: "remove one of these embeddings",
        help_de: "eine dieser Einbettungen entfernen",
    }
    /// A segment with a greater T than the embedding path.
    T_BELOW: PathTBelowSubpathT {
        en: "T of this path is {path}, which is less than the subpath's {segment}",
        de: "T dieses Pfads ist {path} und damit kleiner als {segment} beim Unterpfad",
        help_en: "the outer path's sweeps would run through the inner path's material; raise the path's T",
        help_de: "die Leerfahrten des äußeren Pfads würden durch das Material des inneren laufen; T des Pfads erhöhen",
    }
    /// An embedded path with errors.
    HAS_ERRORS: SubpathHasErrors {
        en: "the embedded path {name} has errors",
        de: "der eingebettete Pfad {name} hat Fehler",
        help_en: "they are reported with {file}",
        help_de: "sie werden bei {file} gemeldet",
    }
}
