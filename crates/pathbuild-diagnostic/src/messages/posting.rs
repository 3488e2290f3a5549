//! Messages about programs that post-processors write: jobs that they cannot write, and texts that do not do what the job does. (PB750 to PB769)

messages! {
    /// A hole with too many pecks.
    TOO_MANY_PECKS: EndlessMacro {
        en: "the hole at {place} requires more than {limit} pecks",
        de: "die Bohrung bei {place} braucht mehr als {limit} Stufen",
        help_en: "check the depth of a peck at this hole: C in a drawing, Q in a program",
        help_de: "die Tiefe einer Stufe bei dieser Bohrung prüfen: C in einer Zeichnung, Q in einem Programm",
    }
    /// A tolerance for chords that is so small that an arc would become too many lines.
    TOO_MANY_CHORDS: EndlessMacro {
        en: "an arc of radius {radius} requires more than {limit} lines",
        de: "ein Bogen mit Radius {radius} braucht mehr als {limit} Strecken",
        help_en: "raise the post's tolerance for arcs",
        help_de: "die Toleranz für Bögen im Postprozessor erhöhen",
    }
    /// A hole for which nothing is written.
    DRILLING_LOST: LostDrilling {
        en: "the post writes nothing that drills the hole at {place}: {section} is empty",
        de: "der Postprozessor schreibt nichts, was die Bohrung bei {place} ausführt: {section} ist leer",
        help_en: "write the hole as moves (cycles = false), or give the post a text for it",
        help_de: "die Bohrung als Bewegungen schreiben (cycles = false) oder dem Postprozessor einen Text dafür geben",
    }
    /// An arc with different radii at its ends after rounding.
    ARC_ROUNDED: RoundedArc {
        en: "in the output, the arc to {place} has the radius {start} at its start and {end} at its end",
        de: "in der Ausgabe hat der Bogen nach {place} am Anfang den Radius {start} und am Ende {end}",
        help_en: "give the post's number format more decimals",
        help_de: "dem Zahlenformat des Postprozessors mehr Nachkommastellen geben",
    }
    /// An arc that is written as a line, because its radius exceeds `MaximumArcRadius`.
    ARC_FLATTENED: FlattenedArc {
        en: "the arc to {place} has the radius {radius}; the post writes a line that deviates from it by up to {distance} mm",
        de: "der Bogen nach {place} hat den Radius {radius}; der Postprozessor schreibt eine Gerade, die bis zu {distance} mm davon abweicht",
        help_en: "raise MaximumArcRadius in the post",
        help_de: "MaximumArcRadius im Postprozessor erhöhen",
    }
    /// A line of output that is not G-code.
    LINE_UNREADABLE: UnreadableLine {
        en: "the post writes \"{line}\", which is not G-code; its effect on the machine is unknown",
        de: "der Postprozessor schreibt \"{line}\"; das ist kein G-Code, und die Wirkung an der Maschine ist unbekannt",
        help_en: "remove the line from the post; if it is intended, set SuppressParserErrors (.cbpp) or suppress-parser-errors (.toml) there",
        help_de: "die Zeile aus dem Postprozessor entfernen; wenn sie so gewollt ist, dort SuppressParserErrors (.cbpp) oder suppress-parser-errors (.toml) setzen",
    }
    /// A cutter diameter that is missing from the tool table.
    TOOL_UNKNOWN: UnknownTool {
        en: "the tool table has no cutter with O = {diameter} for {path}; the cutter is written as tool {index}",
        de: "die Werkzeugtabelle hat keinen Fräser mit O = {diameter} für {path}; er wird als Werkzeug {index} geschrieben",
        help_en: "add the cutter as [tool.NAME] to pathbuild.toml",
        help_de: "den Fräser als [tool.NAME] in pathbuild.toml aufnehmen",
    }
    /// Two tools that fit a path equally well.
    TOOLS_ALIKE: UnknownTool {
        en: "the tools {first} and {second} both have the diameter {diameter} and fit the same paths: {first} is used, because it comes first",
        de: "die Werkzeuge {first} und {second} haben beide den Durchmesser {diameter} und passen zu denselben Pfaden: verwendet wird {first}, weil es zuerst kommt",
        help_en: "give one of them `paths`, a pattern for the names of its paths, or remove the one that is never used",
        help_de: "einem davon `paths` geben, ein Muster für die Namen seiner Pfade, oder das nie verwendete entfernen",
    }
    /// A tool number that is missing from the tool table, in a program that a post writes.
    TOOL_NUMBER_UNKNOWN: UnknownTool {
        en: "the tool table has no tool with the number {index}: the diameter of T{index} is unknown, and a post that writes the diameter writes 0",
        de: "die Werkzeugtabelle hat kein Werkzeug mit der Nummer {index}: der Durchmesser von T{index} ist unbekannt, und ein Postprozessor, der ihn schreibt, schreibt 0",
        help_en: "add the tool as [tool.NAME] with `number` to pathbuild.toml",
        help_de: "das Werkzeug als [tool.NAME] mit `number` in pathbuild.toml aufnehmen",
    }
    /// `verify`: a change to a tool that is missing from the tool table.
    TOOL_NOT_IN_TABLE: UnknownTool {
        en: "T{index} is not in the tool table",
        de: "T{index} ist nicht in der Werkzeugtabelle",
        help_en: "add the tool to the machine's table, and to pathbuild.toml as [tool.NAME] with `number`; or correct T",
        help_de: "das Werkzeug in die Tabelle der Maschine und als [tool.NAME] mit `number` in pathbuild.toml aufnehmen, oder T berichtigen",
    }
    /// A program without operations.
    JOB_EMPTY: NothingToPost {
        en: "the program mills nothing: there is nothing to write",
        de: "das Programm fräst nichts: es gibt nichts zu schreiben",
        help_en: "check that this is the right file, and that it is complete",
        help_de: "prüfen, ob das die richtige Datei ist und ob sie vollständig ist",
    }
    /// A coordinate or feed that is NaN or infinite.
    JOB_NOT_FINITE: NothingToPost {
        en: "{operation} has a coordinate or feed that is not a number",
        de: "{operation} hat eine Koordinate oder einen Vorschub, der keine Zahl ist",
        help_en: "look for values in the program that are far too large, or divided by 0",
        help_de: "im Programm nach viel zu großen Werten oder nach Divisionen durch 0 suchen",
    }
    /// A text that is written outside of a comment, where the control would execute it.
    TEXT_AMONG_WORDS: RejectedWord {
        en: "{macro} in {section} puts \"{text}\" outside a comment, where the machine would execute it",
        de: "{macro} in {section} setzt \"{text}\" außerhalb eines Kommentars, wo die Maschine es ausführen würde",
        help_en: "put the text into a comment in the post, or give the drawing another name",
        help_de: "den Text im Postprozessor in einen Kommentar setzen oder die Zeichnung anders nennen",
    }
    /// A program to be wrapped around a cylinder with a radius of 0 or less.
    NO_RADIUS: NothingToPost {
        en: "{operation} cannot be wrapped round a cylinder: its surface T, which is the radius, must be above 0",
        de: "{operation} lässt sich nicht um einen Zylinder legen: die Oberfläche T, die der Radius ist, muss über 0 liegen",
        help_en: "give the radius with --surface, or write the program with emit from the drawing, which contains T",
        help_de: "den Radius mit --surface angeben oder das Programm mit emit aus der Zeichnung schreiben, die T enthält",
    }
    /// A program wrapped around a cylinder more than once.
    WRAPPED_TWICE: DoubtfulPost {
        en: "wrapped round the cylinder, the program covers {degrees} degrees: it mills some places twice",
        de: "um den Zylinder gelegt, reicht das Programm über {degrees} Grad: es fräst manche Stellen zweimal",
        help_en: "keep the width of the drawing within the circumference, 2 x pi x T",
        help_de: "die Breite der Zeichnung innerhalb des Umfangs halten, 2 x Pi x T",
    }
    /// An axis that the definition writes with the opposite sign.
    AXIS_REVERSED: DoubtfulPost {
        en: "the post writes {axis} with the opposite sign: the output is a mirror image, right only for a machine whose {axis} axis counts the other way",
        de: "der Postprozessor schreibt {axis} mit umgekehrtem Vorzeichen: die Ausgabe ist gespiegelt und nur für eine Maschine richtig, deren {axis}-Achse andersherum zählt",
        help_en: "remove the minus from the post's macros, such as {$-z}, or replace it with _, unless this axis of the machine does count the other way",
        help_de: "das Minus in den Makros des Postprozessors, etwa {$-z}, weglassen oder durch _ ersetzen, außer wenn diese Achse der Maschine wirklich andersherum zählt",
    }
    /// Feeds of a path wrapped around a cylinder, which many controls take for other speeds.
    WRAPPED_FEED: DoubtfulPost {
        en: "F is the speed along the surface of the cylinder, but a control that does not know the cylinder's diameter takes F for the speed of X, Y and Z alone, or for degrees per minute: the rotary axis turns far too fast or too slowly",
        de: "F ist die Geschwindigkeit auf der Oberfläche des Zylinders, eine Steuerung ohne Angabe seines Durchmessers bezieht F aber nur auf X, Y und Z oder auf Grad je Minute: die Drehachse dreht viel zu schnell oder zu langsam",
        help_en: "run the program only on a control that converts feeds of the rotary axis, and set its diameter to 2 x T there",
        help_de: "das Programm nur auf einer Steuerung fahren, die Vorschübe der Drehachse umrechnet, und dort als deren Durchmesser 2 x T angeben",
    }
    /// A word for an axis that is replaced by an angle.
    REPLACED_AXIS_WRITTEN: PostDiffers {
        en: "the post writes \"{line}\" although {angle} replaces {axis}: the machine would move both axes",
        de: "der Postprozessor schreibt \"{line}\", obwohl {angle} an die Stelle von {axis} tritt: die Maschine würde beide Achsen bewegen",
        help_en: "remove {axis} from the post's texts",
        help_de: "{axis} aus den Texten des Postprozessors nehmen",
    }
    /// A cutter without a known spindle speed.
    SPINDLE_UNKNOWN: MissingPostValue {
        en: "no spindle speed is known for {operation} (cutter O = {diameter}): the spindle would not turn",
        de: "für {operation} (Fräser O = {diameter}) ist keine Spindeldrehzahl bekannt: die Spindel stünde still",
        help_en: "add spindle = 12000 to [tool.NAME] with diameter = {diameter} in pathbuild.toml; if the spindle is switched by hand, write spindle = \"manual\" outside all tables",
        help_de: "spindle = 12000 in pathbuild.toml unter [tool.NAME] mit diameter = {diameter} eintragen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen schreiben",
    }
    /// A path without a tool, and so without a known spindle speed, although tools of its diameter are configured for other paths.
    SPINDLE_UNKNOWN_OF_PATH: MissingPostValue {
        en: "no spindle speed is known for path {path}: each [tool] with diameter = {diameter} is limited by `paths` to other names",
        de: "für Pfad {path} ist keine Spindeldrehzahl bekannt: jedes [tool] mit diameter = {diameter} gilt wegen seines `paths` nur für andere Namen",
        help_en: "change `paths` of one of these tools so that it matches {path}, or add another [tool.NAME] with diameter = {diameter} and spindle to pathbuild.toml",
        help_de: "`paths` eines dieser Werkzeuge so ändern, dass es auch auf {path} passt, oder ein weiteres [tool.NAME] mit diameter = {diameter} und spindle in pathbuild.toml eintragen",
    }
    /// A tool without a known spindle speed, in a program that states only the number of the tool.
    SPINDLE_UNKNOWN_OF_NUMBER: MissingPostValue {
        en: "no spindle speed is known for {operation} (T{index}): the spindle would not turn",
        de: "für {operation} (T{index}) ist keine Spindeldrehzahl bekannt: die Spindel stünde still",
        help_en: "put S and M3 into the program, or add [tool.NAME] with number = {index}, diameter and spindle to pathbuild.toml; if the spindle is switched by hand, write spindle = \"manual\" outside all tables",
        help_de: "S und M3 in das Programm aufnehmen oder [tool.NAME] mit number = {index}, diameter und spindle in pathbuild.toml eintragen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen schreiben",
    }
    /// A program without a known spindle speed and without a tool.
    SPINDLE_UNSTATED: MissingPostValue {
        en: "no spindle speed is known for {operation}: the program has no S with M3 or M4, and names no tool",
        de: "für {operation} ist keine Spindeldrehzahl bekannt: das Programm hat kein S mit M3 oder M4 und nennt kein Werkzeug",
        help_en: "put S and M3, or the tool (T1 M6), into the program; if the spindle is switched by hand, write spindle = \"manual\" outside all tables of pathbuild.toml",
        help_de: "S und M3 oder das Werkzeug (T1 M6) in das Programm aufnehmen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen von pathbuild.toml schreiben",
    }
    /// Different spindle speeds for one tool, with a definition that writes the speed only at tool changes.
    ONE_SPEED_A_TOOL: NothingToPost {
        en: "T{index} runs at {speed} and, in {operation}, at {other} 1/min, but this post writes one speed for each tool",
        de: "T{index} läuft mit {speed} und in {operation} mit {other} 1/min, dieser Postprozessor schreibt aber eine Drehzahl je Werkzeug",
        help_en: "give the second speed a tool number of its own in pathbuild.toml, or write a program for each path",
        help_de: "der zweiten Drehzahl in pathbuild.toml eine eigene Werkzeugnummer geben oder je Pfad ein Programm schreiben",
    }
    /// A spindle speed for some operations of a tool only, with a definition that writes the speed only at tool changes.
    SPEED_OF_SOME_OPERATIONS: NothingToPost {
        en: "T{index} runs at {speed} 1/min, but for {operation} no speed is known, and this post writes one speed for each tool",
        de: "T{index} läuft mit {speed} 1/min, für {operation} ist aber keine Drehzahl bekannt, und dieser Postprozessor schreibt eine je Werkzeug",
        help_en: "state S before the first cut of the program, or nowhere in it",
        help_de: "S vor dem ersten Schnitt des Programms angeben oder nirgends im Programm",
    }
    /// Note: the coolant is not switched as the program or the tool table says, because the definition lacks the macro for it.
    COOLANT_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the coolant setting of the program or the tool table does not reach the output",
        de: "der Postprozessor hat kein {macro}: die Ausgabe richtet sich nicht nach der Kühlung, die das Programm oder die Werkzeugtabelle bestimmt",
        help_en: "add {macro} to the post, or check how its texts switch the coolant",
        help_de: "{macro} in den Postprozessor aufnehmen oder prüfen, wie seine Texte die Kühlung schalten",
    }
    /// An output without a coolant word, although the job has the coolant on and the definition follows it.
    COOLANT_NEVER_ON: DoubtfulPost {
        en: "the program or the tool table switches the coolant on, but the output has neither M7 nor M8",
        de: "das Programm oder die Werkzeugtabelle schaltet die Kühlung ein, die Ausgabe enthält aber weder M7 noch M8",
        help_en: "correct the coolant words in the post; custom words for the coolant are not checked",
        help_de: "die Wörter für die Kühlung im Postprozessor berichtigen; eigene Wörter dafür werden nicht geprüft",
    }
    /// Note: the spindle is not switched as the program or the tool table says, because the definition lacks the macro for it.
    SPINDLE_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the spindle direction of the program or the tool table does not reach the output",
        de: "der Postprozessor hat kein {macro}: die Ausgabe richtet sich nicht nach der Drehrichtung, die das Programm oder die Werkzeugtabelle bestimmt",
        help_en: "add {macro} to the post, or check how its texts start the spindle",
        help_de: "{macro} in den Postprozessor aufnehmen oder prüfen, wie seine Texte die Spindel einschalten",
    }
    /// Note: the output does not wait until the spindle is up to speed.
    SPIN_UP_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the output does not wait until the spindle is up to speed, for which `spin-up` under [machine] sets the time",
        de: "der Postprozessor hat kein {macro}: die Ausgabe wartet nicht, bis die Spindel ihre Drehzahl erreicht hat; die Zeit dafür setzt `spin-up` unter [machine]",
        help_en: "add {macro} to the post, after the words that start the spindle",
        help_de: "{macro} in den Postprozessor aufnehmen, hinter den Wörtern, die die Spindel einschalten",
    }
    /// A word or character that the controller does not accept.
    WORD_REJECTED: RejectedWord {
        en: "line {line} of the output: {dialect} does not accept \"{word}\"",
        de: "Zeile {line} der Ausgabe: {dialect} nimmt \"{word}\" nicht an",
        help_en: "change the post's text, or name the dialect that the control really has",
        help_de: "den Text im Postprozessor ändern oder den Dialekt nennen, den die Steuerung wirklich hat",
    }
    /// Two words of a group in one line, such as G0 and G1, in the output of a definition without a dialect.
    WORDS_EXCLUDE: RejectedWord {
        en: "{first} and {second} must not be on the same line: controls refuse the line, or obey only one of the two",
        de: "{first} und {second} dürfen nicht in derselben Zeile stehen: Steuerungen lehnen sie ab oder befolgen nur eines von beiden",
        help_en: "write them on separate lines, or remove one of them",
        help_de: "in getrennte Zeilen schreiben oder eines entfernen",
    }
    /// A repeated letter in the output of a definition without a dialect.
    LETTER_REPEATED: RejectedWord {
        en: "{letter} occurs twice on one line: controls refuse the line, or obey only one of the two",
        de: "{letter} kommt in einer Zeile zweimal vor: Steuerungen lehnen sie ab oder befolgen nur eines von beiden",
        help_en: "remove one, or write it on a line of its own",
        help_de: "eines entfernen oder in eine eigene Zeile schreiben",
    }
    /// P beside G54 to G59 in the output of a definition without a dialect.
    SYSTEM_WITH_P: RejectedWord {
        en: "{word} with P is another coordinate system on some controls, and an error on others",
        de: "{word} mit P ist bei manchen Steuerungen ein anderes Koordinatensystem, bei anderen ein Fehler",
        help_en: "remove P, or name the control in the definition with <Dialect> or dialect = (see program/posts in the book)",
        help_de: "P entfernen oder die Steuerung in der Definition mit <Dialect> oder dialect = nennen (siehe program/posts im Buch)",
    }
    /// A `/` before a line that must not be skipped.
    LINE_SKIPPABLE: RejectedWord {
        en: "`/` begins a line that moves or selects the tool, sets its length, a mode or the feed, or switches the spindle: a switch at the machine (block delete) can skip it",
        de: "`/` beginnt eine Zeile, die fährt, das Werkzeug wählt, dessen Länge, einen Modus oder den Vorschub setzt oder die Spindel schaltet: ein Schalter an der Maschine (Sätze ausblenden) kann sie überspringen",
        help_en: "remove `/` from the text of the definition",
        help_de: "`/` aus dem Text der Definition entfernen",
    }
    /// A line of output that is longer than the dialect accepts.
    LINE_TOO_LONG: LineTooLong {
        en: "line {line} of the output has {length} characters; {dialect} accepts at most {longest}",
        de: "Zeile {line} der Ausgabe hat {length} Zeichen; {dialect} nimmt höchstens {longest} an",
        help_en: "give the post's number format fewer decimals, or split its texts into several lines",
        help_de: "dem Zahlenformat des Postprozessors weniger Nachkommastellen geben oder seine Texte auf mehrere Zeilen verteilen",
    }
    /// A comment that is longer than the target accepts a line to be.
    COMMENT_TOO_LONG: LineTooLong {
        en: "line {line} of the output is a comment of {length} characters; {dialect} accepts at most {longest}",
        de: "Zeile {line} der Ausgabe ist ein Kommentar von {length} Zeichen; {dialect} nimmt höchstens {longest} an",
        help_en: "shorten the comment in the program or the post from which it comes",
        help_de: "den Kommentar in dem Programm oder Postprozessor kürzen, aus dem er stammt",
    }
    /// Output that differs from the program when read back.
    POST_DIFFERS: PostDiffers {
        en: "line {line} of the output differs from the program",
        de: "Zeile {line} der Ausgabe weicht vom Programm ab",
        help_en: "check the post's text for this line; if you take responsibility for the output, set unchecked = true in [post] of pathbuild.toml",
        help_de: "den Text im Postprozessor für diese Zeile prüfen; wer selbst für die Ausgabe einsteht, setzt unchecked = true in [post] von pathbuild.toml",
    }
    /// Output that ends before all moves of the program are made.
    MOVES_LOST: PostDiffers {
        en: "the output ends before all moves of the program are complete",
        de: "die Ausgabe endet, bevor alle Bewegungen des Programms ausgeführt sind",
        help_en: "check the post's texts for moves; if you take responsibility for the output, set unchecked = true in [post] of pathbuild.toml",
        help_de: "die Texte für Bewegungen im Postprozessor prüfen; wer selbst für die Ausgabe einsteht, setzt unchecked = true in [post] von pathbuild.toml",
    }
    /// A cut at an unknown position, which cannot be compared.
    CUT_AT_UNKNOWN_PLACE: PostDiffers {
        en: "step {step} of the program cuts from or to an unknown position",
        de: "Schritt {step} des Programms fräst von oder zu einer unbekannten Position",
        help_en: "begin the program with absolute moves in Z, X and Y",
        help_de: "das Programm mit absoluten Bewegungen in Z, X und Y beginnen",
    }
    /// Note: a dwell of another length than in the program.
    DWELL_DIFFERS: PostDiffers {
        en: "the program dwells for {seconds} s, but the output for {found} s",
        de: "das Programm wartet {seconds} s, die Ausgabe aber {found} s",
    }
    /// Note: a dwell of the program that the output lacks.
    DWELL_LOST: PostDiffers {
        en: "the program dwells for {seconds} s, but this dwell is missing from the output or comes there in another order",
        de: "das Programm wartet {seconds} s, diese Wartezeit fehlt aber in der Ausgabe oder steht dort in anderer Reihenfolge",
    }
    /// Note: the spindle is not started before the first cut.
    SPINDLE_NOT_STARTED: PostDiffers {
        en: "the tool cuts here, but the output has not switched the spindle on, although it turns in the program; if the spindle is switched by hand, write spindle = \"manual\" outside all tables of pathbuild.toml",
        de: "hier wird gefräst, aber die Ausgabe hat die Spindel nicht eingeschaltet, obwohl sie sich im Programm dreht; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen von pathbuild.toml schreiben",
    }
    /// Note: the spindle turns in the wrong direction.
    SPINDLE_OTHER_WAY: PostDiffers {
        en: "here the spindle turns in the direction opposite to that in the program",
        de: "hier dreht sich die Spindel andersherum als im Programm",
    }
    /// Note: a cut without coolant, although the job has it on.
    COOLANT_OFF: PostDiffers {
        en: "the coolant is off during this cut, but the program or the tool table switches it on",
        de: "bei diesem Schnitt ist die Kühlung aus, das Programm oder die Werkzeugtabelle schaltet sie aber ein",
    }
    /// Note: a cut with coolant, although the job has it off.
    COOLANT_ON: PostDiffers {
        en: "the coolant is on during this cut, but the program or the tool table switches it off",
        de: "bei diesem Schnitt ist die Kühlung an, das Programm oder die Werkzeugtabelle schaltet sie aber aus",
    }
    /// Note: the spindle turns at a stop for the operator at which it stands still in the program.
    SPINDLE_TURNS_AT_STOP: PostDiffers {
        en: "the spindle turns at this stop, but in the program it stands still there",
        de: "bei diesem Halt dreht sich die Spindel, im Programm steht sie dort still",
    }
    /// Note: the spindle turns at another speed.
    SPINDLE_OTHER_SPEED: PostDiffers {
        en: "the spindle speed is {found} here, but {expected} in the program",
        de: "die Drehzahl ist hier {found}, im Programm aber {expected}",
    }
    /// Note: a cut with another tool than in the program.
    TOOL_OTHER: PostDiffers {
        en: "the output makes this cut with T{found}, but the program uses T{expected}",
        de: "die Ausgabe führt diesen Schnitt mit T{found} aus, das Programm aber mit T{expected}",
    }
    /// Note: a cut before T selects a tool or, if the post writes M6, before M6 inserts the tool.
    TOOL_NOT_SELECTED: PostDiffers {
        en: "the output has not changed to T{expected}, with which the program makes this cut",
        de: "die Ausgabe hat nicht auf T{expected} gewechselt, mit dem das Programm diesen Schnitt macht",
    }
    /// Note: a cut after T alone, on a control that changes tools only by M6 or by hand.
    TOOL_NOT_CHANGED: PostDiffers {
        en: "T alone does not change the tool on this control, and the output does not stop (M0) for T{expected}",
        de: "T allein wechselt auf dieser Steuerung kein Werkzeug, und die Ausgabe hält für T{expected} nicht an (M0)",
    }
    /// Note: a cut with the length of another tool, or with none.
    LENGTH_OTHER: PostDiffers {
        en: "the tool length in effect here is not that of T{expected}",
        de: "hier gilt nicht die Werkzeuglänge von T{expected}",
    }
    /// Note: the beam may be on during a rapid move.
    BEAM_ON: PostDiffers {
        en: "the beam is still on during this rapid move, and the post writes no Z that would raise the head",
        de: "der Strahl ist während dieses Eilgangs noch an, und der Postprozessor schreibt kein Z, das den Kopf anheben würde",
    }
    /// Note: a move to another point than in the program.
    GOES_ELSEWHERE: PostDiffers {
        en: "the tool goes to {found} here, but to {expected} in the program",
        de: "hier fährt das Werkzeug nach {found}, im Programm nach {expected}",
    }
    /// Note: a move to the right point along another curve than in the program.
    GOES_ANOTHER_WAY: PostDiffers {
        en: "the tool goes to {place} as in the program, but by a different route",
        de: "das Werkzeug fährt wie im Programm nach {place}, aber auf anderem Weg",
    }
    /// Note: a rapid move instead of a cut, or the reverse.
    GOES_AT_ANOTHER_PACE: PostDiffers {
        en: "this move is {found}, but in the program it is {expected}",
        de: "diese Bewegung ist {found}, im Programm aber {expected}",
    }
    /// Note: a move with another feed than in the program.
    GOES_WITH_ANOTHER_FEED: PostDiffers {
        en: "the feed is {found} here and {expected} in the program",
        de: "der Vorschub ist hier {found}, im Programm {expected}",
    }
    /// Note: a move after the last cut.
    GOES_TOO_FAR: PostDiffers {
        en: "the output goes on after the program's last cut, with {found} to {place}",
        de: "nach dem letzten Schnitt des Programms folgt hier noch {found} nach {place}",
    }
    /// Note: a move between two cuts that the program does not contain and that may hit material.
    WAY_NOT_FREE: PostDiffers {
        en: "this is {found} from {from} to {to}; between these two cuts the program makes no such move, or only a higher one",
        de: "das ist {found} von {from} nach {to}; zwischen diesen beiden Schnitten macht das Programm keine solche Bewegung oder nur eine weiter oben",
    }
    /// Note: between two pecks, the tool rises inside the hole only.
    PECK_STAYS_IN_HOLE: PostDiffers {
        en: "between two pecks, the tool rises only to Z {found} and stays in the hole, as with G73; in the program it leaves the hole, up to Z {expected}, to clear the chips (G83)",
        de: "zwischen zwei Stufen fährt das Werkzeug nur auf Z {found} und bleibt im Loch, wie bei G73; im Programm verlässt es das Loch, bis Z {expected}, damit die Späne herauskommen (G83)",
    }
    /// An M word or an axis with an unknown meaning, because no dialect is named.
    WORD_NOT_FOLLOWED: DoubtfulPost {
        en: "the output contains {word}, whose effect is unknown without a dialect",
        de: "die Ausgabe enthält {word}, dessen Wirkung ohne Dialekt unbekannt ist",
        help_en: "name the dialect of the control in the definition, or with `emit --dialect` or `post --target`",
        help_de: "den Dialekt der Steuerung in der Definition nennen oder mit `emit --dialect` oder `post --target`",
    }
    /// A G or M code that controls interpret differently, with no dialect named.
    DIALECTS_DISAGREE: DoubtfulPost {
        en: "controls disagree on the meaning of {words}, and no dialect is named",
        de: "die Bedeutung von {words} ist von Steuerung zu Steuerung verschieden, und kein Dialekt ist genannt",
        help_en: "name the dialect of the control in the definition, or with `emit --dialect` or `post --target`",
        help_de: "den Dialekt der Steuerung in der Definition nennen oder mit `emit --dialect` oder `post --target`",
    }
    /// A work offset in the output, such as G55.
    OFFSET_CHOSEN: DoubtfulPost {
        en: "the output selects a work offset of the machine ({word}), which determines the position of the drawing's zero",
        de: "die Ausgabe wählt eine Nullpunktverschiebung der Maschine ({word}), die die Lage des Zeichnungsnullpunkts bestimmt",
        help_en: "set that offset at the machine before each run, or remove the word from the post",
        help_de: "diese Verschiebung vor jedem Lauf an der Maschine setzen oder das Wort aus dem Postprozessor entfernen",
    }
    /// A spindle that is started or reversed after the last cut.
    SPINDLE_STARTED_AT_END: DoubtfulPost {
        en: "the output starts the spindle after the last cut",
        de: "die Ausgabe startet die Spindel nach dem letzten Schnitt",
        help_en: "remove M3 or M4 from the end of the post, or move it to the tool change",
        help_de: "M3 oder M4 aus dem Ende des Postprozessors entfernen oder in den Werkzeugwechsel setzen",
    }
    /// A zero that the output sets at the machine, such as G10 L2.
    ZERO_SET: DoubtfulPost {
        en: "the output sets a zero of the machine with {word}: the operator's zero is overwritten or shifted, and the drawing lies somewhere else",
        de: "die Ausgabe setzt mit {word} einen Nullpunkt der Maschine: der Nullpunkt des Bedieners wird überschrieben oder verschoben, und die Zeichnung liegt woanders",
        help_en: "set the zero at the machine before the program starts, and remove the word from the post",
        help_de: "den Nullpunkt vor dem Start des Programms an der Maschine setzen und das Wort aus dem Postprozessor entfernen",
    }
    /// G38.3 or G38.5 in an output for a target that has G38.2.
    PROBE_WITHOUT_ALARM: DoubtfulPost {
        en: "the output goes on if the probe touches nothing here; the program stops there with an error, as with G38.2",
        de: "die Ausgabe läuft weiter, wenn der Taster hier nichts berührt; das Programm hält dann mit einem Fehler an, wie bei G38.2",
        help_en: "write G38.2 in the post's text for probes",
        help_de: "im Text des Postprozessors zum Antasten G38.2 schreiben",
    }
    /// Note: absolute centres of arcs in an output without G90.1.
    CENTRES_NOT_STATED: PostDiffers {
        en: "the post writes absolute centres for arcs, but G90.1 is missing, without which controls count I and J from the start of the arc: write G90.1 before the first arc (in a .cbpp with the macro $arccentermode), or write centres relative to the arc's start",
        de: "der Postprozessor schreibt absolute Bogenmittelpunkte, aber G90.1 fehlt, und ohne G90.1 zählen Steuerungen I und J vom Anfang des Bogens: vor dem ersten Bogen G90.1 schreiben (in einer .cbpp mit dem Makro $arccentermode), oder Mittelpunkte relativ zum Bogenanfang schreiben",
    }
    /// A tool length in the output that does not come from an entry of the tool table, such as that of G43.1.
    LENGTH_CHOSEN: DoubtfulPost {
        en: "the output applies a tool length with {word}, but it is not known whether this is the length of the tool",
        de: "die Ausgabe setzt mit {word} eine Werkzeuglänge, es ist aber nicht bekannt, ob das die Länge des Werkzeugs ist",
        help_en: "write G43 with the tool's number as H, or check the length at the machine",
        help_de: "G43 mit der Nummer des Werkzeugs als H schreiben oder die Länge an der Maschine prüfen",
    }
    /// Note: the line of the output that contains the problem. The output is not written, so that no file contains it.
    IN_OUTPUT: PostDiffers {
        en: "in line {line} of the output",
        de: "in Zeile {line} der Ausgabe",
    }
    /// Note: the line of one of several files that contains the problem.
    IN_OUTPUT_FILE: PostDiffers {
        en: "in line {line} of {name}",
        de: "in Zeile {line} von {name}",
    }
    /// Note: the section and line of the definition that wrote the line of output.
    WRITTEN_BY_LINE: PostDiffers {
        en: "the line comes from {section}, line {at} of the definition",
        de: "die Zeile stammt aus {section}, Zeile {at} der Definition",
    }
    /// Note: the section with the default text that wrote the line of output.
    WRITTEN_BY: PostDiffers {
        en: "the line comes from the default text of {section}, which the definition does not contain",
        de: "die Zeile stammt aus dem vorgegebenen Text von {section}, den die Definition nicht enthält",
    }
    /// A work offset other than G54, in a program to be written through a post.
    JOB_SYSTEM: NothingToPost {
        en: "{word} selects a work offset, which a post does not write: everything after it would be milled somewhere else",
        de: "{word} wählt eine Nullpunktverschiebung, die ein Postprozessor nicht schreibt: alles danach würde woanders gefräst",
        help_en: "write a separate program for each work offset, without {word}; select the offset at the machine or in the texts of the post",
        help_de: "für jede Nullpunktverschiebung ein eigenes Programm ohne {word} schreiben; die Verschiebung an der Maschine oder in den Texten des Postprozessors wählen",
    }
    /// A cut from or to an unknown position, for example after G91, in a program to be written through a post.
    JOB_PLACE_UNKNOWN: NothingToPost {
        en: "a cut from or to an unknown position cannot be written through a post",
        de: "einen Schnitt von oder zu einer unbekannten Position kann kein Postprozessor schreiben",
        help_en: "before the first cut, move to X, Y and Z once with absolute coordinates (G90)",
        help_de: "vor dem ersten Schnitt X, Y und Z einmal mit absoluten Koordinaten (G90) anfahren",
    }
    /// A rapid move that counts from an unknown position, such as G91 after a probe, in a program to be written through a post.
    JOB_WAY_UNKNOWN: NothingToPost {
        en: "this move counts from a position that only the machine knows, so it cannot be written through a post",
        de: "diese Bewegung zählt von einer Position aus, die nur die Maschine kennt; das kann kein Postprozessor schreiben",
        help_en: "write the height or place with absolute coordinates (G90)",
        help_de: "die Höhe oder den Ort mit absoluten Koordinaten (G90) schreiben",
    }
    /// A program that switches the spindle off for a stop or a dwell, for a post that is defined by CAD6 control texts.
    JOB_SPINDLE_OFF: NothingToPost {
        en: "{operation} switches the spindle off before it stops or waits, and this post can only do so at a tool change",
        de: "{operation} schaltet die Spindel vor einem Halt oder einer Wartezeit aus; dieser Postprozessor kann das nur beim Werkzeugwechsel",
        help_en: "split the program at the stop, or use a post in the language of CamBam",
        help_de: "das Programm am Halt teilen oder einen Postprozessor in der Sprache von CamBam verwenden",
    }
    /// A cut with the length of another tool, or without a length where the tool has one, in a program to be written through a post.
    JOB_LENGTH: NothingToPost {
        en: "cuts after this line use a tool length (H) that a post cannot write: it writes one length for each tool, with the tool's own number",
        de: "Schnitte nach dieser Zeile verwenden eine Werkzeuglänge (H), die ein Postprozessor nicht schreiben kann: er schreibt je Werkzeug eine Länge mit der Nummer des Werkzeugs",
        help_en: "name the tool with T, and write H with the same number once after each tool change",
        help_de: "das Werkzeug mit T nennen und nach jedem Werkzeugwechsel einmal H mit derselben Nummer schreiben",
    }
    /// A zero or a tool length that the program sets at the machine, in a program to be written through a post.
    JOB_ZERO: NothingToPost {
        en: "{word} sets a zero or a tool length at the machine, and a post does not write it: everything after it would be milled somewhere else",
        de: "{word} setzt an der Maschine einen Nullpunkt oder eine Werkzeuglänge, und ein Postprozessor schreibt das nicht: alles danach würde woanders gefräst",
        help_en: "set the zero and the length at the machine before the program starts, and remove the word if the program then counts from there",
        help_de: "Nullpunkt und Länge vor dem Start des Programms an der Maschine setzen und das Wort entfernen, wenn das Programm dann von dort aus zählt",
    }
    /// A value that only the machine knows, such as the height that a probe found.
    JOB_MACHINE_VALUE: NothingToPost {
        en: "only the machine knows {parameter}, so what depends on it cannot be written through a post",
        de: "nur die Maschine kennt {parameter}; was davon abhängt, kann kein Postprozessor schreiben",
        help_en: "measure and calculate in a program written for the machine: a post can only write numbers",
        help_de: "in einem Programm messen und rechnen, das für die Maschine geschrieben ist: ein Postprozessor kann nur Zahlen schreiben",
    }
    /// M6 without T in the middle of a program.
    JOB_TOOL_UNNAMED: NothingToPost {
        en: "the tool is changed here, but the program does not name the new one",
        de: "hier wird das Werkzeug gewechselt, aber das Programm nennt das neue nicht",
        help_en: "write T with the tool's number before M6",
        help_de: "T und die Nummer des Werkzeugs vor M6 setzen",
    }
    /// A plunge directly after a tool change.
    CUT_AFTER_CHANGE: NothingToPost {
        en: "{operation} continues at Z {z}, below the surface at {surface}, right after the change to T{index}: the new tool would plunge where the old one ended",
        de: "{operation} geht gleich nach dem Wechsel zu T{index} bei Z {z} weiter, unter der Oberfläche bei {surface}: das neue Werkzeug würde eintauchen, wo das alte aufgehört hat",
        help_en: "put a rapid move to a place above the material between the tool change and the next cut",
        help_de: "zwischen Werkzeugwechsel und nächstem Schnitt einen Eilgang über das Material setzen",
    }
    /// A native program without the comment that names its path, if several tools have its O.
    CUTTER_OF_UNNAMED_PATH: NothingToPost {
        en: "several tools have the program's O = {diameter} ({first}, {second}), and the comment that would decide between them by naming the program's path is missing",
        de: "mehrere Werkzeuge haben das O = {diameter} des Programms ({first}, {second}), und es fehlt der Kommentar mit dem Namen des Pfads, der zwischen ihnen entscheidet",
        help_en: "restore the comment `(Path NAME, drawing FILE)` below this line, or write the program from its drawing with `pathbuild emit`",
        help_de: "den Kommentar `(Path NAME, drawing DATEI)` unter dieser Zeile wiederherstellen oder das Programm mit `pathbuild emit` aus seiner Zeichnung schreiben",
    }
    /// Native programs for different tools in one file.
    SEVERAL_NATIVE_PROGRAMS: NothingToPost {
        en: "a program for the tool {tool} begins here, but the file begins with one for the tool {first}",
        de: "hier beginnt ein Programm für das Werkzeug {tool}, die Datei aber mit einem für das Werkzeug {first}",
        help_en: "post each program from a file of its own, or write the paths into one program with tool changes: pathbuild emit PATHS --join NAME",
        help_de: "jedes Programm aus einer eigenen Datei umschreiben oder die Pfade in ein Programm mit Werkzeugwechseln schreiben: pathbuild emit PFADE --join NAME",
    }
    /// A stop with the cutter in the material and the spindle off.
    CUT_AFTER_STOP: NothingToPost {
        en: "{operation} goes on at Z {z}, below the surface at {surface}, after a stop or a dwell with the spindle off: a post starts the spindle above the material and would plunge there once more",
        de: "{operation} geht nach einem Halt oder einer Wartezeit mit stehender Spindel bei Z {z} weiter, unter der Oberfläche bei {surface}: ein Postprozessor startet die Spindel über dem Material und würde dort noch einmal eintauchen",
        help_en: "raise the cutter above the material before the spindle is switched off",
        help_de: "den Fräser über das Material heben, bevor die Spindel ausgeschaltet wird",
    }
    /// A move to a machine position (G28, G30 or G53), in a program to be written through a post.
    JOB_NAMED_PLACE: NothingToPost {
        en: "a move to a position that only the machine knows cannot be written through a post",
        de: "eine Bewegung an eine Position, die nur die Maschine kennt, kann kein Postprozessor schreiben",
        help_en: "remove the move; if the machine needs it, put it into the texts of the post",
        help_de: "die Bewegung entfernen; braucht die Maschine sie, in die Texte des Postprozessors schreiben",
    }
    /// A move that cannot be written through a post: an arc of several turns, or a probing move away from the material.
    JOB_MOVE: NothingToPost {
        en: "a move of this kind (an arc of several turns, probing away from the material) cannot be written through a post",
        de: "eine Bewegung dieser Art (ein Bogen mit mehreren Umläufen, Antasten vom Material weg) kann kein Postprozessor schreiben",
        help_en: "write an arc of several turns as single turns; leave probing away from the material to a program written for the machine",
        help_de: "einen Bogen mit mehreren Umläufen als einzelne Umläufe schreiben; das Antasten vom Material weg einem Programm überlassen, das für die Maschine geschrieben ist",
    }
    /// A definition's command that failed or could not be run.
    POST_BUILD_FAILED: PostBuildFailed {
        en: "the post's command \"{command}\" failed: {reason}",
        de: "der Befehl \"{command}\" des Postprozessors ist fehlgeschlagen: {reason}",
        help_en: "correct the command, or run it by hand; the program itself was written",
        help_de: "den Befehl berichtigen oder von Hand ausführen; das Programm selbst wurde geschrieben",
    }
    /// A definition's command that is not run, because the repository is untrusted.
    POST_BUILD_REFUSED: PostBuildFailed {
        en: "the post's command \"{command}\" is not run: the repository is not trusted",
        de: "der Befehl \"{command}\" des Postprozessors wird nicht ausgeführt: dem Repository wird nicht vertraut",
        help_en: "leave out --run-post-build; nothing was written",
        help_de: "--run-post-build weglassen; es wurde nichts geschrieben",
    }
    /// A path with probes that is written through a post.
    POST_WITH_PROBES: UncorrectedHeights {
        en: "the path has Z-probes: written through a post, its heights would stay uncorrected",
        de: "der Pfad hat Z-Proben: ein Postprozessor würde seine Höhen unkorrigiert schreiben",
        help_en: "run emit without a post, measure, run `pathbuild adjust`, then `pathbuild post DRAWING_Milling.gcode --post POST`",
        help_de: "emit ohne Postprozessor ausführen, messen, `pathbuild adjust` ausführen, dann `pathbuild post ZEICHNUNG_Milling.gcode --post POST`",
    }
    /// A program with correction formulas that were not applied, to be written through a post.
    POST_UNADJUSTED: UncorrectedHeights {
        en: "the program has correction formulas that have not been worked out yet: a post would write its heights uncorrected",
        de: "das Programm hat Korrekturformeln, die noch nicht ausgerechnet sind: ein Postprozessor würde seine Höhen unkorrigiert schreiben",
        help_en: "run `pathbuild adjust` first, and use the _Milling.gcode that it writes",
        help_de: "zuerst `pathbuild adjust` ausführen und die _Milling.gcode nehmen, die es schreibt",
    }
}
