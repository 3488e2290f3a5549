//! The German of every help text, value name and possible value of the command line, by its English text in `args`.

/// English and German. A test holds it against the definition of the command line, in both directions.
pub const CATALOGUE: &[(&str, &str)] = &[
    // The program and its commands.
    ("Compiles drawings of milling paths to G-code", "Übersetzt Zeichnungen von Fräspfaden in G-Code"),
    (
        "Exit status: 0 nothing wrong (warnings allowed), 1 errors found, 2 wrong usage or configuration.",
        "Exit-Status: 0 ohne Fehler (Warnungen sind erlaubt), 1 Fehler gefunden, 2 falscher Aufruf oder falsche Konfiguration.",
    ),
    (
        "Check every path of the given drawings, paths or directories; without arguments the library. Writes no programs",
        "Prüft jeden Pfad der genannten Zeichnungen, Pfade oder Verzeichnisse; ohne Angaben die Bibliothek. Schreibt keine Programme",
    ),
    (
        "Write the files of one or more paths; without arguments those of `[emit] targets`",
        "Schreibt die Dateien eines oder mehrerer Pfade; ohne Angaben die von `[emit] targets`",
    ),
    (
        "Put measured heights into a program: `DRAWING_Clean.gcode` and `DRAWING_Z.txt` become `DRAWING_Milling.gcode`",
        "Setzt gemessene Höhen in ein Programm ein: aus `ZEICHNUNG_Clean.gcode` und `ZEICHNUNG_Z.txt` wird `ZEICHNUNG_Milling.gcode`",
    ),
    ("Check again whenever a drawing changes", "Prüft erneut, sobald sich eine Zeichnung ändert"),
    (
        "Show which element each parameter text belongs to",
        "Zeigt, zu welchem Element jeder Parametertext gehört",
    ),
    (
        "Show a path, a drawing or a program: in the browser, or as SVG, PNG, PDF, HTML or JSON",
        "Zeigt einen Pfad, eine Zeichnung oder ein Programm: im Browser oder als SVG, PNG, PDF, HTML oder JSON",
    ),
    (
        "Make a path's setup sheet for the machine operator: PDF, HTML or SVG, or in the browser",
        "Erstellt das Einrichteblatt eines Pfads für die Maschine: PDF, HTML oder SVG, oder im Browser",
    ),
    (
        "Show how changed drawings change the moves: between directories, Git revisions, or a program and a path",
        "Zeigt, wie geänderte Zeichnungen die Bewegungen ändern: zwischen Verzeichnissen, Git-Revisionen oder einem Programm und einem Pfad",
    ),
    (
        "Read a G-code program and print what it does: moves, depths, feeds, times",
        "Liest ein G-Code-Programm und gibt aus, was es tut: Bewegungen, Tiefen, Vorschübe, Zeiten",
    ),
    ("Check a G-code program", "Prüft ein G-Code-Programm"),
    ("Write a G-code program for another machine", "Schreibt ein G-Code-Programm für eine andere Maschine"),
    ("List the built-in posts", "Listet die eingebauten Postprozessoren auf"),
    ("Print a built-in post's definition", "Gibt die Definition eines eingebauten Postprozessors aus"),
    (
        "Show which path embeds which, with the values of variables",
        "Zeigt, welcher Pfad welchen einbettet, mit den Werten der Variablen",
    ),
    ("Show which paths a path embeds", "Zeigt, welche Pfade ein Pfad einbettet"),
    ("Show which paths embed a path", "Zeigt, welche Pfade einen Pfad einbetten"),
    (
        "List paths with drawing, M, T, O, size, length, minutes and state; without arguments those of the library",
        "Listet Pfade mit Zeichnung, M, T, O, Größe, Länge, Minuten und Zustand auf; ohne Angaben die der Bibliothek",
    ),
    ("Count the paths by material, cutter and state", "Zählt die Pfade nach Material, Fräser und Zustand"),
    ("Show where a path is defined", "Zeigt, wo ein Pfad gezeichnet ist"),
    (
        "Show why drawings would be compiled again: what has changed since the last `check` of the library",
        "Zeigt, warum Zeichnungen neu übersetzt würden: was sich seit dem letzten `check` der Bibliothek geändert hat",
    ),
    (
        "Write a Q-project: a drawing that embeds every path of another",
        "Schreibt ein Q-Projekt: eine Zeichnung, die jeden Pfad einer anderen einbettet",
    ),
    ("Manage the results cached between runs", "Verwaltet die zwischen Läufen gespeicherten Ergebnisse"),
    ("Print the directory of the cached results", "Gibt das Verzeichnis der gespeicherten Ergebnisse aus"),
    ("Print the size of the cached results", "Gibt die Größe der gespeicherten Ergebnisse aus"),
    (
        "Remove cached results that are no longer used",
        "Löscht gespeicherte Ergebnisse, die nicht mehr gebraucht werden",
    ),
    ("Remove all cached results", "Löscht alle gespeicherten Ergebnisse"),
    ("Check every cached result for damage", "Prüft jedes gespeicherte Ergebnis auf Schäden"),
    (
        "Explain the codes of messages; without a code list all of them",
        "Erklärt die Codes der Meldungen; ohne Code werden alle aufgelistet",
    ),
    (
        "Write a commented pathbuild.toml into the working directory",
        "Schreibt eine kommentierte pathbuild.toml ins Arbeitsverzeichnis",
    ),
    ("Show the configuration", "Zeigt die Konfiguration"),
    ("Print the values in force", "Gibt die geltenden Werte aus"),
    ("Print the JSON schema of pathbuild.toml", "Gibt das JSON-Schema von pathbuild.toml aus"),
    ("Print a completion script for a shell", "Gibt ein Skript aus, mit dem eine Shell Eingaben ergänzt"),
    ("Print the manual page", "Gibt die Handbuchseite (man) aus"),
    (
        "Run a command line of `PathDxf2GCode` or `PathGCodeAdjustZ`",
        "Führt eine Befehlszeile von `PathDxf2GCode` oder `PathGCodeAdjustZ` aus",
    ),
    (
        "Print this message or the help of the given subcommand(s)",
        "Gibt diese Hilfe oder die eines Befehls aus",
    ),
    // What commands work on.
    (
        "Drawings (.dxf), names of paths or patterns of them (8*.1P), directories",
        "Zeichnungen (.dxf), Namen von Pfaden oder Muster dafür (8*.1P), Verzeichnisse",
    ),
    (
        "Patterns of path names (8*, 20[0-5]?.1P), drawings (.dxf), directories; without drawings or directories the library",
        "Muster von Pfadnamen (8*, 20[0-5]?.1P), Zeichnungen (.dxf), Verzeichnisse; ohne Zeichnungen und Verzeichnisse die Bibliothek",
    ),
    (
        "DRAWING.dxf, `DRAWING_Clean.gcode`, `DRAWING_Z.txt` or DRAWING",
        "ZEICHNUNG.dxf, `ZEICHNUNG_Clean.gcode`, `ZEICHNUNG_Z.txt` oder ZEICHNUNG",
    ),
    (
        "Name of a path, drawing (.dxf), or G-code program",
        "Name eines Pfads, Zeichnung (.dxf) oder G-Code-Programm",
    ),
    (
        "Name of a path, or drawing (.dxf) with one path",
        "Name eines Pfads, oder Zeichnung (.dxf) mit einem Pfad",
    ),
    (
        "File to write: .pdf, .html or .svg; without it the browser shows the setup sheet",
        "Zieldatei: .pdf, .html oder .svg; sonst zeigt der Browser das Einrichteblatt",
    ),
    (
        "Before the change: a directory, a drawing, a Git revision, or a G-code program",
        "Vor der Änderung: ein Verzeichnis, eine Zeichnung, eine Git-Revision oder ein G-Code-Programm",
    ),
    (
        "After the change: the same, or a path if OLD is a program (default: working directory)",
        "Nach der Änderung: ebenso, zu einem Programm auch ein Pfad; sonst das Arbeitsverzeichnis",
    ),
    ("G-code programs", "G-Code-Programme"),
    ("G-code program", "G-Code-Programm"),
    ("Name of a built-in post", "Name eines eingebauten Postprozessors"),
    ("Drawing to embed", "Zeichnung zum Einbetten"),
    (
        "Code or name of a message: PB203, parameter-out-of-range",
        "Code oder Name einer Meldung: PB203, parameter-out-of-range",
    ),
    ("Shell to print the script for", "Shell, für die das Skript ist"),
    (
        "Options and files as `PathDxf2GCode` or `PathGCodeAdjustZ` takes them",
        "Optionen und Dateien, wie `PathDxf2GCode` oder `PathGCodeAdjustZ` sie erwartet",
    ),
    // Options of check.
    (
        "Check every combination of the variables' values, not one example of each",
        "Prüft jede Kombination der Werte von Variablen, nicht nur je ein Beispiel",
    ),
    ("Exit with 1 on warnings too", "Endet auch bei Warnungen mit Exit-Status 1"),
    (
        "Report only findings that are not in this file",
        "Zeigt nur Meldungen, die nicht in dieser Datei stehen",
    ),
    (
        "Write all findings into the baseline file instead of reporting them",
        "Schreibt alle Meldungen in die Datei von --baseline, statt sie zu zeigen",
    ),
    (
        "Check only what depends on files changed since this Git revision",
        "Prüft nur, was von Dateien abhängt, die seit dieser Git-Revision geändert wurden",
    ),
    ("Show how long each stage took", "Zeigt, wie lange jede Stufe gedauert hat"),
    (
        "Show at most N errors; the last lines count all of them",
        "Zeigt höchstens N Fehler; die letzten Zeilen zählen alle",
    ),
    (
        "Write a picture of each finding into this directory: a detail of the drawing with the place circled",
        "Schreibt zu jeder Meldung ein Bild in dieses Verzeichnis: einen Ausschnitt der Zeichnung mit eingekreister Stelle",
    ),
    // Options of emit and post.
    (
        "Write nothing; report the files on disk that are out of date",
        "Schreibt nichts; meldet Dateien auf der Platte, die nicht aktuell sind",
    ),
    ("With --check: compare only the moves", "Mit --check: vergleicht nur die Bewegungen"),
    ("Overwrite measured values in _Z.txt", "Überschreibt gemessene Werte in _Z.txt"),
    (
        "Write for this post-processor: a built-in name or a file",
        "Schreibt für diesen Postprozessor: ein eingebauter Name oder eine Datei",
    ),
    (
        "Join the paths, in this order, into one program called NAME, with a tool change wherever O differs",
        "Fügt die Pfade in dieser Reihenfolge zu einem Programm NAME zusammen, mit Werkzeugwechsel, wo O ein anderes ist",
    ),
    (
        "Write the dependencies of the files into FILE, for make and Ninja",
        "Schreibt die Abhängigkeiten der Dateien in DATEI, für make und Ninja",
    ),
    ("Write the program to standard output: `-o -`", "Schreibt das Programm in die Standardausgabe: `-o -`"),
    (
        "Remove programs that pathbuild wrote earlier and would no longer write",
        "Löscht Programme, die pathbuild früher geschrieben hat und nicht mehr schreiben würde",
    ),
    (
        "G-code dialect for checking the post's output, if the post names none",
        "G-Code-Dialekt, in dem die Ausgabe des Postprozessors geprüft wird, wenn er keinen nennt",
    ),
    ("Date for posts that write one", "Datum für Postprozessoren, die eines schreiben"),
    (
        "After writing, run the command that the post names",
        "Führt nach dem Schreiben den Befehl aus, den der Postprozessor nennt",
    ),
    ("Post-processor: a built-in name or a file", "Postprozessor: ein eingebauter Name oder eine Datei"),
    ("File to write; without it standard output", "Zieldatei; sonst die Standardausgabe"),
    (
        "Height of the material's upper face, for posts that need it; programs by pathbuild contain it",
        "Höhe der Materialoberfläche, für Postprozessoren, die sie brauchen; in Programmen von pathbuild steht sie",
    ),
    // Options of adjust.
    (
        "Largest allowed difference between a measured and a drawn height",
        "Größte erlaubte Differenz zwischen gemessener und gezeichneter Höhe",
    ),
    (
        "Print the lines of `DRAWING_Clean.gcode` that match",
        "Gibt die Zeilen von `ZEICHNUNG_Clean.gcode` aus, die passen",
    ),
    (
        "Take values that are missing in `DRAWING_Z.txt` from a sender's log, one `[PRB:X,Y,Z:1]` for each probe, in order",
        "Nimmt Werte, die in `ZEICHNUNG_Z.txt` fehlen, aus dem Protokoll eines Senders: je Z-Probe ein `[PRB:X,Y,Z:1]`, der Reihe nach",
    ),
    // Options of other commands.
    ("Write the files of `[emit] targets` as well", "Schreibt auch die Dateien von `[emit] targets`"),
    (
        "Look for changes at intervals (for network drives)",
        "Sucht in festen Abständen nach Änderungen (für Netzlaufwerke)",
    ),
    (
        "Show the library as a page that stays up to date: on this computer at port 8347, or at ADDR (PORT, IP, IP:PORT or NAME:PORT)",
        "Zeigt die Bibliothek als Seite, die sich selbst aktualisiert: auf diesem Rechner an Port 8347 oder an ADRESSE (PORT, IP, IP:PORT oder NAME:PORT)",
    ),
    ("With --serve: show the page in the browser", "Mit --serve: zeigt die Seite im Browser"),
    (
        "With --serve: end when the page has been closed",
        "Mit --serve: endet, wenn die Seite geschlossen worden ist",
    ),
    ("Show only texts that match", "Zeigt nur Texte, die passen"),
    (
        "File to write: .svg, .png, .pdf, .html or .json (the scene as data); without it the browser shows the picture",
        "Zieldatei: .svg, .png, .pdf, .html oder .json (das Bild als Daten); sonst zeigt der Browser das Bild",
    ),
    (
        "Also write a file: .html (with pictures) or .md (for a pull request)",
        "Schreibt auch eine Datei: .html (mit Bildern) oder .md (für einen Pull-Request)",
    ),
    (
        "Compare with the drawing of this path, which also gives the cutter and the material",
        "Vergleicht mit der Zeichnung dieses Pfads, die auch Fräser und Material angibt",
    ),
    (
        "Diameter of the cutter; without it from T and `[tool.NAME]`",
        "Durchmesser des Fräsers; sonst aus T und `[tool.NAME]`",
    ),
    (
        "Height of the material's upper face; programs by pathbuild contain it",
        "Höhe der Materialoberfläche; in Programmen von pathbuild steht sie",
    ),
    (
        "Compare with programs written for this post-processor: a built-in name or a file",
        "Vergleicht mit Programmen für diesen Postprozessor: ein eingebauter Name oder eine Datei",
    ),
    (
        "Name of the Q-project's path; without it the drawing's first number with .0Q",
        "Name des Q-Projekt-Pfads; sonst die erste Nummer der Zeichnung mit .0Q",
    ),
    ("File to write; without it `DRAWING_Q.dxf`", "Zieldatei; sonst `ZEICHNUNG_Q.dxf`"),
    (
        "Write a small library to learn on: a first drawing, two components, a project, templates for CAD programs",
        "Schreibt eine kleine Bibliothek zum Lernen: eine erste Zeichnung, zwei Bauteile, ein Projekt, Vorlagen für CAD-Programme",
    ),
    ("Also say where each value comes from", "Gibt auch an, woher jeder Wert kommt"),
    (
        "Print the pathbuild command line instead of running it",
        "Gibt die Befehlszeile von pathbuild aus, statt sie auszuführen",
    ),
    // How programs are read.
    (
        "Post-processor that wrote the programs: sets the known words and the dialect",
        "Postprozessor, der die Programme geschrieben hat: legt die bekannten Wörter und den Dialekt fest",
    ),
    (
        "G-code dialect: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam or din; without it pathbuild guesses",
        "G-Code-Dialekt: native, rs274, linuxcnc, grbl, xpertmill, mach3, fanuc, haas, marlin, estlcam oder din; sonst versucht pathbuild, ihn zu erkennen",
    ),
    (
        "`XpertMILL`: din: G70 means inches and G71 millimetres; table: the other way round",
        "`XpertMILL`: din: G70 heißt Zoll und G71 Millimeter; table: umgekehrt",
    ),
    (
        "`XpertMILL`: I and J are the arc's centre itself, not its distance from the arc's start",
        "`XpertMILL`: I und J sind der Bogenmittelpunkt selbst, nicht sein Abstand vom Bogenanfang",
    ),
    (
        "`XpertMILL`: ignore F and use the feeds of the layers",
        "`XpertMILL`: F wird ignoriert; es gelten die Vorschübe der Layer",
    ),
    // Common options.
    ("Common options", "Allgemeine Optionen"),
    ("Language of messages (also: `PATHBUILD_LANG`)", "Sprache der Meldungen (auch: `PATHBUILD_LANG`)"),
    (
        "Use this configuration instead of the drawing's pathbuild.toml",
        "Nimmt diese Konfiguration statt der pathbuild.toml der Zeichnung",
    ),
    ("Format of the messages", "Format der Meldungen"),
    (
        "Write a report of the findings into a file as well; `-` is standard output (repeatable)",
        "Schreibt die Meldungen auch in eine Datei; `-` ist die Standardausgabe (wiederholbar)",
    ),
    ("When to use colours", "Wann Farben verwendet werden"),
    (
        "Print less: no status lines; given twice: results only",
        "Gibt weniger aus: keine Statuszeilen; zweimal: nur Ergebnisse",
    ),
    ("Print more", "Gibt mehr aus"),
    ("Number of threads", "Anzahl der Threads"),
    (
        "Do not trust the tree: read no file outside of it, and run no command that it names",
        "Dem Verzeichnisbaum nicht trauen: keine Datei außerhalb lesen, keinen dort genannten Befehl ausführen",
    ),
    ("Use no cached results and cache none", "Verwendet keine gespeicherten Ergebnisse und speichert keine"),
    (
        "Directory for cached results, which copies of the tree share (also: `PATHBUILD_CACHE_DIR`)",
        "Verzeichnis für gespeicherte Ergebnisse, auch für Kopien des Verzeichnisbaums (auch: `PATHBUILD_CACHE_DIR`)",
    ),
    ("Print help", "Gibt die Hilfe aus"),
    ("Print version", "Gibt die Version aus"),
    // Possible values.
    ("With the faulty text underlined, help and notes", "Mit unterstrichenem Text, Hilfe und Hinweisen"),
    ("One line each", "Je eine Zeile"),
    ("One JSON object a line", "Je Zeile ein JSON-Objekt"),
    ("SARIF 2.1.0", "SARIF 2.1.0"),
    ("Annotations of a GitHub workflow", "Anmerkungen eines GitHub-Workflows"),
    ("GitLab code quality", "GitLab Code Quality"),
    ("`JUnit` XML, a test case for each path", "`JUnit`-XML, je Pfad ein Testfall"),
    ("A page with pictures: for `--report` only", "Eine Seite mit Bildern: nur für `--report`"),
    ("A graph for Graphviz", "Ein Graph für Graphviz"),
    ("A graph for Mermaid", "Ein Graph für Mermaid"),
    ("English", "Englisch"),
    ("On a terminal", "Auf einem Terminal"),
    ("Also into a file or pipe", "Auch in eine Datei oder Pipe"),
    ("Nowhere", "Nirgends"),
    ("G70 inches, G71 millimetres", "G70 Zoll, G71 Millimeter"),
    ("The other way round", "Umgekehrt"),
    ("German", "Deutsch"),
    // Names of values.
    ("DRAWING|PATH|DIRECTORY", "ZEICHNUNG|PFAD|VERZEICHNIS"),
    ("GLOB|DRAWING|DIRECTORY", "MUSTER|ZEICHNUNG|VERZEICHNIS"),
    ("PATH|DRAWING|FILE", "PFAD|ZEICHNUNG|DATEI"),
    ("PATH|DRAWING", "PFAD|ZEICHNUNG"),
    ("PATH", "PFAD"),
    ("DRAWING", "ZEICHNUNG"),
    ("FILE", "DATEI"),
    ("ADDR", "ADRESSE"),
    ("DIR", "VERZEICHNIS"),
    ("OLD", "ALT"),
    ("NEW", "NEU"),
    ("DATE", "DATUM"),
    ("DIALECT", "DIALEKT"),
    ("PARENT:CHILD", "AUSSEN:INNEN"),
    ("FORMAT=FILE", "FORMAT=DATEI"),
    ("CODE", "CODE"),
    ("NAME", "NAME"),
    ("POST", "POST"),
    ("REGEX", "REGEX"),
    ("REV", "REVISION"),
    ("SHELL", "SHELL"),
    ("ARGUMENT", "ARGUMENT"),
    ("N", "N"),
    ("MM", "MM"),
    ("MM/MIN", "MM/MIN"),
    ("-", "-"),
    ("en|de", "en|de"),
    ("din|table", "din|table"),
    ("auto|always|never", "auto|always|never"),
    ("full|concise|json|sarif|github|gitlab|junit", "full|concise|json|sarif|github|gitlab|junit"),
    // Why a value is refused.
    ("expected a number from 1 to 1024", "erwartet wird eine Zahl von 1 bis 1024"),
    ("expected FORMAT=FILE", "erwartet wird FORMAT=DATEI"),
    (
        "the format is full, concise, json, sarif, github, gitlab, junit or html",
        "das Format ist full, concise, json, sarif, github, gitlab, junit oder html",
    ),
    ("the name of the file is missing", "der Name der Datei fehlt"),
    ("unknown dialect", "unbekannter Dialekt"),
    (
        "an address is PORT, IP, IP:PORT, localhost or NAME:PORT (drawings, paths and directories stand before --serve)",
        "eine Adresse ist PORT, IP, IP:PORT, localhost oder NAME:PORT (Zeichnungen, Pfade und Verzeichnisse stehen vor --serve)",
    ),
];
