//! Messages about the segments of a path in milling order, and about the paths that it embeds. (PB401 to PB511, PB525)

messages! {
    /// The path breaks off: no remaining segment begins where it ends.
    NOTHING_CONTINUES: NothingContinues {
        en: "the path breaks off here; segments not reached: {left}",
        de: "hier bricht der Pfad ab; nicht erreichte Segmente: {left}",
        help_en: "close the gap, draw the missing segment, or move it to the path's layer",
        help_de: "die Lücke schließen, das fehlende Segment zeichnen oder es auf den Layer des Pfads legen",
    }
    /// The path breaks off at the tip of a dead end; the remaining segments branch off between there and the start.
    DEAD_END: NothingContinues {
        en: "the path breaks off here, at the tip of a dead end; segments not reached: {left}",
        de: "hier bricht der Pfad ab, an der Spitze einer Sackgasse; nicht erreichte Segmente: {left}",
        help_en: "draw the segment that is missing here; or, if the dead end is a helper line, remove it or move it to another layer; put a turn marker (a PHANTOM circle of 1.5 mm) here only if the tool is to go along it and back",
        help_de: "das Segment zeichnen, das hier fehlt; oder die Sackgasse, wenn sie eine Hilfslinie ist, entfernen oder auf einen anderen Layer legen; eine Wendemarke (PHANTOM-Kreis mit 1,5 mm) hier nur zeichnen, wenn der Fräser darauf hin- und zurückfahren soll",
    }
    /// The path breaks off beside a turn marker.
    TURN_MARKER_BESIDE_TIP: NothingContinues {
        en: "the path breaks off here, at the tip of a dead end: the turn marker at {point} is {distance} mm away; segments not reached: {left}",
        de: "hier bricht der Pfad ab, an der Spitze einer Sackgasse: die Wendemarke bei {point} ist {distance} mm entfernt; nicht erreichte Segmente: {left}",
        help_en: "move the turn marker exactly to the tip: `join-tolerance` does not apply to it",
        help_de: "die Wendemarke genau auf die Spitze schieben: `join-tolerance` gilt für sie nicht",
    }
    /// The path breaks off near the end of a segment that it has already traversed, such as the first one of an outline.
    ENDS_BESIDE_TRAVERSED: NothingContinues {
        en: "the path breaks off here, {distance} mm from {point}, where {element} ends; segments not reached: {left}",
        de: "hier bricht der Pfad ab, {distance} mm neben {point}, wo {element} endet; nicht erreichte Segmente: {left}",
        help_en: "close the gap: let both segments end at the same point",
        help_de: "die Lücke schließen: beide Segmente an demselben Punkt enden lassen",
    }
    /// The path breaks off at the end of a segment that is slightly too long.
    TOO_LONG: NothingContinues {
        en: "the path breaks off here, {distance} mm past {point}, where {element} begins; segments not reached: {left}",
        de: "hier bricht der Pfad ab, {distance} mm hinter {point}, wo {element} beginnt; nicht erreichte Segmente: {left}",
        help_en: "let this line or arc end at {point}",
        help_de: "diese Linie oder diesen Bogen bei {point} enden lassen",
    }
    /// The path breaks off; a remaining segment begins in the middle of a traversed one.
    BEGINS_ON_OTHER: NothingContinues {
        en: "the path breaks off here: {element} begins at {point}, in the middle of another segment; segments not reached: {left}",
        de: "hier bricht der Pfad ab: bei {point} beginnt {element} mitten auf einem anderen Segment; nicht erreichte Segmente: {left}",
        help_en: "shorten or split the line or arc at {point}, so that the two meet end to end",
        help_de: "die Linie oder den Bogen bei {point} kürzen oder teilen, damit beide sich mit ihren Enden treffen",
    }
    /// The path breaks off in the middle of a segment that was not reached.
    ENDS_ON_OTHER: NothingContinues {
        en: "the path breaks off here, in the middle of {element}: it continues only at the ends of segments; segments not reached: {left}",
        de: "hier bricht der Pfad ab, mitten auf einem anderen Segment ({element}): er geht nur an den Enden von Segmenten weiter; nicht erreichte Segmente: {left}",
        help_en: "split that line or arc into two at {point}, or lead the path to one of its ends instead",
        help_de: "diese Linie oder diesen Bogen bei {point} in zwei Teile trennen oder den Pfad stattdessen zu einem ihrer Enden führen",
    }
    /// The path breaks off because it runs back along a segment that is drawn twice.
    DRAWN_TWICE: NothingContinues {
        en: "{element} at {point} is drawn twice: the path runs back along the second one and breaks off; segments not reached: {left}",
        de: "{element} bei {point} ist doppelt gezeichnet: der Pfad läuft auf dem zweiten Segment zurück und bricht ab; nicht erreichte Segmente: {left}",
        help_en: "delete one of the two",
        help_de: "eines der beiden löschen",
    }
    /// The path breaks off because a segment lies on part of another one.
    PART_DRAWN_TWICE: NothingContinues {
        en: "{element} at {point} lies on part of a longer one: this part is drawn twice, and the path breaks off; segments not reached: {left}",
        de: "{element} bei {point} liegt auf einem Teil eines längeren Segments: dieser Teil ist doppelt gezeichnet, und der Pfad bricht ab; nicht erreichte Segmente: {left}",
        help_en: "delete the shorter of the two",
        help_de: "das kürzere der beiden löschen",
    }
    /// A turn marker without a branch on the way back.
    TURN_FOUND_NOTHING: NothingContinues {
        en: "no segment branches off on the way back from this turn marker; segments not reached: {left}",
        de: "auf dem Rückweg von dieser Wendemarke zweigt kein Segment ab; nicht erreichte Segmente: {left}",
        help_en: "draw one of these segments so that it branches off the way back to the start, or remove the turn marker",
        help_de: "eines dieser Segmente so zeichnen, dass es vom Rückweg zum Anfang abzweigt, oder die Wendemarke entfernen",
    }
    /// Note: the nearest open end.
    NEAREST_END: NothingContinues {
        en: "the nearest open end is at {point}, {distance} mm away ({element})",
        de: "das nächste offene Ende ist bei {point}, {distance} mm entfernt ({element})",
    }
    /// Note: a segment that does not quite meet the way back.
    END_BESIDE_WAY_BACK: NothingContinues {
        en: "{element} ends at {point}, {distance} mm away from the way back, on which the ends must meet exactly: `join-tolerance` does not apply there",
        de: "{element} endet bei {point}, {distance} mm neben dem Rückweg: dort müssen sich die Enden genau treffen, `join-tolerance` gilt nicht",
    }
    /// Note: an open end on another layer.
    END_ON_OTHER_LAYER: NothingContinues {
        en: "on layer {layer}, {element} ends at {point}, {distance} mm away: is it on the wrong layer?",
        de: "auf Layer {layer} endet {element} bei {point}, {distance} mm entfernt: liegt es auf dem falschen Layer?",
    }
    /// Note: a turn marker on another layer.
    TURN_MARKER_ON_OTHER_LAYER: NothingContinues {
        en: "layer {layer} has a turn marker at {point}, {distance} mm away: is it on the wrong layer?",
        de: "auf Layer {layer} liegt bei {point} eine Wendemarke, {distance} mm entfernt: liegt sie auf dem falschen Layer?",
    }
    /// Note: a remaining segment that is drawn on top of a traversed one.
    DUPLICATE: NothingContinues {
        en: "{element} at {point} lies on top of one that was already traversed: it is drawn twice",
        de: "{element} bei {point} liegt auf einem schon durchlaufenen Segment: es ist doppelt gezeichnet",
    }
    /// Note: the number of segments that are drawn on top of others, if there are several.
    COPIES: NothingContinues {
        en: "segments drawn on top of others: {count}; delete all of these copies, which were probably pasted together",
        de: "auf anderen gezeichnete Segmente: {count}; alle diese Kopien löschen, die wahrscheinlich zusammen eingefügt wurden",
    }
    /// Note: a curve that was left out (PB111).
    LEFT_OUT_HERE: NothingContinues {
        en: "there is a curve at {point} that does not belong to the path ({kind})",
        de: "bei {point} liegt eine Kurve ({kind}), die nicht zum Pfad gehört",
    }
    /// Segments that are not reached when the path ends.
    UNREACHED: UnreachedSegments {
        en: "the path ends here; segments not reached: {left}, including {element} at {point}",
        de: "der Pfad endet hier, aber nicht alle seine Segmente wurden erreicht; übrig: {left}, darunter {element} bei {point}",
        help_en: "connect them with the path, remove them, or move them to another layer",
        help_de: "mit dem Pfad verbinden, entfernen oder auf einen anderen Layer legen",
    }
    /// A branch that is not reached, because the path went past it to the end marker.
    UNREACHED_BRANCH: UnreachedSegments {
        en: "segments not reached: {left}; the path went past {point}, where {element} branches off, and ends here",
        de: "nicht alle Segmente wurden erreicht; übrig: {left}; der Pfad lief an {point} vorbei, wo {element} abzweigt, und endet hier",
        help_en: "if the branch is a helper line, remove it or move it to another layer; otherwise give it a smaller N than the segment on which the path goes on from there (HIDDEN takes no N: use DASHED), and draw the segments that lead back from its tip, or put a turn marker (a PHANTOM circle of 1.5 mm) there",
        help_de: "ist es eine Hilfslinie, sie entfernen oder auf einen anderen Layer legen; sonst ihr ein kleineres N geben als dem Segment, auf dem der Pfad von dort weiterläuft (HIDDEN nimmt kein N: DASHED verwenden), und die Segmente zeichnen, die von ihrer Spitze zurückführen, oder dort eine Wendemarke (PHANTOM-Kreis mit 1,5 mm)",
    }
    /// A segment that is not reached because a small gap separates it from the end of a traversed one.
    UNREACHED_BESIDE: UnreachedSegments {
        en: "segments not reached: {left}; {element} at {point} is {distance} mm away from {end}, where {other} ends",
        de: "nicht alle Segmente wurden erreicht; übrig: {left}; {element} bei {point} liegt {distance} mm neben {end}, wo {other} endet",
        help_en: "snap one of these ends to the other with the object snap (`join-tolerance` closes a gap only where the path cannot continue otherwise), or remove what does not belong to the path",
        help_de: "das eine Ende mit dem Objektfang auf das andere setzen (`join-tolerance` schließt eine Lücke nur, wo der Pfad nicht anders weitergeht) oder entfernen, was nicht zum Pfad gehört",
    }
    /// The path ends in the middle of a segment that was not reached.
    UNREACHED_ENDS_ON_OTHER: UnreachedSegments {
        en: "the path ends here, in the middle of {element}, which it does not follow: it continues only at the ends of segments; segments not reached: {left}",
        de: "der Pfad endet hier mitten auf einem anderen Segment ({element}), dem er nicht folgt: er geht nur an den Enden von Segmenten weiter; nicht erreichte Segmente: {left}",
        help_en: "split that line or arc into two at {point}",
        help_de: "diese Linie oder diesen Bogen bei {point} in zwei Teile trennen",
    }
    /// A segment that is not reached because it is drawn twice.
    UNREACHED_TWICE: UnreachedSegments {
        en: "{element} at {point} is drawn twice, but the path runs along only one of the two; segments not reached: {left}",
        de: "{element} bei {point} ist doppelt gezeichnet, der Pfad läuft aber nur über eines der beiden Segmente; nicht erreichte Segmente: {left}",
        help_en: "delete one of the two",
        help_de: "eines der beiden löschen",
    }
    /// A segment that is not reached because one lies on part of the other.
    UNREACHED_PART_TWICE: UnreachedSegments {
        en: "{element} at {point} lies on part of a longer one: this part is drawn twice; segments not reached: {left}",
        de: "{element} bei {point} liegt auf einem Teil eines längeren Segments: dieser Teil ist doppelt gezeichnet; nicht erreichte Segmente: {left}",
        help_en: "delete the shorter of the two",
        help_de: "das kürzere der beiden löschen",
    }
    /// Arcs that form a circle around a point that the path reaches: probably a hole, because some programs export circles as arcs.
    UNREACHED_CIRCLE: UnreachedSegments {
        en: "segments not reached: {left}, among them arcs that form a circle of {diameter} mm around {point}",
        de: "nicht alle Segmente wurden erreicht; übrig: {left}, darunter Bögen, die einen Kreis von {diameter} mm um {point} bilden",
        help_en: "draw a hole as a CIRCLE with the diameter of the hole: the centre of the cutter would run along these arcs, and the hole would be larger by O",
        help_de: "ein Loch als CIRCLE (Kreis) mit dem Durchmesser des Lochs zeichnen: auf diesen Bögen liefe die Mitte des Fräsers, und das Loch würde um O größer",
    }
    /// A segment that is not reached because it touches another kind of segment between that segment's ends.
    NO_END_THERE: UnreachedSegments {
        en: "segments not reached: {left}; {element} at {point} touches {other}, which does not end there",
        de: "nicht alle Segmente wurden erreicht; übrig: {left}; bei {point} trifft {element} auf ein anderes Segment ({other}), das dort nicht endet",
        help_en: "split the line or arc at {point}",
        help_de: "die Linie oder den Bogen bei {point} teilen",
    }
    /// A segment that is not reached because it touches a segment of the same kind between that segment's ends.
    NO_END_THERE_ALIKE: UnreachedSegments {
        en: "segments not reached: {left}; {element} at {point} touches another one, which does not end there",
        de: "nicht alle Segmente wurden erreicht; übrig: {left}; bei {point} trifft {element} auf ein anderes der gleichen Art, das dort nicht endet",
        help_en: "split the line or arc at {point}",
        help_de: "die Linie oder den Bogen bei {point} teilen",
    }
    /// An end that is not reached because a segment is drawn twice.
    END_NOT_REACHED_TWICE: EndNotReached {
        en: "the path stops at {point}, but its end marker is at {end}: {element} at {begin} is drawn twice",
        de: "der Pfad hört bei {point} auf, seine Endmarke ist aber bei {end}: {element} bei {begin} ist doppelt gezeichnet",
        help_en: "delete one of the two",
        help_de: "eines der beiden löschen",
    }
    /// An end that is not reached because a segment lies on part of another one.
    END_NOT_REACHED_PART_TWICE: EndNotReached {
        en: "the path stops at {point}, but its end marker is at {end}: {element} at {begin} lies on part of a longer one",
        de: "der Pfad hört bei {point} auf, seine Endmarke ist aber bei {end}: {element} bei {begin} liegt auf einem Teil eines längeren Segments",
        help_en: "delete the shorter of the two",
        help_de: "das kürzere der beiden löschen",
    }
    /// A path that stops near its end marker.
    STOPS_BESIDE_END: EndNotReached {
        en: "the path stops at {point}, {distance} mm away from its end marker at {end}",
        de: "der Pfad hört bei {point} auf, {distance} mm neben seiner Endmarke bei {end}",
        help_en: "close the gap: let the last segment end at the centre of the end marker",
        help_de: "die Lücke schließen: das letzte Segment im Mittelpunkt der Endmarke enden lassen",
    }
    /// A path that runs past its end marker into a dead end.
    END_PASSED: EndNotReached {
        en: "the path runs past its end marker at {end} and stops at {point}",
        de: "der Pfad läuft an seiner Endmarke bei {end} vorbei und hört bei {point} auf",
        help_en: "draw the missing segments from there back to the end marker; or, if the line beyond the end marker is a helper line, remove it or move it to another layer; move the end marker to {point} only if the path is to end there",
        help_de: "die fehlenden Segmente von dort zur Endmarke zeichnen; oder, wenn hinter der Endmarke eine Hilfslinie folgt, sie entfernen oder auf einen anderen Layer legen; die Endmarke nur dann nach {point} verschieben, wenn der Pfad dort enden soll",
    }
    /// An end that is not reached although all segments are traversed.
    END_NOT_REACHED: EndNotReached {
        en: "the path stops at {point}, but its end marker is at {end}",
        de: "der Pfad hört bei {point} auf, seine Endmarke ist aber bei {end}",
        help_en: "draw the missing segments between the two points; or, if the path ends in a helper line, remove it or move it to another layer; move the end marker to {point} only if the path is to end there",
        help_de: "die fehlenden Segmente dazwischen zeichnen; oder, wenn der Pfad in einer Hilfslinie endet, sie entfernen oder auf einen anderen Layer legen; die Endmarke nur dann nach {point} verschieben, wenn der Pfad dort enden soll",
    }
    /// A path that has no segments.
    EMPTY_PATH: EmptyPath {
        en: "the path has no segments",
        de: "der Pfad hat keine Segmente",
        help_en: "draw lines, arcs or circles on the path's layer",
        help_de: "Linien, Bögen oder Kreise auf dem Layer des Pfads zeichnen",
    }
    /// A helical circle larger than A.
    HELIX_TOO_LARGE: HelixTooLarge {
        en: "the helical circle's diameter {diameter} mm is greater than A, which is {limit}",
        de: "der Durchmesser {diameter} mm des Helixkreises ist größer als A ({limit})",
        help_en: "mill the circle as a path with support bars, so that no core breaks loose, or give the path a larger A (default 4 * O)",
        help_de: "den Kreis als Pfad mit Stützstegen fräsen, damit kein Kern herausbricht, oder dem Pfad ein größeres A geben (sonst gilt 4 * O)",
    }
    /// Support bars that are too close to each other.
    NO_ROOM_BETWEEN_BARS: NoRoomBetweenBars {
        en: "there are only {gap} mm between support bars, too little for the cutter, O{tool}; bars: {count}",
        de: "zwischen den Stützstegen sind nur {gap} mm, zu wenig für den Fräser, O{tool}; Stege: {count}",
        help_en: "raise U, the minimum distance between bars, or shorten P",
        help_de: "U, den Mindestabstand der Stege, erhöhen oder P verkleinern",
    }
    /// A single support bar that leaves no room for the cutter on its segment.
    NO_ROOM_BESIDE_BAR: NoRoomBetweenBars {
        en: "beside the support bar there are only {gap} mm, too little for the cutter, O{tool}",
        de: "neben dem Stützsteg sind nur {gap} mm, zu wenig für den Fräser, O{tool}",
        help_en: "shorten P, the length of a bar; line type CONTINUOUS mills through without bars",
        help_de: "P, die Länge eines Stegs, verkleinern; Linientyp CONTINUOUS fräst ohne Stege durch",
    }
    /// Support bars that leave no gap, because the segment is too short.
    NO_GAP_BETWEEN_BARS: NoGapBetweenBars {
        en: "the support bars leave no gap, so everything is milled only down to D {top}: a length of {length} mm is less than P + U, which is {pitch} mm",
        de: "die Stützstege lassen keine Lücke, alles wird daher nur bis D {top} gefräst: eine Länge von {length} mm ist kürzer als P + U ({pitch} mm)",
        help_en: "for a gap, lower P, the length of a bar, or U, the minimum distance between bars; use line type DIVIDE to mill only to D, and CONTINUOUS to mill through",
        help_de: "für eine Lücke P, die Länge eines Stegs, oder U, den Mindestabstand der Stege, verkleinern; Linientyp DIVIDE fräst nur bis D, CONTINUOUS ganz durch",
    }
    /// Connected segments with support bars that leave no gap, because each of them is too short.
    NO_GAP_IN_RUN: NoGapBetweenBars {
        en: "everything is milled only down to D {top} over a length of {length} mm: each of these {count} connected segments is shorter than P + U, which is {pitch} mm",
        de: "auf einer Länge von {length} mm wird alles nur bis D {top} gefräst: jedes dieser {count} verbundenen Segmente ist kürzer als P + U ({pitch} mm)",
        help_en: "draw longer lines or arcs, such as a few arcs instead of an ellipse, or lower P or U; line type CONTINUOUS mills through without bars",
        help_de: "längere Linien oder Bögen zeichnen, etwa wenige Bögen statt einer Ellipse, oder P oder U verkleinern; Linientyp CONTINUOUS fräst ohne Stege durch",
    }
    /// A program that moves into a clamp, reported at the drawn element.
    MOVES_INTO_CLAMP: InsideKeepOut {
        en: "the tool, O{tool}, hits the clamp of layer {layer} {clamp}, which is {height} mm high: {what}, lowest Z {z}, moves: {count}",
        de: "der Fräser, O{tool}, trifft das Spannmittel auf Layer {layer} {clamp}, das {height} mm hoch ist: {what}, tiefstes Z {z}, Bewegungen: {count}",
        help_en: "raise S to {height} or more (rapids at S are straight), or move the clamp",
        help_de: "S auf {height} oder mehr erhöhen (Eilgänge auf S verlaufen gerade) oder das Spannmittel versetzen",
    }
    /// An embedded path that moves into a clamp, reported at the segment that embeds it.
    COMPONENT_INTO_CLAMP: InsideKeepOut {
        en: "the tool, O{tool}, hits the clamp of layer {layer} {clamp}, which is {height} mm high: {what} in path {component}, lowest Z {z}, moves: {count}",
        de: "der Fräser, O{tool}, trifft das Spannmittel auf Layer {layer} {clamp}, das {height} mm hoch ist: {what} in Pfad {component}, tiefstes Z {z}, Bewegungen: {count}",
        help_en: "give path {component} an S of {sweep_height} or more (rapids at S are straight), or move the clamp",
        help_de: "Pfad {component} ein S von {sweep_height} oder mehr geben (Eilgänge auf S verlaufen gerade) oder das Spannmittel versetzen",
    }
    /// A program that cuts into a clamp, reported at the drawn element.
    CUTS_INTO_CLAMP: InsideKeepOut {
        en: "the tool, O{tool}, hits the clamp of layer {layer} {clamp}, which is {height} mm high: {what}, lowest Z {z}, moves: {count}",
        de: "der Fräser, O{tool}, trifft das Spannmittel auf Layer {layer} {clamp}, das {height} mm hoch ist: {what}, tiefstes Z {z}, Bewegungen: {count}",
        help_en: "move the clamp, or keep the cut at least half of O away from its outline",
        help_de: "das Spannmittel versetzen oder den Schnitt mindestens O/2 von seinem Umriss entfernt zeichnen",
    }
    /// A probing program that moves into a clamp, reported at the probe.
    PROBING_INTO_CLAMP: InsideKeepOut {
        en: "in the probing program the tool, O{tool}, hits the clamp of layer {layer} {clamp}, which is {height} mm high: {what}, lowest Z {z}, moves: {count}",
        de: "im Antastprogramm trifft der Fräser, O{tool}, das Spannmittel auf Layer {layer} {clamp}, das {height} mm hoch ist: {what}, tiefstes Z {z}, Bewegungen: {count}",
        help_en: "draw the probe at least half of O away from the clamp's outline, or move the clamp; for the straight rapids at S from probe to probe, raise S to {height} or more",
        help_de: "die Probe mindestens O/2 vom Umriss des Spannmittels entfernt zeichnen oder das Spannmittel versetzen; für die geraden Eilgänge auf S von Probe zu Probe S auf {height} oder mehr erhöhen",
    }
    /// A path of a joined program that moves into a clamp of another path's drawing.
    JOINED_INTO_CLAMP: InsideKeepOut {
        en: "in the joined program, the tool, O{tool}, hits the clamp of layer {layer} in {drawing}, which lies at {clamp} in the program and is {height} mm high: {what}, lowest Z {z}, moves: {count}",
        de: "im gemeinsamen Programm trifft der Fräser, O{tool}, das Spannmittel auf Layer {layer} in {drawing}, das dort bei {clamp} liegt und {height} mm hoch ist: {what}, tiefstes Z {z}, Bewegungen: {count}",
        help_en: "raise S above the clamps, or write a program for each path: the clamps of all drawings are mounted during the whole program",
        help_de: "S über die Spannmittel anheben oder je Pfad ein Programm schreiben: die Spannmittel aller Zeichnungen stehen während des ganzen Programms",
    }
    /// A G-code program that moves into a clamp, reported at the line of the move.
    LINE_INTO_CLAMP: InsideKeepOut {
        en: "here the tool, O{tool}, hits the clamp of layer {layer}, which lies at {clamp} in the program and is {height} mm high: {what}, lowest Z {z}",
        de: "hier trifft der Fräser, O{tool}, das Spannmittel auf Layer {layer}, das im Programm bei {clamp} liegt und {height} mm hoch ist: {what}, tiefstes Z {z}",
        help_en: "do not run this program: according to the drawing, the clamp is there; move the clamp, or write the program with higher rapids",
        help_de: "dieses Programm nicht ausführen: laut Zeichnung steht dort das Spannmittel; es versetzen oder das Programm mit höheren Eilgängen neu schreiben",
    }
    /// A subpath without `>`.
    MISSING_NAME: MissingSubpathName {
        en: "the subpath does not say which path to embed",
        de: "der Unterpfad sagt nicht, welcher Pfad einzubetten ist",
        help_en: "put a text over it: \">1234.1P\"; or change the line type to DOT to skip it, to DASHED for a sweep",
        help_de: "einen Text darüberlegen: \">1234.1P\"; oder den Linientyp ändern: DOT, um ihn auszulassen, DASHED für eine Leerfahrt",
    }
    /// A subpath without `>` on top of another one, which has the text.
    COPY_OF_SUBPATH: MissingSubpathName {
        en: "this subpath is drawn twice: the text \"{text}\" belongs to the other one",
        de: "dieser Unterpfad ist doppelt gezeichnet: der Text \"{text}\" gehört zu dem anderen",
        help_en: "delete one of the two",
        help_de: "einen der beiden löschen",
    }
    /// A subpath drawn as a single point, to which no text can belong.
    SUBPATH_WITHOUT_LENGTH: MissingSubpathName {
        en: "this subpath has no length, so no text can belong to it",
        de: "dieser Unterpfad hat keine Länge, darum kann kein Text zu ihm gehören",
        help_en: "to embed a path that ends where it starts, draw a full circle instead: an arc with line type DASHDOT from 270 to 270 degrees, with the text over it",
        help_de: "um einen Pfad einzubetten, der endet, wo er anfängt, stattdessen einen Vollkreis zeichnen: einen Bogen mit Linientyp DASHDOT von 270 bis 270 Grad, mit dem Text darüber",
    }
    /// `>` without a path name.
    INVALID_NAME: InvalidPathName {
        en: "\"{value}\" is not a path name",
        de: "\"{value}\" ist kein Pfadname",
        help_en: "write a name that matches {pattern}",
        help_de: "einen Namen schreiben, der {pattern} entspricht",
    }
    /// `>` and a path name with an underscore or comma instead of its point.
    NAME_WITHOUT_POINT: InvalidPathName {
        en: "\"{value}\" is not a path name",
        de: "\"{value}\" ist kein Pfadname",
        help_en: "write \">{meant}\": in a text, a path name is written with a point, not with an underscore or comma",
        help_de: "\">{meant}\" schreiben: in Texten steht im Pfadnamen ein Punkt, kein Unterstrich oder Komma",
    }
    /// Further text after the name.
    MORE_THAN_NAME: InvalidPathName {
        en: "\"{value}\" is read as {name}; the rest is ignored",
        de: "\"{value}\" wird als {name} gelesen; der Rest wird nicht beachtet",
        help_en: "separate parameters from the name by a space",
        help_de: "Parameter durch ein Leerzeichen vom Namen trennen",
    }
    /// A word after `>` of which only a part is a path name.
    NAME_GOES_ON: InvalidPathName {
        en: "\"{value}\" is not a path name; only the part {name} is one",
        de: "\"{value}\" ist kein Pfadname; nur der Teil {name} ist einer",
        help_en: "write the name of the path, and a space before what follows",
        help_de: "den Namen des Pfads schreiben und vor dem, was folgt, ein Leerzeichen",
    }
    /// A path that no searched drawing contains.
    NOT_FOUND: PathNotFound {
        en: "path {name} was not found",
        de: "Pfad {name} wurde nicht gefunden",
        help_en: "correct the name, or add the directory of its drawing to `search`; pathbuild searched in {directories}; files that could contain the path: {files}",
        help_de: "den Namen berichtigen oder das Verzeichnis seiner Zeichnung zu `search` hinzufügen; gesucht wurde in {directories}; Dateien, die den Pfad enthalten könnten: {files}",
    }
    /// Note: existing paths with names similar to the missing one.
    NEAR_NAMES: PathNotFound {
        en: "similar names: {names}",
        de: "ähnliche Namen: {names}",
    }
    /// Note: the names of the paths that the searched drawings contain, none of which is similar.
    NAMES_THERE: PathNotFound {
        en: "the searched drawings contain these paths: {names}",
        de: "die durchsuchten Zeichnungen enthalten diese Pfade: {names}",
    }
    /// Note: a drawing elsewhere in the library that contains the path.
    ELSEWHERE: PathNotFound {
        en: "the library contains this path in {file}: add {directory} to `search`",
        de: "die Bibliothek enthält diesen Pfad in {file}: {directory} zu `search` hinzufügen",
    }
    /// A path that is defined at two places.
    DEFINED_TWICE: PathDefinedTwice {
        en: "path {name} exists twice: in {first} and in {second}",
        de: "Pfad {name} gibt es zweimal: in {first} und in {second}",
        help_en: "rename or remove one of them",
        help_de: "einen davon umbenennen oder entfernen",
    }
    /// A subpath segment whose length differs from the distance between the start and the end of the embedded path.
    SIZE_DIFFERS: SubpathSizeDiffers {
        en: "the segment is {segment} mm long, but path {name} is {path} mm from start to end",
        de: "das Segment ist {segment} mm lang, Pfad {name} aber {path} mm von Anfang bis Ende",
        help_en: "draw the segment from where the path starts to where it ends: copy the component's proxy line",
        help_de: "das Segment vom Anfang des Pfads bis zu seinem Ende zeichnen: die Stellvertreterlinie des Bauteils kopieren",
    }
    /// A subpath segment between two points, with a path that ends where it starts.
    SIZE_OF_CLOSED_PATH: SubpathSizeDiffers {
        en: "the segment is {segment} mm long, but path {name} ends where it starts",
        de: "das Segment ist {segment} mm lang, Pfad {name} endet aber, wo er anfängt",
        help_en: "replace the segment by a full circle, a DASHDOT arc from 270 to 270 degrees (not by a CIRCLE, nor by two half circles); or lead the path by a sweep to an end marker elsewhere, and draw the segment from its start to there",
        help_de: "das Segment durch einen Vollkreis ersetzen, einen DASHDOT-Bogen von 270 bis 270 Grad (nicht durch einen CIRCLE oder zwei Halbkreise); oder den Pfad mit einer Leerfahrt zu einer Endmarke an anderer Stelle führen und das Segment von seinem Anfang bis dorthin zeichnen",
    }
    /// A subpath segment with another cutter (O) than the embedded path has, which cannot be corrected on the segment alone.
    CUTTER_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "give both paths the same O, or embed a component that is drawn for this cutter: one cutter mills both",
        help_de: "beiden Pfaden dasselbe O geben oder ein Bauteil einbetten, das für diesen Fräser gezeichnet ist: ein Fräser fräst beide",
    }
    /// An embedding path with another cutter than the embedded one, whatever the segment states.
    CUTTER_OF_PROJECT: SubpathParameterDiffers {
        en: "path {name} is drawn for a cutter of {there} mm, but path {outer} has O{here}",
        de: "Pfad {name} ist für einen Fräser von {there} mm gezeichnet, Pfad {outer} aber hat O{here}",
        help_en: "embed the path in another project, with its O, and write both projects into one program with --join: a project is milled with one cutter",
        help_de: "den Pfad in einem anderen Projekt mit seinem O einbetten und beide Projekte mit --join in ein Programm schreiben: ein Projekt wird mit einem einzigen Fräser gefräst",
    }
    /// An embedding path with another tool than the embedded one, of the same diameter.
    TOOL_OF_PROJECT: SubpathParameterDiffers {
        en: "path {name} is for the tool {there} ([tool] in pathbuild.toml), but path {outer} is milled with the tool {here}, of the same diameter",
        de: "Pfad {name} ist für das Werkzeug {there} ([tool] in pathbuild.toml), Pfad {outer} wird aber mit dem Werkzeug {here} desselben Durchmessers gefräst",
        help_en: "if {there} mills everything in {outer}, let its `paths` match {outer} as well; otherwise embed the path in another project, whose name it matches, and write both projects into one program with --join: a project is milled with one cutter",
        help_de: "fräst {there} alles in {outer}, soll sein `paths` auch auf {outer} passen; sonst den Pfad in einem anderen Projekt einbetten, auf dessen Namen es passt, und beide Projekte mit --join in ein Programm schreiben: ein Projekt wird mit einem einzigen Fräser gefräst",
    }
    /// An embedding path with a name that selects another tool of the same diameter than the name of the embedded path does.
    TOOL_OF_COMPONENT: SubpathParameterDiffers {
        en: "path {outer} is milled with the tool {here} ([tool] in pathbuild.toml), but path {name} by itself with the tool {there}, of the same diameter",
        de: "Pfad {outer} wird mit dem Werkzeug {here} ([tool] in pathbuild.toml) gefräst, Pfad {name} für sich aber mit dem Werkzeug {there} desselben Durchmessers",
        help_en: "if {here} suits both, let its `paths` match {name} as well; otherwise embed the path in a project that is milled with {there}",
        help_de: "passt {here} für beide, soll sein `paths` auch auf {name} passen; sonst den Pfad in einem Projekt einbetten, das mit {there} gefräst wird",
    }
    /// An embedding path with a greater thickness (T) than the embedded one, although both are of one sheet: the same M, and no H that raises it.
    THICKNESS_OF_PROJECT: SubpathParameterDiffers {
        en: "path {name} is drawn for a sheet of {there} mm, but path {outer}, which embeds it, has T{here}: rapid moves go down to Z {lowest}, into the material of {outer}",
        de: "Pfad {name} ist für ein Blech von {there} mm gezeichnet, Pfad {outer}, der ihn einbettet, hat aber T{here}: Eilgänge gehen bis Z {lowest} hinab, in das Material von {outer}",
        help_en: "correct the T that is wrong. If sheets of different thickness lie side by side, give them different M, and the path that embeds them T and M of the thickest. If the thinner one lies on shims, write H on the segment",
        help_de: "das falsche T berichtigen. Liegen verschieden dicke Bleche nebeneinander, ihnen verschiedene M geben, und dem Pfad, der sie einbettet, T und M des dicksten. Liegt das dünnere auf Unterlagen, H an das Segment schreiben",
    }
    /// Note: the materials of the embedding path and of a segment differ in upper and lower case only.
    MATERIALS_DIFFER_IN_CASE: SubpathParameterDiffers {
        en: "{outer_material} and {material} differ in upper and lower case only, so both are taken for the same sheet",
        de: "{outer_material} und {material} unterscheiden sich nur in Groß- und Kleinschreibung, gelten also als dasselbe Blech",
    }
    /// A subpath segment in a block that is inserted mirrored.
    MIRRORED_SUBPATH: MirroredSubpath {
        en: "this subpath segment is in a block that is inserted mirrored, but the embedded path is never mirrored",
        de: "dieses Unterpfadsegment gehört zu einem Block, der gespiegelt eingefügt ist; der eingebettete Pfad wird aber nie gespiegelt",
        help_en: "draw the segment outside of the block, or insert the block without mirroring it; a mirrored component needs a path of its own",
        help_de: "das Segment außerhalb des Blocks zeichnen oder den Block nicht gespiegelt einfügen; ein gespiegeltes Bauteil braucht einen eigenen Pfad",
    }
    /// A subpath segment with another thickness (T) than the embedded path has, which cannot be corrected on the segment alone.
    THICKNESS_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "give both paths the same T, or embed a component that is drawn for this thickness: both are milled from the same sheet; a separate sheet would have another M, or lie on shims (H)",
        help_de: "beiden Pfaden dasselbe T geben oder ein Bauteil einbetten, das für diese Dicke gezeichnet ist: beide werden aus demselben Blech gefräst; ein eigenes Blech hat ein anderes M oder liegt auf Unterlagen (H)",
    }
    /// A subpath segment with another T, O or M than the embedded path has, which can be corrected on the segment.
    PARAMETER_DIFFERS: SubpathParameterDiffers {
        en: "{letter} is {segment} here, but {path} in path {name}",
        de: "{letter} ist hier {segment}, in Pfad {name} aber {path}",
        help_en: "if the value of the path is right, write its {letter} on the segment; otherwise embed another component",
        help_de: "ist der Wert des Pfads richtig, sein {letter} an das Segment schreiben; sonst ein anderes Bauteil einbetten",
    }
    /// Note: one of two texts that differ has an accent as a character of its own, so that they may look the same.
    COMBINED_LETTERS: SubpathParameterDiffers {
        en: "in one of the texts, a letter and its accent are two characters that look like one: type that text again",
        de: "in einem der Texte besteht ein Buchstabe aus zwei Zeichen, etwa a und ¨, die wie eines aussehen: dort den Text neu eintippen",
    }
    /// An embedding that the parameter E or the option --restrict forbids.
    FORBIDDEN: SubpathForbidden {
        en: "path {name} may not be embedded here: it does not match {rule}",
        de: "Pfad {name} darf hier nicht eingebettet werden: er entspricht nicht {rule}",
        help_en: "embed another path, or change the rule: the path's E, or --restrict (`restrict` in pathbuild.toml)",
        help_de: "einen anderen Pfad einbetten oder die Regel ändern: das E des Pfads oder --restrict (`restrict` in pathbuild.toml)",
    }
    /// Embeddings that are nested more deeply than the limit.
    TOO_DEEP: NestingTooDeep {
        en: "path {name} is embedded more than {limit} levels deep: {chain}",
        de: "Pfad {name} ist mehr als {limit} Ebenen tief eingebettet: {chain}",
        help_en: "embed it in a project with fewer levels above it",
        help_de: "in einem Projekt einbetten, über dem weniger Ebenen liegen",
    }
    /// A path that embeds itself, directly or through others.
    CYCLE: SubpathCycle {
        en: "path {name} embeds itself: {chain}",
        de: "Pfad {name} bettet sich selbst ein: {chain}",
        help_en: "remove one of these embeddings",
        help_de: "eine dieser Einbettungen entfernen",
    }
    /// A subpath segment with a greater T than the path that contains the segment.
    T_BELOW: PathTBelowSubpathT {
        en: "T of this path is {path}, which is less than the subpath's {segment}",
        de: "T dieses Pfads ist {path} und damit kleiner als {segment} beim Unterpfad",
        help_en: "correct the T that is wrong; if the subpath's sheet is another one and thicker, give this path its T and M: otherwise the outer path's sweeps run through the inner path's material",
        help_de: "das falsche T berichtigen; ist das Blech des Unterpfads ein anderes und dicker, diesem Pfad dessen T und M geben: sonst laufen die Leerfahrten des äußeren Pfads durch das Material des inneren",
    }
    /// An embedded path with errors.
    HAS_ERRORS: SubpathHasErrors {
        en: "the embedded path {name} has errors",
        de: "der eingebettete Pfad {name} hat Fehler",
        help_en: "correct them first; they are reported for {file}",
        help_de: "zuerst diese Fehler beheben; sie sind bei {file} gemeldet",
    }
}
