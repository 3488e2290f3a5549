//! Messages about finished parts: their outlines, and the cuts along and into them. (PB213 to PB223)

messages! {
    /// A cut of the path into its own part.
    GOUGE: GougedPart {
        en: "the cutter goes {depth} mm into the part at {point}, over a length of {length} mm",
        de: "der Fräser gerät bei {point} {depth} mm tief in das Teil, auf einer Länge von {length} mm",
        help_en: "draw the path at a distance of half of O from the outline, or correct the outline; `part-tolerance` in pathbuild.toml permits small differences",
        help_de: "den Pfad im Abstand von O/2 neben den Umriss zeichnen oder den Umriss berichtigen; `part-tolerance` in pathbuild.toml erlaubt kleine Abweichungen",
    }
    /// A helical circle that enters the part.
    GOUGE_BY_CIRCLE: GougedPart {
        en: "the cutter goes {depth} mm into the part at {point}, over a length of {length} mm",
        de: "der Fräser gerät bei {point} {depth} mm tief in das Teil, auf einer Länge von {length} mm",
        help_en: "draw the circle as the outer edge of the cut: as large as the hole that it mills, and larger than a disc around which it runs by 2 O; or correct the outline",
        help_de: "den Kreis als Außenkante des Schnitts zeichnen: so groß wie das Loch, das er fräst, und um 2 O größer als die Scheibe, um die er läuft; oder den Umriss berichtigen",
    }
    /// A cut with the whole cutter inside the part.
    GOUGE_INSIDE: GougedPart {
        en: "the cutter goes {depth} mm into the part at {point}, over a length of {length} mm",
        de: "der Fräser gerät bei {point} {depth} mm tief in das Teil, auf einer Länge von {length} mm",
        help_en: "for a groove, write B, the height of its bottom, at this element; to travel above the material, draw it HIDDEN; for an opening, draw its outline on the layer of the part",
        help_de: "für eine Nut B, die Höhe ihres Grunds, an dieses Element schreiben; für einen Weg über dem Material HIDDEN zeichnen; für einen Ausschnitt dessen Umriss auf dem Layer des Teils zeichnen",
    }
    /// A hole drilled into the part.
    GOUGE_BY_HOLE: GougedPart {
        en: "the hole, O{tool}, goes {depth} mm into the part at {point}",
        de: "das Bohrloch, O{tool}, ragt bei {point} {depth} mm weit in das Teil",
        help_en: "move the hole, or draw its circle on the layer of the part as well",
        help_de: "das Bohrloch versetzen oder seinen Kreis auch auf dem Layer des Teils zeichnen",
    }
    /// A hole or helical circle that takes away a whole part, because its circle is taken for the part's outline.
    GOUGED_BY_ITS_HOLE: GougedPart {
        en: "the circle of this hole is taken for the outline of a part: layer {layer} has no outline around it",
        de: "der Kreis dieses Lochs wird für den Umriss eines Teils gehalten: auf Layer {layer} liegt kein Umriss um ihn herum",
        help_en: "draw the outline of the part around the hole on layer {layer}, closed and with line type CONTINUOUS: other line types do not count",
        help_de: "den Umriss des Teils um das Loch herum auf Layer {layer} zeichnen, geschlossen und mit Linientyp CONTINUOUS: andere Linientypen zählen nicht",
    }
    /// A cut into the part of another path of the project.
    GOUGED_NEIGHBOUR: GougedNeighbour {
        en: "the cutter, O{tool}, goes {depth} mm into the part of path {other} at {point}; that part lies at {place} in the program",
        de: "der Fräser, O{tool}, gerät bei {point} {depth} mm tief in das Teil von Pfad {other}, das im Programm bei {place} liegt",
        help_en: "place the two parts farther apart, so that the cutter fits between them",
        help_de: "die beiden Teile mit größerem Abstand anordnen, sodass der Fräser dazwischen Platz hat",
    }
    /// A cut into the part of another path by a path that cuts no part of its own.
    GOUGED_BY_PATH_WITHOUT_PART: GougedNeighbour {
        en: "the cutter, O{tool}, goes {depth} mm into the part of path {other} at {point}; that part lies at {place} in the program",
        de: "der Fräser, O{tool}, gerät bei {point} {depth} mm tief in das Teil von Pfad {other}, das im Programm bei {place} liegt",
        help_en: "move this path away from the part; if it is meant to mill an opening of the part, draw the opening on the layer of the part's outline",
        help_de: "diesen Pfad vom Teil wegrücken; soll er einen Ausschnitt des Teils fräsen, den Ausschnitt auf dem Layer des Umrisses zeichnen",
    }
    /// Material left beside an outline.
    LEFTOVER: LeftoverAtPart {
        en: "up to {thickness} mm of material remain at the outline of the part, from {from} to {to}, over {length} mm (places: {count})",
        de: "am Umriss des Teils bleiben bis zu {thickness} mm Material stehen, von {from} bis {to}, auf {length} mm (Stellen: {count})",
        help_en: "draw the path at a distance of half of O from the outline; to leave an allowance on purpose, include it in the outline",
        help_de: "den Pfad im Abstand von O/2 neben den Umriss zeichnen; soll ein Aufmaß bleiben, das Teil damit zeichnen",
    }
    /// Material left at the lower edge of a part by a bull nose or ball end mill.
    ROUND_TIP: LeftoverAtPart {
        en: "the round tip of the cutter leaves up to {thickness} mm of material at the lower edge of the part, from {from} to {to}, over {length} mm (places: {count}): the cut ends at Z{height}",
        de: "die runde Stirn des Fräsers lässt an der Unterkante des Teils, von {from} bis {to}, auf {length} mm, bis zu {thickness} mm Material stehen (Stellen: {count}): der Schnitt endet bei Z{height}",
        help_en: "set B to {bottom} or below, so that the cutter goes through the plate with its full diameter, or use a cutter with a flat tip",
        help_de: "B auf {bottom} oder darunter setzen, damit der Fräser mit vollem Durchmesser durch die Platte geht, oder einen Fräser mit flacher Stirn nehmen",
    }
    /// A cut along the outline of a part that does not go through the material.
    NOT_CUT_THROUGH: LeftoverAtPart {
        en: "the cut along the outline of the part, from {from} to {to}, over {length} mm, does not go through: it ends at Z{height} (places: {count})",
        de: "der Schnitt am Umriss des Teils, von {from} bis {to}, auf {length} mm, geht nicht durch: er endet bei Z{height} (Stellen: {count})",
        help_en: "to cut through, set B to 0 or below; a mark (DIVIDE) only goes down to D: draw it CONTINUOUS, or BORDER for support bars",
        help_de: "zum Durchtrennen B auf 0 oder darunter setzen; eine Markierung (DIVIDE) geht nur bis D: sie CONTINUOUS zeichnen, mit Stützstegen BORDER",
    }
    /// A sweep along the outline of a part, where the other sides are cut.
    SWEEP_ALONG_OUTLINE: LeftoverAtPart {
        en: "only a sweep runs along the outline of the part, from {from} to {to}, over {length} mm: this side is not cut (places: {count})",
        de: "am Umriss des Teils, von {from} bis {to}, auf {length} mm, verläuft nur eine Leerfahrt: diese Seite wird nicht gefräst (Stellen: {count})",
        help_en: "check the line type: draw a cut CONTINUOUS, or BORDER for support bars; if this side is the edge of the material, draw the sweep farther away",
        help_de: "den Linientyp prüfen: einen Schnitt CONTINUOUS zeichnen, mit Stützstegen BORDER; ist diese Seite der Rand des Materials, die Leerfahrt weiter entfernt zeichnen",
    }
    /// Inner corners that are sharper than the cutter.
    UNREACHABLE_CORNER: UnreachableCorner {
        en: "the cutter, O{tool}, does not reach all of the outline: inner corners such as the one at {point} are too sharp, over {length} mm in all",
        de: "der Fräser, O{tool}, erreicht nicht den ganzen Umriss: Innenecken wie die bei {point} sind zu scharf, zusammen auf {length} mm",
        help_en: "round the corners of the part with a radius of at least half of O, use a smaller cutter, or accept the rounding",
        help_de: "die Ecken des Teils mit mindestens O/2 runden, einen kleineren Fräser nehmen oder die Rundung hinnehmen",
    }
    /// A part that nothing holds.
    LOOSE_PART: LoosePart {
        en: "the part whose outline begins at {point} is cut out all round, and no support bar holds it",
        de: "das Teil, dessen Umriss bei {point} beginnt, wird rundum ausgefräst, und kein Stützsteg hält es",
        help_en: "draw some segments of its outline with support bars (BORDER) of a sufficient length (P), or set part-held = \"otherwise\" if tape or vacuum holds it",
        help_de: "einige Segmente seines Umrisses mit Stützstegen (BORDER) ausreichender Länge (P) zeichnen oder part-held = \"otherwise\" setzen, wenn Klebeband oder Vakuum es hält",
    }
    /// A part that is held after the cuts of its own path, but loose after the cuts of another path of its drawing.
    SEVERED_PART: LoosePart {
        en: "after this cut, nothing holds the part of path {other} whose outline begins at {point}: this cut meets the cuts between the support bars",
        de: "nach diesem Schnitt hält nichts mehr das Teil von Pfad {other}, dessen Umriss bei {point} beginnt: dieser Schnitt verbindet sich mit den Schnitten zwischen den Stützstegen",
        help_en: "place the parts farther apart, or draw support bars on a side where material remains",
        help_de: "die Teile mit größerem Abstand anordnen oder Stützstege auf einer Seite zeichnen, an der Material stehen bleibt",
    }
    /// A part of another path of the project that is loose after the cuts of this path.
    SEVERED_NEIGHBOUR: LoosePart {
        en: "after this cut, nothing holds the part of path {other} whose outline begins at {place} in the program: this cut meets the cuts between the support bars",
        de: "nach diesem Schnitt hält nichts mehr das Teil von Pfad {other}, dessen Umriss im Programm bei {place} beginnt: dieser Schnitt verbindet sich mit den Schnitten zwischen den Stützstegen",
        help_en: "place the parts farther apart, or draw support bars on a side where material remains",
        help_de: "die Teile mit größerem Abstand anordnen oder Stützstege auf einer Seite zeichnen, an der Material stehen bleibt",
    }
    /// A part that is loose because the support bars of helical circles do not turn with their path.
    SEVERED_BY_TURNING: LoosePart {
        en: "after this cut, nothing holds the part of path {other} whose outline begins at {place} in the program: the path is turned where it is embedded, but the support bars of a circle do not turn with it",
        de: "nach diesem Schnitt hält nichts mehr das Teil von Pfad {other}, dessen Umriss im Programm bei {place} beginnt: der Pfad ist gedreht eingebettet, aber die Stützstege eines Kreises drehen sich nicht mit",
        help_en: "embed the path at another angle, or draw the ring as two arcs at a distance of half of O from the outline, whose bars turn with the path",
        help_de: "den Pfad in einem anderen Winkel einbetten oder den Ring als zwei Bögen im Abstand von O/2 neben dem Umriss zeichnen, deren Stege sich mitdrehen",
    }
    /// Support bars that another cut removes.
    BAR_CUT_AWAY: BarCutAway {
        en: "this cut removes {lost} of the {length} mm of the support bar at {point} of path {other} (bars: {count})",
        de: "dieser Schnitt nimmt {lost} von {length} mm des Stützstegs bei {point} von Pfad {other} weg (Stege: {count})",
        help_en: "interrupt this cut at the bar, end it higher than D of the bar, or lengthen a short line with a bar to more than O",
        help_de: "den Schnitt am Steg aussparen oder höher als D des Stegs enden lassen, oder eine kurze Linie mit Steg auf mehr als O verlängern",
    }
    /// Support bars that a cut of another path of the project removes.
    NEIGHBOURS_BAR_CUT_AWAY: BarCutAway {
        en: "this cut removes {lost} of the {length} mm of a support bar of path {other}; that bar stands at {point} in the program (bars: {count})",
        de: "dieser Schnitt nimmt {lost} von {length} mm eines Stützstegs von Pfad {other} weg; dieser Steg steht im Programm bei {point} (Stege: {count})",
        help_en: "place the paths farther apart, or end this cut higher than D of the bar",
        help_de: "die Pfade mit größerem Abstand anordnen oder diesen Schnitt höher als D des Stegs enden lassen",
    }
    /// Support bars that a cut removes because the support bars of helical circles do not turn with their path.
    BAR_LOST_BY_TURNING: BarCutAway {
        en: "this cut removes {lost} of the {length} mm of a support bar of path {other}: the path is turned where it is embedded, but the bars of a circle do not turn with it, so this bar is at {point} in the program (bars: {count})",
        de: "dieser Schnitt nimmt {lost} von {length} mm eines Stützstegs von Pfad {other} weg, der gedreht eingebettet ist: die Stege eines Kreises drehen sich nicht mit, und dieser steht im Programm bei {point} (Stege: {count})",
        help_en: "embed the path at another angle, or draw the ring as two arcs at a distance of half of O from the outline, whose bars turn with the path",
        help_de: "den Pfad in einem anderen Winkel einbetten oder den Ring als zwei Bögen im Abstand von O/2 neben dem Umriss zeichnen, deren Stege sich mitdrehen",
    }
    /// Two ends of an outline that almost meet.
    OUTLINE_GAP: DoubtfulOutline {
        en: "the outline of the part has a gap: it ends at {point} and at {other}, {distance} mm apart",
        de: "der Umriss des Teils hat eine Lücke: er endet bei {point} und bei {other}, {distance} mm auseinander",
        help_en: "close the gap with the CAD's object snap; neither an open outline nor anything inside it is checked",
        help_de: "die Lücke mit dem Objektfang des CAD schließen; ein offener Umriss und alles darin werden nicht geprüft",
    }
    /// An outline that crosses itself.
    OUTLINE_CROSSES_ITSELF: DoubtfulOutline {
        en: "the outline of the part crosses itself at {point}",
        de: "der Umriss des Teils kreuzt sich bei {point} selbst",
        help_en: "trim it there, so that its ends meet in one point; until then, neither the outline nor anything inside it is checked",
        help_de: "ihn dort stutzen, sodass sich seine Enden in einem Punkt treffen; bis dahin werden er und alles darin nicht geprüft",
    }
    /// An outline that crosses or overlaps the rim of a part.
    OUTLINE_CROSSES_RIM: DoubtfulOutline {
        en: "this outline crosses or overlaps the rim of the part at {point}, so it is neither an opening nor a part",
        de: "dieser Umriss kreuzt oder überdeckt bei {point} den Rand des Teils und ist deshalb weder ein Ausschnitt noch ein Teil",
        help_en: "trim the two to one outline, or delete the copy if one is a copy of the other; if this one only indicates something, such as a counterbore, give it another layer or line type",
        help_de: "beide zu einem Umriss stutzen oder, wenn einer eine Kopie des anderen ist, die Kopie löschen; zeigt dieser nur etwas an, etwa eine Senkung, ihm einen anderen Layer oder Linientyp geben",
    }
    /// A layer for parts that has no closed outline.
    NO_CLOSED_OUTLINE: DoubtfulOutline {
        en: "layer {layer} has no closed outline, so no part is checked there",
        de: "Layer {layer} hat keinen geschlossenen Umriss, deshalb wird dort kein Teil geprüft",
        help_en: "draw the outline with CONTINUOUS lines, arcs, circles or closed polylines whose ends meet all around; other line types do not count",
        help_de: "den Umriss mit Linien, Bögen, Kreisen oder geschlossenen Polylinien vom Linientyp CONTINUOUS zeichnen, deren Enden sich rundum treffen; andere Linientypen zählen nicht",
    }
    /// An unsupported element on a layer with parts.
    OUTLINE_UNREADABLE: DoubtfulOutline {
        en: "this {entity} on a layer with a part could not be read, so the outline may be incomplete",
        de: "{entity} auf einem Layer mit einem Teil war nicht lesbar; der Umriss ist daher vielleicht unvollständig",
        help_en: "draw the outline with lines, arcs, circles or closed polylines; ellipses and splines are read if `approximate-curves` is set in pathbuild.toml, blocks if the file contains them and they have the same scale in x and y",
        help_de: "den Umriss mit Linien, Bögen, Kreisen oder geschlossenen Polylinien zeichnen; Ellipsen und Splines werden gelesen, wenn `approximate-curves` in pathbuild.toml gesetzt ist, Blöcke, wenn die Datei sie enthält und sie in x und y denselben Maßstab haben",
    }
    /// A faulty element on a layer with parts. Its problem is a note.
    OUTLINE_FAULTY: DoubtfulOutline {
        en: "this {entity} on a layer with a part has an error, so the outline may be incomplete",
        de: "{entity} auf einem Layer mit einem Teil hat einen Fehler; der Umriss ist daher vielleicht unvollständig",
        help_en: "correct what the note says, or draw the element again",
        help_de: "berichtigen, was der Hinweis nennt, oder das Element neu zeichnen",
    }
    /// An outline of a part that no path cuts.
    OUTLINE_NOT_CUT: OutlineNotCut {
        en: "no path of this drawing cuts through the material along this outline",
        de: "kein Pfad dieser Zeichnung fräst an diesem Umriss entlang durch das Material",
        help_en: "if a path is missing, draw it; if a path runs along the outline but ends above the plate, lower its B; if a path runs at a distance of O or more, move it to half of O from the outline; if this is not an outline of the part, move it to another layer",
        help_de: "fehlt ein Pfad, ihn zeichnen; läuft ein Pfad am Umriss entlang, endet aber über der Platte, sein B tiefer setzen; verläuft ein Pfad im Abstand von O oder mehr, ihn auf O/2 an den Umriss heranrücken; ist dies kein Umriss des Teils, ihn auf einen anderen Layer legen",
    }
    /// A layer with a part that names a path which its drawing lacks.
    LAYER_WITHOUT_PATH: OutlineNotCut {
        en: "layer {layer} names path {name}, which this drawing does not have, so this part is only checked for cuts into it",
        de: "Layer {layer} nennt den Pfad {name}, den es in dieser Zeichnung nicht gibt; daher wird dieses Teil nur auf Schnitte ins Teil geprüft",
        help_en: "rename the layer after a path of this drawing ({names}), or correct the group in `part` in pathbuild.toml",
        help_de: "den Layer nach einem Pfad dieser Zeichnung ({names}) benennen oder die Gruppe in `part` in pathbuild.toml berichtigen",
    }
    /// Two paths that cut the same part, but are embedded at different places.
    DISPLACED_PATH: DisplacedPath {
        en: "paths {name} and {other} cut the same part, but place it up to {distance} mm apart: in the program, its outline begins at {point} and at {place}",
        de: "die Pfade {name} und {other} fräsen dasselbe Teil, aber um bis zu {distance} mm gegeneinander versetzt: sein Umriss beginnt im Programm bei {point} und bei {place}",
        help_en: "embed the paths relative to each other as they lie in their drawing; two copies of the part must be O or more apart",
        help_de: "die Pfade so zueinander einbetten, wie sie in ihrer Zeichnung liegen; zwei Exemplare des Teils müssen mindestens um O auseinanderliegen",
    }
    /// Two paths that cut the same part out, but are raised by different heights.
    RAISED_PATH: DisplacedPath {
        en: "paths {name} and {other} cut the same part out, but one of them {distance} mm higher than the other",
        de: "die Pfade {name} und {other} fräsen dasselbe Teil aus, aber der eine {distance} mm höher als der andere",
        help_en: "embed both paths with the same H, since the part lies at one height",
        help_de: "beide Pfade mit demselben H einbetten, denn das Teil liegt auf einer Höhe",
    }
    /// A cut in a piece of waste that nothing holds any more.
    CUT_IN_LOOSE_WASTE: CutInLooseWaste {
        en: "path {name} cuts in waste that is loose by then: the opening of path {other} whose outline begins at {place} in the program has been cut out all round",
        de: "Pfad {name} fräst in Abfall, der dann schon lose ist: der Ausschnitt von Pfad {other}, dessen Umriss im Programm bei {place} beginnt, ist rundum ausgefräst",
        help_en: "mill this path before the opening, draw support bars in the opening, or set part-held = \"otherwise\" if tape or vacuum holds the waste",
        help_de: "diesen Pfad vor dem Ausschnitt fräsen, den Ausschnitt mit Stützstegen zeichnen oder part-held = \"otherwise\" setzen, wenn Klebeband oder Vakuum den Abfall hält",
    }
    /// An outline in an opening that a path cuts as a part.
    PART_IN_OPENING: PartInOpening {
        en: "a path runs along the outside of this outline as round a part, but the outline lies in an opening, so it is not checked as a part",
        de: "ein Pfad läuft an der Außenseite dieses Umrisses entlang wie um ein Teil, der Umriss liegt aber in einem Ausschnitt und wird deshalb nicht als Teil geprüft",
        help_en: "give the inner part a drawing of its own, and embed its path; if this is not an outline of a part, move it to another layer",
        help_de: "das innere Teil in eine eigene Zeichnung setzen und seinen Pfad einbetten; ist dies kein Umriss eines Teils, ihn auf einen anderen Layer legen",
    }
}
