//! Messages about verifying G-code. (PB739 to PB791; book: program/reading)

messages! {
    /// `verify --against`: no T word selects the tool before the first cut.
    TOOL_NOT_CHOSEN: MovesDiffer {
        en: "the tool is not selected before the first cut: the drawing's program selects it with {expected}",
        de: "vor dem ersten Schnitt ist das Werkzeug nicht gewählt: im Programm der Zeichnung steht {expected}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a mode such as `G54` that is missing before the first move.
    MODE_MISSING: MovesDiffer {
        en: "{word} is missing before the first move: the control may keep what the previous program set",
        de: "{word} fehlt vor der ersten Bewegung: die Steuerung behält womöglich, was das vorige Programm gesetzt hat",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a coolant word (M7 to M9) other than that for the drawing's cutter.
    COOLANT_DIFFERS: MovesDiffer {
        en: "the coolant is `{found}`, but for the drawing's cutter it must be `{expected}`",
        de: "die Kühlung ist `{found}`, für den Fräser der Zeichnung muss sie aber `{expected}` sein",
        help_en: "write the program again with `pathbuild emit`, or correct `coolant` in [tool.NAME]",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder `coolant` in [tool.NAME] berichtigen",
    }
    /// `verify --against`: a word that the drawing's program does not contain.
    NOT_IN_DRAWING: MovesDiffer {
        en: "{word} is not in the drawing's program: it may change where, how deep or how fast the tool cuts",
        de: "{word} steht nicht im Programm der Zeichnung: es kann ändern, wo, wie tief oder wie schnell gefräst wird",
        help_en: "remove it, or write the program again with `pathbuild emit`",
        help_de: "das Wort entfernen oder das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a move to another point than in the drawing's program.
    DRAWN_ELSEWHERE: MovesDiffer {
        en: "the tool goes to {found}; the drawing says {expected}",
        de: "das Werkzeug fährt nach {found}, laut Zeichnung aber nach {expected}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a move to the right point along another curve.
    DRAWN_OTHERWISE: MovesDiffer {
        en: "the tool goes to this point by a different route than in the drawing's program",
        de: "das Werkzeug fährt auf anderem Weg zu diesem Punkt als in der Zeichnung",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a rapid move instead of a cut, or the reverse.
    DRAWN_AT_ANOTHER_PACE: MovesDiffer {
        en: "this move is {found}, but the drawing's program has {expected} here",
        de: "diese Bewegung ist {found}, im Programm der Zeichnung steht hier aber {expected}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a move with another feed than in the drawing's program.
    DRAWN_WITH_ANOTHER_FEED: MovesDiffer {
        en: "the feed is {found}; the drawing says {expected}",
        de: "der Vorschub ist {found}, laut Zeichnung aber {expected}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: missing moves at the end.
    DRAWN_FURTHER: MovesDiffer {
        en: "moves are missing at the end: the drawing goes on to {expected}",
        de: "am Ende fehlen Bewegungen: die Zeichnung geht weiter nach {expected}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: additional moves at the end.
    NOT_DRAWN: MovesDiffer {
        en: "the drawing's program ends before this move, but here the tool goes on to {found}",
        de: "das Programm der Zeichnung endet vor dieser Bewegung, hier fährt das Werkzeug aber noch nach {found}",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a probing program with another move than the drawing's.
    PROBING_NOT_DRAWN: MovesDiffer {
        en: "the drawing's probing program has `{expected}` here",
        de: "das Antastprogramm der Zeichnung hat hier `{expected}`",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a probing program that goes on after the end of the drawing's.
    PROBING_ENDED: MovesDiffer {
        en: "this line is not in the drawing's probing program, which ends before it",
        de: "diese Zeile ist zu viel: das Antastprogramm der Zeichnung endet davor",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against` and `diff`: a program that joins several paths.
    JOINED_PROGRAM: MovesDiffer {
        en: "the program joins several paths, so it cannot be compared with one path",
        de: "das Programm verbindet mehrere Pfade, lässt sich also nicht mit einem Pfad vergleichen",
        help_en: "compare it with `pathbuild emit PATHS --join NAME --check`, and verify it without --against",
        help_de: "es mit `pathbuild emit PFADE --join NAME --check` vergleichen und ohne --against prüfen",
    }
    /// `diff`: a probing program and a path.
    PROBING_PROGRAM: MovesDiffer {
        en: "the program only probes, and `diff` compares what is milled",
        de: "das Programm tastet nur an, und `diff` vergleicht, was gefräst wird",
        help_en: "compare the milling program with the path, and this one with `pathbuild verify PROGRAM --against PATH`",
        help_de: "das Fräsprogramm mit dem Pfad vergleichen, dieses mit `pathbuild verify PROGRAMM --against PFAD`",
    }
    /// `verify --against` with a program that was corrected by probes and then converted.
    CONVERTED_CORRECTION: MovesDiffer {
        en: "the heights of this program were corrected by probes, but the converted program no longer says by how much",
        de: "die Höhen dieses Programms sind nach Proben korrigiert, aber das umgewandelte Programm sagt nicht mehr, um wie viel",
        help_en: "compare the NAME_Milling.gcode that adjust wrote with --against, and verify this program without --against",
        help_de: "die NAME_Milling.gcode, die adjust geschrieben hat, mit --against vergleichen und dieses Programm ohne --against prüfen",
    }
    /// `verify --against`: a probing program that a definition of the user's own wrote.
    PROBING_CONVERTED: MovesDiffer {
        en: "the program only probes, and a definition of your own wrote it: --against compares the probing programs of `emit` and of the built-in posts with the drawing, but not this one",
        de: "das Programm tastet nur an, und eine eigene Definition hat es geschrieben: --against vergleicht Antastprogramme von `emit` und der eingebauten Postprozessoren mit der Zeichnung, dieses aber nicht",
        help_en: "compare the file NAME_Probing.gcode with --against, and verify this one without --against",
        help_de: "die Datei NAME_Probing.gcode mit --against vergleichen und diese ohne --against prüfen",
    }
    /// `verify --against`: another tool than the drawing needs.
    TOOLS_DIFFER: MovesDiffer {
        en: "the tool is T{found}, but the drawing needs T{expected}",
        de: "das Werkzeug ist T{found}, die Zeichnung braucht aber T{expected}",
        help_en: "write the program again with `pathbuild emit`, or correct `number` in [tool.NAME]",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder `number` in [tool.NAME] berichtigen",
    }
    /// `verify --against`: a line with words of unknown effect, which the post's definition does not write.
    LINE_NOT_WRITTEN: MovesDiffer {
        en: "the definition writes \"{expected}\" here, but this program has other words, whose effect is unknown",
        de: "die Definition schreibt hier \"{expected}\", dieses Programm enthält aber andere Wörter, deren Wirkung unbekannt ist",
        help_en: "write the program again with `pathbuild emit`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: moves that were not compared, because the definition is marked as unchecked.
    MOVES_NOT_COMPARED: DoubtfulPost {
        en: "the moves were not compared with path {path}: with unchecked = true, it is unknown whether the output of {post} mills the drawing",
        de: "die Bewegungen wurden nicht mit dem Pfad {path} verglichen: mit unchecked = true ist nicht bekannt, ob die Ausgabe von {post} die Zeichnung fräst",
        help_en: "remove `unchecked` in pathbuild.toml and write the program again with `pathbuild emit`, or check its moves by hand",
        help_de: "`unchecked` in pathbuild.toml entfernen und das Programm mit `pathbuild emit` neu schreiben, oder seine Bewegungen selbst prüfen",
    }
    /// `verify --against`: another program number (O) than that of the drawing's program.
    NUMBERS_DIFFER: MovesDiffer {
        en: "the program's number is O{found}, but the drawing's is O{expected}: on the control, O{found} may be another program",
        de: "die Programmnummer ist O{found}, für die Zeichnung ist sie O{expected}: in der Steuerung kann O{found} ein anderes Programm sein",
        help_en: "write the program again with `pathbuild emit`; if the control uses a different number for it, set `program-number`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben; hat es in der Steuerung eine andere Nummer, `program-number` setzen",
    }
    /// `verify --against`: a program without the number by which the control identifies it.
    NUMBER_MISSING: MovesDiffer {
        en: "the program lacks its number, which is O{expected} according to the drawing: the control may take the first N for the number and overwrite another program",
        de: "dem Programm fehlt die Nummer O{expected}, die es laut Zeichnung hat: die Steuerung nimmt vielleicht das erste N dafür und überschreibt ein anderes Programm",
        help_en: "write O{expected} at the beginning, or write the program again with `pathbuild emit`",
        help_de: "O{expected} an den Anfang schreiben, oder das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a tool length offset (G43, H) other than that of the tool in the spindle.
    LENGTHS_DIFFER: MovesDiffer {
        en: "the tool length in effect is not that of the tool in the spindle",
        de: "es gilt nicht die Länge des eingewechselten Werkzeugs",
        help_en: "write G43 H with the number of the tool in the spindle; in a native program, remove G43",
        help_de: "G43 H mit der Nummer des mit M6 eingewechselten Werkzeugs schreiben; aus einem nativen Programm G43 entfernen",
    }
    /// `verify --against`: a spindle direction or speed other than that for the drawing's cutter.
    SPINDLES_DIFFER: MovesDiffer {
        en: "the spindle runs with `{found}`, but the drawing's cutter needs `{expected}`",
        de: "die Spindel läuft mit `{found}`, der Fräser der Zeichnung braucht aber `{expected}`",
        help_en: "write the program again with `pathbuild emit`, or correct [tool.NAME]",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder [tool.NAME] berichtigen",
    }
    /// `verify --against`: a hole with C that is drilled in deeper strokes.
    STROKE_TOO_DEEP: MovesDiffer {
        en: "the tool drills {found} mm in one stroke; according to C in the drawing, each peck is at most {expected} mm deep",
        de: "das Werkzeug bohrt {found} mm auf einmal; laut C in der Zeichnung ist jede Stufe höchstens {expected} mm tief",
        help_en: "correct Q of the cycle, or write the program again with `pathbuild emit`",
        help_de: "Q des Zyklus berichtigen oder das Programm mit `pathbuild emit` neu schreiben",
    }
    /// `verify --against`: a cut before the program switches the spindle on.
    SPINDLE_NOT_SWITCHED: MovesDiffer {
        en: "the program has not switched the spindle on, but the drawing's cutter needs `{expected}`",
        de: "das Programm hat die Spindel nicht eingeschaltet, der Fräser der Zeichnung braucht aber `{expected}`",
        help_en: "write the program again with `pathbuild emit`, or correct [tool.NAME]",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder [tool.NAME] berichtigen",
    }
    /// `verify --against`: a program that ends with the spindle or the coolant on.
    STOP_MISSING: MovesDiffer {
        en: "the program ends without {word}, which the drawing's program has",
        de: "das Programm endet ohne {word}, das im Programm der Zeichnung steht",
        help_en: "add {word} at the end, or write the program again with `pathbuild emit`: it may have been cut off",
        help_de: "{word} am Ende ergänzen oder das Programm mit `pathbuild emit` neu schreiben: vielleicht wurde es abgeschnitten",
    }
    /// `verify --against`: a cut too soon after the spindle was switched on, because the dwell is missing or too short.
    SPUN_UP_TOO_SHORT: MovesDiffer {
        en: "the tool starts cutting less than {seconds} s after the spindle was switched on",
        de: "das Werkzeug beginnt früher als {seconds} s nach dem Einschalten der Spindel zu fräsen",
        help_en: "rewrite the program with `pathbuild emit`, which waits for the time in `[machine] spin-up`",
        help_de: "das Programm mit `pathbuild emit` neu schreiben; es wartet dann so lange, wie `[machine] spin-up` angibt",
    }
    /// Rapid moves down and up again without a feed move between them, as in `G0 Z-3`, `G0 X50`, `G0 Z2`.
    RAPID_DIP: RapidPlunge {
        en: "a rapid move goes down to Z {z}, below the material's surface, and up again where nothing was cut before",
        de: "ein Eilgang fährt unter die Oberfläche des Materials auf Z {z} hinunter und wieder hinauf, wo vorher nichts gefräst wurde",
        help_en: "drill or mill with G01 and a feed",
        help_de: "mit G01 und einem Vorschub bohren oder fräsen",
    }
    /// A move to a machine position, such as `G28`, while the tool is below the surface of the material.
    HOME_FROM_DEPTH: RapidInMaterial {
        en: "a rapid move to a fixed position of the machine starts at Z {z}, but the material reaches up to Z {surface}",
        de: "ein Eilgang zu einer festen Position der Maschine beginnt bei Z {z}, das Material reicht aber bis Z {surface}",
        help_en: "raise the tool above the material first",
        help_de: "das Werkzeug zuerst über das Material heben",
    }
    /// The first move in another coordinate system, while the tool is below the surface of the material.
    SYSTEM_FROM_DEPTH: RapidInMaterial {
        en: "a move to a place in another coordinate system starts at Z {z}, but the material reaches up to Z {surface}",
        de: "eine Bewegung zu einer Stelle in einem anderen Koordinatensystem beginnt bei Z {z}, das Material reicht aber bis Z {surface}",
        help_en: "raise the tool above the material first",
        help_de: "das Werkzeug zuerst über das Material heben",
    }
    /// A cut with the spindle on at speed 0 (`M3 S0`).
    SPINDLE_AT_ZERO: SpindleOff {
        en: "this is a cutting move with the spindle at speed 0",
        de: "diese Fräsbewegung läuft bei Drehzahl 0",
        help_en: "write the speed with S: `M3 S12000`",
        help_de: "die Drehzahl mit S angeben: `M3 S12000`",
    }
    /// A cut with the spindle on before any S word. Many controls then use the speed of the previous program.
    SPINDLE_WITHOUT_SPEED: SpindleOff as Warning {
        en: "this is a cutting move at an unknown spindle speed: the program has no S before it, so the control takes the last one, or 0",
        de: "diese Fräsbewegung läuft mit unbekannter Drehzahl: das Programm nennt vorher kein S, die Steuerung nimmt daher das letzte oder 0",
        help_en: "write the speed with S: `M3 S12000`; if it is set at the machine, accept this warning with `--accept`",
        help_de: "die Drehzahl mit S angeben: `M3 S12000`; wird sie an der Maschine eingestellt, die Warnung mit `--accept` hinnehmen",
    }
    /// An offset by G92 or G52 that is active at the end.
    OFFSET_LEFT_ON: OffsetLeftOn {
        en: "the offset of {word} is still active at the end, so the next program is shifted by it",
        de: "die Verschiebung von {word} gilt am Ende noch; das nächste Programm wird daher verschoben gefräst",
        help_en: "write G92.1, or G52 X0 Y0 Z0, before the end",
        help_de: "vor dem Ende G92.1 schreiben oder G52 X0 Y0 Z0",
    }
    /// A height that differs from the value of its formula. The machine uses the height.
    FORMULA_DIFFERS: FormulaDiffers {
        en: "the machine goes to the height {number}, but the correction formula gives {value}",
        de: "die Maschine fährt auf {number}, die Formel ergibt aber {value}",
        help_en: "run `emit` and `adjust` again: the program was edited",
        help_de: "noch einmal emit und adjust aufrufen: das Programm wurde bearbeitet",
    }
    /// A formula that differs from that in the drawing's program.
    FORMULA_NOT_DRAWN: FormulaDiffers {
        en: "the formula is {found}, but according to the drawing it must be {expected}",
        de: "die Formel ist {found}, laut Zeichnung muss sie aber {expected} sein",
        help_en: "run `emit` and `adjust` again: the program was edited, or written with another `z-model`",
        help_de: "noch einmal emit und adjust aufrufen: das Programm wurde bearbeitet oder mit einem anderen `z-model` geschrieben",
    }
    /// A probe that differs from that in the drawing's program.
    PROBE_NOT_DRAWN: FormulaDiffers {
        en: "the program has the probe {found}, but the drawing has {expected}",
        de: "das Programm hat die Probe {found}, die Zeichnung aber {expected}",
        help_en: "run `emit` again, and measure with the new program",
        help_de: "noch einmal emit aufrufen und mit dem neuen Programm messen",
    }
    /// A formula with a probe that the program's header does not list.
    PROBE_NOT_STATED: UncheckedFormula {
        en: "the formula uses #{probe}, which the program's header does not state",
        de: "die Formel verwendet #{probe}, das der Kopf des Programms nicht nennt",
        help_en: "run `emit` and `adjust` again: the program was edited",
        help_de: "noch einmal emit und adjust aufrufen: das Programm wurde bearbeitet",
    }
    /// A formula that was applied, although the program's header does not list a measured height for it.
    HEIGHT_NOT_MEASURED: UncheckedFormula {
        en: "the formula has been worked out, but the program's header does not state the measured height of #{probe}",
        de: "die Formel ist ausgerechnet, der Kopf des Programms nennt aber keine gemessene Höhe von #{probe}",
        help_en: "run `adjust` again: an older version adjusted the program, or it was edited",
        help_de: "noch einmal adjust aufrufen: eine ältere Version hat das Programm angepasst, oder es wurde bearbeitet",
    }
    /// A formula that was not applied in an adjusted program.
    FORMULA_NOT_APPLIED: UncheckedFormula {
        en: "this formula has not been worked out, although the program's header states measured heights",
        de: "diese Formel ist nicht ausgerechnet, obwohl der Kopf des Programms gemessene Höhen nennt",
        help_en: "run `adjust` again",
        help_de: "noch einmal adjust aufrufen",
    }
    /// A formula in a program without probes.
    FORMULA_WITHOUT_PROBES: UncheckedFormula {
        en: "the program has a correction formula, but no probes",
        de: "das Programm hat eine Korrekturformel, aber keine Proben",
        help_en: "run `emit` again: the program was edited",
        help_de: "noch einmal emit aufrufen: das Programm wurde bearbeitet",
    }
    /// A formula without a value, for example because of a division by zero.
    FORMULA_WITHOUT_VALUE: UncheckedFormula {
        en: "the formula has no value: it divides by 0, or its result is too large",
        de: "die Formel hat keinen Wert: sie teilt durch 0, oder ihr Ergebnis ist zu groß",
        help_en: "run `emit` and `adjust` again: the program was edited",
        help_de: "noch einmal emit und adjust aufrufen: das Programm wurde bearbeitet",
    }
    /// A height without a formula in a program with probes. The height at the start needs none.
    HEIGHT_WITHOUT_FORMULA: UncheckedFormula {
        en: "this height has no correction formula",
        de: "diese Höhe hat keine Korrekturformel",
        help_en: "run `emit` and `adjust` again: an editor or the sending program may have removed the formula",
        help_de: "noch einmal emit und adjust aufrufen: ein Editor oder das Sendeprogramm hat die Formel vielleicht entfernt",
    }
    /// A probe that the header lists twice, with different values.
    PROBE_STATED_TWICE: UncheckedFormula {
        en: "the header states #{probe} twice, with different values",
        de: "der Kopf nennt #{probe} zweimal, mit verschiedenen Werten",
        help_en: "run `emit` and `adjust` again: the program was edited",
        help_de: "noch einmal emit und adjust aufrufen: das Programm wurde bearbeitet",
    }
    /// An adjusted program that does not list its measured heights.
    HEIGHTS_NOT_STATED: UncheckedFormula as Warning {
        en: "the program does not state its measured heights, so the numbers before its formulas are not checked",
        de: "das Programm nennt seine gemessenen Höhen nicht; die Zahlen vor den Formeln sind darum nicht geprüft",
        help_en: "adjust the program with pathbuild, which writes the heights into the header",
        help_de: "das Programm mit pathbuild anpassen: adjust schreibt die Höhen in den Kopf",
    }
    /// A program whose formulas `adjust` has not worked out.
    UNADJUSTED: UncorrectedHeights as Warning {
        en: "the heights of this program are still to be corrected: a control takes its formulas for comments",
        de: "die Höhen dieses Programms sind noch zu korrigieren: eine Steuerung hält seine Formeln für Kommentare",
        help_en: "run `pathbuild adjust`, and mill with the _Milling.gcode that it writes",
        help_de: "`pathbuild adjust` ausführen und mit der _Milling.gcode fräsen, die es schreibt",
    }
    /// A cut of a program by pathbuild that is deep below the plate.
    CUT_BELOW_PLATE: Disagreement {
        en: "pathbuild wrote this program, with Z 0 on the plate, but this cut goes down to Z {z}: {depth} mm below the plate",
        de: "das Programm ist von pathbuild, mit Z 0 auf der Platte, aber dieser Schnitt geht bis Z {z} hinunter: {depth} mm unter die Platte",
        help_en: "if the program was edited, check its numbers, or compare it with its drawing (--against PATH); set `below-plate` under [warnings] to allow more than {limit} mm",
        help_de: "wurde das Programm bearbeitet, seine Zahlen prüfen oder es mit seiner Zeichnung vergleichen (--against PFAD); mit `below-plate` unter [warnings] mehr als {limit} mm erlauben",
    }
    /// A probe of a program by pathbuild that would go deep below the plate.
    PROBE_BELOW_PLATE: Disagreement {
        en: "pathbuild wrote this program, with Z 0 on the plate, but this probe goes down to Z {z} if it touches nothing: {depth} mm below the plate",
        de: "das Programm ist von pathbuild, mit Z 0 auf der Platte, aber dieses Antasten geht bis Z {z} hinunter, wenn es nichts berührt: {depth} mm unter die Platte",
        help_en: "if the program was edited, check its numbers, or compare it with its drawing (--against PATH); set `below-plate` under [warnings] to allow more than {limit} mm",
        help_de: "wurde das Programm bearbeitet, seine Zahlen prüfen oder es mit seiner Zeichnung vergleichen (--against PFAD); mit `below-plate` unter [warnings] mehr als {limit} mm erlauben",
    }
    /// A comment of a probing program without the probe that it announces.
    PROBE_MISSING: Disagreement as Error {
        en: "the comment in line {comment} announces a probe, but no probing move down follows it",
        de: "der Kommentar in Zeile {comment} kündigt ein Antasten an, aber darauf folgt keine Antastbewegung nach unten",
        help_en: "write the probing program again: with G1 in place of G38.2 (or of G31 on Fanuc, Haas and Mach3), the tool does not stop at the touch plate",
        help_de: "das Antastprogramm neu schreiben: mit G1 statt G38.2 (bei Fanuc, Haas und Mach3 statt G31) hält das Werkzeug nicht an der Messplatte",
    }
    /// Inches in a program that pathbuild has written in millimetres.
    INCHES_OF_PATHBUILD: Disagreement {
        en: "pathbuild wrote this program, and writes all programs in millimetres, but this word selects inches",
        de: "das Programm ist von pathbuild, das alle Programme in Millimetern schreibt, aber dieses Wort stellt auf Zoll um",
        help_en: "restore the word that emit wrote, or compare the program with its drawing (--against PATH)",
        help_de: "das Wort wiederherstellen, das emit geschrieben hat, oder das Programm mit seiner Zeichnung vergleichen (--against PFAD)",
    }
    /// A cutter in the header that differs from the tool table.
    OTHER_CUTTER_IN_TABLE: Disagreement {
        en: "the header says that the cutter's diameter is {header} mm, but T{index} of `[tool]` has {table} mm",
        de: "laut Kopf hat der Fräser {header} mm; T{index} in `[tool]` hat {table} mm",
        help_en: "use the cutter named in the header, or correct `[tool]`; until then, the check of rapid moves removes material with the smaller cutter and looks for collisions with the larger one",
        help_de: "den Fräser einsetzen, den der Kopf nennt, oder `[tool]` berichtigen; bis dahin rechnet die Prüfung der Eilgänge beim Abtragen mit dem kleineren Fräser und bei Kollisionen mit dem größeren",
    }
    /// A cutter diameter in the header or the tool table that differs from `--cutter`.
    OTHER_CUTTER_GIVEN: Disagreement {
        en: "{place} says that the cutter's diameter is {found} mm, but --cutter says {given} mm",
        de: "{place} gibt den Fräser mit {found} mm an, --cutter mit {given} mm",
        help_en: "correct the wrong value; until then, the check of rapid moves removes material with the smaller cutter and looks for collisions with the larger one",
        help_de: "den falschen Wert berichtigen; bis dahin rechnet die Prüfung der Eilgänge beim Abtragen mit dem kleineren Fräser und bei Kollisionen mit dem größeren",
    }
    /// A cutter diameter in the header or an option that differs from the drawing's.
    OTHER_CUTTER_DRAWN: Disagreement {
        en: "{place} says that the cutter is O{found}, but the drawing says O{drawn}",
        de: "{place} nennt als Fräser O{found}, die Zeichnung aber O{drawn}",
        help_en: "write the program again with `pathbuild emit`, or leave the option out",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder die Option weglassen",
    }
    /// A height of the surface in the header or an option that differs from the drawing's.
    OTHER_SURFACE_DRAWN: Disagreement {
        en: "{place} says that the surface is at {found}, but the drawing says {drawn}",
        de: "{place} gibt die Oberfläche mit {found} an, die Zeichnung aber mit {drawn}",
        help_en: "write the program again with `pathbuild emit`, or leave the option out",
        help_de: "das Programm mit `pathbuild emit` neu schreiben oder die Option weglassen",
    }
    /// A height of the surface in the header that differs from `--surface`.
    OTHER_SURFACE_GIVEN: Disagreement {
        en: "the header says that the surface is at Z {found}, but --surface says {given}",
        de: "laut Kopf liegt die Oberfläche bei Z {found}, laut --surface bei {given}",
        help_en: "correct the wrong value; until then, the check of rapid moves assumes material up to the higher one",
        help_de: "den falschen Wert berichtigen; bis dahin rechnet die Prüfung der Eilgänge mit Material bis zum höheren",
    }
    /// Plunges of a native program that begin to cut at another height than the surface given by an option.
    PLUNGES_ABOVE_SURFACE: Disagreement {
        en: "plunges of this program begin to cut at Z {found}, but according to --surface the material begins at {given}",
        de: "beim Eintauchen beginnt das Fräsen in diesem Programm bei Z {found}, laut --surface liegt die Oberfläche bei {given}",
        help_en: "correct the wrong value; until then, the check of rapid moves assumes material up to the higher one",
        help_de: "den falschen Wert berichtigen; bis dahin rechnet die Prüfung der Eilgänge mit Material bis zum höheren",
    }
    /// A program whose cuts all end above the surface given by an option.
    CUTS_ABOVE_SURFACE: Disagreement {
        en: "the lowest cut is at Z {found}, but according to --surface the material begins at {given}: the program cuts nothing",
        de: "der tiefste Schnitt liegt auf Z {found}, laut --surface beginnt das Material bei {given}: das Programm fräst nichts",
        help_en: "if Z 0 is on the table, give --surface the thickness of the material; until then, rapid moves are not checked",
        help_de: "liegt Z 0 auf dem Tisch, bei --surface die Dicke des Materials angeben; bis dahin werden Eilgänge nicht geprüft",
    }
    /// A required check that was not made.
    CHECK_NOT_MADE: UnmadeCheck {
        en: "the required check `{check}` was not carried out: {reason}",
        de: "die verlangte Prüfung `{check}` fand nicht statt: {reason}",
        help_en: "this check needs {option}",
        help_de: "diese Prüfung braucht {option}",
    }
    /// A required check of rapid moves that is incomplete.
    CHECK_INCOMPLETE: UnmadeCheck {
        en: "the required check `{check}` is incomplete: rapid moves that go below the material's surface start at unknown positions (number: {count}, the first in line {line})",
        de: "die verlangte Prüfung `{check}` ist unvollständig: Eilgänge unter die Oberfläche des Materials beginnen an unbekannter Stelle (Anzahl: {count}, der erste in Zeile {line})",
        help_en: "go to X and Y above the material first, then down",
        help_de: "zuerst über dem Material nach X und Y fahren, dann hinunter",
    }
    /// Two comments with different diameters for a numbered tool.
    TOOL_STATED_TWICE: HeaderContradiction {
        en: "comments contradict each other about the diameter of T{number}: {one} mm and {other} mm",
        de: "Kommentare widersprechen sich beim Durchmesser von T{number}: {one} mm und {other} mm",
        help_en: "find out which tool is meant; until then, the check of rapid moves removes material with the smaller one",
        help_de: "klären, welches Werkzeug gemeint ist; bis dahin rechnet die Prüfung der Eilgänge beim Abtragen mit dem kleineren",
    }
    /// Two comments with different diameters for a tool without a number.
    CURRENT_TOOL_STATED_TWICE: HeaderContradiction {
        en: "comments contradict each other about the diameter of the tool: {one} mm and {other} mm",
        de: "Kommentare widersprechen sich beim Durchmesser des Werkzeugs: {one} mm und {other} mm",
        help_en: "find out which tool is meant; until then, the check of rapid moves removes material with the smaller one",
        help_de: "klären, welches Werkzeug gemeint ist; bis dahin rechnet die Prüfung der Eilgänge beim Abtragen mit dem kleineren",
    }
    /// Two comments with tips of different shapes for a tool.
    TIP_STATED_TWICE: HeaderContradiction {
        en: "comments contradict each other about the shape of the tool's tip",
        de: "Kommentare widersprechen sich bei der Form der Werkzeugspitze",
        help_en: "find out which tool is meant; until then, the check of rapid moves uses the tip with the smaller flat part",
        help_de: "klären, welches Werkzeug gemeint ist; bis dahin rechnet die Prüfung der Eilgänge mit der Spitze, deren flacher Teil kleiner ist",
    }
    /// A tool that comments list, and that the program never uses.
    TOOL_NEVER_SELECTED: Disagreement {
        en: "comments list T{number}, but the program never changes to it",
        de: "Kommentare führen T{number} auf, aber das Programm wechselt es nie ein",
        help_en: "check whether a tool change is missing",
        help_de: "prüfen, ob ein Werkzeugwechsel fehlt",
    }
    /// T after a tool change, followed by cuts without M6.
    TOOL_NOT_INSERTED: Disagreement {
        en: "T{tool} is selected here, but no M6 changes to it: the cuts that follow are made with the previous tool",
        de: "T{tool} wird hier gewählt, aber kein M6 wechselt es ein: die folgenden Schnitte macht das vorige Werkzeug",
        help_en: "write M6 after T, or remove T",
        help_de: "M6 hinter T schreiben oder T entfernen",
    }
    /// T without M6 or a stop, followed by cuts, on a control where T alone changes no tool.
    TOOL_WITHOUT_STOP: Disagreement {
        en: "T{tool} is selected here, but T alone does not change the tool on this control, and neither M6 nor a stop comes before the next cut: that cut is made with the previous tool",
        de: "T{tool} wird hier gewählt, aber T allein wechselt auf dieser Steuerung kein Werkzeug, und vor dem nächsten Schnitt steht weder M6 noch ein Halt: diesen Schnitt macht das vorige Werkzeug",
        help_en: "write M0 beside T so that the operator changes the tool, or M6 after T if the machine changes it; otherwise remove T",
        help_de: "M0 neben T schreiben, damit der Bediener das Werkzeug wechselt, oder M6 dahinter, wenn die Maschine es wechselt; sonst T entfernen",
    }
    /// Headers of two programs that were put together, with different materials.
    SURFACE_STATED_TWICE: HeaderContradiction {
        en: "an earlier header of pathbuild says that the material is {one} mm high (T{one}), but this one says {other} mm (T{other})",
        de: "ein früherer Kopf von pathbuild gibt das Material mit {one} mm an (T{one}), dieser aber mit {other} mm (T{other})",
        help_en: "run the programs one by one if they are for different sheets; until then, the higher value is used",
        help_de: "die Programme einzeln laufen lassen, wenn sie für verschiedene Bleche sind; bis dahin gilt der höhere Wert",
    }
    /// Two comments that place a corner of the stock differently.
    STOCK_STATED_TWICE: HeaderContradiction {
        en: "comments place a corner of the stock at {axis} {one} and at {axis} {other}",
        de: "Kommentare geben eine Ecke des Rohteils mit {axis} {one} und mit {axis} {other} an",
        help_en: "correct the wrong comment; until then, the corner with the higher Z is used, or the later one if Z is the same",
        help_de: "den falschen Kommentar berichtigen; bis dahin gilt die Ecke mit dem höheren Z, bei gleichem Z die spätere",
    }
    /// Statistics at the end of a program that do not match its moves.
    LENGTH_DIFFERS: Disagreement {
        en: "`{label}` states {stated} mm, but the program's moves add up to {length} mm",
        de: "`{label}` nennt {stated} mm, die Bewegungen des Programms ergeben aber {length} mm",
        help_en: "run `emit` again: the program was edited",
        help_de: "noch einmal emit aufrufen: das Programm wurde bearbeitet",
    }
    /// A comment after the last one that `emit` writes.
    TEXT_ADDED: Disagreement {
        en: "emit does not write this comment",
        de: "emit schreibt diesen Kommentar nicht",
        help_en: "write the program again with `pathbuild emit`: it was edited",
        help_de: "das Programm mit `pathbuild emit` neu schreiben: es wurde bearbeitet",
    }
    /// A comment that differs from what `emit` writes.
    TEXT_DIFFERS: Disagreement {
        en: "the program does not have the comment that emit writes here: `{expected}`",
        de: "im Programm fehlt der Kommentar, den emit hier schreibt: `{expected}`",
        help_en: "write the program again with `pathbuild emit`: it was edited",
        help_de: "das Programm mit `pathbuild emit` neu schreiben: es wurde bearbeitet",
    }
    /// A rapid move in the plane through material.
    RAPID_IN_MATERIAL: RapidInMaterial {
        en: "a rapid move at Z {z} goes through material that still reaches up to Z {height}, near {point}",
        de: "ein Eilgang auf Z {z} führt durch Material, das noch bis Z {height} steht, bei {point}",
        help_en: "raise the cutter before this move, or mill that place earlier (the stock is simulated to within {resolution} mm)",
        help_de: "den Fräser vorher anheben oder dort zuerst fräsen (das Material ist auf {resolution} mm genau berechnet)",
    }
    /// A rapid move of a drawn path through material.
    SWEEP_IN_MATERIAL: RapidInMaterial {
        en: "the rapid move at Z {z} along this element goes through material that still reaches up to Z {height}, near {point}",
        de: "der Eilgang auf Z {z} entlang dieses Elements führt durch Material, das noch bis Z {height} steht, bei {point}",
        help_en: "give this path an S above {height}, lead the sweep around that place, or mill it first (the stock is simulated to within {resolution} mm)",
        help_de: "diesem Pfad ein S über {height} geben, die Leerfahrt außen herum führen oder dort zuerst fräsen (das Material ist auf {resolution} mm genau berechnet)",
    }
    /// A rapid move in the plane at cutting depth, where the surface of the material is unknown.
    RAPID_AT_DEPTH: RapidAtDepth {
        en: "a rapid move at Z {z} passes {point}, where nothing was cut to that depth; just before or after this move, the program cuts that deep, so there is probably material",
        de: "ein Eilgang auf Z {z} führt über {point}, wo nichts so tief gefräst wurde; kurz vor oder nach dieser Bewegung fräst das Programm so tief, also steht dort wahrscheinlich Material",
        help_en: "raise the cutter first; if the material is not that high, give its height with `--surface` for an exact check",
        help_de: "den Fräser vorher anheben; ist das Material nicht so hoch, seine Höhe mit `--surface` angeben, damit genau geprüft wird",
    }
    /// A rapid move in the plane at cutting depth, where neither the surface of the material nor the cutter is known.
    RAPID_FAR_FROM_CUTS: RapidAtDepth {
        en: "a rapid move at Z {z} passes {point}, where no cutter of up to {widest} mm can have cut to that depth; just before or after this move, the program cuts that deep, so there is probably material",
        de: "ein Eilgang auf Z {z} führt über {point}, wo kein Fräser bis {widest} mm so tief gefräst haben kann; kurz vor oder nach dieser Bewegung fräst das Programm so tief, also steht dort wahrscheinlich Material",
        help_en: "raise the cutter first; give its diameter with `--cutter` for a closer check, and the height of the material with `--surface` for an exact one",
        help_de: "den Fräser vorher anheben; für eine genauere Prüfung seinen Durchmesser mit `--cutter` angeben, für eine genaue auch die Höhe des Materials mit `--surface`",
    }
    /// A cut before X and Y are known, as in a program that is incremental from its beginning.
    UNKNOWN_POSITION: UnknownPosition {
        en: "this cut begins before the program has stated X and Y: until it does, neither travel nor rapid moves are checked",
        de: "dieser Schnitt beginnt, bevor das Programm X und Y angegeben hat: bis dahin werden weder Verfahrwege noch Eilgänge geprüft",
        help_en: "go to a position in X and Y with G90 first, and check whether G91 is intended",
        help_de: "zuerst mit G90 eine Position in X und Y anfahren und prüfen, ob G91 gemeint ist",
    }
    /// A cut at a height that is relative to a machine position, because Z was not stated after G28, G30 or G53.
    HEIGHT_OF_MACHINE: UnknownPosition as Error {
        en: "the height of this cut counts from a machine position: since G28, G30 or G53, the program has not stated Z",
        de: "die Höhe dieses Schnitts zählt von einer Maschinenposition aus: seit G28, G30 oder G53 hat das Programm kein Z angegeben",
        help_en: "write G90 after G91 G28, and go to a height above the material before the cut",
        help_de: "nach G91 G28 wieder G90 schreiben und vor dem Schnitt eine Höhe über dem Material anfahren",
    }
    /// A rapid move down into material.
    RAPID_PLUNGE: RapidPlunge {
        en: "a rapid move goes down to Z {z} into material that reaches up to Z {height}, at {point}",
        de: "ein Eilgang fährt auf Z {z} hinunter in Material, das bis Z {height} steht, bei {point}",
        help_en: "go down with G1 and a feed (the stock is simulated to within {resolution} mm)",
        help_de: "mit G1 und einem Vorschub hinunterfahren (das Material ist auf {resolution} mm genau berechnet)",
    }
    /// A cut through material that another path of the program mills from higher up.
    CUT_IN_HIGHER_MATERIAL: CutInHigherMaterial {
        en: "this cut at Z {z} goes through material that still reaches up to Z {height}, near {point}: higher than its own path says",
        de: "dieser Schnitt auf Z {z} geht durch Material, das bei {point} noch bis Z {height} steht: höher, als sein eigener Pfad angibt",
        help_en: "check H, T and the place of both paths that mill there; if both are right, mill the higher one first (N)",
        help_de: "H, T und die Stelle beider Pfade prüfen, die dort fräsen; stimmen sie, den höheren zuerst fräsen (N)",
    }
    /// A rapid move of a drawn path down into material.
    PLUNGE_IN_DRAWING: RapidPlunge {
        en: "the rapid move down to Z {z} at this element goes into material that still reaches up to Z {height}, near {point}",
        de: "der Eilgang bei diesem Element hinunter auf Z {z} geht in Material, das noch bis Z {height} steht, bei {point}",
        help_en: "look there for an element of another height, and check H, T and the place of both paths that mill there; if both are right, mill the higher one first (N), down to Z {z} (the stock is simulated to within {resolution} mm)",
        help_de: "dort nach einem Element anderer Höhe suchen und bei beiden Pfaden, die dort fräsen, H, T und die Stelle prüfen; stimmen beide, den höheren zuerst fräsen (N), bis Z {z} hinunter (das Material ist auf {resolution} mm genau berechnet)",
    }
    /// A program that moves in the plane before it raises the cutter.
    START_NOT_RAISED: StartNotRaised {
        en: "the program moves in the plane before it raises the cutter",
        de: "das Programm fährt in der Ebene, bevor es den Fräser anhebt",
        help_en: "begin with G0 Z above the material",
        help_de: "mit G0 Z über dem Material beginnen",
    }
    /// A program that moves in the plane after a stop for a tool change or a new zero, before it states or raises Z in a line of its own.
    CHANGE_NOT_RAISED: StartNotRaised {
        en: "after a stop for a tool change or a new zero, the program moves in X or Y before a move in Z alone has raised the cutter: only the controller knows how high the cutter is",
        de: "nach einem Halt für Werkzeugwechsel oder Nullpunkt fährt das Programm in X oder Y, bevor es den Fräser allein in Z angehoben hat: nur die Steuerung weiß, wie hoch der Fräser steht",
        help_en: "raise the cutter with G0 Z before X and Y; the definition of a post-processor does so at the end of its ToolChange",
        help_de: "den Fräser mit G0 Z anheben, bevor X und Y kommen; die Definition eines Postprozessors tut das am Ende ihres ToolChange",
    }
    /// A program that changes Z in its first move in the plane, although the height before it is unknown.
    START_ASLANT: StartNotRaised {
        en: "the first move in the plane also changes the height, which is unknown before it: on its way, the cutter may hit material or clamps",
        de: "die erste Bewegung in der Ebene ändert zugleich die Höhe, die vorher unbekannt ist: unterwegs kann der Fräser Material oder Spannmittel treffen",
        help_en: "begin with G0 Z above the material, then go to X and Y",
        help_de: "mit G0 Z über dem Material beginnen, dann nach X und Y fahren",
    }
    /// A program that ends below the surface.
    END_NOT_RAISED: EndNotRaised {
        en: "the program ends at Z {z}, below the material's surface at {surface}",
        de: "das Programm endet auf Z {z}, unter der Oberfläche des Materials bei {surface}",
        help_en: "end with G0 Z above the material",
        help_de: "mit G0 Z über dem Material enden",
    }
    /// A rapid move in the plane and down at the same time.
    DIAGONAL_RAPID: DiagonalRapid {
        en: "a rapid move in the plane also goes down to Z {z}: many machines do not follow a straight line",
        de: "ein Eilgang in der Ebene fährt zugleich auf Z {z} hinunter: viele Maschinen fahren dabei nicht gerade",
        help_en: "move in the plane first, then down",
        help_de: "zuerst in der Ebene fahren, dann hinunter",
    }
    /// A slanting rapid move in the material, on a control that moves each axis at its own speed.
    BENT_RAPID: DiagonalRapid {
        en: "a rapid move below the material's surface goes in X and Y at once: {dialect} does not move in a straight line, so the cutter may leave the groove that was cut",
        de: "ein Eilgang fährt unter der Oberfläche des Materials in X und Y zugleich: {dialect} fährt dabei nicht gerade, und der Fräser kann die gefräste Nut verlassen",
        help_en: "raise the tool above the material first, or move with G1",
        help_de: "das Werkzeug zuerst über das Material heben oder mit G1 fahren",
    }
    /// A cut with the spindle off.
    SPINDLE_OFF: SpindleOff {
        en: "this is a cutting move with the spindle off",
        de: "diese Fräsbewegung läuft bei stehender Spindel",
        help_en: "switch it on with M3 first; programs without any of M3 to M5 are checked for this only if they have S or their tool has a speed in [tool]",
        help_de: "sie vorher mit M3 einschalten; Programme ohne M3 bis M5 werden darauf nur geprüft, wenn sie S enthalten oder ihr Werkzeug in [tool] eine Drehzahl hat",
    }
    /// A program that never switches the spindle on, for a tool with a speed in the tool table.
    SPINDLE_NEVER_STARTED: SpindleOff {
        en: "the program cuts without ever switching the spindle on, although [tool] gives the tool a spindle speed",
        de: "das Programm fräst, ohne je die Spindel einzuschalten, obwohl [tool] dem Werkzeug eine Drehzahl gibt",
        help_en: "write M3 and S before the cut, or spindle = \"manual\" in pathbuild.toml if the operator switches the spindle",
        help_de: "M3 und S vor den Schnitt schreiben, oder spindle = \"manual\" in pathbuild.toml, wenn der Bediener die Spindel schaltet",
    }
    /// A program with S that never switches the spindle on.
    SPINDLE_SPEED_WITHOUT_START: SpindleOff as Warning {
        en: "the program cuts with a speed S, but never switches the spindle on",
        de: "das Programm fräst mit einer Drehzahl S, schaltet aber die Spindel nie ein",
        help_en: "write M3 before the cut, or spindle = \"manual\" in pathbuild.toml if the operator switches the spindle",
        help_de: "M3 vor den Schnitt schreiben, oder spindle = \"manual\" in pathbuild.toml, wenn der Bediener die Spindel schaltet",
    }
    /// A program that ends with the spindle on.
    SPINDLE_LEFT_ON: SpindleLeftOn {
        en: "the spindle still turns when the program ends",
        de: "die Spindel dreht sich noch, wenn das Programm endet",
        help_en: "switch it off with M5, or end the program with M30",
        help_de: "sie mit M5 ausschalten oder das Programm mit M30 beenden",
    }
    /// Arcs with only one or two decimals.
    COARSE_ARCS: CoarseArcs {
        en: "the coordinates of arcs are rounded to steps of {step} mm",
        de: "die Koordinaten der Bögen sind auf Schritte von {step} mm gerundet",
        help_en: "set the post-processor to three or more decimals: the ends and centres of rounded arcs do not match",
        help_de: "den Postprozessor auf drei oder mehr Nachkommastellen einstellen: die Enden und Mittelpunkte gerundeter Bögen passen nicht zusammen",
    }
    /// A move in the plane straight after probing, before the tool is retracted.
    PROBE_NOT_RAISED: ProbeNotRaised {
        en: "the tool moves sideways while it still touches what it probed",
        de: "das Werkzeug fährt zur Seite, während es noch berührt, was es angetastet hat",
        help_en: "raise the tool with G0 Z before it moves in X or Y",
        help_de: "das Werkzeug mit G0 Z anheben, bevor es in X oder Y fährt",
    }
    /// A rapid move down beyond the point at which a probe made contact.
    RAPID_BELOW_CONTACT: ProbeNotRaised as Error {
        en: "this rapid move ends {below} mm below the point at which the probing move before it made contact: the tool hits what it has touched",
        de: "dieser Eilgang endet {below} mm unter dem Ende der Antastbewegung davor: das Werkzeug stößt in das, was es berührt hat",
        help_en: "raise the tool after contact: G91 G0 Z with a positive number, or a height above the end of the probing move",
        help_de: "das Werkzeug nach der Berührung anheben: G91 G0 Z mit positiver Zahl, oder eine Höhe über dem Ende der Antastbewegung",
    }
    /// A spindle speed outside of the machine's range.
    SPINDLE_SPEED: SpindleSpeed {
        en: "S {speed} is outside the machine's range of {least} to {most}",
        de: "S {speed} liegt außerhalb des Bereichs der Maschine von {least} bis {most}",
        help_en: "correct S, or the spindle's range under [machine]",
        help_de: "S oder den Bereich der Spindel unter [machine] berichtigen",
    }
    /// A cut with M3 for a tool that turns counter-clockwise, or the reverse.
    SPINDLE_DIRECTION: SpindleDirection {
        en: "the spindle turns the wrong way in this cut: it was switched on with {found}, but the direction of the tool is {direction}",
        de: "die Spindel dreht sich bei diesem Schnitt falsch herum: sie wurde mit {found} eingeschaltet, die Drehrichtung des Werkzeugs ist aber {direction}",
        help_en: "write {expected}, or correct `direction` in [tool.NAME]; without it, a tool with `spindle` turns clockwise",
        help_de: "{expected} schreiben oder `direction` in [tool.NAME] berichtigen; ohne diese Angabe dreht ein Werkzeug mit `spindle` im Uhrzeigersinn",
    }
    /// A feed that exceeds the limit of an axis.
    FEED_TOO_HIGH: FeedTooHigh {
        en: "feed {feed} mm/min exceeds the machine's maximum of {most} in {axis}",
        de: "der Vorschub {feed} mm/min überschreitet in {axis} das Maximum der Maschine von {most}",
        help_en: "lower F, or correct the rate under [machine]; otherwise the control limits the feed, and the program takes longer",
        help_de: "F senken oder die Geschwindigkeit unter [machine] berichtigen; sonst begrenzt die Steuerung den Vorschub, und das Programm dauert länger",
    }
    /// A feed that exceeds the maximum feed of the machine.
    FEED_ABOVE_MOST: FeedTooHigh {
        en: "feed {feed} mm/min exceeds the machine's maximum of {most}",
        de: "der Vorschub {feed} mm/min überschreitet das Maximum der Maschine von {most}",
        help_en: "lower F, or correct `maximum-feed` under [machine]; otherwise the control limits the feed, and the program takes longer",
        help_de: "F senken oder `maximum-feed` unter [machine] berichtigen; sonst begrenzt die Steuerung den Vorschub, und das Programm dauert länger",
    }
    /// A program that leaves the working area of the machine.
    OUTSIDE_MACHINE: OutsideMachine {
        en: "{axis} {value} is outside the machine's travel of {least} to {most}",
        de: "{axis} {value} liegt außerhalb des Verfahrwegs der Maschine von {least} bis {most}",
        help_en: "move the part, or correct the travel under [machine]",
        help_de: "das Werkstück versetzen oder den Verfahrweg unter [machine] berichtigen",
    }
    /// A program that is larger than the working area of the machine.
    LARGER_THAN_MACHINE: OutsideMachine {
        en: "the program needs {size} mm in {axis}, but the machine has {most}",
        de: "das Programm braucht {size} mm in {axis}, die Maschine hat aber nur {most}",
        help_en: "use a larger machine, or correct the travel under [machine]; on this one the program does not fit, wherever the part is clamped",
        help_de: "eine größere Maschine nehmen oder den Verfahrweg unter [machine] berichtigen; auf diese passt das Programm nicht, wo immer das Werkstück gespannt ist",
    }
    /// A tool change below the surface.
    TOOL_CHANGE_AT_DEPTH: ToolChangeAtDepth {
        en: "the tool is changed at Z {z}, below the material's surface at {surface}",
        de: "das Werkzeug wird auf Z {z} gewechselt, unter der Oberfläche des Materials bei {surface}",
        help_en: "raise the cutter before M6",
        help_de: "den Fräser vor M6 anheben",
    }
    /// A stop for the operator (M0, M1, M60) below the surface of the material.
    STOP_AT_DEPTH: StopAtDepth {
        en: "the program stops for the operator at Z {z}, below the material's surface at {surface}",
        de: "das Programm hält auf Z {z} für den Bediener an, unter der Oberfläche des Materials bei {surface}",
        help_en: "raise the cutter before the stop",
        help_de: "den Fräser vor dem Halt anheben",
    }
    /// A stop at the depth of the previous cut, while the surface of the material is unknown.
    STOP_AT_CUT: StopAtDepth {
        en: "the program stops for the operator at Z {z}, as deep as the cut before: the cutter is probably in the material",
        de: "das Programm hält auf Z {z} für den Bediener an, so tief wie der Schnitt davor: der Fräser steht wohl im Material",
        help_en: "raise the cutter before the stop",
        help_de: "den Fräser vor dem Halt anheben",
    }
    /// A tool change at the depth of the previous cut, while the surface of the material is unknown.
    CHANGE_AT_CUT: ToolChangeAtDepth {
        en: "the tool is changed at Z {z}, as deep as the cut before: the cutter is probably in the material",
        de: "das Werkzeug wird auf Z {z} gewechselt, so tief wie der Schnitt davor: der Fräser steht wohl im Material",
        help_en: "raise the cutter before the change",
        help_de: "den Fräser vor dem Wechsel anheben",
    }
    /// A manual tool change (M0 after T) while the spindle turns.
    SPINNING_AT_CHANGE: SpinningAtChange {
        en: "the spindle still turns where the program stops for the tool change",
        de: "die Spindel dreht sich noch, wo das Programm zum Werkzeugwechsel anhält",
        help_en: "switch it off with M5 before the tool change",
        help_de: "sie vor dem Werkzeugwechsel mit M5 ausschalten",
    }
    /// A cut after M6 that still uses the length of the previous tool.
    LENGTH_BEFORE_CHANGE: WrongToolLength {
        en: "this cut still uses the tool length that line {set} set before {change} changed the tool",
        de: "für diesen Schnitt gilt noch die Werkzeuglänge, die Zeile {set} vor dem Werkzeugwechsel {change} gesetzt hat",
        help_en: "set the length of the new tool after the change, such as `G43 H2` for T2",
        help_de: "nach dem Wechsel die Länge des neuen Werkzeugs setzen, etwa `G43 H2` für T2",
    }
    /// A cut without a tool length, because G49 switched it off.
    LENGTH_SWITCHED_OFF: WrongToolLength {
        en: "this cut has no tool length: line {set} switched it off, but line {first} had applied one",
        de: "für diesen Schnitt gilt keine Werkzeuglänge: Zeile {set} hat sie ausgeschaltet, Zeile {first} hatte aber eine gesetzt",
        help_en: "leave the length on up to the last cut, or set it again with G43 H",
        help_de: "die Länge bis zum letzten Schnitt gelten lassen oder mit G43 H wieder setzen",
    }
    /// A cut before the first G43, although later cuts use a tool length.
    LENGTH_OF_FIRST_TOOL: WrongToolLength as Warning {
        en: "T{tool} cuts without a tool length, but line {first} applies one to a later cut",
        de: "T{tool} schneidet ohne Werkzeuglänge, Zeile {first} setzt aber eine für einen späteren Schnitt",
        help_en: "set the length of T{tool} after M6, such as `G43 H{tool}`; if all lengths are measured from T{tool}, accept this warning with `--accept`",
        help_de: "nach M6 die Länge von T{tool} setzen, etwa `G43 H{tool}`; werden alle Längen von T{tool} aus gemessen, die Warnung mit `--accept` hinnehmen",
    }
    /// A rapid move that states Z with a tool length that was set before the last M6.
    RAPID_WITH_OLD_LENGTH: WrongToolLength as Warning {
        en: "this rapid move to a Z still uses the tool length that line {set} set before {change} changed the tool: only the controller knows how high the tip is",
        de: "für das Z dieses Eilgangs gilt noch die Werkzeuglänge, die Zeile {set} vor dem Werkzeugwechsel {change} gesetzt hat: nur die Steuerung weiß, wie hoch die Spitze ist",
        help_en: "set the length of the new tool before or in the first line with Z, such as `G43 H2 Z5` for T2",
        help_de: "die Länge des neuen Werkzeugs vor oder in der ersten Zeile mit Z setzen, etwa `G43 H2 Z5` für T2",
    }
    /// A rapid move that states Z after G49 or G43 H0.
    RAPID_WITHOUT_LENGTH: WrongToolLength as Warning {
        en: "this rapid move to a Z uses no tool length, because line {set} switched it off: on most controllers, the spindle nose goes to this Z",
        de: "für das Z dieses Eilgangs gilt keine Werkzeuglänge, weil Zeile {set} sie ausgeschaltet hat: auf den meisten Steuerungen fährt die Spindelnase auf dieses Z",
        help_en: "raise the tool before the length is switched off, or go to a machine position, such as `G53 G0 Z0`",
        help_de: "das Werkzeug anheben, bevor die Länge ausgeschaltet wird, oder eine Maschinenposition anfahren, etwa `G53 G0 Z0`",
    }
    /// A rapid move that states Z after M6 and before the first G43 of the program.
    RAPID_BEFORE_LENGTH: WrongToolLength as Warning {
        en: "T{tool} goes to this Z before line {first} sets a tool length: only the controller knows how high the tip is",
        de: "T{tool} fährt auf dieses Z, bevor Zeile {first} eine Werkzeuglänge setzt: nur die Steuerung weiß, wie hoch die Spitze ist",
        help_en: "set the length before or in the first line with Z, such as `G43 H{tool} Z5`",
        help_de: "die Länge vor oder in der ersten Zeile mit Z setzen, etwa `G43 H{tool} Z5`",
    }
    /// A rapid move that states Z with the H of another tool than the one in the spindle.
    RAPID_WITH_OTHER_LENGTH: WrongToolLength as Warning {
        en: "for the Z of this rapid move, the length H{entry} applies, but T{tool} is in the spindle: only the controller knows how high the tip is",
        de: "für das Z dieses Eilgangs gilt die Länge H{entry}, in der Spindel ist aber T{tool}: nur die Steuerung weiß, wie hoch die Spitze ist",
        help_en: "write H{tool}, or set the length of the next tool only after M6",
        help_de: "H{tool} schreiben oder die Länge des nächsten Werkzeugs erst nach M6 setzen",
    }
    /// A cut with the length of another tool of the program: `G43 H2` for T1 where T2 exists as well.
    LENGTH_OF_OTHER_TOOL: WrongToolLength {
        en: "T{tool} cuts with the length H{entry}, which is that of T{entry} in this program",
        de: "T{tool} schneidet mit der Länge H{entry}, die in diesem Programm zu T{entry} gehört",
        help_en: "write H{tool}",
        help_de: "H{tool} schreiben",
    }
    /// A cut with a length that has another number than the tool: `G43 H2` for T1.
    LENGTH_OF_OTHER_NUMBER: WrongToolLength as Warning {
        en: "T{tool} cuts with the length H{entry}: the numbers differ",
        de: "T{tool} schneidet mit der Länge H{entry}: die Nummern sind verschieden",
        help_en: "write H{tool}; if H{entry} is the length of T{tool} on this machine, accept this warning with `--accept`",
        help_de: "H{tool} schreiben; ist H{entry} auf dieser Maschine die Länge von T{tool}, die Warnung mit `--accept` hinnehmen",
    }
    /// Programs that should have the same moves, but go to different points.
    PATHS_DIFFER: MovesDiffer {
        en: "the moves differ: here the tool goes to {found}, but in line {line} of the other program to {expected}",
        de: "die Bewegungen unterscheiden sich: hier fährt das Werkzeug nach {found}, in Zeile {line} des anderen Programms aber nach {expected}",
    }
    /// Programs that should have the same moves, but move along different curves.
    SHAPES_DIFFER: MovesDiffer {
        en: "the moves differ: this one and the one in line {line} of the other program have the same ends, but different routes between them",
        de: "die Bewegungen unterscheiden sich: diese und die in Zeile {line} des anderen Programms haben dieselben Enden, aber nicht denselben Weg dazwischen",
    }
    /// Programs that should have the same moves, but one cuts where the other makes a rapid move.
    KINDS_DIFFER: MovesDiffer {
        en: "the moves differ: this is {found}, but in line {line} of the other program it is {expected}",
        de: "die Bewegungen unterscheiden sich: das ist {found}, in Zeile {line} des anderen Programms aber {expected}",
    }
    /// Programs that should have the same moves, but have different feeds.
    FEEDS_DIFFER: MovesDiffer {
        en: "the feeds differ: {found} here, but {expected} in line {line} of the other program",
        de: "die Vorschübe unterscheiden sich: hier {found}, in Zeile {line} des anderen Programms aber {expected}",
    }
    /// A program that lacks the last moves of the other program.
    MOVES_MISSING: MovesDiffer {
        en: "the moves end here, but the other program goes on in line {line}",
        de: "die Bewegungen enden hier, das andere Programm geht aber in Zeile {line} weiter",
    }
    /// A program that goes on after the last move of the other program.
    MOVES_TOO_MANY: MovesDiffer {
        en: "the other program has no more moves, but this program goes on here",
        de: "das andere Programm hat keine weiteren Bewegungen, dieses Programm geht hier aber weiter",
    }
}
