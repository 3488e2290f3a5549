//! What is emitted, and Q-projects. (PB512 to PB520)

messages! {
    /// Several paths in a drawing.
    SEVERAL_PATHS: SeveralPaths {
        en: "the drawing holds several paths: {names}",
        de: "die Zeichnung enthält mehrere Pfade: {names}",
        help_en: "name the paths to emit: pathbuild emit {first}",
        help_de: "die gewünschten Pfade nennen: pathbuild emit {first}",
    }
    /// No path in a drawing.
    NO_PATH: NoPath {
        en: "the drawing holds no path",
        de: "die Zeichnung enthält keinen Pfad",
        help_en: "a path's layer has a name that matches {pattern}",
        help_de: "der Layer eines Pfads hat einen Namen, der {pattern} entspricht",
    }
    /// A pattern of targets that no path has.
    NO_TARGET: NoPath {
        en: "no path of the library matches the target {pattern}",
        de: "kein Pfad der Bibliothek entspricht dem Ziel {pattern}",
        help_en: "targets are patterns of path names: * is any text, ? one character",
        help_de: "Ziele sind Muster von Pfadnamen: * ist beliebiger Text, ? ein Zeichen",
    }
    /// A name on the command line that nothing has.
    NO_SUCH_PATH: PathNotFound {
        en: "there is no path or drawing {name}",
        de: "es gibt keinen Pfad und keine Zeichnung {name}",
        help_en: "looked in {directories}",
        help_de: "gesucht in {directories}",
    }
    /// Two outputs of one name.
    SAME_OUTPUT: SameOutput {
        en: "{name} would be written by {first} and by {second}",
        de: "{name} würde von {first} und von {second} geschrieben",
        help_en: "give one of them an R (a suffix of the output's name), or use --out-dir in separate runs",
        help_de: "einem davon ein R geben (Zusatz zum Namen der Ausgabe), oder --out-dir in getrennten Läufen verwenden",
    }
    /// Output that nothing writes any more.
    STALE: StaleOutput {
        en: "{name} was written earlier, and nothing would write it now",
        de: "{name} wurde früher geschrieben, jetzt würde es nichts mehr schreiben",
        help_en: "check that nobody needs it; emit --remove-stale removes such files",
        help_de: "prüfen, ob es noch jemand braucht; emit --remove-stale entfernt solche Dateien",
    }
}
