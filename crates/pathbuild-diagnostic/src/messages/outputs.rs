//! Messages about output files and Q-projects. (PB512 to PB528)

messages! {
    /// A drawing with several paths where one is needed.
    SEVERAL_PATHS: SeveralPaths {
        en: "the drawing contains several paths: {names}",
        de: "die Zeichnung enthält mehrere Pfade: {names}",
        help_en: "name a path instead of the drawing, for example {first}",
        help_de: "statt der Zeichnung einen Pfad nennen, zum Beispiel {first}",
    }
    /// A pattern that matches several paths, where exactly one is needed.
    SEVERAL_MATCHES: SeveralPaths {
        en: "{pattern} matches several paths or drawings: {names}",
        de: "{pattern} passt auf mehrere Pfade oder Zeichnungen: {names}",
        help_en: "name one of them",
        help_de: "einen davon nennen",
    }
    /// A drawing in which no layer has the name of a path.
    NO_PATH: NoPath {
        en: "the drawing contains no path",
        de: "die Zeichnung enthält keinen Pfad",
        help_en: "give the layer of each path a name that matches {pattern}",
        help_de: "dem Layer jedes Pfads einen Namen geben, der {pattern} entspricht",
    }
    /// Searched directories that contain no drawing.
    NO_DRAWING: NothingFound {
        en: "there is no drawing in {directories}",
        de: "in {directories} gibt es keine Zeichnung",
        help_en: "name a directory with .dxf files; hidden files and those that .gitignore or .ignore excludes do not count",
        help_de: "ein Verzeichnis mit .dxf-Dateien nennen; versteckte und durch .gitignore oder .ignore ausgeschlossene Dateien zählen nicht",
    }
    /// A searched directory that contains no program.
    NO_PROGRAM: NothingFound {
        en: "there is no G-code program in {directory}",
        de: "in {directory} gibt es kein G-Code-Programm",
        help_en: "name a directory that holds .nc, .ngc, .gcode, .tap, .cnc or .din files or those of your post, or the program itself; hidden files and those that .ignore excludes do not count",
        help_de: "ein Verzeichnis mit .nc-, .ngc-, .gcode-, .tap-, .cnc- oder .din-Dateien oder solchen des eigenen Postprozessors nennen, oder das Programm selbst; versteckte und durch .ignore ausgeschlossene Dateien zählen nicht",
    }
    /// Drawings none of which contains a path.
    NO_PATH_ANYWHERE: NothingFound {
        en: "no drawing contains a path; drawings that were read: {count}",
        de: "keine Zeichnung enthält einen Pfad; gelesene Zeichnungen: {count}",
        help_en: "give the layer of each path a name that matches {pattern}, or set another pattern with `path-pattern` in pathbuild.toml",
        help_de: "dem Layer jedes Pfads einen Namen geben, der {pattern} entspricht, oder mit `path-pattern` in pathbuild.toml ein anderes Muster setzen",
    }
    /// A pattern for clamps that matches no layer of the library.
    NO_CLAMP_LAYER: PatternWithoutLayer {
        en: "`keep-out` ({pattern}) matches no layer in any drawing of the library, so collisions with clamps are not checked",
        de: "`keep-out` ({pattern}) passt in keiner Zeichnung der Bibliothek auf einen Layer: Kollisionen mit Spannmitteln werden nicht geprüft",
        help_en: "correct the pattern, which must match the whole name of a layer, or remove the key",
        help_de: "das Muster berichtigen, das auf den ganzen Namen eines Layers passen muss, oder den Schlüssel entfernen",
    }
    /// A pattern for finished parts that matches no layer of the library.
    NO_PART_LAYER: PatternWithoutLayer {
        en: "`part` ({pattern}) matches no layer in any drawing of the library, so no cut is compared with a finished part",
        de: "`part` ({pattern}) passt in keiner Zeichnung der Bibliothek auf einen Layer: kein Schnitt wird mit einem fertigen Teil verglichen",
        help_en: "correct the pattern, which must match the whole name of a layer, or remove the key",
        help_de: "das Muster berichtigen, das auf den ganzen Namen eines Layers passen muss, oder den Schlüssel entfernen",
    }
    /// A path that the file's name contains, but not the drawing.
    PROMISED_PATH: PromisedPath {
        en: "the file is named after path {name}, but the drawing has nothing on a layer of that name",
        de: "der Dateiname nennt den Pfad {name}, die Zeichnung enthält aber nichts auf einem Layer dieses Namens",
        help_en: "rename the layer, or the file",
        help_de: "den Layer oder die Datei umbenennen",
    }
    /// Note: a layer with a similar name.
    NEAR_LAYER: PromisedPath {
        en: "layer {layer} has a similar name",
        de: "Layer {layer} heißt ähnlich",
    }
    /// Note: a layer name with a character of another alphabet.
    LOOK_ALIKE_LAYER: PromisedPath {
        en: "layer {layer} has a similar name: \"{character}\" ({code}) only looks like \"{plain}\"",
        de: "Layer {layer} heißt ähnlich: \"{character}\" ({code}) sieht nur aus wie \"{plain}\"",
    }
    /// A path that other drawings cannot find, because the file's name does not contain its name.
    STRAY_PATH: StrayPath {
        en: "other drawings cannot embed path {name}: its name is not in the name of this file",
        de: "andere Zeichnungen können Pfad {name} nicht einbetten: sein Name steht nicht im Namen dieser Datei",
        help_en: "put the path's name into the file's name, or correct the layer's name",
        help_de: "den Namen des Pfads in den Dateinamen aufnehmen oder den Namen des Layers berichtigen",
    }
    /// A target pattern that matches no path.
    NO_TARGET: NoPath {
        en: "no path of the library matches the target {pattern}",
        de: "kein Pfad der Bibliothek entspricht dem Ziel {pattern}",
        help_en: "give a pattern of path names: * stands for any text, ? for one character",
        help_de: "ein Muster von Pfadnamen angeben: * steht für beliebigen Text, ? für ein Zeichen",
    }
    /// A name on the command line that is neither a path nor a drawing.
    NO_SUCH_PATH: PathNotFound {
        en: "there is no path or drawing {name}",
        de: "es gibt keinen Pfad und keine Zeichnung {name}",
        help_en: "check the name; pathbuild searched in {directories}",
        help_de: "den Namen prüfen; gesucht wurde in {directories}",
    }
    /// A pattern that no path matches.
    NO_PATH_LIKE: PathNotFound {
        en: "no path matches {name}",
        de: "kein Pfad entspricht {name}",
        help_en: "`pathbuild list` shows all paths; * stands for any characters, ? for one",
        help_de: "mit `pathbuild list` alle Pfade anzeigen; * steht für beliebige Zeichen, ? für eines",
    }
    /// Note: the drawing that defines the path.
    DEFINED_IN: PathNotFound {
        en: "the library defines the path in {near}: specify this drawing instead",
        de: "die Bibliothek enthält den Pfad in {near}: diese Zeichnung angeben",
    }
    /// Note: the drawing that defines the path, although the file's name does not contain the path's name.
    NOT_IN_FILE_NAME: PathNotFound {
        en: "{near} defines the path, although its file name does not contain the path's name: specify this drawing instead",
        de: "{near} enthält den Pfad, obwohl der Dateiname ihn nicht nennt: diese Zeichnung angeben",
    }
    /// Note: the drawing that defines the path, in a directory that is not searched.
    NOT_SEARCHED: PathNotFound {
        en: "{near} defines the path, but its directory is not searched: specify this drawing instead, or list the directory under `library` in pathbuild.toml",
        de: "{near} enthält den Pfad, aber das Verzeichnis wird nicht durchsucht: diese Zeichnung angeben oder das Verzeichnis unter `library` in pathbuild.toml aufführen",
    }
    /// Note: the path with the most similar name.
    NEAR_PATH: PathNotFound {
        en: "did you mean {near}?",
        de: "ist {near} gemeint?",
    }
    /// Two programs with the same file name.
    SAME_OUTPUT: SameOutput {
        en: "{name} would be written by {first} and by {second}",
        de: "{name} würde von {first} und von {second} geschrieben",
        help_en: "give one of them an R (a suffix of the output's name), or use --out-dir in separate runs",
        help_de: "einem davon ein R geben (Zusatz zum Namen der Ausgabe) oder --out-dir in getrennten Läufen verwenden",
    }
    /// Several programs with one number, by which a control tells programs apart.
    NUMBER_SHARED: ProgramNumber {
        en: "{count} programs have the number O{number}, such as {first} and {second}: on the control, one replaces the other",
        de: "{count} Programme haben die Nummer O{number}, etwa {first} und {second}: in der Steuerung ersetzt eines das andere",
        help_en: "leave out `program-number` and give the paths names whose first numbers differ, or join the programs with --join",
        help_de: "`program-number` weglassen und den Pfaden Namen mit verschiedener erster Zahl geben, oder die Programme mit --join verbinden",
    }
    /// A program with a number from 9000 to 9999.
    NUMBER_RESERVED: ProgramNumber {
        en: "{name} has the program number O{number}, but O9000 to O9999 are macros of the control, which are locked or would be overwritten",
        de: "{name} hat die Programmnummer O{number}, aber O9000 bis O9999 sind Makros der Steuerung, die gesperrt sind oder überschrieben würden",
        help_en: "give the path another name, or set `program-number` under [post] in pathbuild.toml",
        help_de: "dem Pfad einen anderen Namen geben oder `program-number` unter [post] in pathbuild.toml setzen",
    }
    /// A joined program with the file name of a path's program.
    JOINED_LIKE_PATH: SameOutput {
        en: "{name} is the file of path {path}, so joined paths cannot be written into it",
        de: "{name} ist die Datei des Pfads {path}, deshalb können keine verbundenen Pfade hineingeschrieben werden",
        help_en: "give --join a name that no path and no drawing has",
        help_de: "mit --join einen Namen angeben, den kein Pfad und keine Zeichnung hat",
    }
    /// An output file from an earlier run that no path would write now.
    STALE: StaleOutput {
        en: "{name} was written earlier, but no path would write it now",
        de: "{name} wurde früher geschrieben, aber kein Pfad würde es jetzt noch schreiben",
        help_en: "check that it is no longer needed; emit --remove-stale removes such files",
        help_de: "prüfen, ob es noch gebraucht wird; emit --remove-stale entfernt solche Dateien",
    }
    /// A program that no path would write now, in a file with a name that `emit` does not give to it.
    STALE_COPY: StaleOutput {
        en: "{name} contains an outdated program, which no path writes any more; emit would not give it this name, so it may be a copy",
        de: "{name} enthält ein veraltetes Programm, das kein Pfad mehr schreibt; emit gäbe ihm nicht diesen Namen, es kann also eine Kopie sein",
        help_en: "check that it is no longer needed, and delete it yourself: emit --remove-stale keeps files that may be copies",
        help_de: "prüfen, ob es noch gebraucht wird, und es selbst löschen: emit --remove-stale lässt Dateien stehen, die Kopien sein können",
    }
    /// The current program of a path, in a file with a name that `emit` does not give to it.
    CURRENT_COPY: StaleOutput {
        en: "{name} contains the current program of path {path}; emit would not give it this name, so it may be a copy, which is not kept up to date",
        de: "{name} enthält das aktuelle Programm von Pfad {path}; emit gäbe ihm nicht diesen Namen, es kann also eine Kopie sein, die nicht aktuell gehalten wird",
        help_en: "mill with the file that emit writes, and delete {name} yourself: emit --remove-stale keeps files that may be copies",
        help_de: "mit der Datei fräsen, die emit schreibt, und {name} selbst löschen: emit --remove-stale lässt Dateien stehen, die Kopien sein können",
    }
    /// A program of a path that is not selected and yields another program now.
    STALE_UNSELECTED: StaleOutput {
        en: "{name} is out of date: path {path} yields another program now, which emit does not write because no pattern in `[emit] targets` matches the path",
        de: "{name} ist veraltet: Pfad {path} ergibt jetzt ein anderes Programm, das emit nicht schreibt, weil kein Muster in `[emit] targets` auf den Pfad passt",
        help_en: "do not mill with it: write it again with emit {path}, or delete it",
        help_de: "nicht damit fräsen: es mit emit {path} neu schreiben oder löschen",
    }
    /// A program of a path that is not selected and has errors now.
    STALE_BROKEN: StaleOutput {
        en: "{name} was written earlier, but its path {path} has errors now",
        de: "{name} wurde früher geschrieben, aber sein Pfad {path} hat jetzt Fehler",
        help_en: "do not mill with it: fix the errors, which check {path} shows, and write it again with emit {path}, or delete it",
        help_de: "nicht damit fräsen: die Fehler beheben, die check {path} zeigt, und es mit emit {path} neu schreiben oder löschen",
    }
    /// A program of a drawing that is excluded by an ignore file or by its hidden name.
    STALE_OF_IGNORED: StaleOutput {
        en: "{name} was written from {drawing}, which is ignored (.ignore, .gitignore, hidden name), so `emit` does not keep it up to date",
        de: "{name} wurde aus {drawing} geschrieben; diese Zeichnung wird ignoriert (.ignore, .gitignore, versteckter Name), `emit` hält das Programm also nicht aktuell",
        help_en: "delete it if it is no longer needed; to keep it up to date, run `emit` with the drawing's name",
        help_de: "es löschen, wenn es nicht mehr gebraucht wird; um es aktuell zu halten, `emit` mit dem Namen der Zeichnung aufrufen",
    }
    /// A program that lies beside its drawing although programs are written into another directory now.
    STALE_BESIDE: StaleOutput {
        en: "{name} lies beside its drawing, but programs are written into {directory} now",
        de: "{name} liegt neben seiner Zeichnung, Programme werden aber jetzt in {directory} geschrieben",
        help_en: "do not mill with it, as it no longer follows its drawing; emit --remove-stale removes it if {directory} has its successor",
        help_de: "nicht damit fräsen, denn es folgt seiner Zeichnung nicht mehr; emit --remove-stale entfernt es, wenn {directory} seinen Nachfolger enthält",
    }
    /// A program with other moves than the current one of its path, which is in another directory: the drawing was moved, `out-dir` was changed, or
    /// `--out-dir` was used once.
    STALE_ELSEWHERE: StaleOutput {
        en: "{name} is an older program of its path: the current one is {program}",
        de: "{name} ist ein älteres Programm seines Pfads: das aktuelle ist {program}",
        help_en: "do not mill with it, and remove it: emit no longer writes into its directory",
        help_de: "nicht damit fräsen und es entfernen: emit schreibt nicht mehr in sein Verzeichnis",
    }
    /// An output file from an earlier run that no path of this library would write. Another library may have written it.
    STALE_OR_OF_OTHERS: StaleOutput {
        en: "{name} was written earlier from a drawing that this library does not have",
        de: "{name} wurde früher aus einer Zeichnung geschrieben, die diese Bibliothek nicht hat",
        help_en: "delete the program only if no other library has written it: its directory lies outside of this library",
        help_de: "das Programm nur löschen, wenn keine andere Bibliothek es geschrieben hat: sein Verzeichnis liegt außerhalb dieser Bibliothek",
    }
    /// An output file that remains from before its path had errors.
    OLDER_OUTPUT: OlderOutput {
        en: "path {path} was not written, so {name} is out of date",
        de: "Pfad {path} wurde nicht geschrieben, {name} ist daher veraltet",
        help_en: "do not mill with {name} until the path's errors are fixed and the file is written again",
        help_de: "nicht mit {name} fräsen, bevor die Fehler des Pfads behoben sind und die Datei neu geschrieben ist",
    }
    /// An output file of a drawing that can no longer be read.
    OUTPUT_OF_UNREAD: OlderOutput {
        en: "{name} was written for {drawing}, which cannot be read now",
        de: "{name} wurde für {drawing} geschrieben, die jetzt nicht lesbar ist",
        help_en: "do not mill with {name} until the drawing can be read and the file is written again",
        help_de: "nicht mit {name} fräsen, bevor die Zeichnung lesbar und die Datei neu geschrieben ist",
    }
    /// A file that `emit` would write, but that is not on disk.
    MISSING_OUTPUT: NotCurrent {
        en: "{name} is missing",
        de: "{name} fehlt",
        help_en: "write it with `pathbuild emit`",
        help_de: "mit `pathbuild emit` schreiben",
    }
    /// A file on disk that differs from what `emit` would write.
    OTHER_OUTPUT: NotCurrent {
        en: "{name} is not what emit would write",
        de: "{name} ist nicht das, was emit schreiben würde",
        help_en: "write it again with emit before it is used; a file that was edited needs a name of its own, or the edit is lost",
        help_de: "vor der Verwendung mit emit neu schreiben; eine bearbeitete Datei braucht einen eigenen Namen, sonst geht die Änderung verloren",
    }
    /// An error that prevents a program although the configuration lowers its severity.
    LOWERED_ERROR: LoweredError {
        en: "nothing was written: {code} prevents writing the program even where pathbuild.toml ignores it or makes it a warning",
        de: "nichts wurde geschrieben: {code} verhindert das Programm auch dann, wenn pathbuild.toml diesen Fehler übergeht oder zur Warnung macht",
        help_en: "remove {code} from `[severity]` or `[[severity-in]]` to see where it is, and correct it",
        help_de: "{code} aus `[severity]` oder `[[severity-in]]` entfernen, um die Stelle zu sehen, und den Fehler beheben",
    }
    /// An adjusted program that was made from an older version of its program.
    STALE_ADJUSTED: StaleOutput {
        en: "{name} was made from an older version of {clean}",
        de: "{name} wurde aus einer älteren Fassung von {clean} erzeugt",
        help_en: "do not mill with it: run `adjust` again with the current probe values, after emit if {clean} is out of date; emit --remove-stale removes it",
        help_de: "nicht damit fräsen: adjust mit den aktuellen Messwerten noch einmal aufrufen, vorher emit, falls {clean} veraltet ist; emit --remove-stale entfernt die Datei",
    }
    /// An adjusted program that was edited afterwards, or that lacks the measured heights in its header.
    STALE_EDITED: StaleOutput {
        en: "{name} is not what adjust makes of {clean} with the measured heights in its header",
        de: "{name} ist nicht das, was adjust mit den gemessenen Höhen seines Kopfs aus {clean} erzeugt",
        help_en: "do not mill with it: run `adjust` again; the file was edited, or adjusted by an older version",
        help_de: "nicht damit fräsen: noch einmal adjust aufrufen; die Datei wurde bearbeitet oder von einer älteren Version angepasst",
    }
    /// An adjusted program that was made with other heights than those measured now.
    STALE_VALUES: StaleOutput {
        en: "{name} was adjusted with other heights than {values} has now",
        de: "{name} wurde mit anderen Höhen angepasst, als {values} jetzt hat",
        help_en: "do not mill with it: run `adjust` again",
        help_de: "nicht damit fräsen: noch einmal adjust aufrufen",
    }
    /// An outdated program that was written by another post-processor.
    STALE_OTHER_MOVES: StaleOutput {
        en: "{name} has other moves than {program}: another post-processor wrote it before the path was changed",
        de: "{name} hat andere Bewegungen als {program}: ein anderer Postprozessor hat es geschrieben, bevor der Pfad geändert wurde",
        help_en: "do not mill with it: emit it again with that post-processor, or remove it with emit --remove-stale",
        help_de: "nicht damit fräsen: mit jenem Postprozessor neu schreiben (emit) oder mit emit --remove-stale entfernen",
    }
    /// A program that was converted from an adjusted one before that got other heights.
    STALE_CONVERTED: StaleOutput {
        en: "{name} has other measured heights than {program}, from which it was converted",
        de: "{name} hat andere gemessene Höhen als {program}, aus dem es umgeschrieben wurde",
        help_en: "do not mill with it: convert {program} again with pathbuild post, or remove it with emit --remove-stale",
        help_de: "nicht damit fräsen: {program} mit pathbuild post noch einmal umschreiben oder die Datei mit emit --remove-stale entfernen",
    }
    /// An outdated program that joins paths.
    STALE_JOINED: StaleOutput {
        en: "{name} joins {paths}, which yield another program now",
        de: "{name} verbindet {paths}, die jetzt ein anderes Programm ergeben",
        help_en: "do not mill with it: write it again with {command}, or remove it with emit --remove-stale",
        help_de: "nicht damit fräsen: mit {command} neu schreiben oder mit emit --remove-stale entfernen",
    }
    /// A path that the Q-project does not embed.
    LACKS_PATH: QProjectLacksPath {
        en: "the Q-project does not embed path {name} of {drawing}",
        de: "das Q-Projekt bettet Pfad {name} aus {drawing} nicht ein",
        help_en: "add it, or delete the Q-project and write it again: pathbuild q-project {argument}",
        help_de: "ihn hinzufügen oder das Q-Projekt löschen und neu schreiben lassen: pathbuild q-project {argument}",
    }
    /// A Q-project without the drawing that it belongs to.
    WITHOUT_DRAWING: QProjectLacksPath {
        en: "there is no {drawing} beside this Q-project, so it is compared with nothing",
        de: "neben diesem Q-Projekt liegt keine {drawing}, deshalb wird es mit nichts verglichen",
        help_en: "if the drawing was renamed or moved, rename or move the Q-project as well; otherwise remove it",
        help_de: "wurde die Zeichnung umbenannt oder verschoben, das Q-Projekt ebenso umbenennen oder verschieben; sonst entfernen",
    }
    /// A value on a Q-project's segment that differs from that of the proxy line.
    Q_VALUE_DIFFERS: QProjectDiffers {
        en: "{letter} is {here} here, but {there} on the proxy line of path {name} in {drawing}",
        de: "{letter} ist hier {here}, auf der Stellvertreterlinie von Pfad {name} in {drawing} aber {there}",
        help_en: "make both agree, or delete the Q-project and write it again: pathbuild q-project {argument}",
        help_de: "die Werte angleichen oder das Q-Projekt löschen und neu schreiben lassen: pathbuild q-project {argument}",
    }
    /// A length of a Q-project's segment that differs from that of the proxy line.
    Q_LENGTH_DIFFERS: QProjectDiffers {
        en: "the segment is {here} mm long, but the proxy line of path {name} in {drawing} is {there} mm long",
        de: "das Segment ist {here} mm lang, die Stellvertreterlinie von Pfad {name} in {drawing} aber {there} mm",
        help_en: "make both agree, or delete the Q-project and write it again: pathbuild q-project {argument}",
        help_de: "die Werte angleichen oder das Q-Projekt löschen und neu schreiben lassen: pathbuild q-project {argument}",
    }
    /// A proxy line that names a path which does not exist in the drawing.
    PROXY_OF_NOTHING: ProxyDiffers {
        en: "the proxy line names {name}, which is not a path of this drawing",
        de: "die Stellvertreterlinie nennt {name}; so heißt kein Pfad dieser Zeichnung",
        help_en: "name one of the drawing's paths: {names}",
        help_de: "einen der Pfade der Zeichnung nennen: {names}",
    }
    /// A proxy line that runs along one path, but names another.
    PROXY_OF_OTHER: ProxyDiffers {
        en: "the proxy line names {name}, but runs from the start of path {other} to its end",
        de: "die Stellvertreterlinie nennt {name}, läuft aber vom Anfang von Pfad {other} zu dessen Ende",
        help_en: "correct the name",
        help_de: "den Namen berichtigen",
    }
    /// A value of a proxy line that differs from that of its path.
    PROXY_VALUE_DIFFERS: ProxyDiffers {
        en: "{letter} is {here} on the proxy line, but {there} in path {name}",
        de: "{letter} ist auf der Stellvertreterlinie {here}, in Pfad {name} aber {there}",
        help_en: "write the path's {letter} on the proxy line, which is copied into projects",
        help_de: "das {letter} des Pfads an die Stellvertreterlinie schreiben, die in Projekte kopiert wird",
    }
    /// A value of a variable on a proxy line that its path does not allow.
    PROXY_VALUE_NOT_ALLOWED: ProxyDiffers {
        en: "variable {variable} is {value} on the proxy line, but path {name} allows {definition}",
        de: "Variable {variable} ist auf der Stellvertreterlinie {value}, Pfad {name} erlaubt aber {definition}",
        help_en: "write a value that the path allows on the proxy line, which is copied into projects",
        help_de: "einen Wert, den der Pfad erlaubt, an die Stellvertreterlinie schreiben, die in Projekte kopiert wird",
    }
    /// A variable on a proxy line that its path does not have.
    PROXY_VARIABLE_UNKNOWN: ProxyDiffers {
        en: "the proxy line gives variable {variable} a value, but path {name} has no such variable",
        de: "die Stellvertreterlinie gibt der Variablen {variable} einen Wert, Pfad {name} hat aber keine solche",
        help_en: "remove :{variable} from the proxy line, or correct its name",
        help_de: ":{variable} von der Stellvertreterlinie entfernen oder den Namen berichtigen",
    }
    /// A length of a proxy line that differs from that of its path.
    PROXY_LENGTH_DIFFERS: ProxyDiffers {
        en: "the proxy line is {here} mm long, but path {name} is {there} mm from start to end",
        de: "die Stellvertreterlinie ist {here} mm lang, Pfad {name} aber {there} mm von Anfang bis Ende",
        help_en: "draw it from the path's start to its end",
        help_de: "sie vom Anfang des Pfads zu seinem Ende zeichnen",
    }
    /// A Q-project that needs several paths, although no further names can be derived from its name.
    NO_NAME_FOR_CUTTER: CannotWrite {
        en: "the drawing's paths use several cutters (O), so the Q-project needs a path for each, but no further names can be derived from {name}",
        de: "die Pfade der Zeichnung verwenden mehrere Fräser (O); das Q-Projekt braucht für jeden einen Pfad, aber aus {name} lassen sich keine weiteren Namen bilden",
        help_en: "use --path-name to give a name whose last number can be increased",
        help_de: "mit --path-name einen Namen angeben, dessen letzte Zahl sich hochzählen lässt",
    }
    /// Note: the moves are the same with `--compatible`.
    SAME_IF_COMPATIBLE: MovesDiffer {
        en: "with --compatible the moves are the same: this program is the one that PathDxf2GCode writes",
        de: "mit --compatible sind die Bewegungen gleich: dieses Programm ist das von PathDxf2GCode",
    }
}
