//! Messages about following a G-code program: calls, positions, offsets, feeds, and arcs. (PB701 to PB738, PB773 to PB789; book: program/reading)
//!
//! `{dialect}` is the name of the dialect in which the file is read.

messages! {
    /// A comment that the controller obeys, such as `(LOGOPEN,name)`.
    ACTIVE_COMMENT: ActiveComment {
        en: "{dialect} obeys this comment: {word}",
        de: "{dialect} führt diesen Kommentar aus: {word}",
        help_en: "if it is only a remark, begin it with another word",
        help_de: "ein anderes Wort davorsetzen, wenn es nur eine Bemerkung ist",
    }
    /// A program without M2, M30 or %.
    NO_END: NoProgramEnd {
        en: "the program ends without {words}",
        de: "das Programm endet ohne {words}",
        help_en: "check whether the file was cut off; if not, write M30 on its last line",
        help_de: "prüfen, ob die Datei abgeschnitten ist; wenn nicht, M30 in die letzte Zeile schreiben",
    }
    /// An O word (subroutine or branch) that is not interpreted.
    O_WORD: WordNotFollowed {
        en: "pathbuild does not interpret this O word; the lines below are read once, in the order of the file",
        de: "pathbuild wertet dieses O-Wort nicht aus; die Zeilen darunter werden einmal gelesen, in der Reihenfolge der Datei",
        help_en: "write the moves out, or check the program at the control",
        help_de: "die Bewegungen ausschreiben oder das Programm an der Steuerung prüfen",
    }
    /// A call of a subprogram that the file lacks.
    CALLED_ELSEWHERE: WordNotFollowed {
        en: "the subprogram {name} is not in this file: its moves are not known",
        de: "das Unterprogramm {name} steht nicht in dieser Datei: seine Bewegungen sind unbekannt",
        help_en: "put it after the program in the same file, or check the program at the control",
        help_de: "es in derselben Datei hinter das Programm schreiben oder das Programm an der Steuerung prüfen",
    }
    /// Two subprograms with the same number or name.
    DEFINED_TWICE: WordNotFollowed {
        en: "the subprogram {name} is in this file twice: which one the control calls depends on its settings",
        de: "das Unterprogramm {name} steht zweimal in dieser Datei: welches die Steuerung aufruft, hängt von ihren Einstellungen ab",
        help_en: "remove one of them, or give it another number",
        help_de: "eines davon entfernen oder anders nummerieren",
    }
    /// A subprogram that calls itself, directly or through others, or that calls the main program. That call is not interpreted.
    CALLED_BY_ITSELF: WordNotFollowed {
        en: "the subprogram {name} calls itself; this call is left out",
        de: "das Unterprogramm {name} ruft sich selbst auf; dieser Aufruf wird ausgelassen",
        help_en: "write a loop with a number of repetitions instead",
        help_de: "stattdessen eine Schleife mit einer Anzahl von Wiederholungen schreiben",
    }
    /// A subprogram or loop without its last line.
    CALLED_WITHOUT_END: WordNotFollowed {
        en: "{name} has no end in this file",
        de: "{name} hat in dieser Datei kein Ende",
        help_en: "end subprograms with M99 or endsub, `repeat` and `while` loops with `endrepeat` and `endwhile`, `do` loops with `while`, and branches with `endif`",
        help_de: "Unterprogramme mit M99 oder endsub beenden, Schleifen mit endrepeat oder endwhile, do-Schleifen mit while, Verzweigungen mit endif",
    }
    /// A `do` loop that LinuxCNC ends too early, because an earlier `while` loop was left by `break`.
    ENDED_BY_EARLIER_BREAK: WordNotFollowed {
        en: "LinuxCNC ends the do loop {name} here, although its condition holds, because a break left a while loop in line {earlier}",
        de: "LinuxCNC beendet die do-Schleife {name} hier, obwohl ihre Bedingung erfüllt ist, weil ein break in Zeile {earlier} eine while-Schleife verlassen hat",
        help_en: "write a while loop instead of the do loop, or end the earlier loop by its condition",
        help_de: "statt der do-Schleife eine while-Schleife schreiben, oder die frühere Schleife durch ihre Bedingung beenden",
    }
    /// A loop that LinuxCNC repeats once too often, because of an earlier `continue` in a `do` loop.
    REPEATED_BY_EARLIER_CONTINUE: WordNotFollowed {
        en: "LinuxCNC begins the loop {name} again where it should end, because of the continue in a do loop in line {earlier}",
        de: "LinuxCNC beginnt die Schleife {name} erneut, wo sie enden sollte, wegen des continue in einer do-Schleife in Zeile {earlier}",
        help_en: "in line {earlier}, write an if around the rest of the pass instead of continue",
        help_de: "in Zeile {earlier} statt continue den Rest des Durchgangs in ein if setzen",
    }
    /// `break` or `continue` outside of the loop that it names.
    LEFT_WITHOUT_LOOP: WordNotFollowed {
        en: "this word leaves the loop {name}, which is not running here",
        de: "dieses Wort verlässt die Schleife {name}, die hier nicht läuft",
        help_en: "write the number of the while or do loop that contains this line",
        help_de: "die Nummer der while- oder do-Schleife angeben, in der diese Zeile steht",
    }
    /// The end of a subprogram that was not called, in the main program.
    END_WITHOUT_CALL: WordNotFollowed {
        en: "a subprogram ends here, but none was called: some controls begin the program again",
        de: "hier endet ein Unterprogramm, es wurde aber keines aufgerufen: manche Steuerungen beginnen das Programm von vorn",
        help_en: "end the main program with M30",
        help_de: "das Hauptprogramm mit M30 beenden",
    }
    /// Calls and loops that are nested more deeply than the limit.
    CALLS_TOO_DEEP: WordNotFollowed {
        en: "subprograms and loops are nested more than {most} levels deep: this one is left out",
        de: "Unterprogramme und Schleifen sind mehr als {most} Ebenen tief verschachtelt: diese Ebene wird ausgelassen",
        help_en: "nest fewer levels: replace the innermost calls and loops with the moves that they make",
        help_de: "weniger Ebenen verschachteln: die innersten Aufrufe und Schleifen durch ihre Bewegungen ersetzen",
    }
    /// Calls and loops that execute more lines than the limit.
    CALLS_TOO_LONG: WordNotFollowed {
        en: "subprograms and loops execute more than {most} lines: the rest of the program is not read",
        de: "Unterprogramme und Schleifen führen mehr als {most} Zeilen aus: der Rest des Programms wird nicht gelesen",
        help_en: "check how often loops and subprograms are repeated",
        help_de: "prüfen, wie oft Schleifen und Unterprogramme wiederholt werden",
    }
    /// A command that is not interpreted, although it may affect later moves.
    NOT_FOLLOWED: WordNotFollowed {
        en: "pathbuild does not interpret {word}: from here on, the machine may move differently",
        de: "pathbuild wertet {word} nicht aus: ab hier kann sich die Maschine anders bewegen",
        help_en: "check the program at the control, or write the moves out",
        help_de: "das Programm an der Steuerung prüfen oder die Bewegungen ausschreiben",
    }
    /// G28.1 or G30.1, which overwrites the home position that the control stores.
    HOME_STORED: OffsetLeftOn {
        en: "{word} permanently stores the current position as the home position of the control: from now on, {home} in any other program moves here",
        de: "{word} macht diese Stelle dauerhaft zur Referenzposition der Steuerung: von nun an fährt {home} in jedem anderen Programm hierher",
        help_en: "remove the word, or store the usual home position again afterwards",
        help_de: "das Wort entfernen oder danach die übliche Referenzposition wieder speichern",
    }
    /// G28 of Marlin after the first cut, which changes the zero point.
    REFERENCED: WordNotFollowed {
        en: "with {word}, {dialect} moves to the reference switches, and then counts from them, no longer from the zero of the part",
        de: "mit {word} fährt {dialect} auf die Referenzschalter und zählt danach von ihnen aus, nicht mehr vom Nullpunkt des Werkstücks",
        help_en: "home the machine before you start the program; to park it at the end, raise the cutter and move to a position in the coordinates of the part",
        help_de: "die Maschine vor dem Programmstart referenzieren; zum Parken am Ende den Fräser anheben und eine Position in den Koordinaten des Werkstücks anfahren",
    }
    /// G92.1 or G92.2 after the operator has touched off.
    ZERO_CLEARED: WordNotFollowed {
        en: "{word} returns to the zero that was in effect before G92, and only the machine knows how far that is from where the tool stood at G92",
        de: "{word} kehrt zum Nullpunkt zurück, der vor G92 galt, und nur die Maschine weiß, wie weit er von der Stelle entfernt ist, an der das Werkzeug bei G92 stand",
        help_en: "write {word} after the last move, or set the zero again with G92 before the next one",
        help_de: "{word} hinter die letzte Bewegung schreiben oder den Nullpunkt vor der nächsten mit G92 neu setzen",
    }
    /// F words that are ignored because of an option.
    FEED_IGNORED: IgnoredWord {
        en: "F is ignored because of the option --ignore-feed: the feeds of the layers apply",
        de: "F wird wegen der Option --ignore-feed übergangen: es gelten die Vorschübe der Layer",
    }
    /// A speed that replaces an earlier one of the same layer.
    SPEED_REPLACED: IgnoredWord {
        en: "layer {layer} already has the speed {old}; {new} replaces it",
        de: "Layer {layer} hat schon die Drehzahl {old}; {new} ersetzt sie",
        help_en: "give each layer only one S",
        help_de: "jedem Layer nur ein S geben",
    }
    /// A dwell for a number of turns of the spindle before a speed is set.
    TURNS_WITHOUT_SPEED: MissingWord {
        en: "this dwell is given in turns of the spindle, but no spindle speed is set",
        de: "diese Wartezeit ist in Umdrehungen der Spindel angegeben, es ist aber keine Drehzahl gesetzt",
        help_en: "set the speed with S on an earlier line, or write the dwell in seconds",
        help_de: "die Drehzahl mit S in einer früheren Zeile setzen oder die Wartezeit in Sekunden schreiben",
    }
    /// Coordinates in a line while no motion mode is active.
    NO_MOTION: MissingWord {
        en: "these coordinates have no motion word: none of G0 to G3 is active here",
        de: "diese Koordinaten haben kein Bewegungswort: hier ist keines von G0 bis G3 aktiv",
        help_en: "write G0 or G1 before them",
        help_de: "G0 oder G1 davorsetzen",
    }
    /// A drilling cycle of more moves than the limit.
    TOO_MANY_STROKES: ValueOutOfRange {
        en: "this line drills with {count} moves; pathbuild interprets at most {most}",
        de: "diese Zeile bohrt mit {count} Bewegungen; pathbuild wertet höchstens {most} aus",
        help_en: "correct the depth, the depth of a peck (Q) or the number of holes",
        help_de: "die Tiefe, die Tiefe je Hub (Q) oder die Zahl der Bohrungen berichtigen",
    }
    /// G53 while G91 is active, which together give no position.
    MACHINE_COORDINATES_RELATIVE: ConflictingWords {
        en: "G53 counts from the machine's zero, but G91 from where the tool is: together they give no position",
        de: "G53 zählt ab Maschinennull, G91 aber ab der Werkzeugposition: zusammen ergeben sie kein Ziel",
        help_en: "switch to G90 first",
        help_de: "vorher auf G90 schalten",
    }
    /// G53 with a motion other than G0 and G1.
    MACHINE_COORDINATES_MOTION: ConflictingWords {
        en: "G53 works only with G0 and G1",
        de: "G53 wirkt nur zusammen mit G0 und G1",
        help_en: "write G0 or G1 on the same line",
        help_de: "G0 oder G1 in dieselbe Zeile schreiben",
    }
    /// An expression without a value, for example because of a division by zero.
    NO_VALUE: CannotEvaluate {
        en: "the expression has no value: {reason}; the line is ignored",
        de: "der Ausdruck hat keinen Wert: {reason}; die Zeile bleibt unbeachtet",
    }
    /// A parameter with a value that only the machine knows.
    MACHINE_VALUE: MachineValue {
        en: "only the machine knows {parameter}; {value} is assumed",
        de: "nur die Maschine kennt {parameter}; {value} wird angenommen",
        help_en: "check at the machine everything that depends on this value",
        help_de: "an der Maschine alles prüfen, was von diesem Wert abhängt",
    }
    /// A work offset with an unknown position, such as that of G55.
    OFFSET_UNKNOWN: UnknownOffset {
        en: "the position of {system} is unknown; it is assumed to be that of {base}",
        de: "die Lage von {system} ist unbekannt; angenommen wird die von {base}",
        help_en: "rely on lengths and on the overall size only if the program stays within one work offset",
        help_de: "sich auf Längen und Abmessungen nur verlassen, wenn das Programm bei einer einzigen Nullpunktverschiebung bleibt",
    }
    /// G10 L2 for the active work offset, which had an unknown position before.
    ORIGIN_UNKNOWN: UnknownOffset {
        en: "G10 L2 counts from the machine's zero, and the previous position of {system} is unknown; it is assumed to be at the machine's zero",
        de: "G10 L2 zählt vom Maschinennullpunkt aus, und die vorige Lage von {system} ist unbekannt; angenommen wird der Maschinennullpunkt",
        help_en: "set the origin with G10 before the first move",
        help_de: "den Nullpunkt mit G10 vor der ersten Bewegung setzen",
    }
    /// G28, G30 or G53 with an unknown target.
    POSITION_UNKNOWN: UnknownOffset {
        en: "the target of {word} is unknown, so the next move begins at an unknown position",
        de: "das Ziel von {word} ist unbekannt; die nächste Bewegung beginnt daher an unbekannter Stelle",
        help_en: "check at the machine that nothing is in the way of the next move: pathbuild leaves such moves out of lengths and checks",
        help_de: "an der Maschine prüfen, dass der Weg der nächsten Bewegung frei ist: bei Längen und Prüfungen lässt pathbuild solche Bewegungen aus",
    }
    /// A program that does not state its unit.
    UNITS_NOT_STATED: UnitsNotStated {
        en: "there is no {inch} or {mm} before the first move; millimetres are assumed",
        de: "vor der ersten Bewegung fehlt {inch} oder {mm}; Millimeter werden angenommen",
        help_en: "state the unit: otherwise, the control keeps that of the previous program",
        help_de: "die Einheit angeben: die Steuerung behält sonst die des vorigen Programms",
    }
    /// A cut with an F that was stated before a change of the unit, on a control that may read its number in the new unit.
    FEED_IN_OTHER_UNIT: UnitChanged {
        en: "this cut uses the F of line {line}, which is in {unit}: after the change of the unit, {dialect} may read its number as {other}",
        de: "dieser Schnitt nimmt das F aus Zeile {line}, das in {unit} angegeben ist: nach dem Wechsel der Einheit kann {dialect} die Zahl als {other} lesen",
        help_en: "write F again in the new unit",
        help_de: "F in der neuen Einheit noch einmal angeben",
    }
    /// A move with a G52 or G92 that was stated before a change of the unit, on a control that may read its numbers in the new unit.
    OFFSET_IN_OTHER_UNIT: UnitChanged {
        en: "this move counts from the offset of line {line}, which is in {unit}: after the change of the unit, {dialect} may read its numbers as {other}",
        de: "diese Bewegung zählt ab der Verschiebung aus Zeile {line}, die in {unit} angegeben ist: nach dem Wechsel der Einheit kann {dialect} die Zahlen als {other} lesen",
        help_en: "cancel the offset before the change of the unit, and set it again after it",
        help_de: "die Verschiebung vor dem Wechsel der Einheit aufheben und danach neu setzen",
    }
    /// A hole with an R, Z or Q that was stated before a change of the unit.
    CYCLE_IN_OTHER_UNIT: UnitChanged as Error {
        en: "this hole uses the {word} of line {line}, which is in {unit}: after the change of the unit, controls such as LinuxCNC read the number as {other}",
        de: "diese Bohrung verwendet das {word} aus Zeile {line}, das in {unit} angegeben ist: nach dem Wechsel der Einheit lesen Steuerungen wie LinuxCNC die Zahl als {other}",
        help_en: "write R, Z and Q again in the new unit",
        help_de: "R, Z und Q in der neuen Einheit noch einmal angeben",
    }
    /// G20 and G21 in one program, for a control on which the unit is a setting of the machine.
    UNIT_IS_SETTING: UnitChanged as Error {
        en: "{word} contradicts the unit set earlier in the program: {dialect} has only one unit, that of Setting 9, and stops with an alarm",
        de: "{word} widerspricht der Einheit, die das Programm vorher gesetzt hat: {dialect} hat nur eine Einheit, die aus Setting 9, und hält mit einem Alarm an",
        help_en: "write the whole program in one unit",
        help_de: "das ganze Programm in einer Einheit schreiben",
    }
    /// Coordinates after a tool change, without a motion word, while a drilling cycle is on.
    CYCLE_LEFT_ON: CycleLeftOn {
        en: "this line drills: {word} is still on, although line {line} has changed the tool",
        de: "diese Zeile bohrt: {word} gilt noch, obwohl Zeile {line} das Werkzeug gewechselt hat",
        help_en: "write G80 before the tool change; if the new tool is to drill, write the cycle again with the R and Z of that tool",
        help_de: "vor dem Wechsel G80 schreiben; soll das neue Werkzeug bohren, den Zyklus mit seinem R und Z noch einmal schreiben",
    }
    /// G53 with a low Z, while the tool is at a known position in the plane and thus may be over the part.
    LOW_MACHINE_HEIGHT: UnknownOffset {
        en: "only the machine knows whether Z {z} of G53 is above the material",
        de: "nur die Maschine weiß, ob Z {z} von G53 über dem Material liegt",
        help_en: "raise the tool with `G53 G0 Z0`; to go down beside the part, move over that place with `G53 G0 X Y` first",
        help_de: "das Werkzeug mit `G53 G0 Z0` heben; ist ein Platz neben dem Teil gemeint, zuerst mit `G53 G0 X Y` dorthin fahren",
    }
    /// A unit that contradicts a comment.
    UNITS_CONTRADICTED: UnitsNotStated {
        en: "{word} is read as {unit}, but the comment says {comment}",
        de: "{word} wird als {unit} gelesen, aber der Kommentar sagt {comment}",
        help_en: "choose the right meaning with `--unit-codes`: the table of XpertMILL's import filter contradicts its examples",
        help_de: "mit `--unit-codes` die richtige Bedeutung wählen: die Tabelle des Importfilters von XpertMILL widerspricht seinen Beispielen",
    }
    /// A program that does not state whether its coordinates are absolute.
    DISTANCE_NOT_STATED: ModesNotStated {
        en: "there is neither G90 nor G91 before the first move that depends on them; G90 is assumed",
        de: "vor der ersten Bewegung, die davon abhängt, fehlt G90 oder G91; G90 wird angenommen",
        help_en: "write one of them: otherwise, the control keeps what the previous program set",
        help_de: "eines der beiden Wörter angeben: die Steuerung behält sonst, was das vorige Programm gesetzt hat",
    }
    /// A program that does not state a mode such as G17.
    MODES_NOT_STATED: ModesNotStated {
        en: "there is no {words} before the first move that depends on it; {taken} is assumed",
        de: "vor der ersten Bewegung, die davon abhängt, fehlt {words}; {taken} wird angenommen",
        help_en: "write it: otherwise, the control keeps what the previous program set",
        help_de: "das Wort angeben: die Steuerung behält sonst, was das vorige Programm gesetzt hat",
    }
    /// A program that does not state to which height the tool rises after a hole.
    RETRACT_NOT_STATED: ModesNotStated {
        en: "there is neither G98 nor G99 before the first hole; G99 is assumed, so the tool goes to the next hole at R",
        de: "vor dem ersten Loch fehlt G98 oder G99; G99 wird angenommen, das Werkzeug fährt also auf R zum nächsten Loch",
        help_en: "write one of them: otherwise, the control keeps what the previous program set",
        help_de: "eines der beiden Wörter angeben: die Steuerung behält sonst, was das vorige Programm gesetzt hat",
    }
    /// Coordinates without a motion word, as XpertMILL accepts them.
    MOTION_NOT_STATED: MotionNotStated {
        en: "these coordinates have no motion word and are read as another {word}; it is not known whether {dialect} does the same",
        de: "diese Koordinaten haben kein Bewegungswort und werden als weiteres {word} gelesen; ob {dialect} das auch tut, ist nicht bekannt",
        help_en: "write the motion word on every line",
        help_de: "das Bewegungswort in jede Zeile schreiben",
    }
    /// A helix in a dialect that may not support it.
    HELIX_DOUBTFUL: DoubtfulArc {
        en: "this is an arc with Z, which {dialect} is not known to accept",
        de: "das ist ein Bogen mit Z; es ist nicht bekannt, ob {dialect} solche Bögen annimmt",
        help_en: "write short lines instead",
        help_de: "stattdessen kurze Strecken schreiben",
    }
    /// A cut while no feed is set.
    NO_FEED: MissingFeed {
        en: "this cutting move has no feed",
        de: "diese Fräsbewegung hat keinen Vorschub",
        help_en: "write F on this line or an earlier one",
        help_de: "F in diese oder eine frühere Zeile schreiben",
    }
    /// A cut without a feed after G94 cleared it.
    FEED_CLEARED: MissingFeed {
        en: "this cutting move has no feed: {word} in line {line} has cleared F",
        de: "diese Fräsbewegung hat keinen Vorschub: {word} in Zeile {line} hat F gelöscht",
        help_en: "write F after {word}",
        help_de: "F nach {word} schreiben",
    }
    /// G93 without F.
    INVERSE_TIME_WITHOUT_FEED: MissingFeed {
        en: "with G93 every cutting move needs its own F",
        de: "mit G93 braucht jede Fräsbewegung ihr eigenes F",
        help_en: "write F on this line, or switch to G94",
        help_de: "F in diese Zeile schreiben oder auf G94 schalten",
    }
    /// A cut with G95 before a spindle speed is set.
    FEED_PER_TURN_WITHOUT_SPEED: MissingFeed {
        en: "with G95 the feed depends on the spindle, and no speed is set",
        de: "mit G95 hängt der Vorschub von der Spindel ab, und es ist keine Drehzahl gesetzt",
        help_en: "set S, or switch to G94",
        help_de: "S setzen oder auf G94 schalten",
    }
    /// An arc with different radii at its ends.
    RADII_DIFFER: ArcRadiiDiffer {
        en: "the arc begins with the radius {start} and ends with {end}: the difference is {difference} mm more than {dialect} accepts",
        de: "der Bogen beginnt mit dem Radius {start} und endet mit {end}: der Unterschied ist {difference} mm größer, als {dialect} zulässt",
        help_en: "write {centre} with more decimals, or check the centre",
        help_de: "{centre} mit mehr Nachkommastellen schreiben oder den Mittelpunkt prüfen",
    }
    /// An arc with neither centre nor radius.
    ARC_WITHOUT_CENTRE: InvalidArc {
        en: "an arc needs {centre} or R",
        de: "ein Bogen braucht {centre} oder R",
    }
    /// An arc with both centre and radius.
    ARC_WITH_CENTRE_AND_RADIUS: InvalidArc {
        en: "the arc has both R and {centre}, which contradict each other",
        de: "der Bogen hat R und {centre}, die einander widersprechen",
        help_en: "remove R: {centre} are more accurate",
        help_de: "R entfernen: {centre} sind genauer",
    }
    /// An arc without a required axis word.
    ARC_WITHOUT_END: InvalidArc {
        en: "{dialect} requires at least one of {axes} in an arc, even if none of them changes",
        de: "{dialect} verlangt mindestens eines von {axes} in einem Bogen, auch wenn sich keines davon ändert",
        help_en: "repeat the coordinates",
        help_de: "die Koordinaten wiederholen",
    }
    /// A full circle given by its radius.
    RADIUS_FULL_CIRCLE: InvalidArc {
        en: "an arc with R cannot end where it begins",
        de: "ein Bogen mit R kann nicht enden, wo er beginnt",
        help_en: "write a full circle with {centre}",
        help_de: "einen Vollkreis mit {centre} schreiben",
    }
    /// A radius that is too small for the ends of the arc.
    RADIUS_TOO_SMALL: InvalidArc {
        en: "the radius {radius} is too small: the arc's ends are {chord} apart",
        de: "der Radius {radius} ist zu klein: die Enden des Bogens liegen {chord} auseinander",
        help_en: "make R at least half of that distance",
        help_de: "R mindestens auf die Hälfte dieses Abstands setzen",
    }
    /// An arc with its centre at its start.
    RADIUS_ZERO: InvalidArc {
        en: "the arc's radius is 0",
        de: "der Radius des Bogens ist 0",
        help_en: "correct {centre}, which give the centre as seen from the start of the arc, except with G90.1 or, for xpertmill, --absolute-arc-centres",
        help_de: "{centre} berichtigen: sie geben den Mittelpunkt vom Anfang des Bogens aus an, außer mit G90.1 oder, bei xpertmill, --absolute-arc-centres",
    }
    /// An arc given by its radius that is nearly a half circle, so that the centre is imprecise.
    NEAR_HALF_CIRCLE: DoubtfulArc {
        en: "the centre of this arc with R moves by {shift} mm if R changes by {change} mm, which is the precision of the program's numbers",
        de: "der Mittelpunkt dieses Bogens mit R wandert um {shift} mm, wenn sich R um {change} mm ändert; genauer sind die Zahlen des Programms nicht",
        help_en: "write the arc with I and J, or with more decimals",
        help_de: "den Bogen mit I und J oder mit mehr Nachkommastellen schreiben",
    }
    /// An arc that is nearly a full circle.
    NEAR_FULL_CIRCLE: DoubtfulArc {
        en: "the arc's ends are only {gap} mm apart: it is run as {degrees} degrees, but their last digit decides between a tiny arc and a full circle",
        de: "die Enden des Bogens liegen nur {gap} mm auseinander: er wird mit {degrees} Grad gefahren, aber die letzte Ziffer der Koordinaten entscheidet zwischen winzigem Bogen und Vollkreis",
        help_en: "for a full circle, give the arc the same start and end; otherwise remove the arc",
        help_de: "für einen Vollkreis Anfang und Ende gleich schreiben; sonst den Bogen entfernen",
    }
    /// An arc that turns back at both ends, where an arc in the other direction would continue the neighbouring cuts.
    ARC_DOUBLES_BACK: DoubtfulArc {
        en: "the arc turns back at both of its ends: with {word} it would continue the cuts before and after it",
        de: "der Bogen kehrt an beiden Enden um: mit {word} würde er die Schnitte davor und danach fortsetzen",
        help_en: "check the direction of the arc",
        help_de: "die Richtung des Bogens prüfen",
    }
    /// A stop of the spindle in a line with a move, which the control executes after the stop.
    STOP_BEFORE_MOTION: StopBeforeMotion {
        en: "{word} is obeyed before the move of this line, while the cutter is still in the material",
        de: "{word} wird vor der Bewegung dieser Zeile ausgeführt, während der Fräser noch im Material ist",
        help_en: "put {word} on the next line",
        help_de: "{word} in die nächste Zeile setzen",
    }
    /// A program that would require more cells than the limit to simulate its material.
    TOO_LARGE_TO_FOLLOW: LimitReached {
        en: "simulating the material of this program takes more grid cells than the limit of {limit}; rapid moves into material are not checked",
        de: "um das Material dieses Programms zu simulieren, sind mehr als die erlaubten {limit} Rasterzellen nötig; Eilgänge ins Material werden nicht geprüft",
        help_en: "correct numbers that are far too large, or raise `{key}` under [limits] in pathbuild.toml",
        help_de: "viel zu große Zahlen berichtigen oder `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A program with arcs and slopes that are divided into more pieces than the limit, to simulate the material.
    TOO_MANY_PIECES: LimitReached {
        en: "to simulate the material, the arcs and slopes of this program are divided into {count} pieces, which exceeds the limit of {limit}; rapid moves into material are not checked",
        de: "um das Material zu simulieren, werden die Bögen und schrägen Bewegungen dieses Programms in {count} Stücke geteilt, mehr als die erlaubten {limit}; Eilgänge ins Material werden nicht geprüft",
        help_en: "correct radii and heights that are far too large, or raise `{key}` under [limits] in pathbuild.toml",
        help_de: "viel zu große Radien und Höhen berichtigen oder `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A probing move that does not go down.
    USELESS_PROBE: UselessProbe {
        en: "the probing move does not go down, so it touches nothing",
        de: "die Antastbewegung führt nicht nach unten und berührt daher nichts",
        help_en: "probe towards the material; G38.4 and G38.5 go away from it",
        help_de: "zum Material hin antasten; G38.4 und G38.5 führen von ihm weg",
    }
    /// A probing move while the spindle turns.
    PROBE_WITH_SPINDLE_ON: ProbeWithSpindleOn {
        en: "the spindle turns during this probing move: the cutter mills the touch plate, or the probe breaks",
        de: "bei dieser Antastbewegung dreht sich die Spindel: der Fräser fräst in die Messplatte, oder der Taster bricht ab",
        help_en: "stop the spindle with M5 first, and start it again after probing",
        help_de: "die Spindel vorher mit M5 anhalten und nach dem Antasten wieder einschalten",
    }
    /// G64 with a P above the limit.
    CORNERS_ROUNDED: RoundedCorners {
        en: "the control may round corners by up to {most} mm (G64 P), which is more than {limit} mm",
        de: "die Steuerung darf Ecken um bis zu {most} mm verrunden (G64 P), das sind mehr als {limit} mm",
        help_en: "write G64 with a P of at most {limit} mm, or G61; if the part permits more, set `part-tolerance` in pathbuild.toml",
        help_de: "G64 mit einem P von höchstens {limit} mm schreiben, oder G61; erlaubt das Teil mehr, `part-tolerance` in pathbuild.toml setzen",
    }
    /// A probing move without length.
    PROBE_WITHOUT_WAY: UselessProbe {
        en: "the probing move ends where it begins",
        de: "die Antastbewegung endet, wo sie beginnt",
        help_en: "probe down to a height below the material's surface",
        help_de: "bis zu einer Höhe unter der Oberfläche des Materials antasten",
    }
}
